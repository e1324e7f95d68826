// What surfaces that blend may be hidden by: depth, as peeling compares it. Holes are left open.
layout(location = 0) out float back_depth;

void main()
{
#ifdef ALPHA_TEST
    if (base_color().a < alpha_cutoff)
        discard;
#endif
    back_depth = gl_FragCoord.z;
}
