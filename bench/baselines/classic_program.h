/* The program of classic.cl, compiled or taken from the cache of compiled kernels. */
#ifndef TL_CLASSIC_PROGRAM_H
#define TL_CLASSIC_PROGRAM_H

#include "kernel_program.h"

typedef struct classic_program {
    cl_program program;
    cl_kernel kernel;
    tl_keeper keeper;
} classic_program;

/* For grids of `items` work-items. The caller clears *out whether it succeeds or not. Fails with
 * TL_ERR_DEVICE, with the compiler's log. */
tl_status tl_classic_program_make(const tl_device *device,
                                  const tl_kernel_options *options,
                                  size_t items,
                                  classic_program *out,
                                  tl_error *err);

/* To be called after the first launch: puts what was compiled into the cache. Cannot fail. */
void tl_classic_program_keep(classic_program *program, size_t items, size_t group);

/* Accepts one that is all zero. */
void tl_classic_program_clear(classic_program *program);

#endif
