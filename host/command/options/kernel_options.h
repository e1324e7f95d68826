/* Options of a shading kernel that the user brings. */
#ifndef TL_KERNEL_OPTIONS_GROUP_H
#define TL_KERNEL_OPTIONS_GROUP_H

#include "tilelight/lighting.h"

#include <argp.h>

/* All zero to begin with: tilelight's own kernels. */
typedef struct kernel_choice {
    const char *file, *entry; /* both NULL or both given */
    tl_kernel_items items;
    char *text; /* set by kernel_choice_read; freed by kernel_choice_release */
} kernel_choice;

/* --kernel, --entry, --items. Its input is a kernel_choice. */
extern const struct argp kernel_argp;

/* Reads the file that was chosen. *out borrows from the choice; it is all zero where none was chosen. Fails
 * with TL_ERR_READ, TL_ERR_FORMAT (larger than a kernel could be, or no text) or TL_ERR_MEMORY. */
tl_status kernel_choice_read(kernel_choice *choice, tl_user_kernel *out, tl_error *err);

/* Accepts what was never read. */
void kernel_choice_release(kernel_choice *choice);

#endif
