/* Colours of other primaries, or encoded for screens, as linear Rec. 709. */
#include "meaning.h"
#include "parallel.h"
#include "srgb.h"

#include <math.h>
#include <string.h>

/* Rec. 709 (ITU-R BT.709-6, table 1, item 1.3 and 1.4): x, y of red, green, blue and white D65. */
static const double rec709[8] = {0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};

/* Files round them to as little as three digits. */
static const double same = 6e-4;

static void multiply(const double a[9], const double b[9], double out[9])
{
    double made[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            made[3 * i + j] =
                a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    memcpy(out, made, sizeof made);
}

static void apply(const double m[9], const double v[3], double out[3])
{
    double made[3];
    for (int i = 0; i < 3; i++)
        made[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
    memcpy(out, made, sizeof made);
}

/* By cofactors. False for a matrix without an inverse. */
static bool invert(const double m[9], double out[9])
{
    double made[9], determinant = 0.0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            made[3 * i + j] = m[3 * a + c] * m[3 * b + d] - m[3 * a + d] * m[3 * b + c];
        }
    for (int i = 0; i < 3; i++)
        determinant += m[i] * made[3 * i];
    if (!isfinite(determinant) || !(fabs(determinant) > 1e-9))
        return false;
    for (int i = 0; i < 9; i++)
        out[i] = made[i] / determinant;
    return true;
}

static void xyz_of(double x, double y, double out[3])
{
    out[0] = x / y;
    out[1] = 1.0;
    out[2] = (1.0 - x - y) / y;
}

/* XYZ from linear RGB: SMPTE RP 177, section 3.3. Columns are the primaries, scaled so that
 * 1 1 1 is white with Y = 1. */
static bool xyz_from_rgb(const double c[8], double out[9])
{
    double primaries[9], inverse[9], white[3], scales[3];
    for (int k = 0; k < 3; k++) {
        primaries[k] = c[2 * k];
        primaries[3 + k] = c[2 * k + 1];
        primaries[6 + k] = 1.0 - c[2 * k] - c[2 * k + 1];
    }
    if (!(c[7] > 1e-3) || !invert(primaries, inverse))
        return false;
    xyz_of(c[6], c[7], white);
    apply(inverse, white, scales);
    for (int i = 0; i < 9; i++)
        out[i] = primaries[i] * scales[i % 3];
    return true;
}

/* From one white to another as von Kries with the cones of Bradford: Lam, "Metamerism and colour
 * constancy", 1985; the matrix as in ICC.1:2010, annex E. */
static bool adapt(const double from[3], const double to[3], double out[9])
{
    static const double cones[9] = {0.8951, 0.2664, -0.1614, -0.7502, 1.7135,
                                    0.0367, 0.0389, -0.0685, 1.0296};
    double inverse[9], a[3], b[3], scaled[9];
    apply(cones, from, a);
    apply(cones, to, b);
    for (int i = 0; i < 9; i++) {
        if (!(fabs(a[i / 3]) > 1e-6))
            return false;
        scaled[i] = cones[i] * b[i / 3] / a[i / 3];
    }
    if (!invert(cones, inverse))
        return false;
    multiply(inverse, scaled, out);
    return true;
}

bool tl_color_matrix(const double chromaticities[8], double out[9])
{
    double to_xyz[9], from_rec709[9], to_rec709[9], adaptation[9], white[3], d65[3];
    if (!xyz_from_rgb(chromaticities, to_xyz) || !xyz_from_rgb(rec709, from_rec709) ||
        !invert(from_rec709, to_rec709))
        return false;
    xyz_of(chromaticities[6], chromaticities[7], white);
    xyz_of(rec709[6], rec709[7], d65);
    if (!adapt(white, d65, adaptation))
        return false;
    multiply(adaptation, to_xyz, out);
    multiply(to_rec709, out, out);
    return true;
}

typedef struct color_work {
    const tl_gbuffer *gbuffer;
    float *planes[3];
    double matrix[9];
    bool is_srgb; /* decoded, in place of the matrix */
} color_work;

static void color_rows(void *context, size_t begin, size_t end)
{
    const color_work *w = context;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < w->gbuffer->camera.width; x++) {
            const size_t at = y * w->gbuffer->pitch + x;
            double v[3];
            for (int c = 0; c < 3; c++)
                v[c] = (double)w->planes[c][at];
            if (w->is_srgb)
                for (int c = 0; c < 3; c++)
                    v[c] = tl_linear_from_srgb(v[c]);
            else
                apply(w->matrix, v, v);
            for (int c = 0; c < 3; c++)
                w->planes[c][at] = (float)v[c];
        }
}

static bool are_rec709(const double c[8])
{
    for (int i = 0; i < 8; i++)
        if (!(fabs(c[i] - rec709[i]) <= same))
            return false;
    return true;
}

static bool read_chromaticities(const tl_source_part *part, double out[8])
{
    const exr_attribute_t *a =
        part->exr.stream ? tl_exr_part_attribute(&part->exr, "chromaticities") : NULL;
    if (!a || a->type != EXR_ATTR_CHROMATICITIES)
        return false;
    const exr_attr_chromaticities_t *c = a->chromaticities;
    const float read[8] = {c->red_x,  c->red_y,  c->green_x, c->green_y,
                           c->blue_x, c->blue_y, c->white_x, c->white_y};
    for (int i = 0; i < 8; i++)
        out[i] = (double)read[i];
    return true;
}

tl_status tl_import_color(const tl_importing *f, tl_import_plane plane, tl_error *err)
{
    const tl_source *source = &f->plan->sources[f->plan->bindings[plane].source];
    const char *word = tl_import_kinds[plane].word;
    double c[8];
    color_work w = {.gbuffer = f->gbuffer, .is_srgb = source->needs_srgb};
    for (unsigned i = 0; i < 3; i++)
        w.planes[i] =
            tl_gbuffer_plane(f->gbuffer, (enum tl_plane)(tl_import_kinds[plane].plane + i));
    if (w.is_srgb) {
        tl_notice(f->notices, "%s: %s is decoded from sRGB", source->path, word);
    } else {
        if (!read_chromaticities(tl_import_part(f->plan, plane), c) || are_rec709(c))
            return TL_OK;
        if (!tl_color_matrix(c, w.matrix))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: its attribute \"chromaticities\" spans no colours",
                           source->path);
        tl_notice(f->notices,
                  "%s: %s is converted to Rec. 709 from the primaries of its attribute "
                  "\"chromaticities\"",
                  source->path, word);
    }
    tl_parallel(f->gbuffer->camera.height, 16, color_rows, &w);
    return TL_OK;
}
