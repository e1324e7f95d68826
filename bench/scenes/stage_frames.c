#include "stage_frames.h"

#include "aovs.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* Shadow maps are empty, and profiles alike in all directions: each pixel looks up all that it would, and
 * finds all of the light. Links keep lights from every other pixel, by turns of 8 x 8. */
typedef struct stage_row {
    const char *name, *meaning;
    const char *frame; /* of the frames of effects */
    /* lights of the frame, from its first on, that get a map, a profile alike in all directions, a link */
    uint32_t map_count, profile_count, link_count;
    uint32_t map_size;      /* texels each way */
    float occlusion_radius; /* m; 0: ambient light is not kept from anything */
    float sky_light;        /* 0: the sky is background alone */
    uint32_t split;         /* tl_lighting_options.split */
    uint32_t group_count;   /* tl_frame_side.group_count */
    int is_part;            /* 1: the middle of the picture alone, half as wide and high */
} stage_row;

static const stage_row stages[] = {
    {"shadows", "of a sun, in a map of 2048 texels each way", "sun", .map_count = 1,
     .map_size = 2048},
    {"shadows", "of 16 of 1024 lamps, in six maps of 256 each", "gloss", .map_count = 16,
     .map_size = 256},
    {"shadows", "of all of 1024 lamps, in six maps of 64 each", "gloss", .map_count = 1024,
     .map_size = 64},
    {"profiles", "of 16 of 1024 lamps", "gloss", .profile_count = 16},
    {"profiles", "of all of 1024 lamps", "gloss", .profile_count = 1024},
    {"links", "of 16 of 1024 lamps to half of the pixels", "gloss", .link_count = 16},
    {"links", "of all of 1024 lamps to half of the pixels", "gloss", .link_count = 1024},
    {"ambient-occlusion", "within half a metre, in 64 looks a pixel", "spots",
     .occlusion_radius = 0.5f},
    {"sky-light", "of a gradient, diffuse and mirrored", "gloss", .sky_light = 1.0f},
    {"layers", "all terms of the light, written beside the picture", "all",
     .split = TL_ALL_AOVS},
    {"light-groups", "two, of half of 1024 lamps each, beside the picture", "gloss",
     .group_count = 2},
    {"light-groups", "eight of 128 lamps each, beside the picture", "gloss", .group_count = 8},
    {"regions", "the middle quarter of the picture", "gloss", .is_part = 1},
};
const int tl_stage_count = sizeof stages / sizeof stages[0];

tl_effect_frame_row tl_stage_about(int index)
{
    return (tl_effect_frame_row){stages[index].name, stages[index].meaning};
}

int tl_stage_keeps_bits(int index)
{
    const stage_row *of = &stages[index];
    return !(of->occlusion_radius > 0.0f) && !(of->sky_light > 0.0f) && of->link_count == 0;
}

uint32_t tl_stage_split(int index)
{
    return stages[index].split;
}

uint32_t tl_stage_group_count(int index)
{
    return stages[index].group_count;
}

static int frame_named(const char *name)
{
    int i = 0;
    while (strcmp(tl_effect_frame_about(i).name, name) != 0)
        i++;
    return i;
}

/* As large as all that the frame may show, m. */
static const double far_away = 1e3;

static tl_status add_map(tl_gbuffer *g, const tl_light *light, uint32_t size, tl_error *err)
{
    const int is_sun = light->type == TL_LIGHT_DIRECTIONAL;
    tl_shadow_map map = {.kind = is_sun ? TL_SHADOW_PARALLEL : TL_SHADOW_CUBE, .size = size};
    double around[2][3];
    for (int i = 0; i < 3; i++) {
        around[0][i] = -far_away;
        around[1][i] = far_away;
        map.position[i] = is_sun ? 0.0f : light->position[i];
        map.direction[i] = is_sun ? light->direction[i] : 0.0f;
    }
    if (is_sun)
        tl_shadow_view_along(&map, (const double(*)[3])around, (const double(*)[3])around);
    else
        tl_shadow_views_from(&map, NULL, 0.0, 1e-2);
    return tl_shadow_maps_add(&g->shadows, &map, err);
}

static tl_status cast_shadows(const stage_row *of,
                              tl_effect_frame *without,
                              tl_effect_frame *with,
                              tl_error *err)
{
    tl_status status = TL_OK;
    for (uint32_t i = 0; i < of->map_count && i < with->lights.count; i++) {
        with->lights.lights[i].casts_shadow = 1;
        TRY(add_map(without->gbuffer, &with->lights.lights[i], of->map_size, err));
    }
done:
    return status;
}

