/* Brute force: the project's own kernels, every light on every pixel. */
#include "baseline_tables.h"
#include "try.h"

#include <stdlib.h>

typedef struct brute {
    const tl_gbuffer *gbuffer;
    const tl_light_set *lights;
    tl_lighting *lighting;
} brute;

void brute_destroy(void *state)
{
    brute *b = state;
    if (!b)
        return;
    tl_lighting_destroy(b->lighting);
    free(b);
}

/* Kernels are compiled for what a scene calls for: one pixel of sky calls for the same ones. */
static tl_status compile(const brute *b, tl_error *err)
{
    tl_camera camera = b->gbuffer->camera;
    tl_gbuffer *sky = NULL;
    tl_image *image = NULL;
    tl_status status = TL_OK;
    camera.width = camera.height = 1;
    TRY(tl_gbuffer_create(&camera, b->gbuffer->present, &sky, err));
    TRY(tl_image_create(1, 1, &image, err));
    TRY(tl_lighting_run(b->lighting, sky, b->lights, image, NULL, NULL, NULL, err));
done:
    tl_image_destroy(image);
    tl_gbuffer_destroy(sky);
    return status;
}

tl_status brute_create(const tl_baseline_input *input, void **out, tl_error *err)
{
    tl_lighting_options options = tl_lighting_options_default();
    tl_status status = TL_OK;
    brute *b = calloc(1, sizeof *b);
    if (!b)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline");
    b->gbuffer = input->gbuffer;
    b->lights = input->lights;
    options.cull = TL_CULL_NONE;
    TRY(tl_lighting_create(input->device, &options, &b->lighting, err));
    TRY(compile(b, err));
    *out = b;
    b = NULL;
done:
    brute_destroy(b);
    return status;
}

tl_status brute_run(void *state, tl_image *image, tl_timings *timings, tl_error *err)
{
    brute *b = state;
    return tl_lighting_run(b->lighting, b->gbuffer, b->lights, image, timings, NULL, NULL, err);
}
