/* Layers before a scene: what it would look like through panes that follow its surfaces. */
#ifndef TL_BENCH_LAYERS_H
#define TL_BENCH_LAYERS_H

#include "tilelight/gbuffer.h"

/* Adds `count` layers to a frame in full float. Each has the frame's surfaces in a window in its middle that
 * is 1/part of the picture, of its form; nearer by 1 % for each layer behind it; and lets half of what is
 * behind it through. Fails with TL_ERR_MEMORY. */
tl_status tl_bench_layers_add(tl_gbuffer *gbuffer,
                              uint32_t count,
                              uint32_t part,
                              tl_error *err);

#endif
