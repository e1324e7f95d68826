/* The filters of FLIP, all separable. Numbers of sections and equations are those of Andersson et
 * al. 2020. */
#ifndef TL_FLIP_FILTERS_H
#define TL_FLIP_FILTERS_H

enum { FLIP_MOST_RADIUS = 144 }; /* px, at 1000 pixels a degree */

/* A filter along one axis: taps [2 radius + 1]. */
typedef struct flip_taps {
    float taps[2 * FLIP_MOST_RADIUS + 1];
} flip_taps;

/* How much of detail the eye sees: section 4.1.1, sums of Gaussians by the fit of Johnson and
 * Fairchild. Blue against yellow has two terms, which share one sum of weights. */
enum {
    FLIP_LIGHTNESS,
    FLIP_RED_GREEN,
    FLIP_BLUE_YELLOW,
    FLIP_BLUE_YELLOW_NARROW,
    FLIP_EYE_COUNT
};

typedef struct flip_filters {
    int eye_radius, feature_radius;       /* px */
    flip_taps across_eye[FLIP_EYE_COUNT]; /* with the weight of the term */
    flip_taps down_eye[FLIP_EYE_COUNT];   /* sums to 1 */
    flip_taps smooth, edge, point;        /* features: section 4.2.1 */
} flip_filters;

/* pixels_per_degree: 1 to 1000. Cannot fail. */
void flip_filters_make(double pixels_per_degree, flip_filters *out);

#endif
