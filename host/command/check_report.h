/* What `tilelight check` found, frame by frame: as text, as JSON, as a picture. */
#ifndef TL_CHECK_REPORT_H
#define TL_CHECK_REPORT_H

#include "tilelight/check.h"

#include <jansson.h>

enum { MOST_CHECK_LIGHTS = 64 }; /* reported of one pixel */

/* One frame that was checked. */
typedef struct check_result {
    char name[256]; /* a built-in frame's, or a file's */
    uint32_t width, height;
    uint64_t light_count;
    tl_check_report report;
    struct {
        tl_check_light light;
        char name[64];           /* as in the light set */
    } lights[MOST_CHECK_LIGHTS]; /* those of the worst pixel, that come first */
    size_t worst_light_count;    /* however many */
} check_result;

/* All frames together. worst: an index into results, of the largest ratio. */
typedef struct check_summary {
    const check_result *results; /* [count] */
    size_t count, worst;
    uint64_t failed_frame_count, pixel_count, failed_count, not_finite_count, excused_count;
    double rounding_ratio; /* the largest of them */
} check_summary;

check_summary check_summarise(const check_result *results, size_t count);

/* A line a frame, then the verdict and what is known of the worst pixel. `what` was checked. */
void check_print(const char *what, const check_summary *summary);

/* The same as an object; NULL where memory is out. `kernel`, `device` may be NULL. */
json_t *check_json(const char *kernel,
                   const char *entry,
                   const char *device,
                   const check_summary *summary);

/* TL_OK, or TL_ERR_DIFFERENT with the sentence of a failed check. */
tl_status check_judge(const char *what, const check_summary *summary, tl_error *err);

/* Error over tolerance as an 8-bit picture: grey up to 1, then red, yellow from 10,000 on, white
 * where nothing is allowed or the value is not finite. rgb: [height][width][3]. */
void check_paint(const tl_image *ratios, uint8_t *rgb);

#endif
