#include "image_exr.h"

#include "exr_compression.h"
#include "exr_reader.h"
#include "exr_writer.h"
#include "ranges.h"
#include "try.h"

static const char *const channel_names[3] = {"R", "G", "B"};

/* A row in floats that halves hold. */
static void cut_row(const void *context, uint32_t y, void *const rows[TL_EXR_MAX_COMPUTED])
{
    const tl_image *image = context;
    for (unsigned c = 0; c < 3; c++) {
        const float *from = tl_image_plane(image, c) + (size_t)y * image->pitch;
        float *to = rows[c];
        for (uint32_t x = 0; x < image->width; x++)
            to[x] = from[x] > TL_MOST_HALF ? TL_MOST_HALF : from[x];
    }
}

tl_status tl_image_write_exr(const char *path,
                             const tl_image *image,
                             tl_exr_form form,
                             tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_writer writer = {.stream.context = NULL};
    tl_exr_channel channels[3];
    const tl_exr_picture picture = {.width = image->width,
                                    .height = image->height,
                                    .pitch = image->pitch,
                                    .channel_count = 3,
                                    .channels = channels,
                                    .compute = form.half ? cut_row : NULL,
                                    .context = image};
    for (unsigned c = 0; c < 3; c++)
        channels[c] = (tl_exr_channel){.name = channel_names[c],
                                       .type = tl_exr_type_of(form),
                                       .held = EXR_PIXEL_FLOAT,
                                       .plane = form.half ? NULL : tl_image_plane(image, c)};
    TRY(tl_exr_writer_begin(&writer, path, image->width, image->height,
                            tl_exr_compression_of(form), err));
    TRY(tl_exr_writer_pixels(&writer, &picture, err));
    TRY(tl_exr_writer_commit(&writer, err));
done:
    tl_exr_writer_abandon(&writer);
    return status;
}

tl_status tl_image_read_exr(const char *path, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_reader reader = {.is_open = false};
    tl_image *made = NULL;
    tl_exr_target targets[3];
    TRY(tl_exr_reader_open(&reader, path, err));
    for (unsigned c = 0; c < 3; c++)
        TRY(tl_exr_reader_require(&reader, channel_names[c], err));
    TRY(tl_exr_reader_check_size(&reader, (uint64_t)3 * reader.width * reader.height * 4, err));
    TRY(tl_image_create(reader.width, reader.height, &made, err));
    for (unsigned c = 0; c < 3; c++)
        targets[c] = (tl_exr_target){.channel = channel_names[c],
                                     .held = EXR_PIXEL_FLOAT,
                                     .plane = tl_image_plane(made, c)};
    TRY(tl_exr_reader_pixels(&reader, targets, 3, made->pitch, err));
    *out = made;
    made = NULL;
done:
    tl_image_destroy(made);
    tl_exr_reader_close(&reader);
    return status;
}
