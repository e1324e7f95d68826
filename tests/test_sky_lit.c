/* Is a frame that the sky lights the same by every width, path and the twin, within what check allows, and
 * right pixel by pixel against integrals over the map? Do only frames pay for it that ask for it? */
#include "frames.h"
#include "oracle/sky.h"
#include "prepared.h"
#include "sky_light.h"
#include "sky_prefilter.h"
#include "split_sum.h"

#include "tilelight/check.h"

#include <string.h>

enum { WIDTH = 16, HEIGHT = 8 };

static float texel_of(int x, int y)
{
    return (y < HEIGHT / 2 ? 0.75f : 0.25f) + (x == 11 && y == 2 ? 6.0f : 0.0f) +
           0.05f * (float)(x % 5);
}

/* A map with a bright texel right of the middle and above; red once, green twice, blue half of it. */
static tl_light_set sky_set(float light, float rotation)
{
    static const float scales[3] = {1.0f, 2.0f, 0.5f};
    tl_light_set set = {.sky_type = TL_SKY_IMAGE,
                        .sky_intensity = 1.5f,
                        .sky_light = light,
                        .sky_rotation = rotation,
                        .model = TL_MODEL_METAL_ROUGH};
    tl_error err;
    float *pixels = malloc(3 * sizeof(float) * WIDTH * HEIGHT);
    assert_non_null(pixels);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++)
                pixels[3 * (y * WIDTH + x) + c] = texel_of(x, y) * scales[c];
    ASSERT_OK(tl_light_set_add_image(&set, "sky", WIDTH, HEIGHT, pixels, &set.sky_image, &err),
              err);
    return set;
}

static const uint32_t metal_rough =
    TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE;
static const uint32_t phong = TL_GROUP_BASE | TL_GROUP_PHONG;

static tl_gbuffer *frame_of(uint32_t present)
{
    const tl_camera camera = camera_of(70, 45, TL_PERSPECTIVE);
    tl_error err;
    tl_gbuffer *g = random_gbuffer(&camera, present, 7);
    ASSERT_OK(tl_gbuffer_repair(g, "frame", false, NULL, &err), err);
    return g;
}

static tl_image *lit(tl_device *device,
                     const tl_gbuffer *g,
                     const tl_light_set *set,
                     const tl_lighting_options *options)
{
    tl_image *image = image_like(g);
    light_frame(device, options, g, set, image);
    return image;
}

static tl_image *lit_by_twin(const tl_gbuffer *g, const tl_light_set *set)
{
    tl_lighting_options options = tl_lighting_options_default();
    options.precision = TL_PRECISION_TWIN;
    return lit(NULL, g, set, &options);
}

static const struct {
    const char *name;
    uint32_t present;
    enum tl_shading_model model;
    tl_path path;
    uint32_t width;
} ways[] = {
    {"metal-rough", metal_rough, TL_MODEL_METAL_ROUGH, TL_PATH_CPU, 0},
    {"metal-rough, a pixel an item", metal_rough, TL_MODEL_METAL_ROUGH, TL_PATH_GPU, 1},
    {"phong", phong, TL_MODEL_PHONG, TL_PATH_CPU, 0},
};

/* And within what is derived; a sky that is brighter by a ten-thousandth is not. */
static void every_way_has_the_same_bits(void **state)
{
    for (size_t i = 0; i < COUNT_OF(ways); i++) {
        tl_light_set set = sky_set(0.8f, 0.7f);
        tl_gbuffer *g = frame_of(ways[i].present);
        tl_lighting_options options = tl_lighting_options_default();
        tl_check *check = NULL;
        tl_check_report report;
        tl_error err;
        set.model = ways[i].model;
        options.path = ways[i].path;
        options.vector_width = ways[i].width;
        tl_image *want = lit_by_twin(g, &set), *got = lit(*state, g, &set, &options);
        assert_same_image(got, want, ways[i].name);
        ASSERT_OK(tl_check_create(g, &set, 0.0f, TL_COSINE_STABLE, &check, &err), err);
        ASSERT_OK(tl_check_image(check, got, NULL, &report, &err), err);
        print_message("%s: largest of what is allowed: %.3f\n", ways[i].name,
                      report.worst.ratio);
        assert_int_equal(report.failed_count, 0);
        set.sky_light *= 1.0001f;
        tl_image *brighter = lit_by_twin(g, &set);
        ASSERT_OK(tl_check_image(check, brighter, NULL, &report, &err), err);
        assert_true(report.failed_count > 1000);
        tl_check_destroy(check);
        tl_image_destroy(brighter);
        tl_image_destroy(got);
        tl_image_destroy(want);
        tl_gbuffer_destroy(g);
        tl_light_set_clear(&set);
    }
}

