/* Is a position from stored depth as exact as kernels/depth_code.h derives, in every convention and under
 * every camera, and does the textbook form fail there?
 *
 * tests/oracle/depth_buffer.h has the definitions of the conventions. Bounds have two parts: how far the
 * number that is stored may be from the surface, half a step of it, and what reading that number in float may
 * add, a few u of the depth whatever far/near is. The second is what the form decides. */
#include "layout_frames.h"

#include "packing.h"

#include "figures.h"
#include "formulas.h"
#include "oracle/depth_buffer.h"

static const wide u = 0x1p-24Q;
static const wide margin = 1 + 0x1p-20Q; /* products of errors */

/* read: u of the nearness that reading adds, where it is not exact (depth_code.h); step: of the number. */
static const struct convention {
    enum tl_layout_name layout;
    enum tl_oracle_convention of;
    int whole;      /* of 24 bits; 0: a float */
    int high_first; /* the highest of its three bytes first */
    int read;
} conventions[] = {
    {TL_LAYOUT_FLOAT_FORWARD, TL_ORACLE_FORWARD, 0, 0, 1},
    {TL_LAYOUT_FLOAT_NDC, TL_ORACLE_NDC, 0, 0, 1},
    {TL_LAYOUT_FLOAT_REVERSED, TL_ORACLE_REVERSED, 0, 0, 0},
    {TL_LAYOUT_TUTORIAL_U24, TL_ORACLE_FORWARD, 1, 0, 2},
    {TL_LAYOUT_TUTORIAL_3X8, TL_ORACLE_FORWARD, 1, 1, 2},
    {TL_LAYOUT_FLOAT_FRACTION, TL_ORACLE_FRACTION, 0, 0, 0},
};

/* Whether the number is linear in depth; else in 1/depth. */
static int is_linear(const struct convention *c, const tl_camera *camera)
{
    return camera->projection == TL_ORTHOGRAPHIC || c->layout == TL_LAYOUT_FLOAT_FRACTION;
}

static wide stored_number(const struct convention *c, const tl_gbuffer *g, size_t at)
{
    const uint32_t index = tl_layouts[c->layout].depth.channels[0].word;
    const unsigned char *b = (const unsigned char *)tl_gbuffer_words(g, index) + 4 * at;
    float f;
    if (c->high_first)
        return (wide)(b[0] * 65536u + b[1] * 256u + b[2]) / 16777215;
    if (c->whole)
        return (wide)(b[2] * 65536u + b[1] * 256u + b[0]) / 16777215;
    memcpy(&f, b, sizeof f);
    return f;
}

static tl_depth_range range_of(const tl_camera *c, int linear)
{
    return (tl_depth_range){c->near, c->far, linear};
}

/* Half of the step between floats at x, or below 1 the whole one that keeps a surface from being sky. */
static wide half_step(const struct convention *c, wide share)
{
    const wide number = c->layout == TL_LAYOUT_FLOAT_REVERSED ? 1 - share
                        : c->layout == TL_LAYOUT_FLOAT_NDC    ? 2 * share - 1
                                                              : share;
    const wide scale = c->layout == TL_LAYOUT_FLOAT_NDC ? 0.5Q : 1;
    int exponent;
    if (c->whole)
        return (share > 1 - 1 / 16777215.0Q ? 1 : 0.5Q) / 16777215;
    frexpq(number, &exponent);
    if (c->layout == TL_LAYOUT_FLOAT_REVERSED)
        return number < 0x1p-126Q ? 0x1p-126Q : ldexpq(0.5Q, exponent - 24);
    return scale * (number > 1 - u ? u : ldexpq(0.5Q, exponent - 24));
}

typedef struct spot {
    const struct convention *convention;
    const char *camera;
    const tl_gbuffer *from, *packed;
    uint32_t column, row;
    size_t at;
} spot;

static void check(const spot *s, const char *what, wide got, wide want, wide bound)
{
    if (!(fabsq(got - want) <= bound))
        fail_msg("%s, %s, pixel (%u, %u): %s %.9g, want %.9g within %.3g",
                 tl_layout_word(s->convention->layout), s->camera, s->column, s->row, what,
                 (double)got, (double)want, (double)bound);
}

/* What computing nearness in double leaves of it: four roundings of what is subtracted. */
static wide packing(const tl_camera *c, int linear, wide depth)
{
    const wide near = c->near, far = c->far, per_far = isinf(c->far) ? 0 : 1 / far;
    return 0x1p-51Q * (linear ? (fabsq(far) + fabsq(depth)) / (far - near)
                              : (1 / depth + per_far) / (1 / near - per_far));
}

