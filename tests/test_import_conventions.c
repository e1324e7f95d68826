/* Is a frame that was written as another program writes it the same frame when it is imported? Our own
 * captures, in each row's convention, against themselves, within what the row's types round. */
#include "file_cases.h"
#include "golden_scenes.h"

#include "camera_attributes.h"
#include "foreign_exr.h"
#include "tilelight/gbuffer_file.h"
#include "tilelight/import.h"

/* Where the file says its camera, or the options do. */
typedef enum camera_source {
    BY_NDC,         /* worldToNDC as OpenEXR defines it */
    BY_NDC_SIGNED,  /* -1 to 1, y upwards; and worldToCamera */
    BY_PLACE,       /* worldToCamera, and --fov */
    BY_PLACE_RIGHT, /* the same for a right-handed camera */
    BY_VRAY,        /* cameraFov in the file; --eye, --target, --up */
    BY_OPTIONS      /* --fov, --eye, --target, --up */
} camera_source;

typedef struct convention {
    const char *name;
    const char *depth; /* its channel; NULL: positions */
    const char *position, *position_letters;
    const char *normal, *normal_letters;
    const char *albedo, *alpha;
    tl_depth_kind kind;
    double unit; /* m; 0: 1 */
    float sky;   /* what stands where nothing was hit */
    tl_import_space normal_space, position_space;
    double sign; /* of normals; 0: 1 */
    int is_encoded;
    exr_pixel_type_t depth_type, type; /* 0 (uint) stands for float */
    camera_source camera;
    int knows_space; /* the options need not say it */
    exr_storage_t storage;
    exr_compression_t compression;
    exr_tile_level_mode_t levels;
    int crop[4], origin[2];
    const char *parts[3]; /* of depth, normals, colours; NULL: one part */
} convention;

static const float infinite = INFINITY;

