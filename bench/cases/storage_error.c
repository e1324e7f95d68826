#include "storage_error.h"

#include "try.h"

/* Where fewer than one pixel in a thousand is lit, the mean is next to nothing. */
static int is_dark(const tl_bench_frame *frame)
{
    const tl_camera *camera = &frame->gbuffer->camera;
    return 1000 * frame->pairs.lit < (uint64_t)camera->width * camera->height;
}

static tl_status light(tl_device *device,
                       const tl_bench_case *of,
                       const tl_gbuffer *gbuffer,
                       const tl_light_set *lights,
                       tl_image **out,
                       tl_error *err)
{
    tl_lighting_options options = of->lighting;
    tl_lighting *lighting = NULL;
    tl_status status = TL_OK;
    options.precision = TL_PRECISION_DOUBLE;
    options.vector_width = 0;
    TRY(tl_image_create(gbuffer->camera.width, gbuffer->camera.height, out, err));
    TRY(tl_lighting_create(device, &options, &lighting, err));
    TRY(tl_lighting_run(lighting, gbuffer, lights, *out, NULL, NULL, NULL, err));
done:
    tl_lighting_destroy(lighting);
    return status;
}

/* Metallic and roughness that became a Phong material are not lost. */
static uint32_t lost_planes(const tl_gbuffer *from, const tl_gbuffer *to)
{
    const uint32_t lost = from->present & ~to->present;
    return to->present & TL_GROUP_PHONG ? lost & ~TL_GROUP_METAL_ROUGH : lost;
}

tl_status tl_storage_error_find(tl_device *device,
                                const tl_bench_case *of,
                                tl_bench_frame *frame,
                                tl_storage_error *out,
                                tl_error *err)
{
    tl_status status = TL_OK;
    const tl_gbuffer *gbuffer = NULL;
    tl_image *exact = NULL, *stored = NULL;
    tl_storage_error found = {0};
    if (of->layout == TL_LAYOUT_FLOAT || is_dark(frame) || !device ||
        !tl_device_describe(device).has_double)
        goto done;
    TRY(tl_bench_frame_in(frame, of->layout, &gbuffer, err));
    TRY(light(device, of, frame->gbuffer, &frame->lights, &exact, err));
    TRY(light(device, of, gbuffer, &frame->lights, &stored, err));
    TRY(tl_compare(stored, exact, &found.of, err));
    found.lost = lost_planes(frame->gbuffer, gbuffer);
    found.is_known = 1;
done:
    tl_image_destroy(exact);
    tl_image_destroy(stored);
    *out = found;
    return status;
}
