#include "bands.h"

#include "layout.h"
#include "try.h"

#include <string.h>

/* One band: rows of tiles [first, first + count) of the frame. */
typedef struct band {
    uint32_t first, count;
} band;

/* Whether the picture's planes are on the device whatever the band: where they are the host's own memory, and
 * where pixels are dimmed by what stands around them, in other bands too. */
static int has_whole_planes(const tl_pass_context *c)
{
    return c->device->shares_memory || c->prepared->needs.surroundings;
}

/* Planes of the picture, and of the terms of its radiance that are written by themselves. */
static uint32_t picture_planes(const tl_pass_context *c)
{
    return TL_PICTURE_PLANES(c->programs[TL_PART_SHADE]->options.split);
}

/* Of the words and the radiance; of a layer its opacity and the picture behind it, too. */
static uint64_t bytes_per_pixel(const tl_pass_context *c, const tl_gbuffer *gbuffer)
{
    const uint64_t picture = picture_planes(c) * sizeof(float);
    const uint64_t of_layer = gbuffer->opacity ? sizeof(float) + picture : 0;
    return tl_gbuffer_pixel_size(gbuffer) + picture + of_layer;
}

/* Bytes of the device's own memory per row of tiles, lists apart. */
static uint64_t bytes_per_row(const tl_pass_context *c, const tl_gbuffer *gbuffer)
{
    const tl_frame *frame = &c->prepared->frame;
    const uint64_t element = c->precision_is_double ? sizeof(double) : sizeof(float);
    const uint64_t tiles =
        (TL_MAX_BOXES * 6 * element + (1 + TL_LIGHT_BLOCK / 32) * sizeof(cl_int)) *
            frame->box_pitch +
        2 * sizeof(cl_uint) * frame->tiles_x + sizeof(cl_ulong);
    const uint64_t pixels = bytes_per_pixel(c, gbuffer) * frame->pitch * frame->tile_size;
    return tiles + (has_whole_planes(c) ? 0 : pixels);
}

/* Of what bands have in common: lights, and planes that are there whole. */
static uint64_t bytes_in_common(const tl_pass_context *c, const tl_gbuffer *gbuffer)
{
    const uint64_t count = c->prepared->frame.light_count;
    const uint64_t planes =
        (uint64_t)gbuffer->pitch * gbuffer->rows * bytes_per_pixel(c, gbuffer);
    return tl_prepared_buffer_size(c->prepared) +
           TL_RECT_PLANE_COUNT * TL_RECT_PITCH(count) * sizeof(cl_int) +
           (has_whole_planes(c) && !c->device->shares_memory ? planes : 0);
}

static tl_status too_small(const tl_band_options *options, uint64_t needed, tl_error *err)
{
    return tl_fail(err, TL_ERR_ARGUMENT,
                   "%llu bytes of device memory do not hold one row of tiles of this frame: it "
                   "takes about %llu; allow more (--memory) or use smaller tiles (--tile)",
                   (unsigned long long)options->memory_limit, (unsigned long long)needed);
}

/* Rows of tiles in which there is anything to light: of a layer those that show something. */
static band lit_rows(const tl_pass_context *c, const tl_gbuffer *gbuffer)
{
    const uint32_t tile = c->prepared->frame.tile_size;
    if (!gbuffer->opacity)
        return (band){0, c->prepared->frame.tiles_y};
    const uint32_t first = gbuffer->shown_from / tile;
    return (band){first, (gbuffer->shown_to + tile - 1) / tile - first};
}

/* The rows of the largest band whose fixed part fits. */
static tl_status first_guess(const tl_pass_context *c,
                             const tl_band_options *options,
                             const tl_gbuffer *gbuffer,
                             uint32_t *rows,
                             tl_error *err)
{
    const uint64_t row = bytes_per_row(c, gbuffer), lights = bytes_in_common(c, gbuffer);
    *rows = c->prepared->frame.tiles_y;
    if (options->memory_limit == 0)
        return TL_OK;
    if (lights + row > options->memory_limit)
        return too_small(options, lights + row, err);
    const uint64_t most = (options->memory_limit - lights) / row;
    *rows = most < *rows ? (uint32_t)most : *rows;
    return TL_OK;
}

