/* From a plan to a G-buffer. */
#include "material.h"
#include "meaning.h"
#include "reading.h"
#include "size_limit.h"
#include "try.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Where nothing says what colour a surface has. */
static const float unknown_albedo = 0.5f;

/* Planes that are read beside the G-buffer's own: coverage, positions, a roughness that becomes an
 * exponent. */
enum { EXTRA_PLANES = 5 };

static tl_status check_size(const tl_import_plan *plan, tl_error *err)
{
    uint64_t files = 0;
    const uint64_t planes = (uint64_t)__builtin_popcount(plan->present) + EXTRA_PLANES;
    for (uint32_t i = 0; i < plan->source_count; i++)
        files += plan->sources[i].file_size;
    return tl_check_decoded_size(plan->sources[0].path, files,
                                 planes * plan->width * plan->height * sizeof(float), err);
}

static bool is_bound(const tl_importing *f, tl_import_plane plane)
{
    return f->plan->bindings[plane].is_bound;
}

/* The planes that a capture is read into, beside those of the G-buffer. */
typedef struct beside {
    float *alpha[3], *position[3]; /* [rows][pitch] each, or NULL */
    bool has_roughness;            /* in the place of the exponent */
} beside;

static tl_status add_beside(tl_reading *reading,
                            const tl_importing *f,
                            tl_import_plane plane,
                            float *planes[3],
                            float outside,
                            tl_error *err)
{
    const size_t count = (size_t)f->gbuffer->pitch * f->gbuffer->rows;
    const unsigned numbers = tl_import_kinds[plane].numbers;
    for (unsigned i = 0; i < numbers; i++) {
        planes[i] = malloc(count * sizeof(float));
        if (!planes[i])
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for \"%s\"",
                           tl_import_kinds[plane].word);
        for (size_t k = 0; k < count; k++)
            planes[i][k] = outside;
    }
    tl_reading_add(reading, &f->plan->bindings[plane], numbers, planes);
    return TL_OK;
}

/* The planes of the G-buffer that a kind fills as they are. */
static void add_own(tl_reading *reading, const tl_importing *f, tl_import_plane plane)
{
    const tl_import_kind *kind = &tl_import_kinds[plane];
    float *planes[3] = {NULL, NULL, NULL};
    if (!is_bound(f, plane) || kind->plane == TL_PLANE_COUNT ||
        !(f->gbuffer->present & TL_HAS(kind->plane)))
        return;
    for (unsigned i = 0; i < kind->numbers; i++)
        planes[i] = tl_gbuffer_plane(f->gbuffer, (enum tl_plane)(kind->plane + i));
    tl_reading_add(reading, &f->plan->bindings[plane], kind->numbers, planes);
}

static tl_status read_all(tl_importing *f, beside *to, tl_error *err)
{
    tl_status status = TL_OK;
    tl_reading reading = {.count = 0};
    float *exponent = tl_gbuffer_plane(f->gbuffer, TL_SHININESS);
    if (is_bound(f, TL_IMPORT_ALPHA))
        TRY(add_beside(&reading, f, TL_IMPORT_ALPHA, to->alpha, 0.0f, err));
    if (!is_bound(f, TL_IMPORT_DEPTH))
        TRY(add_beside(&reading, f, TL_IMPORT_POSITION, to->position, INFINITY, err));
    for (tl_import_plane p = 0; p < TL_IMPORT_COUNT; p++)
        add_own(&reading, f, p);
    to->has_roughness = exponent && !is_bound(f, TL_IMPORT_SHININESS);
    if (to->has_roughness)
        tl_reading_add(&reading, &f->plan->bindings[TL_IMPORT_ROUGHNESS], 1, &exponent);
    TRY(tl_reading_run(&reading, f->plan->sources, f->gbuffer->pitch, err));
    memcpy(f->position, to->position, sizeof to->position);
done:
    return status;
}

/* A coverage of 0 everywhere says nothing: the program did not write it. */
static void use_alpha(tl_importing *f, const float *alpha)
{
    const tl_gbuffer *g = f->gbuffer;
    bool any = false;
    for (uint32_t y = 0; alpha && y < g->camera.height && !any; y++)
        for (uint32_t x = 0; x < g->camera.width && !any; x++)
            any = alpha[(size_t)y * g->pitch + x] > 0.0f;
    if (any)
        f->alpha = alpha;
    else if (alpha)
        tl_notice(f->notices, "alpha is 0 everywhere, and ignored");
}

static void make_exponents(const tl_gbuffer *g)
{
    const vec3 black = {0.0f, 0.0f, 0.0f};
    float *plane = tl_gbuffer_plane(g, TL_SHININESS);
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            float *value = &plane[(size_t)y * g->pitch + x];
            *value = phong_of_metal_rough(black, 0.0f, *value).shininess;
        }
}

