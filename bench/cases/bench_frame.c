#include "bench_frame.h"

#include "ray_cast.h"
#include "scene_lights.h"
#include "try.h"

#include <stdlib.h>

static tl_status make_gbuffer(tl_bench_frame *frame, const tl_bench_case *of, tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t width = of->scene_options.width, height = of->scene_options.height;
    if (frame->made_for.scene && tl_bench_case_same_gbuffer(&frame->made_for, of))
        return TL_OK;
    tl_bench_frame_clear(frame);
    TRY(tl_ray_cast(of->scene, width, height, &frame->gbuffer, err));
    TRY(tl_gbuffer_repair(frame->gbuffer, of->scene->name, false, NULL, err));
    TRY(tl_image_create(width, height, &frame->image, err));
    frame->rgb = malloc(3 * (size_t)width * height);
    if (!frame->rgb)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a picture of %u x %u pixels", width,
                    height));
done:
    return status;
}

tl_status tl_bench_frame_make(tl_bench_frame *frame, const tl_bench_case *of, tl_error *err)
{
    tl_status status = TL_OK;
    if (frame->made_for.scene && tl_bench_case_same_frame(&frame->made_for, of))
        return TL_OK;
    TRY(make_gbuffer(frame, of, err));
    tl_light_set_clear(&frame->lights);
    TRY(tl_scene_lights(frame->gbuffer, &of->scene_options, &frame->lights, err));
    TRY(tl_pair_counts_take(frame->gbuffer, &frame->lights, &frame->pairs, err));
    frame->made_for = *of;
done:
    if (status != TL_OK)
        tl_bench_frame_clear(frame);
    return status;
}

void tl_bench_frame_clear(tl_bench_frame *frame)
{
    free(frame->rgb);
    tl_image_destroy(frame->image);
    tl_light_set_clear(&frame->lights);
    tl_gbuffer_destroy(frame->gbuffer);
    *frame = (tl_bench_frame){0};
}
