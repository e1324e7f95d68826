/* Is a lit picture right? Every value is held against the reference in double and against an interval
 * that any correct shading in float stays in. The interval is derived per pixel and per light, from the
 * rounding of each step (host/reference/allowance.c), not chosen. */
#ifndef TL_CHECK_H
#define TL_CHECK_H

#include "approximations.h"
#include "gbuffer.h"
#include "image.h"
#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, word on the command line, meaning) */
#define TL_COSINES(X)                                                                          \
    X(TL_COSINE_STABLE, "stable", "by its sine near the peak: the error is that of the angle") \
    X(TL_COSINE_TEXTBOOK, "textbook", "pow(n.h, e): the rounding of n.h counts e times")

/* How the shading takes its specular cosine. */
typedef enum tl_cosine {
#define TL_COSINE_NAME(name, word, meaning) name,
    TL_COSINES(TL_COSINE_NAME)
#undef TL_COSINE_NAME
        TL_COSINE_COUNT
} tl_cosine;

/* What a frame should look like. */
typedef struct tl_check tl_check;

/* gbuffer (repaired) and lights are borrowed while *out lives; layers are blended. Of a packed G-buffer the
 * frame is what tl_gbuffer_unpack makes of it, in which every position is on its pixel's ray: that is what
 * pictures have to be lit from, as they are by a user's kernel. light_cutoff as in tl_lighting_options. The
 * caller releases *out with tl_check_destroy. Fails with TL_ERR_ARGUMENT, TL_ERR_FORMAT (a row of materials
 * leads nowhere, an index has none) or TL_ERR_MEMORY. */
tl_status tl_check_create(const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          float light_cutoff,
                          tl_cosine cosine,
                          tl_check **out,
                          tl_error *err);

/* Accepts NULL. */
void tl_check_destroy(tl_check *check);

/* From now on pictures may be off by so much more as these are (kernels/knobs.h). The textbook's form brings
 * TL_COSINE_TEXTBOOK. Fails with TL_ERR_ARGUMENT, naming one that nobody bounds. */
tl_status tl_check_allow(tl_check *check, const tl_approximations *of, tl_error *err);

/* From now on ambient occlusion is that of so many samples (tl_lighting_options.occlusion_samples). What
 * share of ambient light arrives is given to every shading kernel, so it is taken as our kernels in float
 * compute it, and allows for nothing. Fails with TL_ERR_ARGUMENT or TL_ERR_MEMORY; *check can then be
 * destroyed alone. */
tl_status tl_check_occlusion(tl_check *check, uint32_t samples, tl_error *err);

/* From now on pictures are of the nearest layers, so many at most: tl_lighting_options.layers. */
void tl_check_layers(tl_check *check, uint32_t most);

/* One value of a picture beside what it may be. */
typedef struct tl_check_value {
    uint32_t x, y, channel;
    float got;
    double expected, low, high; /* low <= expected <= high */
    double ratio; /* |got - expected| over what is allowed on that side; within is 0 to 1;
                     INFINITY where nothing is allowed, or got is not finite */
} tl_check_value;

typedef struct tl_check_report {
    uint64_t pixel_count;      /* of the picture, padding left out */
    uint64_t failed_count;     /* pixels with a value outside its interval */
    uint64_t not_finite_count; /* of those, with a value that is NaN or infinite */
    uint64_t excused_count;    /* of those, right if TL_COSINE_TEXTBOOK were allowed */
    double rounding_ratio;     /* largest of pixels where no light hangs on rounding */
    tl_check_value worst; /* of largest ratio, the first row by row; all 0 if none is above 0 */
} tl_check_report;

/* Holds a picture of the G-buffer's size against the frame, on all threads. ratios (may be NULL)
 * has that size too and gets the ratio of every value, INFINITY included. Fails with
 * TL_ERR_ARGUMENT (sizes differ) or TL_ERR_MEMORY; a picture that is wrong is no failure. */
tl_status tl_check_image(const tl_check *check,
                         const tl_image *image,
                         tl_image *ratios,
                         tl_check_report *out,
                         tl_error *err);

/* A light that reaches a pixel. */
typedef struct tl_check_light {
    uint32_t index;  /* in the kernel's buffer: lights without a range first */
    uint32_t source; /* in the light set */
    double distance; /* m; 1 of a directional light */
    double n_dot_l;
    bool certain;           /* false: rounding may decide whether it adds anything */
    double low[3], high[3]; /* what it adds, linear Rec. 709 */
} tl_check_light;

/* The lights that add to pixel (x, y) of the surfaces, behind all layers, in index order: *count of them, of
 * which the first `capacity` are written to out. Cannot fail. */
void tl_check_lights(const tl_check *check,
                     uint32_t x,
                     uint32_t y,
                     tl_check_light *out,
                     size_t capacity,
                     size_t *count);

#ifdef __cplusplus
}
#endif

#endif
