/* How far a picture is off at the pixels of a sample, and what that says of the others. */
#ifndef TL_PROMISE_DEVIATION_H
#define TL_PROMISE_DEVIATION_H

#include "sample.h"

typedef struct tl_deviation {
    double mean; /* brightness of the picture */
    double
        exact; /* squares of what channels are off, summed over pixels that were all looked at */
    double
        drawn; /* the same of the others, each drawn pixel counted as often as it stands for one */
    double most; /* that a pixel may have added to `drawn` */
    double
        peak; /* what no pixel outside the sample is taken to be off by, of its brightness and the mean */
} tl_deviation;

/* image: of the sample's frame. What is not finite is off by INFINITY. Fails with TL_ERR_MEMORY. */
tl_status tl_deviation_find(const tl_sample *sample,
                            const tl_image *image,
                            tl_deviation *out,
                            tl_error *err);

/* RMS of the picture over the mean of the reference: as seen on the sample, and an upper bound that holds but
 * for a chance of exp(-doubt). Cannot fail. */
typedef struct tl_estimate {
    double seen, bound;
} tl_estimate;
tl_estimate tl_deviation_rms(const tl_sample *sample, const tl_deviation *of, double doubt);

#endif
