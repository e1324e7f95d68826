/* Layers of surfaces that blend with what lies behind them. Capture peels them, a G-buffer owns them, files
 * hold them, lighting lights each and blends them (kernels/blend.h).
 *
 * A layer is a G-buffer of its own: the same camera, layout, planes and samples, what is not there being sky;
 * beside that an opacity. Layer 0 has the surface of each pixel that is nearest, layer 1 the next one behind
 * it, all before the G-buffer's own surface, which hides what is behind it. */
#ifndef TL_LAYERS_H
#define TL_LAYERS_H

#include "error.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TL_MOST_LAYERS = 64, TL_DEFAULT_LAYERS = 8 };

struct tl_gbuffer;

/* All zero is none. */
typedef struct tl_layers {
    uint32_t count;         /* TL_MOST_LAYERS at most */
    struct tl_gbuffer **of; /* [count], nearest first; owned */
    uint64_t left;          /* pixels in which one more would show something */
} tl_layers;

/* Appends an empty layer of `of`, all sky and opacity 0, which of->layers owns: *out, which may be NULL.
 * Fails with TL_ERR_MEMORY. */
tl_status tl_layers_add(struct tl_gbuffer *of, struct tl_gbuffer **out, tl_error *err);

/* Of layers of the same extent. */
void tl_layer_copy_opacity(const struct tl_gbuffer *from, struct tl_gbuffer *to);

/* The share of the picture that one more layer would change, 0 to 1. */
double tl_layers_left_share(const struct tl_gbuffer *of);

/* The share of the picture in which layer `index` has a surface. */
double tl_layer_coverage(const struct tl_gbuffer *of, uint32_t index);

/* Leaves none. */
void tl_layers_clear(tl_layers *layers);

#ifdef __cplusplus
}
#endif

#endif
