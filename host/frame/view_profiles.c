#include "view_profiles.h"

#include "map.h"
#include "sections.h"
#include "try.h"

#include <string.h>

static tl_status add_shares(const tl_light_profile *profile,
                            tl_prepared *prepared,
                            tl_u32 *at,
                            tl_error *err)
{
    const size_t size = (size_t)profile->columns * profile->rows * sizeof *profile->shares;
    void *memory = NULL;
    const tl_status status = tl_section_add(prepared, size, at, &memory, err);
    if (status == TL_OK)
        memcpy(memory, profile->shares, size);
    return status;
}

/* Angles around are counted against the clock as seen from above: C90 is C0 x nadir. */
tl_status tl_view_profile_add(const tl_camera *camera,
                              const tl_light_set *lights,
                              uint32_t number,
                              const double nadir[3],
                              const double c0[3],
                              tl_u32 *shared,
                              tl_prepared *prepared,
                              tl_u32 *at,
                              tl_error *err)
{
    const tl_light_profile *const profile = &lights->profiles[number - 1];
    tl_view_profile view = {.columns = profile->columns,
                            .rows = profile->rows,
                            .first_row = profile->first_row,
                            .rows_of_half_turn = profile->rows_of_half_turn};
    double c90[3];
    tl_status status = TL_OK;
    for (int i = 0; i < 3; i++)
        c90[i] = c0[(i + 1) % 3] * nadir[(i + 2) % 3] - c0[(i + 2) % 3] * nadir[(i + 1) % 3];
    tl_map_direction(camera, c90, 1.0, view.c90);
    tl_map_direction(camera, c0, 1.0, view.c0);
    tl_map_direction(camera, nadir, 1.0, view.nadir);
    if (shared[number - 1] == 0)
        TRY(add_shares(profile, prepared, &shared[number - 1], err));
    view.shares_at = shared[number - 1];
    TRY(tl_section_add(prepared, sizeof view, at, NULL, err));
    memcpy(tl_section_at(prepared, *at), &view, sizeof view);
done:
    return status;
}
