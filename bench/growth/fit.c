#include "fit.h"

#include <math.h>

#define WORD(name, word, meaning) [name] = word,
const char *const tl_term_words[TL_TERM_COUNT] = {TL_TERMS(WORD)};
#undef WORD

/* Normal equations of the relative problem: each row of amounts is divided by its time, and the
 * right-hand side is 1. */
typedef struct equations {
    double matrix[TL_TERM_COUNT][TL_TERM_COUNT], right[TL_TERM_COUNT];
} equations;

static equations equations_of(const tl_growth_point *points, size_t count)
{
    equations e = {0};
    for (size_t i = 0; i < count; i++)
        for (int row = 0; row < TL_TERM_COUNT; row++) {
            const double share = points[i].amounts[row] / points[i].ns;
            e.right[row] += share;
            for (int column = 0; column < TL_TERM_COUNT; column++)
                e.matrix[row][column] += share * points[i].amounts[column] / points[i].ns;
        }
    return e;
}

/* The prices of the terms in `used`, the others 0: Gauss-Jordan elimination, which needs no exchange
 * of rows for a positive definite matrix. 0 where it is not, because terms are proportional. */
static int solve(equations e, unsigned used, double prices[TL_TERM_COUNT])
{
    static const double least_pivot = 1e-10; /* of what stood there first */
    const equations original = e;
    for (int k = 0; k < TL_TERM_COUNT; k++) {
        if (!(used & 1u << k))
            continue;
        if (!(e.matrix[k][k] > least_pivot * original.matrix[k][k]))
            return 0;
        for (int row = 0; row < TL_TERM_COUNT; row++) {
            if (row == k || !(used & 1u << row))
                continue;
            const double factor = e.matrix[row][k] / e.matrix[k][k];
            for (int column = 0; column < TL_TERM_COUNT; column++)
                e.matrix[row][column] -= factor * e.matrix[k][column];
            e.right[row] -= factor * e.right[k];
        }
    }
    for (int k = 0; k < TL_TERM_COUNT; k++)
        prices[k] = used & 1u << k ? e.right[k] / e.matrix[k][k] : 0.0;
    return 1;
}

static int none_is_negative(const double prices[TL_TERM_COUNT])
{
    for (int k = 0; k < TL_TERM_COUNT; k++)
        if (!(prices[k] >= 0.0))
            return 0;
    return 1;
}

double tl_growth_fitted_ns(const tl_growth_fit *fit, const tl_growth_point *point)
{
    double ns = 0.0;
    for (int k = 0; k < TL_TERM_COUNT; k++)
        ns += fit->prices[k] * point->amounts[k];
    return ns;
}

double tl_growth_residual(const tl_growth_fit *fit, const tl_growth_point *point)
{
    return point->ns / tl_growth_fitted_ns(fit, point) - 1.0;
}

double tl_growth_pair_price(const tl_growth_fit *fit, const tl_growth_point *point)
{
    const double pairs = point->amounts[TL_TERM_PAIRS];
    const double others = tl_growth_fitted_ns(fit, point) - fit->prices[TL_TERM_PAIRS] * pairs;
    return (point->ns - others) / pairs;
}

static double sum_of_squares(const tl_growth_fit *fit,
                             const tl_growth_point *points,
                             size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double off = tl_growth_fitted_ns(fit, &points[i]) / points[i].ns - 1.0;
        sum += off * off;
    }
    return sum;
}

/* What the fit says of the points it was made from. */
static void judge(tl_growth_fit *fit, const tl_growth_point *points, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const double residual = fabs(tl_growth_residual(fit, &points[i]));
        const double price = tl_growth_pair_price(fit, &points[i]);
        const double pairs_ns = fit->prices[TL_TERM_PAIRS] * points[i].amounts[TL_TERM_PAIRS];
        fit->worst_residual = fmax(fit->worst_residual, residual);
        if (!(pairs_ns >= 0.5 * tl_growth_fitted_ns(fit, &points[i])) || pairs_ns <= 0.0)
            continue;
        const double ratio = price / fit->prices[TL_TERM_PAIRS];
        fit->least_pair_price =
            fit->most_pair_price > 0.0 ? fmin(fit->least_pair_price, ratio) : ratio;
        fit->most_pair_price = fmax(fit->most_pair_price, ratio);
    }
}

/* The optimum under the bounds is the free optimum of the terms that it leaves above 0 (Lawson and
 * Hanson, "Solving Least Squares Problems", 1974, chapter 23); with four terms, all 15 choices are
 * tried. */
tl_growth_fit tl_growth_fit_make(const tl_growth_point *points, size_t count)
{
    const equations e = equations_of(points, count);
    tl_growth_fit best = {.worst_residual = 0.0};
    double least = (double)INFINITY;
    for (unsigned used = 1; used < 1u << TL_TERM_COUNT; used++) {
        tl_growth_fit one = {.worst_residual = 0.0};
        if (!solve(e, used, one.prices) || !none_is_negative(one.prices))
            continue;
        const double sum = sum_of_squares(&one, points, count);
        if (sum < least) {
            least = sum;
            best = one;
        }
    }
    judge(&best, points, count);
    return best;
}
