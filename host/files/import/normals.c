#include "meaning.h"
#include "parallel.h"

#include <math.h>
#include <string.h>

/* Depths of neighbours that differ by more lie on two surfaces. */
static const double largest_step = 0.05;

/* What a program is known to write is kept unless something else fits the depths by so much
 * better, as a mean cosine; where nothing is known, what fits best is taken, and world for as
 * good. */
static const double clear_difference = 0.3, any_difference = 0.02;

/* Shading normals of curved and bumpy surfaces are off the depths' by less than 45 degrees in
 * the mean. */
static const double poor_fit = 0.7;

/* How normals may be meant: a space, and a sign. */
typedef struct reading {
    tl_import_space space;
    double sign;
} reading;

typedef struct normal_work {
    const tl_importing *frame;
    reading as;
} normal_work;

static void raw_normal(const tl_importing *f, size_t at, double out[3])
{
    for (int i = 0; i < 3; i++) {
        const double v =
            (double)tl_gbuffer_plane(f->gbuffer, (enum tl_plane)(TL_NORMAL_X + i))[at];
        out[i] = f->plan->options->normals_are_encoded ? 2.0 * v - 1.0 : v;
    }
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

static void to_view(const tl_camera *camera, reading as, const double n[3], double out[3])
{
    if (as.space == TL_SPACE_WORLD) {
        tl_camera_view_direction(camera, n, out);
    } else {
        memcpy(out, n, 3 * sizeof *n);
        if (as.space == TL_SPACE_VIEW_FORWARD)
            out[2] = -out[2];
    }
    for (int i = 0; i < 3; i++)
        out[i] *= as.sign;
}

static void view_point(const tl_gbuffer *g, uint32_t x, uint32_t y, double out[3])
{
    const double depth = (double)tl_gbuffer_plane(g, TL_DEPTH)[(size_t)y * g->pitch + x];
    const double scale = g->camera.projection == TL_PERSPECTIVE ? depth : 1.0;
    double ray[2];
    tl_pixel_ray(&g->camera, x, y, ray);
    out[0] = ray[0] * scale;
    out[1] = ray[1] * scale;
    out[2] = -depth;
}

/* The normal of the surface through a pixel and its neighbours to the right and below, towards the
 * viewer, in view space. False where they are not one surface. */
static bool normal_of_depths(const tl_gbuffer *g, uint32_t x, uint32_t y, double out[3])
{
    double p[3][3], a[3], b[3];
    view_point(g, x, y, p[0]);
    view_point(g, x + 1, y, p[1]);
    view_point(g, x, y + 1, p[2]);
    for (int i = 1; i < 3; i++)
        if (!isfinite(p[i][2]) || !isfinite(p[0][2]) ||
            fabs(p[i][2] - p[0][2]) > largest_step * fabs(p[0][2]))
            return false;
    for (int i = 0; i < 3; i++) {
        a[i] = p[2][i] - p[0][i]; /* down */
        b[i] = p[1][i] - p[0][i]; /* right */
    }
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
    const double length = length_of(out);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
    return length > 0.0;
}

/* The mean cosine between normals, read so, and the surface that depths make; *count: of how many. */
static double fit_of(const tl_importing *f, reading as, int *count)
{
    const tl_gbuffer *g = f->gbuffer;
    const tl_camera *c = &g->camera;
    double sum = 0.0;
    *count = 0;
    /* Each with a neighbour to the right and one below. */
    const tl_sample_grid grid = tl_sample_grid_of(c->width - 1, c->height - 1);
    for (uint32_t i = 0; i < grid.columns * grid.rows; i++) {
        double raw[3], n[3], surface[3];
        uint32_t x, y;
        tl_sample_at(&grid, i, &x, &y);
        if (!normal_of_depths(g, x, y, surface))
            continue;
        raw_normal(f, (size_t)y * g->pitch + x, raw);
        const double length = length_of(raw);
        if (!(length > 0.0) || !isfinite(length))
            continue;
        to_view(c, as, raw, n);
        sum += (n[0] * surface[0] + n[1] * surface[1] + n[2] * surface[2]) / length;
        (*count)++;
    }
    return *count > 0 ? sum / *count : 0.0;
}

/* What is said, or known of the program that wrote the channel; else world. */
static tl_import_space assumed_space(const tl_importing *f)
{
    const tl_alias *alias = f->plan->bindings[TL_IMPORT_NORMAL].alias;
    const tl_import_space given = f->plan->options->normal_space;
    if (given != TL_SPACE_AUTO)
        return given;
    return alias && alias->space != TL_SPACE_AUTO ? alias->space : TL_SPACE_WORLD;
}

static void say_reading(
    const tl_importing *f, reading assumed, reading taken, double worse, double fit)
{
    if (taken.space != assumed.space)
        tl_notice(f->notices,
                  "normals are taken as of the space \"%s\": as \"%s\" they do not fit the "
                  "depths (mean cosine %.2f against %.2f); --normal-space decides",
                  tl_import_space_words[taken.space], tl_import_space_words[assumed.space], fit,
                  worse);
    else if (f->plan->options->normal_space == TL_SPACE_AUTO)
        tl_notice(f->notices, "normals are taken as of the space \"%s\"",
                  tl_import_space_words[taken.space]);
    if (taken.sign < 0.0)
        tl_notice(f->notices, "normals point away from the viewer: all are turned round");
    if (fit < poor_fit)
        tl_notice(f->notices,
                  "normals do not fit the depths (mean cosine %.2f): one of --fov, "
                  "--depth-kind, --unit or --normal-space may be wrong",
                  fit);
}

/* Normals and depths are of one surface, which tells space and sign. */
static reading find_reading(const tl_importing *f)
{
    enum { FEW = 16 };
    const reading assumed = {assumed_space(f), 1.0};
    const tl_alias *alias = f->plan->bindings[TL_IMPORT_NORMAL].alias;
    const bool may_change_space = f->plan->options->normal_space == TL_SPACE_AUTO;
    const bool is_known = !may_change_space || (alias && alias->space != TL_SPACE_AUTO);
    const double difference = is_known ? clear_difference : any_difference;
    reading best = assumed;
    int count = 0;
    const double first = fit_of(f, assumed, &count);
    double most = first;
    if (count < FEW)
        return assumed;
    for (int s = TL_SPACE_WORLD; s < TL_SPACE_COUNT; s++)
        for (double sign = 1.0; sign >= -1.0; sign -= 2.0) {
            const reading as = {(tl_import_space)s, sign};
            const double fit = fit_of(f, as, &count);
            if ((as.space == assumed.space || may_change_space) &&
                fit > fmax(most, first + difference)) {
                most = fit;
                best = as;
            }
        }
    say_reading(f, assumed, best, first, most);
    return best;
}

static void normal_rows(void *context, size_t begin, size_t end)
{
    /* A float's rounding of a unit vector: what is as long as that is left bit for bit. */
    static const double rounding = 1e-6;
    const normal_work *w = context;
    const tl_gbuffer *g = w->frame->gbuffer;
    for (size_t y = begin; y < end; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const size_t at = y * g->pitch + x;
            double raw[3], n[3], out[3];
            raw_normal(w->frame, at, raw);
            to_view(&g->camera, w->as, raw, n);
            if (w->as.space == TL_SPACE_WORLD)
                for (int i = 0; i < 3; i++)
                    out[i] = w->as.sign * raw[i];
            else
                tl_camera_world_direction(&g->camera, n, out);
            const double length = length_of(out);
            const double scale =
                length > 0.0 && isfinite(length) && fabs(length - 1.0) > rounding ? 1.0 / length
                                                                                  : 1.0;
            for (int i = 0; i < 3; i++)
                tl_gbuffer_plane(g, (enum tl_plane)(TL_NORMAL_X + i))[at] =
                    (float)(out[i] * scale);
        }
}

void tl_import_normals(tl_importing *f)
{
    normal_work w = {.frame = f, .as = find_reading(f)};
    tl_parallel(f->gbuffer->camera.height, 16, normal_rows, &w);
}
