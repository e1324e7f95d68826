/* By how many of 255 codes a picture is off once it is shown. */
#ifndef TL_PROMISE_CODES_H
#define TL_PROMISE_CODES_H

#include "deviation.h"
#include "goal.h"

/* The largest difference of any channel: as seen on the sample, and an upper bound for all pixels: what the
 * assumption of deviation.c leaves. Where pixels are means of side x side of those that were drawn, nothing is seen
 * of them, 0, unless all were drawn. Fails with TL_ERR_MEMORY. */
tl_status tl_codes_off(const tl_goal *goal,
                       const tl_sample *sample,
                       const tl_deviation *deviation,
                       const tl_image *image,
                       uint32_t side,
                       tl_estimate *out,
                       tl_error *err);

#endif
