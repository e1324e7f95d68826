/* Does every layout give back each pixel within its derived bound, and do its bits mean what its
 * render targets' formats say?
 *
 * What is packed is read twice: by layout_oracle.h, from the formats' definitions, and by
 * tl_gbuffer_unpack, in float as kernels do. Both must be within tilelight/error_bounds.h of what was
 * packed, value by value; values beyond a layout's range are expected cut, and counted. */
#include "figures.h"
#include "layout_frames.h"
#include "layout_oracle.h"

#include "tilelight/error_bounds.h"

/* One pixel, and where to say that it is wrong. */
typedef struct spot {
    const char *camera;
    enum tl_layout_name layout;
    const tl_gbuffer *from;       /* what was packed */
    const tl_layout_errors *most; /* of this camera and layout */
    size_t at;
    uint32_t column, row;
} spot;

/* The largest error so far, as a share of its bound: a bound that nothing comes near would say nothing. */
static figure closest[TL_LAYOUT_COUNT][TL_PLANE_COUNT];

/* plane: the one that `what` is of. */
static void check(const spot *s,
                  const char *reader,
                  int plane,
                  const char *what,
                  wide got,
                  wide want,
                  wide bound)
{
    const wide error = fabsl(got - want);
    if (!(error <= bound))
        fail_msg("%s, %s, pixel (%u, %u), %s: %s %.9Lg, want %.9Lg within %.3Lg",
                 tl_layout_word(s->layout), s->camera, s->column, s->row, reader, what, got,
                 want, bound);
    if (bound > 0)
        figure_sees(&closest[s->layout][plane], (double)error, (double)bound,
                    "%s, pixel (%u, %u)", s->camera, s->column, s->row);
}

static wide value(const tl_gbuffer *g, int plane, size_t at)
{
    const float *values = tl_gbuffer_plane(g, (enum tl_plane)plane);
    return values ? (wide)values[at] : plane == TL_OCCLUSION ? 1 : 0;
}

static void three(const tl_gbuffer *g, int first, size_t at, wide out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = value(g, first + i, at);
}

static wide angle_between(const wide a[3], const wide b[3])
{
    wide across = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const wide c = a[j] * b[k] - a[k] * b[j];
        across += c * c;
        along += a[i] * b[i];
    }
    return atan2l(sqrtl(across), along);
}

