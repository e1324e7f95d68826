#include "lighter.h"

tl_status lighter_lighting(lighter *with,
                           tl_lighting **of,
                           const tl_lighting_options *options,
                           tl_error *err)
{
    return *of ? TL_OK : tl_lighting_create(with->device, options, of, err);
}

tl_status lighter_post(lighter *with,
                       const tl_lighting_options *lighting,
                       const tl_post_options *options,
                       tl_error *err)
{
    if (with->post)
        return tl_post_choose(with->post, options, err);
    return tl_post_create(with->device, lighting, options, &with->post, err);
}

void lighter_let_go(lighter *with)
{
    tl_lighting_let_go(with->lighting);
    tl_lighting_let_go(with->groups);
}

void lighter_close(lighter *with)
{
    tl_lighting_destroy(with->lighting);
    tl_lighting_destroy(with->groups);
    tl_post_destroy(with->post);
    tl_device_close(with->device);
    *with = (lighter){0};
}
