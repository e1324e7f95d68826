/* Ambient light that what stands around a pixel keeps from it: which share of it arrives.
 *
 * Horizon-based ambient occlusion with the cosine in closed form: Jimenez, Wu, Pesce, Jarabo, "Practical
 * Realtime Strategies for Accurate Indirect Occlusion" (GTAO), 2016. The hemisphere over a pixel is cut
 * into slices, planes through the eye; in a slice, to either side, the picture's surfaces hide all
 * directions from the plane of the pixel up to the highest of them, its horizon.
 *
 * Their equation 7 gives what is left of a slice by the angles of both horizons from the eye. Here it is
 * what is lost, by the angle b of a horizon over the pixel's own plane, because that is exactly 0 where
 * nothing rises above it. v: towards the eye; s: the unit vector in the slice at right angles to it, to one
 * side; n: the normal; c = n.v, q = n.s, so (c, q) is the normal in the slice, g = atan2(q, c) its angle
 * from the eye:
 *
 *     all of a slice   c + q g
 *     lost on the side of s     (c sin^2 b + q (b - sin b cos b)) / 2
 *     lost on the other side    the same of -q
 *
 * Both are their integral of cos(a) |sin(a + g)| over a, the angle from the normal, times the length of (c,
 * q); a horizon is not beyond the eye: b <= pi/2 + g. What arrives is 1 - sum of what is lost / sum of all:
 * they divide by the slices' number, which is exact for many slices, this for a plane in any number.
 *
 * A sample d away: over the plane by h = n.d, along it by a = m.d, m = s c - v q, both times the same
 * length, so cos b = a / sqrt(h^2 + a^2). Samples are centres of pixels, not quite in their slice; h is of
 * the sample's own place, so that a plane has none above itself. Places are off by rounding and by what the
 * layout drops, and h is lessened by both.
 *
 * A sample counts by 1 - (d/radius)^4, the window that lights with a range have, as a share of 1 - cos b:
 * what enters the radius does so without a step. Asserted by tests/test_occlusion_formulas.c. */
#ifndef TL_OCCLUSION_H
#define TL_OCCLUSION_H

#include "position.h"
#include "texture.h"

#ifdef __OPENCL_C_VERSION__
#    include "block.h"
/* A block of a plane of floats. */
#    define FLOATS_OF_BLOCK(from, pitch) \
        WORD_AS_REAL(load_ints((__global const uchar *)(from), pitch))
#else
#    define FLOATS_OF_BLOCK(from, pitch) ((void)(pitch), (real) * (from))
#endif

/* Planes of floats behind the sections of the lights, [TL_AROUND_COUNT][rows][pitch] with TL_AROUND_MARGIN
 * floats of anything before and behind, for what is read across the picture's edges and not used. They are
 * filled in whole patches, and pixels lie in vectors as runs of a row: what smoothing reads around each is
 * then one load, of blocks of rows it is four and three shuffles. */
enum tl_around_plane {
    TL_AROUND_SHARE,    /* of ambient light: what shading multiplies with */
    TL_AROUND_DEPTH,    /* m along the view axis; +infinity is sky */
    TL_AROUND_NORMAL_X, /* view space, unit or 0 */
    TL_AROUND_NORMAL_Y,
    TL_AROUND_NORMAL_Z,
    TL_AROUND_ROUGH, /* the share before it is smoothed */
    TL_AROUND_COUNT
};
#define TL_AROUND_MARGIN(pitch) (2 * (size_t)(pitch) + 64)
#define TL_PATCH_COLUMNS 64 /* px: pitch is a multiple of it, rows of TL_PATCH_ROWS */
#define TL_PATCH_ROWS 16
#define TL_PATCHES(extent, side) (((extent) + (side)-1) / (side))

/* Pixels that patches cover, more than the picture has by sky alone. */
TL_INLINE tl_u32 around_width(const tl_frame *frame)
{
    return TL_PATCHES(frame->tiles_x * frame->tile_size, TL_PATCH_COLUMNS) * TL_PATCH_COLUMNS;
}

TL_INLINE tl_u32 around_height(const tl_frame *frame)
{
    return TL_PATCHES(frame->tiles_y * frame->tile_size, TL_PATCH_ROWS) * TL_PATCH_ROWS;
}

/* What is not sampled farther away, px: what would be is cut, and the radius with it. */
#define TL_MOST_OCCLUSION_REACH 256

