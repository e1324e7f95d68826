#include "variants.h"

#include "lookup.h"
#include "try.h"

#include <stdbool.h>
#include <string.h>

/* By name first: a variant may be called "2". False: there is none. */
static bool find_variant(const tl_gltf *gltf, const char *wanted, int *out)
{
    size_t index;
    for (size_t i = 0; i < gltf->variant_count; i++)
        if (strcmp(gltf->variants[i], wanted) == 0) {
            *out = (int)i;
            return true;
        }
    if (!tl_index_of(wanted, gltf->variant_count, &index))
        return false;
    *out = (int)index;
    return true;
}

tl_status tl_find_variant(const tl_gltf *gltf, const char *wanted, int *out, tl_error *err)
{
    char names[1024] = "";
    *out = TL_NO_VARIANT;
    if (!wanted || find_variant(gltf, wanted, out))
        return TL_OK;
    if (gltf->variant_count == 0)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s: has no variants of materials, so none can be chosen", gltf->path);
    for (size_t i = 0; i < gltf->variant_count; i++)
        if (!tl_list_add(names, sizeof names, tl_label_of("", i, gltf->variants[i]).text))
            break;
    return tl_fail(err, TL_ERR_ARGUMENT, "%s: has no variant \"%.64s\"; it has: %s", gltf->path,
                   wanted, names);
}

/* The mapping of the variant, NULL: the primitive has none for it. */
static tl_status find_mapping(const tl_gltf *gltf,
                              const char *user,
                              const tl_gltf_primitive *primitive,
                              int variant,
                              const tl_gltf_mapping **out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    *out = NULL;
    for (size_t i = 0; i < primitive->mapping_count; i++) {
        const tl_gltf_mapping *const one = &primitive->mappings[i];
        for (size_t k = 0; k < one->variant_count; k++) {
            TRY(tl_gltf_check_index(gltf, user, "variant", one->variants[k],
                                    gltf->variant_count, err));
            if (one->variants[k] == variant && !*out)
                *out = one;
        }
    }
done:
    return status;
}

tl_status tl_variant_material(const tl_gltf *gltf,
                              const char *user,
                              const tl_gltf_primitive *primitive,
                              int variant,
                              size_t *out,
                              tl_error *err)
{
    const tl_gltf_mapping *mapping = NULL;
    tl_status status = TL_OK;
    if (variant != TL_NO_VARIANT)
        TRY(find_mapping(gltf, user, primitive, variant, &mapping, err));
    const int material = mapping ? mapping->material : primitive->material;
    *out = gltf->material_count;
    if (material == -1 && !mapping)
        goto done;
    TRY(tl_gltf_check_index(gltf, user, "material", material, gltf->material_count, err));
    *out = (size_t)material;
done:
    return status;
}