static const convention conventions[] = {
    {.name = "Blender, one layer of many channels",
     .depth = "ViewLayer.Depth.Z",
     .normal = "ViewLayer.Normal",
     .normal_letters = "XYZ",
     .albedo = "ViewLayer.DiffCol",
     .alpha = "ViewLayer.Combined.A",
     .sky = 1e10f,
     .knows_space = 1,
     .camera = BY_OPTIONS,
     .compression = EXR_COMPRESSION_ZIP},
    {.name = "Blender 4, half, and V of depth",
     .depth = "Layer.Depth.V",
     .normal = "Layer.Normal",
     .normal_letters = "XYZ",
     .albedo = "Layer.DiffCol",
     .type = EXR_PIXEL_HALF,
     .sky = 1e10f,
     .knows_space = 1,
     .camera = BY_OPTIONS,
     .compression = EXR_COMPRESSION_PIZ},
    {.name = "Blender, positions alone",
     .position = "ViewLayer.Position",
     .position_letters = "XYZ",
     .position_space = TL_SPACE_WORLD,
     .normal = "ViewLayer.Normal",
     .normal_letters = "XYZ",
     .albedo = "ViewLayer.DiffCol",
     .sky = 0.0f,
     .knows_space = 1,
     .camera = BY_OPTIONS},
    {.name = "Arnold, parts of layers, cropped, at an odd origin",
     .depth = "Z",
     .normal = "N",
     .normal_letters = "XYZ",
     .albedo = "diffuse_albedo",
     .alpha = "A",
     .sky = infinite,
     .knows_space = 1,
     .camera = BY_PLACE_RIGHT,
     .parts = {"Z", "N", "diffuse_albedo"},
     .crop = {5, 3, 2, 7},
     .origin = {-11, 23},
     .compression = EXR_COMPRESSION_ZIPS},
    {.name = "Arnold, distance along the ray, in cm, mipmapped tiles",
     .depth = "Z",
     .normal = "N",
     .normal_letters = "xyz",
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_RAY,
     .unit = 0.01,
     .sky = 1e30f,
     .knows_space = 1,
     .camera = BY_NDC_SIGNED,
     .storage = EXR_STORAGE_TILED,
     .levels = EXR_TILE_MIPMAP_LEVELS,
     .compression = EXR_COMPRESSION_ZIP},
    {.name = "V-Ray, view-space normals, in mm",
     .depth = "Z",
     .normal = "normals",
     .normal_letters = "XYZ",
     .normal_space = TL_SPACE_VIEW,
     .albedo = "diffuse",
     .alpha = "A",
     .unit = 0.001,
     .sky = 0.0f,
     .type = EXR_PIXEL_HALF,
     .knows_space = 1,
     .camera = BY_VRAY,
     .compression = EXR_COMPRESSION_ZIPS},
    {.name = "Direct3D, reversed buffer, normals away from the viewer and encoded",
     .depth = "depth",
     .normal = "normal",
     .normal_letters = "RGB",
     .normal_space = TL_SPACE_VIEW_FORWARD,
     .is_encoded = 1,
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_NDC_REVERSED,
     .sky = 0.0f,
     .type = EXR_PIXEL_HALF,
     .camera = BY_NDC,
     .storage = EXR_STORAGE_TILED},
    {.name = "Direct3D, buffer from 0 to 1",
     .depth = "depth.R",
     .normal = "normal",
     .normal_letters = "RGB",
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_NDC,
     .sky = 1.0f,
     .camera = BY_NDC},
    {.name = "OpenGL, as it clips",
     .depth = "depth.Y",
     .normal = "normal",
     .normal_letters = "XYZ",
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_NDC_GL,
     .sky = 1.0f,
     .camera = BY_NDC},
    {.name = "inverse depth, and normals all turned round",
     .depth = "depth",
     .normal = "N",
     .normal_letters = "XYZ",
     .sign = -1.0,
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_INVERSE,
     .sky = 0.0f,
     .camera = BY_PLACE,
     .compression = EXR_COMPRESSION_RLE},
    {.name = "negative z, half, larger than its frame",
     .depth = "depth",
     .normal = "N",
     .normal_letters = "XYZ",
     .albedo = "albedo",
     .kind = TL_DEPTH_KIND_VIEW_Z,
     .sky = -1e10f,
     .depth_type = EXR_PIXEL_HALF,
     .type = EXR_PIXEL_HALF,
     .camera = BY_NDC,
     .crop = {-3, -2, -1, -4}},
    {.name = "positions and normals in the camera's left-handed space",
     .position = "P",
     .position_letters = "XYZ",
     .position_space = TL_SPACE_VIEW_FORWARD,
     .normal = "Ns",
     .normal_letters = "XYZ",
     .normal_space = TL_SPACE_VIEW_FORWARD,
     .albedo = "Albedo",
     .sky = 0.0f,
     .knows_space = 1,
     .camera = BY_NDC},
};

/* A frame of ours with the planes that a row writes, and what they come to. */
typedef struct exported {
    const tl_gbuffer *frame;
    float *planes[13]; /* depth, position, normal, albedo, alpha: [rows][pitch] */
    const convention *as;
} exported;

enum { DEPTH = 0, POSITION = 1, NORMAL = 4, ALBEDO = 7, ALPHA = 10, PLANES = 11 };

static double unit_of(const convention *as)
{
    return as->unit > 0.0 ? as->unit : 1.0;
}

