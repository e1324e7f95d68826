/* What a surface reflects of one light, by the model of each lane. */
#ifndef TL_LOBES_H
#define TL_LOBES_H

#include "lobe_cook_torrance.h"
#include "lobe_metal_rough.h"
#include "lobe_minnaert.h"
#include "lobe_oren_nayar.h"
#include "lobe_phong_reflection.h"
#include "lobe_plain.h"
#include "lobe_ward.h"

TL_INLINE reflection pick_reflection(mask which, reflection a, reflection b)
{
    const reflection r = {pick(which, a.diffuse, b.diffuse),
                          pick(which, a.specular, b.specular),
                          pick(which, a.grazing, b.grazing)};
    return r;
}

TL_INLINE reflection reflection_of(tl_needs needs, surface s, finish f, meeting m)
{
    reflection r = {R(0.0), R(0.0), R(0.0)};
    if (some_lobe_has(needs, TL_LOBE_PLAIN))
        r = plain_reflection(needs, s, m, lane_has(needs, f.model, TL_LOBE_SPECULAR),
                             lane_has(needs, f.model, TL_LOBE_COSINE));
/* Lanes of other models are 0 where nothing plain was computed, and NaN nowhere. */
#define TL_TAKE(which, lobe)                                            \
    if (uses_models(needs, which)) {                                    \
        const mask lanes = reflects_by_one_of(needs, f.model, (which)); \
        if (any_lane(lanes))                                            \
            r = pick_reflection(lanes, (lobe), r);                      \
    }
    TL_TAKE(1u << TL_MODEL_PHONG_REFLECTION, phong_reflection(needs, s, m))
    TL_TAKE(1u << TL_MODEL_OREN_NAYAR, oren_nayar_reflection(s, f, m))
    TL_TAKE(1u << TL_MODEL_WARD | 1u << TL_MODEL_WARD_ANISOTROPIC,
            ward_reflection(needs, s, f, m))
    TL_TAKE(1u << TL_MODEL_COOK_TORRANCE, cook_torrance_reflection(s, f, m))
    TL_TAKE(1u << TL_MODEL_MINNAERT, minnaert_reflection(f, m))
    TL_TAKE(1u << TL_MODEL_METAL_ROUGH, metal_rough_reflection(needs, s, f, m))
#undef TL_TAKE
    return r;
}

#endif
