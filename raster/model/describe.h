/* The steps of tl_scene_describe, each of which fills its part. */
#ifndef TL_DESCRIBE_H
#define TL_DESCRIBE_H

#include "model.h"

#include "tilelight/scene_info.h"

/* Sets meshes, materials and images. Fails with TL_ERR_MEMORY. */
tl_status tl_count_scene(const tl_model *model, tl_scene_info *out, tl_error *err);

/* Sets cameras, animations, variants and extensions. Fails with TL_ERR_MEMORY. */
tl_status tl_list_choices(const tl_model *model, tl_scene_info *out, tl_error *err);

#endif
