#include "job_region.h"

#include "tilelight/post.h"
#include "try.h"

#include <stdlib.h>
#include <string.h>

/* Windows begin at multiples of this, in pixels: patterns that pixels take turns by, and pictures of a half
 * and a quarter of the size, then lie in them as in the whole. */
enum { GRANULE = 64 };

/* Samples that ambient occlusion looks at around its own (kernels/occlusion.h: TL_MOST_OCCLUSION_REACH),
 * those that smoothing takes in, and some more. */
enum { OCCLUSION_HALO = 256 + 8 };

static tl_status check_region(const job *j, const tl_region *region, tl_error *err)
{
    const uint32_t side = tl_samples_side(j->gbuffer->samples);
    const uint32_t width = j->gbuffer->camera.width / side,
                   height = j->gbuffer->camera.height / side;
    if (region->x + region->width <= width && region->y + region->height <= height)
        return TL_OK;
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "--region %u,%u,%u,%u leaves the picture, which has %u x %u pixels",
                   region->x, region->y, region->width, region->height, width, height);
}

/* Samples around the region's that are looked at for them. */
static tl_status find_halo(const job *j,
                           const lighting_choice *lighting,
                           const post_choice *choice,
                           tl_device *device,
                           uint32_t *halo,
                           tl_error *err)
{
    const double radius = lighting->occlusion_radius >= 0.0
                              ? lighting->occlusion_radius
                              : (double)j->lights.occlusion_radius;
    tl_post_options options = choice->options;
    tl_post *post = NULL;
    options.mend = lighting->options.kernel.text != NULL;
    const tl_status status = tl_post_create(device, &lighting->options, &options, &post, err);
    if (status != TL_OK)
        return status;
    *halo = tl_post_halo(post, j->gbuffer) + (radius > 0.0 ? OCCLUSION_HALO : 0);
    tl_post_destroy(post);
    return TL_OK;
}

/* One axis, in samples: from `first`, `count` long, grown by the halo, within `whole`; whole pixels. */
static void grow(uint32_t first,
                 uint32_t count,
                 uint32_t halo,
                 uint32_t side,
                 uint32_t whole,
                 uint32_t out[2])
{
    const uint32_t granule = GRANULE * side;
    const uint32_t from = (first > halo ? first - halo : 0) / granule * granule;
    const uint32_t to = (first + count + halo + side - 1) / side * side;
    out[0] = from;
    out[1] = (to < whole ? to : whole) - from;
}

tl_status job_cut_region(job *j,
                         const tl_region *region,
                         const lighting_choice *lighting,
                         const post_choice *post,
                         tl_device *device,
                         tl_error *err)
{
    const uint32_t side = tl_samples_side(j->gbuffer->samples);
    const tl_camera *camera = &j->gbuffer->camera;
    tl_status status = TL_OK;
    uint32_t halo = 0, across[2], down[2];
    const double start = tl_seconds();
    if (region->width == 0)
        return TL_OK;
    TRY(check_region(j, region, err));
    TRY(find_halo(j, lighting, post, device, &halo, err));
    grow(region->x * side, region->width * side, halo, side, camera->width, across);
    grow(region->y * side, region->height * side, halo, side, camera->height, down);
    const tl_region window = {across[0], down[0], across[1], down[1]};
    TRY(tl_gbuffer_cut(&j->gbuffer, &window, err));
    tl_timings_end(&j->timings, "cut", start);
done:
    return status;
}

/* *image of planes like `like`, from `planes`: the part of it. */
static tl_status crop(const tl_image *like,
                      const float *planes,
                      const tl_region *part,
                      tl_image **out,
                      tl_error *err)
{
    const tl_status status = tl_image_create(part->width, part->height, out, err);
    if (status != TL_OK)
        return status;
    for (unsigned c = 0; c < 3; c++) {
        const float *const from = planes + c * (size_t)like->pitch * like->rows;
        for (uint32_t y = 0; y < part->height; y++)
            memcpy(tl_image_plane(*out, c) + (size_t)y * (*out)->pitch,
                   from + (size_t)(part->y + y) * like->pitch + part->x,
                   part->width * sizeof *from);
    }
    return TL_OK;
}

/* Layers have the shape of the picture, and may share an image: each gets its own, and those they had go once
 * all are cut. */
static tl_status crop_layers(job *j, const tl_region *part, tl_error *err)
{
    job_aovs *const aovs = &j->aovs;
    tl_image **const cut = calloc(aovs->count + 1, sizeof(tl_image *));
    tl_status status = TL_OK;
    if (!cut)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu layers", aovs->count));
    for (size_t i = 0; i < aovs->count; i++)
        TRY(crop(j->image, aovs->layers[i].planes, part, &cut[i], err));
    for (size_t i = 0; i < aovs->count; i++) {
        tl_image *const before = aovs->images[i];
        aovs->images[i] = cut[i];
        aovs->layers[i].planes = cut[i]->planes;
        cut[i] = before;
    }
done:
    for (size_t i = 0; cut && i < aovs->count; i++)
        tl_image_destroy(cut[i]);
    free(cut);
    return status;
}

tl_status job_crop_pictures(job *j, const tl_region *region, tl_error *err)
{
    const uint32_t side = tl_samples_side(j->gbuffer->samples);
    const tl_camera *const camera = &j->gbuffer->camera;
    const tl_region part = {region->x - camera->window_x / side,
                            region->y - camera->window_y / side, region->width, region->height};
    tl_image *cut = NULL;
    tl_status status = TL_OK;
    if (region->width == 0)
        return TL_OK;
    TRY(crop(j->image, j->image->planes, &part, &cut, err));
    TRY(crop_layers(j, &part, err));
    cut->x = region->x;
    cut->y = region->y;
    cut->whole_width = tl_camera_whole_width(camera) / side;
    cut->whole_height = tl_camera_whole_height(camera) / side;
    tl_image_destroy(j->image);
    j->image = cut;
    cut = NULL;
done:
    tl_image_destroy(cut);
    return status;
}
