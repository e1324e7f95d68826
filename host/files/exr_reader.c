#include "exr_reader.h"

#include "size_limit.h"
#include "try.h"

static bool is_within(const exr_attr_box2i_t *data, const exr_attr_box2i_t *display)
{
    return data->min.x >= display->min.x && data->min.y >= display->min.y &&
           data->max.x <= display->max.x && data->max.y <= display->max.y;
}

static tl_status check_windows(const tl_exr_reader *reader, bool may_be_part, tl_error *err)
{
    const exr_attr_box2i_t *data = &reader->part.data, *display = &reader->part.display;
    if (may_be_part && is_within(data, display))
        return TL_OK;
    if (tl_exr_part_is_uncropped(&reader->part) && data->min.x == 0 && data->min.y == 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "%s: its data window (%d, %d) to (%d, %d) is not the whole display window "
                   "(%d, %d) to (%d, %d) from (0, 0) on; save it uncropped",
                   reader->stream.path, data->min.x, data->min.y, data->max.x, data->max.y,
                   display->min.x, display->min.y, display->max.x, display->max.y);
}

static tl_status open_reader(tl_exr_reader *reader,
                             const char *path,
                             bool may_be_part,
                             tl_error *err)
{
    tl_status status = TL_OK;
    uint64_t file_size = 0;
    *reader = (tl_exr_reader){.is_open = false};
    TRY(tl_exr_stream_open(&reader->stream, path, &file_size, err));
    reader->is_open = true;
    TRY(tl_exr_part_open(&reader->stream, file_size, 0, &reader->part, err));
    TRY(check_windows(reader, may_be_part, err));
    reader->width = reader->part.width;
    reader->height = reader->part.height;
done:
    if (status != TL_OK)
        tl_exr_reader_close(reader);
    return status;
}

tl_status tl_exr_reader_open(tl_exr_reader *reader, const char *path, tl_error *err)
{
    return open_reader(reader, path, false, err);
}

tl_status tl_exr_reader_open_part(tl_exr_reader *reader, const char *path, tl_error *err)
{
    return open_reader(reader, path, true, err);
}

void tl_exr_reader_close(tl_exr_reader *reader)
{
    if (!reader->is_open)
        return;
    tl_exr_stream_close_file(&reader->stream);
    reader->is_open = false;
}

bool tl_exr_reader_has_channel(const tl_exr_reader *reader, const char *name)
{
    return tl_exr_part_channel(&reader->part, name) != NULL;
}

tl_status tl_exr_reader_require(const tl_exr_reader *reader, const char *channel, tl_error *err)
{
    const exr_attr_chlist_entry_t *found = tl_exr_part_channel(&reader->part, channel);
    if (!found)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no channel \"%s\"", reader->stream.path,
                       channel);
    if (found->pixel_type != EXR_PIXEL_HALF && found->pixel_type != EXR_PIXEL_FLOAT)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: channel \"%s\" holds whole numbers; it must be half or float",
                       reader->stream.path, channel);
    return TL_OK;
}

tl_status tl_exr_reader_require_type(const tl_exr_reader *reader,
                                     const char *channel,
                                     exr_pixel_type_t type,
                                     tl_error *err)
{
    const exr_attr_chlist_entry_t *found = tl_exr_part_channel(&reader->part, channel);
    if (!found)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no channel \"%s\"", reader->stream.path,
                       channel);
    if (found->pixel_type != type)
        return tl_fail(
            err, TL_ERR_FORMAT,
            "%s: channel \"%s\" is %s; its bits are a word of the layout, so it must "
            "be %s",
            reader->stream.path, channel, tl_exr_type_words[found->pixel_type],
            tl_exr_type_words[type]);
    return TL_OK;
}

bool tl_exr_reader_has_attribute(const tl_exr_reader *reader, const char *name)
{
    return tl_exr_part_attribute(&reader->part, name) != NULL;
}

tl_status tl_exr_reader_check_size(const tl_exr_reader *reader, uint64_t size, tl_error *err)
{
    return tl_check_decoded_size(reader->stream.path, reader->part.file_size, size, err);
}

tl_status tl_exr_reader_pixels(tl_exr_reader *reader,
                               const tl_exr_target *targets,
                               size_t target_count,
                               size_t pitch,
                               tl_error *err)
{
    return tl_exr_part_pixels(&reader->part, targets, target_count, pitch, err);
}
