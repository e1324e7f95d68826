#include "compare_flip.h"

#include "json_values.h"
#include "output.h"
#include "ramp.h"
#include "try.h"
#include "values.h"

#include <stdio.h>
#include <stdlib.h>

enum { OPTION_FLIP = 512, OPTION_MAP, OPTION_DEGREE };

flip_options flip_options_default(void)
{
    return (flip_options){.pixels_per_degree = TL_FLIP_PIXELS_PER_DEGREE};
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    flip_options *options = state->input;
    switch (key) {
    case OPTION_FLIP: options->asked = true; return 0;
    case OPTION_MAP:
        output_kind(state, "--flip-map", text, OUTPUT_PNG);
        options->map = text;
        return 0;
    case OPTION_DEGREE:
        options->pixels_per_degree =
            value_number(state, "--pixels-per-degree", text, 1.0, 1000.0);
        options->asked = true;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"flip", OPTION_FLIP, NULL, 0,
     "Also how visible differences are to somebody who flips between the pictures, 0 to 1 "
     "(FLIP, Andersson et al. 2020). Of radiance the largest over all exposures from that "
     "which suits its brightest pixel to that which suits its median (Andersson et al. 2021)",
     0},
    {"flip-map", OPTION_MAP, "FILE.png", 0,
     "--flip, and where: from dark blue (0) by way of red to yellow (1)", 0},
    {"pixels-per-degree", OPTION_DEGREE, "N", 0,
     "--flip, for an eye that sees so many pixels in a degree (default 67.02: 0.7 m from a "
     "screen of 0.7 m and 3840 pixels)",
     0},
    {0},
};

const struct argp flip_argp = {.options = options_table, .parser = parse};

bool flip_is_asked(const flip_options *options)
{
    return options->asked || options->map;
}

static tl_status write_map(
    const char *path, const float *map, uint32_t width, uint32_t height, tl_error *err)
{
    const size_t pixels = (size_t)width * height;
    uint8_t *rgb = malloc(3 * pixels);
    if (!rgb)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a map of %u x %u pixels", width,
                       height);
    for (size_t i = 0; i < pixels; i++)
        tl_ramp((double)map[i], rgb + 3 * i);
    const tl_status status = tl_png_write(path, rgb, width, height, TL_CURVE_SRGB, err);
    free(rgb);
    return status;
}

tl_status flip_run(const flip_options *options,
                   const char *const paths[2],
                   tl_image *const pictures[2],
                   const int is_png[2],
                   tl_flip *out,
                   tl_error *err)
{
    tl_status status = TL_OK;
    const uint32_t width = pictures[0]->width, height = pictures[0]->height;
    float *map = NULL;

    if (is_png[0] != is_png[1])
        TRY(tl_fail(err, TL_ERR_ARGUMENT,
                    "FLIP compares two PNGs or two OpenEXR files, and of %s and %s one is each",
                    paths[0], paths[1]));
    if (options->map) {
        map = malloc(sizeof *map * width * height);
        if (!map)
            TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a map of %u x %u pixels", width,
                        height));
    }
    TRY(tl_flip_compare(pictures[0], pictures[1], is_png[0] ? TL_FLIP_SCREEN : TL_FLIP_RADIANCE,
                        options->pixels_per_degree, map, out, err));
    if (map)
        TRY(write_map(options->map, map, width, height, err));
done:
    free(map);
    return status;
}

void flip_print(const tl_flip *flip)
{
    printf("%-12s %14.6g in the mean, %.6g at most, at (%u, %u)\n", "FLIP", flip->mean,
           flip->max, flip->worst_x, flip->worst_y);
    if (flip->exposure_count > 0)
        printf("%-12s %u exposures from %.2f to %.2f stops\n", "", flip->exposure_count,
               flip->first_exposure, flip->last_exposure);
}

json_t *flip_json(const tl_flip *flip)
{
    json_t *report =
        json_pack("{so so s[ii]}", "mean", tl_json_number(flip->mean), "max",
                  tl_json_number(flip->max), "worst", (int)flip->worst_x, (int)flip->worst_y);
    if (flip->exposure_count > 0)
        json_object_set_new(report, "exposures",
                            json_pack("{si so so}", "count", (int)flip->exposure_count, "first",
                                      tl_json_number(flip->first_exposure), "last",
                                      tl_json_number(flip->last_exposure)));
    return report;
}

tl_status flip_judge(const tl_flip *flip,
                     double tolerance,
                     const char *const paths[2],
                     tl_error *err)
{
    if (flip->mean <= tolerance)
        return TL_OK;
    return tl_fail(err, TL_ERR_DIFFERENT,
                   "%s and %s: FLIP is %.6g in the mean, above the tolerance of %.6g; it is "
                   "largest at pixel (%u, %u)",
                   paths[0], paths[1], flip->mean, tolerance, flip->worst_x, flip->worst_y);
}
