#include "model.h"

#include "lookup.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- cameras of the file ----------------------------------------------------------------------- */

static const char *node_name(const tl_model *model, const tl_placed *camera)
{
    return model->gltf->nodes[camera->node].name;
}

/* By name first: a camera may be called "2". NULL: there is none. */
static const tl_placed *find_camera(const tl_model *model, const char *wanted)
{
    char *end;
    if (!wanted)
        return model->camera_count ? &model->cameras[0] : NULL;
    for (size_t i = 0; i < model->camera_count; i++)
        if (strcmp(node_name(model, &model->cameras[i]), wanted) == 0)
            return &model->cameras[i];
    for (size_t i = 0; i < model->camera_count; i++)
        if (strcmp(model->gltf->cameras[model->cameras[i].what].name, wanted) == 0)
            return &model->cameras[i];
    const long index = strtol(wanted, &end, 10);
    if (end == wanted || *end != '\0')
        return NULL;
    for (size_t i = 0; i < model->camera_count; i++)
        if (model->cameras[i].what == index)
            return &model->cameras[i];
    return NULL;
}

static tl_status refuse_wanted(const tl_model *model, const char *wanted, tl_error *err)
{
    char names[1024] = "none";
    size_t length = 0;
    for (size_t i = 0; i < model->camera_count && length + 100 < sizeof names; i++) {
        const tl_placed *const one = &model->cameras[i];
        const char *const own = model->gltf->cameras[one->what].name;
        length += (size_t)snprintf(
            names + length, sizeof names - length, "%s%s", i ? ", " : "",
            tl_label_of("", (size_t)one->what, own[0] ? own : node_name(model, one)).text + 1);
    }
    return tl_fail(err, TL_ERR_ARGUMENT, "%s: has no camera \"%.64s\" in its scene; it has: %s",
                   model->gltf->path, wanted, names);
}

/* The rotation and the place of a world transform, as view_from_world. A camera's scale does not
 * count (glTF 2.0, section 3.10.1); the rest is made orthonormal again, looking along -z first. */
static bool view_of(const tl_affine *world, double view[3][4])
{
    double axes[3][3], eye[3];
    for (int i = 0; i < 3; i++)
        tl_affine_column(world, i, axes[i]);
    tl_affine_column(world, 3, eye);
    if (!tl_normalize(axes[2]))
        return false;
    tl_cross(axes[1], axes[2], axes[0]);
    if (!tl_normalize(axes[0]))
        return false;
    tl_cross(axes[2], axes[0], axes[1]);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            view[i][j] = axes[i][j];
        view[i][3] = -tl_dot(axes[i], eye);
    }
    return true;
}

static tl_status camera_of_file(const tl_model *model,
                                const tl_placed *placed,
                                uint32_t width,
                                uint32_t height,
                                tl_camera *out,
                                tl_error *err)
{
    const tl_gltf_camera *const from = &model->gltf->cameras[placed->what];
    const tl_label label = tl_label_of("camera", (size_t)placed->what, from->name);
    const double half = from->orthographic ? fabs(from->ymag) : tan(0.5 * from->vertical_fov);
    const double pi = 3.14159265358979323846;
    const float far = from->far == 0.0 && !from->orthographic ? INFINITY : (float)from->far;
    tl_camera camera = {.projection = from->orthographic ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE,
                        .width = width,
                        .height = height,
                        .near = (float)from->near,
                        .far = far};
    double view[3][4];
    tl_error reason;

    if (!from->orthographic && !(from->vertical_fov > 0.0 && from->vertical_fov < pi))
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s has a yfov of %g; it must be in (0, pi)",
                       model->gltf->path, label.text, from->vertical_fov);
    if (!view_of(&placed->world, view))
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s: its node is scaled to nothing",
                       model->gltf->path, label.text);
    /* The height is the file's; the width follows the picture's shape. */
    camera.top = (float)half;
    camera.right = (float)(half * width / height);
    camera.bottom = -camera.top;
    camera.left = -camera.right;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            camera.view_from_world[i][j] = (float)view[i][j];
    if (tl_camera_check(&camera, &reason) != TL_OK)
        return tl_fail(err, TL_ERR_FORMAT, "%s: %s cannot be used: %.500s", model->gltf->path,
                       label.text, reason.message);
    *out = camera;
    return TL_OK;
}

/* --- a camera that shows all ------------------------------------------------------------------- */

static const double framed_fov = 0.78539816339744831; /* 45 degrees, as viewers have it */
static const double framed_margin = 1.05; /* of the distance: air around the scene */

