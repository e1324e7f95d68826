#include "lighting_state.h"

#include "ranges.h"
#include "reference.h"
#include "tilelight/layouts.h"
#include "tilelight/occlusion.h"
#include "try.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    int on_host, is_double;
    tl_arithmetic arithmetic; /* on the host */
} precisions[TL_PRECISION_COUNT] = {
    [TL_PRECISION_FLOAT] = {0, 0, TL_TWIN_FLOAT},
    [TL_PRECISION_DOUBLE] = {0, 1, TL_TWIN_DOUBLE},
    [TL_PRECISION_REFERENCE] = {1, 1, TL_TWIN_REFERENCE},
    [TL_PRECISION_TWIN] = {1, 0, TL_TWIN_FLOAT},
};

/* Boxes per tile that lights are tested against. */
static const uint32_t box_counts[TL_CULL_COUNT] = {
    [TL_CULL_DEPTH] = 1,
    [TL_CULL_SPLIT] = TL_MAX_BOXES,
};

tl_lighting_options tl_lighting_options_default(void)
{
    return (tl_lighting_options){.cull = TL_CULL_SPLIT,
                                 .precision = TL_PRECISION_FLOAT,
                                 .tile_size = 16,
                                 .layers = TL_MOST_LAYERS};
}

/* Whether a work-item shades a pixel. */
static int is_by_pixel(const tl_device *device, const tl_lighting_options *options)
{
    if (options->path == TL_PATH_AUTO)
        return strcmp(device->info.kind, "gpu") == 0;
    return options->path == TL_PATH_GPU;
}

int tl_precision_is_on_host(tl_precision precision)
{
    return precisions[precision].on_host;
}

int tl_lighting_is_on_host(const tl_lighting *lighting)
{
    return tl_precision_is_on_host(lighting->options.precision);
}

static int is_one_of(uint32_t value, const uint32_t *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (values[i] == value)
            return 1;
    return 0;
}

/* What of the choices this precision cannot compute. */
static tl_status check_approximations(const tl_lighting_options *options, tl_error *err)
{
    const tl_approximations *of = &options->approximations;
    char lacking[128] = "";
    tl_status status = TL_OK;
    TRY(tl_approximations_check(of, err));
    if (options->precision == TL_PRECISION_REFERENCE && !tl_approximations_are_default(of))
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "the reference approximates nothing, it is what approximations are held "
                    "against: leave them out, or use --precision float"));
    if (options->precision == TL_PRECISION_TWIN)
        tl_approximations_lacking(of, TL_KNOB_SAME_BITS, lacking, sizeof lacking);
    if (lacking[0])
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "the twin is C, and %s is up to the device or its compiler: use "
                    "--precision float",
                    lacking));
    if (precisions[options->precision].is_double)
        tl_approximations_lacking(of, TL_KNOB_DOUBLE, lacking, sizeof lacking);
    if (lacking[0])
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%s is of floats alone: use --precision float",
                    lacking));
done:
    return status;
}

