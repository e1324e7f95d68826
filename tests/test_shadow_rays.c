#define _GNU_SOURCE
/* Does light arrive where rays say that it does?
 *
 * Each scene is captured with shadow maps of all its lights. For every pixel that a light reaches, and is
 * above, a ray between the two says whether anything is in between; kernels' text says by the map which
 * share arrives. They differ where the share is on the other side of a half. A pixel is at an edge where rays
 * to its surroundings, two texels of the map each way, do not all say the same. */
#include "assets.h"
#include "lit_pixel.h"
#include "parallel.h"
#include "prepared.h"
#include "rays/asset_view.h"
#include "rays/ray_scene.h"
#include "sections.h"

#include "tilelight/capture.h"
#include "tilelight/gbuffer_file.h"

#include <jansson.h>
#include <unistd.h>

enum { WIDTH = 640, HEIGHT = 360 };

/* Of lit pixels, that may differ; none away from edges. */
static const double most_differing = 0.01;

typedef struct scene_case {
    const char *scene, *lights; /* in the sources' folder; lights NULL: the scene's own */
    double near;                /* tl_capture_options.shadow_near */
    bool is_long;               /* only where TILELIGHT_LONG is set: minutes */
    bool is_asset;              /* in the assets' folder: skipped where it is not there */
    const asset_view *view;     /* NULL: the scene's own */
} scene_case;

/* Along the nave, from its end. */
static const asset_view along_nave = {
    {-9.8, 2.2, -0.3}, {0.0, -0.7071067811865475, 0.0, 0.7071067811865476}, 1.0};

static const scene_case cases[] = {
    {"data/nine-lights.gltf", NULL, 0.0, false, false, NULL},
    {"data/nine-lights.gltf", "data/nine-lights.lights.json", 0.0, false, false, NULL},
    {"data/fair.glb", NULL, 0.0, false, false, NULL},
    {"data/hard-cases.glb", NULL, 0.0, false, false, NULL},
    {"data/hall.gltf", NULL, 0.4, true, false, NULL}, /* from beyond its lanterns on */
    {"SponzaRebuilt/glTF/Sponza.gltf", "tests/rays/atrium.lights.json", 0.0, false, true,
     &along_nave},
};

/* Surfaces that get less than a hundredth of what the light gives head on count for neither: by normals,
 * which maps of 8 bits turn by half of that, they are edge-on to it. */
static const real least_cosine = 0.01f;

/* A frame, and its scene for rays. */
typedef struct frame {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    tl_prepared prepared;
    ray_scene *rays;
    float *planes[TL_PLANE_COUNT];
    double world_from_view[3][3], eye[3];
    double (*facets)
        [3]; /* [HEIGHT][WIDTH]: normals of the triangles, in view space; 0 where unknown */
} frame;

/* What is known of a pixel and the light in question. */
enum { NOT_LIT = 0, LIT = 1, REACHED = 2, BRIGHT = 4, DARK = 8, TURNED = 16 };

typedef struct pixel_of_light {
    unsigned
        is; /* LIT; REACHED: by the ray; BRIGHT, DARK: more, less than a half, by the map; TURNED: not LIT,
             * for the triangle is turned away although the normal is not */
    float x, y; /* texels in the map */
    float share, cosine;
    float view;
} pixel_of_light;

typedef struct light_case {
    const frame *f;
    uint32_t index; /* of the prepared light */
    tl_view_shadow shadow;
    pixel_of_light *pixels; /* [HEIGHT][WIDTH] */
} light_case;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static surface surface_of_pixel(const frame *f, uint32_t column, uint32_t row)
{
    const tl_needs needs = f->prepared.needs;
    const pixel in = pixel_at(f->planes, (size_t)row * f->gbuffer->pitch + column);
    return surface_of(&f->prepared.frame, needs, in, R(1.0), (real)column, (scalar)row);
}

static void to_world(const frame *f, const double view[3], int is_point, double world[3])
{
    for (int i = 0; i < 3; i++)
        world[i] = is_point ? f->eye[i] : 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            world[i] += f->world_from_view[i][j] * view[j];
}

/* Of the triangles that the picture may have there, that whose normal is nearest to the picture's: on an edge
 * between two, one picture shows one and another the other. */
