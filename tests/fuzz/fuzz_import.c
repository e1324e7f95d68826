/* Captures of other programs, OpenEXR, PFM or PNG: does any file, with any options, do more than be refused?
 *
 * The first FUZZ_OPTIONS bytes are options, the rest is the file. */
#include "fuzz.h"
#include "fuzz_frame.h"

#include "tilelight/import.h"

#include <stdio.h>

enum { FUZZ_OPTIONS = 6 };

/* Planes of a picture file, which has no names for them. */
static void map_picture(tl_import_options *options, const char *path)
{
    static const struct {
        tl_import_plane plane;
        const char *channels;
    } maps[] = {{TL_IMPORT_DEPTH, "R"}, {TL_IMPORT_NORMAL, ""}, {TL_IMPORT_ALBEDO, ""}};
    for (size_t i = 0; i < sizeof maps / sizeof maps[0]; i++) {
        tl_import_map *const map = &options->maps[options->map_count++];
        *map = (tl_import_map){.plane = maps[i].plane};
        snprintf(map->file, sizeof map->file, "%s", path);
        snprintf(map->channels, sizeof map->channels, "%s", maps[i].channels);
    }
}

static tl_import_options options_of(fuzz_bytes *from, const char *path)
{
    tl_import_options options = tl_import_options_default();
    options.is_given = true;
    options.depth_kind = (tl_depth_kind)(fuzz_byte(from) % TL_DEPTH_KIND_COUNT);
    options.normal_space = (tl_import_space)(fuzz_byte(from) % TL_SPACE_COUNT);
    options.position_space = (tl_import_space)(fuzz_byte(from) % TL_SPACE_COUNT);
    const uint8_t flags = fuzz_byte(from), camera = fuzz_byte(from);
    options.normals_are_encoded = flags & 1;
    options.edges = flags & 2 ? TL_EDGES_DROP : TL_EDGES_KEEP;
    options.unit = flags & 4 ? 0.01 : 1.0;
    options.sky_from = flags & 8 ? 10.0 : options.sky_from;
    options.camera.vertical_fov = camera & 1 ? 0.5 + 0.7 * camera : 0.0;
    options.camera.is_placed = (camera & 2) != 0;
    options.camera.eye[2] = 5.0;
    options.camera.near = camera & 4 ? 0.1 : 0.0;
    options.camera.far = camera & 4 ? 100.0 : 0.0;
    if (fuzz_byte(from) & 1)
        map_picture(&options, path);
    return options;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes bytes = {data, size};
    tl_error err = {.status = TL_OK};
    tl_gbuffer *gbuffer = NULL;
    if (size < FUZZ_OPTIONS)
        return 0;
    const char *const path = fuzz_file(data + FUZZ_OPTIONS, size - FUZZ_OPTIONS);
    const tl_import_options options = options_of(&bytes, path);
    const tl_status status =
        tl_import_read(options.map_count ? NULL : path, &options, NULL, &gbuffer, NULL, &err);
    if (status != TL_ERR_ARGUMENT) /* whose sentences may be on options */
        fuzz_must_tell(status, &err, path);
    if (status == TL_OK) {
        fuzz_repair(gbuffer);
        fuzz_light(gbuffer, &(tl_light_set){.ambient = {1.0f, 1.0f, 1.0f}});
    }
    tl_gbuffer_destroy(gbuffer);
    return 0;
}
