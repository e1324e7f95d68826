#include "oracle/sky.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Calls visit for every part of every texel. */
typedef void visitor(void *context, const double d[3], double solid_angle, double light);

static void walk(const tl_oracle_sky *sky, visitor *visit, void *context)
{
    const int rows = sky->height * sky->parts, columns = sky->width * sky->parts;
    for (int y = 0; y < rows; y++) {
        const double top = pi * y / rows, end = pi * (y + 1) / rows, middle = 0.5 * (top + end);
        const double solid_angle =
            2.0 * sin(middle) * sin(0.5 * (end - top)) * 2.0 * pi / columns;
        for (int x = 0; x < columns; x++) {
            const double turn = 2.0 * pi * (x + 0.5) / columns - pi;
            const double d[3] = {sin(middle) * sin(turn), cos(middle), sin(middle) * cos(turn)};
            visit(context, d, solid_angle,
                  (double)sky->values[y / sky->parts * sky->width + x / sky->parts]);
        }
    }
}

typedef struct sum {
    const double *n, *v;
    double alpha, f0, f90;
    double value, weight;
} sum;

static void add_irradiance(void *context, const double d[3], double solid_angle, double light)
{
    sum *s = context;
    const double cosine = dot(s->n, d);
    s->value += cosine > 0.0 ? light * cosine * solid_angle / pi : 0.0;
}

double tl_oracle_sky_irradiance(const tl_oracle_sky *sky, const double n[3])
{
    sum s = {.n = n};
    walk(sky, add_irradiance, &s);
    return s.value;
}

/* Real harmonics up to band 2, in the usual order. */
static void harmonics(const double d[3], double y[9])
{
    const double a = sqrt(1.0 / (4.0 * pi)), b = sqrt(3.0 / (4.0 * pi)),
                 c = sqrt(15.0 / (4.0 * pi)), e = sqrt(5.0 / (16.0 * pi));
    y[0] = a;
    y[1] = b * d[1];
    y[2] = b * d[2];
    y[3] = b * d[0];
    y[4] = c * d[0] * d[1];
    y[5] = c * d[1] * d[2];
    y[6] = e * (3.0 * d[2] * d[2] - 1.0);
    y[7] = c * d[0] * d[2];
    y[8] = 0.5 * c * (d[0] * d[0] - d[1] * d[1]);
}

typedef struct projection {
    double of[9], power;
} projection;

static void project(void *context, const double d[3], double solid_angle, double light)
{
    projection *p = context;
    double y[9];
    harmonics(d, y);
    for (int i = 0; i < 9; i++)
        p->of[i] += light * y[i] * solid_angle;
    p->power += light * light * solid_angle;
}

double tl_oracle_sky_nine(const tl_oracle_sky *sky, const double n[3], double *energy)
{
    static const int band[9] = {0, 1, 1, 1, 2, 2, 2, 2, 2};
    const double of_band[3] = {pi, 2.0 * pi / 3.0, pi / 4.0};
    projection p = {{0.0}, 0.0};
    double y[9], value = 0.0;
    walk(sky, project, &p);
    harmonics(n, y);
    *energy = p.power;
    for (int i = 0; i < 9; i++) {
        value += of_band[band[i]] * p.of[i] * y[i] / pi;
        *energy -= p.of[i] * p.of[i];
    }
    return value;
}

static double distribution(double alpha, double cosine2)
{
    const double a2 = alpha * alpha, t = cosine2 * (a2 - 1.0) + 1.0;
    return a2 / (pi * t * t);
}

static void add_mirrored(void *context, const double d[3], double solid_angle, double light)
{
    sum *s = context;
    const double cosine = dot(s->n, d);
    if (!(cosine > 0.0))
        return;
    /* h is half way between n and d: its cosine squared is (1 + n.d)/2. */
    const double weight = distribution(s->alpha, 0.5 + 0.5 * cosine) * cosine * solid_angle;
    s->value += light * weight;
    s->weight += weight;
}

double tl_oracle_sky_mirrored(const tl_oracle_sky *sky, const double n[3], double alpha)
{
    sum s = {.n = n, .alpha = alpha};
    walk(sky, add_mirrored, &s);
    return s.value / s.weight;
}

/* D V, of Heitz's V: over 4 n.l n.v already. */
static double lobe(double alpha, double nh, double nl, double nv)
{
    const double a2 = alpha * alpha;
    const double masked =
        nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
    return distribution(alpha, nh * nh) * 0.5 / masked;
}

static void add_reflected(void *context, const double d[3], double solid_angle, double light)
{
    sum *s = context;
    const double nl = dot(s->n, d), nv = dot(s->n, s->v);
    double h[3];
    if (!(nl > 0.0))
        return;
    for (int i = 0; i < 3; i++)
        h[i] = s->v[i] + d[i];
    const double length = sqrt(dot(h, h)), nh = dot(s->n, h) / length,
                 vh = dot(s->v, h) / length;
    const double fresnel = s->f0 + (s->f90 - s->f0) * pow(1.0 - vh, 5.0);
    s->value += light * fresnel * lobe(s->alpha, nh, nl, nv) * nl * solid_angle;
}

double tl_oracle_sky_reflected(const tl_oracle_sky *sky,
                               const double n[3],
                               const double v[3],
                               double alpha,
                               double f0,
                               double f90)
{
    sum s = {.n = n, .v = v, .alpha = alpha, .f0 = f0, .f90 = f90};
    walk(sky, add_reflected, &s);
    return s.value;
}

/* Integrands over directions l, around the mirrored one: at an angle `off` from it, turned by `turn`. */
static void add_direction(
    double nv, double alpha, double off, double turn, double solid_angle, double out[3])
{
    const double sine = sqrt(1.0 - nv * nv);
    const double up = nv * cos(off) - sine * sin(off) * cos(turn); /* n.l */
    /* v = (sine, 0, nv), the mirrored direction (-sine, 0, nv). */
    const double x = -sine * cos(off) - nv * sin(off) * cos(turn), y = sin(off) * sin(turn);
    const double vl = sine * x + nv * up;
    const double length = sqrt(2.0 + 2.0 * vl);
    (void)y;
    if (!(up > 0.0) || !(length > 0.0))
        return;
    const double nh = (up + nv) / length, vh = 0.5 * length, graze = pow(1.0 - vh, 5.0);
    const double reflected = lobe(alpha, nh, up, nv) * up * solid_angle;
    out[0] += reflected;
    out[1] += reflected * graze;
    out[2] += up * graze * solid_angle / pi;
}

/* Rings around the mirrored direction whose widths grow from a share of alpha. */
void tl_oracle_sky_shares(
    double cosine, double alpha, double *base, double *grazing, double *lost)
{
    enum { TURNS = 720 };
    const double first = 0.01 * alpha * (cosine + alpha);
    double out[3] = {0.0, 0.0, 0.0};
    for (double from = 0.0; from < pi;) {
        const double to = fmin(pi, from + fmin(0.004, first + 0.01 * from));
        const double solid_angle = (cos(from) - cos(to)) * 2.0 * pi / TURNS;
        for (int turn = 0; turn < TURNS; turn++)
            add_direction(cosine, alpha, 0.5 * (from + to), 2.0 * pi * (turn + 0.5) / TURNS,
                          solid_angle, out);
        from = to;
    }
    *base = out[0];
    *grazing = out[1];
    *lost = out[2];
}
