/* `tilelight layouts`: the table, and one layout word by word. */
#ifndef TL_LAYOUTS_COMMAND_H
#define TL_LAYOUTS_COMMAND_H

#include "tilelight/error_bounds.h"
#include "tilelight/layouts.h"

#include <jansson.h>

/* Planes of a frame of which bytes are told: the material that the layout can hold, metal-rough before
 * Phong, and what it can hold of `more`. */
uint32_t layout_content(enum tl_layout_name layout, uint32_t more);

/* Bytes of a pixel of a frame with these planes. */
uint32_t layout_pixel_size(enum tl_layout_name layout, uint32_t present);

/* The camera that errors are told for: 60 degrees upwards, 1920 x 1080 px, near 0.1 m, far 1000 m. */
tl_camera layouts_camera(void);

/* An error that may be made of something: a column of the table. */
typedef struct error_row {
    const char *key, *heading, *meaning;
    uint32_t planes; /* that it is of: told where the layout can hold one */
    size_t offset;   /* of a double in tl_layout_errors */
} error_row;
enum { ERROR_ROW_COUNT = 11 };
extern const error_row error_rows[ERROR_ROW_COUNT];

/* Every layout: a row of bytes and contents, and a row of errors. */
void layouts_print(void);

/* NULL where memory ran out. */
json_t *layout_json(enum tl_layout_name layout);

/* The words and what is in them, errors, what is not stored, what passes need. */
void layout_print_details(enum tl_layout_name layout);
json_t *layout_words_json(enum tl_layout_name layout);

/* What depths lose at some distances: a layout for each way to store one. May fail as
 * tl_depth_loss_find does; *out is released by the caller. */
tl_status depths_print(tl_error *err);
tl_status depths_json(json_t **out, tl_error *err);

#endif