static float encoded_depth(
    const convention *as, const tl_camera *c, double depth, uint32_t x, uint32_t y)
{
    const double near = (double)c->near, far = (double)c->far;
    const double tx = (double)c->left + (x + 0.5) * (double)(c->right - c->left) / c->width;
    const double ty = (double)c->top - (y + 0.5) * (double)(c->top - c->bottom) / c->height;
    const double z01 = far * (depth - near) / (depth * (far - near));
    const double d = depth / unit_of(as);
    switch (as->kind) {
    case TL_DEPTH_KIND_VIEW_Z: return (float)-d;
    case TL_DEPTH_KIND_RAY: return (float)(d * sqrt(1.0 + tx * tx + ty * ty));
    case TL_DEPTH_KIND_INVERSE: return (float)(1.0 / d);
    case TL_DEPTH_KIND_NDC: return (float)z01;
    case TL_DEPTH_KIND_NDC_REVERSED:
        return (float)(near * (far - depth) / (depth * (far - near)));
    case TL_DEPTH_KIND_NDC_GL: return (float)(2.0 * z01 - 1.0);
    default: return (float)d;
    }
}

static void in_space(const tl_camera *c, tl_import_space space, int is_point, double v[3])
{
    if (space == TL_SPACE_AUTO || space == TL_SPACE_WORLD)
        return;
    if (is_point)
        tl_camera_view_point(c, v, v);
    else
        tl_camera_view_direction(c, v, v);
    if (space == TL_SPACE_VIEW_FORWARD)
        v[2] = -v[2];
}

static void export_pixel(exported *e, uint32_t x, uint32_t y)
{
    const tl_camera *c = &e->frame->camera;
    const convention *as = e->as;
    const size_t at = (size_t)y * e->frame->pitch + x;
    const double depth = (double)tl_gbuffer_plane(e->frame, TL_DEPTH)[at];
    const int is_sky = isinf(depth);
    const double tx = (double)c->left + (x + 0.5) * (double)(c->right - c->left) / c->width;
    const double ty = (double)c->top - (y + 0.5) * (double)(c->top - c->bottom) / c->height;
    double n[3], p[3] = {tx * depth, ty * depth, -depth};
    e->planes[ALPHA][at] = is_sky ? 0.0f : 1.0f;
    e->planes[DEPTH][at] = is_sky ? as->sky : encoded_depth(as, c, depth, x, y);
    if (!is_sky) {
        tl_camera_world_point(c, p, p);
        in_space(c, as->position_space, 1, p);
    }
    for (unsigned i = 0; i < 3; i++) {
        n[i] = (double)tl_gbuffer_plane(e->frame, (enum tl_plane)(TL_NORMAL_X + i))[at];
        e->planes[ALBEDO + i][at] =
            tl_gbuffer_plane(e->frame, (enum tl_plane)(TL_ALBEDO_R + i))[at];
        e->planes[POSITION + i][at] = is_sky ? as->sky : (float)(p[i] / unit_of(as));
    }
    in_space(c, as->normal_space, 0, n);
    for (unsigned i = 0; i < 3; i++) {
        const double v = as->sign < 0.0 ? -n[i] : n[i];
        e->planes[NORMAL + i][at] = (float)(as->is_encoded ? 0.5 * v + 0.5 : v);
    }
}

