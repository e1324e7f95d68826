// From a surface to what the channels of a layout hold, as far as kernels/encode.h leaves it open. Behind
// this follows main(), which the layout's row is made into (output_stage.c).
layout(location = UNIFORM_EYE) uniform vec3 eye;
layout(location = UNIFORM_DEPTH_RANGE) uniform vec3 depth_range;

const float FLOAT_STEP = 1.0 / 16777216.0; // below 1
const float NO_NUMBER = -2.0;              // of signed numbers within [-1, 1]: the code that says none

surface phong_surface(surface s)
{
    phong_material m = phong_of_metal_rough(s.albedo, clamp(s.metallic, 0.0, 1.0),
                                            clamp(s.roughness, 0.0, 1.0));
    s.albedo = m.diffuse;
    s.specular = m.specular;
    s.shininess = m.shininess;
    return s;
}

// --- depth and position

vec3 metres_channels(surface s)
{
    return vec3(-s.position.z);
}

vec3 nearness_channels(surface s)
{
    return vec3(nearness_at(-s.position.z, depth_range.x, depth_range.y, depth_range.z != 0.0));
}

vec3 ndc_channels(surface s)
{
    return vec3(ndc_of_nearness(nearness_channels(s).x, FLOAT_STEP));
}

vec3 fraction_channels(surface s)
{
    return vec3(fraction_of_depth(-s.position.z, depth_range.x, depth_range.y));
}

vec3 view_position_channels(surface s)
{
    return s.position;
}

vec3 world_position_channels(surface s)
{
    return world_from_view * s.position + eye;
}

// --- normals: unit, or 0 where there is none

vec3 valid_normal(vec3 n)
{
    return dot(n, n) > 0.25 ? clamp(n, -1.0, 1.0) : vec3(0.0);
}

vec3 view_space(vec3 n)
{
    return n * world_from_view; // the transpose is the inverse
}

// steps: from 0 to 1.
vec3 octahedron_channels(vec3 n, float steps)
{
    return dot(n, n) > 0.0 ? vec3(nearest_octahedron(n, steps), 0.0) : vec3(NO_NUMBER);
}

vec3 spheremap_channels(vec3 n)
{
    return dot(n, n) > 0.0 ? vec3(spheremap_of(n), 0.0) : vec3(0.0);
}

// --- colours and exponents

vec3 gray_channels(vec3 color)
{
    return vec3(gray_of(color));
}

vec3 shared_channels(vec3 color)
{
    return clamp(color, 0.0, TL_MOST_SHARED);
}

vec3 logarithm_channels(float exponent)
{
    return vec3(logarithm_of_shininess(exponent));
}

// --- numbers that OpenGL does not make

// OpenGL may cut halves off instead of rounding them, so they come rounded. Denormals stay its affair.
float rounded_half(float x)
{
    uint bits = floatBitsToUint(clamp(x, -TL_MOST_HALF, TL_MOST_HALF));
    return uintBitsToFloat((bits & 0x80000000u) | rounded_bits(bits, 13u) << 13u);
}

uint unorm_field(float x, uint bits)
{
    return unorm_bits(clamp(x, 0.0, 1.0), bits);
}

uint snorm_field(float x, uint bits)
{
    return x < -1.5 ? none_bits(bits) : snorm_bits(clamp(x, -1.0, 1.0), bits);
}

uint float24_field(float x)
{
    return rounded_bits(floatBitsToUint(max(x, 0.0)), 7u);
}

// Red has the highest byte.
vec4 bytes24(uint w)
{
    return vec4(w >> 16u, w >> 8u & 255u, w & 255u, 0u) / 255.0;
}
