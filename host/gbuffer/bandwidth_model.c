#include "bandwidth_model.h"

tl_bandwidth_variables tl_bandwidth_variables_default(void)
{
    return (tl_bandwidth_variables){.width = 1024.0,
                                    .height = 768.0,
                                    .depth_bytes = 4.0,
                                    .back_buffer_bytes = 4.0,
                                    .overdraw = 3.0,
                                    .sorting = 1.5,
                                    .texture_bytes = 3.0,
                                    .building_lookups = 2.0,
                                    .shading_lookups = 4.0,
                                    .shading_passes = 8.0,
                                    .geometry_bytes = 16e6,
                                    .frames_per_second = 60.0};
}

tl_target_bytes tl_targets_alike(double count, double bits)
{
    const double bytes = count * bits / 8.0;
    return (tl_target_bytes){.written = bytes, .read = bytes};
}

double tl_bandwidth_building(const tl_bandwidth_variables *of, tl_target_bytes targets)
{
    const double depth = of->depth_bytes * (of->overdraw + of->sorting);
    const double textures = of->texture_bytes * of->building_lookups * of->sorting;
    return of->width * of->height * (depth + textures + targets.written * of->sorting) +
           of->geometry_bytes;
}

double tl_bandwidth_shading(const tl_bandwidth_variables *of, tl_target_bytes targets)
{
    const double blending = 2.0 * of->back_buffer_bytes; /* read and written */
    const double textures = of->texture_bytes * of->shading_lookups;
    return of->width * of->height * of->shading_passes * (blending + textures + targets.read);
}

double tl_bandwidth(const tl_bandwidth_variables *of, tl_target_bytes targets)
{
    return (tl_bandwidth_building(of, targets) + tl_bandwidth_shading(of, targets)) *
           of->frames_per_second;
}

double tl_bandwidth_rounded(double target_bytes)
{
    return 1e9 * (target_bytes / 2.0 + 10.0);
}
