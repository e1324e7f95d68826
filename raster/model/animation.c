#include "animation.h"

#include "accessor.h"
#include "curves.h"
#include "load_limits.h"
#include "lookup.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- which ------------------------------------------------------------------------------------- */

/* By name first: an animation may be called "2"; one without a name is not called "". False: there is
 * none. */
static bool find_animation(const tl_gltf *gltf, const char *wanted, size_t *out)
{
    *out = 0;
    if (!wanted)
        return gltf->animation_count > 0;
    for (size_t i = 0; i < gltf->animation_count && wanted[0]; i++)
        if (strcmp(gltf->animations[i].name, wanted) == 0) {
            *out = i;
            return true;
        }
    return tl_index_of(wanted, gltf->animation_count, out);
}

static tl_status refuse_wanted(const tl_gltf *gltf, const char *wanted, tl_error *err)
{
    char names[1024] = "";
    if (gltf->animation_count == 0)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: has no animations, so it can only be shown without a time",
                       gltf->path);
    for (size_t i = 0; i < gltf->animation_count; i++)
        if (!tl_list_add(names, sizeof names,
                         tl_label_of("", i, gltf->animations[i].name).text))
            break;
    return tl_fail(err, TL_ERR_ARGUMENT, "%s: has no animation \"%.64s\"; it has: %s",
                   gltf->path, wanted, names);
}

/* --- the words of a file ----------------------------------------------------------------------- */

static const struct {
    const char *word;
    int use;
    size_t width;
} paths[TL_PATH_COUNT] = {
#define PATH(name, word, use, width) [name] = {word, use, width},
    TL_PATHS(PATH)
#undef PATH
};

static const struct {
    const char *word;
    size_t elements, least; /* per key; keys */
} interpolations[TL_INTERPOLATION_COUNT] = {
#define INTERPOLATION(name, word, elements, keys) [name] = {word, elements, keys},
    TL_INTERPOLATIONS(INTERPOLATION)
#undef INTERPOLATION
};

/* --- one channel ------------------------------------------------------------------------------- */

typedef struct player {
    const tl_gltf *gltf;
    const tl_gltf_animation *animation;
    tl_label label; /* of the animation */
    double time, end;
    tl_budget budget; /* for the keys of all channels */
    tl_pose pose;
} player;

/* A channel once its words are known. */
typedef struct track {
    char user[160]; /* "animation 0 ("walk"): the rotation of node 3" */
    size_t node;
    enum tl_path path;
    const tl_gltf_keys *keys;
    tl_curve curve;
    float *times, *values; /* the curve's, owned */
} track;

static tl_status find_path(const player *at,
                           const tl_gltf_channel *from,
                           track *to,
                           tl_error *err)
{
    size_t path = 0;
    while (path < TL_PATH_COUNT && strcmp(paths[path].word, from->path) != 0)
        path++;
    if (path == TL_PATH_COUNT)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s moves the \"%.32s\" of node %d, which nodes have not",
                       at->gltf->path, at->label.text, from->path, from->node);
    to->path = (enum tl_path)path;
    snprintf(to->user, sizeof to->user, "%s: the %s of node %d", at->label.text,
             paths[path].word, from->node);
    return TL_OK;
}

static tl_status find_width(const player *at, track *to, tl_error *err)
{
    const tl_gltf_node *const node = &at->gltf->nodes[to->node];
    tl_status status = TL_OK;
    to->curve.width = paths[to->path].width;
    if (to->path != TL_PATH_WEIGHTS)
        return TL_OK;
    if (node->mesh != -1) {
        TRY(tl_gltf_check_index(at->gltf, to->user, "mesh", node->mesh, at->gltf->mesh_count,
                                err));
        to->curve.width = tl_mesh_target_count(&at->gltf->meshes[node->mesh]);
    }
    if (to->curve.width == 0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: it has no mesh with morph targets",
                       at->gltf->path, to->user);
done:
    return status;
}

static tl_status open_track(const player *at,
                            const tl_gltf_channel *from,
                            track *to,
                            tl_error *err)
{
    const tl_gltf *const gltf = at->gltf;
    tl_status status = TL_OK;
    TRY(tl_gltf_check_index(gltf, at->label.text, "node", from->node, gltf->node_count, err));
    to->node = (size_t)from->node;
    TRY(find_path(at, from, to, err));
    TRY(tl_gltf_check_index(gltf, to->user, "sampler", from->keys, at->animation->keys_count,
                            err));
    to->keys = &at->animation->keys[from->keys];
    if (gltf->nodes[to->node].matrix_count && to->path != TL_PATH_WEIGHTS)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: it has a matrix, and only what has none can move", gltf->path,
                       to->user);
    if (at->pose.nodes[to->node].values[to->path])
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s is moved by two channels", gltf->path,
                       to->user);
    TRY(find_width(at, to, err));
    size_t kind = 0;
    while (kind < TL_INTERPOLATION_COUNT &&
           strcmp(interpolations[kind].word, to->keys->interpolation) != 0)
        kind++;
    if (kind == TL_INTERPOLATION_COUNT)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s: the interpolation \"%.32s\" is none; there are LINEAR, STEP "
                       "and CUBICSPLINE",
                       gltf->path, to->user, to->keys->interpolation);
    to->curve.interpolation = (enum tl_interpolation)kind;
    to->curve.rotates = to->path == TL_PATH_ROTATION;
done:
    return status;
}