static void aim_at(tl_pass_context *c, const tl_gbuffer *gbuffer, band at)
{
    const uint32_t tile = c->prepared->frame.tile_size;
    c->frame = c->prepared->frame;
    c->frame.tiles_y = at.count;
    c->frame.first_row = at.first * tile;
    c->frame.rows = has_whole_planes(c) ? gbuffer->rows : at.count * tile;
    c->frame.buffer_row = has_whole_planes(c) ? c->frame.first_row : 0;
}

tl_status tl_bands_upload_words(tl_pass_context *c, const tl_gbuffer *gbuffer, tl_error *err)
{
    const size_t pixels = (size_t)gbuffer->pitch * c->frame.rows;
    const size_t first_row = c->frame.first_row - c->frame.buffer_row;
    tl_status status = TL_OK;
    size_t before = 0;
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_PLANES,
                           pixels * tl_gbuffer_pixel_size(gbuffer), err));
    for (uint32_t i = 0; i < TL_MAX_WORDS; i++) {
        const size_t bytes = tl_gbuffer_word_size(gbuffer, i);
        if (bytes == 0)
            continue;
        const unsigned char *from = tl_gbuffer_words(gbuffer, i);
        TRY(tl_cl(
            clEnqueueWriteBuffer(c->device->queue, c->buffers->of[TL_BUFFER_PLANES].memory,
                                 CL_TRUE, before * pixels, bytes * pixels,
                                 from + bytes * gbuffer->pitch * first_row, 0, NULL, NULL),
            "clEnqueueWriteBuffer", err));
        before += bytes;
    }
done:
    return status;
}

/* Shared planes stay where they are; others travel a band at a time. The last tile row may reach
 * below the image, never below the padding. */
static tl_status upload(tl_pass_context *c,
                        const tl_gbuffer *gbuffer,
                        tl_image *image,
                        tl_error *err)
{
    const size_t host_pixels = (size_t)gbuffer->pitch * gbuffer->rows;
    const size_t pixels = (size_t)gbuffer->pitch * c->frame.rows;
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_PLANES, gbuffer->planes,
                             host_pixels * tl_gbuffer_pixel_size(gbuffer), err));
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_RADIANCE, image->planes,
                             picture_planes(c) * host_pixels * sizeof(float), err));
    } else {
        TRY(tl_bands_upload_words(c, gbuffer, err));
        TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_RADIANCE,
                               picture_planes(c) * pixels * sizeof(float), err));
    }
done:
    return status;
}

/* What a layer is blended by, and over. */
static tl_status upload_behind(tl_pass_context *c,
                               const tl_gbuffer *layer,
                               tl_image *image,
                               tl_error *err)
{
    const size_t pixels = (size_t)layer->pitch * c->frame.rows,
                 host_pixels = (size_t)layer->pitch * layer->rows;
    const size_t first = (size_t)layer->pitch * c->frame.first_row;
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_OPACITY, layer->opacity,
                             host_pixels * sizeof(float), err));
        TRY(tl_buffers_share(c->buffers, c->device, TL_BUFFER_BEHIND, image->planes,
                             picture_planes(c) * host_pixels * sizeof(float), err));
        goto done;
    }
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_OPACITY, pixels * sizeof(float),
                           err));
    TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_BEHIND,
                           picture_planes(c) * pixels * sizeof(float), err));
    TRY(tl_buffers_write(c->buffers, c->device, TL_BUFFER_OPACITY, layer->opacity + first,
                         pixels * sizeof(float), err));
    for (unsigned color = 0; color < picture_planes(c); color++)
        TRY(tl_cl(clEnqueueWriteBuffer(c->device->queue,
                                       c->buffers->of[TL_BUFFER_BEHIND].memory, CL_TRUE,
                                       color * pixels * sizeof(float), pixels * sizeof(float),
                                       tl_image_plane(image, color) + first, 0, NULL, NULL),
                  "clEnqueueWriteBuffer", err));
done:
    return status;
}

