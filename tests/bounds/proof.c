#include "bounds/proof.h"

#include "bounds/cone_verdict.h"
#include "bounds/sphere_families.h"
#include "bounds/tile_families.h"

#include "parallel.h"

#include <pthread.h>

/* What sets the random numbers of the groups apart. */
enum { SPHERES = 0, TILES = 1000, CONES = 2000 };

static const char *sphere_name(int family)
{
    return tl_sphere_families[family].name;
}

static void try_sphere(uint64_t seed, int family, uint64_t index, tl_tally *tally)
{
    tl_draws draws = draws_of(seed, (uint64_t)(SPHERES + family), index);
    const tl_sphere_case drawn = tl_sphere_families[family].draw(&draws);
    tl_try_sphere(&drawn, tally);
}

static const char *tile_name(int family)
{
    return tl_tile_families[family].name;
}

static void try_tile(uint64_t seed, int family, uint64_t index, tl_tally *tally)
{
    tl_draws draws = draws_of(seed, (uint64_t)(TILES + family), index);
    tl_tile_families[family].attempt(&draws, tally);
}

static const char *cone_name(int family)
{
    return tl_cone_families[family].name;
}

static void try_cone(uint64_t seed, int family, uint64_t index, tl_tally *tally)
{
    tl_draws draws = draws_of(seed, (uint64_t)(CONES + family), index);
    const tl_cone_case drawn = tl_cone_families[family].draw(&draws);
    tl_try_cone(&drawn, tally);
}

const tl_bound_group tl_bound_groups[TL_BOUND_GROUPS] = {
    {"spheres", "not empty", 1, TL_SPHERE_FAMILIES, sphere_name, try_sphere},
    {"tiles", "reached", 5, TL_TILE_FAMILIES, tile_name, try_tile},
    {"cones", "lit", 5, TL_CONE_FAMILIES, cone_name, try_cone},
};

typedef struct attempts {
    const tl_bound_group *group;
    int family;
    uint64_t seed;
    pthread_mutex_t lock; /* of what follows */
    tl_tally tally;
    uint64_t first;
} attempts;

static void try_range(void *context, size_t begin, size_t end)
{
    attempts *all = context;
    tl_tally tally = {.cases = 0};
    uint64_t first = UINT64_MAX;
    for (size_t i = begin; i < end; i++) {
        all->group->attempt(all->seed, all->family, i, &tally);
        if (first == UINT64_MAX && tally_violations(&tally) > 0)
            first = i;
    }
    pthread_mutex_lock(&all->lock);
    tally_add(&all->tally, &tally);
    all->first = first < all->first ? first : all->first;
    pthread_mutex_unlock(&all->lock);
}

tl_tally tl_try_family(
    const tl_bound_group *group, int family, uint64_t seed, uint64_t count, uint64_t *first)
{
    attempts all = {.group = group, .family = family, .seed = seed, .first = UINT64_MAX};
    pthread_mutex_init(&all.lock, NULL);
    tl_parallel((size_t)count, 4096, try_range, &all);
    pthread_mutex_destroy(&all.lock);
    *first = all.first;
    return all.tally;
}
