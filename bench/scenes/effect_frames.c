#include "effect_frames.h"

#include "bench_scene.h"
#include "ray_cast.h"
#include "scene_lights.h"
#include "try.h"

#include <math.h>

/* What is in a frame. */
enum {
    SUN = 1,
    LAMPS = 2,     /* 1024 with a range and a linear falloff, 27 on a tile */
    SQUARE = 4,    /* their falloff is inverse-square */
    GLOSS = 8,     /* surfaces have highlights */
    LOBES = 16,    /* and lights */
    SPOTS = 32,    /* half of the lamps */
    FADES = 64,    /* all falloffs by turns, and a lamp without a range */
    AMBIENT = 128, /* ambient light */
    DIRT = 256,    /* occlusion */
    GLOW = 512,    /* emission */
    SKY = 1024,    /* of a colour */
    WALL = 2048    /* no sky in the picture */
};

#define ALL_PLANES (TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE)

static const struct {
    const char *name, *meaning;
    int traits;
} frames[] = {
    {"sun", "a sun, no highlights", SUN},
    {"lamps", "1024 lamps, no highlights", LAMPS},
    {"gloss", "the lamps with highlights", LAMPS | GLOSS | LOBES},
    {"spots", "half of them spots, ambient light and occlusion",
     LAMPS | GLOSS | LOBES | SPOTS | AMBIENT | DIRT},
    {"all", "and a sun, a lamp without a range, all falloffs, emission and a sky",
     SUN | LAMPS | GLOSS | LOBES | SPOTS | FADES | AMBIENT | DIRT | GLOW | SKY},
};
const int tl_effect_frame_count = sizeof frames / sizeof frames[0];

/* What the frame with an unused effect has more than the one without. */
typedef enum addition {
    A_POINT, /* all lights that are added reach no surface, but where the picture shows surfaces */
    A_LINEAR_FROM,
    AN_INVERSE_SQUARE,
    A_SPOT,
    A_LOBE,
    A_BLACK_SUN,
    A_BLACK_LAMP,
    A_SKY,
    CASTERS,
    SOME_PLANES
} addition;

static const struct {
    const char *name, *meaning;
    int traits; /* of both */
    addition more;
    uint32_t planes; /* added, and neutral */
} pairs[] = {
    {"spots", "a spot that no tile lists", LAMPS | GLOSS | LOBES, A_SPOT, 0},
    {"specular", "a lamp with a lobe that no tile lists, among lamps without", LAMPS | GLOSS,
     A_LOBE, 0},
    {"specular", "specular planes that are black", LAMPS | LOBES, SOME_PLANES, TL_GROUP_PHONG},
    {"inverse-square", "one such lamp that no tile lists, among linear ones",
     LAMPS | GLOSS | LOBES, AN_INVERSE_SQUARE, 0},
    {"linear", "one such lamp that no tile lists, among others", LAMPS | GLOSS | LOBES | SQUARE,
     A_POINT, 0},
    {"linear-from", "one such lamp that no tile lists, among linear ones",
     LAMPS | GLOSS | LOBES, A_LINEAR_FROM, 0},
    {"ranged-lights", "a lamp that no tile lists, under a sun", SUN, A_POINT, 0},
    {"global-lights", "a lamp without a range or intensity", LAMPS | GLOSS | LOBES,
     A_BLACK_LAMP, 0},
    {"directional", "a sun without intensity", LAMPS | GLOSS | LOBES, A_BLACK_SUN, 0},
    {"occlusion", "a plane that is 1", LAMPS | AMBIENT, SOME_PLANES, TL_GROUP_OCCLUSION},
    {"emission", "planes that are black", LAMPS, SOME_PLANES, TL_GROUP_EMISSIVE},
    {"shadows", "lamps that cast some, and have no maps", LAMPS | GLOSS | LOBES, CASTERS, 0},
    {"sky", "a colour that no pixel shows", LAMPS | WALL, A_SKY, 0},
};
const int tl_unused_effect_count = sizeof pairs / sizeof pairs[0];