static tl_status check_options(const tl_device *device,
                               const tl_lighting_options *options,
                               tl_error *err)
{
    static const uint32_t tiles[] = {8, 16, 32, 64}, widths[] = {0, 1, 4, 8, 16};
    if (!is_one_of(options->tile_size, tiles, sizeof tiles / sizeof tiles[0]))
        return tl_fail(err, TL_ERR_ARGUMENT, "a tile of %u px: it must be 8, 16, 32 or 64",
                       options->tile_size);
    if (!is_one_of(options->vector_width, widths, sizeof widths / sizeof widths[0]))
        return tl_fail(err, TL_ERR_ARGUMENT, "vectors of %u lanes: it must be 1, 4, 8 or 16",
                       options->vector_width);
    if (options->shadow_filter > TL_MOST_SHADOW_FILTER)
        return tl_fail(err, TL_ERR_ARGUMENT, "a shadow filter of %u texels: %d at most",
                       options->shadow_filter, TL_MOST_SHADOW_FILTER);
    if (!tl_occlusion_slices_of(options->occlusion_samples))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%u samples of ambient occlusion: it must be a power of 2 from 8 to 256",
                       options->occlusion_samples);
    if (options->layers > TL_MOST_LAYERS)
        return tl_fail(err, TL_ERR_ARGUMENT, "%u layers: %d at most", options->layers,
                       TL_MOST_LAYERS);
    if (options->split & ~TL_ALL_AOVS)
        return tl_fail(err, TL_ERR_ARGUMENT, "terms 0x%x: there are %d", options->split,
                       TL_AOV_COUNT);
    if (options->split && options->kernel.text)
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "a kernel of one's own writes the picture alone, not the terms that it is the "
            "sum of: leave them out, or the kernel");
    if (!(options->light_cutoff >= 0.0f && options->light_cutoff < INFINITY))
        return tl_fail(err, TL_ERR_ARGUMENT, "a light cutoff of %g lx: it must be 0 or above",
                       (double)options->light_cutoff);
    const tl_status status = check_approximations(options, err);
    if (status != TL_OK || precisions[options->precision].on_host)
        return status;
    if (!device)
        return tl_fail(err, TL_ERR_ARGUMENT, "this precision needs a device");
    if (is_by_pixel(device, options) && options->vector_width > 1)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "vectors of %u lanes on the gpu path, where a work-item shades a pixel: "
                       "use --path cpu, or leave --width out",
                       options->vector_width);
    if (precisions[options->precision].is_double && !device->info.has_double)
        return tl_fail(err, TL_ERR_NO_DEVICE,
                       "%s has no double precision: use --precision float or reference",
                       device->info.name);
    return TL_OK;
}

tl_status tl_lighting_create(tl_device *device,
                             const tl_lighting_options *options,
                             tl_lighting **out,
                             tl_error *err)
{
    const tl_status status = check_options(device, options, err);
    if (status != TL_OK)
        return status;
    tl_lighting *made = calloc(1, sizeof *made);
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for lighting");
    made->device = device;
    made->options = *options;
    *out = made;
    return TL_OK;
}

void tl_lighting_destroy(tl_lighting *lighting)
{
    if (!lighting)
        return;
    tl_lighting_layers_clear(lighting);
    tl_buffers_release(&lighting->buffers);
    tl_gbuffer_destroy(lighting->unpacked);
    tl_prepared_clear(&lighting->prepared);
    free(lighting->tile_lights);
    free(lighting->tile_effects);
    free(lighting->light_effects);
    free(lighting);
}

void tl_lighting_let_go(tl_lighting *lighting)
{
    if (!lighting)
        return;
    tl_buffers_let_go(&lighting->buffers);
    for (uint32_t i = 0; i < lighting->layer_capacity; i++)
        tl_lighting_let_go(lighting->layers[i]);
}

tl_kernel_options tl_lighting_arithmetic(const tl_device *device, const tl_lighting_options *o)
{
    const int is_double = precisions[o->precision].is_double;
    uint32_t width = o->vector_width ? o->vector_width : device->info.vector_width;
    if (!o->vector_width && is_double && width > 1)
        width /= 2; /* as many bytes as the register has */
    const int by_pixel = is_by_pixel(device, o);
    if (width == 2 || by_pixel)
        width = 1;
    return (tl_kernel_options){
        .width = width, .by_pixel = (uint32_t)by_pixel, .real_double = (uint32_t)is_double};
}

tl_kernel_options tl_lighting_kernels(const tl_lighting *lighting, const tl_needs *needs)
{
    const tl_lighting_options *o = &lighting->options;
    const tl_kernel_options arithmetic = tl_lighting_arithmetic(lighting->device, o);
    uint32_t width = arithmetic.width;
    if (!o->vector_width && o->kernel.text && o->kernel.items == TL_ITEMS_PIXEL)
        width = 1; /* what the headers then are for */
    if (o->kernel.text && width > o->tile_size)
        width = o->tile_size; /* a user's kernel may take a run of a row's pixels as a vector */
    return (tl_kernel_options){.width = width,
                               .by_pixel = arithmetic.by_pixel,
                               .real_double = arithmetic.real_double,
                               .precise_power =
                                   o->approximations.of[TL_KNOB_POWER] == TL_POWER_LIBRARY,
                               .approximations = o->approximations,
                               .orthographic = needs->orthographic,
                               .layout = needs->layout,
                               .present = needs->present,
                               .specular = needs->specular,
                               .falloffs = needs->falloffs,
                               .model = needs->model,
                               .spots = needs->spots,
                               .one_color = needs->one_color,
                               .ambient = needs->ambient,
                               .idle = needs->idle,
                               .models = needs->models,
                               .fixed_exponent = needs->fixed_exponent,
                               .choices = needs->choices,
                               .shapes = needs->shapes,
                               .sky = needs->sky,
                               .surroundings = needs->surroundings,
                               .split = needs->split,
                               .sky_light = needs->sky_light,
                               .window = needs->window};
}

