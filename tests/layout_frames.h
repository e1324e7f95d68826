/* Frames whose pixels are hard to pack: cameras, depths, normals, colours, exponents and emission at the
 * ends, edges and half steps of every format, among random ones. */
#ifndef TL_LAYOUT_FRAMES_H
#define TL_LAYOUT_FRAMES_H

#include "frames.h"

#include "tilelight/layouts.h"

enum { HARD_COLUMNS = 64, HARD_ROWS = 40, HARD_PIXELS = HARD_COLUMNS * HARD_ROWS };

/* vertical_fov in rad; shift: of the image's centre, in its halves; eye, in m along every world axis. */
static const struct hard_camera {
    const char *name;
    tl_projection projection;
    double vertical_fov, shift, eye;
    float near, far;
    int turned;
} hard_cameras[] = {
    {"far/near 1e4, view is world", TL_PERSPECTIVE, 1.0, 0.0, 0.0, 0.1f, 1e3f, 0},
    {"far/near 1e7", TL_PERSPECTIVE, 1.2, 0.0, 3.0, 1e-2f, 1e5f, 1},
    {"far/near 1 + 1e-3", TL_PERSPECTIVE, 0.5, 0.0, -40.0, 10.0f, 10.01f, 1},
    {"infinite far plane", TL_PERSPECTIVE, 1.2, 0.0, 1.0, 0.1f, INFINITY, 1},
    {"off centre", TL_PERSPECTIVE, 1.0, 2.5, 3.0, 0.5f, 500.0f, 1},
    {"0.01 degree", TL_PERSPECTIVE, 1.7453292519943295e-4, 0.0, 3.0, 100.0f, 1e4f, 1},
    {"170 degrees", TL_PERSPECTIVE, 2.9670597283903604, 0.0, 3.0, 0.01f, 1e3f, 1},
    {"far from the origin", TL_PERSPECTIVE, 1.0, 0.0, 3e4, 0.1f, 1e3f, 1},
    {"orthographic", TL_ORTHOGRAPHIC, 1.0, 0.0, 3.0, 0.1f, 100.0f, 1},
    {"orthographic, near behind the eye", TL_ORTHOGRAPHIC, 1.0, 0.5, 3.0, -50.0f, 50.0f, 1},
};

static inline tl_camera hard_camera(size_t i)
{
    const struct hard_camera *h = &hard_cameras[i];
    const double eye[3] = {h->eye, h->eye, h->eye}, up[3] = {0.1, 1.0, 0.2};
    const double target[3] = {h->eye - 0.5, h->eye - 0.2, h->eye - 4.0};
    const double ahead[3] = {h->eye, h->eye, h->eye - 1.0}, straight[3] = {0, 1, 0};
    tl_camera camera = tl_camera_look_at(
        eye, h->turned ? target : ahead, h->turned ? up : straight, h->vertical_fov,
        HARD_COLUMNS, HARD_ROWS, fabs((double)h->near), (double)h->far);
    const float right = (float)h->shift * camera.right, top = (float)h->shift * camera.top;
    camera.projection = h->projection;
    camera.near = h->near;
    camera.left += right;
    camera.right += right;
    camera.bottom += top;
    camera.top += top;
    return camera;
}

/* The deepest surface of a frame: so deep where there is no far plane. */
static inline float deepest_of(const tl_camera *camera)
{
    return isinf(camera->far) ? 1e6f * camera->near : camera->far;
}

/* Pixel i. Sky is one of nine; both planes and their neighbours; else all octaves alike. */
static inline float hard_depth(const tl_camera *camera, uint32_t i, uint32_t *seed)
{
    const float near = camera->near, far = deepest_of(camera);
    const float share = uniform(seed, 0.0f, 1.0f);
    const float linear = near + share * (far - near);
    const float some = camera->projection == TL_ORTHOGRAPHIC || i % 2
                           ? linear
                           : near * powf(far / near, share);
    const float cases[] = {INFINITY,
                           near,
                           nextafterf(near, far),
                           far,
                           nextafterf(far, near),
                           near + (far - near) * 0x1p-20f,
                           far - (far - near) * 0x1p-20f};
    const float depth = i % 9 < COUNT_OF(cases) ? cases[i % 9] : some;
    return isinf(depth) ? depth : fminf(fmaxf(depth, near), far);
}

/* Directions where the codes of normals change sign, fold or end; each is also mirrored and turned. */
static const float hard_normals[][3] = {
    {0, 0, 1},           {1, 1, 1},         {1, 1, 0},
    {0.5f, 0.5f, 1e-7f}, {0.25f, 0.75f, 0}, {3, 1, 1e-30f},
    {1, 1e-7f, 0},       {1, 1e-7f, 1e-7f}, {1, 0x1p-24f, 0},
    {1, 1e-20f, 1e-3f},  {1, 1e-3f, 1e-3f}, {1, 1, 0x1.fffffep-1f},
    {1, 0x1p-12f, 0},    {1, 0x1p-11f, 0},  {0.6f, 0.8f, 0},
    {2, 3, 6},           {1e-2f, 0, 1},     {1e-4f, 1e-4f, 1},
    {1e-3f, 2e-3f, 1},   {0.03f, 0.01f, 1}, {0.0392f, 0.0039f, 1},
    {1, 0.5f, 0.25f},    {127, 1, 0.5f},    {1, 2, 0.001f},
};

