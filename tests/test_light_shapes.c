/* Is what a falloff table, a texture, an ambient lobe and a sky give what docs/conventions.md says of them?
 *
 * Expected values are worked out here, in double, from the words of that page: no header of kernels/. */
#include "frames.h"

enum { SIDE = 24 };
static const double pi = 3.14159265358979323846;

/* The eye at the origin, along -z, a wall at z = -2 over all of the picture, white, facing the eye. */
static tl_gbuffer *white_wall(uint32_t present)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1}, up[3] = {0, 1, 0};
    const tl_camera camera = tl_camera_look_at(eye, target, up, 1.6, SIDE, SIDE, 0.1, 100.0);
    tl_gbuffer *g = NULL;
    tl_error err;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE | present, &g, &err), err);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            set_pixel(g, TL_DEPTH, at, 2.0f);
            set_pixel(g, TL_NORMAL_Z, at, 1.0f);
            set_pixel(g, TL_OCCLUSION, at, 0.5f);
            for (int c = 0; c < 3; c++)
                set_pixel(g, (enum tl_plane)(TL_ALBEDO_R + c), at, c == 1 ? 0.5f : 1.0f);
        }
    return g;
}

/* Of the ray through pixel (x, y), at depth 1. */
static void ray_of(const tl_gbuffer *g, uint32_t x, uint32_t y, double out[3])
{
    const tl_camera *c = &g->camera;
    out[0] = (double)c->left + (x + 0.5) / SIDE * ((double)c->right - (double)c->left);
    out[1] = (double)c->top - (y + 0.5) / SIDE * ((double)c->top - (double)c->bottom);
    out[2] = -1.0;
}

/* Each pixel has numbers of its own. The caller's set owns them. */
static uint32_t add_picture(tl_light_set *set, uint32_t width, uint32_t height)
{
    float *pixels = malloc(3 * (size_t)width * height * sizeof *pixels);
    uint32_t image = 0, seed = 42;
    tl_error err;
    assert_non_null(pixels);
    for (size_t i = 0; i < 3 * (size_t)width * height; i++)
        pixels[i] = uniform(&seed, 0.0f, 1.0f);
    ASSERT_OK(tl_light_set_add_image(set, "picture", width, height, pixels, &image, &err), err);
    return image;
}

static double texel(const tl_light_image *image, long x, long y, int channel, int around)
{
    const long w = (long)image->width, h = (long)image->height;
    x = around ? ((x % w) + w) % w : x < 0 ? 0 : x < w ? x : w - 1;
    y = y < 0 ? 0 : y < h ? y : h - 1;
    return (double)image->pixels[3 * (y * w + x) + channel];
}

/* u to the right, v down, the picture from 0 to 1. */
static double shown(const tl_light_image *image, double u, double v, int channel, int around)
{
    const double x = u * image->width - 0.5, y = v * image->height - 0.5;
    const long i = (long)floor(x), j = (long)floor(y);
    const double a = x - (double)i, b = y - (double)j;
    return (1 - b) * ((1 - a) * texel(image, i, j, channel, around) +
                      a * texel(image, i + 1, j, channel, around)) +
           b * ((1 - a) * texel(image, i, j + 1, channel, around) +
                a * texel(image, i + 1, j + 1, channel, around));
}

static void expect_close(
    const char *what, uint32_t x, uint32_t y, int channel, double got, double want)
{
    if (!(fabs(got - want) <= 3e-5 * (fabs(want) + 0.01)))
        fail_msg("%s: pixel (%u, %u), channel %d is %.9g, want %.9g", what, x, y, channel, got,
                 want);
}

typedef double expected(const tl_light_set *set, const double point[3], int channel);

/* Of the wall lit by the set: the albedo times what `want` says of the point. */
static void expect_wall(const char *what,
                        const tl_light_set *set,
                        uint32_t present,
                        expected *want)
{
    tl_gbuffer *g = white_wall(present);
    tl_image *image = image_like(g);
    tl_lighting_options options = tl_lighting_options_default();
    tl_error err;
    options.precision = TL_PRECISION_TWIN;
    ASSERT_OK(tl_light_set_check(set, what, &err), err);
    light_frame(NULL, &options, g, set, image);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            double p[3];
            ray_of(g, x, y, p);
            for (int i = 0; i < 3; i++)
                p[i] *= 2.0;
            for (int c = 0; c < 3; c++)
                expect_close(what, x, y, c,
                             (double)tl_image_plane(image, (unsigned)c)[y * image->pitch + x],
                             (c == 1 ? 0.5 : 1.0) * want(set, p, c));
        }
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

