/* Rows of materials: their fields, one table for checking, reading, writing and telling of them. */
#ifndef TL_MATERIAL_ROWS_H
#define TL_MATERIAL_ROWS_H

#include "tilelight/lights.h"

typedef struct tl_material_field {
    const char *name;   /* in files */
    uint32_t parameter; /* a bit of tl_brdf_parameter: models that take it may have the field */
    uint32_t count;     /* numbers: 1 or 3 */
    size_t offset;      /* of float [count] in tl_material_row */
    float least, most;  /* of each */
} tl_material_field;

enum { TL_MATERIAL_FIELD_COUNT = 7 };
extern const tl_material_field tl_material_fields[TL_MATERIAL_FIELD_COUNT];

/* The parameters that a model takes: bits of tl_brdf_parameter. */
uint32_t tl_model_takes(enum tl_shading_model model);

const float *tl_material_values(const tl_material_row *row, const tl_material_field *field);

/* "materials[2]", with the material that it is for where it names one. */
typedef struct tl_material_label {
    char text[192];
} tl_material_label;
tl_material_label tl_material_label_of(const tl_light_set *set, size_t row);

/* Fails with TL_ERR_FORMAT, naming the row and what is wrong: more rows than indices, an index that is none
 * or has a row already, a parameter that the model does not take or that is outside its range. */
tl_status tl_material_rows_check(const tl_light_set *set, const char *source, tl_error *err);

#endif