/* The box around all draws; false: nothing is drawn. */
static bool find_bounds(const tl_model *model, double low[3], double high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = INFINITY;
        high[c] = -INFINITY;
    }
    for (size_t i = 0; i < model->draw_count; i++) {
        const tl_part *const part = &model->parts[model->draws[i].part];
        for (int corner = 0; corner < 8; corner++) {
            double p[3], q[3];
            for (int c = 0; c < 3; c++)
                p[c] = corner >> c & 1 ? part->high[c] : part->low[c];
            tl_affine_point(&model->draws[i].world, p, q);
            for (int c = 0; c < 3; c++) {
                low[c] = fmin(low[c], q[c]);
                high[c] = fmax(high[c], q[c]);
            }
        }
    }
    return model->draw_count > 0;
}

/* From the front of glTF's models (+z), a little to the right and above: back is towards the eye. */
static const double framed_back[3] = {0.45, 0.35, 1.0};

/* How far from the centre the eye has to stand, along unit `back`, to see all corners of the box
 * with half-extents `half`; and between which depths they then lie. */
static double framed_distance(const double right[3],
                              const double up[3],
                              const double back[3],
                              const double half[3],
                              double aspect,
                              double depths[2])
{
    const double tangent = tan(0.5 * framed_fov);
    double distance = 0.0, nearest = INFINITY, farthest = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        double p[3];
        for (int c = 0; c < 3; c++)
            p[c] = corner >> c & 1 ? half[c] : -half[c];
        const double z = tl_dot(p, back);
        distance = fmax(distance, z + fabs(tl_dot(p, up)) / tangent);
        distance = fmax(distance, z + fabs(tl_dot(p, right)) / (tangent * aspect));
        nearest = fmin(nearest, -z);
        farthest = fmax(farthest, -z);
    }
    distance *= framed_margin;
    depths[0] = distance + nearest;
    depths[1] = distance + farthest;
    return distance;
}

static tl_status framed_camera(
    const tl_model *model, uint32_t width, uint32_t height, tl_camera *out, tl_error *err)
{
    static const double world_up[3] = {0.0, 1.0, 0.0};
    double low[3], high[3], center[3] = {0}, half[3] = {0.5, 0.5, 0.5}, eye[3], depths[2];
    double back[3] = {framed_back[0], framed_back[1], framed_back[2]}, right[3], up[3];
    double largest = 0.0;

    if (find_bounds(model, low, high))
        for (int c = 0; c < 3; c++) {
            center[c] = 0.5 * low[c] + 0.5 * high[c];
            half[c] = 0.5 * high[c] - 0.5 * low[c];
        }
    for (int c = 0; c < 3; c++)
        largest = fmax(largest, half[c]);
    if (!(largest > 0.0)) /* a point: any distance shows it */
        half[0] = half[1] = half[2] = largest = 0.5;
    tl_normalize(back);
    tl_cross(world_up, back, right);
    tl_normalize(right);
    tl_cross(back, right, up);
    const double distance =
        framed_distance(right, up, back, half, (double)width / height, depths);
    for (int c = 0; c < 3; c++)
        eye[c] = center[c] + distance * back[c];
    /* Rounding the eye to float far from the origin moves everything by up to that much. */
    const double slack = 0.05 * largest + 1e-6 * (fabs(eye[0]) + fabs(eye[1]) + fabs(eye[2]));
    const double near = fmax(depths[0] - slack, 1e-3 * distance);
    tl_error reason;
    *out =
        tl_camera_look_at(eye, center, up, framed_fov, width, height, near, depths[1] + slack);
    if (tl_camera_check(out, &reason) != TL_OK)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: no camera can show its box from %g %g %g to %g %g %g: %.500s",
                       model->gltf->path, low[0], low[1], low[2], high[0], high[1], high[2],
                       reason.message);
    return TL_OK;
}

tl_status tl_model_camera(const tl_model *model,
                          const char *wanted,
                          uint32_t width,
                          uint32_t height,
                          const tl_notices *notices,
                          tl_camera *out,
                          tl_error *err)
{
    const tl_placed *const found = find_camera(model, wanted);
    if (found)
        return camera_of_file(model, found, width, height, out, err);
    if (wanted)
        return refuse_wanted(model, wanted, err);
    tl_notice(notices, "%s: its scene has no camera; one that shows all of it is used",
              model->gltf->path);
    return framed_camera(model, width, height, out, err);
}