/* Sign and order of the components from the bits of `which`; lengths from 1e-17 to 1e17. */
static inline void hard_normal(uint32_t i, uint32_t *seed, float out[3])
{
    static const float lengths[] = {1.0f, 1.0f, 1e-17f, 1e17f, 0.3f, 2.0f, 1.0f};
    const float *n = hard_normals[i % COUNT_OF(hard_normals)];
    const uint32_t which = i / COUNT_OF(hard_normals);
    const float random[3] = {uniform(seed, -1.0f, 1.0f), uniform(seed, -1.0f, 1.0f),
                             uniform(seed, -1.0f, 1.0f)};
    const int is_random = i % 5 == 4;
    const double x = (double)(is_random ? random[0] : n[0]),
                 y = (double)(is_random ? random[1] : n[1]),
                 z = (double)(is_random ? random[2] : n[2]);
    const double k = (double)lengths[i % COUNT_OF(lengths)] / sqrt(x * x + y * y + z * z);
    for (uint32_t axis = 0; axis < 3; axis++) {
        const uint32_t from = (axis + which / 8) % 3;
        const double value = from == 0 ? x : from == 1 ? y : z;
        out[axis] = (float)(value * k) * (is_random || !(which >> axis & 1u) ? 1.0f : -1.0f);
    }
    if (i % 23 == 0)
        out[0] = out[1] = out[2] = 0.0f;
}

/* Both ends, and steps and half steps of 8 and 16 bits and of the squares of 8. */
static inline float hard_share(uint32_t i, uint32_t *seed)
{
    const float k = (float)(i % 255), share = uniform(seed, 0.0f, 1.0f);
    const float cases[] = {0.0f,
                           1.0f,
                           k / 255.0f,
                           (k + 0.5f) / 255.0f,
                           nextafterf((k + 0.5f) / 255.0f, 0.0f),
                           (k + 0.5f) / 255.0f * ((k + 0.5f) / 255.0f),
                           (k * 257.0f + 0.5f) / 65535.0f,
                           nextafterf(1.0f, 0.0f),
                           1e-12f,
                           share};
    return i % 13 < COUNT_OF(cases) ? cases[i % 13] : share;
}

static inline float hard_exponent(uint32_t i, uint32_t *seed)
{
    const double t = ((double)(i % 255) + 0.5) / 255.0;
    const float cases[] = {0.0f,
                           1.0f,
                           10000.0f,
                           nextafterf(10000.0f, 0.0f),
                           1e-6f,
                           8193.0f,
                           (float)(pow(10001.0, t) - 1.0),
                           uniform(seed, 0.0f, 10000.0f)};
    return i % 11 < COUNT_OF(cases) ? cases[i % 11] : powf(10000.0f, uniform(seed, 0.0f, 1.0f));
}

static inline float hard_emission(uint32_t i, uint32_t *seed)
{
    const float cases[] = {0.0f,     1.0f,        0x1p-25f, 0x1p-24f, 3e-8f,
                           65408.0f, 65504.0f,    1e30f,    511.5f,   511.4f,
                           1023.9f,  0x1.ffcp15f, 0.5f,     2e5f,     nextafterf(2.0f, 0.0f)};
    return i % 19 < COUNT_OF(cases) ? cases[i % 19] : powf(10.0f, uniform(seed, -9.0f, 5.0f));
}

/* The caller destroys it. */
static inline tl_gbuffer *hard_layout_frame(const tl_camera *camera,
                                            uint32_t present,
                                            uint32_t seed)
{
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(camera, present, &g, &err), err);
    for (uint32_t i = 0; i < HARD_PIXELS; i++) {
        const size_t at = (size_t)(i / HARD_COLUMNS) * g->pitch + i % HARD_COLUMNS;
        const float depth = hard_depth(camera, i, &seed);
        float normal[3];
        if (isinf(depth))
            continue;
        set_pixel(g, TL_DEPTH, at, depth);
        hard_normal(i, &seed, normal);
        for (int axis = 0; axis < 3; axis++)
            set_pixel(g, (enum tl_plane)(TL_NORMAL_X + axis), at, normal[axis]);
        for (uint32_t p = TL_ALBEDO_R; p < TL_BRDF; p++)
            set_pixel(g, (enum tl_plane)p, at, hard_share(i / 3 * 5 + p * 7, &seed));
        set_pixel(g, TL_SHININESS, at, hard_exponent(i, &seed));
        for (uint32_t p = TL_EMISSIVE_R; p <= TL_EMISSIVE_B; p++)
            set_pixel(g, (enum tl_plane)p, at, hard_emission(i / 2 + p * 5, &seed));
        set_pixel(g, TL_BRDF, at, (float)(i % 256));
        if (!(present & TL_GROUP_TANGENT))
            continue;
        hard_normal(i + 5, &seed, normal);
        for (int axis = 0; axis < 3 && i % 7 != 0; axis++) /* the others have none */
            set_pixel(g, (enum tl_plane)(TL_TANGENT_X + axis), at, normal[axis]);
    }
    return g;
}

#endif
