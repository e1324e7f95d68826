/* tilelight info: what is in a file. */
#include "info.h"

#include "capture_read.h"
#include "commands.h"
#include "console.h"
#include "import/plan.h"
#include "import_options.h"
#include "json_values.h"
#include "printable.h"
#include "report_options.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/layouts.h"
#include "try.h"
#include "values.h"
#ifdef TILELIGHT_RASTER
#    include "info_scene.h"
#endif

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

typedef struct info_command {
    const char *path;
    tl_import_options import;
    report_options report;
} info_command;

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const char *const names[] = {"FILE"};
    info_command *options = state->input;
    const value_arguments arguments = {names, &options->path, 1};
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = &options->report;
        state->child_inputs[1] = &options->import;
        return 0;
    }
    return value_argument(key, text, state, &arguments);
}

static const struct argp_child children[] = {
    {&json_argp, 0, NULL, 0},
    {&import_argp, 0, "Captures of other programs (docs/file-formats.md):", 1},
    {0},
};

static const struct argp argp = {
    .parser = parse,
    .args_doc = "FILE",
    .doc = "Says what is in a G-buffer, a capture of another program (OpenEXR or PFM) and what "
           "lighting it lacks, a picture (OpenEXR, PFM or PNG) or a lights file, told apart by "
           "their "
           "first bytes; or in a glTF scene (.gltf, .glb), and what `capture' and `render' can "
           "choose of it: cameras, animations, variants.",
    .children = children,
};

info_values info_measure(
    const float *plane, const float *depth, uint32_t width, uint32_t height, uint32_t pitch)
{
    info_values out = {.least = INFINITY, .most = -INFINITY};
    double sum = 0.0;
    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++) {
            const double value = (double)plane[y * pitch + x];
            if (depth && depth[y * pitch + x] == INFINITY)
                continue;
            out.count++;
            if (!isfinite(value)) {
                out.not_finite_count++;
                continue;
            }
            sum += value;
            out.least = fmin(out.least, value);
            out.most = fmax(out.most, value);
        }
    if (out.count == out.not_finite_count)
        out.least = out.most = 0.0;
    else
        out.mean = sum / (double)(out.count - out.not_finite_count);
    return out;
}

void info_print_text(const char *text, int width)
{
    int printed = 0;
    for (; text[printed]; printed++)
        putchar(tl_printable(text[printed]));
    for (; printed < width; printed++)
        putchar(' ');
}

void info_print_values(const char *name, const info_values *v)
{
    printf("%-12s %12.6g %12.6g %12.6g", name, v->least, v->mean, v->most);
    if (v->not_finite_count > 0)
        printf("   %" PRIu64 " not finite", v->not_finite_count);
    putchar('\n');
}

json_t *info_values_json(const info_values *v)
{
    return json_pack("{sf sf sf sI}", "min", v->least, "mean", v->mean, "max", v->most,
                     "not_finite", (json_int_t)v->not_finite_count);
}

static const char *const channel_names[] = {"R", "G", "B"};

/* Takes `channels`. */
static json_t *picture_json(const tl_image *image, const char *kind, json_t *channels)
{
    json_t *const report =
        json_pack("{ss ss s[ii] so}", "kind", "picture", "format", kind, "size",
                  (int)image->width, (int)image->height, "channels", channels);
    if (image->whole_width > 0)
        json_object_set_new(report, "part",
                            json_pack("{s[ii] s[ii]}", "from", (int)image->x, (int)image->y,
                                      "of", (int)image->whole_width, (int)image->whole_height));
    return report;
}

static tl_status picture_info(const tl_image *image, const char *kind, bool json, tl_error *err)
{
    json_t *channels = json_object();
    if (!json)
        printf("picture     %s, %u x %u pixels\n", kind, image->width, image->height);
    if (!json && image->whole_width > 0)
        printf("part        from (%u, %u) on, of %u x %u pixels\n", image->x, image->y,
               image->whole_width, image->whole_height);
    if (!json)
        printf("%-12s %12s %12s %12s\n", "channel", "min", "mean", "max");
    for (unsigned c = 0; c < 3; c++) {
        const info_values values = info_measure(tl_image_plane(image, c), NULL, image->width,
                                                image->height, image->pitch);
        if (json)
            json_object_set_new(channels, channel_names[c], info_values_json(&values));
        else
            info_print_values(channel_names[c], &values);
    }
    if (json)
        return tl_json_write("-", picture_json(image, kind, channels), err);
    json_decref(channels);
    return TL_OK;
}

