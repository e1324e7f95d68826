#include "visible_points.h"

#include "packing.h"

#include <math.h>
#include <string.h>

/* Along the rows: where the camera stands, and its right, up and back. */
typedef struct turned_camera {
    double eye[3], axes[3][3];
} turned_camera;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static turned_camera turn(const tl_camera *camera, const double rows[3][3])
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double world[3];
    turned_camera t;
    tl_camera_world_point(camera, origin, world);
    for (int i = 0; i < 3; i++)
        t.eye[i] = dot(rows[i], world);
    for (int axis = 0; axis < 3; axis++) {
        const double unit[3] = {axis == 0, axis == 1, axis == 2};
        tl_camera_world_direction(camera, unit, world);
        for (int i = 0; i < 3; i++)
            t.axes[axis][i] = dot(rows[i], world);
    }
    return t;
}

/* The surface of a pixel, along the rows. */
static void place(const tl_unpacking *of,
                  const turned_camera *camera,
                  uint32_t column,
                  uint32_t row,
                  double depth,
                  double out[3])
{
    const tl_rays rays = of->frame.rays;
    const double scale = of->from->camera.projection == TL_ORTHOGRAPHIC ? 1.0 : depth;
    const double x = ((double)rays.x0 + column * (double)rays.dx) * scale;
    const double y = ((double)rays.y0 + row * (double)rays.dy) * scale;
    for (int i = 0; i < 3; i++)
        out[i] = camera->eye[i] + x * camera->axes[0][i] + y * camera->axes[1][i] -
                 depth * camera->axes[2][i];
}

static void visit_pixel(const tl_unpacking *of,
                        const turned_camera *camera,
                        uint32_t column,
                        uint32_t row,
                        double depth,
                        tl_point_visitor visit,
                        void *context)
{
    const bool is_parallel = of->from->camera.projection == TL_ORTHOGRAPHIC;
    double at[3];
    if (!isfinite(depth) || (!is_parallel && depth <= 0.0))
        return;
    place(of, camera, column, row, depth, at);
    visit(context, at, fabs((double)of->frame.rays.dy) * (is_parallel ? 1.0 : depth));
}

/* Of one surface. */
static void visit_surface(const tl_gbuffer *gbuffer,
                          const turned_camera *camera,
                          uint32_t step,
                          tl_point_visitor visit,
                          void *context)
{
    enum { SPAN = 256 };
    const tl_unpacking unpacking = tl_unpacking_of(gbuffer);
    const uint32_t width = gbuffer->camera.width;
    for (uint32_t row = 0; row < gbuffer->camera.height; row += step)
        for (uint32_t begin = 0; begin < width; begin += SPAN) {
            const uint32_t end = width - begin < SPAN ? width : begin + SPAN;
            const uint32_t first = (begin + step - 1) / step * step;
            float depths[SPAN], *to[TL_PLANE_COUNT] = {[TL_DEPTH] = depths};
            tl_unpack_span(&unpacking, row, begin, end, to);
            for (uint32_t x = first; x < end; x += step)
                visit_pixel(&unpacking, camera, x, row, (double)depths[x - begin], visit,
                            context);
        }
}

void tl_visit_visible_points(const tl_gbuffer *gbuffer,
                             const double rows[3][3],
                             uint32_t step,
                             tl_point_visitor visit,
                             void *context)
{
    const turned_camera camera = turn(&gbuffer->camera, rows);
    visit_surface(gbuffer, &camera, step, visit, context);
    for (uint32_t i = 0; i < gbuffer->layers.count; i++)
        visit_surface(gbuffer->layers.of[i], &camera, step, visit, context);
}

static void widen(void *context, const double at[3], double width)
{
    double(*const around)[3] = context;
    (void)width;
    for (int i = 0; i < 3; i++) {
        around[0][i] = fmin(around[0][i], at[i]);
        around[1][i] = fmax(around[1][i], at[i]);
    }
}

bool tl_visible_box(const tl_gbuffer *gbuffer, const double rows[3][3], double out[2][3])
{
    double around[2][3] = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    tl_visit_visible_points(gbuffer, rows, 1, widen, around);
    if (!(around[0][0] <= around[1][0]))
        return false;
    memcpy(out, around, sizeof around);
    return true;
}
