// The depth of the next layer.
layout(location = 0) out float front_depth;

void main()
{
    if (!is_left(gl_FragCoord.z, rank_of_fragment(), opacity_of_fragment()))
        discard;
    front_depth = gl_FragCoord.z;
}
