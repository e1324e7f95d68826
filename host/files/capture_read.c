#include "capture_read.h"

#include "import/source.h"
#include "ispc_read.h"
#include "regular_file.h"
#include "tilelight/gbuffer_file.h"
#include "try.h"

#include <stdio.h>

static bool is_exr(const tl_capture_start *start)
{
    return tl_source_exr.recognises(start->bytes, start->size);
}

static bool is_picture(const tl_capture_start *start)
{
    return !is_exr(start) && tl_import_recognises(start->bytes, start->size);
}

static tl_status import(const tl_capture_request *request, tl_captured *out, tl_error *err)
{
    const tl_import_options defaults = tl_import_options_default();
    const tl_status status =
        tl_import_read(request->path, request->import ? request->import : &defaults,
                       request->notices, &out->gbuffer, &out->counts, err);
    out->is_imported = status == TL_OK;
    return status;
}

static bool is_given(const tl_capture_request *request)
{
    return request->import && request->import->is_given;
}

static tl_light_set *wanted_lights(const tl_capture_request *request, tl_captured *out)
{
    return request->without_lights ? NULL : &out->lights;
}

/* Ours with channels mapped by hand: the lights inside go along. */
static tl_status import_own(const tl_capture_request *request, tl_captured *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_captured made = {0};
    TRY(tl_gbuffer_read_lights(request->path, wanted_lights(request, &made), &made.has_lights,
                               err));
    TRY(import(request, &made, err));
    *out = made;
    made = (tl_captured){0};
done:
    tl_captured_clear(&made);
    return status;
}

/* Ours say what their numbers mean, and are read bit for bit unless channels are mapped by hand. */
static tl_status read_exr(const tl_capture_request *request, tl_captured *out, tl_error *err)
{
    tl_status status = TL_OK;
    bool is_own = false;
    TRY(tl_gbuffer_is_own(request->path, &is_own, err));
    if (!is_own)
        TRY(import(request, out, err));
    else if (request->import && request->import->map_count > 0)
        TRY(import_own(request, out, err));
    else if (is_given(request))
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "%s: is a G-buffer of tilelight, which says itself what its numbers mean; "
                    "leave out the options for captures of other programs",
                    request->path));
    else
        TRY(tl_gbuffer_read(request->path, &out->gbuffer, wanted_lights(request, out),
                            &out->has_lights, err));
done:
    return status;
}

const tl_capture_format tl_capture_formats[] = {
    {"OpenEXR", is_exr, read_exr, true},
    {"PFM, PNG (with --map)", is_picture, import, true},
    {"ISPC deferred example", tl_ispc_recognises, tl_ispc_read, false},
};
const size_t tl_capture_format_count = sizeof tl_capture_formats / sizeof tl_capture_formats[0];

static tl_status read_start(const char *path, tl_capture_start *out, tl_error *err)
{
    *out = (tl_capture_start){.path = path};
    return tl_regular_file_start(path, out->bytes, sizeof out->bytes, &out->size,
                                 &out->file_size, err);
}

static const tl_capture_format *format_of(const tl_capture_start *start)
{
    for (size_t i = 0; i < tl_capture_format_count; i++)
        if (tl_capture_formats[i].recognises(start))
            return &tl_capture_formats[i];
    return NULL;
}

const tl_capture_format *tl_capture_format_of(const char *path)
{
    tl_capture_start start;
    return read_start(path, &start, NULL) == TL_OK ? format_of(&start) : NULL;
}

static tl_status unknown_format(const char *path, tl_error *err)
{
    char list[512] = "";
    for (size_t i = 0, used = 0; i < tl_capture_format_count && used < sizeof list; i++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "",
                                 tl_capture_formats[i].name);
    return tl_fail(err, TL_ERR_FORMAT, "%s: is no capture: it starts as none of these: %s",
                   path, list);
}

tl_status tl_capture_read(const tl_capture_request *request, tl_captured *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_captured read = {0};
    tl_capture_start start;
    const tl_capture_format *format;
    if (!request->path) {
        TRY(import(request, &read, err));
        *out = read;
        goto done;
    }
    TRY(read_start(request->path, &start, err));
    format = format_of(&start);
    if (!format)
        TRY(unknown_format(request->path, err));
    if (is_given(request) && !format->takes_options)
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "%s: is of the format %s, which says itself what its numbers mean; leave "
                    "out the options for captures of other programs",
                    request->path, format->name));
    TRY(format->read(request, &read, err));
    *out = read;
done:
    return status;
}

void tl_captured_clear(tl_captured *captured)
{
    tl_light_set_clear(&captured->lights);
    tl_gbuffer_destroy(captured->gbuffer);
    *captured = (tl_captured){0};
}
