// The last pass: the surface's colours and the light they received, channel by channel to planes.
layout(binding = UNIT_DIFFUSE) uniform sampler2D diffuse;
layout(binding = UNIT_SPECULAR) uniform sampler2D specular;
layout(binding = UNIT_UNLIT) uniform sampler2D unlit;
layout(binding = UNIT_DIFFUSE_LIGHT) uniform sampler2D diffuse_light;
layout(binding = UNIT_SPECULAR_LIGHT) uniform sampler2D specular_light;

layout(location = 0) out float red;
layout(location = 1) out float green;
layout(location = 2) out float blue;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 radiance = texelFetch(unlit, pixel, 0).xyz;
    radiance += texelFetch(diffuse, pixel, 0).xyz * texelFetch(diffuse_light, pixel, 0).xyz;
#ifdef SPECULAR
    radiance += texelFetch(specular, pixel, 0).xyz * texelFetch(specular_light, pixel, 0).xyz;
#endif
    red = radiance.x;
    green = radiance.y;
    blue = radiance.z;
}