tl_effect_frame_row tl_effect_frame_about(int index)
{
    return (tl_effect_frame_row){frames[index].name, frames[index].meaning};
}

tl_effect_frame_row tl_unused_effect_about(int index)
{
    return (tl_effect_frame_row){pairs[index].name, pairs[index].meaning};
}

void tl_effect_frame_clear(tl_effect_frame *frame)
{
    if (!frame->borrows)
        tl_gbuffer_destroy(frame->gbuffer);
    tl_light_set_clear(&frame->lights);
    *frame = (tl_effect_frame){0};
}

/* The planes become what they are where they are absent. */
static void make_neutral(tl_gbuffer *g, uint32_t planes)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++) {
        float *values = tl_gbuffer_plane(g, (enum tl_plane)p);
        if (values && (planes >> p & 1u))
            for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
                values[i] = p == TL_OCCLUSION ? 1.0f : 0.0f;
    }
}

static tl_status make_surfaces(int traits,
                               uint32_t present,
                               uint32_t neutral,
                               uint32_t width,
                               uint32_t height,
                               tl_gbuffer **out,
                               tl_error *err)
{
    const tl_bench_scene *scene = tl_bench_scene_find(traits & WALL ? "wall" : "spheres");
    tl_status status = TL_OK;
    neutral |= (traits & GLOSS ? 0 : TL_GROUP_PHONG) |
               (traits & DIRT ? 0 : TL_GROUP_OCCLUSION) |
               (traits & GLOW ? 0 : TL_GROUP_EMISSIVE);
    TRY(tl_ray_cast(scene, present, width, height, out, err));
    make_neutral(*out, neutral);
    TRY(tl_gbuffer_repair(*out, scene->name, false, NULL, err));
done:
    return status;
}

static tl_light sun(void)
{
    tl_light light = tl_light_default();
    const float direction[3] = {0.36f, -0.8f, -0.48f};
    light.type = TL_LIGHT_DIRECTIONAL;
    for (int i = 0; i < 3; i++)
        light.direction[i] = direction[i];
    return light;
}

/* Half of the lamps look down; their falloffs go round. */
static void dress_lamp(tl_light *lamp, size_t i, int traits)
{
    const int turn = traits & FADES ? (int)(i % 3) : 0;
    lamp->specular = traits & LOBES ? 1.0f : 0.0f;
    if ((traits & SQUARE) || turn == 1) {
        lamp->falloff = TL_FALLOFF_INVERSE_SQUARE;
        lamp->intensity *= 0.1f * lamp->range * lamp->range;
    }
    if (turn == 2)
        lamp->begin = 0.5f * lamp->range;
    if ((traits & SPOTS) && i % 2 == 0) {
        lamp->type = TL_LIGHT_SPOT;
        lamp->direction[1] = -1.0f;
        lamp->direction[0] = lamp->direction[2] = 0.0f;
        lamp->inner_cone = 0.5f;
        lamp->outer_cone = 1.0f;
    }
}

static tl_status make_lights(const tl_gbuffer *g,
                             int traits,
                             tl_light_set *lights,
                             tl_error *err)
{
    tl_bench_scene_options scattered = tl_bench_scene_options_default();
    tl_light from_above = sun(), far_off = tl_light_default();
    tl_status status = TL_OK;
    from_above.specular = far_off.specular = traits & LOBES ? 1.0f : 0.0f;
    far_off.position[1] = 12.0f;
    far_off.intensity = 10.0f;
    if (traits & LAMPS)
        TRY(tl_scene_lights(g, &scattered, lights, err));
    for (size_t i = 0; i < lights->count; i++)
        dress_lamp(&lights->lights[i], i, traits);
    if (traits & SUN)
        TRY(tl_light_set_add(lights, &from_above, err));
    if (traits & FADES)
        TRY(tl_light_set_add(lights, &far_off, err));
    for (int i = 0; i < 3; i++) {
        lights->ambient[i] = traits & AMBIENT ? 0.05f : 0.0f;
        lights->sky[i] = traits & SKY ? 0.2f * (float)(i + 1) : 0.0f;
    }
done:
    return status;
}

