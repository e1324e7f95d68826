#define _DEFAULT_SOURCE
#include "aligned.h"

#include <stdlib.h>
#include <sys/mman.h>

static const size_t large_page = 2 << 20;

void *tl_aligned_alloc(size_t size)
{
    const size_t alignment = size >= large_page ? large_page : TL_PAGE;
    const size_t whole = (size + TL_PAGE - 1) / TL_PAGE * TL_PAGE;
    void *memory = NULL;
    if (posix_memalign(&memory, alignment, whole) != 0)
        return NULL;
#ifdef MADV_HUGEPAGE
    if (alignment == large_page)
        madvise(memory, whole, MADV_HUGEPAGE); /* a wish; refused, it costs only speed */
#endif
    return memory;
}