static void scaled_camera_attributes(exr_context_t file, void *context)
{
    const exported *e = context;
    tl_camera c = e->frame->camera;
    for (int i = 0; i < 3; i++)
        c.view_from_world[i][3] = (float)((double)c.view_from_world[i][3] / unit_of(e->as));
    exr_attr_m44f_t to_camera = tl_world_to_camera(&c), to_ndc = tl_world_to_ndc(&c);
    const double aspect = (double)(c.right - c.left) / (double)(c.top - c.bottom);
    const double half = atan((double)c.top * aspect) * 57.29577951308232;
    switch (e->as->camera) {
    case BY_NDC_SIGNED: /* 2x - w, w - 2y */
        for (int i = 0; i < 4; i++) {
            to_ndc.m[4 * i] = 2.0f * to_ndc.m[4 * i] - to_ndc.m[4 * i + 3];
            to_ndc.m[4 * i + 1] = to_ndc.m[4 * i + 3] - 2.0f * to_ndc.m[4 * i + 1];
        }
        foreign_must(exr_attr_set_m44f(file, 0, "worldToCamera", &to_camera), "camera");
        foreign_must(exr_attr_set_m44f(file, 0, "worldToNDC", &to_ndc), "ndc");
        break;
    case BY_NDC: foreign_must(exr_attr_set_m44f(file, 0, "worldToNDC", &to_ndc), "ndc"); break;
    case BY_PLACE_RIGHT:
        for (int i = 0; i < 4; i++)
            to_camera.m[4 * i + 2] = -to_camera.m[4 * i + 2];
        foreign_must(exr_attr_set_m44f(file, 0, "worldToCamera", &to_camera), "camera");
        break;
    case BY_PLACE:
        foreign_must(exr_attr_set_m44f(file, 0, "worldToCamera", &to_camera), "camera");
        break;
    case BY_VRAY:
        foreign_must(exr_attr_set_float(file, 0, "cameraFov", (float)(2.0 * half)), "fov");
        foreign_must(exr_attr_set_int(file, 0, "cameraProjection", 0), "projection");
        foreign_must(exr_attr_set_string(file, 0, "vrayInfo/vraycore", "4"), "vray");
        break;
    case BY_OPTIONS: break;
    }
}

static exr_pixel_type_t type_of(exr_pixel_type_t type)
{
    return type == EXR_PIXEL_HALF ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
}

static void write_as(exported *e, const char *path)
{
    static foreign_file file; /* too large for a stack */
    const convention *as = e->as;
    const tl_camera *c = &e->frame->camera;
    const float *const *planes = (const float *const *)e->planes;
    file = (foreign_file){.width = (int)c->width,
                          .height = (int)c->height,
                          .pitch = e->frame->pitch,
                          .origin = {as->origin[0], as->origin[1]},
                          .part_count = as->parts[0] ? 3 : 1,
                          .attributes = scaled_camera_attributes,
                          .context = e};
    for (int i = 0; i < file.part_count; i++) {
        file.parts[i] = (foreign_part){.name = as->parts[i],
                                       .storage = as->storage,
                                       .compression = as->compression,
                                       .levels = as->levels};
        memcpy(file.parts[i].crop, as->crop, sizeof as->crop);
    }
    foreign_part *second = &file.parts[file.part_count > 1 ? 1 : 0];
    foreign_part *third = &file.parts[file.part_count > 1 ? 2 : 0];
    if (as->depth)
        foreign_add(&file.parts[0], as->depth, type_of(as->depth_type), planes[DEPTH]);
    if (as->position)
        foreign_add_three(&file.parts[0], as->position, as->position_letters, EXR_PIXEL_FLOAT,
                          planes + POSITION);
    if (as->alpha)
        foreign_add(&file.parts[0], as->alpha, EXR_PIXEL_HALF, planes[ALPHA]);
    /* In parts of their own the layers' names stand in front, and letters alone in the channels. */
    foreign_add_three(second, as->parts[0] ? "" : as->normal, as->normal_letters,
                      type_of(as->type), planes + NORMAL);
    foreign_add_three(third, as->parts[0] ? "" : as->albedo, "RGB", type_of(as->type),
                      planes + ALBEDO);
    foreign_write(&file, path);
}

static tl_import_options options_for(const exported *e)
{
    const convention *as = e->as;
    const tl_camera *c = &e->frame->camera;
    static const double origin[3] = {0.0, 0.0, 0.0}, ahead[3] = {0.0, 0.0, -3.0};
    static const double upwards[3] = {0.0, 1.0, 0.0};
    tl_import_options options = tl_import_options_default();
    options.depth_kind = as->kind;
    options.unit = unit_of(as);
    options.normals_are_encoded = as->is_encoded != 0;
    if (!as->knows_space)
        options.normal_space =
            as->normal_space == TL_SPACE_AUTO ? TL_SPACE_WORLD : as->normal_space;
    if (as->kind >= TL_DEPTH_KIND_NDC) {
        options.camera.near = (double)c->near;
        options.camera.far = (double)c->far;
    }
    if (as->camera == BY_PLACE || as->camera == BY_PLACE_RIGHT || as->camera == BY_OPTIONS)
        options.camera.vertical_fov = 2.0 * atan((double)c->top) * 57.29577951308232;
    if (as->camera == BY_VRAY || as->camera == BY_OPTIONS) {
        options.camera.is_placed = true;
        tl_camera_world_point(c, origin, options.camera.eye);
        tl_camera_world_point(c, ahead, options.camera.target);
        tl_camera_world_direction(c, upwards, options.camera.up);
    }
    return options;
}

