#include "tilelight/check.h"

#include "allowance_blend.h"
#include "parallel.h"
#include "surround.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

/* What a picture shows: the surfaces of a G-buffer, or a layer of it. */
typedef struct checked_surface {
    const tl_gbuffer *gbuffer; /* in full float */
    tl_prepared prepared;
    float *planes[TL_PLANE_COUNT]; /* the G-buffer's */
} checked_surface;

struct tl_check {
    tl_gbuffer *unpacked; /* the G-buffer in full float, where it had to be made; or NULL */
    checked_surface surface;
    checked_surface *layers; /* [layer_count], nearest first; owned */
    uint32_t layer_count, lit_layers;
    const tl_light_set *lights;
    float light_cutoff;
    uint32_t occlusion_samples; /* 0: the default */
    tl_cosine cosine;
};

static tl_status prepare(const tl_check *check,
                         const tl_gbuffer *gbuffer,
                         checked_surface *out,
                         tl_error *err)
{
    enum { ANY_TILE = 16 }; /* there are no tiles here */
    const tl_prepare_options options = {.tile_size = ANY_TILE,
                                        .light_cutoff = check->light_cutoff,
                                        .occlusion_samples = check->occlusion_samples};
    out->gbuffer = gbuffer;
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        out->planes[p] = tl_gbuffer_plane(gbuffer, (enum tl_plane)p);
    const tl_status status =
        tl_prepare(gbuffer, check->lights, &options, NULL, &out->prepared, err);
    if (status == TL_OK)
        tl_reference_surround(&out->prepared, gbuffer, TL_TWIN_FLOAT);
    return status;
}

static tl_status prepare_layers(const tl_layers *layers, tl_check *made, tl_error *err)
{
    tl_status status = TL_OK;
    made->layers = calloc(layers->count + 1, sizeof *made->layers);
    if (!made->layers)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a check"));
    made->layer_count = made->lit_layers = layers->count;
    for (uint32_t i = 0; i < layers->count; i++)
        TRY(prepare(made, layers->of[i], &made->layers[i], err));
done:
    return status;
}

tl_status tl_check_create(const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          float light_cutoff,
                          tl_cosine cosine,
                          tl_check **out,
                          tl_error *err)
{
    tl_status status = TL_OK;
    tl_check *made = calloc(1, sizeof *made);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a check"));
    if (gbuffer->layout != TL_LAYOUT_FLOAT)
        TRY(tl_gbuffer_unpack(gbuffer, &made->unpacked, err));
    const tl_gbuffer *in_float = made->unpacked ? made->unpacked : gbuffer;
    made->cosine = cosine;
    made->lights = lights;
    made->light_cutoff = light_cutoff;
    TRY(prepare(made, in_float, &made->surface, err));
    TRY(prepare_layers(&in_float->layers, made, err));
    *out = made;
    made = NULL;
done:
    tl_check_destroy(made);
    return status;
}

void tl_check_destroy(tl_check *check)
{
    if (!check)
        return;
    for (uint32_t i = 0; i < check->layer_count; i++)
        tl_prepared_clear(&check->layers[i].prepared);
    free(check->layers);
    tl_prepared_clear(&check->surface.prepared);
    tl_gbuffer_destroy(check->unpacked);
    free(check);
}

tl_status tl_check_allow(tl_check *check, const tl_approximations *of, tl_error *err)
{
    char lacking[128];
    tl_status status = TL_OK;
    TRY(tl_approximations_check(of, err));
    tl_approximations_lacking(of, TL_KNOB_BOUNDED, lacking, sizeof lacking);
    if (lacking[0])
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "%s: nobody says how far it may be off, so a picture cannot be checked "
                    "for it; `tilelight compare' says how far it is",
                    lacking));
    check->surface.prepared.approximations = *of;
    for (uint32_t i = 0; i < check->layer_count; i++)
        check->layers[i].prepared.approximations = *of;
    if (of->of[TL_KNOB_FORM] == TL_FORM_TEXTBOOK)
        check->cosine = TL_COSINE_TEXTBOOK;
done:
    return status;
}

tl_status tl_check_occlusion(tl_check *check, uint32_t samples, tl_error *err)
{
    const tl_approximations of = check->surface.prepared.approximations;
    check->occlusion_samples = samples;
    const tl_status status = prepare(check, check->surface.gbuffer, &check->surface, err);
    check->surface.prepared.approximations = of;
    return status;
}

void tl_check_layers(tl_check *check, uint32_t most)
{
    check->lit_layers = most < check->layer_count ? most : check->layer_count;
}

/* What is seen through the layers. */
static tl_allowance allowance_at(const tl_check *check,
                                 uint32_t x,
                                 uint32_t y,
                                 tl_cosine cosine)
{
    tl_allowance seen =
        tl_allowance_of(&check->surface.prepared, check->surface.planes, x, y, cosine);
    for (uint32_t i = check->lit_layers; i-- > 0;) {
        const checked_surface *layer = &check->layers[i];
        const float opacity = layer->gbuffer->opacity[(size_t)y * layer->gbuffer->pitch + x];
        if (!(opacity > 0.0f))
            continue;
        const tl_allowance lit = tl_allowance_of(&layer->prepared, layer->planes, x, y, cosine);
        seen = tl_allowance_blended(opacity, &lit, &seen);
    }
    return seen;
}

