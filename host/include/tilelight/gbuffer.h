/* A captured G-buffer in memory: the camera, and float planes in one aligned block.
 *
 * The meeting point of the two halves: capture makes it, lighting reads it, files hold it. The
 * block is laid out as kernels read it, so a CPU device lights it without a copy. */
#ifndef TL_GBUFFER_H
#define TL_GBUFFER_H

#include "camera.h"
#include "planes.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Rows and pitch are multiples of this: the largest tile, and more than a cache line. */
enum { TL_PADDING = 64 };

typedef struct tl_gbuffer {
    tl_camera camera;
    uint32_t present; /* bit p: plane p is stored; a union of TL_GROUP_... with TL_GROUP_BASE */
    uint32_t
        pitch;     /* floats from row to row: at least camera.width, a multiple of TL_PADDING */
    uint32_t rows; /* camera.height up to a multiple of TL_PADDING */
    float *planes; /* [popcount(present)][rows][pitch], aligned to 4096 bytes; padding is sky */
} tl_gbuffer;

/* Every pixel is sky. The caller releases *out with tl_gbuffer_destroy. Fails with
 * TL_ERR_ARGUMENT (tl_camera_check; an incomplete group in `present`; both the Phong and the
 * metal-rough group) or TL_ERR_MEMORY. */
tl_status tl_gbuffer_create(const tl_camera *camera,
                            uint32_t present,
                            tl_gbuffer **out,
                            tl_error *err);

/* Accepts NULL. */
void tl_gbuffer_destroy(tl_gbuffer *gbuffer);

/* [rows][pitch], owned by the G-buffer; NULL where the plane is absent. */
float *tl_gbuffer_plane(const tl_gbuffer *gbuffer, enum tl_plane plane);

/* What tl_gbuffer_repair found, in pixels. */
typedef struct tl_repairs {
    uint64_t depth;  /* NaN, negative infinity, or <= 0 under a perspective camera: made sky */
    uint64_t normal; /* not finite, or of no length: made 0, which no light reaches */
    uint64_t value;  /* another plane not finite, negative, or above its range: made 0 or cut */
} tl_repairs;

/* Makes every pixel safe to light, and sky pixels hold the values of `TL_PLANES` for nothing hit.
 * On all threads. *out may be NULL. With `strict`, fails with TL_ERR_FORMAT at the first pixel
 * that would need it, naming pixel and channel, and `name` (a file) in front. */
tl_status tl_gbuffer_repair(
    tl_gbuffer *gbuffer, const char *name, bool strict, tl_repairs *out, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
