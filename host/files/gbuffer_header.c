#include "gbuffer_header.h"

#include "camera_attributes.h"
#include "packing.h"
#include "plane_channels.h"
#include "try.h"

#include <inttypes.h>
#include <string.h>

enum { KNOWN_VERSION = 1 };

static tl_status check_version(tl_exr_reader *reader, tl_error *err)
{
    tl_status status = TL_OK;
    const char *path = reader->stream.path;
    int32_t version = 0;
    if (!tl_exr_reader_has_attribute(reader, "tilelight:version"))
        TRY(tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s: is no G-buffer of tilelight: it has no attribute \"tilelight:version\", so "
            "its camera is missing; capture the scene with tilelight",
            path));
    if (exr_attr_get_int(reader->stream.context, 0, "tilelight:version", &version) !=
        EXR_ERR_SUCCESS)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: attribute \"tilelight:version\" is not of type int", path));
    if (version != KNOWN_VERSION)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: is a G-buffer of version %" PRId32 "; this program reads version %d",
                    path, version, KNOWN_VERSION));
done:
    return status;
}

/* *out is the context's. */
static tl_status read_text(tl_exr_reader *reader,
                           const char *attribute,
                           const char **out,
                           tl_error *err)
{
    int32_t length;
    if (!tl_exr_reader_has_attribute(reader, attribute) ||
        exr_attr_get_string(reader->stream.context, 0, attribute, &length, out) !=
            EXR_ERR_SUCCESS)
        return tl_fail(err, TL_ERR_FORMAT, "%s: has no attribute \"%s\" of type string",
                       reader->stream.path, attribute);
    return TL_OK;
}

static tl_status read_layout(tl_exr_reader *reader, enum tl_layout_name *out, tl_error *err)
{
    tl_status status = TL_OK;
    const char *word = NULL;
    tl_error reason;
    TRY(read_text(reader, "tilelight:layout", &word, err));
    if (tl_layout_find(word, out, &reason) != TL_OK)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED, "%s: attribute \"tilelight:layout\": %s",
                    reader->stream.path, reason.message));
done:
    return status;
}

/* Of full float: which planes the file has, every group whole. */
static tl_status find_planes(const tl_exr_reader *reader, uint32_t *present, tl_error *err)
{
    static const uint32_t groups[] = {TL_GROUP_PHONG, TL_GROUP_METAL_ROUGH, TL_GROUP_OCCLUSION,
                                      TL_GROUP_EMISSIVE, TL_GROUP_TANGENT};
    tl_status status = TL_OK;
    uint32_t found = 0, wanted = TL_GROUP_BASE;
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if (tl_exr_reader_has_channel(reader, tl_plane_channels[p]))
            found |= TL_HAS(p);
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; i++)
        if (found & groups[i])
            wanted |= groups[i];
    /* An index may be a number of any type; and beside it an exponent may stand alone. */
    wanted |= found & TL_GROUP_BRDF;
    if ((found & TL_GROUP_BRDF) && !(found & TL_THREE(TL_SPECULAR_R)))
        wanted &= ~TL_THREE(TL_SPECULAR_R);
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        if ((wanted & TL_HAS(p)) && p != TL_BRDF)
            TRY(tl_exr_reader_require(reader, tl_plane_channels[p], err));
    *present = wanted;
done:
    return status;
}

/* TL_PLANE_COUNT where it is none. */
static enum tl_plane plane_called(const char *name, size_t length)
{
    enum tl_plane p = 0;
    while (p < TL_PLANE_COUNT && (strlen(tl_plane_channels[p]) != length ||
                                  memcmp(tl_plane_channels[p], name, length) != 0))
        p++;
    return p;
}

