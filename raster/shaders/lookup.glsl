// Texture lookups and the alpha test, for both passes.
in vec2 uv_0;
in vec2 uv_1;
in vec4 vertex_color;

layout(location = UNIFORM_BASE_COLOR) uniform vec4 base_color_factor;
layout(location = UNIFORM_ALPHA_CUTOFF) uniform float alpha_cutoff;
layout(location = UNIFORM_COORDINATES) uniform int coordinates[SLOT_COUNT];
layout(location = UNIFORM_UV) uniform vec3 uv_rows[2 * SLOT_COUNT];

#ifdef HAS_BASE_COLOR
layout(binding = SLOT_BASE_COLOR) uniform sampler2D base_color_texture;
#endif

// Texture coordinates of a slot: its set, then KHR_texture_transform.
vec2 uv_of(int slot)
{
    vec3 st = vec3(coordinates[slot] == 0 ? uv_0 : uv_1, 1.0);
    return vec2(dot(uv_rows[2 * slot], st), dot(uv_rows[2 * slot + 1], st));
}

vec4 base_color()
{
    vec4 color = base_color_factor * vertex_color;
#ifdef HAS_BASE_COLOR
    color *= texture(base_color_texture, uv_of(SLOT_BASE_COLOR));
#endif
    return color;
}
