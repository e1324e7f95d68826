/* Lights of a set switched off or scaled, by what they are called. */
#ifndef TL_LIGHT_CONTROL_H
#define TL_LIGHT_CONTROL_H

#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Which lights `name` stands for.
 * X(name, the option that says it, what it selects) */
#define TL_LIGHT_CONTROLS(X)                                              \
    X(TL_CONTROL_LIGHT, "--light", "lights by name, index or pattern")    \
    X(TL_CONTROL_GROUP, "--group", "lights of groups by name or pattern") \
    X(TL_CONTROL_SOLO, "--solo", "both; all others are off")

typedef enum tl_light_control_kind {
#define TL_LIGHT_CONTROL_NAME(name, option, selects) name,
    TL_LIGHT_CONTROLS(TL_LIGHT_CONTROL_NAME)
#undef TL_LIGHT_CONTROL_NAME
        TL_LIGHT_CONTROL_COUNT
} tl_light_control_kind;

extern const char *const tl_light_control_options[TL_LIGHT_CONTROL_COUNT];

typedef struct tl_light_control {
    tl_light_control_kind kind;
    /* What lights, or groups, are called, in full; else a light's index in the set; else a pattern with
     * *, ? and [...]. The caller's */
    const char *name;
    float scale; /* of the intensity, 0 to 1e30; of no meaning for TL_CONTROL_SOLO */
} tl_light_control;

/* Multiplies the intensity of every light that a control selects with its scale: 0 is off, and is not lit. Of
 * several controls all count, in any order; where some are TL_CONTROL_SOLO, lights that none of those selects
 * are off. Fails with TL_ERR_ARGUMENT, and leaves the set alone, for a name that selects nothing, in a
 * sentence that says what there is, and for an intensity beyond 1e30; with TL_ERR_MEMORY. */
tl_status tl_light_set_control(tl_light_set *set,
                               const tl_light_control *controls,
                               size_t count,
                               tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