static void fill_albedo(const tl_importing *f)
{
    const tl_gbuffer *g = f->gbuffer;
    for (int c = 0; c < 3; c++) {
        float *plane = tl_gbuffer_plane(g, (enum tl_plane)(TL_ALBEDO_R + c));
        for (uint32_t y = 0; y < g->camera.height; y++)
            for (uint32_t x = 0; x < g->camera.width; x++)
                plane[(size_t)y * g->pitch + x] = unknown_albedo;
    }
    tl_notice(f->notices, "no albedo: every surface is taken as grey, %g; --map albedo=...",
              (double)unknown_albedo);
}

static tl_status make_colors(tl_importing *f, tl_error *err)
{
    static const tl_import_plane colors[] = {TL_IMPORT_ALBEDO, TL_IMPORT_SPECULAR,
                                             TL_IMPORT_EMISSIVE};
    tl_status status = TL_OK;
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++)
        if (is_bound(f, colors[i]) &&
            (f->gbuffer->present & TL_HAS(tl_import_kinds[colors[i]].plane)))
            TRY(tl_import_color(f, colors[i], err));
    if (!is_bound(f, TL_IMPORT_ALBEDO))
        fill_albedo(f);
done:
    return status;
}

/* Of the data window of the depth: pixels of the frame that it does not cover. */
static uint64_t count_outside(const tl_import_plan *plan)
{
    const tl_import_plane plane =
        plan->bindings[TL_IMPORT_DEPTH].is_bound ? TL_IMPORT_DEPTH : TL_IMPORT_POSITION;
    const tl_source_part *part = tl_import_part(plan, plane);
    const uint64_t all = (uint64_t)plan->width * plan->height;
    exr_attr_box2i_t both;
    if (!part->exr.stream)
        return 0;
    if (!tl_exr_part_overlap(&part->exr, &both))
        return all;
    return all - (uint64_t)((int64_t)both.max.x - both.min.x + 1) *
                     (uint64_t)((int64_t)both.max.y - both.min.y + 1);
}

static void say_counts(const tl_importing *f, const char *name)
{
    const uint64_t all = (uint64_t)f->plan->width * f->plan->height;
    const tl_import_counts *c = &f->counts;
    if (c->outside > 0)
        tl_notice(f->notices, "%s: %" PRIu64 " pixels lie outside its data window: sky", name,
                  c->outside);
    if (c->partial > 0)
        tl_notice(f->notices, "%s: %" PRIu64 " pixels are covered in part: %s", name,
                  c->partial,
                  f->plan->options->edges == TL_EDGES_DROP
                      ? "made sky"
                      : "their numbers are taken as they are, which may be means of several "
                        "surfaces (--edges drop makes them sky)");
    if (c->sky == all)
        tl_notice(f->notices,
                  "%s: no pixel has a depth above 0 and below %g: the whole frame is sky", name,
                  f->plan->options->sky_from);
}

static tl_status read_pixels(tl_importing *f, const char *name, tl_error *err)
{
    tl_status status = TL_OK;
    beside to = {.has_roughness = false};
    TRY(read_all(f, &to, err));
    use_alpha(f, to.alpha[0]);
    if (to.has_roughness)
        make_exponents(f->gbuffer);
    TRY(tl_import_depth(f, err));
    f->counts.outside = count_outside(f->plan);
    tl_import_range(f);
    tl_import_normals(f);
    TRY(make_colors(f, err));
    say_counts(f, name);
done:
    for (int i = 0; i < 3; i++) {
        free(to.alpha[i]);
        free(to.position[i]);
    }
    return status;
}

/* Near and far are known once the depths are. */
static tl_camera camera_to_begin_with(const tl_import_plan *plan)
{
    tl_camera camera = plan->camera.camera;
    camera.near = 1.0f;
    camera.far = INFINITY;
    return camera;
}

tl_status tl_import_read(const char *path,
                         const tl_import_options *options,
                         const tl_notices *notices,
                         tl_gbuffer **out,
                         tl_import_counts *counts,
                         tl_error *err)
{
    tl_status status = TL_OK;
    tl_import_plan plan = {.options = NULL};
    tl_importing f = {.plan = &plan, .notices = notices};
    tl_error reason = {.status = TL_OK};
    TRY(tl_import_plan_open(&plan, path, options, notices, err));
    if (plan.missing[0])
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED, "%s", plan.missing));
    TRY(check_size(&plan, err));
    const tl_camera camera = camera_to_begin_with(&plan);
    const tl_status created = tl_gbuffer_create(&camera, plan.present, &f.gbuffer, &reason);
    if (created != TL_OK)
        TRY(tl_fail(err, created == TL_ERR_MEMORY ? created : TL_ERR_FORMAT, "%s: %.3000s",
                    plan.sources[0].path, reason.message));
    TRY(read_pixels(&f, plan.sources[0].path, err));
    *out = f.gbuffer;
    f.gbuffer = NULL;
    if (counts)
        *counts = f.counts;
done:
    tl_gbuffer_destroy(f.gbuffer);
    tl_import_plan_close(&plan);
    return status;
}
