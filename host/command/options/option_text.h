/* Options as they were given, as text: what stands in it is the same for command lines that ask for the same. */
#ifndef TL_OPTION_TEXT_H
#define TL_OPTION_TEXT_H

#include "tilelight/error.h"

#include <argp.h>

/* "name=value" lines of the options of `of`, one of the groups of options that `root` has, and of its own
 * groups: by name, those of one name in their order. without: [.., NULL] names that are left out. argv was
 * parsed by `root` without complaint. The caller frees *out. Fails with TL_ERR_MEMORY. */
tl_status option_text(const struct argp *root,
                      const struct argp *of,
                      int argc,
                      char **argv,
                      const char *const *without,
                      char **out,
                      tl_error *err);

#endif
