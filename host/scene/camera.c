#include "tilelight/camera.h"

#include "largest.h"

#include <math.h>

/* Rows may be off orthonormal by what rounding a rotation to float leaves, and by what other
 * programs' half-hearted matrices bring; beyond it the view would be sheared. */
static const double rotation_tolerance = 1e-3;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void row_of(const tl_camera *camera, int row, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)camera->view_from_world[row][i];
}

static tl_status check_frustum(const tl_camera *camera, tl_error *err)
{
    static const char *const names[] = {"left", "right", "bottom", "top"};
    const float edges[] = {camera->left, camera->right, camera->bottom, camera->top};
    for (int i = 0; i < 4; i++)
        if (!(fabsf(edges[i]) <= TL_FARTHEST))
            return tl_fail(err, TL_ERR_ARGUMENT,
                           "the camera's frustum has %s at %g: it must be from %g to %g",
                           names[i], (double)edges[i], -(double)TL_FARTHEST,
                           (double)TL_FARTHEST);
    if (!(camera->left < camera->right) || !(camera->bottom < camera->top))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "the camera's frustum is empty: left %g, right %g, bottom %g, top %g",
                       (double)camera->left, (double)camera->right, (double)camera->bottom,
                       (double)camera->top);
    if (!isfinite(camera->near) || isnan(camera->far) || !(camera->near < camera->far))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "the camera's near plane (%g m) is not in front of its far plane (%g m)",
                       (double)camera->near, (double)camera->far);
    if (camera->projection == TL_PERSPECTIVE && !(camera->near > 0.0f))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "the perspective camera's near plane is at %g m: it must be above 0",
                       (double)camera->near);
    return TL_OK;
}

static tl_status check_placement(const tl_camera *camera, tl_error *err)
{
    double rows[3][3];
    for (int i = 0; i < 3; i++) {
        const float shift = camera->view_from_world[i][3];
        row_of(camera, i, rows[i]);
        if (!isfinite(dot(rows[i], rows[i])))
            return tl_fail(err, TL_ERR_ARGUMENT, "row %d of the camera's matrix is not finite",
                           i);
        if (!(fabsf(shift) <= TL_FARTHEST))
            return tl_fail(
                err, TL_ERR_ARGUMENT,
                "row %d of the camera's matrix shifts by %g m: it must be from %g to %g", i,
                (double)shift, -(double)TL_FARTHEST, (double)TL_FARTHEST);
    }
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            if (fabs(dot(rows[i], rows[j]) - (i == j)) > rotation_tolerance)
                return tl_fail(err, TL_ERR_ARGUMENT,
                               "the camera's matrix is no rotation: rows %d and %d have the "
                               "product %g",
                               i, j, dot(rows[i], rows[j]));
    return TL_OK;
}

tl_status tl_camera_check(const tl_camera *camera, tl_error *err)
{
    if (camera->projection != TL_PERSPECTIVE && camera->projection != TL_ORTHOGRAPHIC)
        return tl_fail(err, TL_ERR_ARGUMENT, "the camera has no known projection");
    if (camera->width < 1 || camera->width > TL_MAX_EXTENT || camera->height < 1 ||
        camera->height > TL_MAX_EXTENT)
        return tl_fail(err, TL_ERR_ARGUMENT, "a frame of %u x %u pixels: 1 to %d per side",
                       camera->width, camera->height, TL_MAX_EXTENT);
    const tl_status status = check_frustum(camera, err);
    return status == TL_OK ? check_placement(camera, err) : status;
}

void tl_camera_view_direction(const tl_camera *camera, const double world[3], double view[3])
{
    double out[3];
    for (int i = 0; i < 3; i++) {
        double row[3];
        row_of(camera, i, row);
        out[i] = dot(row, world);
    }
    for (int i = 0; i < 3; i++)
        view[i] = out[i];
}

void tl_camera_view_point(const tl_camera *camera, const double world[3], double view[3])
{
    tl_camera_view_direction(camera, world, view);
    for (int i = 0; i < 3; i++)
        view[i] += (double)camera->view_from_world[i][3];
}

void tl_camera_world_direction(const tl_camera *camera, const double view[3], double world[3])
{
    double out[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < 3; i++) {
        double row[3];
        row_of(camera, i, row);
        for (int j = 0; j < 3; j++)
            out[j] += row[j] * view[i];
    }
    for (int i = 0; i < 3; i++)
        world[i] = out[i];
}

void tl_camera_world_point(const tl_camera *camera, const double view[3], double world[3])
{
    double from_camera[3];
    for (int i = 0; i < 3; i++)
        from_camera[i] = view[i] - (double)camera->view_from_world[i][3];
    tl_camera_world_direction(camera, from_camera, world);
}

static void normalise(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

void tl_camera_center(tl_camera *camera, double right, double top)
{
    camera->right = (float)right;
    camera->top = (float)top;
    camera->left = -camera->right;
    camera->bottom = -camera->top;
}

tl_camera tl_camera_look_at(const double eye[3],
                            const double target[3],
                            const double up[3],
                            double vertical_fov,
                            uint32_t width,
                            uint32_t height,
                            double near,
                            double far)
{
    const float tangent = (float)tan(0.5 * vertical_fov);
    const float aspect = (float)width / (float)height;
    tl_camera camera = {.projection = TL_PERSPECTIVE,
                        .width = width,
                        .height = height,
                        .left = -tangent * aspect,
                        .right = tangent * aspect,
                        .bottom = -tangent,
                        .top = tangent,
                        .near = (float)near,
                        .far = (float)far};
    double axes[3][3]; /* right, up, backwards */
    for (int i = 0; i < 3; i++)
        axes[2][i] = eye[i] - target[i];
    normalise(axes[2]);
    cross(up, axes[2], axes[0]);
    normalise(axes[0]);
    cross(axes[2], axes[0], axes[1]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            camera.view_from_world[i][j] = (float)axes[i][j];
        camera.view_from_world[i][3] = (float)-dot(axes[i], eye);
    }
    return camera;
}
