/* Affine matrices in double: [row][column], the last column is the translation. */
#ifndef TL_MATRIX_H
#define TL_MATRIX_H

#include <math.h>
#include <stdbool.h>

typedef struct tl_affine {
    double m[3][4];
} tl_affine;

static const tl_affine tl_affine_identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

static inline tl_affine tl_affine_product(const tl_affine *a, const tl_affine *b)
{
    tl_affine c;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            c.m[i][j] = a->m[i][0] * b->m[0][j] + a->m[i][1] * b->m[1][j] +
                        a->m[i][2] * b->m[2][j] + (j == 3 ? a->m[i][3] : 0.0);
    return c;
}

static inline void tl_affine_point(const tl_affine *a, const double p[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][0] * p[0] + a->m[i][1] * p[1] + a->m[i][2] * p[2] + a->m[i][3];
}

static inline bool tl_affine_is_finite(const tl_affine *a)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            if (!isfinite(a->m[i][j]))
                return false;
    return true;
}

static inline double tl_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void tl_cross(const double a[3], const double b[3], double out[3])
{
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    for (int i = 0; i < 3; i++)
        out[i] = c[i];
}

/* To length 1; false, and left alone, where there is no direction. The first division keeps the
 * squares of very small and very large vectors inside the exponent's range. */
static inline bool tl_normalize(double v[3])
{
    const double largest = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    if (!(largest > 0.0) || !isfinite(largest))
        return false;
    const double w[3] = {v[0] / largest, v[1] / largest, v[2] / largest};
    const double length = sqrt(tl_dot(w, w));
    for (int i = 0; i < 3; i++)
        v[i] = w[i] / length;
    return true;
}

/* Column `column` of the linear part. */
static inline void tl_affine_column(const tl_affine *a, int column, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a->m[i][column];
}

/* The matrix that turns normals: cofactors of the linear part, times the sign of its determinant
 * (`mirrored`: negative). It is the inverse transpose but for a positive factor, and exists where
 * that does not: for a node that is scaled flat. */
static inline void tl_affine_normal_matrix(const tl_affine *a, double out[3][3], bool *mirrored)
{
    double columns[3][3], cofactors[3][3];
    for (int j = 0; j < 3; j++)
        tl_affine_column(a, j, columns[j]);
    for (int j = 0; j < 3; j++)
        tl_cross(columns[(j + 1) % 3], columns[(j + 2) % 3], cofactors[j]);
    const double determinant = tl_dot(columns[0], cofactors[0]);
    *mirrored = determinant < 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[i][j] = *mirrored ? -cofactors[j][i] : cofactors[j][i];
}

#endif
