/* Where the camera of a capture stands, and which rays it sees: from options, from attributes
 * that say it for sure, or not at all. */
#include "camera_attributes.h"
#include "plan.h"
#include "try.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double degree = 0.017453292519943295; /* pi / 180 */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The matrix of an attribute; NULL where it is of another type. */
static const float *matrix_of(const tl_exr_part *part, const char *name)
{
    const exr_attribute_t *a = tl_exr_part_attribute(part, name);
    return a && a->type == EXR_ATTR_M44F ? a->m44f->m : NULL;
}

static bool float_of(const tl_exr_part *part, const char *name, double *out)
{
    const exr_attribute_t *a = tl_exr_part_attribute(part, name);
    if (!a || a->type != EXR_ATTR_FLOAT)
        return false;
    *out = (double)a->f;
    return true;
}

static void place_at_origin(tl_camera *camera)
{
    memset(camera->view_from_world, 0, sizeof camera->view_from_world);
    for (int i = 0; i < 3; i++)
        camera->view_from_world[i][i] = 1.0f;
}

/* Axes are unit vectors in the world: right, up, back. */
static void place(tl_camera *camera, const double axes[3][3], const double eye[3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            camera->view_from_world[i][j] = (float)axes[i][j];
        camera->view_from_world[i][3] = (float)-dot(axes[i], eye);
    }
}

/* A centred perspective. Pixels may be wider than high. */
static void set_lens(tl_import_plan *plan, double vertical, double horizontal)
{
    tl_camera *camera = &plan->camera.camera;
    const double aspect = plan->pixel_aspect * plan->width / plan->height;
    const double up =
        vertical > 0.0 ? tan(0.5 * vertical * degree) : tan(0.5 * horizontal * degree) / aspect;
    camera->projection = TL_PERSPECTIVE;
    tl_camera_center(camera, up * aspect, up);
}

/* A plane function of OpenEXR's matrix for row vectors: value(p) = direction . p + offset. */
typedef struct plane_function {
    double direction[3], offset;
} plane_function;

static plane_function column(const float *m, int index)
{
    return (plane_function){
        .direction = {(double)m[index], (double)m[4 + index], (double)m[8 + index]},
        .offset = (double)m[12 + index]};
}

/* The point where three plane functions are 0, by Cramer's rule. */
static bool common_point(const plane_function planes[3], double out[3])
{
    double crosses[3][3];
    for (int i = 0; i < 3; i++)
        cross(planes[(i + 1) % 3].direction, planes[(i + 2) % 3].direction, crosses[i]);
    const double determinant = dot(planes[0].direction, crosses[0]);
    if (!isfinite(determinant) || !(fabs(determinant) > 0.0))
        return false;
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = 0.0;
        for (int i = 0; i < 3; i++)
            out[axis] -= planes[i].offset * crosses[i][axis] / determinant;
    }
    return true;
}

/* One axis of the image: ndc = middle + slope * (x/depth), growing along `along`. */
typedef struct image_axis {
    double along[3], slope, middle;
} image_axis;

static image_axis image_axis_of(const plane_function *f, const double forward[3], double scale)
{
    image_axis out;
    double length = 0.0;
    out.middle = dot(f->direction, forward) / scale;
    for (int i = 0; i < 3; i++) {
        out.along[i] = f->direction[i] - out.middle * scale * forward[i];
        length += out.along[i] * out.along[i];
    }
    length = sqrt(length);
    for (int i = 0; i < 3; i++)
        out.along[i] /= length;
    out.slope = length / scale;
    return out;
}

static void flip(double v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = -v[i];
}

/* OpenEXR defines NDC from 0 to 1, y downwards. Some programs write -1 to 1, y upwards, under the same
 * name: then a ray straight ahead is at 0. Which way is up, worldToCamera says where it is there: its y
 * is up in every convention. *out is left where the matrix is of no perspective camera. */