static tl_status upload_lights(tl_pass_context *c, tl_error *err)
{
    const size_t size = tl_prepared_lights_size(c->prepared);
    const tl_status status = tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_LIGHTS,
                                                tl_prepared_buffer_size(c->prepared), err);
    if (status != TL_OK)
        return status;
    return tl_buffers_send(c->buffers, c->device, TL_BUFFER_LIGHTS, c->prepared->lights, size,
                           err);
}

/* Of the buffer that holds the picture. Where memory is shared, mapping is how the host gets to see what the
 * device wrote, once the queue is empty. */
static tl_status read_back(tl_pass_context *c,
                           tl_buffer_name from,
                           tl_image *image,
                           tl_error *err)
{
    const size_t row = (size_t)image->pitch * sizeof(float), host_plane = row * image->rows;
    tl_status status = TL_OK;
    if (c->device->shares_memory) {
        TRY(tl_buffers_touch(c->buffers, c->device, from, CL_MAP_READ,
                             picture_planes(c) * host_plane, err));
        TRY(tl_pass_finish(c, err));
    } else {
        const size_t rows = (size_t)c->frame.tiles_y * c->frame.tile_size;
        const size_t origin[3] = {0, c->frame.buffer_row, 0},
                     host_origin[3] = {0, c->frame.first_row, 0};
        const size_t region[3] = {row, rows, picture_planes(c)};
        TRY(tl_cl(clEnqueueReadBufferRect(c->device->queue, c->buffers->of[from].memory,
                                          CL_TRUE, origin, host_origin, region, row,
                                          row * c->frame.rows, row, host_plane, image->planes,
                                          0, NULL, NULL),
                  "clEnqueueReadBufferRect", err));
    }
done:
    return status;
}

/* Whether the lists of the band can be written: indices are 32 bits, and the limit holds. */
static int fits(const tl_pass_context *c,
                const tl_band_options *options,
                const tl_gbuffer *gbuffer,
                const tl_list_lengths *lengths,
                uint64_t *needed)
{
    *needed = bytes_in_common(c, gbuffer) + bytes_per_row(c, gbuffer) * c->frame.tiles_y +
              (lengths->tiles + lengths->cells) * sizeof(cl_uint);
    return lengths->tiles <= UINT32_MAX && lengths->cells <= UINT32_MAX &&
           (options->memory_limit == 0 || *needed <= options->memory_limit);
}

int tl_bands_cull(const tl_prepared *prepared, const tl_band_options *options)
{
    return options->cull && prepared->frame.light_count > prepared->frame.global_count;
}

/* *fitted is 0, and the lists are not complete, where they turn out too long and the band has more
 * than one row to give up. */
static tl_status list_band(tl_pass_context *c,
                           const tl_band_options *options,
                           const tl_gbuffer *gbuffer,
                           uint64_t *list_length,
                           double *ms,
                           int *fitted,
                           tl_error *err)
{
    tl_status status = TL_OK;
    tl_list_lengths lengths;
    uint64_t needed = 0;
    TRY(tl_pass_cull(c, &lengths, ms, err));
    while ((*fitted = fits(c, options, gbuffer, &lengths, &needed)) &&
           !tl_lists_fit(c, &lengths))
        TRY(tl_pass_cull_again(c, &lengths, ms, err));
    if (!*fitted && c->frame.tiles_y == 1)
        TRY(too_small(options, needed, err));
    *list_length = lengths.tiles;
done:
    return status;
}

static tl_status cull_band(tl_pass_context *c,
                           const tl_band_options *options,
                           const tl_gbuffer *gbuffer,
                           tl_lighting_counts *counts,
                           int *fitted,
                           tl_error *err)
{
    tl_status status = TL_OK;
    uint64_t list_length = 0;
    *fitted = 1;
    if (tl_bands_cull(c->prepared, options))
        TRY(list_band(c, options, gbuffer, &list_length, &counts->device_cull_ms, fitted, err));
    else
        TRY(tl_pass_list_all(c, &list_length, err));
    TRY(tl_pass_finish(c, err));
    if (*fitted)
        counts->list_length += list_length;
done:
    return status;
}

