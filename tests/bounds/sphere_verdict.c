#include "bounds/sphere_verdict.h"

#include "oracle/sphere.h"

#include <math.h>

/* One axis: where the sphere is, in pixels, and what is kept of it. */
typedef struct axis {
    wide from, to;         /* of the interval */
    wide from_off, to_off; /* what the oracle may be off by, px */
    uint32_t count, first, end;
    int off;     /* for sure it does not meet the image */
    int touches; /* it may meet it or not */
} axis;

static wide larger_of(wide a, wide b)
{
    return a > b ? a : b;
}

/* What doubles and the oracle may be off by at an edge, where the end of the interval is. A sphere between
 * the planes of parallel rays ends at c - r and c + r: what a double holds of these is exact on both
 * sides. */
static wide slack_of(const tl_sphere_case *of, wide end, wide end_off, wide edge)
{
    const float depth = -of->center[2];
    const int is_sum = of->camera.projection == TL_ORTHOGRAPHIC && depth >= of->camera.near &&
                       depth <= of->camera.far;
    return is_sum && end == (double)end ? 0 : 14 * 0x1p-53Q * fabsq(edge) + end_off;
}

static axis axis_of(const tl_sphere_case *of, int vertical)
{
    const tl_camera *c = &of->camera;
    const int parallel = c->projection == TL_ORTHOGRAPHIC;
    const wide at_0 = vertical ? c->top : c->left, at_count = vertical ? c->bottom : c->right;
    const uint32_t count = vertical ? c->height : c->width;
    const tl_span s = tl_oracle_sphere_span(of->center[vertical], -(wide)of->center[2],
                                            of->radius, c->near, c->far, parallel);
    const wide least = parallel ? 0 : 1, scale = count / (at_count - at_0);
    const wide low_off = TL_SPAN_ERROR * larger_of(least, fabsq(s.low));
    const wide high_off = TL_SPAN_ERROR * larger_of(least, fabsq(s.high));
    axis a = {.count = count};
    a.from = ((vertical ? s.high : s.low) - at_0) * scale;
    a.to = ((vertical ? s.low : s.high) - at_0) * scale;
    a.from_off = (vertical ? high_off : low_off) * fabsq(scale);
    a.to_off = (vertical ? low_off : high_off) * fabsq(scale);
    /* Edges are compared in units of the interval, for pixels round. */
    const wide bottom = vertical ? at_count : at_0, top = vertical ? at_0 : at_count;
    const wide high_slack = slack_of(of, s.high, high_off, bottom);
    const wide low_slack = slack_of(of, s.low, low_off, top);
    a.off = s.empty || s.high < bottom - high_slack || s.low > top + low_slack;
    a.touches = !a.off && (s.high < bottom + high_slack || s.low > top - low_slack);
    return a;
}

/* Pixels [first, end) whose centre is in the interval widened by what the oracle is off by. */
static void centres(const axis *a, wide *first, wide *end)
{
    *first = larger_of(ceilq(a->from - 0.5Q - a->from_off), 0);
    *end = floorq(a->to - 0.5Q + a->to_off) + 1;
    *end = *end < a->count ? *end : a->count;
}

static wide not_below_0(wide v)
{
    return v > 0 ? v : 0;
}

static uint64_t inside(const axis *a)
{
    wide first, end;
    if (a->off)
        return 0;
    centres(a, &first, &end);
    return (uint64_t)not_below_0(end - first);
}

static uint64_t inside_and_kept(const axis *a)
{
    wide first, end;
    if (a->off)
        return 0;
    centres(a, &first, &end);
    first = larger_of(first, a->first);
    end = end < a->end ? end : a->end;
    return (uint64_t)not_below_0(end - first);
}

/* More than one pixel kept before the first whose centre is in the interval, or behind the last. */
static int has_extra(const axis *a)
{
    const wide from = a->from - 0.5Q + a->from_off, to = a->to - 0.5Q - a->to_off;
    const wide before = (from < a->end ? ceilq(from) : a->end) - a->first;
    const wide behind = a->end - (to >= a->first ? floorq(to) + 1 : a->first);
    return before > 1 || behind > 1;
}

