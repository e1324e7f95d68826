#include "bench_frame.h"

#include "bench_layers.h"
#include "ray_cast.h"
#include "scene_lights.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <stdlib.h>

static tl_status make_gbuffer(tl_bench_frame *frame, const tl_bench_case *of, tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t width = of->scene_options.width, height = of->scene_options.height;
    if (frame->made_for.scene && tl_bench_case_same_gbuffer(&frame->made_for, of))
        return TL_OK;
    tl_bench_frame_clear(frame);
    TRY(tl_ray_cast(of->scene, of->scene_options.material->present, width, height,
                    &frame->gbuffer, err));
    TRY(tl_bench_layers_add(frame->gbuffer, of->scene_options.layer_count,
                            of->scene_options.layer_part, err));
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
    frame->ours = frame->gbuffer;
done:
    if (status != TL_OK)
        tl_bench_frame_clear(frame);
    return status;
}

/* Repaired, for that finds how far stored positions lie off their rays: culling's rectangles need it. */
tl_status tl_bench_frame_in(tl_bench_frame *frame,
                            enum tl_layout_name layout,
                            const tl_gbuffer **out,
                            tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;
    if (layout == frame->gbuffer->layout) {
        *out = frame->gbuffer;
        return TL_OK;
    }
    for (int i = 0; i < 2; i++)
        if (frame->packed[i] && frame->packed[i]->layout == layout) {
            frame->next = 1 - i;
            *out = frame->packed[i];
            return TL_OK;
        }
    TRY(tl_gbuffer_pack(frame->gbuffer, layout, &made, NULL, err));
    TRY(tl_gbuffer_repair(made, frame->made_for.scene->name, false, NULL, err));
    tl_gbuffer_destroy(frame->packed[frame->next]);
    *out = frame->packed[frame->next] = made;
    made = NULL;
    frame->next = 1 - frame->next;
done:
    tl_gbuffer_destroy(made);
    return status;
}

void tl_bench_frame_clear(tl_bench_frame *frame)
{
    free(frame->rgb);
    tl_image_destroy(frame->image);
    tl_light_set_clear(&frame->lights);
    tl_gbuffer_destroy(frame->packed[0]);
    tl_gbuffer_destroy(frame->packed[1]);
    tl_gbuffer_destroy(frame->gbuffer);
    *frame = (tl_bench_frame){0};
}
