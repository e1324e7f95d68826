/* The fields of a light in a lights file: one table for reading and writing. */
#ifndef TL_LIGHT_FIELDS_H
#define TL_LIGHT_FIELDS_H

#include "light_words.h"

#include <stdbool.h>
#include <stddef.h>

/* Both reading and writing hold the text in memory, reading as a tree some 20 times its size. */
#define TL_LIGHTS_TEXT_LIMIT ((size_t)64 << 20) /* bytes */

typedef enum tl_field_kind {
    TL_FIELD_NUMBER,  /* float */
    TL_FIELD_VECTOR,  /* float [3] */
    TL_FIELD_UNIT,    /* float [3] of length 1 */
    TL_FIELD_FALLOFF, /* tl_falloff, as its word */
    TL_FIELD_NAME,    /* char [64] */
    TL_FIELD_TABLE,   /* uint32_t: 1 + index of the set's tables, as an array of numbers */
    TL_FIELD_IMAGE,   /* uint32_t: 1 + index of the set's images, as a path */
    TL_FIELD_PROFILE, /* uint32_t: 1 + index of the set's profiles, as a path */
    TL_FIELD_SCALE,   /* tl_profile_scale, as its word */
    TL_FIELD_FLAG,    /* uint32_t: 0 or 1, as false or true */
    TL_FIELD_LINK     /* uint32_t: 1 + index of the set's links, as an object */
} tl_field_kind;

typedef struct tl_light_field {
    const char *name;
    tl_field_kind kind;
    size_t offset;        /* in tl_light */
    unsigned types;       /* bit t: lights of type t may have it */
    unsigned required_by; /* those that must; for others tl_light_default has the default */
} tl_light_field;

enum { TL_LIGHT_FIELD_COUNT = 21 };

/* `type` itself is not among them: it decides which of them apply. Of point lights those alone have a
 * direction that have a profile. */
extern const tl_light_field tl_light_fields[TL_LIGHT_FIELD_COUNT];

#define TL_ANY_SKY (-1)

/* A field of the sky, whose `type` is none of them. */
typedef struct tl_sky_field {
    const char *name;
    int type; /* a tl_sky that has it, or TL_ANY_SKY */
    tl_field_kind kind;
    size_t offset; /* in tl_light_set */
    bool is_required;
} tl_sky_field;

enum { TL_SKY_FIELD_COUNT = 8 };
extern const tl_sky_field tl_sky_fields[TL_SKY_FIELD_COUNT];

#endif
