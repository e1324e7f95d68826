#define _GNU_SOURCE /* asprintf */
#include "batch_record.h"

#include "option_text.h"
#include "try.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char *const batch_reasons[] = {
#define WHY(name, why) [name] = why,
    TL_BATCH_REASONS(WHY)
#undef WHY
};

/* What shows in no bit, and files, whose contents count and not their names. How a frame is cut up shows in
 * none either, but for kernels of the user's. */
static const char *const left_out[] = {"output",      "lights", "device", "cull",    "memory",
                                       "camera-file", "sky",    "kernel", "effects", "tile",
                                       "width",       "path",   NULL};
static const char *const left_out_with_kernel[] = {
    "output", "lights", "device", "cull", "memory", "camera-file", "sky", "kernel", NULL};

static bool has_sky_file(const frame_options *frame)
{
    const char *sky = frame->lighting.sky.image;
    return sky && strcmp(sky, "none") != 0;
}

tl_status batch_options_text(const struct argp *root,
                             int argc,
                             char **argv,
                             const frame_options *frame,
                             char **out,
                             tl_error *err)
{
    const char *kernel = frame->kernel.text ? frame->kernel.text : "";
    char *given = NULL, *all = NULL;
    tl_status status = TL_OK;
    TRY(option_text(root, &frame_argp, argc, argv,
                    frame->kernel.text ? left_out_with_kernel : left_out, &given, err));
    const char *sky = has_sky_file(frame)         ? "a file"
                      : frame->lighting.sky.image ? "none"
                                                  : "as the lights say";
    if (asprintf(&all, "%ssky: %s\nkernel: %s", given, sky, kernel) < 0) {
        all = NULL;
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for options"));
    }
    *out = all;
done:
    free(given);
    return status;
}

/* Of an item: capture, lights, sky, camera and what maps name. */
enum { MOST_FILES = 4 + TL_MAX_MAPS };

static size_t files_of(const frame_options *frame,
                       const tl_item *item,
                       tl_record_file files[MOST_FILES])
{
    const tl_import_options *import = &frame->import;
    size_t count = 0;
    files[count++] =
        (tl_record_file){item->input, item->lights ? TL_RECORD_PLAIN : TL_RECORD_CAPTURE};
    if (item->lights)
        files[count++] = (tl_record_file){item->lights, TL_RECORD_LIGHTS};
    if (has_sky_file(frame))
        files[count++] = (tl_record_file){frame->lighting.sky.image, TL_RECORD_PLAIN};
    if (import->camera.file)
        files[count++] = (tl_record_file){import->camera.file, TL_RECORD_PLAIN};
    for (size_t i = 0; i < import->map_count; i++)
        if (import->maps[i].file[0])
            files[count++] = (tl_record_file){import->maps[i].file, TL_RECORD_PLAIN};
    return count;
}

tl_status batch_record_of(const batch *b,
                          const tl_item *item,
                          char record[TL_RECORD_SIZE],
                          tl_error *err)
{
    tl_record_file files[MOST_FILES];
    char *options = NULL;
    const size_t count = files_of(&b->options->frame, item, files);
    if (asprintf(&options, "%slights: %s\n", b->text, item->lights ? "a file" : "inside") < 0)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for options");
    const tl_status status =
        tl_record_of(b->records, options, TILELIGHT_VERSION, files, count, record, err);
    free(options);
    return status;
}

batch_reason batch_reason_of(const batch *b,
                             const tl_item *item,
                             const char record[TL_RECORD_SIZE],
                             const char **output)
{
    char found[TL_IMAGE_RECORD_SIZE];
    for (size_t i = 0; i < item->output_count; i++) {
        *output = item->outputs[i];
        if (access(*output, F_OK) != 0)
            return BATCH_IS_MISSING;
        if (!tl_image_record(*output, found))
            return BATCH_SAYS_NOTHING;
        if (strcmp(found, record) != 0)
            return BATCH_IS_OUTDATED;
    }
    *output = item->outputs[0];
    return b->options->force ? BATCH_IS_FORCED : BATCH_UP_TO_DATE_IS;
}
