/* The end of the material pass's shader, which writes a surface to the targets of a layout: made from the
 * layout's row, so that what is written is where kernels read it. */
#ifndef TL_OUTPUT_STAGE_H
#define TL_OUTPUT_STAGE_H

#include "tilelight/gbuffer.h"

enum { TL_OUTPUT_STAGE_SIZE = 8192 };

/* The text of main(), for what a G-buffer stores; `text` holds TL_OUTPUT_STAGE_SIZE bytes. Variables are
 * called target_N, N the target's number and location. id_target: the location that ids of objects go to; -1:
 * none is. Cannot fail. */
void tl_output_stage(enum tl_layout_name layout, uint32_t present, int id_target, char *text);

#endif