static tl_status add_profile(tl_light_set *lights, uint32_t *number, tl_error *err)
{
    tl_light_profile alike = {.columns = 24, .rows = 37, .rows_of_half_turn = 36, .peak = 1.0};
    const size_t count = (size_t)alike.columns * alike.rows;
    alike.shares = malloc(count * sizeof *alike.shares);
    if (!alike.shares)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a profile");
    for (size_t i = 0; i < count; i++)
        alike.shares[i] = 1.0f;
    return tl_light_set_add_profile(lights, "alike", &alike, number, err);
}

static tl_status give_profiles(const stage_row *of, tl_effect_frame *with, tl_error *err)
{
    tl_status status = TL_OK;
    uint32_t number = 0;
    if (of->profile_count > 0)
        TRY(add_profile(&with->lights, &number, err));
    for (uint32_t i = 0; i < of->profile_count && i < with->lights.count; i++)
        with->lights.lights[i].profile = number;
done:
    return status;
}

/* Two objects, on squares of 8 x 8 pixels by turns. */
static tl_status add_objects(tl_gbuffer *g, tl_error *err)
{
    const tl_status status = tl_ids_add(g, err);
    for (uint32_t y = 0; status == TL_OK && y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++)
            g->ids[(size_t)y * g->pitch + x] = 1 + (x / 8 + y / 8) % 2;
    return status;
}

static tl_status link_lights(const stage_row *of,
                             tl_effect_frame *without,
                             tl_effect_frame *with,
                             tl_error *err)
{
    tl_link_object second = {.id = 2};
    const tl_light_link link = {.except = 1, .count = 1, .of = &second};
    tl_status status = TL_OK;
    uint32_t number = 0;
    if (of->link_count == 0)
        return TL_OK;
    TRY(add_objects(without->gbuffer, err));
    TRY(tl_light_set_add_link(&with->lights, &link, &number, err));
    for (uint32_t i = 0; i < of->link_count && i < with->lights.count; i++)
        with->lights.lights[i].link = number;
done:
    return status;
}

/* A G-buffer of its own, of the middle of the other's picture. */
static tl_status cut_middle(int frame,
                            const tl_effect_frame *without,
                            tl_effect_frame *with,
                            tl_error *err)
{
    const tl_camera *whole = &without->gbuffer->camera;
    const tl_region middle = {whole->width / 4, whole->height / 4, (whole->width + 1) / 2,
                              (whole->height + 1) / 2};
    tl_effect_frame again = {0};
    tl_status status = TL_OK;
    TRY(tl_effect_frame_make(frame, whole->width, whole->height, &again, err));
    TRY(tl_gbuffer_cut(&again.gbuffer, &middle, err));
    with->gbuffer = again.gbuffer;
    with->borrows = 0;
    again.gbuffer = NULL;
done:
    tl_effect_frame_clear(&again);
    return status;
}

static void paint_sky(tl_light_set *lights)
{
    static const float zenith[3] = {0.1f, 0.2f, 0.6f}, level[3] = {0.7f, 0.7f, 0.7f},
                       ground[3] = {0.2f, 0.15f, 0.1f};
    lights->sky_type = TL_SKY_GRADIENT;
    memcpy(lights->zenith, zenith, sizeof zenith);
    memcpy(lights->sky, level, sizeof level);
    memcpy(lights->ground, ground, sizeof ground);
}

tl_status tl_stage_make(int index,
                        uint32_t width,
                        uint32_t height,
                        tl_effect_frame *without,
                        tl_effect_frame *with,
                        tl_error *err)
{
    const stage_row *of = &stages[index];
    tl_status status = TL_OK;
    TRY(tl_effect_frame_make(frame_named(of->frame), width, height, without, err));
    TRY(tl_effect_frame_alike(without, with, err));
    if (of->sky_light > 0.0f) {
        paint_sky(&without->lights);
        paint_sky(&with->lights);
    }
    with->lights.sky_light = of->sky_light;
    TRY(cast_shadows(of, without, with, err));
    TRY(give_profiles(of, with, err));
    TRY(link_lights(of, without, with, err));
    if (of->is_part)
        TRY(cut_middle(frame_named(of->frame), without, with, err));
    with->lights.occlusion_radius = of->occlusion_radius;
done:
    if (status != TL_OK) {
        tl_effect_frame_clear(with);
        tl_effect_frame_clear(without);
    }
    return status;
}