static void find_facet(const frame *f, uint32_t column, uint32_t row)
{
    static const double around[][2] = {{0, 0}, {0.02, 0}, {-0.02, 0}, {0, 0.02}, {0, -0.02}};
    double *const out = f->facets[(size_t)row * WIDTH + column], most = -2.0;
    const surface s = surface_of_pixel(f, column, row);
    const double depth = -(double)s.position.z;
    for (size_t k = 0; k < COUNT_OF(around) && isfinite(depth); k++) {
        const tl_rays rays = f->prepared.frame.rays;
        const double view[3] = {(double)s.position.x + around[k][0] * (double)rays.dx * depth,
                                (double)s.position.y + around[k][1] * (double)rays.dy * depth,
                                -depth};
        const double length = sqrt(dot(view, view));
        const double unit[3] = {view[0] / length, view[1] / length, view[2] / length};
        const double n[3] = {(double)s.normal.x, (double)s.normal.y, (double)s.normal.z};
        double direction[3], world[3], facet[3] = {0.0, 0.0, 0.0};
        to_world(f, unit, 0, direction);
        if (!ray_scene_normal(f->rays, f->eye, direction, 0.999 * length, 1.001 * length,
                              world))
            continue;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                facet[i] += f->world_from_view[j][i] * world[j];
        if (dot(facet, n) > most) {
            most = dot(facet, n);
            memcpy(out, facet, sizeof facet);
        }
    }
}

static void find_facets(void *context, size_t begin, size_t end)
{
    for (size_t row = begin; row < end; row++)
        for (uint32_t column = 0; column < WIDTH; column++)
            find_facet(context, column, (uint32_t)row);
}

/* Whether the triangle turns its side that is seen to the light, too, as its normal in the picture does:
 * where it does not, which side of it the surface is on is for normals to say and for rays to deny. */
static bool facet_faces(const frame *f, uint32_t column, uint32_t row, vec3 l, real distance)
{
    const double *const n = f->facets[(size_t)row * WIDTH + column];
    const double to_light[3] = {(double)l.x, (double)l.y, (double)l.z};
    return dot(n, to_light) > (double)(least_cosine * distance);
}

/* How much of the way from the light to a point, in view space, is nearer than what the map sees. */
static double unseen_share(tl_view_shadow map, const double l[3])
{
    const vec3 v = along_rows(map, (vec3){(real)-l[0], (real)-l[1], (real)-l[2]});
    const real ahead = map.kind == TL_SHADOW_CUBE ? seen_from_side(side_met_by(v), v).z : v.z;
    return ahead > 0.0f ? fmin((double)(map.near / ahead), 1.0) : 0.0;
}

/* Whether a ray from a point in view space to the light meets anything. Both ends are left out: the surface's
 * own, by what its place is off, and what is nearer to the light than the map sees. */
static bool is_blocked(const light_case *of, const double point[3], const double n[3])
{
    const tl_view_light light = of->f->prepared.lights[of->index];
    const int is_sun = of->shadow.kind == TL_SHADOW_PARALLEL;
    const double off = 2e-5 * (1.0 + fabs(point[2]));
    double start[3], l[3], length = 0.0, from[3], direction[3];
    for (int i = 0; i < 3; i++) {
        start[i] = point[i] + off * n[i];
        l[i] = (double)light.position[i] - (is_sun ? 0.0 : start[i]);
        length += l[i] * l[i];
    }
    const double seen = is_sun ? 1e6 : sqrt(length) * (1.0 - unseen_share(of->shadow, l));
    length = sqrt(length);
    for (int i = 0; i < 3; i++)
        l[i] /= length;
    to_world(of->f, start, 1, from);
    to_world(of->f, l, 0, direction);
    return ray_scene_blocks(of->f->rays, from, direction, off, seen);
}

/* As kernels decide it, without the shadow. */
static bool is_lit(const light_case *of, surface s, vec3 *l, approach *a, real *distance)
{
    const tl_prepared *p = &of->f->prepared;
    const tl_view_light light = p->lights[of->index];
    const bool is_sun = of->shadow.kind == TL_SHADOW_PARALLEL;
    const bool is_global = of->index < p->frame.global_count;
    const vec3 direction = {light.position[0], light.position[1], light.position[2]};
    *l = is_sun ? direction : vector_to_light(s.position, light);
    *a = approach_of(s, *l);
    *distance = is_sun ? R(1.0) : SQRT(a->distance2);
    return a->facing > least_cosine * *distance &&
           (is_global || reaches(light, a->distance2)) &&
           in_cone(p->spots[of->index], *l, a->distance2);
}

