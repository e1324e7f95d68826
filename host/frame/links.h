/* Links of lights to objects, as kernels take them (kernels/link.h). */
#ifndef TL_LINKS_H
#define TL_LINKS_H

#include "prepared.h"

/* Adds the words of the links that lights of the frame have, says in the row before their shapes where those
 * are, and gives those lights' shapes
 * their bits. Nothing where no light of the frame is linked. To be called once shapes are there. Fails with
 * TL_ERR_FORMAT, naming a light, where the G-buffer tells no objects apart, or a link names an object that it
 * does not have; as tl_section_add does; TL_ERR_MEMORY. */
tl_status tl_links_add(const tl_gbuffer *gbuffer,
                       const tl_light_set *lights,
                       tl_prepared *prepared,
                       tl_error *err);

#endif
