/* The roof over every figure: what vector kernels of nothing but arithmetic, or nothing but memory,
 * reach on a device. */
#ifndef TL_PEAKS_H
#define TL_PEAKS_H

#include "tilelight/lighting.h"

typedef struct tl_peaks {
    double flops;      /* 1/s; single precision, a fused multiply-add counts as two */
    double read_bytes; /* 1/s; reading alone */
    double copy_bytes; /* 1/s; read and written bytes both count */
    double bytes;      /* 1/s; the better of the two */
} tl_peaks;

/* The best of several launches each, by profiling events; some 0.5 s. Vectors are as wide as
 * tl_device_describe says. Fails with TL_ERR_DEVICE, or TL_ERR_MEMORY where 128 MB are not there. */
tl_status tl_peaks_measure(tl_device *device, tl_peaks *out, tl_error *err);

#endif
