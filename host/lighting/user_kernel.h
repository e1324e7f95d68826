/* A shading kernel that is not ours: its text made ready, and what can be wrong with it. */
#ifndef TL_USER_KERNEL_H
#define TL_USER_KERNEL_H

#include "device.h"

/* What messages call it. */
const char *tl_user_kernel_name(const tl_user_kernel *user);

/* Replaces the strings of *user by copies in *memory, which the caller frees. Fails with
 * TL_ERR_MEMORY. */
tl_status tl_user_kernel_copy(tl_user_kernel *user, char **memory, tl_error *err);

/* Fails with TL_ERR_FORMAT, naming the kernels that the text does have. */
tl_status tl_user_kernel_missing(cl_program program, const tl_user_kernel *user, tl_error *err);

/* Whether the kernel takes what it will be given. Fails with TL_ERR_FORMAT, naming the argument. */
tl_status tl_user_kernel_check_arguments(cl_kernel kernel,
                                         const tl_user_kernel *user,
                                         tl_error *err);

/* Whether work-groups of `items` can run it. Fails with TL_ERR_ARGUMENT. */
tl_status tl_user_kernel_check_group(const tl_device *device,
                                     cl_kernel kernel,
                                     const tl_user_kernel *user,
                                     size_t items,
                                     tl_error *err);

#endif
