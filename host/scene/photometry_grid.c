/* Uneven angles brought to an even grid. */
#include "tilelight/photometry.h"

#include <math.h>
#include <stdlib.h>

/* Steps are looked for in these: what files write has 4 digits behind the point at most. */
static const double unit = 1e-4; /* degrees */
enum { UNITS_OF_QUARTER = 900000 };

/* Finer steps are not made: a tenth of a degree down, a third around. What has both is 7.4 MiB. */
enum { MOST_STEPS_OF_QUARTER = 900, MOST_COLUMNS = 1080 };

static long common_divisor(long a, long b)
{
    while (b != 0) {
        const long rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* How many steps a quarter turn has, so that all angles are ends of steps; `most` where that takes more, or
 * where there is none. *is_exact says whether they are. */
static long steps_of_quarter(const double *angles, size_t count, long most, int *is_exact)
{
    long step = UNITS_OF_QUARTER;
    *is_exact = 1;
    for (size_t i = 0; i < count; i++) {
        const double units = angles[i] / unit;
        const long whole = lround(units);
        *is_exact = *is_exact && fabs(units - (double)whole) <= 1e-6;
        step = common_divisor(step, whole);
    }
    *is_exact = *is_exact && UNITS_OF_QUARTER / step <= most;
    return *is_exact ? UNITS_OF_QUARTER / step : most;
}

typedef struct grid {
    long columns, rows;
    double step_around, step_down, first; /* degrees */
    const double *values;                 /* cd, [rows][columns] */
} grid;

/* As kernels read it: columns come round, rows do not go on. */
static double grid_at(const grid *g, double horizontal, double vertical)
{
    const double x = horizontal / g->step_around, y = (vertical - g->first) / g->step_down;
    const long i = (long)floor(x), j = (long)fmin(floor(y), (double)(g->rows - 2));
    const double fx = x - (double)i, fy = y - (double)j;
    const double *const upper = g->values + j * g->columns, *const lower = upper + g->columns;
    const long left = i % g->columns, right = (i + 1) % g->columns;
    const double a = upper[left] + fx * (upper[right] - upper[left]);
    const double b = lower[left] + fx * (lower[right] - lower[left]);
    return a + fy * (b - a);
}

/* Of a row; the last has the file's last angle, whatever rounding does. */
static double vertical_of(const tl_photometry *p, const grid *g, long row)
{
    return fmin(g->first + (double)row * g->step_down, p->vertical[p->vertical_count - 1]);
}

static double largest_at(const tl_photometry *p, const grid *g, double horizontal, double most)
{
    for (size_t i = 0; i < p->vertical_count; i++)
        most = fmax(most, fabs(grid_at(g, horizontal, p->vertical[i]) -
                               tl_photometry_at(p, horizontal, p->vertical[i])));
    for (long j = 0; j < g->rows; j++) {
        const double vertical = vertical_of(p, g, j);
        most = fmax(most, fabs(grid_at(g, horizontal, vertical) -
                               tl_photometry_at(p, horizontal, vertical)));
    }
    return most;
}

/* Both are linear along each axis between the angles of either, and so is what they differ by: it is largest
 * where such angles cross. Angles of mirror images cross alike, for the grid has them too. */
static double largest_difference(const tl_photometry *p, const grid *g)
{
    double most = 0.0;
    for (size_t i = 0; i < p->horizontal_count; i++)
        most = largest_at(p, g, p->horizontal[i], most);
    for (long i = 0; i < g->columns; i++)
        most = largest_at(p, g, (double)i * g->step_around, most);
    return most;
}

static grid grid_of(const tl_photometry *p, int *is_exact)
{
    const double last = p->vertical[p->vertical_count - 1];
    int down_exact = 1, around_exact = 1;
    const long down =
        steps_of_quarter(p->vertical, p->vertical_count, MOST_STEPS_OF_QUARTER, &down_exact);
    const long around =
        steps_of_quarter(p->horizontal, p->horizontal_count, MOST_COLUMNS / 4, &around_exact);
    grid g = {.columns = p->horizontal_count == 1 ? 1 : 4 * around,
              .first = p->vertical[0],
              .step_down = 90.0 / (double)down};
    g.step_around = 360.0 / (double)g.columns;
    g.rows = lround((last - g.first) / g.step_down) + 1;
    *is_exact = down_exact && around_exact;
    return g;
}

tl_status tl_photometry_resample(const tl_photometry *p, tl_light_profile *out, tl_error *err)
{
    int is_exact = 0;
    grid g = grid_of(p, &is_exact);
    const size_t count = (size_t)g.columns * (size_t)g.rows;
    const double peak = tl_photometry_peak(p);
    double *const candela = malloc(count * sizeof *candela);
    float *const shares = malloc(count * sizeof *shares);
    if (!candela || !shares) {
        free(candela);
        free(shares);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a light's profile");
    }
    for (size_t i = 0; i < count; i++) {
        const double horizontal = (double)(i % (size_t)g.columns) * g.step_around;
        candela[i] = tl_photometry_at(p, horizontal, vertical_of(p, &g, (long)i / g.columns));
        shares[i] = peak > 0.0 ? (float)(candela[i] / peak) : 0.0f;
    }
    g.values = candela;
    *out = (tl_light_profile){.columns = (uint32_t)g.columns,
                              .rows = (uint32_t)g.rows,
                              .first_row = (uint32_t)lround(g.first / g.step_down),
                              .rows_of_half_turn = (uint32_t)lround(180.0 / g.step_down),
                              .shares = shares,
                              .peak = peak,
                              .flux = tl_photometry_flux(p),
                              .lamp_lumens = p->lamp_lumens,
                              .off = is_exact ? 0.0 : largest_difference(p, &g)};
    free(candela);
    return TL_OK;
}