static void keep_programs(const tl_device *device,
                          const tl_pass_context *context,
                          tl_timings *timings)
{
    const double clock = tl_seconds();
    int kept = 0;
    for (int part = 0; part < TL_LIGHTING_PART_COUNT; part++)
        if (context->programs[part])
            kept |= tl_program_keep(device, context->programs[part]);
    if (kept)
        tl_timings_end(timings, "keep", clock);
}

/* On the host. */
static tl_arithmetic arithmetic_of(const tl_lighting_options *options)
{
    return tl_approximations_are_default(&options->approximations)
               ? precisions[options->precision].arithmetic
               : TL_TWIN_CHOSEN;
}

static int is_needed(tl_program_part part,
                     const tl_prepared *prepared,
                     const tl_gbuffer *gbuffer,
                     const tl_band_options *bands)
{
    return part == TL_PART_CULL      ? tl_bands_cull(prepared, bands)
           : part == TL_PART_OCCLUDE ? (int)prepared->needs.surroundings
           : part == TL_PART_BLEND   ? gbuffer->opacity != NULL
                                     : 1;
}

static tl_status run_on_device(tl_lighting *lighting,
                               const tl_gbuffer *gbuffer,
                               tl_image *image,
                               tl_image *lit,
                               tl_timings *timings,
                               tl_lighting_counts *counts,
                               tl_error *err)
{
    const tl_lighting_options *options = &lighting->options;
    const tl_kernel_options kernels = tl_lighting_kernels(lighting, &lighting->prepared.needs);
    const tl_kept_lists kept = {.lights = lighting->tile_lights,
                                .effects = lighting->tile_effects,
                                .pairs = lighting->use.pairs,
                                .light_effects = lighting->light_effects};
    const tl_band_options bands = {.cull = options->cull != TL_CULL_NONE,
                                   .memory_limit = options->memory_limit,
                                   .kept = options->keeps_tile_lights ? &kept : NULL,
                                   .lit = lit};
    tl_status status = TL_OK;
    tl_pass_context context = {.device = lighting->device,
                               .buffers = &lighting->buffers,
                               .prepared = &lighting->prepared,
                               .precision_is_double = (int)kernels.real_double,
                               .by_pixel = (int)kernels.by_pixel};
    const double clock = tl_seconds();
    for (tl_program_part part = 0; part < TL_LIGHTING_PART_COUNT; part++)
        if (is_needed(part, &lighting->prepared, gbuffer, &bands))
            TRY(tl_program_find(lighting->device, part, &kernels, &options->kernel,
                                &context.programs[part], err));
    tl_timings_end(timings, "compile", clock);
    TRY(tl_bands_light(&context, &bands, gbuffer, image, timings, counts, err));
done:
    keep_programs(lighting->device, &context, timings);
    return status;
}

void tl_lighting_explain(const tl_lighting *lighting, tl_explanation *out)
{
    *out = lighting->explanation;
}

const uint32_t *tl_lighting_tile_lights(const tl_lighting *lighting)
{
    return lighting->tile_lights;
}

const tl_effect_use *tl_lighting_effect_use(const tl_lighting *lighting)
{
    return lighting->options.keeps_tile_lights ? &lighting->use : NULL;
}

void tl_lighting_build_options(const tl_lighting *lighting, char *text, size_t size)
{
    const tl_program *program = NULL;
    text[0] = '\0';
    if (tl_lighting_is_on_host(lighting) || !lighting->prepared.lights)
        return;
    const tl_kernel_options kernels = tl_lighting_kernels(lighting, &lighting->prepared.needs);
    char *options = NULL;
    size_t options_size = 0;
    if (tl_program_find(lighting->device, TL_PART_SHADE, &kernels, &lighting->options.kernel,
                        &program, NULL) != TL_OK)
        return;
    clGetProgramBuildInfo(program->program, lighting->device->id, CL_PROGRAM_BUILD_OPTIONS, 0,
                          NULL, &options_size);
    options = options_size ? malloc(options_size) : NULL;
    if (options &&
        clGetProgramBuildInfo(program->program, lighting->device->id, CL_PROGRAM_BUILD_OPTIONS,
                              options_size, options, NULL) == CL_SUCCESS)
        snprintf(text, size, "%s", options);
    free(options);
}

