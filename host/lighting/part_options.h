/* What a part of a frame's work is compiled by: of the frame's options those that the part reads. */
#ifndef TL_PART_OPTIONS_H
#define TL_PART_OPTIONS_H

#include "kernel_program.h"

/* The options that the part's kernels are built with for a frame of these. What they do not read is 0. Where
 * a part reads little of a pixel, layouts that keep that in the same way, at the same place, have one answer:
 * the first of them in the table, with no more planes than it takes. Two frames may share a program exactly
 * where their answers are the same bytes. */
tl_kernel_options tl_part_options(tl_program_part part, const tl_kernel_options *frame);

#endif