static bool read_ndc(tl_import_plan *plan, const tl_exr_part *part, const float *m)
{
    static const double near_middle = 0.25;
    tl_found_camera *out = &plan->camera;
    const float *to_camera = matrix_of(part, "worldToCamera");
    const plane_function planes[3] = {column(m, 0), column(m, 1), column(m, 3)};
    const double scale = sqrt(dot(planes[2].direction, planes[2].direction));
    double forward[3], eye[3], axes[3][3], back[3];
    if (!isfinite(scale) || !(scale > 0.0) || !common_point(planes, eye))
        return false;
    for (int i = 0; i < 3; i++)
        forward[i] = planes[2].direction[i] / scale;
    const image_axis x = image_axis_of(&planes[0], forward, scale);
    image_axis y = image_axis_of(&planes[1], forward, scale);
    const bool is_signed = fabs(x.middle) < near_middle && fabs(y.middle) < near_middle;
    const double low = is_signed ? -1.0 : 0.0, high = 1.0;

    for (int i = 0; i < 3; i++) {
        axes[0][i] = x.along[i];
        axes[1][i] = y.along[i];
        axes[2][i] = back[i] = -forward[i];
    }
    double handed[3];
    cross(axes[0], axes[1], handed);
    bool is_upwards = dot(handed, back) > 0.0; /* of a right-handed world */
    if (to_camera)
        is_upwards = dot(axes[1], column(to_camera, 1).direction) > 0.0;
    if (!is_upwards)
        flip(axes[1]);
    cross(axes[0], axes[1], handed);
    if (dot(handed, back) <= 0.0) {
        snprintf(out->missing, sizeof out->missing,
                 "its attributes worldToNDC and worldToCamera are of a left-handed world, "
                 "which is not read; --camera-file or --fov with --eye and --target give "
                 "another camera");
        return true;
    }
    out->camera.projection = TL_PERSPECTIVE;
    out->camera.left = (float)((low - x.middle) / x.slope);
    out->camera.right = (float)((high - x.middle) / x.slope);
    const double first = (low - y.middle) / y.slope, last = (high - y.middle) / y.slope;
    out->camera.bottom = (float)(is_upwards ? first : -last);
    out->camera.top = (float)(is_upwards ? last : -first);
    for (int i = 0; i < 3; i++)
        eye[i] *= plan->options->unit;
    place(&out->camera, (const double(*)[3])axes, eye);
    out->is_placed = true;
    snprintf(out->lens, sizeof out->lens, "attribute worldToNDC%s",
             is_signed ? ", as -1 to 1" : "");
    snprintf(out->place, sizeof out->place, "attribute worldToNDC");
    return true;
}

/* Left-handed by definition; a right-handed one, which others write, looks along -z. */
static bool read_placement(tl_import_plan *plan, const tl_exr_part *part)
{
    tl_found_camera *out = &plan->camera;
    const float *m = matrix_of(part, "worldToCamera");
    double handed[3];
    if (!m)
        return false;
    plane_function rows[3] = {column(m, 0), column(m, 1), column(m, 2)};
    cross(rows[0].direction, rows[1].direction, handed);
    const bool is_standard = dot(handed, rows[2].direction) < 0.0;
    for (int i = 0; i < 3; i++) {
        const double sign = i == 2 && is_standard ? -1.0 : 1.0;
        for (int j = 0; j < 3; j++)
            out->camera.view_from_world[i][j] = (float)(sign * rows[i].direction[j]);
        out->camera.view_from_world[i][3] =
            (float)(sign * rows[i].offset * plan->options->unit);
    }
    out->is_placed = true;
    snprintf(out->place, sizeof out->place, "attribute worldToCamera%s",
             is_standard ? "" : ", right-handed, looking along -z");
    return true;
}

/* V-Ray: the horizontal angle in degrees; projection 0 is perspective. */
static bool read_vray_lens(tl_import_plan *plan, const tl_exr_part *part)
{
    double horizontal = 0.0;
    const exr_attribute_t *projection = tl_exr_part_attribute(part, "cameraProjection");
    if (!float_of(part, "cameraFov", &horizontal) || !(horizontal > 0.0) ||
        !(horizontal < 180.0) || !projection || projection->type != EXR_ATTR_INT ||
        projection->i != 0)
        return false;
    set_lens(plan, 0.0, horizontal);
    snprintf(plan->camera.lens, sizeof plan->camera.lens,
             "attribute cameraFov, %.4g degrees across", horizontal);
    return true;
}

/* Our own attributes, of a file whose channels are mapped otherwise. */
static tl_status read_own(tl_import_plan *plan,
                          const tl_exr_part *part,
                          bool *found,
                          tl_error *err)
{
    tl_status status = TL_OK;
    *found = part->index == 0 && tl_exr_part_attribute(part, "tilelight:frustum") != NULL;
    if (!*found)
        return TL_OK;
    TRY(tl_camera_attributes_read(part->stream, part->index, plan->width, plan->height,
                                  &plan->camera.camera, err));
    plan->camera.is_exact = plan->camera.is_placed = true;
    snprintf(plan->camera.lens, sizeof plan->camera.lens, "attributes tilelight:");
    snprintf(plan->camera.place, sizeof plan->camera.place, "attributes tilelight:");
done:
    return status;
}