static tl_prepared prepared_of(const tl_gbuffer *g, const tl_light_set *lights)
{
    tl_prepared p = {.memory_size = 0};
    tl_error err;
    ASSERT_OK(tl_prepare(g, lights, &(tl_prepare_options){.tile_size = 16}, NULL, &p, &err),
              err);
    return p;
}

/* A sky that is background alone, or black, or shines on what reflects nothing; and what mirrors nothing has
 * no levels of it. */
static void only_askers_pay(void **state)
{
    tl_gbuffer *g = frame_of(metal_rough), *plaster = frame_of(TL_GROUP_BASE);
    tl_light_set on = sky_set(0.5f, 0.0f), off = sky_set(0.0f, 0.0f);
    const tl_light_set none = {.model = TL_MODEL_METAL_ROUGH},
                       black = {.model = TL_MODEL_METAL_ROUGH, .sky_light = 1.0f};
    (void)state;
    tl_prepared with = prepared_of(g, &on), without = prepared_of(g, &off),
                plain = prepared_of(g, &none), unlit = prepared_of(g, &black);
    assert_int_equal(with.needs.sky_light, TL_SKY_DIFFUSE | TL_SKY_MIRRORED);
    assert_true(with.frame.sky_light_at > 0);
    assert_int_equal(without.needs.sky_light, 0);
    assert_int_equal(without.needs.ambient, 0);
    assert_int_equal(without.frame.sky_light_at, 0);
    assert_null(without.sky_map);
    assert_memory_equal(&unlit.needs, &plain.needs, sizeof plain.needs);
    assert_memory_equal(&unlit.frame, &plain.frame, sizeof plain.frame);
    assert_int_equal(tl_prepared_buffer_size(&unlit), tl_prepared_buffer_size(&plain));
    const size_t map = sizeof(tl_view_sky) + (size_t)WIDTH * HEIGHT * TL_SECTION_ROW;
    assert_int_equal(without.sections_size, map);
    on.model = TL_MODEL_LAMBERT;
    tl_prepared matt = prepared_of(plaster, &on);
    assert_int_equal(matt.needs.sky_light, TL_SKY_DIFFUSE);
    assert_int_equal(matt.sections_size, map + sizeof(tl_view_sky_light));
    on.model = TL_MODEL_METAL_ROUGH;
    g->is_dark = 1;
    tl_prepared dark = prepared_of(g, &on);
    assert_int_equal(dark.needs.sky_light, 0);
    tl_prepared_clear(&dark);
    tl_prepared_clear(&matt);
    tl_prepared_clear(&unlit);
    tl_prepared_clear(&plain);
    tl_prepared_clear(&without);
    tl_prepared_clear(&with);
    tl_light_set_clear(&on);
    tl_light_set_clear(&off);
    tl_gbuffer_destroy(plaster);
    tl_gbuffer_destroy(g);
}

/* A white matt surface under a sky of one colour has that colour, whatever its normal: nothing of it
 * shows. */
