/* What the device can do at most: vectors without end of fused multiply-adds, and memory read and
 * copied in one go. WIDTH, lanes of a vector, comes from the host.
 *
 * PoCL's work-items do not vectorise well; vectors written out do, like those of the kernels. */
#if WIDTH == 1
typedef float lanes;
#    define GATHER(from, at) ((from)[at])
#    define SCATTER(v, to, at) ((to)[at] = (v))
#else
#    define PASTE_(a, b) a##b
#    define PASTE(a, b) PASTE_(a, b)
typedef PASTE(float, WIDTH) lanes;
#    define GATHER(from, at) PASTE(vload, WIDTH)(at, from)
#    define SCATTER(v, to, at) PASTE(vstore, WIDTH)(v, at, to)
#endif

/* 12 chains: two units with a latency of 4 or 5 cycles want 8 to 10.
 * out     [global size * WIDTH], so that no result is dropped
 * rounds  steps of each chain: 12 * 2 * WIDTH * rounds operations per work-item */
__kernel void peak_flops(__global float *restrict out,
                         const float a,
                         const float b,
                         const uint rounds)
{
    const uint item = get_global_id(0);
    lanes x0 = (lanes)(a), x1 = x0 + b, x2 = x1 + b, x3 = x2 + b, x4 = x3 + b, x5 = x4 + b,
          x6 = x5 + b, x7 = x6 + b, x8 = x7 + b, x9 = x8 + b, x10 = x9 + b, x11 = x10 + b;
    const lanes k = (lanes)(a), c = (lanes)(b);
    for (uint i = 0; i < rounds; i++) {
        x0 = fma(x0, k, c);
        x1 = fma(x1, k, c);
        x2 = fma(x2, k, c);
        x3 = fma(x3, k, c);
        x4 = fma(x4, k, c);
        x5 = fma(x5, k, c);
        x6 = fma(x6, k, c);
        x7 = fma(x7, k, c);
        x8 = fma(x8, k, c);
        x9 = fma(x9, k, c);
        x10 = fma(x10, k, c);
        x11 = fma(x11, k, c);
    }
    SCATTER(x0 + x1 + x2 + x3 + x4 + x5 + x6 + x7 + x8 + x9 + x10 + x11, out, item);
}

/* Work-item i copies vectors [i * block, (i + 1) * block).
 * from, to  [global size * block * WIDTH] */
__kernel void peak_copy(__global const float *restrict from,
                        __global float *restrict to,
                        const uint block)
{
    const uint first = get_global_id(0) * block;
    for (uint i = first; i < first + block; i++)
        SCATTER(GATHER(from, i), to, i);
}

/* Adds up the same vectors in four chains.
 * from  [global size * block * WIDTH], block a multiple of 4
 * to    [global size * WIDTH] */
__kernel void peak_read(__global const float *restrict from,
                        __global float *restrict to,
                        const uint block)
{
    const uint item = get_global_id(0), first = item * block;
    lanes s0 = GATHER(from, first), s1 = (lanes)(0.0f), s2 = s1, s3 = s1;
    for (uint i = first; i + 3 < first + block; i += 4) {
        s0 += GATHER(from, i);
        s1 += GATHER(from, i + 1);
        s2 += GATHER(from, i + 2);
        s3 += GATHER(from, i + 3);
    }
    SCATTER((s0 + s1) + (s2 + s3), to, item);
}
