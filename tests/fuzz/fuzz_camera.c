/* Camera files: does any text do more than be refused? */
#include "fuzz.h"
#include "plan.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const char *const path = fuzz_file(data, size);
    tl_error err = {.status = TL_OK};
    tl_camera camera;
    const tl_status status = tl_camera_file_read(path, 16, 9, 1.0, &camera, &err);
    fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        /* Planes that the file does not give are found later. */
        camera.near = camera.near > 0.0f ? camera.near : 0x1p-100f;
        camera.far = camera.far > 0.0f ? camera.far : INFINITY;
        fuzz_must(tl_camera_check(&camera, &err) == TL_OK, "%s", err.message);
    }
    return 0;
}
