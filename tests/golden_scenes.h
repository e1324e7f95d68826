/* The golden files: G-buffers of the scenes of data/ with what they were lit to. tests/golden/make
 * made them. */
#ifndef TL_GOLDEN_SCENES_H
#define TL_GOLDEN_SCENES_H

#include "testing.h"

static const struct {
    const char *name, *scene;
} golden_scenes[] = {
    {"hall", "hall.gltf"},
    {"nine-lights", "nine-lights.gltf"},
    {"hard-cases", "hard-cases.glb"},
};

/* The path of a file of the sources, in a buffer of the caller's. */
static inline const char *source_path(
    char *buffer, size_t size, const char *folder, const char *name, const char *ending)
{
    const char *source = getenv("TILELIGHT_SOURCE");
    snprintf(buffer, size, "%s/%s/%s%s", source ? source : ".", folder, name, ending);
    return buffer;
}

#endif
