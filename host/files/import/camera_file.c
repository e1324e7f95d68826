/* Camera files: JSON, versioned as lights files are. */
#include "json_values.h"
#include "plan.h"
#include "suggest.h"
#include "try.h"

#include <math.h>
#include <string.h>

enum { KNOWN_VERSION = 1 };
static const double degree = 0.017453292519943295; /* pi / 180 */

/* X(member, field, kind, meaning); `matrix` is three or four rows of four. */
#define CAMERA_FIELDS(X)                                 \
    X(position, "position", VECTOR)                      \
    X(target, "target", VECTOR)                          \
    X(up, "up", VECTOR)                                  \
    X(world_from_view, "worldFromView", MATRIX)          \
    X(vertical_fov, "verticalFov", NUMBER)               \
    X(horizontal_fov, "horizontalFov", NUMBER)           \
    X(focal_length, "focalLength", NUMBER)               \
    X(sensor_width, "sensorWidth", NUMBER)               \
    X(sensor_height, "sensorHeight", NUMBER)             \
    X(orthographic_height, "orthographicHeight", NUMBER) \
    X(near, "near", NUMBER)                              \
    X(far, "far", NUMBER)

typedef enum field_kind { NUMBER, VECTOR, MATRIX } field_kind;

enum { NUMBER_SIZE = 1, VECTOR_SIZE = 3, MATRIX_SIZE = 12 };

typedef struct camera_fields {
#define FIELD_MEMBER(member, field, kind) double member[kind##_SIZE];
    CAMERA_FIELDS(FIELD_MEMBER)
#undef FIELD_MEMBER
    unsigned given; /* bit i: field i of the table */
} camera_fields;

typedef enum field_index {
#define FIELD_INDEX(member, field, kind) AT_##member,
    CAMERA_FIELDS(FIELD_INDEX)
#undef FIELD_INDEX
        FIELD_COUNT
} field_index;

static const struct {
    const char *name;
    field_kind kind;
    size_t offset;
} fields[FIELD_COUNT] = {
#define FIELD_ROW(member, field, kind) {field, kind, offsetof(camera_fields, member)},
    CAMERA_FIELDS(FIELD_ROW)
#undef FIELD_ROW
};

static bool has(const camera_fields *f, field_index index)
{
    return f->given >> index & 1;
}

static tl_status read_numbers(const char *path,
                              const char *field,
                              const json_t *array,
                              size_t count,
                              double *out,
                              tl_error *err)
{
    if (!json_is_array(array) || json_array_size(array) != count)
        return tl_fail(err, TL_ERR_FORMAT, "%s: \"%s\" must be an array of %zu numbers", path,
                       field, count);
    for (size_t i = 0; i < count; i++) {
        const json_t *value = json_array_get(array, i);
        out[i] = json_number_value(value);
        if (!json_is_number(value) || !(fabs(out[i]) <= 1e30))
            return tl_fail(err, TL_ERR_FORMAT,
                           "%s: \"%s\" must be an array of %zu numbers within 1e30", path,
                           field, count);
    }
    return TL_OK;
}

/* Rows of four; a fourth row is 0 0 0 1. */
static tl_status read_matrix(
    const char *path, const char *field, const json_t *array, double out[12], tl_error *err)
{
    tl_status status = TL_OK;
    double last[4] = {0.0, 0.0, 0.0, 1.0};
    const size_t rows = json_array_size(array);
    if (rows != 3 && rows != 4)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: \"%s\" must be 3 or 4 rows of 4 numbers", path,
                    field));
    for (size_t i = 0; i < rows; i++)
        TRY(read_numbers(path, field, json_array_get(array, i), 4, i < 3 ? out + 4 * i : last,
                         err));
    if (fabs(last[0]) + fabs(last[1]) + fabs(last[2]) + fabs(last[3] - 1.0) > 0.0)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: the last row of \"%s\" is not 0 0 0 1: rows are the lines of the "
                    "matrix for column vectors",
                    path, field));
done:
    return status;
}

static tl_status read_field(
    const char *path, size_t index, const json_t *value, camera_fields *out, tl_error *err)
{
    double *to = (double *)(void *)((char *)out + fields[index].offset);
    const char *name = fields[index].name;
    out->given |= 1u << index;
    if (fields[index].kind == MATRIX)
        return read_matrix(path, name, value, to, err);
    if (fields[index].kind == VECTOR)
        return read_numbers(path, name, value, 3, to, err);
    *to = json_number_value(value);
    if (!json_is_number(value) || !(*to > 0.0) || !(*to <= 1e30))
        return tl_fail(err, TL_ERR_FORMAT, "%s: \"%s\" must be a number above 0, up to 1e30",
                       path, name);
    return TL_OK;
}

static tl_status read_top(const char *path, json_t *root, camera_fields *out, tl_error *err)
{
    tl_status status = TL_OK;
    const char *words[FIELD_COUNT], *key;
    json_t *value;
    const json_t *version = json_object_get(root, "tilelight");
    for (size_t i = 0; i < FIELD_COUNT; i++)
        words[i] = fields[i].name;
    if (!json_is_integer(version))
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s: is no camera file: it must be an object with \"tilelight\": 1", path));
    if (json_integer_value(version) != KNOWN_VERSION)
        TRY(tl_fail(err, TL_ERR_UNSUPPORTED,
                    "%s: is a camera file of version %lld; this program reads version %d", path,
                    (long long)json_integer_value(version), KNOWN_VERSION));
    json_object_foreach(root, key, value)
    {
        size_t i = 0;
        while (i < FIELD_COUNT && strcmp(key, fields[i].name) != 0)
            i++;
        if (i < FIELD_COUNT) {
            TRY(read_field(path, i, value, out, err));
        } else if (strcmp(key, "tilelight") != 0) {
            const char *meant = tl_suggest(key, words, FIELD_COUNT);
            TRY(tl_fail(err, TL_ERR_FORMAT, "%s: unknown field \"%.64s\"%s%s%s", path, key,
                        meant ? "; did you mean \"" : "", meant ? meant : "",
                        meant ? "\"?" : ""));
        }
    }
