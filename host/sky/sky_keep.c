#include "sky_keep.h"

#include "program_cache.h"
#include "sky_light.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

/* Changes with whatever changes a map's numbers: filtering, the tree, moments. */
static const char format[8] = "tlsky1";

/* All bytes of it are of use: it is compared and hashed as it is. */
typedef struct sky_key {
    char format[8];
    XXH128_hash_t pixels;
    uint32_t width, height, size, levels;
    uint64_t texel_size, unused;
} sky_key;
_Static_assert(sizeof(sky_key) <= TL_SKY_KEY, "a key has room");

/* What stands before the texels. */
typedef struct sky_facts {
    tl_sky_moments moments[3];
    float brightest;
} sky_facts;

void tl_sky_key(const tl_sky_source *source, uint32_t size, char key[TL_SKY_KEY])
{
    sky_key made = {.width = source->width,
                    .height = source->height,
                    .size = size,
                    .levels = TL_SKY_LEVELS,
                    .texel_size = sizeof(float[4])};
    memcpy(made.format, format, sizeof format);
    made.pixels =
        XXH3_128bits(source->pixels, 3 * sizeof(float) * source->width * source->height);
    memset(key, 0, TL_SKY_KEY);
    memcpy(key, &made, sizeof made);
}

bool tl_sky_recall(const char key[TL_SKY_KEY], tl_sky_map *map)
{
    char *folder = tl_program_cache_folder();
    tl_program_entry entry = {.memory = NULL};
    const size_t size = map->texel_count * sizeof *map->texels;
    sky_facts facts;
    bool found = folder && tl_program_cache_read(folder, (tl_bytes){key, TL_SKY_KEY}, &entry) &&
                 entry.note.size == sizeof facts && entry.binary.size == size;
    if (found) {
        memcpy(&facts, entry.note.data, sizeof facts);
        memcpy(map->texels, entry.binary.data, size);
        memcpy(map->moments, facts.moments, sizeof facts.moments);
        map->brightest = facts.brightest;
    }
    tl_program_entry_release(&entry);
    free(folder);
    return found;
}

void tl_sky_keep(const char key[TL_SKY_KEY], const tl_sky_map *map)
{
    char *folder = tl_program_cache_folder();
    sky_facts facts;
    memset(&facts, 0, sizeof facts);
    memcpy(facts.moments, map->moments, sizeof facts.moments);
    facts.brightest = map->brightest;
    if (folder && tl_program_cache_write(
                      folder, (tl_bytes){key, TL_SKY_KEY}, (tl_bytes){&facts, sizeof facts},
                      (tl_bytes){map->texels, map->texel_count * sizeof *map->texels}))
        tl_program_cache_trim(folder, TL_CACHE_LIMIT);
    free(folder);
}
