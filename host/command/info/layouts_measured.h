/* `tilelight layouts --bandwidth`: what the bytes of layouts cost on a device. */
#ifndef TL_LAYOUTS_MEASURED_H
#define TL_LAYOUTS_MEASURED_H

#include "tilelight/layouts.h"

#include <jansson.h>

typedef struct measured_options {
    const char *device; /* NULL: the default one */
    uint32_t width, height;
    enum tl_layout_name first, end; /* layouts [first, end) */
} measured_options;

/* Measures, and prints or adds to `report` (NULL: prints): what was measured, and to `layouts`, one object
 * a layout in the same order, its figures. Where no device was asked for by name and there is none, a
 * notice takes the measurement's place. Fails as tl_device_open and tl_lighting_run do. */
tl_status measured_layouts(const measured_options *options,
                           json_t *report,
                           json_t *layouts,
                           tl_error *err);

#endif