/* Unit roundoff: a number is off by at most so much of itself. */
static double roundoff(exr_pixel_type_t type)
{
    return type == EXR_PIXEL_HALF ? 0x1p-11 : 0x1p-24;
}

/* Depths: the stored number is off by its roundoff u. Of kinds that are proportional to depth or its
 * inverse so is the depth. Of a buffer, d = n f / (f - z (f - n)): an error e of z moves d by
 * d^2 (f - n)/(n f) e, and e is u for z up to 1, halved and doubled again for GL. The rest of a frame
 * away: the ray's length changes by less than the edges do, which matrices of floats carry to some 8 u of
 * float, and positions go through a matrix to 8 u of their size. */
static double depth_tolerance(const exported *e, double depth)
{
    const tl_camera *c = &e->frame->camera;
    const double u = roundoff(type_of(e->as->depth_type)), near = (double)c->near,
                 far = (double)c->far;
    const double rest = 16.0 * 0x1p-24 * depth;
    if (e->as->position) {
        const double *t = (const double[3]){(double)c->view_from_world[0][3],
                                            (double)c->view_from_world[1][3],
                                            (double)c->view_from_world[2][3]};
        const double eye = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
        return rest + 16.0 * 0x1p-24 * (eye + 3.0 * depth);
    }
    if (e->as->kind == TL_DEPTH_KIND_NDC || e->as->kind == TL_DEPTH_KIND_NDC_GL)
        return rest + u * depth * depth * (far - near) / (near * far);
    return rest + u * depth;
}

/* Normals: each number is off by half a step below 1, u/2; encoded, twice that after decoding. That moves
 * the vector by sqrt(3) times as much, and bringing it to length 1 at most doubles it. Going through the
 * camera's matrix and its transpose costs some 8 u of float, and a matrix made from points as much. */
static double normal_tolerance(const convention *as)
{
    const double u = roundoff(type_of(as->type));
    return 2.0 * 1.7320508 * 0.5 * u * (as->is_encoded ? 2.0 : 1.0) + 32.0 * 0x1p-24;
}

static int is_inside(const exported *e, uint32_t x, uint32_t y)
{
    const int *crop = e->as->crop;
    return (int)x >= crop[0] && (int)y >= crop[1] &&
           (int)x < (int)e->frame->camera.width - crop[2] &&
           (int)y < (int)e->frame->camera.height - crop[3];
}

static void assert_near(const exported *e,
                        const char *plane,
                        uint32_t x,
                        uint32_t y,
                        double got,
                        double wanted,
                        double tolerance)
{
    if (isinf(wanted) ? !isinf(got) : !(fabs(got - wanted) <= tolerance))
        fail_msg("%s: %s at (%u, %u) is %.9g, not %.9g: off by %g, where %g is allowed",
                 e->as->name, plane, x, y, got, wanted, fabs(got - wanted), tolerance);
}

