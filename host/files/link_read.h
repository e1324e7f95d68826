/* Links of lights to objects in a lights file. */
#ifndef TL_LINK_READ_H
#define TL_LINK_READ_H

#include "light_values.h"

/* {"only": [...]} or {"except": [...]}, of names and ids, into the set's links: *out becomes what
 * tl_light.link is to be. Fails with TL_ERR_FORMAT or TL_ERR_MEMORY. */
tl_status tl_read_link(const tl_place *at,
                       const char *field,
                       const json_t *value,
                       tl_light_set *set,
                       uint32_t *out,
                       tl_error *err);

#endif
