#include "loading.h"

#include "decode.h"
#include "load_limits.h"
#include "lookup.h"
#include "parallel.h"
#include "size_limit.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* How image files begin. */
static const struct {
    const char *name;
    size_t offset, length;
    const char *magic;
    bool readable;
} formats[] = {
    {"PNG", 0, 4, "\x89PNG", true},      {"JPEG", 0, 3, "\xff\xd8\xff", true},
    {"KTX2", 0, 7, "\xabKTX 20", false}, {"WebP", 8, 4, "WEBP", false},
    {"DDS", 0, 4, "DDS ", false},        {"GIF", 0, 3, "GIF", false},
    {"AVIF", 4, 4, "ftyp", false},       {"BMP", 0, 2, "BM", false},
};

static tl_label label_of(const tl_gltf *gltf, size_t image)
{
    const tl_gltf_image *const from = &gltf->images[image];
    return tl_label_of("image", image, from->name[0] ? from->name : from->uri);
}

static tl_status check_format(const tl_gltf *gltf,
                              size_t image,
                              const tl_gltf_bytes *bytes,
                              tl_error *err)
{
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        if (bytes->size < formats[i].offset + formats[i].length ||
            memcmp(bytes->data + formats[i].offset, formats[i].magic, formats[i].length) != 0)
            continue;
        if (formats[i].readable)
            return TL_OK;
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s is %s; only PNG and JPEG can be read, so convert it", gltf->path,
                       label_of(gltf, image).text, formats[i].name);
    }
    return tl_fail(err, TL_ERR_FORMAT, "%s: %s is neither PNG nor JPEG", gltf->path,
                   label_of(gltf, image).text);
}

/* All pixels together must stay below the limit: 8 bytes each once decoded, 11 with mipmaps; and none be
 * out of proportion to its file. */
static tl_status check_size(const tl_model *model, const tl_pixels *wanted, tl_error *err)
{
    const uint64_t size = (uint64_t)8 * wanted->width * wanted->height;
    uint64_t sum = size;
    char where[1280];
    for (size_t i = 0; i < model->pixels_count; i++)
        sum += (uint64_t)8 * model->pixels[i].width * model->pixels[i].height;
    if (wanted->width > TL_MAX_IMAGE_EXTENT || wanted->height > TL_MAX_IMAGE_EXTENT ||
        sum > tl_max_texel_bytes)
        return tl_fail(err, TL_ERR_UNSUPPORTED,
                       "%s: %s with its %u x %u pixels is more than fits: %d per side, and "
                       "%llu million pixels for all images",
                       model->gltf->path, label_of(model->gltf, wanted->image).text,
                       wanted->width, wanted->height, TL_MAX_IMAGE_EXTENT,
                       (unsigned long long)(tl_max_texel_bytes / 8000000));
    snprintf(where, sizeof where, "%.1000s: %s", model->gltf->path,
             label_of(model->gltf, wanted->image).text);
    return tl_check_decoded_size(where, wanted->bytes.size, size, err);
}

static tl_status add_pixels(tl_model *model, const tl_pixels *wanted, tl_error *err)
{
    tl_pixels made = *wanted;
    tl_status status = TL_OK;
    TRY(check_format(model->gltf, made.image, &made.bytes, err));
    if (!tl_decode_size(made.bytes.data, made.bytes.size, &made.width, &made.height)) {
        status = tl_fail(
            err, TL_ERR_FORMAT, "%s: %s is damaged, or larger than %d pixels per side",
            model->gltf->path, label_of(model->gltf, made.image).text, TL_MAX_IMAGE_EXTENT);
        goto done;
    }
    TRY(check_size(model, &made, err));
    model->pixels[model->pixels_count++] = made;
done:
    return status;
}

tl_status tl_find_pixels(tl_model *model,
                         int image,
                         bool srgb,
                         bool mipmaps,
                         const tl_notices *notices,
                         size_t *out,
                         tl_error *err)
{
    const tl_gltf_image *const from = &model->gltf->images[image];
    const tl_label label = label_of(model->gltf, (size_t)image);
    tl_pixels wanted = {.image = (size_t)image, .bytes = from->bytes, .srgb = srgb};
    tl_status status = TL_OK;
    size_t at = 0;

    if (from->view != -1)
        TRY(tl_gltf_view_bytes(model->gltf, label.text, from->view, &wanted.bytes, err));
    if (!wanted.bytes.data) {
        tl_notice(notices, "%s: %s cannot be read; factors are used without it",
                  model->gltf->path, label.text);
        *out = PIXELS_MISSING;
        goto done;
    }
    while (at < model->pixels_count &&
           (model->pixels[at].image != wanted.image || model->pixels[at].srgb != wanted.srgb))
        at++;
    if (at == model->pixels_count)
        TRY(add_pixels(model, &wanted, err));
    model->pixels[at].mipmaps |= mipmaps;
    *out = at;
done:
    return status;
}

typedef struct decoding {
    const tl_pixels *pixels;
    tl_texels *out;
    tl_status *statuses; /* one for each */
} decoding;

static tl_status decode(const tl_pixels *from, tl_texels *to)
{
    const size_t wanted = (size_t)4 * from->width * from->height;
    if (to->capacity < wanted) {
        free(to->rgba);
        to->rgba = malloc(wanted * sizeof *to->rgba);
        to->capacity = to->rgba ? wanted : 0;
        if (!to->rgba)
            return TL_ERR_MEMORY;
    }
    return tl_decode_rgba16(from->bytes.data, from->bytes.size, from->width, from->height,
                            from->srgb, to->rgba)
               ? TL_OK
               : TL_ERR_FORMAT;
}

static void decode_range(void *context, size_t begin, size_t end)
{
    const decoding *const work = context;
    for (size_t i = begin; i < end; i++)
        work->statuses[i] = decode(&work->pixels[i], &work->out[i]);
}

tl_status tl_model_decode(
    const tl_model *model, size_t first, size_t count, tl_texels *out, tl_error *err)
{
    tl_status *const statuses = calloc(count + 1, sizeof *statuses);
    decoding work = {model->pixels + first, out, statuses};
    tl_status status = TL_OK;
    if (!statuses)
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its images",
                       model->gltf->path);
    tl_parallel(count, 1, decode_range, &work);
    for (size_t i = 0; i < count && status == TL_OK; i++)
        if (statuses[i] != TL_OK)
            status = tl_fail(
                err, statuses[i],
                statuses[i] == TL_ERR_MEMORY ? "%s: out of memory for %s"
                                             : "%s: %s is damaged and cannot be decoded",
                model->gltf->path, label_of(model->gltf, model->pixels[first + i].image).text);
    free(statuses);
    return status;
}
