/* What models take of a surface beside its colours, once for all lights. */
#ifndef TL_FINISH_H
#define TL_FINISH_H

#include "substance.h"
#include "surface.h"

TL_INLINE finish finish_of(tl_needs needs, surface s, substance m)
{
    finish f;
    (void)needs;
    (void)s;
    f.model = m.model;
    return f;
}

#endif