static void look_at_pixel(const light_case *of, uint32_t column, uint32_t row)
{
    pixel_of_light *out = &of->pixels[(size_t)row * WIDTH + column];
    const surface s = surface_of_pixel(of->f, column, row);
    const tl_numbers numbers = (tl_numbers)of->f->prepared.lights;
    vec3 l;
    approach a;
    real distance;
    out->is = NOT_LIT;
    if (!isfinite(s.position.z) || !is_lit(of, s, &l, &a, &distance))
        return;
    if (!facet_faces(of->f, column, row, l, distance)) {
        out->is = TURNED;
        return;
    }
    const double point[3] = {(double)s.position.x, (double)s.position.y, (double)s.position.z};
    const real share = unshadowed_share(numbers, of->shadow, s, l, distance, a.facing);
    const shadow_place at =
        place_in_shadow(of->shadow, shadowed_point(of->shadow, s, l), s.normal, a.facing);
    out->is = LIT;
    out->is |= is_blocked(of, point, of->f->facets[(size_t)row * WIDTH + column])
                   ? 0u
                   : (unsigned)REACHED;
    out->is |= share > R(0.5) ? (unsigned)BRIGHT : share < R(0.5) ? (unsigned)DARK : 0u;
    out->share = share;
    out->cosine = a.facing / distance;
    out->x = at.x;
    out->y = at.y;
    out->view = at.view;
}

static void look_at_rows(void *context, size_t begin, size_t end)
{
    const light_case *of = context;
    for (size_t row = begin; row < end; row++)
        for (uint32_t column = 0; column < WIDTH; column++)
            look_at_pixel(of, column, (uint32_t)row);
}

static bool differs(const pixel_of_light *p)
{
    return (p->is & LIT) && (p->is & (p->is & REACHED ? DARK : BRIGHT));
}

/* Rays to neighbours on the screen that are up to two texels away. */
static bool neighbours_differ(const light_case *of, uint32_t column, uint32_t row)
{
    enum { FAR = 8 };
    const pixel_of_light *own = &of->pixels[(size_t)row * WIDTH + column];
    for (int y = -FAR; y <= FAR; y++)
        for (int x = -FAR; x <= FAR; x++) {
            const long c = (long)column + x, r = (long)row + y;
            if (c < 0 || r < 0 || c >= WIDTH || r >= HEIGHT)
                continue;
            const pixel_of_light *p = &of->pixels[r * WIDTH + c];
            if ((p->is & LIT) && ((p->is ^ own->is) & REACHED) &&
                hypotf(p->x - own->x, p->y - own->y) <= 2.0f)
                return true;
        }
    return false;
}

/* Two directions of unit length across another. */
static void find_across(const double l[3], double x[3], double y[3])
{
    const int i = fabs(l[0]) < fabs(l[1]) ? 0 : 1, j = (i + 1) % 3, k = (i + 2) % 3;
    const double length = hypot(l[j], l[k]);
    x[i] = 0.0;
    x[j] = l[k] / length;
    x[k] = -l[j] / length;
    for (int a = 0; a < 3; a++)
        y[a] = l[(a + 1) % 3] * x[(a + 2) % 3] - l[(a + 2) % 3] * x[(a + 1) % 3];
}

/* A texel's width at the surface, m. */
static double texel_at(const light_case *of, real distance)
{
    const float *const right = of->shadow.right;
    const vec3 row = {right[0], right[1], right[2]};
    return of->shadow.kind == TL_SHADOW_PARALLEL ? 1.0 / (double)SQRT(dot3(row, row))
                                                 : (double)(distance / of->shadow.scale);
}

/* Rays to places up to two texels away each way, across the light: on the triangle's plane, and, of what is
 * dark, also where no surface is, for light that passes there tells of a shadow's edge. */