static tl_status gbuffer_info(const info_gbuffer *read, bool json, tl_error *err)
{
    tl_status status = TL_OK;
    info_gbuffer of = *read;
    tl_gbuffer *unpacked = NULL;
    of.pixels = of.file;
    if (of.file->layout != TL_LAYOUT_FLOAT) {
        TRY(tl_gbuffer_unpack(of.file, &unpacked, err));
        of.pixels = unpacked;
    }
    if (json)
        TRY(tl_json_write("-", info_gbuffer_json(&of), err));
    else
        info_print_gbuffer(&of);
done:
    tl_gbuffer_destroy(unpacked);
    return status;
}

/* A picture and nothing else: one part, and no channel that a G-buffer could use but coverage. */
static bool is_plain_picture(const tl_import_plan *plan)
{
    if (plan->sources[0].part_count != 1 || plan->sources[0].parts[0].refusal[0])
        return false;
    for (tl_import_plane p = 0; p < TL_IMPORT_ALPHA; p++)
        if (plan->bindings[p].is_bound)
            return false;
    return true;
}

/* What was found besides is for `light' to say: here the report says it. is_picture is NULL where the file
 * is to be described whatever it holds. */
static tl_status import_info(const info_command *options, bool *is_picture, tl_error *err)
{
    tl_status status = TL_OK;
    tl_import_plan plan = {.options = NULL};
    TRY(tl_import_plan_open(&plan, options->path, &options->import, NULL, err));
    if (is_picture && (*is_picture = is_plain_picture(&plan)))
        goto done;
    if (options->report.json)
        TRY(tl_json_write("-", info_import_json(&plan), err));
    else
        info_print_import(&plan);
done:
    tl_import_plan_close(&plan);
    return status;
}

static tl_status own_info(const char *path, bool json, tl_error *err)
{
    tl_status status = TL_OK;
    tl_gbuffer *gbuffer = NULL;
    tl_light_set lights = {0};
    bool has_lights = false;
    TRY(tl_gbuffer_read(path, &gbuffer, &lights, &has_lights, err));
    const info_gbuffer read = {.file = gbuffer, .lights = &lights, .has_lights = has_lights};
    TRY(gbuffer_info(&read, json, err));
done:
    tl_light_set_clear(&lights);
    tl_gbuffer_destroy(gbuffer);
    return status;
}

static tl_status image_info(const char *path, const char *kind, bool json, tl_error *err)
{
    tl_status status = TL_OK;
    tl_image *image = NULL;
    TRY(tl_image_read(path, &image, NULL, err));
    TRY(picture_info(image, kind, json, err));
done:
    tl_image_destroy(image);
    return status;
}

/* An OpenEXR file is a G-buffer of ours, else a capture of another program, else a picture. Where ours
 * cannot be read, or nothing else can be, the reason is said. */
static tl_status exr_info(const info_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    const char *path = options->path;
    bool is_own = false, is_picture = false;
    TRY(tl_gbuffer_is_own(path, &is_own, err));
    if (is_own && options->import.map_count == 0)
        return own_info(path, options->report.json, err);
    TRY(import_info(options, &is_picture, err));
    if (is_picture)
        TRY(image_info(path, "OpenEXR", options->report.json, err));
done:
    return status;
}

/* Of three numbers a pixel: a picture, unless options say what its numbers are. */
static tl_status pfm_info(const info_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    bool is_picture = false;
    TRY(import_info(options, options->import.map_count == 0 ? &is_picture : NULL, err));
    if (is_picture)
        TRY(image_info(options->path, "PFM", options->report.json, err));
done:
    return status;
}

