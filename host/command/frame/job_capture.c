#include "job_capture.h"

#include "console.h"
#include "try.h"

tl_status job_capture(
    job *j, const char *scene, const tl_capture_options *options, bool strict, tl_error *err)
{
    tl_status status = TL_OK;
    tl_light_set found = {0};
    tl_capture_options with_shadows = *options;

    console_stage("capturing");
    for (size_t i = 0; options->all_shadows && i < j->lights.count; i++)
        j->lights.lights[i].casts_shadow = 1;
    with_shadows.ids |= j->lights.link_count > 0;
    if (j->lights_given)
        with_shadows.shadow_lights = &j->lights;
    TRY(tl_capture(scene, &with_shadows, &j->gbuffer, &found, &j->timings, &console_notices,
                   err));
    if (!j->lights_given) {
        j->lights = found;
        j->lights_controlled = found.count > 0 && options->change_lights;
        found = (tl_light_set){0};
    }
    TRY(job_repair(j, scene, strict, err));
done:
    tl_light_set_clear(&found);
    return status;
}