static bool surroundings_differ(const light_case *of, uint32_t column, uint32_t row)
{
    enum { STEPS = 12 };
    const surface s = surface_of_pixel(of->f, column, row);
    const bool is_dark = !(of->pixels[(size_t)row * WIDTH + column].is & REACHED);
    const double *const n = of->f->facets[(size_t)row * WIDTH + column];
    double x[3], y[3];
    vec3 to_light;
    approach a;
    real distance;
    (void)is_lit(of, s, &to_light, &a, &distance);
    const double length = (double)SQRT(dot3(to_light, to_light));
    const double l[3] = {(double)to_light.x / length, (double)to_light.y / length,
                         (double)to_light.z / length};
    const double step = 2.0 * texel_at(of, distance) / STEPS;
    find_across(l, x, y);
    for (int j = -STEPS; j <= STEPS; j++)
        for (int i = -STEPS; i <= STEPS; i++) {
            const double at[3] = {(double)s.position.x, (double)s.position.y,
                                  (double)s.position.z};
            double off[3], beside[3], on_plane[3];
            if (i * i + j * j > STEPS * STEPS)
                continue;
            for (int k = 0; k < 3; k++)
                off[k] = step * (i * x[k] + j * y[k]);
            for (int k = 0; k < 3; k++) {
                beside[k] = at[k] + off[k];
                on_plane[k] = beside[k] - dot(off, n) / dot(l, n) * l[k];
            }
            if (is_blocked(of, on_plane, n) != is_dark ||
                (is_dark && !is_blocked(of, beside, n)))
                return true;
        }
    return false;
}

typedef struct tally {
    size_t lit, dark, differing, away, turned;
    uint32_t column, row; /* of one away from edges */
} tally;

static void count_pixels(const light_case *of, tally *out)
{
    for (uint32_t row = 0; row < HEIGHT; row++)
        for (uint32_t column = 0; column < WIDTH; column++) {
            const pixel_of_light *p = &of->pixels[(size_t)row * WIDTH + column];
            out->lit += (p->is & LIT) != 0;
            out->turned += (p->is & TURNED) != 0;
            out->dark += (p->is & LIT) && !(p->is & REACHED);
            if (!differs(p))
                continue;
            out->differing++;
            if (getenv("DUMP"))
                fprintf(stderr, "%u %u %u %g %g %g %u\n", of->f->prepared.sources[of->index],
                        column, row, (double)p->cosine, (double)p->share, (double)p->x, p->is);
            if (neighbours_differ(of, column, row) || surroundings_differ(of, column, row))
                continue;
            out->away++;
            out->column = column;
            out->row = row;
            if (getenv("TILELIGHT_VERBOSE"))
                printf(
                    "  away: light %u, pixel (%u, %u), place (%g, %g), cosine %g, share %g, %s "
                    "by rays\n",
                    of->f->prepared.sources[of->index], column, row, (double)p->x, (double)p->y,
                    (double)p->cosine, (double)p->share, p->is & REACHED ? "lit" : "dark");
        }
}

static char *source_path(const char *file)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    char *path = NULL;
    assert_true(asprintf(&path, "%s/%s", source ? source : ".", file) > 0);
    return path;
}

static void open_frame(const scene_case *c, frame *f)
{
    tl_error err;
    char *const given_scene = c->is_asset ? asset_path(c->scene) : source_path(c->scene);
    char *const seen_scene = c->view ? asset_view_make(given_scene, c->view) : NULL;
    const char *const scene = seen_scene ? seen_scene : given_scene;
    char *const lights = c->lights ? source_path(c->lights) : NULL;
    tl_capture_options options = {
        .width = WIDTH, .height = HEIGHT, .all_shadows = true, .shadow_near = c->near};
    *f = (frame){.gbuffer = NULL};
    tl_light_set found = {0}, given = {0};
    if (lights) {
        ASSERT_OK(tl_lights_read(lights, &given, &err), err);
        for (size_t i = 0; i < given.count; i++)
            given.lights[i].casts_shadow = 1;
        options.shadow_lights = &given;
    }
    ASSERT_OK(tl_capture(scene, &options, &f->gbuffer, &found, NULL, NULL, &err), err);
    f->lights = lights ? given : found;
    if (lights)
        tl_light_set_clear(&found);
    ASSERT_OK(tl_gbuffer_repair(f->gbuffer, scene, false, NULL, &err), err);
    ASSERT_OK(tl_prepare(f->gbuffer, &f->lights, &(tl_prepare_options){.tile_size = 16}, NULL,
                         &f->prepared, &err),
              err);
    ASSERT_OK(ray_scene_open(scene, &f->rays, &err), err);
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        f->planes[p] = tl_gbuffer_plane(f->gbuffer, (enum tl_plane)p);
    static const double origin[3] = {0.0, 0.0, 0.0};
    tl_camera_world_point(&f->gbuffer->camera, origin, f->eye);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            f->world_from_view[i][j] = (double)f->gbuffer->camera.view_from_world[j][i];
    f->facets = calloc((size_t)WIDTH * HEIGHT, sizeof *f->facets);
    assert_non_null(f->facets);
    tl_parallel(HEIGHT, 4, find_facets, f);
    asset_view_remove(seen_scene);
    free(given_scene);
    free(lights);
}