/* Of one: depths, more often than not. */
static tl_status gray_pfm_info(const info_command *options, tl_error *err)
{
    return import_info(options, NULL, err);
}

static tl_status png_info(const info_command *options, tl_error *err)
{
    return image_info(options->path, "PNG", options->report.json, err);
}

static tl_status lights_info(const char *path, bool json, tl_error *err)
{
    tl_status status = TL_OK;
    tl_light_set lights = {0};
    TRY(tl_lights_read(path, &lights, err));
    if (json) {
        json_t *report = json_pack("{ss}", "kind", "lights");
        json_object_set_new(report, "lights", info_lights_json(&lights));
        TRY(tl_json_write("-", report, err));
    } else {
        info_print_lights(&lights);
    }
done:
    tl_light_set_clear(&lights);
    return status;
}

/* Of another program. */
static tl_status capture_info(const char *path,
                              const tl_capture_format *format,
                              bool json,
                              tl_error *err)
{
    const tl_capture_request request = {.path = path, .notices = &console_notices};
    tl_captured captured = {0};
    tl_status status = TL_OK;
    TRY(format->read(&request, &captured, err));
    const info_gbuffer read = {.file = captured.gbuffer,
                               .lights = &captured.lights,
                               .has_lights = captured.has_lights};
    TRY(gbuffer_info(&read, json, err));
done:
    tl_captured_clear(&captured);
    return status;
}

#ifdef TILELIGHT_RASTER
static tl_status scene_info(const info_command *options, tl_error *err)
{
    tl_status status = TL_OK;
    tl_scene_info info = {0};
    TRY(tl_scene_describe(options->path, &console_notices, &info, err));
    if (options->report.json)
        TRY(tl_json_write("-", info_scene_json(&info), err));
    else
        info_print_scene(&info);
done:
    tl_scene_info_clear(&info);
    return status;
}
#else
static tl_status scene_info(const info_command *options, tl_error *err)
{
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "%s: is a glTF scene, which this build cannot read; configure it with "
                   "-DTILELIGHT_RASTER=ON",
                   options->path);
}
#endif

/* A scene is JSON, as lights are: its name says so, else the member that each glTF file has. */
static bool is_scene(const char *path)
{
    const char *const dot = strrchr(path, '.');
    json_t *text = NULL;
    if (dot && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0))
        return true;
    if (tl_json_read(path, &text, NULL) != TL_OK)
        return false;
    const bool has_asset = json_object_get(text, "asset") != NULL;
    json_decref(text);
    return has_asset;
}

/* By the first bytes of a file; what is none of these is a scene or read as lights. */
static const struct {
    unsigned char magic[4];
    size_t magic_size;
    tl_status (*describe)(const info_command *options, tl_error *err);
} kinds[] = {
    {{0x76, 0x2f, 0x31, 0x01}, 4, exr_info},
    {{0x89, 'P', 'N', 'G'}, 4, png_info},
    {{'P', 'F'}, 2, pfm_info},
    {{'P', 'f'}, 2, gray_pfm_info},
    {{'g', 'l', 'T', 'F'}, 4, scene_info},
};

static tl_status run(const info_command *options, tl_error *err)
{
    unsigned char first[4] = {0};
    FILE *file = fopen(options->path, "rb");
    if (!file)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", options->path,
                       strerror(errno));
    const size_t size = fread(first, 1, sizeof first, file);
    fclose(file);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (size == sizeof first && memcmp(first, kinds[i].magic, kinds[i].magic_size) == 0)
            return kinds[i].describe(options, err);
    const tl_capture_format *format = tl_capture_format_of(options->path);
    if (format)
        return capture_info(options->path, format, options->report.json, err);
    if (is_scene(options->path))
        return scene_info(options, err);
    return lights_info(options->path, options->report.json, err);
}

int command_info(int argc, char **argv)
{
    info_command options = {0};
    tl_error err;
    argp_parse(&argp, argc, argv, 0, NULL, &options);
    return console_finish(run(&options, &err), &err);
}