static double distance_to(const tl_light *light, const double p[3])
{
    double d2 = 0.0;
    for (int i = 0; i < 3; i++)
        d2 += (p[i] - (double)light->position[i]) * (p[i] - (double)light->position[i]);
    return sqrt(d2);
}

/* n.l, of the wall. */
static double cosine_to(const tl_light *light, const double p[3])
{
    return ((double)light->position[2] - p[2]) / distance_to(light, p);
}

static double by_table(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const tl_light_table *table = &set->tables[0];
    const double d = distance_to(light, p), x = d / (double)light->range * (table->count - 1);
    const uint32_t i = (uint32_t)x;
    (void)channel;
    if (d >= (double)light->range)
        return 0.0;
    return cosine_to(light, p) * ((double)table->values[i] * (1.0 - (x - i)) +
                                  (double)table->values[i + 1] * (x - i));
}

static void tables_are_linear_between_samples(void **state)
{
    static const float values[] = {3.0f, 0.0f, 1.0f, 0.25f, 2.0f, 0.5f, 0.5f, 0.125f};
    tl_light_set set = {0};
    tl_light light = tl_light_default();
    tl_error err;
    (void)state;
    light.position[2] = -1.75f;
    light.range = 1.6f;
    light.falloff = TL_FALLOFF_TABLE;
    ASSERT_OK(tl_light_set_add_table(&set, values, COUNT_OF(values), &light.table, &err), err);
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    expect_wall("table", &set, 0, by_table);
    tl_light_set_clear(&set);
}

/* A slide from straight ahead: left stays left, and the top is up. */
static double by_slide(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p), ahead = (double)light->position[2] - p[2];
    const double half = tan((double)light->outer_cone) * ahead;
    const double outer = cos((double)light->outer_cone), inner = cos((double)light->inner_cone),
                 above = (ahead / d - outer) / (inner - outer);
    const double share = fmin(fmax(above, 0.0), 1.0);
    const double u = 0.5 + 0.5 * (p[0] - (double)light->position[0]) / half;
    const double v = 0.5 - 0.5 * (p[1] - (double)light->position[1]) / half;
    return share * share * shown(&set->images[0], u, v, channel, 0) * ahead / d / (d * d);
}

/* Its top towards +x: what is right in the picture is down on the wall. */
static double by_turned_slide(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double turned[3] = {(double)light->position[0] - (p[1] - (double)light->position[1]),
                              (double)light->position[1] + (p[0] - (double)light->position[0]),
                              p[2]};
    return by_slide(set, turned, channel);
}

static tl_light slide(tl_light_set *set)
{
    tl_light light = tl_light_default();
    light.type = TL_LIGHT_SPOT;
    light.position[0] = 0.25f;
    light.position[1] = -0.125f;
    light.direction[2] = -1.0f;
    light.outer_cone = 0.7f;
    light.inner_cone = 0.6f;
    light.texture = add_picture(set, 7, 5);
    return light;
}

static void slides_are_upright_and_not_mirrored(void **state)
{
    tl_light_set set = {0};
    tl_error err;
    (void)state;
    tl_light light = slide(&set);
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    expect_wall("slide", &set, 0, by_slide);
    set.lights[0].up[0] = 1.0f;
    expect_wall("turned slide", &set, 0, by_turned_slide);
    tl_light_set_clear(&set);
}

/* Around a lamp close to the wall: -z in the middle, +x right of it, +y at the top. */
static double by_map(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p);
    const double to[3] = {p[0] - (double)light->position[0], p[1] - (double)light->position[1],
                          p[2] - (double)light->position[2]};
    const double u = 0.5 + atan2(to[0], -to[2]) / (2.0 * pi), v = acos(to[1] / d) / pi;
    return shown(&set->images[0], u, v, channel, 1) * cosine_to(light, p) / (d * d);
}

/* Its pole is +z, so -z is the pole below; the middle is towards +y, and ahead x up is +x. */
static double by_lying_map(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p);
    const double to[3] = {p[0] - (double)light->position[0], p[1] - (double)light->position[1],
                          p[2] - (double)light->position[2]};
    const double u = 0.5 + atan2(to[0], to[1]) / (2.0 * pi), v = acos(to[2] / d) / pi;
    return shown(&set->images[0], u, v, channel, 1) * cosine_to(light, p) / (d * d);
}

static void maps_are_around_and_not_mirrored(void **state)
{
    tl_light_set set = {0};
    tl_light light = tl_light_default();
    tl_error err;
    (void)state;
    light.position[0] = 0.3f;
    light.position[2] = -1.5f;
    light.texture = add_picture(&set, 16, 9);
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    expect_wall("map", &set, 0, by_map);
    set.lights[0].up[2] = 1.0f; /* the seam and a pole are on the wall */
    expect_wall("lying map", &set, 0, by_lying_map);
    tl_light_set_clear(&set);
}

