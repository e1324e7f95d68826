/* Captures of the ISPC project's example: does any file do more than be refused? */
#include "fuzz.h"
#include "fuzz_frame.h"
#include "ispc_read.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *const path = fuzz_file(data, size);
    const tl_capture_request request = {.path = path};
    tl_error err = {.status = TL_OK};
    tl_captured captured = {.has_lights = false};
    const tl_status status = tl_ispc_read(&request, &captured, &err);
    fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        fuzz_must(tl_light_set_check(&captured.lights, path, &err) == TL_OK, "%s", err.message);
        fuzz_repair(captured.gbuffer);
        fuzz_light(captured.gbuffer, &captured.lights);
    }
    tl_captured_clear(&captured);
    return 0;
}
