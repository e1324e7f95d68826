/* How much memory a file's header may ask for. */
#ifndef TL_SIZE_LIMIT_H
#define TL_SIZE_LIMIT_H

#include "tilelight/error.h"

#include <stdint.h>

/* Up to 1 GiB a file may decode to what it likes; beyond that, to 2000 times its own size. No codec
 * of OpenEXR or PNG packs tighter on real pictures: deflate ends at 1032 to 1. Fails with
 * TL_ERR_FORMAT. */
tl_status tl_check_decoded_size(const char *path,
                                uint64_t file_size,
                                uint64_t decoded_size,
                                tl_error *err);

#endif
