// Material pass: what the surface is made of. How it is stored comes behind (layout.glsl).
in vec3 view_position;
in vec3 world_normal;
in vec4 world_tangent;

layout(location = UNIFORM_WORLD_FROM_VIEW) uniform mat3 world_from_view;
layout(location = UNIFORM_EMISSIVE) uniform vec3 emissive_factor;
layout(location = UNIFORM_FACTORS) uniform vec4 factors;
layout(location = UNIFORM_BRDF) uniform float brdf_index;

#ifdef HAS_METALLIC_ROUGHNESS
layout(binding = SLOT_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_texture;
#endif
#ifdef HAS_NORMAL_MAP
layout(binding = SLOT_NORMAL_MAP) uniform sampler2D normal_map;
#endif
#ifdef HAS_OCCLUSION
layout(binding = SLOT_OCCLUSION) uniform sampler2D occlusion_texture;
#endif
#ifdef HAS_EMISSIVE
layout(binding = SLOT_EMISSIVE) uniform sampler2D emissive_texture;
#endif

// What a pixel shows.
struct surface {
    vec3 position; // view space, m
    vec3 normal;   // world space; not a number where the file gives none to be had
    vec3 albedo, specular, emissive;
    float shininess, metallic, roughness, occlusion;
    float brdf;   // index of the BRDF, 0: none
    vec3 tangent; // world space; unit, or 0 where there is none
};

// The interpolated normal; where the file has none to interpolate, that of the triangle.
vec3 surface_normal()
{
    vec3 n = world_normal;
    if (dot(n, n) == 0.0) {
        n = world_from_view * cross(dFdx(view_position), dFdy(view_position));
        n = dot(n, world_from_view * view_position) > 0.0 ? -n : n;
        n = gl_FrontFacing ? n : -n;
    }
    return normalize(n);
}

vec3 surface_tangent()
{
    float length2 = dot(world_tangent.xyz, world_tangent.xyz);
    return length2 > 0.0 ? world_tangent.xyz * inversesqrt(length2) : vec3(0.0);
}

#ifdef HAS_NORMAL_MAP
// As MikkTSpace wants it: the interpolated vectors as they are, one normalisation at the end.
vec3 mapped_normal(vec3 mapped)
{
    vec3 bitangent = world_tangent.w * cross(world_normal, world_tangent.xyz);
    return mapped.x * world_tangent.xyz + mapped.y * bitangent + mapped.z * world_normal;
}
#endif

vec3 shading_normal()
{
    vec3 n = surface_normal();
#ifdef HAS_NORMAL_MAP
    vec3 mapped = look_up(normal_map, SLOT_NORMAL_MAP).xyz * 2.0 - 1.0;
    n = normalize(mapped_normal(mapped * vec3(factors.zz, 1.0)));
#endif
    return gl_FrontFacing ? n : -n;
}

surface visible_surface()
{
    vec4 base = base_color();
    float metallic = factors.x, roughness = factors.y, occlusion = 1.0;
    vec3 emitted = emissive_factor;
#ifdef ALPHA_TEST
    if (base.a < alpha_cutoff)
        discard;
#endif
#ifdef UNLIT
    // KHR_materials_unlit: what it shows it sends out. A metal without colour is what reflects
    // exactly nothing (kernels/material.h): no diffuse light, for it is a metal, and no
    // highlight, for a metal's has its colour.
    return surface(view_position, shading_normal(), vec3(0.0), vec3(0.0),
                   clamp(base.rgb, 0.0, 1.0), 0.0, 1.0, 1.0, 1.0, 0.0, vec3(0.0));
#endif
#ifdef HAS_METALLIC_ROUGHNESS
    vec4 rough = look_up(metallic_roughness_texture, SLOT_METALLIC_ROUGHNESS);
    metallic *= rough.b;
    roughness *= rough.g;
#endif
#ifdef HAS_OCCLUSION
    float open = look_up(occlusion_texture, SLOT_OCCLUSION).r;
    occlusion = 1.0 + factors.w * (open - 1.0);
#endif
#ifdef HAS_EMISSIVE
    emitted *= look_up(emissive_texture, SLOT_EMISSIVE).rgb;
#endif
    // The interpolated view position is as exact as depth gets here, a few units of 2^-24, and serves
    // every projection: 1 / gl_FragCoord.w is the same number but for orthographic cameras, and
    // undoing the reversed depth adds the roundings of near, far and the quotient.
    return surface(view_position, shading_normal(), clamp(base.rgb, 0.0, 1.0), vec3(0.0), emitted, 0.0,
                   metallic, roughness, occlusion, brdf_index, surface_tangent());
}

#ifdef LAYER
layout(binding = SLOT_FRONT) uniform sampler2D front;
layout(binding = SLOT_CHOICE) uniform sampler2D choice;
#endif

// Of a layer the one surface that was chosen for the pixel. Behind all that asks for derivatives, which
// fragments that are discarded do not have.
void keep_fragment()
{
#ifdef LAYER
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (gl_FragCoord.z != texelFetch(front, at, 0).r ||
        rank_of_fragment() != texelFetch(choice, at, 0).r)
        discard;
#    ifdef FORWARD_DEPTH
    gl_FragDepth = 1.0 - gl_FragCoord.z;
#    endif
#endif
}
