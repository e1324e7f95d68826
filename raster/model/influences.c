#include "influences.h"

#include "try.h"

#include <stdlib.h>

static tl_status read_half(const tl_gltf *gltf,
                           const char *user,
                           int accessor,
                           int use,
                           size_t set,
                           size_t count,
                           tl_budget *budget,
                           float **out,
                           tl_error *err)
{
    const char *const word = use == TL_USE_JOINTS ? "JOINTS" : "WEIGHTS";
    size_t found = 0;
    if (accessor == -1)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has no %s_%zu, which its skin needs",
                       gltf->path, user, word, set);
    const tl_status status =
        tl_accessor_read(gltf, user, accessor, use, budget, out, &found, err);
    if (status == TL_OK && found != count)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has %zu positions, but %zu of %s_%zu",
                       gltf->path, user, count, found, word, set);
    return status;
}

/* Where the weight is 0 a joint does not count: exporters leave anything there. */
static tl_status check_set(const tl_gltf *gltf,
                           const char *user,
                           const tl_influence_set *set,
                           size_t count,
                           size_t joint_count,
                           tl_error *err)
{
    for (size_t i = 0; i < TL_JOINTS_PER_SET * count; i++) {
        if (set->weights[i] < 0.0f)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: vertex %zu has the weight %g for a joint", gltf->path, user,
                           i / TL_JOINTS_PER_SET, (double)set->weights[i]);
        if (set->weights[i] > 0.0f && (double)set->joints[i] >= (double)joint_count)
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: %s: vertex %zu is moved by joint %.0f, but its skin has %zu",
                           gltf->path, user, i / TL_JOINTS_PER_SET, (double)set->joints[i],
                           joint_count);
    }
    return TL_OK;
}

tl_status tl_influences_read(const tl_gltf *gltf,
                             const char *user,
                             const tl_gltf_primitive *primitive,
                             size_t count,
                             size_t joint_count,
                             tl_budget *budget,
                             tl_influences *out,
                             tl_error *err)
{
    const size_t set_count = primitive->influences_count;
    void *sets = NULL;
    tl_status status = TL_OK;

    *out = (tl_influences){.count = count};
    if (set_count == 0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has no JOINTS_0, which its skin needs",
                       gltf->path, user);
    TRY(tl_budget_take(budget, gltf, user, set_count, sizeof *out->sets, &sets, err));
    out->sets = sets;
    out->set_count = set_count;
    for (size_t i = 0; i < set_count; i++) {
        const tl_gltf_influences *const from = &primitive->influences[i];
        tl_influence_set *const to = &out->sets[i];
        TRY(read_half(gltf, user, from->joints, TL_USE_JOINTS, i, count, budget, &to->joints,
                      err));
        TRY(read_half(gltf, user, from->weights, TL_USE_WEIGHTS, i, count, budget, &to->weights,
                      err));
        TRY(check_set(gltf, user, to, count, joint_count, err));
    }
done:
    return status;
}

void tl_influences_clear(tl_influences *influences)
{
    for (size_t i = 0; i < influences->set_count; i++) {
        free(influences->sets[i].joints);
        free(influences->sets[i].weights);
    }
    free(influences->sets);
    *influences = (tl_influences){0};
}

double tl_influences_sum(const tl_influences *influences, size_t vertex)
{
    double sum = 0.0;
    for (size_t i = 0; i < influences->set_count; i++)
        for (size_t k = 0; k < TL_JOINTS_PER_SET; k++)
            sum += (double)influences->sets[i].weights[TL_JOINTS_PER_SET * vertex + k];
    return sum;
}
