#include "model.h"

#include "decode.h"
#include "load_limits.h"
#include "lookup.h"
#include "parallel.h"
#include "try.h"

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

typedef struct decoding {
    const tl_gltf *gltf;
    size_t count;
    struct item {
        size_t image;
        tl_gltf_bytes bytes;
        tl_texels texels;
    } * items; /* [count] */
} decoding;

/* Checks all that the file says of the image before anything is decoded. */
static tl_status add_image(decoding *work,
                           size_t image,
                           const tl_gltf_bytes *bytes,
                           uint64_t *texel_bytes,
                           tl_error *err)
{
    struct item item = {image, *bytes, {0}};
    tl_status status = check_format(work->gltf, image, bytes, err);
    if (status != TL_OK)
        return status;
    if (!tl_decode_size(bytes->data, bytes->size, &item.texels.width, &item.texels.height))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s is damaged, or larger than %d pixels per side", work->gltf->path,
                       label_of(work->gltf, image).text, TL_MAX_IMAGE_EXTENT);
    *texel_bytes += (uint64_t)4 * item.texels.width * item.texels.height;
    if (item.texels.width > TL_MAX_IMAGE_EXTENT || item.texels.height > TL_MAX_IMAGE_EXTENT ||
        *texel_bytes > tl_max_texel_bytes)
        return tl_fail(
            err, TL_ERR_UNSUPPORTED,
            "%s: %s with its %u x %u pixels is more than fits: %d per side, and %llu "
            "million pixels for all images",
            work->gltf->path, label_of(work->gltf, image).text, item.texels.width,
            item.texels.height, TL_MAX_IMAGE_EXTENT,
            (unsigned long long)(tl_max_texel_bytes / 4000000));
    work->items[work->count++] = item;
    return status;
}

static void decode_range(void *context, size_t begin, size_t end)
{
    const decoding *const work = context;
    for (size_t i = begin; i < end; i++) {
        struct item *const item = &work->items[i];
        item->texels.rgba = tl_decode_rgba8(item->bytes.data, item->bytes.size,
                                            item->texels.width, item->texels.height);
    }
}

static void drop_texture(tl_model *model, int texture)
{
    for (size_t i = 0; i < model->material_count; i++)
        for (int slot = 0; slot < TL_GLTF_SLOT_COUNT; slot++)
            if (model->materials[i].slots[slot].texture == texture)
                model->materials[i].slots[slot].texture = -1;
}

/* Lists the images that textures show, once each. `asked` is [image_count]. */
static tl_status list_images(
    tl_model *model, decoding *work, bool *asked, const tl_notices *notices, tl_error *err)
{
    const tl_gltf *const gltf = model->gltf;
    uint64_t texel_bytes = 0;
    for (size_t i = 0; i < model->texture_count; i++) {
        const size_t image = (size_t)model->textures[i].image;
        const tl_label label = label_of(gltf, image);
        tl_gltf_bytes bytes = gltf->images[image].bytes;
        tl_status status = TL_OK;
        if (gltf->images[image].view != -1)
            status =
                tl_gltf_view_bytes(gltf, label.text, gltf->images[image].view, &bytes, err);
        if (status == TL_OK && !bytes.data) {
            if (!asked[image])
                tl_notice(notices, "%s: %s cannot be read; factors are used without it",
                          gltf->path, label.text);
            drop_texture(model, (int)i);
        } else if (status == TL_OK && !asked[image])
            status = add_image(work, image, &bytes, &texel_bytes, err);
        if (status != TL_OK)
            return status;
        asked[image] = true;
    }
    return TL_OK;
}

tl_status tl_model_decode(tl_model *model, const tl_notices *notices, tl_error *err)
{
    tl_status status = TL_OK;
    decoding work = {.gltf = model->gltf,
                     .items = calloc(model->image_count + 1, sizeof *work.items)};
    bool *const asked = calloc(model->image_count + 1, sizeof *asked);

    if (!work.items || !asked) {
        status =
            tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its images", model->gltf->path);
        goto done;
    }
    TRY(list_images(model, &work, asked, notices, err));
    tl_parallel(work.count, 1, decode_range, &work);
    for (size_t i = 0; i < work.count; i++) {
        model->images[work.items[i].image] = work.items[i].texels;
        if (!work.items[i].texels.rgba && status == TL_OK)
            status =
                tl_fail(err, TL_ERR_FORMAT, "%s: %s is damaged and cannot be decoded",
                        model->gltf->path, label_of(model->gltf, work.items[i].image).text);
    }
done:
    free(work.items);
    free(asked);
    return status;
}