/* Pixels of TL_PATTERN x TL_PATTERN take turns: no two have the same slices and steps. */
#define TL_PATTERN 4
#define TL_PATTERN_CELLS (TL_PATTERN * TL_PATTERN)

typedef struct around_view {
    tl_view_surroundings of;
    tl_numbers planes; /* TL_AROUND_SHARE's first pixel */
    tl_numbers
        directions;   /* [slices][2][TL_PATTERN_CELLS]: px right, px down, of 1 px across */
    tl_numbers steps; /* [slices][steps][TL_PATTERN_CELLS]: shares of the reach */
} around_view;

/* numbers: the buffer of lights. */
TL_INLINE around_view around_behind(const tl_frame *frame, tl_numbers numbers)
{
    around_view a;
    const size_t at = (size_t)frame->surroundings_at * (TL_SECTION_ROW / 4);
    a.of = *(TL_GLOBAL const tl_view_surroundings *)(numbers + at);
    a.planes = numbers + (size_t)a.of.planes_at * (TL_SECTION_ROW / 4) +
               TL_AROUND_MARGIN(frame->pitch);
    a.directions = numbers + (size_t)a.of.table_at * (TL_SECTION_ROW / 4);
    a.steps = a.directions + a.of.slices * 2 * TL_PATTERN_CELLS;
    return a;
}

TL_INLINE tl_numbers around_plane(const tl_frame *frame,
                                  around_view a,
                                  enum tl_around_plane plane)
{
    return a.planes + (size_t)plane * a.of.rows * frame->pitch;
}

TL_INLINE vec3 around_normal(const tl_frame *frame, around_view a, size_t at)
{
    const vec3 n = {LOAD(around_plane(frame, a, TL_AROUND_NORMAL_X), at),
                    LOAD(around_plane(frame, a, TL_AROUND_NORMAL_Y), at),
                    LOAD(around_plane(frame, a, TL_AROUND_NORMAL_Z), at)};
    return n;
}

/* What shading multiplies ambient light with: `occlusion` of the pixel's own, times what stands around. at:
 * the block's first pixel in the whole picture's planes. */
TL_INLINE real ambient_share(
    const tl_frame *frame, tl_needs needs, tl_numbers numbers, real occlusion, size_t at)
{
    if (!needs.surroundings)
        return occlusion;
    return occlusion * FLOATS_OF_BLOCK(around_behind(frame, numbers).planes + at, frame->pitch);
}

/* A pixel as its surroundings are looked for. */
typedef struct sheltered {
    vec3 position, normal, to_eye;
    integer column, row, cell;
    real depth;
    real facing;      /* c: n.v, 0 where the normal is turned away */
    real reach;       /* px, a float in every precision */
    real per_radius2; /* 1/m^2, of the radius that reaches so far */
    real slack;       /* m that its own place may be off */
} sheltered;

TL_INLINE real place_slack(tl_view_surroundings of, real depth)
{
    return FMA(FMA((real)of.slack_per_depth2, depth, of.slack_per_depth), depth, of.slack);
}

/* Which pixels are sampled must not hang on the precision: what decides that is rounded to float. */
TL_INLINE sheltered sheltered_at(const tl_frame *frame,
                                 tl_needs needs,
                                 around_view a,
                                 real depth,
                                 vec3 normal,
                                 real column,
                                 real row)
{
    sheltered p;
    p.position = view_position(frame->rays, needs, column, row, depth);
    p.normal = normal;
    p.to_eye = direction_to_eye(needs, p.position);
    p.column = TO_INTEGER(column);
    p.row = TO_INTEGER(row);
    p.cell = (p.row & (TL_PATTERN - 1)) * TL_PATTERN + (p.column & (TL_PATTERN - 1));
    p.depth = depth;
    const real facing = dot3(normal, p.to_eye);
    p.facing = pick(facing > R(0.0), facing, R(0.0));
    const real scale = needs.orthographic ? (real)R(1.0) : depth;
    const real wanted = NARROW(a.of.reach / scale), most = (real)a.of.most_reach;
    const mask is_cut = wanted > most;
    const real radius = pick(is_cut, a.of.radius * (most / wanted), (real)a.of.radius);
    p.reach = pick(is_cut, most, wanted);
    p.per_radius2 = R(1.0) / (radius * radius);
    p.slack = place_slack(a.of, depth);
    return p;
}

