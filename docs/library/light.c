/* light G.exr OUT.exr: lights a G-buffer by the lights inside it, as `tilelight light G.exr -o OUT.exr`. */
#include <stdio.h>
#include <tilelight/gbuffer_file.h>
#include <tilelight/lighting.h>

int main(int argc, char **argv)
{
    tl_error err = {TL_ERR_ARGUMENT, "usage: light G.exr OUT.exr"};
    tl_gbuffer *gbuffer = NULL;
    tl_light_set lights = {0};
    tl_image *picture = NULL;
    tl_device *device = NULL;
    tl_lighting *lighting = NULL;
    const tl_lighting_options options = tl_lighting_options_default();
    const tl_exr_form floats = {0};
    const bool failed =
        argc != 3 || tl_gbuffer_read(argv[1], &gbuffer, &lights, NULL, &err) ||
        tl_gbuffer_repair(gbuffer, argv[1], false, NULL, &err) ||
        tl_image_create(gbuffer->camera.width, gbuffer->camera.height, &picture, &err) ||
        tl_device_open(NULL, &device, &err) ||
        tl_lighting_create(device, &options, &lighting, &err) ||
        tl_lighting_run(lighting, gbuffer, &lights, picture, NULL, NULL, NULL, &err) ||
        tl_image_write_exr(argv[2], picture, floats, &err);
    if (failed)
        fprintf(stderr, "light: %s\n", err.message);
    tl_lighting_destroy(lighting);
    tl_device_close(device);
    tl_image_destroy(picture);
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(gbuffer);
    return failed ? tl_exit_status(err.status) : 0;
}
