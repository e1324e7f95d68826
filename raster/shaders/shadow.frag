// What a light sees: depth goes to the depth buffer, how it changes over the texel to the target. Depth
// is affine over a triangle's plane, so a difference between neighbours of a quad is that slope wherever
// the triangle is. Holes are left open.
layout(location = UNIFORM_DEPTH_RANGE) uniform vec3 depth_range;
layout(location = 0) out uint slopes;

void main()
{
    const float largest = 65504.0; // that a half holds
    float depth = gl_FragCoord.z;
    vec2 slope = vec2(dFdx(depth), dFdy(depth)) * float(TL_SLOPE_SCALE);
#ifdef ALPHA_TEST
    if (base_color().a < alpha_cutoff)
        discard;
#endif
    bool is_parallel = depth_range.z != 0.0;
    slopes = packHalf2x16(clamp(is_parallel ? slope : slope / depth, -largest, largest));
}