/* A slice through a pixel, by one side of it; of the other along and across are the negatives. */
typedef struct slice_side {
    vec3 along;  /* m */
    real across; /* q */
} slice_side;

TL_INLINE slice_side slice_of(const tl_frame *frame, sheltered p, real right, real down)
{
    const vec3 on_screen = {right * frame->rays.dx, down * frame->rays.dy, (real)R(0.0)};
    const vec3 s = unit3(fma3(p.to_eye, -dot3(on_screen, p.to_eye), on_screen));
    slice_side of;
    of.across = dot3(p.normal, s);
    const vec3 bent = {s.x * p.facing, s.y * p.facing, s.z * p.facing};
    of.along = fma3(p.to_eye, -of.across, bent);
    return of;
}

/* 1 - cos b of a sample, times its window; 0 of what is below the plane, too far, sky, or outside. */
TL_INLINE real rise_of(vec3 from, sheltered p, vec3 along, real slack)
{
    const real h = dot3(p.normal, from) - slack;
    const real a = dot3(along, from);
    const real share = dot3(from, from) * p.per_radius2;
    const real window = FMA(-share, share, R(1.0));
    const real rise = window * (R(1.0) - a / SQRT(FMA(h, h, a * a)));
    return pick((h > R(0.0)) & (window > R(0.0)), rise, R(0.0));
}

/* The rise of pixel (x, y) seen from p. */
TL_INLINE real rise_at(const tl_frame *frame,
                       tl_needs needs,
                       around_view a,
                       sheltered p,
                       vec3 along,
                       integer x,
                       integer y)
{
    const integer width = (integer)around_width(frame);
    const integer height = (integer)around_height(frame);
    const mask inside = (x >= 0) & (x < width) & (y >= 0) & (y < height);
    const integer column = inside ? x : p.column, row = inside ? y : p.row;
    const real depth =
        GATHER(around_plane(frame, a, TL_AROUND_DEPTH), row * (integer)frame->pitch + column);
    const vec3 at = view_position(frame->rays, needs, TO_REAL(column), TO_REAL(row), depth);
    const vec3 from = {at.x - p.position.x, at.y - p.position.y, at.z - p.position.z};
    return rise_of(from, p, along, p.slack + place_slack(a.of, depth));
}

/* Of 1 - cos b on the side of q: twice what is lost. */
TL_INLINE real lost_on_side(real rise, real facing, real across)
{
    const real length = SQRT(FMA(facing, facing, across * across));
    const real at_eye = R(1.0) + pick(length > R(0.0), across / length, R(0.0));
    const real r = pick(rise < at_eye, rise, at_eye);
    const real cosine = R(1.0) - r, sine2 = r * (R(2.0) - r);
    const real sine = SQRT(pick(sine2 > R(0.0), sine2, R(0.0)));
    const real angle = longitude_of(sine, cosine) * R(6.2831853071795865);
    const real lost = FMA(facing, sine2, across * FMA(-sine, cosine, angle));
    return pick(lost > R(0.0), lost, R(0.0));
}

/* Half the width of a sample's number, so that it is truncated to the nearest pixel. */
#define TL_SAMPLE_OFFSET (TL_MOST_OCCLUSION_REACH * 2)

TL_INLINE integer nearest_pixel(real offset)
{
    return TO_INTEGER(NARROW(offset + R(0.5) + (real)TL_SAMPLE_OFFSET)) - TL_SAMPLE_OFFSET;
}

/* The horizon on one side of a slice so far: the highest rise, the distance at which it is, px, and those
 * of the looks before and behind it. */
typedef struct horizon {
    real rise, near, at, far;
} horizon;

/* Where a slice is walked along: away from the pixel, by `right` and `down` px a px. */
typedef struct way_out {
    vec3 along;
    real right, down;
} way_out;

TL_INLINE real rise_along(const tl_frame *frame,
                          tl_needs needs,
                          around_view a,
                          sheltered p,
                          way_out path,
                          real distance)
{
    const integer x = nearest_pixel(NARROW(path.right * distance));
    const integer y = nearest_pixel(NARROW(path.down * distance));
    return rise_at(frame, needs, a, p, path.along, p.column + x, p.row + y);
}

