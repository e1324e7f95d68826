/* Cases that bounds, lists, shading, shadows, ambient occlusion and what comes after lighting have been wrong
 * in elsewhere: a table, one function each, and the figures they come to. */
#ifndef TL_HARD_CASE_H
#define TL_HARD_CASE_H

#include "frames.h"

/* What a case came to. It passes where nothing is wrong, lost or beyond what is allowed, and where the usual
 * form, if one is named, is wrong somewhere: else the case would not be hard. */
typedef struct hard_result {
    uint64_t tried, wrong; /* what hard_case.counted says */
    uint64_t usual_wrong;  /* of those that were tried, by hard_case.usual */
    uint64_t pixels;       /* of pictures in all ways */
    uint64_t lost;   /* of these, with other bits than the picture without tiles and lists */
    uint64_t beyond; /* pixels beyond what rounding in float may give (tilelight/check.h) */
    /* the largest error against the reference in double, over what is allowed; of pixels where no light
     * hangs on rounding */
    double error;
} hard_result;

/* What a case runs on, and where it counts. */
typedef struct hard_bench {
    tl_device *device;
    hard_result result;
} hard_bench;

typedef struct hard_case {
    int number;
    const char *name;    /* a word, by which it is selected */
    const char *about;   /* what goes wrong elsewhere, one sentence */
    const char *ours;    /* what is done here, one sentence */
    const char *seen_in; /* projects and numbers of their issues */
    const char *counted; /* what is tried */
    const char *usual;   /* the usual form; NULL: there is none to hold against it */
    void (*run)(hard_bench *bench);
} hard_case;

extern const hard_case hard_cases[];
extern const size_t hard_case_count;

/* Whether the case came out right. */
int hard_passes(const hard_case *of, const hard_result *result);

/* A frame, which is repaired or needs no repair, its lights, and the picture that the twin makes of them
 * without tiles and lists. */
typedef struct hard_scene {
    const tl_gbuffer *g;
    const tl_light_set *lights;
    const tl_image *want;
} hard_scene;

/* That picture; the caller destroys it. */
tl_image *hard_picture(const tl_gbuffer *g, const tl_light_set *lights);

/* How many pixels have other bits; of two pictures of one size. */
uint64_t hard_different_pixels(const tl_image *a, const tl_image *b);

/* Holds a picture against the reference in double. */
void hard_judge(hard_bench *bench,
                const tl_gbuffer *g,
                const tl_light_set *lights,
                const tl_image *image);

/* Lights the scenes in every way, one after the other by the same tl_lighting: the bits have to be those of
 * `want`. */
void hard_light_in_turn(hard_bench *bench, const hard_scene scenes[], size_t count);

/* Both, of one frame. */
void hard_light(hard_bench *bench, const tl_gbuffer *g, const tl_light_set *lights);

/* Counts one try. usual_right: 1 where there is no usual form. */
static inline void hard_count(hard_bench *bench, int right, int usual_right)
{
    bench->result.tried++;
    bench->result.wrong += !right;
    bench->result.usual_wrong += !usual_right;
}

void hard_camera_inside(hard_bench *bench);
void hard_small_rectangle(hard_bench *bench);
void hard_scissor(hard_bench *bench);
void hard_left_tile(hard_bench *bench);
void hard_far_plane(hard_bench *bench);
void hard_near_gap(hard_bench *bench);
void hard_wide_cone(hard_bench *bench);
void hard_narrow_cone(hard_bench *bench);
void hard_quarter_turn(hard_bench *bench);
void hard_cone_sphere(hard_bench *bench);
void hard_cone_edge(hard_bench *bench);
void hard_cone_axis(hard_bench *bench);
void hard_orthographic(hard_bench *bench);
void hard_frustum(hard_bench *bench);
void hard_long_lists(hard_bench *bench);
void hard_resize(hard_bench *bench);
void hard_odd_sizes(hard_bench *bench);
void hard_sky(hard_bench *bench);
void hard_one_depth(hard_bench *bench);
void hard_scaled_view(hard_bench *bench);
void hard_light_order(hard_bench *bench);
void hard_touching(hard_bench *bench);
void hard_powers(hard_bench *bench);
void hard_no_normal(hard_bench *bench);
void hard_nan_pixel(hard_bench *bench);
void hard_edge_neighbours(hard_bench *bench);
void hard_edge_plane(hard_bench *bench);
void hard_grey_bloom(hard_bench *bench);
void hard_nan_bloom(hard_bench *bench);
void hard_half_pixel(hard_bench *bench);
void hard_bright_tone(hard_bench *bench);
void hard_own_shadow(hard_bench *bench);
void hard_far_shadow(hard_bench *bench);
void hard_cube_seam(hard_bench *bench);
void hard_flat_occlusion(hard_bench *bench);
void hard_pane_order(hard_bench *bench);
void hard_profile_seam(hard_bench *bench);
void hard_profile_axis(hard_bench *bench);
void hard_sun_pixel(hard_bench *bench);
void hard_sky_seam(hard_bench *bench);

#endif
