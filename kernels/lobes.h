/* What a surface reflects of one light, by the model of each lane. */
#ifndef TL_LOBES_H
#define TL_LOBES_H

#include "lobe_plain.h"

TL_INLINE reflection reflection_of(tl_needs needs, surface s, finish f, meeting m)
{
    reflection r = {R(0.0), R(0.0), R(0.0)};
    if (some_lobe_has(needs, TL_LOBE_PLAIN))
        r = plain_reflection(needs, s, m, lane_has(needs, f.model, TL_LOBE_SPECULAR),
                             lane_has(needs, f.model, TL_LOBE_COSINE));
    return r;
}

#endif