/* With a look farther than all before it. */
TL_INLINE horizon raised(horizon so_far, real rise, real near, real at, real far)
{
    const mask higher = rise > so_far.rise;
    const horizon h = {pick(higher, rise, so_far.rise), pick(higher, near, so_far.near),
                       pick(higher, at, so_far.at), pick(higher, far, so_far.far)};
    return h;
}

/* With a look halfway to the one before the highest, and one to that behind: an edge is between two of
 * them. */
TL_INLINE horizon halved(
    const tl_frame *frame, tl_needs needs, around_view a, sheltered p, way_out path, horizon h)
{
    const real nearer = NARROW(R(0.5) * (h.near + h.at));
    const real rise = rise_along(frame, needs, a, p, path, nearer);
    const mask is_nearer = rise > h.rise;
    h.rise = pick(is_nearer, rise, h.rise);
    h.near = pick(is_nearer, h.near, nearer);
    h.far = pick(is_nearer, h.at, h.far);
    h.at = pick(is_nearer, nearer, h.at);
    const real farther = NARROW(R(0.5) * (h.at + h.far));
    const real other = rise_along(frame, needs, a, p, path, farther);
    const mask is_farther = other > h.rise;
    h.rise = pick(is_farther, other, h.rise);
    h.near = pick(is_farther, h.at, h.near);
    h.far = pick(is_farther, h.far, farther);
    h.at = pick(is_farther, farther, h.at);
    return h;
}

/* How far away look `index` is, px: no less than a pixel more than the one before, so that each sees
 * another. */
TL_INLINE real look_distance(tl_numbers steps, around_view a, sheltered p, tl_u32 index)
{
    const real least = (real)(scalar)(index + 1);
    const real wanted = index < a.of.steps
                            ? NARROW(GATHER(steps + index * TL_PATTERN_CELLS, p.cell) * p.reach)
                            : p.reach;
    return pick(wanted > least, wanted, least);
}

/* What is lost and all there is, of the slices so far. */
typedef struct shelter {
    real lost, all;
} shelter;

TL_INLINE shelter add_slice(shelter sum,
                            const tl_frame *frame,
                            tl_needs needs,
                            around_view a,
                            sheltered p,
                            tl_u32 index)
{
    const tl_numbers directions = a.directions + index * 2 * TL_PATTERN_CELLS;
    const tl_numbers steps = a.steps + index * a.of.steps * TL_PATTERN_CELLS;
    const real right = GATHER(directions, p.cell);
    const real down = GATHER(directions + TL_PATTERN_CELLS, p.cell);
    const slice_side of = slice_of(frame, p, right, down);
    const way_out one = {of.along, right, down};
    const way_out other = {{-of.along.x, -of.along.y, -of.along.z}, -right, -down};
    real near = R(1.0), at = look_distance(steps, a, p, 0);
    horizon ahead = {R(0.0), near, near, near}, behind = ahead;
    for (tl_u32 i = 0; i < a.of.steps; i++) {
        const real far = look_distance(steps, a, p, i + 1);
        ahead = raised(ahead, rise_along(frame, needs, a, p, one, at), near, at, far);
        behind = raised(behind, rise_along(frame, needs, a, p, other, at), near, at, far);
        near = at;
        at = far;
    }
    for (tl_u32 i = 0; i < a.of.halvings; i++) {
        ahead = halved(frame, needs, a, p, one, ahead);
        behind = halved(frame, needs, a, p, other, behind);
    }
    const real angle = longitude_of(of.across, p.facing) * R(6.2831853071795865);
    sum.lost = sum.lost + R(0.5) * (lost_on_side(ahead.rise, p.facing, of.across) +
                                    lost_on_side(behind.rise, p.facing, -of.across));
    sum.all = sum.all + FMA(of.across, angle, p.facing);
    return sum;
}

/* The share that arrives, before it is smoothed. 1 of sky, and of what has no normal. */
TL_INLINE real rough_share(const tl_frame *frame,
                           tl_needs needs,
                           around_view a,
                           real depth,
                           vec3 normal,
                           real column,
                           real row)
{
    const sheltered p = sheltered_at(frame, needs, a, depth, normal, column, row);
    shelter sum = {R(0.0), R(0.0)};
    for (tl_u32 i = 0; i < a.of.slices; i++)
        sum = add_slice(sum, frame, needs, a, p, i);
    const real share = R(1.0) - sum.lost / sum.all;
    const real kept = pick(share > R(0.0), share, R(0.0));
    return pick((depth < (real)INFINITY) & (sum.all > R(0.0)), kept, R(1.0));
}