static void assert_pixel(const exported *e, const tl_gbuffer *got, uint32_t x, uint32_t y)
{
    const size_t at = (size_t)y * got->pitch + x;
    const double depth =
        is_inside(e, x, y) ? (double)tl_gbuffer_plane(e->frame, TL_DEPTH)[at] : HUGE_VAL;
    assert_near(e, "depth", x, y, (double)tl_gbuffer_plane(got, TL_DEPTH)[at], depth,
                depth_tolerance(e, depth));
    if (isinf(depth))
        return;
    for (unsigned i = 0; i < 3; i++) {
        const enum tl_plane n = (enum tl_plane)(TL_NORMAL_X + i);
        const enum tl_plane a = (enum tl_plane)(TL_ALBEDO_R + i);
        const double color = (double)tl_gbuffer_plane(e->frame, a)[at];
        assert_near(e, "normal", x, y, (double)tl_gbuffer_plane(got, n)[at],
                    (double)tl_gbuffer_plane(e->frame, n)[at], normal_tolerance(e->as));
        assert_near(e, "albedo", x, y, (double)tl_gbuffer_plane(got, a)[at], color,
                    type_of(e->as->type) == EXR_PIXEL_HALF ? 0x1p-11 * color + 0x1p-25 : 0.0);
    }
}

static void assert_same_frame(const exported *e, const tl_gbuffer *got)
{
    const tl_camera *a = &e->frame->camera, *b = &got->camera;
    const float wanted[] = {a->left, a->right, a->bottom, a->top};
    const float edges[] = {b->left, b->right, b->bottom, b->top};
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    for (int i = 0; i < 4; i++)
        if (fabs((double)(edges[i] - wanted[i])) > 16.0 * 0x1p-24 * fabs((double)wanted[i]))
            fail_msg("%s: edge %d of the camera is %.9g, not %.9g", e->as->name, i,
                     (double)edges[i], (double)wanted[i]);
    for (int i = 0; i < 12; i++) {
        const double x = (double)a->view_from_world[i / 4][i % 4];
        const double y = (double)b->view_from_world[i / 4][i % 4];
        if (fabs(x - y) > 32.0 * 0x1p-24 * fmax(1.0, 8.0 * fabs(x)))
            fail_msg("%s: entry %d of the camera's matrix is %.9g, not %.9g", e->as->name, i, y,
                     x);
    }
    for (uint32_t y = 0; y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++)
            assert_pixel(e, got, x, y);
}

static void check(const convention *as, const tl_gbuffer *frame, const char *path)
{
    tl_error err;
    tl_gbuffer *got = NULL;
    tl_import_counts counts;
    exported e = {.frame = frame, .as = as};
    for (int i = 0; i < PLANES; i++) {
        e.planes[i] = calloc((size_t)frame->pitch * frame->rows, sizeof(float));
        assert_non_null(e.planes[i]);
    }
    for (uint32_t y = 0; y < frame->camera.height; y++)
        for (uint32_t x = 0; x < frame->camera.width; x++)
            export_pixel(&e, x, y);
    write_as(&e, path);
    const tl_import_options options = options_for(&e);
    if (tl_import_read(path, &options, NULL, &got, &counts, &err) != TL_OK)
        fail_msg("%s: %s", as->name, err.message);
    assert_same_frame(&e, got);
    tl_gbuffer_destroy(got);
    for (int i = 0; i < PLANES; i++)
        free(e.planes[i]);
    remove(path);
}

static void frames_come_back(void **state)
{
    (void)state;
    char path[512], name[512];
    scratch_path(path, sizeof path, "convention.exr");
    for (size_t s = 0; s < COUNT_OF(golden_scenes); s++) {
        tl_error err;
        tl_gbuffer *frame = NULL;
        source_path(name, sizeof name, "tests/golden", golden_scenes[s].name, ".gbuffer.exr");
        ASSERT_OK(tl_gbuffer_read(name, &frame, NULL, NULL, &err), err);
        ASSERT_OK(tl_gbuffer_repair(frame, name, false, NULL, &err), err);
        for (size_t i = 0; i < COUNT_OF(conventions); i++)
            check(&conventions[i], frame, path);
        tl_gbuffer_destroy(frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(frames_come_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
