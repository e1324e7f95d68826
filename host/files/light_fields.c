#include "light_fields.h"

enum {
    POINT = 1 << TL_LIGHT_POINT,
    DIRECTIONAL = 1 << TL_LIGHT_DIRECTIONAL,
    SPOT = 1 << TL_LIGHT_SPOT,
    PLACED = POINT | SPOT,
    AIMED = DIRECTIONAL | SPOT,
    ANY = POINT | DIRECTIONAL | SPOT
};

const tl_light_field tl_light_fields[TL_LIGHT_FIELD_COUNT] = {
    {"name", TL_FIELD_NAME, offsetof(tl_light, name), ANY, false},
    {"group", TL_FIELD_NAME, offsetof(tl_light, group), ANY, false},
    {"position", TL_FIELD_VECTOR, offsetof(tl_light, position), PLACED, true},
    {"direction", TL_FIELD_UNIT, offsetof(tl_light, direction), AIMED, true},
    {"color", TL_FIELD_VECTOR, offsetof(tl_light, color), ANY, false},
    {"intensity", TL_FIELD_NUMBER, offsetof(tl_light, intensity), ANY, false},
    {"range", TL_FIELD_NUMBER, offsetof(tl_light, range), PLACED, false},
    {"begin", TL_FIELD_NUMBER, offsetof(tl_light, begin), PLACED, false},
    {"falloff", TL_FIELD_FALLOFF, offsetof(tl_light, falloff), PLACED, false},
    {"lut", TL_FIELD_TABLE, offsetof(tl_light, table), PLACED, false},
    {"diffuse", TL_FIELD_NUMBER, offsetof(tl_light, diffuse), ANY, false},
    {"specular", TL_FIELD_NUMBER, offsetof(tl_light, specular), ANY, false},
    {"ambient", TL_FIELD_NUMBER, offsetof(tl_light, ambient), ANY, false},
    {"innerConeAngle", TL_FIELD_NUMBER, offsetof(tl_light, inner_cone), SPOT, false},
    {"outerConeAngle", TL_FIELD_NUMBER, offsetof(tl_light, outer_cone), SPOT, false},
    {"texture", TL_FIELD_IMAGE, offsetof(tl_light, texture), PLACED, false},
    {"up", TL_FIELD_UNIT, offsetof(tl_light, up), PLACED, false},
    {"castsShadow", TL_FIELD_FLAG, offsetof(tl_light, casts_shadow), ANY, false},
};
