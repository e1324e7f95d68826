/* What bounds lose of the spheres that have names. */
#ifndef TL_TEST_NAMED_LOSSES_H
#define TL_TEST_NAMED_LOSSES_H

#include "bounds/sphere_families.h"

/* Pixels of 1920 x 1080, in a view of 60 degrees. */
typedef struct tl_named_loss {
    uint64_t seen;         /* whose rays may meet the sphere, by each axis */
    uint64_t listing_16;   /* of those lost by tl_listing_16 */
    uint64_t mara_mcguire; /* by tl_mara_mcguire */
    uint64_t ours;         /* by tl_sphere_bounds */
} tl_named_loss;

tl_named_loss tl_lose_named(const tl_named_sphere *named);

#endif
