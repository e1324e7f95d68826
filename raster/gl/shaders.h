/* From the texts of two shaders to a program. */
#ifndef TL_SHADERS_H
#define TL_SHADERS_H

#include "gl.h"

/* vertex, fragment: texts that are joined, the first with #version, ended by NULL. *out goes with
 * the context. Fails with TL_ERR_DEVICE, with the compiler's log. */
tl_status tl_shaders_link(const tl_gl *gl,
                          const char *const vertex[],
                          const char *const fragment[],
                          GLuint *out,
                          tl_error *err);

#endif
