/* G-buffers of tilelight's own, in every layout, with lights inside: does any file do more than be
 * refused? */
#include "fuzz.h"
#include "fuzz_frame.h"

#include "tilelight/gbuffer_file.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *const path = fuzz_file(data, size);
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    tl_light_set lights = {.count = 0};
    const tl_status status = tl_gbuffer_read(path, &gbuffer, &lights, NULL, &err);
    fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        fuzz_must(tl_light_set_check(&lights, path, &err) == TL_OK, "%s", err.message);
        fuzz_repair(gbuffer);
        fuzz_light(gbuffer, &lights);
    }
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(gbuffer);
    return 0;
}
