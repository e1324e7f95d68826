/* tilelight devices: what this machine can run. */
#include "commands.h"
#include "console.h"
#include "json_values.h"
#include "report_options.h"
#include "try.h"
#include "values.h"

#ifdef TILELIGHT_LIGHTING
#    include "tilelight/lighting.h"
#endif
#ifdef TILELIGHT_RASTER
#    include "tilelight/capture.h"
#endif

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

static error_t parse(int key, char *text, struct argp_state *state)
{
    static const value_arguments none = {NULL, NULL, 0};
    if (key == ARGP_KEY_INIT) {
        state->child_inputs[0] = state->input;
        return 0;
    }
    return value_argument(key, text, state, &none);
}

static const struct argp_child children[] = {{&json_argp, 0, NULL, 0}, {0}};

static const struct argp argp = {
    .parser = parse,
    .doc = "Lists the OpenCL devices that `--device' selects from by index or name, and the "
           "OpenGL renderer that captures.",
    .children = children,
};

#ifdef TILELIGHT_LIGHTING
static void print_device(size_t index, const tl_device_info *d)
{
    printf("%zu%s %s\n", index, d->is_default ? " (default)" : "", d->name);
    printf("    platform %s, driver %s\n", d->platform, d->driver);
    printf("    %s, %u units, %u lanes, %" PRIu64 " MB, %s\n", d->kind, d->compute_units,
           d->vector_width, d->memory_size >> 20, d->has_double ? "fp64" : "no fp64");
}

static json_t *device_as_json(size_t index, const tl_device_info *d)
{
    return json_pack("{si ss ss ss ss si si sI sb sb}", "index", (int)index, "name", d->name,
                     "platform", d->platform, "driver", d->driver, "kind", d->kind, "units",
                     (int)d->compute_units, "lanes", (int)d->vector_width, "memory_bytes",
                     (json_int_t)d->memory_size, "fp64", d->has_double, "default",
                     d->is_default);
}

static tl_status list_opencl(json_t *report, tl_error *err)
{
    tl_device_info *devices = NULL;
    size_t count = 0;
    const tl_status status = tl_device_list(&devices, &count, err);
    json_t *list = json_array();
    for (size_t i = 0; status == TL_OK && i < count; i++) {
        if (report)
            json_array_append_new(list, device_as_json(i, &devices[i]));
        else
            print_device(i, &devices[i]);
    }
    if (status == TL_OK && count == 0)
        tl_notice(&console_notices, "no OpenCL device: install a driver such as PoCL "
                                    "(pocl-opencl-icd on Debian)");
    if (report)
        json_object_set(report, "opencl", list);
    json_decref(list);
    free(devices);
    return status;
}
#else
static tl_status list_opencl(json_t *report, tl_error *err)
{
    (void)report, (void)err;
    return TL_OK;
}
#endif

#ifdef TILELIGHT_RASTER
/* No OpenGL is a finding here, not a failure. */
static void describe_opengl(json_t *report)
{
    char text[512] = "";
    tl_error err;
    const int found = tl_capture_describe(text, sizeof text, &err) == TL_OK;
    if (report)
        json_object_set_new(report, "opengl", found ? json_string(text) : json_null());
    else if (found)
        printf("OpenGL: %s\n", text);
    if (!found)
        tl_notice(&console_notices, "%s", err.message);
}
#else
static void describe_opengl(json_t *report)
{
    (void)report;
}
#endif

int command_devices(int argc, char **argv)
{
    report_options options = {0};
    tl_status status = TL_OK;
    json_t *report = NULL;
    tl_error err;

    argp_parse(&argp, argc, argv, 0, NULL, &options);
    if (options.json && !(report = json_object()))
        TRY(tl_fail(&err, TL_ERR_MEMORY, "out of memory for the report"));
    TRY(list_opencl(report, &err));
    describe_opengl(report);
    if (report)
        TRY(tl_json_write("-", json_incref(report), &err));
done:
    json_decref(report);
    return console_finish(status, &err);
}
