/* From numbers as a program wrote them to planes of a G-buffer in full float: what depth, normals and
 * colours mean. */
#ifndef TL_IMPORT_MEANING_H
#define TL_IMPORT_MEANING_H

#include "plan.h"
#include "tilelight/gbuffer.h"

/* A frame on its way. The depth plane is final once tl_import_depth is through. */
typedef struct tl_importing {
    const tl_import_plan *plan;
    tl_gbuffer *gbuffer;
    const float *alpha;       /* [height][pitch], or NULL: all covered */
    const float *position[3]; /* [height][pitch] each, or NULL: the depth plane holds depths */
    const tl_notices *notices;
    tl_import_counts counts;
} tl_importing;

/* Makes the depth plane m along the view axis, +infinity for sky, and NaN where it was NaN;
 * counts. Fails with TL_ERR_ARGUMENT where the kind of depth needs what was not given. */
tl_status tl_import_depth(tl_importing *f, tl_error *err);

/* The camera's near and far, where nothing says them: half the least depth, twice the most. */
void tl_import_range(tl_importing *f);

/* Makes normals unit vectors in world space. Those of no length, or not finite, stay. Cannot fail. */
void tl_import_normals(tl_importing *f);

/* Makes a colour of three planes linear Rec. 709. Fails with TL_ERR_FORMAT for chromaticities that span
 * no colours. */
tl_status tl_import_color(const tl_importing *f, tl_import_plane plane, tl_error *err);

/* The matrix from linear RGB of these chromaticities to linear Rec. 709: row-major, for
 * columns. x, y of red, green, blue, white. False where they span no colours. */
bool tl_color_matrix(const double chromaticities[8], double out[9]);

/* The ray through the centre of a pixel: x and y per unit of depth; orthographic: in m. */
void tl_pixel_ray(const tl_camera *camera, uint32_t x, uint32_t y, double out[2]);

/* A grid over width x height pixels, or fewer where there are fewer: enough to tell how numbers are
 * meant. */
typedef struct tl_sample_grid {
    uint32_t width, height, columns, rows;
} tl_sample_grid;

static inline tl_sample_grid tl_sample_grid_of(uint32_t width, uint32_t height)
{
    enum { MOST = 128 }; /* a side */
    return (tl_sample_grid){width, height, width < MOST ? width : MOST,
                            height < MOST ? height : MOST};
}

/* The pixel of sample i, 0 to columns * rows - 1. */
static inline void tl_sample_at(const tl_sample_grid *grid,
                                uint32_t i,
                                uint32_t *x,
                                uint32_t *y)
{
    *x = i % grid->columns * grid->width / grid->columns;
    *y = i / grid->columns * grid->height / grid->rows;
}

#endif
