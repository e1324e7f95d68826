#include "model.h"

#include "lookup.h"

#include <string.h>

/* --- cameras of the file ----------------------------------------------------------------------- */

static const char *node_name(const tl_model *model, const tl_placed *camera)
{
    return model->gltf->nodes[camera->node].name;
}

/* By name first: a camera may be called "2". NULL: there is none. */
static const tl_placed *find_camera(const tl_model *model, const char *wanted)
{
    size_t index;
    if (!wanted)
        return model->camera_count ? &model->cameras[0] : NULL;
    for (size_t i = 0; i < model->camera_count; i++)
        if (strcmp(node_name(model, &model->cameras[i]), wanted) == 0)
            return &model->cameras[i];
    for (size_t i = 0; i < model->camera_count; i++)
        if (strcmp(model->gltf->cameras[model->cameras[i].what].name, wanted) == 0)
            return &model->cameras[i];
    if (!tl_index_of(wanted, model->gltf->camera_count, &index))
        return NULL;
    for (size_t i = 0; i < model->camera_count; i++)
        if ((size_t)model->cameras[i].what == index)
            return &model->cameras[i];
    return NULL;
}

static tl_status refuse_wanted(const tl_model *model, const char *wanted, tl_error *err)
{
    char names[1024] = "";
    for (size_t i = 0; i < model->camera_count; i++) {
        const tl_placed *const one = &model->cameras[i];
        const char *const own = model->gltf->cameras[one->what].name;
        const char *const name = own[0] ? own : node_name(model, one);
        if (!tl_list_add(names, sizeof names, tl_label_of("", (size_t)one->what, name).text))
            break;
    }
    return tl_fail(err, TL_ERR_ARGUMENT, "%s: has no camera \"%.64s\" in its scene; it has: %s",
                   model->gltf->path, wanted, names[0] ? names : "none");
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

tl_status tl_model_camera_at(const tl_model *model,
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
    tl_camera_center(&camera, half * width / height, half);
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

/* Calls visit(context, world position) for every vertex in use, at every place where it is drawn. */
static void for_each_position(const tl_model *model,
                              void (*visit)(void *context, const double world[3]),
                              void *context)
{
    for (size_t i = 0; i < model->draw_count; i++) {
        const tl_part *const part = &model->parts[model->draws[i].part];
        const float *const positions =
            model->vertices[part->vertices].attributes[TL_GLTF_POSITION];
        for (size_t k = 0; k < part->index_count; k++) {
            const float *const p = positions + 3 * (size_t)part->indices[k];
            const double model_point[3] = {(double)p[0], (double)p[1], (double)p[2]};
            double world[3];
            tl_affine_point(&model->draws[i].world, model_point, world);
            visit(context, world);
        }
    }
}

typedef struct box {
    double low[3], high[3];
} box;

static void grow_box(void *context, const double world[3])
{
    box *const around = context;
    for (int c = 0; c < 3; c++) {
        around->low[c] = fmin(around->low[c], world[c]);
        around->high[c] = fmax(around->high[c], world[c]);
    }
}

static box box_of(const tl_model *model)
{
    const double none = HUGE_VAL;
    box around = {{none, none, none}, {-none, -none, -none}};
    for_each_position(model, grow_box, &around);
    return around;
}

bool tl_model_bounds(const tl_model *model, double low[3], double high[3])
{
    const box around = box_of(model);
    for (int c = 0; c < 3 && model->draw_count > 0; c++) {
        low[c] = around.low[c];
        high[c] = around.high[c];
    }
    return model->draw_count > 0;
}

/* From the front of glTF's models (+z), a little to the right and above: towards the eye. */
static const double framed_back[3] = {0.45, 0.35, 1.0};

/* How the picture is framed: around a centre, along unit axes, at a distance found vertex by
 * vertex. */
typedef struct framing {
    double center[3], right[3], up[3], back[3];
    double tangent, aspect;   /* of half the vertical field of view; width by height */
    double distance;          /* from the centre, so that all is in the picture */
    double nearest, farthest; /* depths, measured from the centre */
} framing;

static void frame_point(void *context, const double world[3])
{
    framing *const f = context;
    double p[3];
    for (int c = 0; c < 3; c++)
        p[c] = world[c] - f->center[c];
    const double z = tl_dot(p, f->back);
    f->distance = fmax(f->distance, z + fabs(tl_dot(p, f->up)) / f->tangent);
    f->distance = fmax(f->distance, z + fabs(tl_dot(p, f->right)) / (f->tangent * f->aspect));
    f->nearest = fmin(f->nearest, -z);
    f->farthest = fmax(f->farthest, -z);
}

/* Around the middle of the scene's box. A scene without extent gets a distance of 1. */
static framing find_framing(const tl_model *model, double aspect, box *around)
{
    static const double world_up[3] = {0.0, 1.0, 0.0};
    const double none = HUGE_VAL;
    framing f = {
        .tangent = tan(0.5 * framed_fov), .aspect = aspect, .nearest = none, .farthest = -none};
    *around = box_of(model);
    if (model->draw_count == 0)
        *around = (box){{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
    for (int c = 0; c < 3; c++) {
        f.center[c] = 0.5 * around->low[c] + 0.5 * around->high[c];
        f.back[c] = framed_back[c];
    }
    tl_normalize(f.back);
    tl_cross(world_up, f.back, f.right);
    tl_normalize(f.right);
    tl_cross(f.back, f.right, f.up);
    for_each_position(model, frame_point, &f);
    if (!(f.distance > 0.0)) {
        f.distance = 1.0;
        f.nearest = f.farthest = 0.0;
    }
    f.distance *= framed_margin;
    return f;
}

static tl_status framed_camera(
    const tl_model *model, uint32_t width, uint32_t height, tl_camera *out, tl_error *err)
{
    box around;
    const framing f = find_framing(model, (double)width / height, &around);
    double eye[3], magnitude = 0.0;
    for (int c = 0; c < 3; c++) {
        eye[c] = f.center[c] + f.distance * f.back[c];
        magnitude = fmax(magnitude, fabs(eye[c]));
    }
    /* Rounding the camera to float, far from the origin, moves it by up to about this much. */
    const double slack = 0.02 * f.distance + 4e-7 * magnitude;
    const double near = fmax(f.distance + f.nearest - slack, 1e-3 * f.distance);
    tl_error reason;
    *out = tl_camera_look_at(eye, f.center, f.up, framed_fov, width, height, near,
                             f.distance + f.farthest + slack);
    if (tl_camera_check(out, &reason) != TL_OK)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: no camera can show its box from %g %g %g to %g %g %g: %.500s",
                       model->gltf->path, around.low[0], around.low[1], around.low[2],
                       around.high[0], around.high[1], around.high[2], reason.message);
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
        return tl_model_camera_at(model, found, width, height, out, err);
    if (wanted)
        return refuse_wanted(model, wanted, err);
    tl_notice(notices, "%s: its scene has no camera; one that shows all of it is used",
              model->gltf->path);
    return framed_camera(model, width, height, out, err);
}
