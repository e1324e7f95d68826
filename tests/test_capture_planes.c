/* Do depth, normal and coverage of a captured plane agree with its rays, cast in double?
 *
 * Perspective and orthographic cameras, nodes off their axes, scaled unevenly and mirrored, strips
 * and fans, and far from the origin. */
#include "gltf_scene.h"

enum { WIDTH = 97, HEIGHT = 61 }; /* odd, and unlike: swapped axes would show */

/* Rotation by an angle around a unit axis, after scaling, before moving. */
typedef struct placing {
    double axis[3], angle, scale[3], move[3];
} placing;

typedef struct view {
    placing eye;
    double half_height; /* tangent of half the field of view, or m */
    int orthographic;
} view;

typedef enum shape { LIST, STRIP, FAN } shape;

static const struct {
    const char *name;
    placing quad;
    view from;
    shape shape;
} cases[] = {
    {"facing",
     {{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"turned around y",
     {{0, 1, 0}, 0.9, {1, 1, 1}, {0.1, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"turned around x",
     {{1, 0, 0}, -1.1, {1, 1, 1}, {0, 0.2, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"grazing",
     {{1, 0, 0}, -1.54, {4, 9, 1}, {0, -0.3, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 9.5}}, 0.4, 0},
     LIST},
    {"reaching behind the eye",
     {{1, 0, 0}, -1.4, {50, 50, 1}, {0, -1, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"camera off its axes",
     {{0.6, 0.8, 0}, 0.7, {1, 2, 1}, {3, 2, -5}},
     {{{0, 0.6, 0.8}, 0.4, {1, 1, 1}, {5, 3, 0.5}}, 0.6, 0},
     LIST},
    {"camera with a scale",
     {{0.6, 0.8, 0}, 0.2, {1, 1, 1}, {0, 0, 0}},
     {{{0, 0.6, 0.8}, 0.1, {3, 0.5, 7}, {0.5, 0.2, 4}}, 0.6, 0},
     LIST},
    {"scaled unevenly",
     {{0, 1, 0}, 0.5, {0.5, 1.5, 3}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"mirrored in x",
     {{0, 1, 0}, 0.5, {-1, 1, 1}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"mirrored in all",
     {{0, 1, 0}, 3.0, {-1, -1, -1}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"scaled flat",
     {{0, 1, 0}, 0.4, {1, 1, 0}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     LIST},
    {"strip",
     {{0, 1, 0}, 0.9, {1, 1, 1}, {0.1, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     STRIP},
    {"fan",
     {{0, 1, 0}, 0.9, {1, 1, 1}, {0.1, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4}}, 0.5, 0},
     FAN},
    {"orthographic",
     {{0, 1, 0}, 0.9, {1, 1, 1}, {0.1, 0, 0}},
     {{{0, 0.6, 0.8}, 0.1, {1, 1, 1}, {0, 0, 4}}, 1.5, 1},
     LIST},
    {"orthographic, mirrored",
     {{1, 0, 0}, 0.9, {1, -1, 1}, {0.1, 0, 0}},
     {{{0, 0.6, 0.8}, 0.1, {1, 1, 1}, {0, 0, 4}}, 1.2, 1},
     LIST},
    {"tiny",
     {{0, 1, 0}, 0.9, {1e-6, 1e-6, 1e-6}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4e-6}}, 0.5, 0},
     LIST},
    {"huge",
     {{0, 1, 0}, 0.9, {1e8, 1e8, 1e8}, {0, 0, 0}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {0, 0, 4e8}}, 0.5, 0},
     LIST},
    /* 2^20 and 2^19 m: the camera's own floats hold them exactly where it is not turned; the square is
     * at a place between floats, which are 1/8 m apart there. */
    {"far from the origin",
     {{0, 1, 0}, 0.9, {1, 1, 1}, {1048576.03, 0, 524288.02}},
     {{{0, 1, 0}, 0, {1, 1, 1}, {1048576, 0, 524292}}, 0.5, 0},
     LIST},
};

/* Rodrigues' formula, where the program goes through quaternions. */
static void place(const placing *at, const double p[3], double out[3])
{
    const double *const k = at->axis;
    const double v[3] = {at->scale[0] * p[0], at->scale[1] * p[1], at->scale[2] * p[2]};
    const double c = cos(at->angle), s = sin(at->angle);
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) * (1 - c);
    const double cross[3] = {k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2],
                             k[0] * v[1] - k[1] * v[0]};
    for (int i = 0; i < 3; i++)
        out[i] = v[i] * c + cross[i] * s + k[i] * along + at->move[i];
}

static char *node_transform(char *buffer, size_t size, const placing *at)
{
    const double s = sin(0.5 * at->angle);
    snprintf(buffer, size,
             "\"translation\":[%.17g,%.17g,%.17g],\"rotation\":[%.17g,%.17g,%.17g,%.17g],"
             "\"scale\":[%.17g,%.17g,%.17g]",
             at->move[0], at->move[1], at->move[2], s * at->axis[0], s * at->axis[1],
             s * at->axis[2], cos(0.5 * at->angle), at->scale[0], at->scale[1], at->scale[2]);
    return buffer;
}

static const char *const shape_edits[][2] = {
    [LIST] = {"", ""},
    [STRIP] = {"\"indices\":3,", "\"mode\":5,"},
    [FAN] = {"\"indices\":3,", "\"mode\":6,"},
};

static double near_of(size_t i)
{
    return cases[i].from.orthographic ? -1 : 0.02 * fabs(cases[i].quad.scale[0]);
}

static char *scene_of(size_t i)
{
    square_data data = square;
    char transform[512], node[640];
    if (cases[i].shape == STRIP) /* zigzag */
        memcpy(data.positions, (float[4][3]){{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}},
               sizeof data.positions);
    char *text = square_scene(&data);
    snprintf(node, sizeof node, "\"mesh\":0,%s",
             node_transform(transform, sizeof transform, &cases[i].quad));
    text = edited(text, "\"mesh\":0", node);
    snprintf(node, sizeof node, "\"camera\":0,%s",
             node_transform(transform, sizeof transform, &cases[i].from.eye));
    text = edited(text, "\"camera\":0,\"translation\":[0,0,4]", node);
    if (cases[i].from.orthographic) {
        snprintf(node, sizeof node,
                 "\"orthographic\",\n \"orthographic\":{\"xmag\":9,\"ymag\":%.17g,\"znear\":-1,"
                 "\"zfar\":50}",
                 cases[i].from.half_height);
        text = edited(text,
                      "\"perspective\",\n \"perspective\":{\"yfov\":1.0,\"znear\":0.1,"
                      "\"zfar\":100}",
                      node);
    } else {
        snprintf(node, sizeof node, "\"yfov\":%.17g,\"znear\":%.17g",
                 2 * atan(cases[i].from.half_height), near_of(i));
        text = edited(text, "\"yfov\":1.0,\"znear\":0.1,\"zfar\":100", node);
    }
    return edited(text, shape_edits[cases[i].shape][0], shape_edits[cases[i].shape][1]);
}

/* The ray of a point of the picture: p = origin + t direction, where t is the depth. */
static void ray_of(const view *from, double x, double y, double origin[3], double direction[3])
{
    static const double zero[3] = {0};
    const double half = from->half_height;
    const double right = (2 * x / WIDTH - 1) * half * WIDTH / HEIGHT;
    const double up = (1 - 2 * y / HEIGHT) * half;
    const double flat = from->orthographic;
    const double start[3] = {flat * right, flat * up, 0};
    const double end[3] = {right, up, -1};
    placing rigid = from->eye; /* a camera's scale does not count */
    double base[3], tip[3];
    for (int i = 0; i < 3; i++) {
        rigid.scale[i] = 1;
        rigid.move[i] = 0;
    }
    place(&rigid, zero, base);
    place(&rigid, start, origin);
    place(&rigid, end, tip);
    for (int i = 0; i < 3; i++) {
        direction[i] = tip[i] - origin[i];
        origin[i] += from->eye.move[i];
    }
}

static double det3(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Whether the ray meets the square's front between near and far; at which depth; the normal. */
static int meet(size_t i, double x, double y, double *depth, double normal[3])
{
    static const double corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const double *const scale = cases[i].quad.scale;
    double o[3], d[3], p[3][3], u[3], v[3], w[3], minus[3], length = 0, along = 0;
    ray_of(&cases[i].from, x, y, o, d);
    for (int k = 0; k < 3; k++)
        place(&cases[i].quad, corners[k], p[k]);
    for (int k = 0; k < 3; k++) {
        u[k] = p[1][k] - p[0][k];
        v[k] = p[2][k] - p[0][k];
        w[k] = o[k] - p[0][k];
        minus[k] = -d[k];
    }
    /* s u + t v - depth d = o - p0, by Cramer's rule */
    const double det = det3(u, v, minus);
    const double s = det3(w, v, minus) / det, t = det3(u, w, minus) / det;
    *depth = det3(u, v, w) / det;
    for (int k = 0; k < 3; k++) {
        normal[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
        length += normal[k] * normal[k];
    }
    for (int k = 0; k < 3; k++) { /* u x v is on the other side where the node mirrors */
        normal[k] *= (scale[0] * scale[1] * scale[2] < 0 ? -1 : 1) / sqrt(length);
        along += normal[k] * d[k];
    }
    return fabs(s) <= 1 && fabs(t) <= 1 && *depth > near_of(i) && along < 0;
}

/* A vertex is moved by up to 1/512 pixel, as OpenGL's 8 subpixel bits allow: a pixel whose centre is
 * that near to an edge may go either way. */
static int is_near_an_edge(size_t i, uint32_t x, uint32_t y)
{
    static const double offsets[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    double depth, normal[3];
    int inside = 0;
    for (int k = 0; k < 4; k++)
        inside += meet(i, x + 0.5 + offsets[k][0] / 256, y + 0.5 + offsets[k][1] / 256, &depth,
                       normal);
    return inside != 0 && inside != 4;
}

/* In units of 2^-24 and of the value itself: 7 for a vertex on its way to view space and through 1/w,
 * 3 for the plane that interpolates 1/w over the picture, which the near-plane cut of a triangle that
 * reaches behind the eye goes through twice; 3 for z/w and its division by 1/w. The terms are no
 * larger than the result, as the squares do not come nearer to the eye than their pixels show. */
static const double depth_bound = 16 * 0x1p-24;
/* A rotated normal, normalised twice: 4 roundings of parts of 1, and a reciprocal square root of
 * 2 units. */
static const double normal_bound = 6 * 0x1p-24;

static int check_pixel(size_t i, const shot *taken, uint32_t x, uint32_t y)
{
    const float got = shown_at(taken, TL_DEPTH, x, y);
    double depth, normal[3];
    const int hit = meet(i, x + 0.5, y + 0.5, &depth, normal);
    if (hit != (isfinite(got) != 0))
        fail_msg("%s: pixel %u, %u: depth %g, but the ray %s", cases[i].name, x, y, (double)got,
                 hit ? "hits" : "misses");
    if (!hit)
        return 0;
    if (!(fabs((double)got / depth - 1) <= depth_bound))
        fail_msg("%s: pixel %u, %u: depth %.9g, want %.9g", cases[i].name, x, y, (double)got,
                 depth);
    for (int k = 0; k < 3; k++) {
        const float n = shown_at(taken, (enum tl_plane)(TL_NORMAL_X + k), x, y);
        if (!(fabs((double)n - normal[k]) <= normal_bound))
            fail_msg("%s: pixel %u, %u: normal[%d] %.9g, want %.9g", cases[i].name, x, y, k,
                     (double)n, normal[k]);
    }
    return 1;
}

static void agrees_with_its_rays(void **state)
{
    const tl_capture_options options = {.width = WIDTH, .height = HEIGHT};
    (void)state;
    for (size_t i = 0; i < COUNT_OF(cases); i++) {
        char *const text = scene_of(i);
        int covered = 0;
        shot taken;
        ASSERT_OK(shoot_text("planes", text, &options, &taken), taken.err);
        for (uint32_t y = 0; y < HEIGHT; y++)
            for (uint32_t x = 0; x < WIDTH; x++)
                if (!is_near_an_edge(i, x, y))
                    covered += check_pixel(i, &taken, x, y);
        if (covered < 300)
            fail_msg("%s: shows in %d pixels, too few to say anything", cases[i].name, covered);
        shot_clear(&taken);
        free(text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(agrees_with_its_rays)};
    if (!can_capture())
        return TL_SKIPPED;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
