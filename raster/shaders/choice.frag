// Of the surfaces at the depth of the next layer, the one of the lowest rank, which the depth buffer finds:
// ranks are below 2^24.
layout(binding = SLOT_FRONT) uniform sampler2D front;
layout(location = 0) out vec2 choice; // rank, opacity

void main()
{
    float rank = rank_of_fragment(), opacity = opacity_of_fragment();
    if (gl_FragCoord.z != texelFetch(front, ivec2(gl_FragCoord.xy), 0).r ||
        !is_left(gl_FragCoord.z, rank, opacity))
        discard;
    gl_FragDepth = rank / 16777216.0;
    choice = vec2(rank, opacity);
}
