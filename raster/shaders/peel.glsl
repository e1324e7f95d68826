// Peeling: a layer takes of each pixel the nearest surface that no layer before it has taken, of those that
// blend and nothing hides. Depths are compared as the bits that they are interpolated to, which all passes
// get alike (geometry.vert), and are reversed: larger is nearer. Of surfaces with equal depths the one of the
// lowest rank counts as the nearest.
layout(location = UNIFORM_RANK) uniform float first_rank; // of the draw's first triangle

layout(binding = SLOT_BACK) uniform sampler2D back;                   // depth of what does not blend; or -1
layout(binding = SLOT_TAKEN_FRONT) uniform sampler2D taken_front;     // depth of the layer before; or -1
layout(binding = SLOT_TAKEN_CHOICE) uniform sampler2D taken_choice;   // its rank and opacity

float rank_of_fragment()
{
    return first_rank + float(gl_PrimitiveID);
}

// A colour of 1 at every vertex is interpolated to a rounding or two below it in some pixels: so near to 1 is 1,
// and hides what is behind it.
float opacity_of_fragment()
{
    float opacity = clamp(base_color().a, 0.0, 1.0);
    return opacity > 1.0 - 4.0 / 16777216.0 ? 1.0 : opacity;
}

// What is as near as the surface behind is before it; behind what hides all nothing is left.
bool is_left(float depth, float rank, float opacity)
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    float before = texelFetch(taken_front, at, 0).r;
    vec2 taken = texelFetch(taken_choice, at, 0).rg;
    return opacity > 0.0 && depth >= texelFetch(back, at, 0).r && taken.g < 1.0 &&
           (depth < before || (depth == before && rank > taken.r));
}
