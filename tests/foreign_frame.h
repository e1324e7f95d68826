/* A small frame as another program might write it: a sloping plane before the camera, its numbers different
 * for neighbours. Include foreign_exr.h before. */
#ifndef TL_FOREIGN_FRAME_H
#define TL_FOREIGN_FRAME_H

#include "file_cases.h"

#include "tilelight/import.h"

enum { FRAME_WIDTH = 9, FRAME_HEIGHT = 7 };

/* [FRAME_HEIGHT][FRAME_WIDTH] each; exact in half. */
typedef struct foreign_frame {
    float depth[FRAME_HEIGHT * FRAME_WIDTH];
    float normal[3][FRAME_HEIGHT * FRAME_WIDTH];
    float albedo[3][FRAME_HEIGHT * FRAME_WIDTH];
    float alpha[FRAME_HEIGHT * FRAME_WIDTH];
} foreign_frame;

static inline void foreign_fill(foreign_frame *f)
{
    for (int y = 0; y < FRAME_HEIGHT; y++)
        for (int x = 0; x < FRAME_WIDTH; x++) {
            const int at = y * FRAME_WIDTH + x;
            f->depth[at] = 2.0f + 0.125f * (float)y + 0.015625f * (float)x;
            f->alpha[at] = 1.0f;
            for (int c = 0; c < 3; c++) {
                f->normal[c][at] = c == 2 ? 1.0f : 0.0f;
                f->albedo[c][at] = (float)(x + 10 * y + c) / 256.0f;
            }
        }
}

/* One part with Z, N, albedo and A. `f` must outlive it. */
static inline void foreign_describe(foreign_file *file,
                                    const foreign_frame *f,
                                    exr_pixel_type_t type)
{
    const float *normals[3] = {f->normal[0], f->normal[1], f->normal[2]};
    const float *colors[3] = {f->albedo[0], f->albedo[1], f->albedo[2]};
    *file = (foreign_file){
        .width = FRAME_WIDTH, .height = FRAME_HEIGHT, .pitch = FRAME_WIDTH, .part_count = 1};
    foreign_add(&file->parts[0], "Z", type, f->depth);
    foreign_add(&file->parts[0], "A", type, f->alpha);
    foreign_add_three(&file->parts[0], "N", "XYZ", type, normals);
    foreign_add_three(&file->parts[0], "albedo", "RGB", type, colors);
}

static inline tl_import_options foreign_options(void)
{
    tl_import_options options = tl_import_options_default();
    options.camera.vertical_fov = 60.0;
    return options;
}

/* Fails the test unless a plane is `wanted` but for pixels outside `crop`, which are sky. */
static inline void foreign_assert(const char *name,
                                  const tl_gbuffer *g,
                                  enum tl_plane plane,
                                  const float *wanted,
                                  const int crop[4])
{
    const float *got = tl_gbuffer_plane(g, plane);
    for (int y = 0; y < FRAME_HEIGHT; y++)
        for (int x = 0; x < FRAME_WIDTH; x++) {
            const int is_inside = x >= crop[0] && y >= crop[1] && x < FRAME_WIDTH - crop[2] &&
                                  y < FRAME_HEIGHT - crop[3];
            const float value =
                is_inside || plane != TL_DEPTH ? wanted[y * FRAME_WIDTH + x] : INFINITY;
            if ((is_inside || plane == TL_DEPTH) &&
                !same_bits(got[(size_t)y * g->pitch + (size_t)x], value))
                fail_msg("%s: plane %d at (%d, %d) is %g, not %g", name, (int)plane, x, y,
                         (double)got[(size_t)y * g->pitch + (size_t)x], (double)value);
        }
}

/* Sentences of one import, joined. */
typedef struct foreign_notices {
    char text[8192];
} foreign_notices;

static inline void foreign_say(void *context, const char *sentence)
{
    foreign_notices *n = context;
    const size_t used = strlen(n->text);
    snprintf(n->text + used, sizeof n->text - used, "%s\n", sentence);
}

#endif
