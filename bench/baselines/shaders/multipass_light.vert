// One instance a light: its rectangle on the screen, or a volume around it.
layout(location = ATTRIBUTE_CORNER) in vec3 corner; // of a solid that holds the unit sphere
layout(location = ATTRIBUTE_RECTANGLE) in vec4 rectangle; // -1 to 1: x0, y0, x1, y1
layout(location = ATTRIBUTE_POSITION_RANGE2) in vec4 position_range2;
layout(location = ATTRIBUTE_DIFFUSE_FADE) in vec4 diffuse_fade;
layout(location = ATTRIBUTE_SPECULAR) in vec3 specular;
layout(location = ATTRIBUTE_FALLOFF) in int falloff;

layout(location = UNIFORM_CLIP_FROM_VIEW) uniform mat4 clip_from_view;

flat out vec4 light_position_range2;
flat out vec4 light_diffuse_fade;
flat out vec3 light_specular;
flat out int light_falloff;

void main()
{
    light_position_range2 = position_range2;
    light_diffuse_fade = diffuse_fade;
    light_specular = specular;
    light_falloff = falloff;
#ifdef VOLUME
    vec3 at = position_range2.xyz + corner * sqrt(position_range2.w);
    gl_Position = clip_from_view * vec4(at, 1.0);
#else
    gl_Position = vec4((gl_VertexID & 1) == 0 ? rectangle.x : rectangle.z,
                       (gl_VertexID & 2) == 0 ? rectangle.y : rectangle.w, 0.0, 1.0);
#endif
}
