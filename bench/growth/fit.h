/* How the time of a frame grows: a sum of what there is, each times a price. */
#ifndef TL_GROWTH_FIT_H
#define TL_GROWTH_FIT_H

#include <stddef.h>

/* X(name, what one costs) */
#define TL_TERMS(X)                                                          \
    X(TL_TERM_PIXELS, "pixels", "loading a pixel, and storing its radiance") \
    X(TL_TERM_PAIRS, "pairs", "a pixel and a light that its tile lists")     \
    X(TL_TERM_LIGHTS, "lights", "preparing a light, and finding its tiles")  \
    X(TL_TERM_TILES, "tiles", "bounding a tile, and starting on it")

typedef enum tl_term {
#define TL_TERM_NAME(name, word, meaning) name,
    TL_TERMS(TL_TERM_NAME)
#undef TL_TERM_NAME
        TL_TERM_COUNT
} tl_term;

extern const char *const tl_term_words[TL_TERM_COUNT];

typedef struct tl_growth_point {
    double amounts[TL_TERM_COUNT]; /* how many of each */
    double ns;                     /* of the frame; above 0 */
} tl_growth_point;

typedef struct tl_growth_fit {
    double prices[TL_TERM_COUNT]; /* ns each, 0 and above */
    double worst_residual;        /* the largest |measured / fitted - 1| */
    /* The price of a pair by each point alone, over the fitted one: least and largest of the points
     * whose fit spends at least half of the time on pairs. Both 0 where there is no such point. */
    double least_pair_price, most_pair_price;
} tl_growth_fit;

/* The prices, none negative, with the least sum of squares of relative residuals,
 * fitted / measured - 1. points: [count], count above 0. Where amounts are proportional to each
 * other, their prices are not told apart: only their sum means something. Cannot fail. */
tl_growth_fit tl_growth_fit_make(const tl_growth_point *points, size_t count);

/* What the fit says a point takes, in ns; its residual, measured / fitted - 1; and the price of a
 * pair once the other terms are taken off. */
double tl_growth_fitted_ns(const tl_growth_fit *fit, const tl_growth_point *point);
double tl_growth_residual(const tl_growth_fit *fit, const tl_growth_point *point);
double tl_growth_pair_price(const tl_growth_fit *fit, const tl_growth_point *point);

#endif
