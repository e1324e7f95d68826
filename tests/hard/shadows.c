/* Shadow maps where depth is coarse: aslant to the light, far from it, and where a cube's views meet. */
#include "hard_case.h"

#include "shadow_scenes.h"

/* What a point has to get: exactly that. */
static int gets(const lookup *l, const double point[3], const double n[3], float want)
{
    return same_bits(share_on(l, point, n), want);
}

/* A map with the texels of another. */
static void begin_like(lookup *l, const tl_shadow_map *of)
{
    begin_map(l, of);
    memcpy(l->maps.of[0].texels, of->texels, tl_shadow_map_size(of));
}

/* --- slopes ---------------------------------------------------------------------------------------- */

static void count_lit(
    hard_bench *bench, const lookup *ours, const lookup *usual, const solid *s, uint32_t *seed)
{
    enum { POINTS = 400 };
    for (int i = 0; i < POINTS; i++) {
        double point[3];
        const plane *on = random_point(ours, s, seed, point);
        if (is_lit_well(ours, s, point))
            hard_count(bench, gets(ours, point, on->n, 1.0f), gets(usual, point, on->n, 1.0f));
    }
}

/* In every kind of map, by every filter. */
static void try_solid(hard_bench *bench, const solid *s, uint32_t *seed)
{
    static const uint32_t filters[] = {1, 2, 5};
    for (uint32_t kind = 0; kind < TL_SHADOW_KIND_COUNT; kind++) {
        lookup ours, usual;
        begin(&ours, kind, filters[0], s);
        begin_like(&usual, &ours.maps.of[0]);
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            look_up(&ours, filters[f]);
            look_up(&usual, filters[f]);
            forget_slopes(&usual);
            count_lit(bench, &ours, &usual, s, seed);
        }
        end(&usual);
        end(&ours);
    }
}

void hard_own_shadow(hard_bench *bench)
{
    static const double tilts[] = {0.0, 0.5, 1.0, 1.44};
    uint32_t seed = 26;
    for (size_t i = 0; i < COUNT_OF(tilts); i++)
        for (joint how = ONE; how <= VALLEY; how++) {
            const solid s = {{tilted(tilts[i], random_in(&seed, 0.0, 6.28)),
                              tilted(random_in(&seed, 0.0, 1.4), random_in(&seed, 0.0, 6.28))},
                             how};
            try_solid(bench, &s, &seed);
        }
}

/* --- distance -------------------------------------------------------------------------------------- */

/* What is left of depths that were stored as 1 - near/w. */
static void round_from_one(tl_shadow_map *map)
{
    for (size_t i = 0; i < tl_shadow_map_size(map); i += 2 * sizeof *map->texels) {
        float depth;
        uint32_t *texel = map->texels + i / sizeof *map->texels;
        memcpy(&depth, texel, sizeof depth);
        const float stored = 1.0f - depth, read = 1.0f - stored;
        memcpy(texel, &read, sizeof read);
    }
}

/* Points behind a plate, which are dark, and before it, which are lit, by a share of their distance. */
static void count_around_plate(
    hard_bench *bench, const lookup *ours, const lookup *usual, const solid *s, uint32_t *seed)
{
    enum { POINTS = 20 };
    static const double apart[] = {1e-4, 3e-4, 1e-3, 1e-2};
    for (size_t a = 0; a < COUNT_OF(apart); a++)
        for (int i = 0; i < 2 * POINTS; i++) {
            const int behind = i % 2;
            const double by = behind ? 1.0 + apart[a] : 1.0 - apart[a];
            double point[3];
            const plane *on = random_point(ours, s, seed, point);
            for (int axis = 0; axis < 3; axis++)
                point[axis] *= by;
            const float want = behind ? 0.0f : 1.0f;
            hard_count(bench, gets(ours, point, on->n, want), gets(usual, point, on->n, want));
        }
}

