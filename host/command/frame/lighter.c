#include "lighter.h"

/* Below this a frame's own needs are met, and others are not to be helped by it. */
enum { LEAST_MEMORY = 1 << 16 };

uint64_t lighter_memory(const lighter *with, const tl_lighting_options *options)
{
    return with->memory_limit ? with->memory_limit : options->memory_limit;
}

static void forget(lighter *with)
{
    tl_lighting_destroy(with->lighting);
    tl_lighting_destroy(with->groups);
    tl_post_destroy(with->post);
    with->lighting = with->groups = NULL;
    with->post = NULL;
}

bool lighter_shrink(lighter *with, const tl_lighting_options *options, uint64_t bytes)
{
    const uint64_t had = lighter_memory(with, options);
    const uint64_t limit = (had && had < bytes ? had : bytes) / 2;
    if (limit < LEAST_MEMORY)
        return false;
    forget(with);
    with->memory_limit = limit;
    return true;
}

tl_status lighter_lighting(lighter *with,
                           tl_lighting **of,
                           const tl_lighting_options *options,
                           tl_error *err)
{
    tl_lighting_options limited = *options;
    limited.memory_limit = lighter_memory(with, options);
    return *of ? TL_OK : tl_lighting_create(with->device, &limited, of, err);
}

tl_status lighter_post(lighter *with,
                       const tl_lighting_options *lighting,
                       const tl_post_options *options,
                       tl_error *err)
{
    tl_lighting_options limited = *lighting;
    limited.memory_limit = lighter_memory(with, lighting);
    if (with->post)
        return tl_post_choose(with->post, options, err);
    return tl_post_create(with->device, &limited, options, &with->post, err);
}

void lighter_let_go(lighter *with)
{
    tl_lighting_let_go(with->lighting);
    tl_lighting_let_go(with->groups);
}

void lighter_close(lighter *with)
{
    forget(with);
    tl_device_close(with->device);
    *with = (lighter){0};
}
