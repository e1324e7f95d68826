#include "camera_attributes.h"

#include "try.h"

#include <math.h>
#include <string.h>

static const char *const projection_words[] = {
    [TL_PERSPECTIVE] = "perspective",
    [TL_ORTHOGRAPHIC] = "orthographic",
};
enum { PROJECTION_COUNT = sizeof projection_words / sizeof projection_words[0] };

/* to_view, a matrix for column vectors in view space, after view_from_world, as OpenEXR's matrix
 * for row vectors. */
static exr_attr_m44f_t after_view(const double to_view[4][4], const tl_camera *camera)
{
    exr_attr_m44f_t out;
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 4; column++) {
            double sum = column == 3 ? to_view[row][3] : 0.0;
            for (int k = 0; k < 3; k++)
                sum += to_view[row][k] * (double)camera->view_from_world[k][column];
            out.m[4 * column + row] = (float)sum;
        }
    return out;
}

exr_attr_m44f_t tl_world_to_camera(const tl_camera *camera)
{
    static const double mirror[4][4] = {
        {1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}};
    return after_view(mirror, camera);
}

/* With depth = -z: x' = (x - left * w) / (right - left), y' = (top * w - y) / (top - bottom), where
 * w is the depth in perspective and 1 else. Perspective z' = (depth - near) far / (far - near), so
 * that z'/w is 0 at near and 1 at far; its limit for an infinite far is depth - near. */
exr_attr_m44f_t tl_world_to_ndc(const tl_camera *camera)
{
    const double left = (double)camera->left, top = (double)camera->top;
    const double x_scale = 1.0 / ((double)camera->right - left);
    const double y_scale = 1.0 / (top - (double)camera->bottom);
    const double near = (double)camera->near, far = (double)camera->far;
    const int is_perspective = camera->projection == TL_PERSPECTIVE;
    const double z_scale = isinf(far) ? 1.0 : (is_perspective ? far : 1.0) / (far - near);
    double ndc[4][4] = {{x_scale, 0, 0, 0}, {0, -y_scale, 0, 0}, {0, 0, -z_scale, 0}};
    const int w = is_perspective ? 2 : 3; /* the column that w comes from */
    const double sign = is_perspective ? -1.0 : 1.0;
    ndc[0][w] = -sign * left * x_scale;
    ndc[1][w] = sign * top * y_scale;
    ndc[2][3] = -near * z_scale;
    ndc[3][w] = sign;
    return after_view((const double(*)[4])ndc, camera);
}

static exr_attr_m44f_t padded_view(const tl_camera *camera)
{
    exr_attr_m44f_t out = {{0.0f}};
    memcpy(out.m, camera->view_from_world, sizeof camera->view_from_world);
    out.m[15] = 1.0f;
    return out;
}

tl_status tl_camera_attributes_write(tl_exr_stream *stream,
                                     int part,
                                     const tl_camera *camera,
                                     tl_error *err)
{
    const exr_context_t context = stream->context;
    const exr_attr_m44f_t to_camera = tl_world_to_camera(camera);
    const exr_attr_m44f_t to_ndc = tl_world_to_ndc(camera);
    const exr_attr_m44f_t view = padded_view(camera);
    exr_attr_box2f_t frustum;
    frustum.min.x = camera->left;
    frustum.min.y = camera->bottom;
    frustum.max.x = camera->right;
    frustum.max.y = camera->top;
    const exr_result_t results[] = {
        exr_attr_set_m44f(context, part, "worldToCamera", &to_camera),
        exr_attr_set_m44f(context, part, "worldToNDC", &to_ndc),
        exr_attr_set_string(context, part, "tilelight:projection",
                            projection_words[camera->projection]),
        exr_attr_set_box2f(context, part, "tilelight:frustum", &frustum),
        exr_attr_set_float(context, part, "tilelight:near", camera->near),
        exr_attr_set_float(context, part, "tilelight:far", camera->far),
        exr_attr_set_m44f(context, part, "tilelight:viewFromWorld", &view),
    };
    for (size_t i = 0; i < sizeof results / sizeof results[0]; i++)
        if (results[i] != EXR_ERR_SUCCESS)
            return tl_exr_check(stream, results[i], err);
    return TL_OK;
}

static tl_status expect(const tl_exr_stream *stream,
                        exr_result_t result,
                        const char *type,
                        const char *name,
                        tl_error *err)
{
    if (result == EXR_ERR_SUCCESS)
        return TL_OK;
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s: has no attribute \"%s\" of type %s: its camera is lost", stream->path,
                   name, type);
}

static tl_status read_projection(tl_exr_stream *stream, int part, tl_projection *out, tl_error *err)
{
    tl_status status = TL_OK;
    const char *word = NULL;
    int32_t length;
    TRY(expect(stream,
               exr_attr_get_string(stream->context, part, "tilelight:projection", &length, &word),
               "string", "tilelight:projection", err));
    for (int i = 0; i < PROJECTION_COUNT; i++)
        if (strcmp(word, projection_words[i]) == 0) {
            *out = (tl_projection)i;
            return TL_OK;
        }
    status =
        tl_fail(err, TL_ERR_UNSUPPORTED,
                "%s: tilelight:projection is \"%.64s\"; perspective and orthographic are known",
                stream->path, word);
done:
    return status;
}

tl_status tl_camera_attributes_read(tl_exr_stream *stream,
                                    int part,
                                    uint32_t width,
                                    uint32_t height,
                                    tl_camera *out,
                                    tl_error *err)
{
    tl_status status = TL_OK;
    const exr_context_t context = stream->context;
    tl_camera camera = {.width = width, .height = height};
    exr_attr_box2f_t frustum;
    exr_attr_m44f_t view;
    tl_error reason;

    TRY(read_projection(stream, part, &camera.projection, err));
    TRY(expect(stream, exr_attr_get_box2f(context, part, "tilelight:frustum", &frustum), "box2f",
               "tilelight:frustum", err));
    TRY(expect(stream, exr_attr_get_float(context, part, "tilelight:near", &camera.near), "float",
               "tilelight:near", err));
    TRY(expect(stream, exr_attr_get_float(context, part, "tilelight:far", &camera.far), "float",
               "tilelight:far", err));
    TRY(expect(stream, exr_attr_get_m44f(context, part, "tilelight:viewFromWorld", &view), "m44f",
               "tilelight:viewFromWorld", err));
    camera.left = frustum.min.x;
    camera.bottom = frustum.min.y;
    camera.right = frustum.max.x;
    camera.top = frustum.max.y;
    memcpy(camera.view_from_world, view.m, sizeof camera.view_from_world);
    if (tl_camera_check(&camera, &reason) != TL_OK)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: its tilelight: attributes are damaged: %s",
                    stream->path, reason.message));
    *out = camera;
done:
    return status;
}
