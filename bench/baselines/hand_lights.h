/* What both arithmetics of the hand-written baselines do alike with the lights of a block: which of
 * them may add anything, and how they fade. */
#ifndef TL_HAND_LIGHTS_H
#define TL_HAND_LIGHTS_H

#include "hand_surface.h"

#include <string.h>

enum { CHUNK = 32 }; /* lights of a list that are taken through the loops together */

LANES_INLINE lanes3 towards(const block_surface *s, const tl_view_light *light)
{
    return (lanes3){all(light->position[0]) - s->position.x,
                    all(light->position[1]) - s->position.y,
                    all(light->position[2]) - s->position.z};
}

/* Writes those of list[0] to list[count - 1] that reach the block and stand above it, in order;
 * returns how many. Without a branch: who is kept is not predictable. */
LANES_INLINE size_t keep_lights(block_surface s,
                                const tl_view_light *const *list,
                                size_t count,
                                const tl_view_light *kept[CHUNK])
{
    size_t kept_count = 0;
    for (size_t i = 0; i < count; i++) {
        const lanes3 l = towards(&s, list[i]);
        const lane_mask lit =
            both(below(dot(l, l), all(list[i]->range2)), below(all(0.0f), dot(s.normal, l)));
        kept[kept_count] = list[i];
        kept_count += bits_of(lit) != 0;
    }
    return kept_count;
}

LANES_INLINE lanes fade(const tl_view_light *light,
                        lanes distance2,
                        lanes distance,
                        lanes per_distance)
{
    if (light->falloff == TL_FADE_LINEAR)
        return larger(fused_from(distance, all(light->fade), all(1.0f)), all(0.0f));
    if (falloff_row(light->falloff) == TL_FADE_LINEAR_FROM) {
        float offset;
        memcpy(&offset, &light->falloff, sizeof offset);
        const lanes weight = fused_from(distance, all(light->fade), all(offset));
        return larger(smaller(weight, all(1.0f)), all(0.0f));
    }
    const lanes share = distance2 * light->fade;
    const lanes window = fused_from(share, share, all(1.0f));
    return larger(window, all(0.0f)) * smaller(per_distance * per_distance, all(1e4f));
}

#endif
