#include "sky_map.h"

#include "sky_light.h"
#include "sky_prefilter.h"
#include "sky_tree.h"
#include "try.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* What is given out: the map, what it is of, and how many hold it. */
typedef struct held_map {
    tl_sky_map map; /* the first member: what is given out is a pointer to it */
    XXH128_hash_t key;
    unsigned holders;
} held_map;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static held_map *last; /* one of its holders is this */

static XXH128_hash_t key_of(const tl_sky_source *source)
{
    const XXH64_hash_t extent = (XXH64_hash_t)source->width << 32 | source->height;
    return XXH3_128bits_withSeed(source->pixels,
                                 3 * sizeof(float) * source->width * source->height, extent);
}

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

static tl_status make_levels(const tl_sky_source *source, tl_sky_map *map, tl_error *err)
{
    tl_status status = TL_OK;
    tl_sky_tree tree = {0};
    map->size = size_for(source);
    map->texel_count = tl_sky_level_start(TL_SKY_LEVELS, map->size);
    map->texels = malloc(map->texel_count * sizeof *map->texels);
    if (!map->texels)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
    TRY(tl_sky_tree_make(source, depth_for(map->size), &tree, err));
    tl_sky_prefilter(&tree, map->size, map->texels);
    for (size_t i = 0; i < map->texel_count; i++)
        for (int c = 0; c < 3; c++)
            if (map->texels[i][c] > map->brightest)
                map->brightest = map->texels[i][c];
done:
    tl_sky_tree_clear(&tree);
    return status;
}

static tl_status make(const tl_sky_source *source, bool mirrored, held_map **out, tl_error *err)
{
    tl_status status = TL_OK;
    held_map *made = calloc(1, sizeof *made);
    const double start = tl_seconds();
    if (!made)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the light of a sky");
    TRY(tl_sky_moments_of(source, made->map.moments, err));
    if (mirrored)
        TRY(make_levels(source, &made->map, err));
    made->map.seconds = tl_seconds() - start;
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
    const XXH128_hash_t key = key_of(source);
    if (!last || !XXH128_isEqual(last->key, key) || (mirrored && !last->map.texels)) {
        held_map *made = NULL;
        const tl_status status = make(source, mirrored, &made, err);
        if (status != TL_OK)
            return status;
        made->key = key;
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