static tl_status make(int traits,
                      uint32_t present,
                      uint32_t neutral,
                      uint32_t width,
                      uint32_t height,
                      tl_effect_frame *out,
                      tl_error *err)
{
    tl_effect_frame made = {0};
    tl_status status = TL_OK;
    TRY(make_surfaces(traits, present, neutral, width, height, &made.gbuffer, err));
    TRY(make_lights(made.gbuffer, traits, &made.lights, err));
    *out = made;
    made = (tl_effect_frame){0};
done:
    tl_effect_frame_clear(&made);
    return status;
}

tl_status tl_effect_frame_make(
    int index, uint32_t width, uint32_t height, tl_effect_frame *out, tl_error *err)
{
    return make(frames[index].traits, ALL_PLANES, 0, width, height, out, err);
}

/* A metre before the eye, two metres before all surfaces. */
static tl_light lamp_in_the_air(void)
{
    tl_light lamp = tl_light_default();
    lamp.position[1] = 1.5f;
    lamp.position[2] = -1.0f;
    lamp.range = 0.2f;
    lamp.falloff = TL_FALLOFF_LINEAR;
    lamp.specular = 0.0f;
    return lamp;
}

static tl_status add_unused(addition more, tl_light_set *lights, tl_error *err)
{
    tl_light light = lamp_in_the_air();
    switch (more) {
    case A_POINT: break;
    case A_LINEAR_FROM: light.begin = 0.1f; break;
    case AN_INVERSE_SQUARE: light.falloff = TL_FALLOFF_INVERSE_SQUARE; break;
    case A_SPOT:
        light.type = TL_LIGHT_SPOT;
        light.direction[1] = -1.0f;
        break;
    case A_LOBE: light.specular = 1.0f; break;
    case A_BLACK_SUN:
        light = sun();
        light.intensity = 0.0f;
        break;
    case A_BLACK_LAMP:
        light.falloff = TL_FALLOFF_INVERSE_SQUARE;
        light.range = INFINITY;
        light.intensity = 0.0f;
        break;
    case CASTERS:
        for (size_t i = 0; i < lights->count; i++)
            lights->lights[i].casts_shadow = 1;
        return TL_OK;
    case A_SKY: lights->sky[0] = lights->sky[1] = lights->sky[2] = 1.0f; return TL_OK;
    case SOME_PLANES: return TL_OK;
    }
    return tl_light_set_add(lights, &light, err);
}

static tl_status copy_lights(const tl_light_set *from, tl_light_set *to, tl_error *err)
{
    tl_status status = TL_OK;
    for (int i = 0; i < 3; i++) {
        to->ambient[i] = from->ambient[i];
        to->sky[i] = from->sky[i];
    }
    for (size_t i = 0; i < from->count; i++)
        TRY(tl_light_set_add(to, &from->lights[i], err));
done:
    return status;
}

tl_status tl_effect_frame_alike(const tl_effect_frame *frame,
                                tl_effect_frame *to,
                                tl_error *err)
{
    to->gbuffer = frame->gbuffer;
    to->borrows = 1;
    return copy_lights(&frame->lights, &to->lights, err);
}

tl_status tl_unused_effect_make(int index,
                                uint32_t width,
                                uint32_t height,
                                tl_effect_frame *without,
                                tl_effect_frame *with,
                                tl_error *err)
{
    const int traits = pairs[index].traits;
    const uint32_t more = pairs[index].planes;
    const uint32_t present = TL_GROUP_BASE | (traits & GLOSS ? TL_GROUP_PHONG : 0);
    tl_status status = TL_OK;
    TRY(make(traits, present, 0, width, height, without, err));
    TRY(tl_effect_frame_alike(without, with, err));
    if (more) {
        with->borrows = 0;
        with->gbuffer = NULL;
        TRY(make_surfaces(traits, present | more, more, width, height, &with->gbuffer, err));
    }
    TRY(add_unused(pairs[index].more, &with->lights, err));
done:
    if (status != TL_OK) {
        tl_effect_frame_clear(with);
        tl_effect_frame_clear(without);
    }
    return status;
}
