/* What the kinds of files hold; one function a kind. */
#ifndef TL_INFO_H
#define TL_INFO_H

#include "tilelight/gbuffer.h"
#include "tilelight/image.h"
#include "tilelight/lights.h"

#include <jansson.h>

/* The values of one plane, over pixels that something was hit in, or all of a picture. */
typedef struct info_values {
    double least, mean, most; /* of the finite ones; 0 where there are none */
    uint64_t count, not_finite_count;
} info_values;

/* plane: [height][pitch]. depth: the same, INFINITY for pixels to leave out, or NULL. */
info_values info_measure(
    const float *plane, const float *depth, uint32_t width, uint32_t height, uint32_t pitch);

/* A text of the file on standard output, without what would steer a terminal; at least `width` bytes. */
void info_print_text(const char *text, int width);

/* Text on standard output, or the same as JSON: NULL out of memory. */
void info_print_values(const char *name, const info_values *values);
json_t *info_values_json(const info_values *values);

void info_print_lights(const tl_light_set *set);
json_t *info_lights_json(const tl_light_set *set);

/* What a G-buffer's file holds. */
typedef struct info_gbuffer {
    const tl_gbuffer *file;   /* in its layout */
    const tl_gbuffer *pixels; /* the same in full float */
    const tl_light_set *lights;
    int has_lights;
} info_gbuffer;

void info_print_gbuffer(const info_gbuffer *of);
json_t *info_gbuffer_json(const info_gbuffer *of);

/* What a capture of another program would be imported as. */
struct tl_import_plan;
void info_print_import(const struct tl_import_plan *plan);
json_t *info_import_json(const struct tl_import_plan *plan);

#endif
