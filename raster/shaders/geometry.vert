// Both passes run this text: `invariant` then gives them the same depth to the bit, which the
// material pass relies on (GL_EQUAL).
invariant gl_Position;

layout(location = ATTRIBUTE_POSITION) in vec3 position;
layout(location = ATTRIBUTE_NORMAL) in vec3 normal;
layout(location = ATTRIBUTE_TANGENT) in vec4 tangent;
layout(location = ATTRIBUTE_TEXCOORD_0) in vec2 texcoord[SET_COUNT];
layout(location = ATTRIBUTE_COLOR) in vec4 color;

layout(location = UNIFORM_CLIP_FROM_VIEW) uniform mat4 clip_from_view;
layout(location = UNIFORM_VIEW_FROM_MODEL) uniform mat4x3 view_from_model;
layout(location = UNIFORM_NORMAL_FROM_MODEL) uniform mat3 normal_from_model;
layout(location = UNIFORM_TANGENT_FROM_MODEL) uniform mat3 tangent_from_model;
layout(location = UNIFORM_BITANGENT_SIGN) uniform float bitangent_sign;

out vec3 view_position;
out vec3 world_normal;
out vec4 world_tangent;
out vec2 uv_sets[SET_COUNT];
out vec4 vertex_color;

// Some files have normals of length 0: they stay so, instead of becoming NaN.
vec3 unit(vec3 v)
{
    float length2 = dot(v, v);
    return length2 > 0.0 ? v * inversesqrt(length2) : v;
}

void main()
{
    view_position = view_from_model * vec4(position, 1.0);
    gl_Position = clip_from_view * vec4(view_position, 1.0);
    world_normal = unit(normal_from_model * normal);
    world_tangent = vec4(unit(tangent_from_model * tangent.xyz), tangent.w * bitangent_sign);
    for (int i = 0; i < SET_COUNT; i++)
        uv_sets[i] = texcoord[i];
    vertex_color = color;
}