done:
    return status;
}

/* Half the height of the image at distance 1, or in m; from whichever of them is given. */
static tl_status find_lens(
    const char *path, const camera_fields *f, double aspect, tl_camera *camera, tl_error *err)
{
    const bool by_sensor = has(f, AT_focal_length);
    const int ways = has(f, AT_vertical_fov) + has(f, AT_horizontal_fov) + by_sensor +
                     has(f, AT_orthographic_height);
    double half;
    if (ways != 1)
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: %s of \"verticalFov\", \"horizontalFov\", \"focalLength\" and "
                       "\"orthographicHeight\" must say what the camera sees",
                       path, ways == 0 ? "one" : "only one");
    if (by_sensor != (has(f, AT_sensor_width) + has(f, AT_sensor_height) == 1) ||
        (!by_sensor && has(f, AT_sensor_width)))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: \"focalLength\" goes with \"sensorWidth\" or \"sensorHeight\", in "
                       "the same unit, and each of them with it",
                       path);
    if (f->vertical_fov[0] >= 180.0 || f->horizontal_fov[0] >= 180.0)
        return tl_fail(err, TL_ERR_FORMAT, "%s: a field of view must be below 180 degrees",
                       path);
    if (has(f, AT_vertical_fov))
        half = tan(0.5 * degree * f->vertical_fov[0]);
    else if (has(f, AT_horizontal_fov))
        half = tan(0.5 * degree * f->horizontal_fov[0]) / aspect;
    else if (has(f, AT_orthographic_height))
        half = 0.5 * f->orthographic_height[0];
    else
        half = 0.5 / f->focal_length[0] *
               (has(f, AT_sensor_height) ? f->sensor_height[0] : f->sensor_width[0] / aspect);
    camera->projection = has(f, AT_orthographic_height) ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
    tl_camera_center(camera, half * aspect, half);
    return TL_OK;
}

static tl_status find_place(const char *path,
                            const camera_fields *f,
                            tl_camera *camera,
                            tl_error *err)
{
    static const double upwards[3] = {0.0, 1.0, 0.0};
    const bool by_matrix = has(f, AT_world_from_view), by_points = has(f, AT_position);
    if (by_matrix == by_points || by_points != has(f, AT_target) ||
        (by_matrix && has(f, AT_up)))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: either \"worldFromView\", or \"position\" and \"target\" (and "
                       "\"up\") must say where the camera stands",
                       path);
    if (by_points) {
        const double *up = has(f, AT_up) ? f->up : upwards;
        const tl_camera placed = tl_camera_look_at(f->position, f->target, up, 1.0,
                                                   camera->width, camera->height, 1.0, 2.0);
        for (int i = 0; i < 12; i++)
            if (!isfinite(placed.view_from_world[i / 4][i % 4]))
                return tl_fail(err, TL_ERR_FORMAT,
                               "%s: \"position\", \"target\" and \"up\" span no plane: the "
                               "camera cannot be turned",
                               path);
        memcpy(camera->view_from_world, placed.view_from_world, sizeof placed.view_from_world);
        return TL_OK;
    }
    /* The inverse of a rotation is its transpose. */
    for (int i = 0; i < 3; i++) {
        double offset = 0.0;
        for (int j = 0; j < 3; j++) {
            camera->view_from_world[i][j] = (float)f->world_from_view[4 * j + i];
            offset -= f->world_from_view[4 * j + i] * f->world_from_view[4 * j + 3];
        }
        camera->view_from_world[i][3] = (float)offset;
    }
    return TL_OK;
}

tl_status tl_camera_file_read(const char *path,
                              uint32_t width,
                              uint32_t height,
                              double pixel_aspect,
                              tl_camera *out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    json_t *root = NULL;
    camera_fields read = {.given = 0};
    tl_camera camera = {.width = width, .height = height};
    tl_camera checked;
    tl_error reason = {.status = TL_OK};
    TRY(tl_json_read(path, &root, err));
    TRY(read_top(path, root, &read, err));
    TRY(find_lens(path, &read, pixel_aspect * width / height, &camera, err));
    TRY(find_place(path, &read, &camera, err));
    camera.near = has(&read, AT_near) ? (float)read.near[0] : 0.0f;
    camera.far = has(&read, AT_far) ? (float)read.far[0] : 0.0f;
    /* What is not given stays 0, and is found from the depths later. */
    checked = camera;
    if (!has(&read, AT_far))
        checked.far = INFINITY;
    if (!has(&read, AT_near))
        checked.near = has(&read, AT_far) ? 0.5f * camera.far : 1.0f;
    if (tl_camera_check(&checked, &reason) != TL_OK)
        TRY(tl_fail(err, TL_ERR_FORMAT, "%s: %.3000s", path, reason.message));
    *out = camera;
done:
    json_decref(root);
    return status;
}
