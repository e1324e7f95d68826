/* Parts of a frame that the eye takes in at once, lit by the reference: what FLIP of a picture is estimated
 * on. FLIP of a pixel depends on those around it, so single pixels say nothing. */
#ifndef TL_PROMISE_WINDOWS_H
#define TL_PROMISE_WINDOWS_H

#include "deviation.h"
#include "goal.h"

typedef struct tl_window {
    uint32_t x, y, width, height; /* px of the picture: what counts */
    uint32_t around_x, around_y;  /* where the pixels begin that FLIP looks at for that */
    tl_image *reference;          /* of these, owned */
} tl_window;

typedef struct tl_windows {
    uint32_t count,
        cell_count; /* windows; of which so many cover the picture, each as likely a window */
    tl_window *of;  /* [count] */
    uint32_t side;  /* samples of a pixel: side x side */
    double seconds; /* that drawing and lighting them took */
} tl_windows;

/* pixels: that the reference may light, about; the whole picture is one window where it has no more. The
 * caller releases *out with tl_windows_destroy. Fails as tl_prepare does. */
tl_status tl_windows_draw(const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          double pixels,
                          uint64_t seed,
                          tl_windows **out,
                          tl_error *err);

/* Accepts NULL. */
void tl_windows_destroy(tl_windows *windows);

/* What FLIP sums up to in a window: of a picture of pixels, not of samples, at this exposure. Fails with
 * TL_ERR_MEMORY. */
tl_status tl_window_flip(const tl_window *window,
                         const tl_goal *goal,
                         const tl_image *image,
                         float exposure,
                         double *sum,
                         tl_error *err);

/* Mean FLIP of the picture's codes against those of the reference: as seen in windows, and an upper bound
 * that holds but for a chance of exp(-doubt), if no part of the picture is more than four times as far off as
 * the worst that was seen. image: of the frame's size. Fails with TL_ERR_MEMORY. */
tl_status tl_windows_flip(const tl_windows *windows,
                          const tl_goal *goal,
                          const tl_image *image,
                          double doubt,
                          tl_estimate *out,
                          tl_error *err);

#endif