static void white_is_as_bright_as_the_sky(void **state)
{
    static const enum tl_shading_model models[] = {TL_MODEL_LAMBERT, TL_MODEL_PHONG,
                                                   TL_MODEL_MINNAERT};
    tl_gbuffer *g = frame_of(TL_GROUP_BASE);
    (void)state;
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        for (int c = 0; c < 3; c++)
            set_pixel(g, (enum tl_plane)(TL_ALBEDO_R + c), i, 1.0f);
    for (size_t k = 0; k < COUNT_OF(models); k++) {
        const tl_light_set set = {
            .model = models[k], .sky = {0.7f, 0.5f, 3.0f}, .sky_light = 1.0f};
        tl_image *image = lit_by_twin(g, &set);
        for (uint32_t y = 0; y < image->height; y++)
            for (uint32_t x = 0; x < image->width; x++)
                for (unsigned c = 0; c < 3; c++) {
                    const float got = tl_image_plane(image, c)[(size_t)y * image->pitch + x];
                    /* Of the polynomial 20u, and of a normal's length, twice 4.5u. */
                    assert_true(fabsf(got - set.sky[c]) <= set.sky[c] * 32.0f * 0x1p-24f);
                }
        tl_image_destroy(image);
    }
    tl_gbuffer_destroy(g);
}

/* What integrals over the map say of a pixel. */
typedef struct pixel_light {
    double n[3], v[3]; /* right, up, ahead */
    double alpha, f0, f90, diffuse;
    double mirrored, matt; /* radiance of the red channel, without occlusion */
    double within;         /* off by at most */
} pixel_light;

static void turned_to_map(const double world[3], double rotation, double out[3])
{
    out[0] = cos(rotation) * world[0] - sin(rotation) * world[2];
    out[1] = world[1];
    out[2] = -sin(rotation) * world[0] - cos(rotation) * world[2];
}

/* By how much the levels around a direction differ, in the texels around it. */
static double spread_of(const tl_sky_map *map, const double d[3], double alpha)
{
    const double r = (sqrt(alpha) - 0.11891476620784007) / (1.0 - 0.11891476620784007) * 16.0;
    double low = 1e30, high = 0.0;
    for (unsigned level = (unsigned)r; level <= (unsigned)r + 1 && level < TL_SKY_LEVELS;
         level++) {
        const uint32_t size = tl_sky_level_size(level, map->size);
        for (uint32_t i = 0; i < size * size; i++) {
            double at[3], cosine = 0.0;
            tl_sky_cell_direction(i % size + 0.5, i / size + 0.5, size, at);
            for (int k = 0; k < 3; k++)
                cosine += at[k] * d[k];
            if (cosine < 1.0 - 40.0 / (size * size)) /* within some two texels */
                continue;
            const float *texel = map->texels[tl_sky_level_start(level, map->size) +
                                             (i / size + 1) * (size + 2) + i % size + 1];
            low = fmin(low, (double)texel[0]);
            high = fmax(high, (double)texel[0]);
        }
    }
    return high - low;
}

static void integrate(const tl_light_set *set, const tl_sky_map *map, pixel_light *p)
{
    float values[WIDTH * HEIGHT];
    const tl_oracle_sky sky = {WIDTH, HEIGHT, 6, values};
    const double scale = (double)set->sky_intensity * (double)set->sky_light;
    double nv = 0.0, d[3];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        values[i] = texel_of(i % WIDTH, i / WIDTH);
    for (int i = 0; i < 3; i++)
        nv += p->n[i] * p->v[i];
    for (int i = 0; i < 3; i++)
        d[i] = 2.0 * nv * p->n[i] - p->v[i];
    const tl_split_sum shares = tl_split_sum_at(fabs(nv), p->alpha);
    const double reflected = p->f0 * shares.base + (p->f90 - p->f0) * shares.grazing;
    p->matt = scale * p->diffuse * (1.0 - p->f90 * shares.lost) *
              tl_oracle_sky_irradiance(&sky, p->n);
    p->mirrored = scale * reflected * tl_oracle_sky_mirrored(&sky, d, p->alpha);
    /* Harmonics; texels and levels between which is mixed; the table, whose entries are mixed; the oracle. */
    p->within = scale * (p->diffuse * tl_sky_truncation(&map->moments[0]) +
                         reflected * spread_of(map, d, p->alpha)) +
                0.01 * (p->matt + p->mirrored);
}

