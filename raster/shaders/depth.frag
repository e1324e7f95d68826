// Depth pre-pass: nothing is written but depth, and holes are left open.
void main()
{
#ifdef ALPHA_TEST
    if (base_color().a < alpha_cutoff)
        discard;
#endif
}
