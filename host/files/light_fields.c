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
    {"name", TL_FIELD_NAME, offsetof(tl_light, name), ANY, 0},
    {"group", TL_FIELD_NAME, offsetof(tl_light, group), ANY, 0},
    {"position", TL_FIELD_VECTOR, offsetof(tl_light, position), PLACED, PLACED},
    {"direction", TL_FIELD_UNIT, offsetof(tl_light, direction), ANY, AIMED},
    {"color", TL_FIELD_VECTOR, offsetof(tl_light, color), ANY, 0},
    {"intensity", TL_FIELD_NUMBER, offsetof(tl_light, intensity), ANY, 0},
    {"range", TL_FIELD_NUMBER, offsetof(tl_light, range), PLACED, 0},
    {"begin", TL_FIELD_NUMBER, offsetof(tl_light, begin), PLACED, 0},
    {"falloff", TL_FIELD_FALLOFF, offsetof(tl_light, falloff), PLACED, 0},
    {"lut", TL_FIELD_TABLE, offsetof(tl_light, table), PLACED, 0},
    {"diffuse", TL_FIELD_NUMBER, offsetof(tl_light, diffuse), ANY, 0},
    {"specular", TL_FIELD_NUMBER, offsetof(tl_light, specular), ANY, 0},
    {"ambient", TL_FIELD_NUMBER, offsetof(tl_light, ambient), ANY, 0},
    {"innerConeAngle", TL_FIELD_NUMBER, offsetof(tl_light, inner_cone), SPOT, 0},
    {"outerConeAngle", TL_FIELD_NUMBER, offsetof(tl_light, outer_cone), SPOT, 0},
    {"texture", TL_FIELD_IMAGE, offsetof(tl_light, texture), PLACED, 0},
    {"profile", TL_FIELD_PROFILE, offsetof(tl_light, profile), PLACED, 0},
    {"profileScale", TL_FIELD_SCALE, offsetof(tl_light, profile_scale), PLACED, 0},
    {"up", TL_FIELD_UNIT, offsetof(tl_light, up), PLACED, 0},
    {"link", TL_FIELD_LINK, offsetof(tl_light, link), ANY, 0},
    {"castsShadow", TL_FIELD_FLAG, offsetof(tl_light, casts_shadow), ANY, 0},
};