static tl_status shade(tl_pass_context *c, tl_lighting_counts *counts, tl_error *err)
{
    const double clock = tl_seconds(), busy = tl_processor_seconds();
    tl_status status = TL_OK;
    TRY(tl_pass_shade(c, &counts->device_shade_ms, err));
    if (c->programs[TL_PART_BLEND])
        TRY(tl_pass_blend(c, &counts->device_shade_ms, err));
    TRY(tl_pass_finish(c, err));
    counts->shade_wall_ms += 1e3 * (tl_seconds() - clock);
    counts->shade_processor_ms += 1e3 * (tl_processor_seconds() - busy);
done:
    return status;
}

/* Entries [start, end) of the list, of a tile. */
static void keep_list(
    const tl_kept_lists *kept, size_t tile, const cl_uint *list, cl_uint start, cl_uint end)
{
    kept->lights[tile] = end - start;
    kept->effects[tile] = 0;
    for (cl_uint i = start; i < end; i++) {
        const uint64_t effects = kept->light_effects[list[i]];
        kept->effects[tile] |= effects;
        for (uint64_t rest = effects; rest; rest &= rest - 1)
            kept->pairs[__builtin_ctzll(rest)]++;
    }
}

/* What is kept of the band's lists, at their places in the frame. */
static tl_status keep_lists(tl_pass_context *c,
                            const tl_kept_lists *kept,
                            uint64_t list_length,
                            tl_error *err)
{
    static const tl_buffer_name names[] = {TL_BUFFER_STARTS, TL_BUFFER_ENDS, TL_BUFFER_LIST};
    const size_t count = tl_tile_count(&c->frame), size = count * sizeof(cl_uint);
    const size_t first = c->frame.first_row / c->frame.tile_size * (size_t)c->frame.tiles_x;
    const size_t sizes[] = {size, size, (size_t)list_length * sizeof(cl_uint)};
    const cl_uint *of[3] = {NULL};
    tl_status status = TL_OK;
    for (int i = 0; i < 3; i++) {
        void *mapped = NULL;
        if (sizes[i] == 0)
            continue;
        TRY(tl_buffers_map(c->buffers, c->device, names[i], CL_MAP_READ, sizes[i], &mapped,
                           err));
        of[i] = mapped;
    }
    for (size_t tile = 0; tile < count; tile++)
        keep_list(kept, first + tile, of[2], of[0][tile], of[1][tile]);
done:
    for (int i = 0; i < 3; i++)
        if (of[i] &&
            tl_buffers_unmap(c->buffers, c->device, names[i], (void *)(uintptr_t)of[i],
                             status == TL_OK ? err : NULL) != TL_OK &&
            status == TL_OK)
            status = TL_ERR_DEVICE;
    return status;
}

/* How many entries the buffer of lists has in use: where all tiles share one list, it is there once. */
static uint64_t entries_of(const tl_pass_context *c,
                           const tl_band_options *options,
                           uint64_t list_length)
{
    return tl_bands_cull(c->prepared, options) ? list_length
                                               : c->frame.light_count - c->frame.global_count;
}

/* The shares of ambient light of the whole picture: by the first band that is lit, and by the next once
 * buffers were given up. */
static tl_status occlude(tl_pass_context *c,
                         const tl_gbuffer *gbuffer,
                         tl_timings *timings,
                         double *ms,
                         tl_error *err)
{
    const band whole = {0, c->prepared->frame.tiles_y};
    const tl_frame of_band = c->frame;
    const double clock = tl_seconds();
    tl_status status = TL_OK;
    if (!c->prepared->needs.surroundings || c->has_surroundings)
        return TL_OK;
    aim_at(c, gbuffer, whole);
    TRY(tl_pass_occlude(c, ms, err));
    TRY(tl_pass_finish(c, err));
    c->has_surroundings = 1;
    tl_timings_end(timings, "occlude", clock);
done:
    c->frame = of_band;
    return status;
}

