#include "size_limit.h"

#include <inttypes.h>

static const uint64_t always_allowed = (uint64_t)1 << 30; /* bytes */
static const uint64_t best_ratio = 2000;

tl_status tl_check_decoded_size(const char *path,
                                uint64_t file_size,
                                uint64_t decoded_size,
                                tl_error *err)
{
    if (decoded_size <= always_allowed || decoded_size / best_ratio <= file_size)
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s: is damaged: its header promises %" PRIu64 " MiB of pixels in %" PRIu64
                   " bytes",
                   path, decoded_size >> 20, file_size);
}