/* Smoothing: the mean over TL_PATTERN x TL_PATTERN pixels and the half of those around, in which each cell
 * of the pattern has the same weight, so that what the pattern does to a surface vanishes. A pixel counts
 * by how far it is over or under the plane of this one, and this one over or under its: 1 - (h c / l)^2 of
 * the larger h c, h that height, c the cosine of its plane to the eye, l how far apart pixels are across
 * the view. h c is what is seen of the step between the planes: one as deep as pixels are apart has no
 * weight, whatever its slope. */
TL_INLINE real seen_step(vec3 from, vec3 normal, vec3 to_eye, real slack)
{
    const real height = ABSOLUTE(dot3(normal, from)) - slack;
    return pick(height > R(0.0), height, R(0.0)) * ABSOLUTE(dot3(normal, to_eye));
}

TL_INLINE real
tap_weight(vec3 from, vec3 normal, vec3 other, vec3 to_eye, real slack, real per_apart2)
{
    const real own = seen_step(from, normal, to_eye, slack);
    const real its = seen_step(from, other, to_eye, slack);
    const real step = pick(own > its, own, its);
    const real weight = FMA(-step * step, per_apart2, R(1.0));
    return pick(weight > R(0.0), weight, R(0.0));
}

/* 1/m^2, of the square of how far apart pixels are that are (x, y) apart in the picture, 1 m away. */
TL_INLINE scalar per_apart2_at_1m(tl_rays rays, int x, int y)
{
    const scalar right = (scalar)x * rays.dx, down = (scalar)y * rays.dy;
    return R(1.0) / (right * right + down * down);
}

/* What of the mean a pixel (x, y) away has. */
TL_INLINE scalar tent_at(int x, int y)
{
    return (x == -2 || x == 2 ? R(0.5) : R(1.0)) * (y == -2 || y == 2 ? R(0.5) : R(1.0));
}

/* at: the run's first pixel in the planes; (column, row): its pixels'. */
TL_INLINE real smooth_share(
    const tl_frame *frame, tl_needs needs, around_view a, size_t at, real column, real row)
{
    const tl_u32 pitch = frame->pitch;
    const real width = (real)(scalar)around_width(frame);
    const real height = (real)(scalar)around_height(frame);
    const tl_numbers depths = around_plane(frame, a, TL_AROUND_DEPTH);
    const tl_numbers rough = around_plane(frame, a, TL_AROUND_ROUGH);
    const real depth = LOAD(depths, at);
    const vec3 normal = around_normal(frame, a, at);
    const vec3 position = view_position(frame->rays, needs, column, row, depth);
    const vec3 to_eye = direction_to_eye(needs, position);
    const real slack = place_slack(a.of, depth);
    const real scale = needs.orthographic ? (real)R(1.0) : R(1.0) / (depth * depth);
    real sum = LOAD(rough, at), weights = R(1.0);
    for (int y = -TL_PATTERN / 2; y <= TL_PATTERN / 2; y++) {
        for (int x = -TL_PATTERN / 2; x <= TL_PATTERN / 2; x++) {
            if (x == 0 && y == 0)
                continue;
            const long to = (long)at + (long)y * (long)pitch + x;
            const real its_column = column + (real)(scalar)x, its_row = row + (real)(scalar)y;
            const mask inside = (its_column >= R(0.0)) & (its_column < width) &
                                (its_row >= R(0.0)) & (its_row < height);
            const real its_depth = LOAD(depths, to);
            const vec3 its_normal = around_normal(frame, a, (size_t)to);
            const vec3 its = view_position(frame->rays, needs, its_column, its_row, its_depth);
            const vec3 from = {its.x - position.x, its.y - position.y, its.z - position.z};
            const real alike = tap_weight(from, normal, its_normal, to_eye,
                                          slack + place_slack(a.of, its_depth),
                                          scale * per_apart2_at_1m(frame->rays, x, y));
            const real weight = alike * tent_at(x, y);
            const mask counts = inside & (its_depth < (real)INFINITY);
            const real tap = LOAD(rough, to);
            sum = pick(counts, FMA(weight, tap, sum), sum);
            weights = pick(counts, weights + weight, weights);
        }
    }
    return sum / weights;
}

#endif