static void close_frame(frame *f)
{
    free(f->facets);
    ray_scene_close(f->rays);
    tl_prepared_clear(&f->prepared);
    tl_light_set_clear(&f->lights);
    tl_gbuffer_destroy(f->gbuffer);
}

/* 0: the light has no map. */
static tl_u32 shadow_of_light(const tl_prepared *p, uint32_t index)
{
    if (!has_shape(p->lights[index].falloff))
        return 0;
    const tl_view_shape *shapes = tl_section_at(p, p->frame.shapes_at);
    return shapes[p->lights[index].falloff - TL_FADE_COUNT].shadow_at;
}

/* For a person, and as an object of the report. */
static void report_scene(const scene_case *c, uint32_t maps, const tally *sum, json_t *report)
{
    const char *const lights = c->lights ? c->lights : "its own";
    printf("%s, lights: %s, %u maps; of %zu lit pixels %zu are dark, %zu differ (%.3f %%), %zu "
           "of them away from an edge; %zu more are of triangles that are turned away\n",
           c->scene, lights, maps, sum->lit, sum->dark, sum->differing,
           100.0 * (double)sum->differing / (double)(sum->lit ? sum->lit : 1), sum->away,
           sum->turned);
    fflush(stdout);
    json_array_append_new(report,
                          json_pack("{ss ss sf sI sI sI sI sI sI}", "scene", c->scene, "lights",
                                    lights, "near", c->near, "maps", (json_int_t)maps, "lit",
                                    (json_int_t)sum->lit, "dark", (json_int_t)sum->dark,
                                    "differing", (json_int_t)sum->differing, "away",
                                    (json_int_t)sum->away, "turned", (json_int_t)sum->turned));
}

/* Returns whether they agree. */
static bool agrees_with_rays(const scene_case *c, json_t *report)
{
    frame f;
    tally sum = {0};
    open_frame(c, &f);
    pixel_of_light *pixels = calloc((size_t)WIDTH * HEIGHT, sizeof *pixels);
    assert_non_null(pixels);
    uint32_t maps = 0;
    for (uint32_t i = 0; i < f.prepared.frame.light_count; i++) {
        const tl_u32 at = shadow_of_light(&f.prepared, i);
        if (at == 0)
            continue;
        light_case of = {&f, i, shadow_behind((tl_numbers)f.prepared.lights, at), pixels};
        tally own = {0};
        tl_parallel(HEIGHT, 4, look_at_rows, &of);
        count_pixels(&of, &own);
        maps++;
        if (getenv("TILELIGHT_VERBOSE"))
            printf("  light %u, kind %u, %u texels: %zu lit, %zu dark, %zu differ, %zu away\n",
                   f.prepared.sources[i], of.shadow.kind, of.shadow.size, own.lit, own.dark,
                   own.differing, own.away);
        sum.lit += own.lit;
        sum.dark += own.dark;
        sum.differing += own.differing;
        sum.away += own.away;
        sum.turned += own.turned;
    }
    report_scene(c, maps, &sum, report);
    assert_true(maps > 0 && sum.lit > 0 && sum.dark > 0);
    free(pixels);
    close_frame(&f);
    return (double)sum.differing <= most_differing * (double)sum.lit && sum.away == 0;
}

static bool is_chosen(const scene_case *c)
{
    if (c->is_long && !getenv("TILELIGHT_LONG"))
        return false;
    if (!c->is_asset)
        return true;
    char *const path = asset_path(c->scene);
    const bool is_there = access(path, R_OK) == 0;
    free(path);
    return is_there;
}

static void maps_agree_with_rays(void **state)
{
    const char *const file = getenv("TILELIGHT_RESULT");
    json_t *const report = json_array();
    bool agree = true;
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++)
        if (is_chosen(&cases[i]))
            agree = agrees_with_rays(&cases[i], report) && agree;
    if (file)
        assert_int_equal(json_dump_file(report, file, JSON_INDENT(1)), 0);
    json_decref(report);
    assert_true(agree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(maps_agree_with_rays)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