/* Whole pictures against integrals over the map per pixel, with the map turned and the camera too. */
static void pixels_have_the_light_of_the_map(void **state)
{
    const float rotation = 0.7f;
    tl_light_set set = sky_set(0.8f, rotation);
    tl_gbuffer *g = frame_of(metal_rough);
    tl_sky_map *map = NULL;
    tl_error err;
    double worst = 0.0;
    (void)state;
    for (size_t i = 0; i < (size_t)g->pitch * g->rows; i++)
        for (int c = 0; c < 3; c++)
            set_pixel(g, (enum tl_plane)(TL_EMISSIVE_R + c), i, 0.0f);
    g->neutral |= TL_GROUP_EMISSIVE;
    ASSERT_OK(tl_sky_map_of(&set, true, &map, &err), err);
    tl_image *image = lit_by_twin(g, &set);
    for (uint32_t y = 0; y < image->height; y += 6)
        for (uint32_t x = 0; x < image->width; x += 7) {
            const size_t at = (size_t)y * g->pitch + x;
            const float depth = tl_gbuffer_plane(g, TL_DEPTH)[at];
            pixel_light p;
            double world[3], view[3], eye[3], length = 0.0;
            if (isinf(depth))
                continue;
            for (int i = 0; i < 3; i++)
                world[i] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i))[at];
            turned_to_map(world, (double)rotation, p.n);
            const double across = (double)g->camera.right - (double)g->camera.left,
                         down = (double)g->camera.top - (double)g->camera.bottom;
            view[0] = -((double)g->camera.left + across * (x + 0.5) / g->camera.width);
            view[1] = -((double)g->camera.top - down * (y + 0.5) / g->camera.height);
            view[2] = 1.0;
            tl_camera_world_direction(&g->camera, view, eye);
            for (int i = 0; i < 3; i++)
                length += eye[i] * eye[i];
            for (int i = 0; i < 3; i++)
                eye[i] /= sqrt(length);
            turned_to_map(eye, (double)rotation, p.v);
            const double roughness = (double)tl_gbuffer_plane(g, TL_ROUGHNESS)[at],
                         metallic = (double)tl_gbuffer_plane(g, TL_METALLIC)[at],
                         occlusion = (double)tl_gbuffer_plane(g, TL_OCCLUSION)[at];
            double base[3], most = 0.0;
            for (int c = 0; c < 3; c++) {
                base[c] = (double)tl_gbuffer_plane(g, (enum tl_plane)(TL_ALBEDO_R + c))[at];
                most = fmax(most, 0.04 + metallic * (base[c] - 0.04));
            }
            if (roughness < 0.4)
                continue;
            p.alpha = roughness * roughness;
            p.f0 = 0.04 + metallic * (base[0] - 0.04);
            p.f90 = fmin(1.0, 50.0 * most);
            p.diffuse = base[0] * (1.0 - metallic) * 0.96;
            integrate(&set, map, &p);
            const double nv = p.n[0] * p.v[0] + p.n[1] * p.v[1] + p.n[2] * p.v[2];
            const double share =
                occlusion + (1.0 - p.alpha) * (sqrt(fabs(nv) + occlusion) - 1.0);
            const double want = occlusion * p.matt + fmin(1.0, fmax(0.0, share)) * p.mirrored;
            const double got = (double)tl_image_plane(image, 0)[at];
            worst = fmax(worst, fabs(got - want) / p.within);
            if (!(fabs(got - want) <= p.within))
                fail_msg("pixel (%u, %u): %.6g, want %.6g to within %.3g", x, y, got, want,
                         p.within);
        }
    print_message("largest of what is allowed: %.3f\n", worst);
    tl_image_destroy(image);
    tl_sky_map_release(map);
    tl_gbuffer_destroy(g);
    tl_light_set_clear(&set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_askers_pay),
        cmocka_unit_test(white_is_as_bright_as_the_sky),
        cmocka_unit_test(pixels_have_the_light_of_the_map),
        cmocka_unit_test(every_way_has_the_same_bits),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
