#include "tilelight/check.h"

#include "allowance.h"
#include "parallel.h"
#include "surround.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>
#include <stdlib.h>

struct tl_check {
    const tl_gbuffer *gbuffer; /* in full float */
    tl_gbuffer *unpacked;      /* that, where it had to be made; or NULL */
    const tl_light_set *lights;
    float light_cutoff;
    uint32_t occlusion_samples; /* 0: the default */
    tl_prepared prepared;
    tl_cosine cosine;
    float *planes[TL_PLANE_COUNT]; /* the G-buffer's */
};

static tl_status prepare(tl_check *check, tl_error *err)
{
    enum { ANY_TILE = 16 }; /* there are no tiles here */
    const tl_prepare_options options = {.tile_size = ANY_TILE,
                                        .light_cutoff = check->light_cutoff,
                                        .occlusion_samples = check->occlusion_samples};
    const tl_status status =
        tl_prepare(check->gbuffer, check->lights, &options, NULL, &check->prepared, err);
    if (status == TL_OK)
        tl_reference_surround(&check->prepared, check->gbuffer, TL_TWIN_FLOAT);
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
    made->gbuffer = made->unpacked ? made->unpacked : gbuffer;
    made->cosine = cosine;
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        made->planes[p] = tl_gbuffer_plane(made->gbuffer, (enum tl_plane)p);
    made->lights = lights;
    made->light_cutoff = light_cutoff;
    TRY(prepare(made, err));
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
    tl_prepared_clear(&check->prepared);
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
    check->prepared.approximations = *of;
    if (of->of[TL_KNOB_FORM] == TL_FORM_TEXTBOOK)
        check->cosine = TL_COSINE_TEXTBOOK;
done:
    return status;
}

tl_status tl_check_occlusion(tl_check *check, uint32_t samples, tl_error *err)
{
    const tl_approximations of = check->prepared.approximations;
    check->occlusion_samples = samples;
    const tl_status status = prepare(check, err);
    check->prepared.approximations = of;
    return status;
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
    const tl_check *check = p->check;
    const tl_allowance a =
        tl_allowance_of(&check->prepared, check->planes, x, y, TL_COSINE_TEXTBOOK);
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
    const tl_allowance a =
        tl_allowance_of(&check->prepared, check->planes, x, y, check->cosine);
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
    const tl_camera *camera = &check->gbuffer->camera;
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
    *count = 0;
    for (uint32_t i = 0; i < check->prepared.frame.light_count; i++) {
        tl_light_share share;
        if (!tl_allowance_share(&check->prepared, check->planes, x, y, i, check->cosine,
                                &share))
            continue;
        if (*count < capacity) {
            tl_check_light *to = &out[*count];
            *to = (tl_check_light){.index = i,
                                   .source = check->prepared.sources[i],
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
