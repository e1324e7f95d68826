#include "tilelight/light_groups.h"

#include <stdlib.h>
#include <string.h>

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const tl_light_group *)a)->name, ((const tl_light_group *)b)->name);
}

/* Neighbours of one name become one. Returns how many are left. */
static size_t merge(tl_light_group *groups, size_t count)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (kept > 0 && strcmp(groups[kept - 1].name, groups[i].name) == 0)
            groups[kept - 1].light_count += groups[i].light_count;
        else
            groups[kept++] = groups[i];
    return kept;
}

tl_status tl_light_groups_find(const tl_light_set *set,
                               tl_light_group **out,
                               size_t *count,
                               tl_error *err)
{
    size_t grouped = 0, at = 0;
    tl_light_group *groups = NULL;
    for (size_t i = 0; i < set->count; i++)
        grouped += set->lights[i].group[0] != '\0';
    if (grouped > 0 && !(groups = malloc(grouped * sizeof *groups)))
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the groups of %zu lights",
                       grouped);
    for (size_t i = 0; i < set->count; i++)
        if (set->lights[i].group[0])
            groups[at++] = (tl_light_group){set->lights[i].group, 1};
    if (grouped > 0)
        qsort(groups, grouped, sizeof *groups, compare_names);
    *count = merge(groups, grouped);
    *out = groups;
    return TL_OK;
}
