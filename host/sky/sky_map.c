#include "sky_map.h"

#include "sky_keep.h"
#include "sky_light.h"
#include "sky_prefilter.h"
#include "sky_tree.h"
#include "try.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* What is given out: the map, what it is of, and how many hold it. */
typedef struct held_map {
    tl_sky_map map; /* the first member: what is given out is a pointer to it */
    char key[TL_SKY_KEY];
    unsigned holders;
} held_map;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static held_map *last; /* one of its holders is this */

/* Texels of the finest level are narrower than those of the map; gradients have nothing that is narrow. */
static uint32_t size_for(const tl_sky_source *source)
{
    uint32_t size = TL_SKY_LEAST_SIZE;
    if (source->own)
        return size;
    while (size < TL_SKY_MOST_SIZE && 2 * size < 5 * source->height)
        size *= 2;
    return size;
}

static unsigned depth_for(uint32_t size)
{
    unsigned depth = 0;
    while (1u << depth < size)
        depth++;
    return depth;
}

static void destroy(held_map *held)
{
    if (held)
        free(held->map.texels);
    free(held);
}

static tl_status filter(const tl_sky_source *source, tl_sky_map *map, tl_error *err)
{
    tl_status status = TL_OK;
    tl_sky_tree tree = {0};
    TRY(tl_sky_moments_of(source, map->moments, err));
    TRY(tl_sky_tree_make(source, depth_for(map->size), &tree, err));
    map->brightest = 0.0f;
    tl_sky_prefilter(&tree, map->size, map->texels);
    for (size_t i = 0; i < map->texel_count; i++)
        for (int c = 0; c < 3; c++)
            if (map->texels[i][c] > map->brightest)
                map->brightest = map->texels[i][c];
done:
    tl_sky_tree_clear(&tree);
    return status;
}

/* Moments and levels. Gradients are made as fast as they are read. */
static tl_status fill(const tl_sky_source *source,
                      const char key[TL_SKY_KEY],
                      tl_sky_map *map,
                      tl_error *err)
{
    const bool is_worth_keeping = !source->own;
    tl_status status = TL_OK;
    map->size = size_for(source);
    map->texel_count = tl_sky_level_start(TL_SKY_LEVELS, map->size);
    map->texels = malloc(map->texel_count * sizeof *map->texels);
    if (!map->texels)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
    map->was_kept = is_worth_keeping && tl_sky_recall(key, map);
    if (map->was_kept)
        return TL_OK;
    TRY(filter(source, map, err));
    if (is_worth_keeping)
        tl_sky_keep(key, map);
done:
    return status;
}

static tl_status make(const tl_sky_source *source,
                      bool mirrored,
                      const char key[TL_SKY_KEY],
                      held_map **out,
                      tl_error *err)
{
    tl_status status = TL_OK;
    held_map *made = calloc(1, sizeof *made);
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
    memcpy(made->key, key, TL_SKY_KEY);
    TRY(mirrored ? fill(source, key, &made->map, err)
                 : tl_sky_moments_of(source, made->map.moments, err));
    *out = made;
    made = NULL;
done:
    destroy(made);
    return status;
}

static void release_locked(held_map *held)
{
    if (held && --held->holders == 0)
        destroy(held);
}

/* Under the lock: two that want one sky wait for one. */
static tl_status find(const tl_sky_source *source,
                      bool mirrored,
                      tl_sky_map **out,
                      tl_error *err)
{
    char key[TL_SKY_KEY];
    tl_sky_key(source, size_for(source), key);
    if (!last || memcmp(last->key, key, TL_SKY_KEY) != 0 || (mirrored && !last->map.texels)) {
        held_map *made = NULL;
        const tl_status status = make(source, mirrored, key, &made, err);
        if (status != TL_OK)
            return status;
        made->holders = 1;
        release_locked(last);
        last = made;
    }
    last->holders++;
    *out = &last->map;
    return TL_OK;
}

tl_status tl_sky_map_of(const tl_light_set *set, bool mirrored, tl_sky_map **out, tl_error *err)
{
    tl_sky_source source = {0};
    tl_status status = TL_OK;
    TRY(tl_sky_source_of(set, &source, err));
    pthread_mutex_lock(&lock);
    status = find(&source, mirrored, out, err);
    pthread_mutex_unlock(&lock);
done:
    tl_sky_source_clear(&source);
    return status;
}

void tl_sky_map_release(tl_sky_map *map)
{
    pthread_mutex_lock(&lock);
    release_locked((held_map *)(void *)map);
    pthread_mutex_unlock(&lock);
}
