/* Skies kept on disk from process to process, beside compiled programs (program_cache.h). */
#ifndef TL_SKY_KEEP_H
#define TL_SKY_KEEP_H

#include "sky_map.h"

#include <stdbool.h>

/* What an entry is found by: of the sky and of how it is filtered, [TL_SKY_KEY] bytes. */
enum { TL_SKY_KEY = 64 };
void tl_sky_key(const tl_sky_source *source, uint32_t size, char key[TL_SKY_KEY]);

/* Fills texels [map->texel_count], moments and brightest of a map whose size is set. Returns whether there was
 * a sound entry; without one, or with TILELIGHT_CACHE empty, the map is as it was. */
bool tl_sky_recall(const char key[TL_SKY_KEY], tl_sky_map *map);

/* Puts the map there, and trims the folder. Cannot fail: a folder that is missing, full or read-only costs
 * time, and no more. */
void tl_sky_keep(const char key[TL_SKY_KEY], const tl_sky_map *map);

#endif
