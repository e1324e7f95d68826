// Texture lookups and the alpha test, for both passes.
in vec2 uv_sets[SET_COUNT];
in vec4 vertex_color;

layout(location = UNIFORM_BASE_COLOR) uniform vec4 base_color_factor;
layout(location = UNIFORM_ALPHA_CUTOFF) uniform float alpha_cutoff;
layout(location = UNIFORM_COORDINATES) uniform int coordinates[SLOT_COUNT];
layout(location = UNIFORM_UV) uniform vec3 uv_rows[2 * SLOT_COUNT];

layout(location = UNIFORM_ANISOTROPY) uniform float anisotropy[SLOT_COUNT]; // 1: none

#ifdef HAS_BASE_COLOR
layout(binding = SLOT_BASE_COLOR) uniform sampler2D base_color_texture;
#endif

// Texture coordinates of a slot: its set, then KHR_texture_transform.
vec2 uv_of(int slot)
{
    vec3 st = vec3(uv_sets[0], 1.0);
    for (int i = 1; i < SET_COUNT; i++)
        st.xy = coordinates[slot] == i ? uv_sets[i] : st.xy;
    return vec2(dot(uv_rows[2 * slot], st), dot(uv_rows[2 * slot + 1], st));
}

// A pixel's footprint on a texture, an ellipse (Heckbert, "Fundamentals of Texture Mapping and
// Image Warping", 1989, section 3.4): what a circle of a pixel's width becomes under the
// derivatives, whose singular values are its axes.
struct footprint {
    float longest, shortest; // texels
    vec2 along;              // of the longest, in texture coordinates
};

footprint footprint_of(vec2 uv, vec2 size)
{
    vec2 across = dFdx(uv) * size, down = dFdy(uv) * size;
    float xx = across.x * across.x + down.x * down.x;
    float xy = across.x * across.y + down.x * down.y;
    float yy = across.y * across.y + down.y * down.y;
    float larger = 0.5 * (xx + yy) + length(vec2(0.5 * (xx - yy), xy)); // eigenvalue
    vec2 direction = xx >= yy ? vec2(larger - yy, xy) : vec2(xy, larger - xx);
    float length2 = dot(direction, direction);
    float longest = sqrt(larger);
    float area = abs(across.x * down.y - across.y * down.x);
    return footprint(longest, longest > 0.0 ? area / longest : 0.0,
                     length2 > 0.0 ? direction * inversesqrt(length2) * longest / size : vec2(0.0));
}

// The mean of up to `anisotropy` looks along the footprint, each at the level whose texels are
// as wide as the footprint is, or wider where that many looks would leave gaps. The looks' own
// width and their spread make up its length, so a round footprint gets one look, and one that
// is hardly longer than wide hardly differs.
//
// OpenGL's own filter is not asked: llvmpipe's (Mesa 22.3) takes every degree for the highest,
// and blurs where a texel is as large as a pixel.
vec4 look_up(sampler2D map, int slot)
{
    vec2 uv = uv_of(slot);
    if (anisotropy[slot] == 1.0)
        return texture(map, uv);
    footprint f = footprint_of(uv, vec2(textureSize(map, 0)));
    float width = max(max(f.shortest, f.longest / anisotropy[slot]), 1.0);
    float count = clamp(ceil(f.longest / width), 1.0, anisotropy[slot]);
    float level = log2(width);
    if (count == 1.0)
        return textureLod(map, uv, level);
    vec2 spread = f.along * (1.0 - width / f.longest);
    vec4 sum = vec4(0.0);
    for (float i = 0.0; i < count; i++)
        sum += textureLod(map, uv + (i / (count - 1.0) - 0.5) * spread, level);
    return sum / count;
}

vec4 base_color()
{
    vec4 color = base_color_factor * vertex_color;
#ifdef HAS_BASE_COLOR
    color *= look_up(base_color_texture, SLOT_BASE_COLOR);
#endif
    return color;
}