/* 0 / 0 is 0: what may not be off, and is not. */
static double ratio_of(float got, double expected, double low, double high)
{
    const double off = (double)got - expected;
    if (off == 0.0)
        return 0.0;
    if (!isfinite(got))
        return (double)INFINITY;
    const double allowed = off > 0.0 ? high - expected : expected - low;
    return allowed > 0.0 ? fabs(off) / allowed : (double)INFINITY;
}

/* One picture; a report a row, added up in the order of rows. */
typedef struct picture {
    const tl_check *check;
    const tl_image *image;
    tl_image *ratios;      /* or NULL */
    tl_check_report *rows; /* [height] */
} picture;

static size_t offset_of(const tl_image *image, uint32_t x, uint32_t y)
{
    return (size_t)y * image->pitch + x;
}

static int is_excused(const picture *p, uint32_t x, uint32_t y)
{
    const tl_allowance a = allowance_at(p->check, x, y, TL_COSINE_TEXTBOOK);
    for (unsigned c = 0; c < 3; c++) {
        const float got = tl_image_plane(p->image, c)[offset_of(p->image, x, y)];
        if (!(ratio_of(got, a.expected[c], a.low[c], a.high[c]) <= 1.0))
            return 0;
    }
    return 1;
}

static void check_pixel(const picture *p, uint32_t x, uint32_t y, tl_check_report *row)
{
    const tl_check *check = p->check;
    const size_t at = offset_of(p->image, x, y);
    const tl_allowance a = allowance_at(check, x, y, check->cosine);
    int failed = 0, not_finite = 0;
    for (unsigned c = 0; c < 3; c++) {
        const float got = tl_image_plane(p->image, c)[at];
        const double ratio = ratio_of(got, a.expected[c], a.low[c], a.high[c]);
        failed |= ratio > 1.0;
        not_finite |= !isfinite(got);
        if (p->ratios)
            tl_image_plane(p->ratios, c)[at] = (float)ratio;
        if (a.certain)
            row->rounding_ratio = fmax(row->rounding_ratio, ratio);
        if (ratio > row->worst.ratio)
            row->worst = (tl_check_value){.x = x,
                                          .y = y,
                                          .channel = c,
                                          .got = got,
                                          .expected = a.expected[c],
                                          .low = a.low[c],
                                          .high = a.high[c],
                                          .ratio = ratio};
    }
    row->pixel_count++;
    row->failed_count += (uint64_t)failed;
    row->not_finite_count += (uint64_t)not_finite;
    if (failed && !not_finite && check->cosine != TL_COSINE_TEXTBOOK)
        row->excused_count += (uint64_t)is_excused(p, x, y);
}

static void check_rows(void *context, size_t begin, size_t end)
{
    const picture *p = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < p->image->width; x++)
            check_pixel(p, x, (uint32_t)y, &p->rows[y]);
}

static void add_row(tl_check_report *sum, const tl_check_report *row)
{
    sum->pixel_count += row->pixel_count;
    sum->failed_count += row->failed_count;
    sum->not_finite_count += row->not_finite_count;
    sum->excused_count += row->excused_count;
    sum->rounding_ratio = fmax(sum->rounding_ratio, row->rounding_ratio);
    if (row->worst.ratio > sum->worst.ratio)
        sum->worst = row->worst;
}

static int has_size(const tl_image *image, const tl_camera *camera)
{
    return image->width == camera->width && image->height == camera->height;
}

tl_status tl_check_image(const tl_check *check,
                         const tl_image *image,
                         tl_image *ratios,
                         tl_check_report *out,
                         tl_error *err)
{
    const tl_camera *camera = &check->surface.gbuffer->camera;
    tl_status status = TL_OK;
    tl_check_report sum = {0};
    picture p = {check, image, ratios, NULL};
    if (!has_size(image, camera) || (ratios && !has_size(ratios, camera)))
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "the picture is %u x %u pixels, the G-buffer %u x %u: they must be of one "
                    "size",
                    image->width, image->height, camera->width, camera->height));
    p.rows = calloc(image->height, sizeof *p.rows);
    if (!p.rows)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for checking a picture"));
    tl_parallel(image->height, 1, check_rows, &p);
    for (uint32_t y = 0; y < image->height; y++)
        add_row(&sum, &p.rows[y]);
    *out = sum;
done:
    free(p.rows);
    return status;
}

void tl_check_lights(const tl_check *check,
                     uint32_t x,
                     uint32_t y,
                     tl_check_light *out,
                     size_t capacity,
                     size_t *count)
{
    const checked_surface *of = &check->surface;
    *count = 0;
    for (uint32_t i = 0; i < of->prepared.frame.light_count; i++) {
        tl_light_share share;
        if (!tl_allowance_share(&of->prepared, of->planes, x, y, i, check->cosine, &share))
            continue;
        if (*count < capacity) {
            tl_check_light *to = &out[*count];
            *to = (tl_check_light){.index = i,
                                   .source = of->prepared.sources[i],
                                   .distance = share.distance,
                                   .n_dot_l = share.n_dot_l,
                                   .certain = share.certain};
            for (int c = 0; c < 3; c++) {
                to->low[c] = share.low[c];
                to->high[c] = share.high[c];
            }
        }
        ++*count;
    }
}
