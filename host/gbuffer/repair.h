/* Pixels that cannot be lit, as tl_gbuffer_repair finds them: in full float (repair.c) and as layouts pack
 * them (repair_packed.c). */
#ifndef TL_REPAIR_H
#define TL_REPAIR_H

#include "largest.h"
#include "tilelight/gbuffer.h"

#include <math.h>
#include <stdatomic.h>

/* The largest value that a plane behind the normal may have. */
static inline float tl_largest_value(int plane)
{
    return plane == TL_SHININESS    ? 10000.0f
           : plane >= TL_TANGENT_X  ? TL_LONGEST
           : plane == TL_BRDF       ? (float)TL_MAX_MATERIALS
           : plane >= TL_EMISSIVE_R ? TL_BRIGHTEST
                                    : 1.0f;
}

/* What a value of a plane behind the normal becomes. Not finite or negative: 0. Above the largest: that
 * one. But indices become none then, for the largest is another material's; and vectors, which may be
 * negative, lose such a component. */
static inline float tl_repaired_value(int plane, float value)
{
    const float most = tl_largest_value(plane);
    if (plane == TL_BRDF)
        return value >= 0.0f && value <= most && value == floorf(value) ? value : 0.0f;
    if (plane >= TL_TANGENT_X)
        return value >= -most && value <= most ? value : 0.0f;
    return value >= 0.0f && value <= most    ? value
           : value > most && isfinite(value) ? most
                                             : 0.0f;
}

/* Beside the planes: some surface may reflect light. Those that do not are black by themselves and in their
 * highlights; a metal-rough one is that where the base is black and metallic is 1. */
#define TL_REFLECTS (1u << 31)

/* What all threads found together. */
typedef struct tl_faults {
    atomic_ullong depth, normal, value;
    atomic_ullong first; /* row << 40 | column << 8 | plane of the first, for messages */
    atomic_uint indices[TL_INDEX_WORDS]; /* as tl_gbuffer has them */
    /* not neutral in some pixel, bits 1 << plane; of a colour one; TL_REFLECTS */
    atomic_uint telling;
} tl_faults;

/* Planes whose absence means something, so that they may be neutral. An exponent is of no matter where
 * the colour of its lobe is neutral, and says nothing alone. */
#define TL_MAY_BE_NEUTRAL                                                                      \
    (TL_THREE(TL_SPECULAR_R) | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE | \
     TL_GROUP_BRDF | TL_GROUP_TANGENT)

/* What some rows have: added to the others at their end. */
typedef struct tl_fault_counts {
    unsigned long long depth, normal, value;
} tl_fault_counts;

void tl_faults_add(tl_faults *faults, tl_fault_counts counts);

/* Indices that some rows have: added to the others at their end. */
typedef struct tl_index_set {
    uint32_t bits[TL_INDEX_WORDS];
} tl_index_set;

static inline void tl_index_note(tl_index_set *set, uint32_t index)
{
    set->bits[index / 32] |= 1u << index % 32;
}

void tl_faults_add_indices(tl_faults *faults, const tl_index_set *set);

/* plane: the first of the attribute that is at fault. */
void tl_faults_note(tl_faults *faults, uint32_t row, uint32_t column, int plane);

/* Where a plane is named, that of a layer's opacity. */
enum { TL_OPACITY_FAULT = TL_PLANE_COUNT };

/* Of a layer whose words are repaired: where there is sky, opacity is 0. Finds the rows that show something.
 * */
void tl_repair_opacity(tl_gbuffer *layer, tl_faults *faults);

/* Of a G-buffer that is not in full float; finds its slack. */
void tl_repair_packed(tl_gbuffer *gbuffer, tl_faults *faults);

#endif
