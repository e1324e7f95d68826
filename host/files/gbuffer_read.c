#include "tilelight/gbuffer_file.h"

#include "gbuffer_header.h"
#include "layer_parts.h"
#include "material_attribute.h"
#include "object_attribute.h"
#include "packing.h"
#include "shadow_parts.h"
#include "try.h"
#include "words_read.h"

#include <stdio.h>

static tl_status create(const tl_exr_reader *reader,
                        const tl_gbuffer_header *of,
                        tl_gbuffer **out,
                        tl_error *err)
{
    uint64_t size = 0;
    tl_error reason = {.status = TL_OK};
    for (uint32_t i = 0; i < tl_layouts[of->layout].word_count; i++)
        size += word_bytes(&tl_layouts[of->layout], of->present, i);
    tl_status status =
        tl_exr_reader_check_size(reader, size * of->camera.width * of->camera.height, err);
    if (status != TL_OK)
        return status;
    status = tl_gbuffer_create_packed(&of->camera, of->layout, of->present, out, &reason);
    if (status == TL_OK) {
        (*out)->samples = of->samples;
        return TL_OK;
    }
    return tl_fail(err, status == TL_ERR_MEMORY ? status : TL_ERR_FORMAT, "%s: %.3000s",
                   reader->stream.path, reason.message);
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
    TRY(tl_lights_parse(text, (size_t)length, source, reader->stream.path, lights, err));
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
    tl_gbuffer_header promised;
    bool has = false;

    TRY(tl_exr_reader_open(&reader, path, err));
    TRY(tl_gbuffer_header_read(&reader, &promised, err));
    has = tl_exr_reader_has_attribute(&reader, "tilelight:lights");
    if (has && lights)
        TRY(read_lights(&reader, &brought, err));
    TRY(create(&reader, &promised, &made, err));
    TRY(tl_material_attribute_read(&reader, &made->materials, err));
    TRY(tl_object_attribute_read(&reader, &made->objects, err));
    TRY(tl_words_read(&reader.part, &promised, made, err));
    TRY(tl_ids_read(&reader.part, made, err));
    TRY(tl_layer_parts_read(&reader, &promised, made, err));
    TRY(tl_shadow_parts_read(&reader.stream, reader.part.file_size, &made->shadows, err));

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

tl_status tl_gbuffer_read_lights(const char *path,
                                 tl_light_set *lights,
                                 bool *has_lights,
                                 tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_reader reader = {.is_open = false};
    TRY(tl_exr_reader_open(&reader, path, err));
    const bool has = tl_exr_reader_has_attribute(&reader, "tilelight:lights");
    if (has && lights)
        TRY(read_lights(&reader, lights, err));
    *has_lights = has;
done:
    tl_exr_reader_close(&reader);
    return status;
}

tl_status tl_gbuffer_is_own(const char *path, bool *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_stream stream = {.context = NULL};
    uint64_t file_size = 0;
    TRY(tl_exr_stream_open(&stream, path, &file_size, err));
    const tl_exr_part first = {.stream = &stream};
    *out = tl_exr_part_attribute(&first, "tilelight:version") != NULL;
done:
    tl_exr_stream_close_file(&stream);
    return status;
}
