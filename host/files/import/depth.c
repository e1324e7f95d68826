#include "meaning.h"
#include "parallel.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* What every pixel of a frame shares. */
typedef struct depth_work {
    const tl_importing *frame;
    tl_depth_kind kind;
    double unit, sky_from, near, far;
    bool is_perspective;
    tl_import_space space; /* of positions */
} depth_work;

void tl_pixel_ray(const tl_camera *camera, uint32_t x, uint32_t y, double out[2])
{
    const double left = (double)camera->left, top = (double)camera->top;
    out[0] = left + (x + 0.5) * ((double)camera->right - left) / camera->width;
    out[1] = top - (y + 0.5) * (top - (double)camera->bottom) / camera->height;
}

/* z is 0 at near and 1 at far; nearness = 1 - z, exact where the buffer is reversed. Perspective:
 * z = far (d - near) / (d (far - near)), so 1 - z = near (far - d) / (d (far - near)). */
static double depth_of_buffer(const depth_work *w, double nearness)
{
    const double near = w->near, far = w->far;
    if (!(nearness > 0.0))
        return INFINITY;
    if (!w->is_perspective)
        return far - nearness * (far - near);
    return isinf(far) ? near / nearness : near * far / (near + nearness * (far - near));
}

/* m along the view axis; INFINITY for sky; NaN stays. */
static double planar_depth(const depth_work *w, double v, uint32_t x, uint32_t y)
{
    double ray[2];
    switch (w->kind) {
    case TL_DEPTH_KIND_NDC: return depth_of_buffer(w, 1.0 - v);
    case TL_DEPTH_KIND_NDC_REVERSED: return depth_of_buffer(w, v);
    case TL_DEPTH_KIND_NDC_GL: return depth_of_buffer(w, 0.5 - 0.5 * v);
    case TL_DEPTH_KIND_INVERSE: return v > 0.0 ? w->unit / v : HUGE_VAL;
    case TL_DEPTH_KIND_VIEW_Z: v = -v; break;
    default: break;
    }
    if (v >= w->sky_from || isinf(v))
        return INFINITY;
    if (w->kind != TL_DEPTH_KIND_RAY || !w->is_perspective)
        return v * w->unit;
    tl_pixel_ray(&w->frame->gbuffer->camera, x, y, ray);
    return v * w->unit / sqrt(1.0 + ray[0] * ray[0] + ray[1] * ray[1]);
}

/* The point of a pixel in view space, from positions; false for sky. */
static bool view_position(const depth_work *w, tl_import_space space, size_t at, double view[3])
{
    double p[3], most = 0.0;
    for (int i = 0; i < 3; i++) {
        p[i] = (double)w->frame->position[i][at];
        if (!isfinite(p[i]))
            return false;
        most = fmax(most, fabs(p[i]));
        p[i] *= w->unit;
    }
    if (most >= w->sky_from || !(most > 0.0))
        return false;
    if (space == TL_SPACE_WORLD) {
        tl_camera_view_point(&w->frame->gbuffer->camera, p, view);
    } else {
        memcpy(view, p, sizeof p);
        view[2] = space == TL_SPACE_VIEW_FORWARD ? -p[2] : p[2];
    }
    return true;
}

static bool is_left_out(const depth_work *w, size_t at)
{
    const float *alpha = w->frame->alpha;
    if (!alpha)
        return false;
    return alpha[at] <= 0.0f ||
           (w->frame->plan->options->edges == TL_EDGES_DROP && alpha[at] < 1.0f);
}

static void depth_rows(void *context, size_t begin, size_t end)
{
    const depth_work *w = context;
    const tl_gbuffer *g = w->frame->gbuffer;
    float *plane = tl_gbuffer_plane(g, TL_DEPTH);
    for (uint32_t y = (uint32_t)begin; y < end; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            double view[3], depth;
            if (w->frame->position[0])
                depth = view_position(w, w->space, at, view) ? -view[2] : HUGE_VAL;
            else
                depth = planar_depth(w, (double)plane[at], x, y);
            if (is_left_out(w, at) || (w->is_perspective && depth <= 0.0) ||
                depth > (double)FLT_MAX)
                depth = INFINITY;
            plane[at] = (float)depth;
        }
}

/* How many pixels positions of a space lie off the pixels that they belong to, in the mean; and
 * INFINITY where there are none. */
static double offset_of_positions(const depth_work *w, tl_import_space space)
{
    const tl_camera *c = &w->frame->gbuffer->camera;
    const double most = 0.5 * (c->width + c->height); /* further off is as wrong */
    double sum = 0.0;
    int count = 0;
    const tl_sample_grid grid = tl_sample_grid_of(c->width, c->height);
    for (uint32_t i = 0; i < grid.columns * grid.rows; i++) {
        uint32_t x, y;
        tl_sample_at(&grid, i, &x, &y);
        const size_t at = (size_t)y * w->frame->gbuffer->pitch + x;
        double view[3], ray[2];
        if (is_left_out(w, at) || !view_position(w, space, at, view))
            continue;
        const double scale = w->is_perspective ? -view[2] : 1.0;
        tl_pixel_ray(c, x, y, ray);
        const double dx = (view[0] / scale - ray[0]) * c->width / (double)(c->right - c->left);
        const double dy = (view[1] / scale - ray[1]) * c->height / (double)(c->top - c->bottom);
        const double off = sqrt(dx * dx + dy * dy);
        sum += scale > 0.0 && off < most ? off : most;
        count++;
    }
    return count > 0 ? sum / count : HUGE_VAL;
}