/* Luminaires. Shares over 8 planes, 45 degrees apart, and rows from 90 - 45 (first) on. */
static uint32_t add_profile(tl_light_set *set, uint32_t first_row, uint32_t rows)
{
    tl_light_profile profile = {.columns = 8,
                                .rows = rows,
                                .first_row = first_row,
                                .rows_of_half_turn = 4,
                                .peak = 20.0,
                                .shares = malloc(8 * rows * sizeof(float))};
    uint32_t number = 0, seed = 77;
    tl_error err;
    assert_non_null(profile.shares);
    for (uint32_t i = 0; i < 8 * rows; i++)
        profile.shares[i] = i % 8 > 0 && first_row == 0 && i < 8 ? profile.shares[0]
                                                                 : uniform(&seed, 0.0f, 1.0f);
    ASSERT_OK(tl_light_set_add_profile(set, "profile", &profile, &number, &err), err);
    return number;
}

/* Around and down in degrees; no light above the last row or below the first. */
static double given(const tl_light_profile *profile, double around, double down)
{
    const double x = (around < 0.0 ? around + 360.0 : around) / 45.0,
                 y = down / 45.0 - profile->first_row;
    const uint32_t i = (uint32_t)x, j = (uint32_t)fmin(floor(y), profile->rows - 2.0);
    const float *const row = profile->shares + 8 * (size_t)j;
    const double a = x - i, b = y - j;
    if (y < 0.0 || y > profile->rows - 1.0)
        return 0.0;
    return (1 - b) * ((1 - a) * (double)row[i % 8] + a * (double)row[(i + 1) % 8]) +
           b * ((1 - a) * (double)row[8 + i % 8] + a * (double)row[8 + (i + 1) % 8]);
}

static double degrees(double angle)
{
    return angle * 180.0 / pi;
}

/* It shines at the wall; C0 is up, and C90, against the clock from behind the lamp, left. */
static double by_aimed_luminaire(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p);
    const double to[3] = {p[0] - (double)light->position[0], p[1] - (double)light->position[1],
                          p[2] - (double)light->position[2]};
    const double share =
        given(&set->profiles[0], degrees(atan2(-to[0], to[1])), degrees(acos(-to[2] / d)));
    (void)channel;
    return 3.0 * 20.0 * share * cosine_to(light, p) / (d * d);
}

/* It hangs, and C0 is towards the wall: seam and level are on it. */
static double by_hanging_luminaire(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p);
    const double to[3] = {p[0] - (double)light->position[0], p[1] - (double)light->position[1],
                          p[2] - (double)light->position[2]};
    const double share =
        given(&set->profiles[0], degrees(atan2(-to[0], -to[2])), degrees(acos(-to[1] / d)));
    (void)channel;
    return 3.0 * share * cosine_to(light, p) / (d * d);
}

static void luminaires_hang_as_they_are_aimed(void **state)
{
    static const uint32_t rows[][2] = {{0, 5}, {0, 3}, {2, 3}}; /* all, below, above */
    (void)state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        tl_light_set set = {0};
        tl_light light = tl_light_default();
        tl_error err;
        light.position[0] = 0.3f;
        light.position[2] = -1.5f;
        light.intensity = 3.0f;
        light.profile = add_profile(&set, rows[i][0], rows[i][1]);
        ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
        expect_wall("aimed luminaire", &set, 0, by_aimed_luminaire);
        set.lights[0].profile_scale = TL_PROFILE_PEAK;
        memcpy(set.lights[0].direction, (float[]){0, -1, 0}, sizeof light.direction);
        memcpy(set.lights[0].up, (float[]){0, 0, -1}, sizeof light.up);
        expect_wall("hanging luminaire", &set, 0, by_hanging_luminaire);
        memcpy(set.lights[0].up, (float[]){0, 0, 0}, sizeof light.up); /* it is the default */
        expect_wall("luminaire by default", &set, 0, by_hanging_luminaire);
        tl_light_set_clear(&set);
    }
}

/* The ambient lobe: a lamp behind the wall, which it does not face, and occlusion 1/2. At the range the light
 * is half as bright as beside it, and beyond it is not. */
static double by_ambient_lobe(const tl_light_set *set, const double p[3], int channel)
{
    const tl_light *light = &set->lights[0];
    const double d = distance_to(light, p);
    (void)channel;
    return d < (double)light->range ? 0.5 * 3.0 * 0.25 * (1.0 - 0.5 * d / (double)light->range)
                                    : 0.0;
}