static tl_status check_times(const player *at, const track *t, tl_error *err)
{
    const size_t least = interpolations[t->curve.interpolation].least;
    if (t->curve.key_count < least)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has %zu keys; %s needs %zu", at->gltf->path,
                       t->user, t->curve.key_count, interpolations[t->curve.interpolation].word,
                       least);
    if (t->times[0] < 0.0f)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s begins at %g s, before 0", at->gltf->path,
                       t->user, (double)t->times[0]);
    for (size_t i = 1; i < t->curve.key_count; i++)
        if (!(t->times[i] > t->times[i - 1]))
            return tl_fail(
                err, TL_ERR_FORMAT, "%s: %s: its key %zu at %g s is not after the one at %g s",
                at->gltf->path, t->user, i, (double)t->times[i], (double)t->times[i - 1]);
    return TL_OK;
}

static tl_status check_rotations(const player *at, const track *t, tl_error *err)
{
    const size_t elements = interpolations[t->curve.interpolation].elements;
    for (size_t i = 0; i < t->curve.key_count && t->curve.rotates; i++) {
        const float *const q = t->values + 4 * (elements * i + elements / 2);
        if (q[0] == 0.0f && q[1] == 0.0f && q[2] == 0.0f && q[3] == 0.0f)
            return tl_fail(err, TL_ERR_FORMAT, "%s: %s: its key %zu is a rotation of length 0",
                           at->gltf->path, t->user, i);
    }
    return TL_OK;
}

static tl_status read_keys(player *at, track *t, tl_error *err)
{
    const tl_gltf *const gltf = at->gltf;
    size_t count = 0;
    tl_status status = TL_OK;
    TRY(tl_accessor_read(gltf, t->user, t->keys->times, TL_USE_KEY_TIMES, &at->budget,
                         &t->times, &t->curve.key_count, err));
    t->curve.times = t->times;
    TRY(check_times(at, t, err));
    TRY(tl_accessor_read(gltf, t->user, t->keys->values, paths[t->path].use, &at->budget,
                         &t->values, &count, err));
    t->curve.values = t->values;
    /* Weights are single numbers: an element is one of them. */
    const size_t per_key = interpolations[t->curve.interpolation].elements *
                           (t->path == TL_PATH_WEIGHTS ? t->curve.width : 1);
    if (count != t->curve.key_count * per_key)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s has %zu elements for %zu keys, where %s needs %zu each",
                       gltf->path, t->user, count, t->curve.key_count,
                       interpolations[t->curve.interpolation].word, per_key);
    TRY(check_rotations(at, t, err));
done:
    return status;
}

/* Keys are floats: 0.1 s is the key at 0.1 s only when both are rounded alike. */
static tl_status play(player *at, const tl_gltf_channel *channel, tl_error *err)
{
    track t = {0};
    tl_status status = TL_OK;
    TRY(open_track(at, channel, &t, err));
    TRY(read_keys(at, &t, err));
    double *const value = calloc(t.curve.width, sizeof *value);
    if (!value) {
        status =
            tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %s", at->gltf->path, t.user);
        goto done;
    }
    at->pose.nodes[t.node].values[t.path] = value;
    tl_curve_sample(&t.curve, (double)(float)at->time, value);
    at->end = fmax(at->end, (double)t.times[t.curve.key_count - 1]);
done:
    free(t.times);
    free(t.values);
    return status;
}

/* --- all of them ------------------------------------------------------------------------------- */

/* Sets all but gltf and time; the caller clears the pose. */
static tl_status play_all(player *at, size_t index, tl_error *err)
{
    const tl_gltf *const gltf = at->gltf;
    tl_status status = TL_OK;
    at->animation = &gltf->animations[index];
    at->label = tl_label_of("animation", index, at->animation->name);
    at->budget = (tl_budget){tl_max_geometry_bytes};
    at->pose = (tl_pose){gltf->node_count, calloc(gltf->node_count + 1, sizeof(tl_node_pose))};
    if (!at->pose.nodes)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for %s", gltf->path,
                       at->label.text);
    for (size_t i = 0; i < at->animation->channel_count; i++)
        TRY(play(at, &at->animation->channels[i], err));
done:
    return status;
}

tl_status tl_animation_end(const tl_gltf *gltf, size_t index, double *seconds, tl_error *err)
{
    player at = {.gltf = gltf};
    const tl_status status = play_all(&at, index, err);
    if (status == TL_OK)
        *seconds = at.end;
    tl_pose_clear(&at.pose);
    return status;
}

tl_status tl_animation_pose(const tl_gltf *gltf,
                            const tl_moment *moment,
                            const tl_notices *notices,
                            tl_pose *out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    size_t index = 0;
    *out = (tl_pose){0};
    if (!moment->has_time && !moment->animation)
        return TL_OK;
    if (moment->has_time && !(moment->time >= 0.0 && isfinite(moment->time)))
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: cannot be shown at %g s: times start at 0",
                       gltf->path, moment->time);
    if (!find_animation(gltf, moment->animation, &index))
        return refuse_wanted(gltf, moment->animation, err);

    player at = {.gltf = gltf, .time = moment->has_time ? moment->time : 0.0};
    TRY(play_all(&at, index, err));
    if ((float)at.time > (float)at.end)
        tl_notice(notices, "%s: %s ends at %g s; its end is shown for %g s", gltf->path,
                  at.label.text, at.end, at.time);
    *out = at.pose;
    at.pose = (tl_pose){0};
done:
    tl_pose_clear(&at.pose);
    return status;
}
