/* Kernel programs, specialised and built at run time from the sources embedded at build time. */
#ifndef TL_KERNEL_PROGRAM_H
#define TL_KERNEL_PROGRAM_H

#include "device.h"
#include "options.h"
#include "program_keeper.h"

#include "tilelight/approximations.h"

#include <stdint.h>

/* One field per line of TL_KERNEL_OPTIONS, documented there; and one of each knob of knobs.h. */
typedef struct tl_kernel_options {
#define FIELD(macro, field) uint32_t field;
    TL_KERNEL_OPTIONS(FIELD)
#undef FIELD
    tl_approximations approximations;
} tl_kernel_options;

/* The -D flags of these, each with a blank before it. text: [size], NUL-terminated, cut to fit; 1024 bytes
 * hold them all. */
void tl_kernel_flags(const tl_kernel_options *options, char *text, size_t size);

/* Parts of a frame's work have a program each: scenes differ in what shading is built for, and share
 * the kernels that cull, which take the longest to compile. */
typedef enum tl_program_part {
    TL_PART_CULL,
    TL_PART_OCCLUDE,
    TL_PART_SHADE,
    TL_PART_BLEND, /* of layers alone */
    /* stages after lighting (host/post/), a part each; they are not of a frame that is lit */
    TL_PART_MEND,
    TL_PART_EDGES,
    TL_PART_BLOOM,
    TL_PART_FINAL,
    TL_PART_COUNT,
    TL_LIGHTING_PART_COUNT = TL_PART_MEND
} tl_program_part;

/* Of those that a program lacks the handle is NULL.
 * X(name in the program and here, its part, whether it is there: of `options` and `has_double`) */
#define TL_KERNELS(X)                                 \
    X(light_rects, TL_PART_CULL, has_double)          \
    X(cull_rows, TL_PART_CULL, 1)                     \
    X(bound_tiles, TL_PART_CULL, options->by_pixel)   \
    X(list_cells, TL_PART_CULL, options->by_pixel)    \
    X(list_tiles, TL_PART_CULL, options->by_pixel)    \
    X(gather_surroundings, TL_PART_OCCLUDE, 1)        \
    X(occlude, TL_PART_OCCLUDE, 1)                    \
    X(smooth_surroundings, TL_PART_OCCLUDE, 1)        \
    X(shade_tiles, TL_PART_SHADE, 1)                  \
    X(shade_pixels, TL_PART_SHADE, options->by_pixel) \
    X(blend_layer, TL_PART_BLEND, 1)                  \
    X(count_no_colors, TL_PART_MEND, 1)               \
    X(mend_picture, TL_PART_MEND, 1)                  \
    X(gather_edges, TL_PART_EDGES, 1)                 \
    X(smooth_edges, TL_PART_EDGES, 1)                 \
    X(gather_bright, TL_PART_BLOOM, 1)                \
    X(blur_across, TL_PART_BLOOM, 1)                  \
    X(blur_down, TL_PART_BLOOM, 1)                    \
    X(add_glow, TL_PART_BLOOM, 1)                     \
    X(scale_columns, TL_PART_FINAL, 1)                \
    X(scale_rows, TL_PART_FINAL, 1)                   \
    X(show_codes, TL_PART_FINAL, 1)

typedef struct tl_program {
    tl_program_part part;
    tl_kernel_options options; /* what the part does not depend on is 0 */
    tl_user_kernel user;       /* text NULL: shade_tiles is ours */
    char *user_memory;         /* what `user` points into; owned */
    cl_program program;
    tl_keeper *keeper; /* owned */
#define HANDLE(name, its_part, is_there) cl_kernel name;
    TL_KERNELS(HANDLE)
#undef HANDLE
} tl_program;

/* The device's program of a part for these options, built the first time they are asked for. With
 * `user` (NULL, or its text NULL: ours), shade_tiles is the user's kernel. The device owns *out and keeps
 * the 32 programs it was asked for last: *out holds until it is asked for as many others. Fails with
 * TL_ERR_DEVICE, of a user's kernel TL_ERR_FORMAT, the message carrying the compiler's log or saying what
 * user_kernel.h does; TL_ERR_MEMORY. */
tl_status tl_program_find(tl_device *device,
                          tl_program_part part,
                          const tl_kernel_options *options,
                          const tl_user_kernel *user,
                          const tl_program **out,
                          tl_error *err);

/* Notes a launch of one of the program's kernels. */
void tl_program_note_launch(const tl_program *program,
                            cl_kernel kernel,
                            size_t items,
                            size_t group);

/* To be called after the launches of a frame: puts the program into the cache on disk
 * (program_cache.h), if that is not ready for them all. Returns whether that was so; it then took up
 * to a second. Cannot fail. */
int tl_program_keep(const tl_device *device, const tl_program *program);

/* Releases all programs of the device. Accepts NULL. */
void tl_programs_release(struct tl_programs *programs);

#endif
