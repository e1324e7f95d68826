/* What numbers of a depth buffer mean, by the definitions of the conventions (docs/layouts.md, "Position from
 * depth"). Nothing is shared with kernels/depth_code.h. Off by 8v of the largest of what is added,
 * v = 2^-113. */
#ifndef TL_ORACLE_DEPTH_BUFFER_H
#define TL_ORACLE_DEPTH_BUFFER_H

#include "oracle/depth.h"

enum tl_oracle_convention {
    TL_ORACLE_FORWARD,  /* 0 near, 1 far */
    TL_ORACLE_NDC,      /* -1 near, 1 far */
    TL_ORACLE_REVERSED, /* 1 near, 0 far */
    TL_ORACLE_FRACTION  /* 0 near, 1 far, linear in depth whatever the camera */
};

/* 1 near, 0 far. */
static inline wide tl_oracle_nearness(enum tl_oracle_convention of, wide stored)
{
    return of == TL_ORACLE_REVERSED ? stored
           : of == TL_ORACLE_NDC    ? (1 - stored) / 2
                                    : 1 - stored;
}

/* m, in front of the far end. */
static inline wide tl_oracle_depth(enum tl_oracle_convention of, tl_depth_range in, wide stored)
{
    const wide q = tl_oracle_nearness(of, stored), near = in.near, far = in.far;
    if (in.linear)
        return far - q * (far - near);
    return isinfq(far) ? near / q : near * far / (near + q * (far - near));
}

#endif
