#include "packing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const words[TL_LAYOUT_COUNT] = {
#define LAYOUT_WORD(name, row, word) [name] = word,
    TL_LAYOUTS(LAYOUT_WORD)
#undef LAYOUT_WORD
};

const char *tl_layout_word(enum tl_layout_name layout)
{
    return words[layout];
}

tl_status tl_layout_find(const char *word, enum tl_layout_name *out, tl_error *err)
{
    char known[512] = "";
    size_t length = 0;
    for (int i = 0; i < TL_LAYOUT_COUNT; i++) {
        if (strcmp(words[i], word) == 0) {
            *out = (enum tl_layout_name)i;
            return TL_OK;
        }
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s",
                                   length ? ", " : "", words[i]);
    }
    return tl_fail(err, TL_ERR_ARGUMENT, "no layout is called \"%.64s\": there are %s", word,
                   known);
}

uint32_t tl_layout_planes(enum tl_layout_name layout)
{
    const tl_layout *l = &tl_layouts[layout];
    uint32_t planes = TL_GROUP_BASE;
    if (l->specular.code && l->shininess.code)
        planes |= TL_GROUP_PHONG;
    if (l->metallic.code && l->roughness.code)
        planes |= TL_GROUP_METAL_ROUGH;
    if (l->occlusion.code)
        planes |= TL_GROUP_OCCLUSION;
    if (l->emissive.code)
        planes |= TL_GROUP_EMISSIVE;
    if (l->brdf.code)
        planes |= TL_GROUP_BRDF;
    if (l->tangent.code)
        planes |= TL_GROUP_TANGENT;
    return planes;
}

uint32_t tl_layout_planes_of(enum tl_layout_name layout, uint32_t wanted)
{
    const tl_layout *l = &tl_layouts[layout];
    const tl_channel index = l->brdf.channels[0], color = l->specular.channels[0];
    uint32_t planes = wanted & tl_layout_planes(layout);
    if ((planes & TL_GROUP_BRDF) && l->specular.code && index.word == color.word &&
        index.shift == color.shift)
        planes &= ~TL_THREE(TL_SPECULAR_R);
    if (!(planes & (TL_THREE(TL_SPECULAR_R) | TL_GROUP_BRDF)))
        planes &= ~TL_HAS(TL_SHININESS);
    return planes;
}

tl_status tl_layout_suits(const tl_camera *camera, enum tl_layout_name layout, tl_error *err)
{
    const bool parallel = camera->projection == TL_ORTHOGRAPHIC;
    tl_frame frame = {.tile_size = 0};
    tl_view_set(camera, layout, &frame);
    if (isfinite(frame.depth_slope) && isfinite(frame.depth_offset))
        return TL_OK;
    if (isinf(camera->far))
        return tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "the depth of layout %s is a share of the way to the far plane, and this %s"
            "camera's is infinitely far: choose a layout that stores metres, as float or "
            "compact-16 do",
            words[layout], parallel ? "orthographic " : "");
    return tl_fail(
        err, TL_ERR_UNSUPPORTED,
        "the depth of layout %s cannot be told from numbers between a near plane at %g "
        "m and a far plane at %g m: choose a layout that stores metres, as float or "
        "compact-16 do",
        words[layout], (double)camera->near, (double)camera->far);
}

const char *tl_dropped_name(size_t group, uint32_t dropped)
{
    const uint32_t planes = tl_plane_groups[group].planes;
    return planes == TL_GROUP_PHONG && !(dropped & TL_HAS(TL_SHININESS))
               ? "specular"
               : tl_plane_groups[group].name;
}

void tl_layout_tell_dropped(enum tl_layout_name layout,
                            const char *file,
                            uint32_t dropped,
                            const tl_notices *notices)
{
    char list[128] = "";
    size_t length = 0;
    for (size_t i = 0; i < TL_PLANE_GROUP_COUNT; i++)
        if (dropped & tl_plane_groups[i].planes)
            length += (size_t)snprintf(list + length, sizeof list - length, "%s%s",
                                       length ? ", " : "", tl_dropped_name(i, dropped));
    if (length > 0)
        tl_notice(notices, "%s: dropped, for want of a place in layout %s: %s", file,
                  words[layout], list);
}
