#include "sky_moments.h"

#include "parallel.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

/* Integrals over the longitudes of a column: of 1, sin, cos, sin^2, sin cos. */
enum { COLUMN_TERMS = 5 };

/* A row's sums of L with them, and of L^2. */
typedef struct row_sums {
    double of[3][COLUMN_TERMS], power[3];
} row_sums;

typedef struct job {
    const tl_sky_source *source;
    const double (*columns)[COLUMN_TERMS]; /* [width] */
    row_sums *rows;                        /* [height] */
} job;

static void column_terms(double from, double to, double out[COLUMN_TERMS])
{
    out[0] = to - from;
    out[1] = cos(from) - cos(to);
    out[2] = sin(to) - sin(from);
    out[3] = 0.5 * (to - from) - 0.25 * (sin(2.0 * to) - sin(2.0 * from));
    out[4] = 0.5 * (sin(to) * sin(to) - sin(from) * sin(from));
}

static void sum_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const uint32_t width = j->source->width;
    for (size_t row = begin; row < end; row++) {
        row_sums sums = {{{0.0}}, {0.0}};
        const float *at = j->source->pixels + 3 * row * width;
        for (uint32_t x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) {
                const double light = (double)at[3 * x + (uint32_t)c];
                for (int t = 0; t < COLUMN_TERMS; t++)
                    sums.of[c][t] += light * j->columns[x][t];
                sums.power[c] += light * light * j->columns[x][0];
            }
        j->rows[row] = sums;
    }
}

/* What the latitudes of a row, colatitudes `from` to `to`, make of its sums. */
static void add_row(
    const double of[COLUMN_TERMS], double power, double from, double to, tl_sky_moments *m)
{
    const double c0 = cos(from), c1 = cos(to), s0 = sin(from), s1 = sin(to);
    const double sine = c0 - c1;
    const double sine2 = 0.5 * (to - from) - 0.25 * (sin(2.0 * to) - sin(2.0 * from));
    const double cubes = (c0 * c0 * c0 - c1 * c1 * c1) / 3.0; /* of sin cos^2 */
    const double sine3 = sine - cubes;
    const double sine_cosine = 0.5 * (s1 * s1 - s0 * s0);
    const double sine2_cosine = (s1 * s1 * s1 - s0 * s0 * s0) / 3.0;
    m->light += sine * of[0];
    m->power += sine * power;
    m->first[0] += sine2 * of[1];
    m->first[1] += sine_cosine * of[0];
    m->first[2] += sine2 * of[2];
    m->second[0][0] += sine3 * of[3];
    m->second[1][1] += cubes * of[0];
    m->second[2][2] += sine3 * (of[0] - of[3]);
    m->second[0][1] += sine2_cosine * of[1];
    m->second[0][2] += sine3 * of[4];
    m->second[1][2] += sine2_cosine * of[2];
}

tl_status tl_sky_moments_of(const tl_sky_source *source, tl_sky_moments out[3], tl_error *err)
{
    const uint32_t width = source->width, height = source->height;
    double(*columns)[COLUMN_TERMS] = malloc(width * sizeof *columns);
    row_sums *rows = malloc(height * sizeof *rows);
    job j = {source, (const double(*)[COLUMN_TERMS])columns, rows};
    tl_status status = TL_OK;
    if (!columns || !rows) {
        status = tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
        goto done;
    }
    for (uint32_t x = 0; x < width; x++)
        column_terms(2.0 * pi * ((double)x / width - 0.5),
                     2.0 * pi * ((double)(x + 1) / width - 0.5), columns[x]);
    tl_parallel(height, 1, sum_rows, &j);
    for (int c = 0; c < 3; c++) {
        tl_sky_moments m = {.light = 0.0};
        for (uint32_t y = 0; y < height; y++)
            add_row(rows[y].of[c], rows[y].power[c], pi * y / height, pi * (y + 1) / height,
                    &m);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < i; k++)
                m.second[i][k] = m.second[k][i];
        out[c] = m;
    }
done:
    free(columns);
    free(rows);
    return status;
}

/* Of all bands, and of the first three: sum of squares of the coefficients. */
static double energy_beyond(const tl_sky_moments *of)
{
    double first = 0.0, second = 0.0;
    for (int i = 0; i < 3; i++) {
        first += of->first[i] * of->first[i];
        for (int k = 0; k < 3; k++)
            second += of->second[i][k] * of->second[i][k];
    }
    const double light2 = of->light * of->light;
    const double kept =
        (light2 + 3.0 * first + 5.0 * (1.5 * second - 0.5 * light2)) / (4.0 * pi);
    return of->power > kept ? of->power - kept : 0.0;
}

double tl_sky_truncation(const tl_sky_moments *of)
{
    const double by_energy = sqrt(energy_beyond(of) / (192.0 * pi));
    const double by_light = 3.0 / (32.0 * pi) * of->light;
    return by_energy < by_light ? by_energy : by_light;
}
