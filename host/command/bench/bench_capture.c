#include "bench_capture.h"

#include "capture_read.h"
#include "console.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>

static tl_status check_lights(const char *path, const tl_light_set *lights, tl_error *err)
{
    for (size_t i = 0; i < lights->count; i++)
        if (lights->lights[i].type != TL_LIGHT_POINT || isinf(lights->lights[i].range))
            return tl_fail(
                err, TL_ERR_ARGUMENT,
                "%s: lights[%zu] is no point light with a range; a bench counts pairs "
                "of those alone",
                path, i);
    if (lights->count == 0)
        return tl_fail(err, TL_ERR_ARGUMENT, "%s: has no lights inside; a bench needs some",
                       path);
    return TL_OK;
}

tl_status bench_capture_frame(const char *path, tl_bench_frame *frame, tl_error *err)
{
    const tl_capture_request request = {.path = path, .notices = &console_notices};
    tl_captured captured = {0};
    tl_status status = TL_OK;
    TRY(tl_capture_read(&request, &captured, err));
    TRY(check_lights(path, &captured.lights, err));
    TRY(tl_gbuffer_repair(captured.gbuffer, path, false, NULL, err));
    frame->lights = captured.lights;
    captured.lights = (tl_light_set){0};
    frame->gbuffer = captured.gbuffer;
    captured.gbuffer = NULL;
    frame->ours = frame->gbuffer;
    if (frame->gbuffer->layout != TL_LAYOUT_FLOAT) {
        frame->packed[0] = frame->gbuffer;
        frame->gbuffer = NULL;
        TRY(tl_gbuffer_unpack(frame->packed[0], &frame->gbuffer, err));
        TRY(tl_gbuffer_repair(frame->gbuffer, path, false, NULL, err));
    }
    TRY(tl_image_create(frame->gbuffer->camera.width, frame->gbuffer->camera.height,
                        &frame->image, err));
done:
    tl_captured_clear(&captured);
    return status;
}
