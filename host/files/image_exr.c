#include "image_exr.h"

#include "exr_compression.h"
#include "exr_reader.h"
#include "exr_writer.h"
#include "image_record.h"
#include "ranges.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>

enum { CHANNEL = sizeof((tl_image_layer *)NULL)->name + 2 };

static const char *const channel_names[3] = {"R", "G", "B"};

/* Its channels as they are written: those of the picture, then those of layers. */
typedef struct layered {
    const tl_image *image;
    size_t count;             /* channels */
    const float **planes;     /* [count] */
    char (*names)[CHANNEL];   /* [count] */
    tl_exr_channel *channels; /* [count] */
} layered;

/* A row in floats that halves hold. */
static void cut_row(const void *context, uint32_t y, void *const *rows)
{
    const layered *of = context;
    for (size_t c = 0; c < of->count; c++) {
        const float *from = of->planes[c] + (size_t)y * of->image->pitch;
        float *to = rows[c];
        for (uint32_t x = 0; x < of->image->width; x++)
            to[x] = from[x] > TL_MOST_HALF ? TL_MOST_HALF : from[x];
    }
}

static void set_channel(layered *of, const char *layer, const float *planes, unsigned color)
{
    const size_t i = of->count++;
    snprintf(of->names[i], CHANNEL, "%s%s%s", layer, layer[0] ? "." : "", channel_names[color]);
    of->planes[i] = planes + color * (size_t)of->image->pitch * of->image->rows;
}

/* *out, released with release, also where it fails. */
static tl_status join_layers(const tl_image *image,
                             const tl_image_layer *layers,
                             size_t count,
                             tl_exr_form form,
                             layered *out,
                             tl_error *err)
{
    const size_t channels = 3 * (count + 1);
    *out = (layered){.image = image,
                     .planes = calloc(channels, sizeof *out->planes),
                     .names = calloc(channels, sizeof *out->names),
                     .channels = calloc(channels, sizeof *out->channels)};
    if (!out->planes || !out->names || !out->channels)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu channels", channels);
    for (unsigned c = 0; c < 3; c++)
        set_channel(out, "", image->planes, c);
    for (size_t i = 0; i < count; i++)
        for (unsigned c = 0; c < 3; c++)
            set_channel(out, layers[i].name, layers[i].planes, c);
    for (size_t i = 0; i < channels; i++)
        out->channels[i] = (tl_exr_channel){.name = out->names[i],
                                            .type = tl_exr_type_of(form),
                                            .held = EXR_PIXEL_FLOAT,
                                            .plane = form.half ? NULL : out->planes[i]};
    return TL_OK;
}

static void release(layered *of)
{
    free(of->channels);
    free(of->names);
    free(of->planes);
}

tl_status tl_image_write_layers(const char *path,
                                const tl_image *image,
                                const tl_image_layer *layers,
                                size_t count,
                                tl_exr_form form,
                                tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_writer writer = {.stream.context = NULL};
    layered of;
    TRY(join_layers(image, layers, count, form, &of, err));
    const tl_exr_picture picture = {.width = image->width,
                                    .height = image->height,
                                    .pitch = image->pitch,
                                    .channel_count = of.count,
                                    .channels = of.channels,
                                    .compute = form.half ? cut_row : NULL,
                                    .context = &of};
    TRY(tl_exr_writer_begin(&writer, path, image->width, image->height,
                            tl_exr_compression_of(form), err));
    if (image->whole_width > 0)
        TRY(tl_exr_writer_window(&writer, image->x, image->y, image->whole_width,
                                 image->whole_height, err));
    if (form.record)
        TRY(tl_exr_check(
            &writer.stream,
            exr_attr_set_string(writer.stream.context, 0, TL_IMAGE_RECORD_NAME, form.record),
            err));
    TRY(tl_exr_writer_pixels(&writer, &picture, err));
    TRY(tl_exr_writer_commit(&writer, err));
done:
    tl_exr_writer_abandon(&writer);
    release(&of);
    return status;
}

tl_status tl_image_write_exr(const char *path,
                             const tl_image *image,
                             tl_exr_form form,
                             tl_error *err)
{
    return tl_image_write_layers(path, image, NULL, 0, form, err);
}

/* Where it lies in the display window, of one that is not as large. */
static void set_place(const tl_exr_part *part, tl_image *image)
{
    const exr_attr_box2i_t *data = &part->data, *display = &part->display;
    if (tl_exr_part_is_uncropped(part))
        return;
    image->x = (uint32_t)(data->min.x - display->min.x);
    image->y = (uint32_t)(data->min.y - display->min.y);
    image->whole_width = (uint32_t)(display->max.x - display->min.x + 1);
    image->whole_height = (uint32_t)(display->max.y - display->min.y + 1);
}

tl_status tl_image_read_exr(const char *path, tl_image **out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_reader reader = {.is_open = false};
    tl_image *made = NULL;
    tl_exr_target targets[3];
    TRY(tl_exr_reader_open_part(&reader, path, err));
    for (unsigned c = 0; c < 3; c++)
        TRY(tl_exr_reader_require(&reader, channel_names[c], err));
    TRY(tl_exr_reader_check_size(&reader, (uint64_t)3 * reader.width * reader.height * 4, err));
    TRY(tl_image_create(reader.width, reader.height, &made, err));
    for (unsigned c = 0; c < 3; c++)
        targets[c] = (tl_exr_target){.channel = channel_names[c],
                                     .held = EXR_PIXEL_FLOAT,
                                     .plane = tl_image_plane(made, c)};
    TRY(tl_exr_reader_pixels(&reader, targets, 3, made->pitch, err));
    set_place(&reader.part, made);
    *out = made;
    made = NULL;
done:
    tl_image_destroy(made);
    tl_exr_reader_close(&reader);
    return status;
}
