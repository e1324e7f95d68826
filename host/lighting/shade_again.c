/* The frame that was lit last, shaded once more: without some effects, or tile by tile under a clock. */
#include "lighting_state.h"
#include "scene_causes.h"
#include "tile_choices.h"
#include "try.h"

#include <string.h>

/* The frame that was lit last, by the program of `kernels`. */
static tl_status shade_again(tl_lighting *lighting,
                             const tl_kernel_options *kernels,
                             uint64_t without,
                             const tl_gbuffer *gbuffer,
                             tl_image *image,
                             double *ms,
                             tl_error *err)
{
    tl_pass_context context = {.device = lighting->device,
                               .buffers = &lighting->buffers,
                               .prepared = &lighting->prepared,
                               .frame = lighting->prepared.frame,
                               .precision_is_double = (int)kernels->real_double,
                               .by_pixel = (int)kernels->by_pixel,
                               .ignores_lists = (without >> TL_EFFECT_RANGED & 1u) != 0};
    tl_status status = TL_OK;
    if (without >> TL_EFFECT_GLOBAL & 1u)
        context.frame.global_count = 0;
    if (lighting->unpacked)
        gbuffer = lighting->unpacked;
    TRY(tl_program_find(lighting->device, TL_PART_SHADE, kernels, &lighting->options.kernel,
                        &context.programs[TL_PART_SHADE], err));
    if (kernels->surroundings)
        TRY(tl_program_find(lighting->device, TL_PART_OCCLUDE, kernels, NULL,
                            &context.programs[TL_PART_OCCLUDE], err));
    TRY(tl_bands_shade_again(&context, gbuffer, image, &lighting->counts, ms, err));
done:
    if (context.programs[TL_PART_SHADE])
        tl_program_keep(lighting->device, context.programs[TL_PART_SHADE]);
    return status;
}

static tl_status need_device(const tl_lighting *lighting, tl_error *err)
{
    if (!tl_lighting_is_on_host(lighting))
        return TL_OK;
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "what is lit without OpenCL is not shaded once more: use --precision float");
}

/* The frame's needs less some effects, and of the picture alone. */
static tl_needs needs_without(const tl_prepared *prepared, uint64_t effects)
{
    tl_explanation explanation = prepared->explanation;
    tl_needs needs = prepared->needs;
    explanation.without = effects;
    needs.split = 0;
    tl_needs_by_causes(&explanation, &needs);
    needs.choices &= tl_choosable(&needs);
    return needs;
}

tl_status tl_lighting_shade_without(tl_lighting *lighting,
                                    const tl_gbuffer *gbuffer,
                                    uint64_t effects,
                                    tl_image *image,
                                    double *ms,
                                    tl_error *err)
{
    const tl_status status = need_device(lighting, err);
    if (status != TL_OK)
        return status;
    const tl_needs needs = needs_without(&lighting->prepared, effects);
    const tl_kernel_options kernels = tl_lighting_kernels(lighting, &needs);
    return shade_again(lighting, &kernels, effects, gbuffer, image, ms, err);
}

/* Of the clock that kernels read; 0 where there is none. */
static uint64_t ticks_now(void)
{
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();
#else
    return 0;
#endif
}

static tl_status read_times(
    tl_lighting *lighting, size_t tiles, double us_per_tick, double *us, tl_error *err)
{
    const size_t size = 2 * tiles * sizeof(cl_ulong);
    tl_status status = TL_OK;
    void *mapped = NULL;
    TRY(tl_buffers_map(&lighting->buffers, lighting->device, TL_BUFFER_TIMES, CL_MAP_READ, size,
                       &mapped, err));
    const cl_ulong *times = mapped;
    for (size_t tile = 0; tile < tiles; tile++)
        us[tile] = us_per_tick * (double)(times[2 * tile + 1] - times[2 * tile]);
    TRY(tl_buffers_unmap(&lighting->buffers, lighting->device, TL_BUFFER_TIMES, mapped, err));
done:
    return status;
}

tl_status tl_lighting_time_tiles(tl_lighting *lighting,
                                 const tl_gbuffer *gbuffer,
                                 tl_image *image,
                                 double *us,
                                 tl_error *err)
{
    tl_status status = need_device(lighting, err);
    double ms;
    if (status != TL_OK)
        return status;
    tl_kernel_options kernels = tl_lighting_kernels(lighting, &lighting->prepared.needs);
    if (kernels.by_pixel || lighting->options.kernel.text ||
        strcmp(lighting->device->info.kind, "cpu") != 0 || ticks_now() == 0)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "kernels look at a clock on the cpu path of x86 processors alone: times of "
                    "tiles are not to be had here"));
    kernels.timed = 1;
    kernels.split = 0;
    const double start = tl_seconds();
    const uint64_t first = ticks_now();
    TRY(shade_again(lighting, &kernels, 0, gbuffer, image, &ms, err));
    const double us_per_tick = 1e6 * (tl_seconds() - start) / (double)(ticks_now() - first);
    TRY(read_times(lighting, lighting->counts.tile_count, us_per_tick, us, err));
done:
    return status;
}