static int is_zero(const wide v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/* --- depth and position ------------------------------------------------------------------------------ */

/* The pixel's ray in the floats that frames hold: x/depth and y/depth, or x and y. */
static void ray_of(const tl_camera *c, uint32_t column, uint32_t row, wide ray[2])
{
    const double dx = ((double)c->right - (double)c->left) / c->width;
    const double dy = ((double)c->bottom - (double)c->top) / c->height;
    ray[0] = (wide)(float)((double)c->left + 0.5 * dx) + (wide)column * (wide)(float)dx;
    ray[1] = (wide)(float)((double)c->top + 0.5 * dy) + (wide)row * (wide)(float)dy;
}

/* Whether a layout that stores positions as halves can say this one. In world space by the transpose: the
 * bound holds what the matrix lacks to a rotation. */
static int fits_half(const spot *s, const wide view[3])
{
    const tl_camera *c = &s->from->camera;
    const enum oracle_depth code = oracle_rows[s->layout].depth;
    if (code != IN_VIEW && code != IN_WORLD)
        return 1;
    for (int i = 0; i < 3; i++) {
        wide p = view[i];
        for (int j = 0; j < 3 && code == IN_WORLD; j++)
            p = (j ? p : 0) +
                (wide)c->view_from_world[j][i] * (view[j] - (wide)c->view_from_world[j][3]);
        if (fabsl(p) > 65504 && s->layout != TL_LAYOUT_FLOAT_POSITION)
            return 0;
    }
    return 1;
}

/* What a layout that stores depths cuts `depth` to. */
static wide depth_in_range(const spot *s, wide depth)
{
    const enum oracle_depth code = oracle_rows[s->layout].depth;
    double low, high;
    tl_layout_range(&s->from->camera, s->layout, TL_DEPTH, &low, &high);
    return isinf(depth) || code == IN_VIEW || code == IN_WORLD
               ? depth
               : fminl(fmaxl(depth, (wide)low), (wide)high);
}

/* A position that is stored as far from the world's origin as it is coarse may lie behind the eye. */
static int is_lost(const spot *s, wide depth, wide bound)
{
    return s->from->camera.projection == TL_PERSPECTIVE &&
           oracle_rows[s->layout].depth == IN_WORLD && bound >= depth;
}

/* Returns 0 where the pixel is lost: the rest of it is sky then. */
static int check_position(const spot *s,
                          const wide fields[F_COUNT],
                          wide unpacked,
                          tl_packing_report *counts)
{
    static const char *const axes[3] = {"x", "y", "z"};
    const tl_camera *c = &s->from->camera;
    const wide shown = value(s->from, TL_DEPTH, s->at), depth = depth_in_range(s, shown);
    const wide scale = c->projection == TL_ORTHOGRAPHIC ? 1 : depth;
    wide ray[2], got[3];
    double bound[3];
    ray_of(c, s->column, s->row, ray);
    oracle_position(c, oracle_rows[s->layout].depth, fields, ray, got);
    if (isinf(depth)) {
        if (!isinf(got[2]) || !isinf(unpacked))
            fail_msg("%s, pixel (%u, %u): sky became a surface", tl_layout_word(s->layout),
                     s->column, s->row);
        return 1;
    }
    const wide want[3] = {ray[0] * scale, ray[1] * scale, -depth};
    counts->cut[TL_DEPTH] += depth != shown || !fits_half(s, want);
    tl_position_bound(c, s->layout,
                      (double[3]){(double)want[0], (double)want[1], (double)want[2]}, bound);
    if (isinf(got[2]) && isinf(unpacked) && is_lost(s, depth, (wide)bound[2])) {
        counts->lost++;
        return 0;
    }
    if (isinf(got[2]) || isinf(unpacked))
        fail_msg("%s, %s, pixel (%u, %u): a surface at %.9Lg m became sky",
                 tl_layout_word(s->layout), s->camera, s->column, s->row, depth);
    if (!fits_half(s, want))
        return 1;
    for (int i = 0; i < 3; i++)
        check(s, "by definition", TL_DEPTH, axes[i], got[i], want[i], (wide)bound[i]);
    check(s, "unpacked", TL_DEPTH, "depth", unpacked, depth, (wide)bound[2]);
    return 1;
}

/* --- normals ------------------------------------------------------------------------------------------ */

/* What is said of a layout as a whole holds for each of its pixels. */
static void check_summary(const spot *s, const char *what, double bound, double most)
{
    if (bound > most * (1.0 + 1e-12))
        fail_msg("%s, %s, pixel (%u, %u): a bound of %.9g, where those of %s are at most %.9g",
                 tl_layout_word(s->layout), s->camera, s->column, s->row, bound, what, most);
}

static void check_normal(const spot *s, const wide fields[F_COUNT], const wide unpacked[3])
{
    const tl_camera *c = &s->from->camera;
    const int in_view = oracle_rows[s->layout].normals_in_view;
    wide want[3], seen[3], got[3];
    three(s->from, TL_NORMAL_X, s->at, want);
    oracle_turn(c, want, seen);
    oracle_normal(s->layout, fields, got);
    if (is_zero(want)) {
        if (!is_zero(got) || !is_zero(unpacked))
            fail_msg("%s, pixel (%u, %u): no normal became one", tl_layout_word(s->layout),
                     s->column, s->row);
        return;
    }
    const double bound = tl_normal_bound(
        c, s->layout, (double[3]){(double)want[0], (double)want[1], (double)want[2]});
    check_summary(s, "normals", bound, seen[2] >= 0 ? s->most->normal : s->most->any_normal);
    if (is_zero(got) || is_zero(unpacked))
        fail_msg("%s, pixel (%u, %u): a normal was lost", tl_layout_word(s->layout), s->column,
                 s->row);
    check(s, "by definition", TL_NORMAL_X, "angle of the normal",
          angle_between(got, in_view ? seen : want), 0, (wide)bound);
    check(s, "unpacked", TL_NORMAL_X, "angle of the normal", angle_between(unpacked, want), 0,
          (wide)bound);
}

/* --- values ------------------------------------------------------------------------------------------- */

static wide limit_of(const spot *s, int plane)
{
    double low, high;
    tl_layout_range(&s->from->camera, s->layout, (enum tl_plane)plane, &low, &high);
    return (wide)high;
}

/* Of a plane whose values are `values`, by the layout's summary. */
static double most_of(const spot *s, int plane, const double values[3])
{
    const tl_layout_errors *most = s->most;
    const double spread = fmax(values[0], fmax(values[1], values[2])) -
                          fmin(values[0], fmin(values[1], values[2]));
    if (plane <= TL_ALBEDO_B)
        return most->albedo;
    if (plane <= TL_SPECULAR_B)
        return most->specular + (most->specular_is_gray ? 0.5 * spread : 0.0);
    if (plane == TL_SHININESS)
        return most->shininess * (1.0 + values[0]);
    if (plane >= TL_EMISSIVE_R)
        return INFINITY; /* the summary is of one value */
    return plane == TL_METALLIC    ? most->metallic
           : plane == TL_ROUGHNESS ? most->roughness
                                   : most->occlusion;
}

/* want, got, unpacked: [count], of the planes from `plane` on. */
static void check_values(const spot *s,
                         int plane,
                         int count,
                         const wide *want,
                         const wide *got,
                         const wide *unpacked)
{
    static const char *const names[] = {
#define CHANNEL_NAME(name, channel, empty, meaning) channel,
        TL_PLANES(CHANNEL_NAME)
#undef CHANNEL_NAME
    };
    double cut[3] = {0.0};
    for (int i = 0; i < count; i++)
        cut[i] = (double)fminl(want[i], limit_of(s, plane + i));
    for (int i = 0; i < count; i++) {
        const wide bound = (wide)tl_value_bound(s->layout, (enum tl_plane)(plane + i), cut);
        check_summary(s, names[plane + i], (double)bound, most_of(s, plane + i, cut));
        check(s, "by definition", plane + i, names[plane + i], got[i], (wide)cut[i], bound);
        check(s, "unpacked", plane + i, names[plane + i], unpacked[i], (wide)cut[i], bound);
    }
}

/* What is packed of a metal-rough surface where only Phong fits: docs/conventions.md. */
static void map_to_phong(
    wide albedo[3], wide specular[3], wide *exponent, wide metal, wide rough)
{
    for (int i = 0; i < 3; i++) {
        specular[i] = 0.04L + metal * (albedo[i] - 0.04L);
        albedo[i] *= 1 - metal;
    }
    *exponent = fminl(2 / fmaxl(rough * rough * rough * rough, 0.0001999600L) - 2, 10000);
}

static void check_materials(const spot *s,
                            const tl_gbuffer *packed,
                            const wide f[F_COUNT],
                            const tl_gbuffer *unpacked)
{
    const oracle_row *row = &oracle_rows[s->layout];
    const int is_mapped =
        (s->from->present & TL_GROUP_METAL_ROUGH) && !(packed->present & TL_GROUP_METAL_ROUGH);
    wide want[3], specular[3], got[3], read[3];
    wide exponent = value(s->from, TL_SHININESS, s->at);
    const wide metal = value(s->from, TL_METALLIC, s->at),
               rough = value(s->from, TL_ROUGHNESS, s->at);
    three(s->from, TL_ALBEDO_R, s->at, want);
    three(s->from, TL_SPECULAR_R, s->at, specular);
    if (is_mapped && !isinf(value(s->from, TL_DEPTH, s->at)))
        map_to_phong(want, specular, &exponent, metal, rough);
    three(unpacked, TL_ALBEDO_R, s->at, read);
    oracle_color(row->albedo, &f[F_ar], got);
    check_values(s, TL_ALBEDO_R, 3, want, got, read);
    if (packed->present & TL_THREE(TL_SPECULAR_R)) {
        three(unpacked, TL_SPECULAR_R, s->at, read);
        oracle_color(row->specular, &f[F_sr], got);
        check_values(s, TL_SPECULAR_R, 3, specular, got, read);
    }
    if (packed->present & TL_HAS(TL_SHININESS)) {
        const wide decoded = oracle_exponent(row->exponent, f[F_exponent]);
        const wide as_read = value(unpacked, TL_SHININESS, s->at);
        check_values(s, TL_SHININESS, 1, &exponent, &decoded, &as_read);
    }
    if (packed->present & TL_GROUP_METAL_ROUGH) {
        const wide as_read[2] = {value(unpacked, TL_METALLIC, s->at),
                                 value(unpacked, TL_ROUGHNESS, s->at)};
        check_values(s, TL_METALLIC, 1, &metal, &f[F_metal], &as_read[0]);
        check_values(s, TL_ROUGHNESS, 1, &rough, &f[F_rough], &as_read[1]);
    }
}

/* Emission that is beyond the layout's range is counted, per channel. */
static void check_others(const spot *s,
                         const tl_gbuffer *packed,
                         const wide f[F_COUNT],
                         const tl_gbuffer *unpacked,
                         tl_packing_report *counts)
{
    wide want[3], got[3], read[3];
    if (packed->present & TL_GROUP_OCCLUSION) {
        const wide ao = value(s->from, TL_OCCLUSION, s->at),
                   as_read = value(unpacked, TL_OCCLUSION, s->at);
        check_values(s, TL_OCCLUSION, 1, &ao, &f[F_ao], &as_read);
    }
    if (packed->present & TL_GROUP_EMISSIVE) {
        three(s->from, TL_EMISSIVE_R, s->at, want);
        three(unpacked, TL_EMISSIVE_R, s->at, read);
        oracle_color(oracle_rows[s->layout].emissive, &f[F_er], got);
        check_values(s, TL_EMISSIVE_R, 3, want, got, read);
        for (int i = 0; i < 3; i++)
            counts->cut[TL_EMISSIVE_R + i] +=
                want[i] > 1.00001L * limit_of(s, TL_EMISSIVE_R + i);
    }
}

/* In world space; 0 stays 0. */
static void check_tangent(const spot *s, const char *reader, const wide got[3])
{
    wide want[3];
    three(s->from, TL_TANGENT_X, s->at, want);
    const int is_none = is_zero(want);
    if (is_none != is_zero(got))
        fail_msg("%s, %s, pixel (%u, %u), %s: a tangent where none is, or none where one is",
                 tl_layout_word(s->layout), s->camera, s->column, s->row, reader);
    if (is_none)
        return;
    const double given[3] = {(double)want[0], (double)want[1], (double)want[2]};
    check(s, reader, TL_TANGENT_X, "tangent off by", angle_between(got, want), 0,
          (wide)tl_tangent_bound(s->layout, given));
}

static void check_rows_of_materials(const spot *s,
                                    const tl_gbuffer *packed,
                                    const wide f[F_COUNT],
                                    const tl_gbuffer *unpacked)
{
    if (packed->present & TL_GROUP_BRDF) {
        const wide index = value(s->from, TL_BRDF, s->at),
                   as_read = value(unpacked, TL_BRDF, s->at);
        check_values(s, TL_BRDF, 1, &index, &f[F_bi], &as_read);
    }
    if (packed->present & TL_GROUP_TANGENT) {
        wide got[3] = {f[F_tx], f[F_ty], f[F_tz]}, read[3];
        if (oracle_rows[s->layout].normal == OCTAHEDRON)
            oracle_octahedron(&f[F_tx], got);
        three(unpacked, TL_TANGENT_X, s->at, read);
        check_tangent(s, "by definition", got);
        check_tangent(s, "unpacked", read);
    }
}

/* --- frames ------------------------------------------------------------------------------------------- */

static void check_pixel(const spot *s,
                        const tl_gbuffer *packed,
                        const tl_gbuffer *unpacked,
                        tl_packing_report *counts)
{
    wide fields[F_COUNT], normal[3];
    const uint32_t bits = oracle_read(packed, s->at, fields);
    if (bits != 8 * tl_gbuffer_pixel_size(packed))
        fail_msg("%s: %u bits per pixel by its formats, %u bytes in memory",
                 tl_layout_word(s->layout), bits, tl_gbuffer_pixel_size(packed));
    three(unpacked, TL_NORMAL_X, s->at, normal);
    if (!check_position(s, fields, value(unpacked, TL_DEPTH, s->at), counts))
        return;
    check_normal(s, fields, normal);
    check_materials(s, packed, fields, unpacked);
    check_others(s, packed, fields, unpacked, counts);
    check_rows_of_materials(s, packed, fields, unpacked);
}

static void assert_same_counts(const tl_packing_report *got,
                               const tl_packing_report *want,
                               const char *camera,
                               enum tl_layout_name layout)
{
    for (int p = 0; p < TL_PLANE_COUNT; p++)
        if (got->cut[p] != want->cut[p])
            fail_msg("%s, %s: %llu values of plane %d were cut, %llu are beyond the range",
                     tl_layout_word(layout), camera, (unsigned long long)got->cut[p], p,
                     (unsigned long long)want->cut[p]);
    if (got->lost != want->lost)
        fail_msg("%s, %s: %llu pixels were lost, %llu are sky", tl_layout_word(layout), camera,
                 (unsigned long long)got->lost, (unsigned long long)want->lost);
}

static void round_trip(const tl_gbuffer *from, const char *camera, enum tl_layout_name layout)
{
    tl_gbuffer *packed = NULL, *unpacked = NULL;
    const tl_layout_errors most = tl_layout_errors_of(&from->camera, layout);
    tl_packing_report report, counts = {0};
    tl_error err;
    ASSERT_OK(tl_gbuffer_pack(from, layout, &packed, &report, &err), err);
    ASSERT_OK(tl_gbuffer_unpack(packed, &unpacked, &err), err);
    for (uint32_t i = 0; i < HARD_PIXELS; i++) {
        const uint32_t column = i % HARD_COLUMNS, row = i / HARD_COLUMNS;
        const spot s = {camera, layout, from, &most, (size_t)row * from->pitch + column,
                        column, row};
        check_pixel(&s, packed, unpacked, &counts);
    }
    assert_same_counts(&report, &counts, camera, layout);
    tl_gbuffer_destroy(unpacked);
    tl_gbuffer_destroy(packed);
}

static int can_say(const tl_camera *camera, enum tl_layout_name layout, uint32_t present)
{
    const int shares =
        oracle_rows[layout].depth == FRACTION ||
        (camera->projection == TL_ORTHOGRAPHIC && oracle_rows[layout].depth >= FORWARD &&
         oracle_rows[layout].depth <= REVERSED);
    const int has_phong = (tl_layout_planes(layout) & TL_GROUP_PHONG) != 0 ||
                          !(tl_layout_planes(layout) & TL_GROUP_METAL_ROUGH);
    return !(isinf(camera->far) && shares) && (has_phong || !(present & TL_GROUP_PHONG));
}

static void every_layout(uint32_t present)
{
    for (size_t c = 0; c < COUNT_OF(hard_cameras); c++) {
        const tl_camera camera = hard_camera(c);
        tl_gbuffer *from = hard_layout_frame(&camera, present, 2003 + (uint32_t)c);
        for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
            if (can_say(&camera, (enum tl_layout_name)layout, present))
                round_trip(from, hard_cameras[c].name, (enum tl_layout_name)layout);
        tl_gbuffer_destroy(from);
    }
}

static void every_layout_of_phong(void **state)
{
    (void)state;
    every_layout(TL_GROUP_BASE | TL_GROUP_PHONG | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE |
                 TL_GROUP_BRDF | TL_GROUP_TANGENT);
}

static void every_layout_of_metal(void **state)
{
    (void)state;
    every_layout(TL_GROUP_BASE | TL_GROUP_METAL_ROUGH | TL_GROUP_OCCLUSION | TL_GROUP_EMISSIVE);
}

static void every_layout_of_the_least(void **state)
{
    (void)state;
    every_layout(TL_GROUP_BASE);
}

/* Whether a layout has a bound above 0 for a plane, of values in the middle of its range. */
static int is_lossy(enum tl_layout_name layout, enum tl_plane plane)
{
    static const double half[3] = {0.5, 0.5, 0.5}, view[3] = {0.1, 0.2, -1.0};
    const tl_camera camera = hard_camera(0);
    double position[3];
    tl_position_bound(&camera, layout, view, position);
    if (!(tl_layout_planes(layout) >> plane & 1u) || plane == TL_NORMAL_Y ||
        plane == TL_NORMAL_Z || plane == TL_TANGENT_Y || plane == TL_TANGENT_Z)
        return 0;
    if (plane == TL_TANGENT_X)
        return tl_tangent_bound(layout, half) > 0.0;
    return (plane == TL_DEPTH      ? position[2]
            : plane == TL_NORMAL_X ? tl_normal_bound(&camera, layout, half)
                                   : tl_value_bound(layout, plane, half)) > 0.0;
}

/* Comes after the others: every bound is at most twice what was seen. */
static void no_bound_is_idle(void **state)
{
    (void)state;
    for (int layout = 0; layout < TL_LAYOUT_COUNT; layout++)
        for (int p = 0; p < TL_PLANE_COUNT; p++)
            if (is_lossy((enum tl_layout_name)layout, (enum tl_plane)p) &&
                !(closest[layout][p].worst >= 0.5 * closest[layout][p].bound))
                fail_msg("%s, plane %d: errors reach %.3g of a bound of %.3g",
                         tl_layout_word((enum tl_layout_name)layout), p,
                         closest[layout][p].worst, closest[layout][p].bound);
}

/* One of each format and code. */
static const struct {
    const char *formula;
    enum tl_layout_name layout;
    enum tl_plane plane;
    const char *quantity, *parts;
} shown[] = {
    {"depth in float24", TL_LAYOUT_COMPACT_12, TL_DEPTH, "m, stored and read", "two roundings"},
    {"position in halves", TL_LAYOUT_SHADERX2_128, TL_DEPTH, "m, stored and read",
     "two roundings, turn to the view"},
    {"normal in 3 x 10 bits", TL_LAYOUT_SHADERX2_128, TL_NORMAL_X, "rad, stored and read",
     "half a step each"},
    {"normal in 3 x 10 signed bits", TL_LAYOUT_SHADERX2_128_S10, TL_NORMAL_X,
     "rad, stored and read", "half a step each"},
    {"normal in 3 x 8 bits", TL_LAYOUT_SHADERX2_128_U8, TL_NORMAL_X, "rad, stored and read",
     "half a step each"},
    {"normal in halves", TL_LAYOUT_SHADERX2_160, TL_NORMAL_X, "rad, stored and read",
     "two roundings each"},
    {"octahedron of 2 x 16 bits", TL_LAYOUT_COMPACT_16, TL_NORMAL_X, "rad, stored and read",
     "a triangle's corner; reading"},
    {"octahedron of 2 x 12 bits", TL_LAYOUT_COMPACT_12, TL_NORMAL_X, "rad, stored and read",
     "a triangle's corner; reading"},
    {"spheremap of 2 halves", TL_LAYOUT_ISPC, TL_NORMAL_X, "rad, stored and read",
     "two roundings each, steep at the rim; reading"},
    {"color in 8 bits", TL_LAYOUT_TUTORIAL, TL_ALBEDO_R, "stored and read", "half a step"},
    {"root of a color in 8 bits", TL_LAYOUT_COMPACT_16, TL_ALBEDO_R, "stored and read",
     "half a step, squared"},
    {"grey of a color in 8 bits", TL_LAYOUT_COMPACT_12, TL_SPECULAR_R, "stored and read",
     "half the spread, half a step"},
    {"exponent's logarithm in 8 bits", TL_LAYOUT_TUTORIAL, TL_SHININESS, "stored and read",
     "half a step, a factor of 1 + e; reading"},
    {"exponent in half", TL_LAYOUT_ISPC, TL_SHININESS, "stored and read", "two roundings"},
    {"roughness in 16 bits", TL_LAYOUT_COMPACT_16, TL_ROUGHNESS, "stored and read",
     "half a step"},
    {"emission in RGB9E5", TL_LAYOUT_COMPACT_16, TL_EMISSIVE_R, "stored and read",
     "half a unit of the shared exponent"},
};

static void what_was_seen_is_told(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(shown); i++) {
        figure f = closest[shown[i].layout][shown[i].plane];
        f.section = "encodings";
        f.formula = shown[i].formula;
        f.file = "host/gbuffer/error_bounds.c";
        f.quantity = shown[i].quantity;
        f.unit = "";
        f.parts = shown[i].parts;
        figure_report(&f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_layout_of_phong),     cmocka_unit_test(every_layout_of_metal),
        cmocka_unit_test(every_layout_of_the_least), cmocka_unit_test(no_bound_is_idle),
        cmocka_unit_test(what_was_seen_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