static void ambient_lobes_ask_for_no_normal(void **state)
{
    tl_light_set set = {0};
    tl_light light = tl_light_default();
    tl_error err;
    (void)state;
    light.position[2] = -2.5f;
    light.range = 1.5f;
    light.falloff = TL_FALLOFF_TABLE;
    ASSERT_OK(tl_light_set_add_table(&set, (float[]){1.0f, 0.5f}, 2, &light.table, &err), err);
    light.intensity = 3.0f;
    light.ambient = 0.25f;
    ASSERT_OK(tl_light_set_add(&set, &light, &err), err);
    expect_wall("ambient lobe", &set, TL_GROUP_OCCLUSION, by_ambient_lobe);
    tl_light_set_clear(&set);
}

/* Skies, from a camera that looks anywhere: rays in world space. */
static void expect_sky(const char *what,
                       const tl_light_set *set,
                       tl_projection projection,
                       double (*want)(const tl_light_set *set,
                                      const double ray[3],
                                      int channel))
{
    static const double eye[3] = {1, 2, 3}, target[3] = {-1, 2.3, 1}, up[3] = {0.1, 1, 0};
    tl_camera camera = tl_camera_look_at(eye, target, up, 2.4, SIDE, SIDE, 0.1, 100.0);
    tl_lighting_options options = tl_lighting_options_default();
    tl_gbuffer *g = NULL;
    tl_error err;
    camera.projection = projection;
    ASSERT_OK(tl_gbuffer_create(&camera, TL_GROUP_BASE, &g, &err), err);
    tl_image *image = image_like(g);
    options.precision = TL_PRECISION_TWIN;
    ASSERT_OK(tl_light_set_check(set, what, &err), err);
    light_frame(NULL, &options, g, set, image);
    for (uint32_t y = 0; y < SIDE; y++)
        for (uint32_t x = 0; x < SIDE; x++) {
            double view[3], world[3], length = 0.0;
            ray_of(g, x, y, view);
            if (projection == TL_ORTHOGRAPHIC)
                view[0] = view[1] = 0.0;
            tl_camera_world_direction(&camera, view, world);
            for (int i = 0; i < 3; i++)
                length += world[i] * world[i];
            for (int i = 0; i < 3; i++)
                world[i] /= sqrt(length);
            for (int c = 0; c < 3; c++)
                expect_close(what, x, y, c,
                             (double)tl_image_plane(image, (unsigned)c)[y * image->pitch + x],
                             want(set, world, c));
        }
    tl_image_destroy(image);
    tl_gbuffer_destroy(g);
}

static double by_gradient(const tl_light_set *set, const double ray[3], int channel)
{
    const double level = (double)set->sky[channel], s = ray[1];
    return s > 0.0 ? level + s * ((double)set->zenith[channel] - level)
                   : level - s * ((double)set->ground[channel] - level);
}

/* Turned by 0.5 rad anticlockwise as seen from above: what was at -z is then towards -x. */
static double by_turned_image(const tl_light_set *set, const double ray[3], int channel)
{
    const double c = cos(0.5), s = sin(0.5);
    const double x = c * ray[0] - s * ray[2], z = s * ray[0] + c * ray[2];
    return 2.0 * shown(&set->images[0], 0.5 + atan2(x, -z) / (2.0 * pi), acos(ray[1]) / pi,
                       channel, 1);
}

static void skies_are_where_the_ray_goes(void **state)
{
    tl_light_set set = {.sky_type = TL_SKY_GRADIENT,
                        .sky = {1.0f, 0.5f, 0.25f},
                        .zenith = {0.0f, 3.0f, 0.25f},
                        .ground = {0.5f, 0.0f, 8.0f}};
    (void)state;
    for (int projection = 0; projection < 2; projection++)
        expect_sky("gradient", &set, (tl_projection)projection, by_gradient);
    set = (tl_light_set){.sky_type = TL_SKY_IMAGE, .sky_intensity = 2.0f, .sky_rotation = 0.5f};
    set.sky_image = add_picture(&set, 12, 7);
    for (int projection = 0; projection < 2; projection++)
        expect_sky("image", &set, (tl_projection)projection, by_turned_image);
    tl_light_set_clear(&set);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_linear_between_samples),
        cmocka_unit_test(slides_are_upright_and_not_mirrored),
        cmocka_unit_test(maps_are_around_and_not_mirrored),
        cmocka_unit_test(luminaires_hang_as_they_are_aimed),
        cmocka_unit_test(ambient_lobes_ask_for_no_normal),
        cmocka_unit_test(skies_are_where_the_ray_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