/* One band. *fitted is 0, and nothing lit, where cull_band says so. */
static tl_status light_band(tl_pass_context *c,
                            const tl_band_options *options,
                            const tl_gbuffer *gbuffer,
                            tl_image *image,
                            tl_timings *timings,
                            tl_lighting_counts *counts,
                            int *fitted,
                            tl_error *err)
{
    const uint64_t listed_before = counts->list_length;
    const tl_buffer_name seen = gbuffer->opacity ? TL_BUFFER_BEHIND : TL_BUFFER_RADIANCE;
    tl_status status = TL_OK;
    double clock = tl_seconds();
    TRY(upload(c, gbuffer, options->lit ? options->lit : image, err));
    if (gbuffer->opacity)
        TRY(upload_behind(c, gbuffer, image, err));
    clock = tl_timings_end(timings, "upload", clock);
    TRY(cull_band(c, options, gbuffer, counts, fitted, err));
    clock = tl_timings_end(timings, "cull", clock);
    if (*fitted && options->kept)
        TRY(keep_lists(c, options->kept,
                       entries_of(c, options, counts->list_length - listed_before), err));
    if (*fitted) {
        TRY(occlude(c, gbuffer, timings, &counts->device_occlusion_ms, err));
        clock = tl_seconds();
        TRY(shade(c, counts, err));
        clock = tl_timings_end(timings, "shade", clock);
        TRY(read_back(c, seen, image, err));
        tl_timings_end(timings, "readback", clock);
        counts->band_count++;
    }
done:
    if (tl_pass_finish(c, status == TL_OK ? err : NULL) != TL_OK && status == TL_OK)
        status = TL_ERR_DEVICE;
    return status;
}

tl_status tl_bands_light(tl_pass_context *c,
                         const tl_band_options *options,
                         const tl_gbuffer *gbuffer,
                         tl_image *image,
                         tl_timings *timings,
                         tl_lighting_counts *counts,
                         tl_error *err)
{
    const band lit = lit_rows(c, gbuffer);
    const uint32_t end = lit.first + lit.count;
    tl_status status = TL_OK;
    uint32_t rows = 0;
    band at = {lit.first, 0};
    if (lit.count == 0)
        return TL_OK;
    TRY(first_guess(c, options, gbuffer, &rows, err));
    TRY(upload_lights(c, err));
    while (at.first < end) {
        int fitted = 0;
        at.count = end - at.first < rows ? end - at.first : rows;
        aim_at(c, gbuffer, at);
        TRY(light_band(c, options, gbuffer, image, timings, counts, &fitted, err));
        if (fitted) {
            at.first += at.count;
            continue;
        }
        rows = at.count / 2;
        tl_buffers_release(c->buffers); /* they were sized for the larger band */
        c->has_surroundings = 0;
        TRY(upload_lights(c, err));
    }
    counts->device_bytes = tl_buffers_size(c->buffers);
    counts->first_kernel_s = c->first_start_s;
done:
    return status;
}

tl_status tl_bands_shade_again(tl_pass_context *c,
                               const tl_gbuffer *gbuffer,
                               tl_image *image,
                               const tl_lighting_counts *counts,
                               double *ms,
                               tl_error *err)
{
    const band whole = {0, c->prepared->frame.tiles_y};
    const uint32_t global_count = c->frame.global_count;
    tl_status status = TL_OK;
    *ms = 0.0;
    if (counts->band_count != 1)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "a frame that is lit in bands cannot be shaded once more: allow more "
                    "(--memory)"));
    aim_at(c, gbuffer, whole);
    c->frame.global_count = global_count;
    TRY(upload(c, gbuffer, image, err));
    if (c->programs[TL_PART_OCCLUDE])
        TRY(tl_pass_occlude(c, ms, err));
    if (c->programs[TL_PART_SHADE]->options.timed)
        TRY(tl_buffers_reserve(c->buffers, c->device, TL_BUFFER_TIMES,
                               2 * tl_tile_count(&c->frame) * sizeof(cl_ulong), err));
    TRY(tl_pass_shade(c, ms, err));
done:
    if (tl_pass_finish(c, status == TL_OK ? err : NULL) != TL_OK && status == TL_OK)
        status = TL_ERR_DEVICE;
    return status;
}
