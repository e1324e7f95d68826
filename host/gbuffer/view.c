#include "view.h"

#include "layout.h"

#include <string.h>

static tl_rays rays_of(const tl_camera *camera)
{
    const double dx =
        ((double)camera->right - (double)camera->left) / tl_camera_whole_width(camera);
    const double dy =
        ((double)camera->bottom - (double)camera->top) / tl_camera_whole_height(camera);
    return (tl_rays){(float)((double)camera->left + 0.5 * dx),
                     (float)dx,
                     (float)((double)camera->top + 0.5 * dy),
                     (float)dy,
                     (float)camera->window_x,
                     (float)camera->window_y,
                     {0.0f}};
}

/* kernels/depth_code.h: what is linear in the number that is stored. */
static void set_depth_line(const tl_camera *camera, tl_u32 code, tl_frame *frame)
{
    const double near = (double)camera->near, far = (double)camera->far;
    double slope = 0.0, offset = 0.0;
    if (code == TL_DEPTH_FRACTION) {
        slope = far - near;
        offset = near;
    } else if (TL_IS_NEARNESS(code) && camera->projection == TL_ORTHOGRAPHIC) {
        slope = near - far;
        offset = far;
    } else if (TL_IS_NEARNESS(code)) {
        slope = 1.0 / near - 1.0 / far;
        offset = 1.0 / far;
    }
    frame->depth_slope = (float)slope;
    frame->depth_offset = (float)offset;
}

void tl_view_set(const tl_camera *camera, enum tl_layout_name layout, tl_frame *frame)
{
    frame->rays = rays_of(camera);
    memcpy(frame->view_from_world, camera->view_from_world, sizeof frame->view_from_world);
    set_depth_line(camera, tl_layouts[layout].depth.code, frame);
}