tl_sphere_verdict tl_judge_sphere(const tl_sphere_case *of, const tl_pixel_rect *rect)
{
    axis x = axis_of(of, 0), y = axis_of(of, 1);
    const int off = x.off || y.off, is_empty = rect->x1 <= rect->x0;
    tl_sphere_verdict v = {.undecided = !off && (x.touches || y.touches)};
    x.first = rect->x0;
    x.end = rect->x1;
    y.first = rect->y0;
    y.end = rect->y1;
    v.seen_px = inside(&x) * inside(&y);
    v.lost_px = v.seen_px - inside_and_kept(&x) * inside_and_kept(&y);
    v.falsely_empty = is_empty && !off && !v.undecided;
    v.falsely_kept = !is_empty && off;
    v.extra = !is_empty && !off && (has_extra(&x) || has_extra(&y));
    return v;
}

/* One axis at first look. */
enum standing { OFF, INSIDE, UNCLEAR };

/* Whether the interval meets the image, and if it does for sure, whether [first, end) are surely the pixels
 * that hold its ends and those between. */
static enum standing quick_standing(const tl_sphere_case *of,
                                    int vertical,
                                    const tl_pixel_rect *rect)
{
    const tl_camera *c = &of->camera;
    const uint32_t first = vertical ? rect->y0 : rect->x0, end = vertical ? rect->y1 : rect->x1;
    const long double at_0 = vertical ? c->top : c->left,
                      at_count = vertical ? c->bottom : c->right;
    const long double count = vertical ? c->height : c->width,
                      scale = count / (at_count - at_0);
    const tl_quick_span s = tl_oracle_sphere_quick_span(
        of->center[vertical], -(long double)of->center[2], of->radius, c->near, c->far,
        c->projection == TL_ORTHOGRAPHIC);
    if (s.empty)
        return OFF;
    const long double low = (s.low - at_0) * scale, high = (s.high - at_0) * scale;
    const long double from = low < high ? low : high, to = low < high ? high : low;
    const long double least = c->projection == TL_ORTHOGRAPHIC ? 0 : 1;
    const long double largest = fmaxl(least, fmaxl(fabsl(s.low), fabsl(s.high)));
    /* The same for the slack of doubles, which is less. */
    const long double off =
        2 * TL_QUICK_SPAN_ERROR * (largest + fabsl(at_0) + fabsl(at_count)) * fabsl(scale);
    if (to < -off || from > count + off)
        return OFF;
    if (!(to > off && from < count - off))
        return UNCLEAR;
    const int first_is_right = from + off < 0
                                   ? first == 0
                                   : floorl(from - off) == first && floorl(from + off) == first;
    const int end_is_right = to - off >= count
                                 ? (long double)end == count
                                 : floorl(to - off) + 1 == end && floorl(to + off) + 1 == end;
    return first_is_right && end_is_right ? INSIDE : UNCLEAR;
}

/* Whether the first look finds the contract kept beyond doubt. It never finds it broken. */
static int is_surely_right(const tl_sphere_case *of, const tl_pixel_rect *rect)
{
    const enum standing x = quick_standing(of, 0, rect), y = quick_standing(of, 1, rect);
    if (x == OFF || y == OFF)
        return rect->x1 == 0;
    return x == INSIDE && y == INSIDE;
}

void tl_try_sphere(const tl_sphere_case *of, tl_tally *tally)
{
    tl_pixel_rect rect;
    tl_sphere_bounds(&of->camera, of->center, of->radius, &rect);
    tally->cases++;
    tally->hits += rect.x1 > 0;
    if (is_surely_right(of, &rect))
        return;
    const tl_sphere_verdict v = tl_judge_sphere(of, &rect);
    tally->lost += v.lost_px > 0;
    tally->extra += (uint64_t)v.extra;
    tally->falsely_empty += (uint64_t)v.falsely_empty;
    tally->falsely_kept += (uint64_t)v.falsely_kept;
    tally->undecided += (uint64_t)v.undecided;
}
