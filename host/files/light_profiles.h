/* Profiles that lights name, and where they lie. */
#ifndef TL_LIGHT_PROFILES_H
#define TL_LIGHT_PROFILES_H

#include "light_values.h"

/* Reads the profile that a field names, unless the set has it, and makes *out its number in the set. Fails
 * with the status of what is wrong with it, in a sentence that names the field, the file and the line. */
tl_status tl_light_profile_read(const tl_place *at,
                                const char *field,
                                const json_t *value,
                                tl_light_set *set,
                                uint32_t *out,
                                tl_error *err);

#endif
