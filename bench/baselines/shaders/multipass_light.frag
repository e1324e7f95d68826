// What a pixel receives from one light, added to what is there by blending: the contract of
// kernels/light.h with the language's own pow.
//
// No branches and no discard: llvmpipe runs all of a shader for every block of pixels that it has
// covered, whatever lanes are left, so that a discarded fragment costs its mask as well.
layout(location = UNIFORM_RAYS) uniform vec4 rays; // x0, dx, y0, dy: tl_rays

layout(binding = UNIT_DEPTH) uniform sampler2D depths;
layout(binding = UNIT_NORMAL_EXPONENT) uniform sampler2D normals_exponents; // view space, unit

flat in vec4 light_position_range2;
flat in vec4 light_diffuse_fade;
flat in vec3 light_specular;
flat in int light_falloff;

layout(location = 0) out vec4 diffuse_light;
#ifdef SPECULAR
layout(location = 1) out vec4 specular_light;
#endif

float fade(float distance2, float distance, float per_distance)
{
    float linear = max(0.0, 1.0 - distance * light_diffuse_fade.w);
    float share = distance2 * light_diffuse_fade.w;
    float inverse_square =
        max(0.0, 1.0 - share * share) * min(per_distance * per_distance, 1e4);
#if FALLOFFS == 1 << FADE_LINEAR
    return linear;
#elif FALLOFFS == 1 << FADE_INVERSE_SQUARE
    return inverse_square;
#else
    return light_falloff == FADE_LINEAR           ? linear
           : light_falloff == FADE_INVERSE_SQUARE ? inverse_square
                                                  : 1.0;
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depths, pixel, 0).x;
    vec4 normal_exponent = texelFetch(normals_exponents, pixel, 0);
    vec2 ray = rays.xz + vec2(pixel) * rays.yw;
#ifdef ORTHOGRAPHIC
    vec3 position = vec3(ray, -depth), to_eye = vec3(0.0, 0.0, 1.0);
#else
    vec3 position = vec3(ray * depth, -depth);
    vec3 to_eye = vec3(-ray, 1.0) * inversesqrt(dot(ray, ray) + 1.0);
#endif
    vec3 to_light = light_position_range2.xyz - position;
#if FALLOFFS & 1 << FADE_NONE
    if (light_falloff == FADE_NONE)
        to_light = light_position_range2.xyz;
#endif
    float distance2 = dot(to_light, to_light);
    float per_distance = inversesqrt(distance2);
    float distance = distance2 * per_distance;
    float n_dot_l = dot(normal_exponent.xyz, to_light) * per_distance;
    bool lit = distance2 < light_position_range2.w && n_dot_l > 0.0;
    float weight = fade(distance2, distance, per_distance);

    diffuse_light = vec4(light_diffuse_fade.xyz * (lit ? weight * n_dot_l : 0.0), 0.0);
#ifdef SPECULAR
    // |h|^2 = 2 + 2 l.v and n.h = n.l + n.v for unit l and v.
    float n_dot_h = max(0.0, n_dot_l + dot(normal_exponent.xyz, to_eye));
    float half2 = 2.0 + 2.0 * per_distance * dot(to_light, to_eye);
    float cos2 = n_dot_h * n_dot_h / max(half2, 1e-20);
    float lobe = pow(max(cos2, 1e-30), 0.5 * normal_exponent.w);
    specular_light = vec4(light_specular * (lit ? weight * lobe : 0.0), 0.0);
#endif
}