/* What is lit in place of *gbuffer, which becomes it: users' kernels know full float alone. *before is
 * the one that device buffers may still be of, until the frame is lit. */
static tl_status unpack_for_user(tl_lighting *lighting,
                                 const tl_gbuffer **gbuffer,
                                 tl_gbuffer **before,
                                 tl_timings *timings,
                                 tl_error *err)
{
    const tl_lighting_options *options = &lighting->options;
    const double clock = tl_seconds();
    tl_status status = TL_OK;
    tl_gbuffer *made = NULL;
    if (!options->kernel.text || precisions[options->precision].on_host ||
        (*gbuffer)->layout == TL_LAYOUT_FLOAT)
        return TL_OK;
    TRY(tl_gbuffer_unpack(*gbuffer, &made, err));
    *before = lighting->unpacked;
    *gbuffer = lighting->unpacked = made;
    tl_timings_end(timings, "unpack", clock);
done:
    return status;
}

/* What is known before a light is listed. */
static tl_lighting_counts counts_of(const tl_prepared *prepared)
{
    const tl_frame *frame = &prepared->frame;
    return (tl_lighting_counts){
        .tile_count = frame->tiles_x * frame->tiles_y,
        .global_light_count = frame->global_count,
        .ranged_light_count = frame->light_count - frame->global_count,
    };
}

/* *array becomes one of `count`, what was in it lost. */
static tl_status reserve(void **array, size_t count, size_t size, tl_error *err)
{
    free(*array);
    *array = malloc((count + 1) * size);
    return *array ? TL_OK
                  : tl_fail(err, TL_ERR_MEMORY,
                            "out of memory for what tiles and lights call for");
}

static tl_status reserve_kept(tl_lighting *lighting, size_t tiles, size_t lights, tl_error *err)
{
    tl_status status = TL_OK;
    if (tiles > lighting->tile_capacity) {
        lighting->tile_capacity = 0;
        TRY(reserve((void **)&lighting->tile_lights, tiles, sizeof *lighting->tile_lights,
                    err));
        TRY(reserve((void **)&lighting->tile_effects, tiles, sizeof *lighting->tile_effects,
                    err));
        lighting->tile_capacity = tiles;
    }
    if (lights > lighting->light_capacity || !lighting->light_effects) {
        TRY(reserve((void **)&lighting->light_effects, lights, sizeof *lighting->light_effects,
                    err));
        lighting->light_capacity = lights;
    }
done:
    return status;
}

/* Prepares for what is kept of lists. Without lists, every tile has every light. */
static tl_status keep_tiles(tl_lighting *lighting,
                            const tl_lighting_counts *counts,
                            tl_error *err)
{
    const tl_prepared *prepared = &lighting->prepared;
    const tl_explanation *explanation = &prepared->explanation;
    const int has_lists = !tl_lighting_is_on_host(lighting);
    tl_effect_use *use = &lighting->use;
    uint64_t all = 0;
    tl_status status = TL_OK;
    if (!lighting->options.keeps_tile_lights)
        return TL_OK;
    TRY(reserve_kept(lighting, counts->tile_count, prepared->frame.light_count, err));
    *use = (tl_effect_use){.tiles = lighting->tile_effects};
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const int is_global = i < prepared->frame.global_count;
        const uint64_t effects = tl_effects_of_light(explanation->causes | explanation->assumed,
                                                     prepared->light_causes[i]);
        lighting->light_effects[i] = effects;
        all |= is_global ? 0 : effects;
        for (uint64_t rest = effects; rest; rest &= rest - 1) {
            use->global_lights[__builtin_ctzll(rest)] += (uint32_t)is_global;
            use->pairs[__builtin_ctzll(rest)] +=
                is_global || has_lists ? 0 : counts->tile_count;
        }
    }
    for (uint32_t i = 0; i < counts->tile_count; i++) {
        lighting->tile_lights[i] = counts->ranged_light_count;
        lighting->tile_effects[i] = all;
    }