/* The nearness of the convention, and what half a step of it is of the depth: h of depth_code.h. */
static void check_storage(const spot *s, wide shown, wide stored)
{
    const tl_camera *c = &s->from->camera;
    const int linear = is_linear(s->convention, c);
    const wide step =
        half_step(s->convention, tl_oracle_share_of_depth(range_of(c, linear), shown)) +
        packing(c, linear, shown);
    const wide near = c->near, far = c->far;
    if (linear) {
        check(s, "stored depth", stored, shown, step * (far - near) * margin);
        return;
    }
    const wide h = step * shown * (1 / near - (isinf(c->far) ? 0 : 1 / far)) * margin;
    if (stored > shown)
        check(s, "shown depth", shown, stored, h * stored); /* 1/depth is off by h/depth */
    else
        check(s, "stored depth", stored, shown, h * shown);
}

/* What reading adds to the depth that the number says. */
static wide reading_bound(const spot *s, wide depth)
{
    const tl_camera *c = &s->from->camera;
    const wide read = s->convention->read, near = c->near, far = c->far;
    if (!is_linear(s->convention, c))
        return (3 + read) * u * depth * margin;
    const wide from = s->convention->layout == TL_LAYOUT_FLOAT_FRACTION ? near : far;
    return ((1 + read) * u * fabsq(from - depth) + u * fabsq(depth)) * margin;
}

/* Along a ray that is rounded three times: its beginning, its step, their sum; then the product. */
static void check_across(const spot *s, int axis, wide got, wide depth, wide depth_bound)
{
    const tl_camera *c = &s->from->camera;
    const wide begin = axis ? c->top : c->left, end = axis ? c->bottom : c->right;
    const wide cells = axis ? c->height : c->width, index = axis ? s->row : s->column;
    const wide step = (end - begin) / cells, ray = tl_oracle_ray(begin, end, cells, index);
    const wide ray_off =
        u * (fabsq(begin + step / 2) + fabsq(index * step) + fabsq(ray)) * margin;
    if (c->projection == TL_ORTHOGRAPHIC)
        check(s, "x or y", got, ray, ray_off);
    else
        check(s, "x or y", got, ray * depth,
              ((ray_off + u * fabsq(ray)) * depth + fabsq(ray) * depth_bound) * margin);
}

/* What was seen: of the depth, or, where numbers are linear in it, of near to far. */
static figure figures[COUNT_OF(conventions)][2][2];

static const char *const arithmetics[] = {"float", "double"};

static void name_figures(void)
{
    for (size_t i = 0; i < COUNT_OF(conventions); i++)
        for (int linear = 0; linear < 2; linear++)
            for (int k = 0; k < 2; k++)
                figures[i][linear][k] =
                    (figure){.section = "positions",
                             .formula = tl_layout_word(conventions[i].layout),
                             .file = "kernels/depth_code.h",
                             .quantity = linear ? "depth as read, of |near| + |far|"
                                                : "depth as read, of itself",
                             .arithmetic = arithmetics[k],
                             .unit = k ? "u of float" : "u",
                             .parts = linear ? "reading, slope, sum"
                                             : "reading, slope and offset, sum, quotient"};
}

static void note(const spot *s, int linear, int arithmetic, wide got, wide want, wide bound)
{
    const tl_camera *c = &s->from->camera;
    const wide scale = linear ? fabsq((wide)c->near) + fabsq((wide)c->far) : want;
    figure_sees(&figures[s->convention - conventions][linear][arithmetic],
                (double)(fabsq(got - want) / scale), (double)(bound / scale), "%s, depth %.9g",
                s->camera, (double)want);
}

/* In double: slope and offset are floats, and nothing else rounds to speak of. */
static void check_double(
    const spot *s, const tl_frame *frame, int linear, wide number, wide stored)
{
    const tl_camera *c = &s->from->camera;
    if (s->convention->whole)
        return;
    const int parallel = c->projection == TL_ORTHOGRAPHIC;
    const wide read =
        tl_formulas_double.depth(tl_layouts[s->convention->layout].depth.code, parallel,
                                 frame->depth_slope, frame->depth_offset, (double)number);
    const wide from = s->convention->of == TL_ORACLE_FRACTION ? c->near : c->far;
    const wide rest = 0x1p-50Q * (fabsq(from) + fabsq(stored));
    note(s, linear, 1, read, stored,
         linear ? u * fabsq(from - stored) * margin + rest : (u + 0x1p-50Q) * stored * margin);
}

static void check_pixel(const spot *s, const tl_frame *frame, tl_needs needs)
{
    const tl_word_planes planes = tl_word_planes_of(s->packed);
    const tl_words words = tl_words_at(&planes, s->at);
    const float shown = tl_gbuffer_plane(s->from, TL_DEPTH)[s->at];
    const vec3 read =
        position_of(frame, needs, planes.layout, &words, (float)s->column, (float)s->row);
    const float got[3] = {read.x, read.y, read.z};
    if (isinf(shown)) {
        assert_true(isinf(got[2]) && got[2] < 0.0f);
        return;
    }
    const tl_camera *c = &s->from->camera;
    const int linear = is_linear(s->convention, c);
    const wide number = stored_number(s->convention, s->packed, s->at);
    const wide stored = tl_oracle_depth(s->convention->of, range_of(c, linear), number);
    const wide bound = reading_bound(s, stored);
    check_storage(s, shown, stored);
    check(s, "depth as read", -(wide)got[2], stored, bound);
    note(s, linear, 0, -(wide)got[2], stored, bound);
    check_double(s, frame, linear, number, stored);
    check_across(s, 0, got[0], stored, bound);
    check_across(s, 1, got[1], stored, bound);
}

