/* `tilelight compare --flip`: how visible differences are. */
#ifndef TL_COMPARE_FLIP_H
#define TL_COMPARE_FLIP_H

#include "tilelight/flip.h"

#include <argp.h>
#include <jansson.h>
#include <stdbool.h>

typedef struct flip_options {
    bool asked;
    const char *map; /* NULL: none */
    double pixels_per_degree;
} flip_options;

flip_options flip_options_default(void);

/* Its input is a flip_options. */
extern const struct argp flip_argp; /* --flip, --flip-map, --pixels-per-degree */

bool flip_is_asked(const flip_options *options);

/* Compares pictures[0] with pictures[1], both PNGs or neither, and writes the map. Fails with
 * TL_ERR_ARGUMENT, TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status flip_run(const flip_options *options,
                   const char *const paths[2],
                   tl_image *const pictures[2],
                   const int is_png[2],
                   tl_flip *out,
                   tl_error *err);

void flip_print(const tl_flip *flip);
json_t *flip_json(const tl_flip *flip); /* a new reference */

/* TL_ERR_DIFFERENT where the mean is above the tolerance. */
tl_status flip_judge(const tl_flip *flip,
                     double tolerance,
                     const char *const paths[2],
                     tl_error *err);

#endif