/* Positions prove their space: they lie on the rays of their pixels. */
static tl_import_space find_position_space(const depth_work *w)
{
    static const double few = 2.0; /* px; filters and halves move positions by less */
    tl_import_space best = w->frame->plan->options->position_space;
    double least = best == TL_SPACE_AUTO ? HUGE_VAL : offset_of_positions(w, best);
    for (int s = TL_SPACE_WORLD;
         s < TL_SPACE_COUNT && w->frame->plan->options->position_space == TL_SPACE_AUTO; s++) {
        const double offset = offset_of_positions(w, (tl_import_space)s);
        if (offset < least || best == TL_SPACE_AUTO) {
            least = offset;
            best = (tl_import_space)s;
        }
    }
    tl_notice(w->frame->notices, "depth is taken from positions, which are of the space \"%s\"",
              tl_import_space_words[best]);
    if (isfinite(least) && least > few)
        tl_notice(w->frame->notices,
                  "positions lie %.3g pixels off their own pixels: the camera is not the one "
                  "that saw them",
                  least);
    return best;
}

static void count(tl_importing *f)
{
    const tl_gbuffer *g = f->gbuffer;
    const float *depth = tl_gbuffer_plane(g, TL_DEPTH);
    for (uint32_t y = 0; y < g->camera.height; y++)
        for (uint32_t x = 0; x < g->camera.width; x++) {
            const size_t at = (size_t)y * g->pitch + x;
            f->counts.sky += isinf(depth[at]) != 0;
            f->counts.partial += f->alpha && f->alpha[at] > 0.0f && f->alpha[at] < 1.0f;
        }
}

static bool is_of_buffer(tl_depth_kind kind)
{
    return kind == TL_DEPTH_KIND_NDC || kind == TL_DEPTH_KIND_NDC_REVERSED ||
           kind == TL_DEPTH_KIND_NDC_GL;
}

tl_status tl_import_depth(tl_importing *f, tl_error *err)
{
    const tl_import_plan *plan = f->plan;
    const tl_import_options *options = plan->options;
    const tl_camera *found = &plan->camera.camera;
    depth_work w = {.frame = f,
                    .kind = options->depth_kind,
                    .unit = options->unit,
                    .sky_from = options->sky_from,
                    .near = (double)found->near,
                    .far = (double)found->far,
                    .is_perspective = found->projection == TL_PERSPECTIVE};
    if (f->position[0]) {
        w.space = find_position_space(&w);
    } else if (is_of_buffer(w.kind) && !(w.near > 0.0 && w.far > w.near)) {
        return tl_fail(
            err, TL_ERR_ARGUMENT,
            "--depth-kind %s needs --near and --far, which the depth buffer was made "
            "with (--far inf where it has none)",
            tl_depth_kind_words[w.kind]);
    } else if (w.kind == TL_DEPTH_KIND_PLANAR) {
        tl_notice(f->notices,
                  "depths are taken as %g m each along the view axis (--depth-kind planar, "
                  "--unit %g)",
                  w.unit, w.unit);
    }
    tl_parallel(f->gbuffer->camera.height, 16, depth_rows, &w);
    count(f);
    return TL_OK;
}

void tl_import_range(tl_importing *f)
{
    tl_gbuffer *g = f->gbuffer;
    tl_camera *camera = &g->camera;
    const tl_camera *found = &f->plan->camera.camera;
    const float *depth = tl_gbuffer_plane(g, TL_DEPTH);
    float least = INFINITY, most = -INFINITY;
    if (f->plan->camera.is_exact) {
        camera->near = found->near;
        camera->far = found->far;
        return;
    }
    for (uint32_t y = 0; y < camera->height; y++)
        for (uint32_t x = 0; x < camera->width; x++) {
            const float d = depth[(size_t)y * g->pitch + x];
            if (!isfinite(d))
                continue;
            least = fminf(least, d);
            most = fmaxf(most, d);
        }
    if (!(least <= most))
        least = most = 1.0f;
    const float margin = 0.5f * (fabsf(least) + fabsf(most));
    const bool is_perspective = camera->projection == TL_PERSPECTIVE;
    camera->near = found->near > 0.0f ? fminf(found->near, least)
                   : is_perspective   ? 0.5f * least
                                      : least - margin;
    camera->far = found->far > 0.0f ? fmaxf(found->far, most)
                  : is_perspective  ? 2.0f * most
                                    : most + margin;
    if (!(camera->near < camera->far)) /* one depth alone, or an ortho camera's 0 */
        camera->far = camera->near + 1.0f;
}
