/* Profiles of lights as kernels look them up. */
#ifndef TL_VIEW_PROFILES_H
#define TL_VIEW_PROFILES_H

#include "prepared.h"

/* Adds the section of a light that has a profile, and unless shared[number - 1] says that it is there, that
 * of the profile's shares, which it then says. *at becomes its row. nadir, c0: world space, unit and at right
 * angles. Fails as tl_section_add does. */
tl_status tl_view_profile_add(const tl_camera *camera,
                              const tl_light_set *lights,
                              uint32_t number,
                              const double nadir[3],
                              const double c0[3],
                              tl_u32 *shared,
                              tl_prepared *prepared,
                              tl_u32 *at,
                              tl_error *err);

#endif
