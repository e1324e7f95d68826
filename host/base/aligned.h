/* Memory that a CPU device reads and writes in place. */
#ifndef TL_ALIGNED_H
#define TL_ALIGNED_H

#include <stddef.h>
#include <stdlib.h>

/* A page: what CL_MEM_USE_HOST_PTR needs at the least is 64 bytes on PoCL, a page elsewhere. */
enum { TL_PAGE = 4096 };

/* Not cleared; released with free. NULL out of memory. */
static inline void *tl_aligned_alloc(size_t size)
{
    return aligned_alloc(TL_PAGE, (size + TL_PAGE - 1) / TL_PAGE * TL_PAGE);
}

#endif