void hard_far_shadow(hard_bench *bench)
{
    enum { DISTANCES = 16 };
    static const double near = 1e-3, narrow = 1e-3; /* m; rad, so that texels are no limit */
    const float axis[3] = {0.0f, 0.0f, -1.0f};
    tl_shadow_map like = {
        .kind = TL_SHADOW_SPOT, .size = MAP_SIZE, .direction = {0.0f, 0.0f, -1.0f}};
    uint32_t seed = 27;
    tl_shadow_views_from(&like, axis, narrow, near);
    for (int i = 0; i < DISTANCES; i++) {
        lookup ours, usual;
        solid s = {{tilted(0.5, random_in(&seed, 0.0, 6.28))}, ONE};
        s.of[0].offset *= near * pow(10.0, 2.0 + 3.0 * i / (DISTANCES - 1)) / 5.0;
        begin_map(&ours, &like);
        fill(&ours.maps.of[0], &s);
        begin_like(&usual, &ours.maps.of[0]);
        round_from_one(&usual.maps.of[0]);
        look_up(&ours, 2);
        look_up(&usual, 2);
        count_around_plate(bench, &ours, &usual, &s, &seed);
        end(&usual);
        end(&ours);
    }
}

/* --- seams ----------------------------------------------------------------------------------------- */

/* A direction from the light within `width` texels of an edge of the side against z; every fifth is near
 * a corner. */
static void random_at_seam(uint32_t *seed, int index, double width, double out[3])
{
    const double texel = 2.0 / MAP_SIZE;
    const double end = 1.0 + random_in(seed, -width, width) * texel;
    const double other = index % 5 == 0 ? 1.0 + random_in(seed, -width, width) * texel
                                        : random_in(seed, -0.95, 0.95);
    const double along[2] = {index & 1 ? end : -end, index & 2 ? other : -other};
    const int axis = (index >> 2) & 1;
    out[axis] = along[0];
    out[1 - axis] = along[1];
    out[2] = -1.0;
}

/* On the plane, where all is lit, and half as far behind it again, where all is dark. */
static void count_at_seams(
    hard_bench *bench, const lookup *ours, const lookup *usual, const solid *s, uint32_t *seed)
{
    enum { POINTS = 1600 };
    static const double eye[3] = {0.0, 0.0, 0.0};
    for (int i = 0; i < POINTS; i++) {
        const int behind = i >= POINTS / 2;
        double along[3], point[3];
        random_at_seam(seed, i, 0.5 * ours->shadow.filter, along);
        const double far = met_at(&s->of[0], eye, along) * (behind ? 1.5 : 1.0);
        for (int axis = 0; axis < 3; axis++)
            point[axis] = far * along[axis];
        const float want = behind ? 0.0f : 1.0f;
        hard_count(bench, gets(ours, point, s->of[0].n, want),
                   gets(usual, point, s->of[0].n, want));
    }
}

void hard_cube_seam(hard_bench *bench)
{
    static const double tilts[] = {0.0, 0.2, 0.4};
    static const uint32_t filters[] = {1, 5, TL_MOST_SHADOW_FILTER};
    const tl_shadow_map like = map_of(TL_SHADOW_CUBE);
    tl_shadow_map square = like;
    uint32_t seed = 28;
    for (uint32_t v = 0; v < tl_shadow_view_count(&square); v++)
        tl_camera_center(&square.views[v], 1.0, 1.0);
    for (size_t i = 0; i < COUNT_OF(tilts); i++) {
        lookup ours, usual;
        const solid s = {{tilted(tilts[i], random_in(&seed, 0.0, 6.28))}, ONE};
        begin_map(&ours, &like);
        begin_map(&usual, &square);
        fill(&ours.maps.of[0], &s);
        fill(&usual.maps.of[0], &s);
        for (size_t f = 0; f < COUNT_OF(filters); f++) {
            look_up(&ours, filters[f]);
            look_up(&usual, filters[f]);
            count_at_seams(bench, &ours, &usual, &s, &seed);
        }
        end(&usual);
        end(&ours);
    }
}