done:
    return status;
}

/* Pixels are looked through only where light may add up that far: as a rule none is. */
static uint64_t count_cut(const tl_prepared *prepared,
                          const tl_image *image,
                          const tl_notices *notices)
{
    if (!prepared->may_be_cut)
        return 0;
    const uint64_t count = tl_image_count_above(image, nextafterf(TL_MOST_FLOAT, 0.0f));
    if (count > 0)
        tl_notice(notices,
                  "%" PRIu64 " pixels are brighter than a float can say, and have the largest, "
                  "%.3g: lower the intensity of lights, or move them away",
                  count, (double)TL_MOST_FLOAT);
    return count;
}

tl_status tl_lighting_surface(tl_lighting *lighting,
                              const tl_gbuffer *gbuffer,
                              const tl_light_set *lights,
                              tl_image *image,
                              tl_image *lit,
                              tl_timings *timings,
                              const tl_notices *notices,
                              tl_lighting_counts *counts,
                              tl_error *err)
{
    const tl_lighting_options *options = &lighting->options;
    const tl_light_part *part = lighting->part;
    tl_status status = TL_OK;
    double clock = tl_seconds();
    TRY(tl_prepare(
        gbuffer, lights,
        &(tl_prepare_options){.tile_size = options->tile_size,
                              .box_count = box_counts[options->cull],
                              .light_cutoff = options->light_cutoff,
                              .effects = options->effects,
                              .shadow_filter = options->shadow_filter,
                              .occlusion_samples = options->occlusion_samples,
                              .layers = options->layers,
                              .split = options->split,
                              .lit = part ? part->lit : NULL,
                              .without = part && part->alone ? TL_ON(TL_EFFECT_EMISSION) : 0},
        notices, &lighting->prepared, err));
    lighting->prepared.approximations = options->approximations;
    lighting->explanation = lighting->prepared.explanation;
    clock = tl_timings_end(timings, "prepare", clock);
    *counts = counts_of(&lighting->prepared);
    TRY(keep_tiles(lighting, counts, err));
    if (tl_lighting_is_on_host(lighting)) {
        tl_reference_light(&lighting->prepared, gbuffer, arithmetic_of(options), image);
        tl_timings_end(timings, "shade", clock);
        counts->list_length = (uint64_t)counts->ranged_light_count * counts->tile_count;
    } else {
        TRY(run_on_device(lighting, gbuffer, image, lit, timings, counts, err));
    }
    counts->pair_count = counts->list_length * options->tile_size * options->tile_size;
    counts->cut_count = count_cut(&lighting->prepared, image, notices);
done:
    return status;
}

tl_status tl_lighting_run(tl_lighting *lighting,
                          const tl_gbuffer *gbuffer,
                          const tl_light_set *lights,
                          tl_image *image,
                          tl_timings *timings,
                          const tl_notices *notices,
                          tl_lighting_counts *counts,
                          tl_error *err)
{
    tl_status status = TL_OK;
    tl_lighting_counts frame_counts;
    tl_gbuffer *before = NULL;

    if (image->pitch != gbuffer->pitch || image->rows != gbuffer->rows)
        TRY(tl_fail(
            err, TL_ERR_ARGUMENT,
            "the image is %u x %u pixels, the G-buffer %u x %u: they must be of one size",
            image->width, image->height, gbuffer->camera.width, gbuffer->camera.height));
    if (image->part_count != TL_AOVS_IN(lighting->options.split))
        TRY(tl_fail(
            err, TL_ERR_ARGUMENT,
            "the image has %u parts, and %u terms are to be written: they must be as many",
            image->part_count, TL_AOVS_IN(lighting->options.split)));
    TRY(unpack_for_user(lighting, &gbuffer, &before, timings, err));
    TRY(tl_lighting_surface(lighting, gbuffer, lights, image, NULL, timings, notices,
                            &frame_counts, err));
    TRY(tl_lighting_layers(lighting, gbuffer, lights, image, timings, &frame_counts, err));
    lighting->counts = frame_counts;
    if (counts)
        *counts = frame_counts;
done:
    tl_gbuffer_destroy(before);
    return status;
}