static void check_frame(const struct convention *convention,
                        const char *name,
                        const tl_gbuffer *from)
{
    tl_gbuffer *packed = NULL;
    tl_frame frame = {.tile_size = 0};
    tl_error err;
    const tl_needs needs = {.present = from->present,
                            .orthographic = from->camera.projection == TL_ORTHOGRAPHIC,
                            .layout = convention->layout};
    ASSERT_OK(tl_gbuffer_pack(from, convention->layout, &packed, NULL, &err), err);
    tl_view_set(&from->camera, convention->layout, &frame);
    for (uint32_t i = 0; i < HARD_PIXELS; i++) {
        const uint32_t column = i % HARD_COLUMNS, row = i / HARD_COLUMNS;
        const spot s = {
            convention, name, from, packed, column, row, (size_t)row * from->pitch + column};
        check_pixel(&s, &frame, needs);
    }
    tl_gbuffer_destroy(packed);
}

static void positions_are_within_the_bound(void **state)
{
    (void)state;
    name_figures();
    for (size_t c = 0; c < COUNT_OF(hard_cameras); c++) {
        const tl_camera camera = hard_camera(c);
        tl_gbuffer *from = hard_layout_frame(&camera, TL_GROUP_BASE, 1994 + (uint32_t)c);
        for (size_t i = 0; i < COUNT_OF(conventions); i++)
            if (!isinf(camera.far) || !is_linear(&conventions[i], &camera))
                check_frame(&conventions[i], hard_cameras[c].name, from);
        tl_gbuffer_destroy(from);
    }
    for (size_t i = 0; i < 4 * COUNT_OF(conventions); i++)
        if (figures[i / 4][i / 2 % 2][i % 2].cases > 0)
            figure_report(&figures[i / 4][i / 2 % 2][i % 2]);
}

/* 1/depth = d/P34 + P33/P34, P33 = far/(near - far), P34 = near far/(near - far), as "Deferred Shading
 * Tricks" has it: one fma and one division too, of constants that are rounded once. */
static float textbook_depth(const tl_camera *c, float d)
{
    const double near = (double)c->near, far = (double)c->far;
    const double p33 = far / (near - far), p34 = near * far / (near - far);
    return 1.0f / fmaf(d, (float)(1.0 / p34), (float)(p33 / p34));
}

/* The largest relative errors of reading numbers d close to 1 and further from it, ours and theirs. */
static void worst_reading(const tl_camera *camera, wide *ours, wide *theirs)
{
    tl_frame frame = {.tile_size = 0};
    tl_view_set(camera, TL_LAYOUT_FLOAT_FORWARD, &frame);
    for (uint32_t k = 1; k < 4096; k++) {
        const float d = 1.0f - (float)k * (k % 2 ? 0x1p-24f : 0x1p-12f);
        const wide exact = tl_oracle_depth(TL_ORACLE_FORWARD, range_of(camera, 0), d);
        const wide read = depth_of(&frame, (tl_needs){.orthographic = 0}, TL_DEPTH_FORWARD,
                                   nearness_of(TL_DEPTH_FORWARD, d));
        *ours = fmaxq(*ours, fabsq(read - exact) / exact);
        *theirs = fmaxq(*theirs, fabsq((wide)textbook_depth(camera, d) - exact) / exact);
    }
}

/* Its terms have opposite signs: what rounding the constants leaves of 1/near stays beside 1/far, up to
 * u far/near of the depth. A tenth of that, which one of a few near planes shows, is 25 times our bound at
 * far/near = 1e3, and 6 % of the depth at 1e7. */
static void the_textbook_form_is_not(void **state)
{
    static const float nears[] = {0.1f, 0.3f, 0.7f, 3.0f}, ratios[] = {1e3f, 1e5f, 1e7f};
    (void)state;
    for (size_t r = 0; r < COUNT_OF(ratios); r++) {
        wide ours = 0, theirs = 0;
        for (size_t n = 0; n < COUNT_OF(nears); n++) {
            tl_camera camera = hard_camera(0);
            camera.near = nears[n];
            camera.far = camera.near * ratios[r];
            worst_reading(&camera, &ours, &theirs);
        }
        if (!(ours <= 4 * u * margin) || !(theirs > u * ratios[r] / 10))
            fail_msg("far/near %g: reading is off by %.3g, the textbook form by %.3g",
                     (double)ratios[r], (double)ours, (double)theirs);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positions_are_within_the_bound),
        cmocka_unit_test(the_textbook_form_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
