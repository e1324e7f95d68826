/* Memory that a CPU device reads and writes in place. */
#ifndef TL_ALIGNED_H
#define TL_ALIGNED_H

#include <stddef.h>

/* A page: what CL_MEM_USE_HOST_PTR needs at the least is 64 bytes on PoCL, a page elsewhere. */
enum { TL_PAGE = 4096 };

/* Aligned to TL_PAGE, not cleared; released with free. NULL out of memory. Large blocks ask for large
 * pages where the system has them: a tile touches a page per row and plane (1080p with next to no
 * lights: x 0.88 of the time, 7680x4320: x 0.8). */
void *tl_aligned_alloc(size_t size);

#endif
