#include "tilelight/gbuffer_file.h"

#include "camera_attributes.h"
#include "exr_reader.h"
#include "plane_channels.h"
#include "try.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum { KNOWN_VERSION = 1 };

static tl_status check_version(tl_exr_reader *reader, tl_error *err)
{
    tl_status status = TL_OK;
    const char *path = reader->stream.path, *layout = NULL;
    const exr_context_t context = reader->stream.context;
    int32_t version = 0, length;
    if (!tl_exr_reader_has_attribute(reader, "tilelight:version"))
        TRY(tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s: is no G-buffer of tilelight: it has no attribute \"tilelight:version\", so "
            "its camera is missing; capture the scene with tilelight",
            path));
    if (exr_attr_get_int(context, 0, "tilelight:version", &version) != EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: attribute \"tilelight:version\" is not of type int", path));
    if (version != KNOWN_VERSION)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: is a G-buffer of version %" PRId32 "; this program reads version %d",
                    path, version, KNOWN_VERSION));
    if (exr_attr_get_string(context, 0, "tilelight:layout", &length, &layout) !=
        EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: has no attribute \"tilelight:layout\" of type string", path));
    if (strcmp(layout, "float") != 0)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: its tilelight:layout is \"%.64s\"; this program reads \"float\"", path,
                    layout));
done:
    return status;
}

/* Which planes the file has, every group whole. */
static tl_status find_planes(const tl_exr_reader *reader, uint32_t *present, tl_error *err)
{
    static const uint32_t groups[] = {TL_GROUP_PHONG, TL_GROUP_METAL_ROUGH, TL_GROUP_OCCLUSION,
                                      TL_GROUP_EMISSIVE};
    tl_status status = TL_OK;
    uint32_t found = 0, wanted = TL_GROUP_BASE;
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if (tl_exr_reader_has_channel(reader, tl_plane_channels[p]))
            found |= TL_HAS(p);
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++)
        if (found & groups[i])
            wanted |= groups[i];
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if (wanted & TL_HAS(p))
            TRY(tl_exr_reader_require(reader, tl_plane_channels[p], err));
    *present = wanted;
done:
    return status;
}

static tl_status create(const tl_exr_reader *reader,
                        const tl_camera *camera,
                        uint32_t present,
                        tl_gbuffer **out,
                        tl_error *err)
{
    const uint64_t plane_count = (uint64_t)__builtin_popcount(present);
    tl_error reason = {.status = TL_OK};
    tl_status status = tl_exr_reader_check_size(
        reader, plane_count * camera->width * camera->height * sizeof(float), err);
    if (status != TL_OK)
        return status;
    status = tl_gbuffer_create(camera, present, out, &reason);
    if (status == TL_OK)
        return TL_OK;
    return tl_fail(err, status == TL_ERR_MEMORY ? status : TL_ERR_FORMAT, "%s: %.3000s",
                   reader->stream.path, reason.message);
}

static tl_status read_planes(tl_exr_reader *reader, tl_gbuffer *gbuffer, tl_error *err)
{
    tl_exr_target targets[TL_PLANE_COUNT];
    size_t count = 0;
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if (gbuffer->present & TL_HAS(p))
            targets[count++] = (tl_exr_target){.channel = tl_plane_channels[p],
                                               .plane = tl_gbuffer_plane(gbuffer, p)};
    return tl_exr_reader_pixels(reader, targets, count, gbuffer->pitch, err);
}

static tl_status read_lights(tl_exr_reader *reader, tl_light_set *lights, tl_error *err)
{
    tl_status status = TL_OK;
    const char *text = NULL;
    char source[1024];
    int32_t length = 0;
    if (exr_attr_get_string(reader->stream.context, 0, "tilelight:lights", &length, &text) !=
        EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: attribute \"tilelight:lights\" is not of type string",
                    reader->stream.path));
    snprintf(source, sizeof source, "%.900s: attribute \"tilelight:lights\"",
             reader->stream.path);
    TRY(tl_lights_parse(text, (size_t)length, source, lights, err));
done:
    return status;
}

tl_status tl_gbuffer_read(
    const char *path, tl_gbuffer **out, tl_light_set *lights, bool *has_lights, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_reader reader = {.is_open = false};
    tl_gbuffer *made = NULL;
    tl_light_set brought = {0};
    tl_camera camera;
    uint32_t present = 0;
    bool has = false;

    TRY(tl_exr_reader_open(&reader, path, err));
    TRY(check_version(&reader, err));
    TRY(tl_camera_attributes_read(&reader.stream, reader.width, reader.height, &camera, err));
    TRY(find_planes(&reader, &present, err));
    has = tl_exr_reader_has_attribute(&reader, "tilelight:lights");
    if (has)
        TRY(read_lights(&reader, &brought, err));
    TRY(create(&reader, &camera, present, &made, err));
    TRY(read_planes(&reader, made, err));

    *out = made;
    made = NULL;
    if (lights) {
        *lights = brought;
        brought = (tl_light_set){0};
    }
    if (has_lights)
        *has_lights = has;
done:
    tl_light_set_clear(&brought);
    tl_gbuffer_destroy(made);
    tl_exr_reader_close(&reader);
    return status;
}