/* Of a packed file: which planes its words stand for. */
static tl_status read_planes_named(tl_exr_reader *reader,
                                   enum tl_layout_name layout,
                                   uint32_t *present,
                                   tl_error *err)
{
    static const char attribute[] = "tilelight:planes";
    tl_status status = TL_OK;
    const char *path = reader->stream.path, *text = NULL;
    uint32_t found = 0;
    TRY(read_text(reader, attribute, &text, err));
    while (*text) {
        const size_t length = strcspn(text, " ");
        const enum tl_plane p = plane_called(text, length);
        if (p == TL_PLANE_COUNT || (found & TL_HAS(p)))
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\": \"%.*s\" is %s", path,
                        attribute, length < 64 ? (int)length : 64, text,
                        p == TL_PLANE_COUNT ? "no plane" : "there twice"));
        if (!(tl_layout_planes(layout) & TL_HAS(p)))
            TRY(tl_fail(err, TL_ERR_FORMAT,
                        "%s: attribute \"%s\": layout %s has no place for \"%s\"", path,
                        attribute, tl_layout_word(layout), tl_plane_channels[p]));
        found |= TL_HAS(p);
        text += length + (text[length] == ' ');
    }
    if (tl_layout_planes_of(layout, found) != found)
        TRY(tl_fail(
            err, TL_ERR_FORMAT,
            "%s: attribute \"%s\": layout %s has one place for \"specular\" and \"brdf\", "
            "not both",
            path, attribute, tl_layout_word(layout)));
    *present = found;
done:
    return status;
}

/* Every channel that a packed file needs, as it must be. */
static tl_status require_words(const tl_exr_reader *reader,
                               const tl_word_channel *channels,
                               size_t count,
                               tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < count; i++)
        TRY(tl_exr_reader_require_type(reader, channels[i].name,
                                       (exr_pixel_type_t)channels[i].type, err));
done:
    return status;
}

/* Without the attribute a pixel is a sample. */
static tl_status read_samples(tl_exr_reader *reader, uint32_t *out, tl_error *err)
{
    static const char attribute[] = "tilelight:samples";
    const char *path = reader->stream.path;
    int32_t samples = 1;
    *out = 1;
    if (!tl_exr_reader_has_attribute(reader, attribute))
        return TL_OK;
    if (exr_attr_get_int(reader->stream.context, 0, attribute, &samples) != EXR_ERR_SUCCESS)
        return tl_fail(err, TL_ERR_FORMAT, "%s: attribute \"%s\" is not of type int", path,
                       attribute);
    const uint32_t side = samples > 0 ? tl_samples_side((uint32_t)samples) : 0;
    if (side == 0)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: attribute \"%s\" is %" PRId32
                       ", which is no square number from 1 to %d",
                       path, attribute, samples, TL_MAX_SAMPLES);
    if (reader->width % side || reader->height % side)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %u x %u pixels are no whole number of %u x %u samples", path,
                       reader->width, reader->height, side, side);
    *out = (uint32_t)samples;
    return TL_OK;
}

tl_status tl_gbuffer_header_read(tl_exr_reader *reader, tl_gbuffer_header *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_error reason = {.status = TL_OK};
    TRY(check_version(reader, err));
    TRY(read_layout(reader, &out->layout, err));
    TRY(tl_camera_attributes_read(&reader->stream, 0, reader->width, reader->height,
                                  &out->camera, err));
    TRY(read_samples(reader, &out->samples, err));
    if (out->layout == TL_LAYOUT_FLOAT)
        TRY(find_planes(reader, &out->present, err));
    else
        TRY(read_planes_named(reader, out->layout, &out->present, err));
    if (tl_planes_check(out->present, &reason) != TL_OK ||
        tl_layout_suits(&out->camera, out->layout, &reason) != TL_OK)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: %.3000s", reader->stream.path, reason.message));
    out->channel_count = tl_word_channels(out->layout, out->present, out->channels);
    if (out->layout != TL_LAYOUT_FLOAT)
        TRY(require_words(reader, out->channels, out->channel_count, err));
done:
    return status;
}