/* The first part that has any of them. */
static tl_status read_attributes(tl_import_plan *plan,
                                 bool *has_lens,
                                 bool *has_place,
                                 tl_error *err)
{
    tl_status status = TL_OK;
    const tl_source *source = &plan->sources[0];
    *has_lens = *has_place = false;
    if (!plan->has_capture || source->format != &tl_source_exr)
        return TL_OK;
    for (uint32_t i = 0; i < source->part_count && !*has_lens; i++) {
        const tl_exr_part *part = &source->parts[i].exr;
        const float *to_ndc = matrix_of(part, "worldToNDC");
        TRY(read_own(plan, part, has_lens, err));
        if (!*has_lens && to_ndc)
            *has_lens = read_ndc(plan, part, to_ndc);
        *has_place = *has_lens;
        if (plan->camera.missing[0])
            return TL_OK;
        if (!*has_lens) {
            *has_place = *has_place || read_placement(plan, part);
            *has_lens = read_vray_lens(plan, part);
        }
    }
done:
    return status;
}

/* Eye, target and up; checked, since they come from a command line. */
static tl_status place_by_options(tl_import_plan *plan, tl_error *err)
{
    const tl_import_camera *given = &plan->options->camera;
    tl_found_camera *out = &plan->camera;
    double back[3], right[3];
    for (int i = 0; i < 3; i++)
        back[i] = given->eye[i] - given->target[i];
    cross(given->up, back, right);
    if (!(dot(right, right) > 1e-24 * dot(back, back) * dot(given->up, given->up)))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "--eye, --target and --up span no plane: the camera cannot be turned");
    const tl_camera placed = tl_camera_look_at(given->eye, given->target, given->up, 1.0,
                                               plan->width, plan->height, 1.0, 2.0);
    memcpy(out->camera.view_from_world, placed.view_from_world, sizeof placed.view_from_world);
    out->is_placed = true;
    snprintf(out->place, sizeof out->place, "--eye and --target");
    return TL_OK;
}

static void say_camera(const tl_import_plan *plan, const tl_notices *notices)
{
    const tl_found_camera *c = &plan->camera;
    if (c->is_placed)
        tl_notice(notices, "camera: lens by %s; place by %s", c->lens, c->place);
    else
        tl_notice(notices,
                  "camera: lens by %s; nothing says where it stands, so the world is what it "
                  "sees: it is at the origin, looking along -z, and lights are relative to it",
                  c->lens);
}

tl_status tl_import_find_camera(tl_import_plan *plan, const tl_notices *notices, tl_error *err)
{
    tl_status status = TL_OK;
    tl_found_camera *out = &plan->camera;
    const tl_import_camera *given = &plan->options->camera;
    bool has_lens = false, has_place = false;
    out->camera = (tl_camera){.width = plan->width, .height = plan->height};
    place_at_origin(&out->camera);
    if (given->file) {
        TRY(tl_camera_file_read(given->file, plan->width, plan->height, plan->pixel_aspect,
                                &out->camera, err));
        snprintf(out->lens, sizeof out->lens, "%.100s", given->file);
        snprintf(out->place, sizeof out->place, "%.100s", given->file);
        out->is_placed = true;
        goto done;
    }
    TRY(read_attributes(plan, &has_lens, &has_place, err));
    if (given->vertical_fov > 0.0 || given->horizontal_fov > 0.0) {
        set_lens(plan, given->vertical_fov, given->horizontal_fov);
        snprintf(out->lens, sizeof out->lens, given->vertical_fov > 0.0 ? "--fov" : "--hfov");
        out->is_exact = false;
        out->missing[0] = '\0';
        has_lens = true;
    }
    if (given->is_placed)
        TRY(place_by_options(plan, err));
    if (!has_lens)
        snprintf(out->missing, sizeof out->missing,
                 "nothing says what its camera sees; give --fov DEGREES (and --eye X,Y,Z "
                 "--target X,Y,Z where it stands), or --camera-file");
done:
    if (status == TL_OK && given->near > 0.0)
        out->camera.near = (float)given->near;
    if (status == TL_OK && given->far > 0.0)
        out->camera.far = (float)given->far;
    if (status == TL_OK && !out->missing[0])
        say_camera(plan, notices);
    return status;
}
