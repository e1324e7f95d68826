/* What a glTF scene holds, as text or JSON; only where the capturing half is part of the build. */
#ifndef TL_INFO_SCENE_H
#define TL_INFO_SCENE_H

#include "tilelight/scene_info.h"

#include <jansson.h>

/* As those of info.h. */
void info_print_scene(const tl_scene_info *of);
json_t *info_scene_json(const tl_scene_info *of);

#endif
