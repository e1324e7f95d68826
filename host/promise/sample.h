/* Pixels of a frame at which pictures are held against the reference, and the reference there.
 *
 * Every tile is a stratum: some of its pixels are drawn, evenly and without putting back, more where the
 * picture is bright. Taken whole are the pixels at which float may be off by far more than elsewhere
 * (rims.h), and the tiles at most risk beside them: those with the longest lists, the brightest, those with
 * the greatest range of depths. A picture that is small, or has few lights, is taken whole. */
#ifndef TL_PROMISE_SAMPLE_H
#define TL_PROMISE_SAMPLE_H

#include "rims.h"
#include "some_pixels.h"

#include "tilelight/image.h"

/* Pixels that are drawn alike. */
typedef struct tl_stratum {
    uint32_t size, drawn; /* pixels; drawn <= size */
} tl_stratum;

typedef struct tl_sample {
    uint32_t width, height; /* px, of the picture */
    uint32_t tiles_x, tiles_y;
    uint32_t stratum_count; /* tiles, and last the pixels at rims */
    tl_stratum *strata;     /* [stratum_count]; tiles: without what is at rims */
    size_t count;           /* pixels that were drawn */
    tl_pixel_at *at;        /* [count], tile by tile */
    uint32_t *stratum;      /* [count] */
    /* [count], linear Rec. 709, as the picture of the reference has it */
    float (*reference)[3];
    /* lights that a pixel is looked at with, in the mean, and as many as the rest of it costs */
    double pixel_cost;
    double seconds; /* that finding, drawing and lighting it took */
} tl_sample;

typedef struct tl_sample_options {
    uint64_t seed;
    /* of pixel and light that the reference may look at, about; more for pixels at rims */
    double pairs;
    uint32_t rim_most; /* pixels at rims that are taken, at most */
} tl_sample_options;

/* So many pairs that they take about a tenth of a second on two processors. */
tl_sample_options tl_sample_options_default(void);

/* Draws a sample for pictures of this frame. guide: one of them, of the frame's size, whose brightness
 * decides where more pixels are drawn. The caller releases *out with tl_sample_destroy. Fails as tl_prepare
 * does. */
tl_status tl_sample_draw(const tl_gbuffer *gbuffer,
                         const tl_light_set *lights,
                         const tl_image *guide,
                         const tl_sample_options *options,
                         tl_sample **out,
                         tl_error *err);

/* Accepts NULL. */
void tl_sample_destroy(tl_sample *sample);

/* Whether every pixel was drawn. */
int tl_sample_is_whole(const tl_sample *sample);

#endif
