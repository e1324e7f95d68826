#include "light_profiles.h"

#include "light_images.h"
#include "tilelight/photometry.h"
#include "try.h"
#include "whole_file.h"

#include <stdlib.h>
#include <string.h>

/* From `path`, which sentences name. */
static tl_status read_profile(const char *path, tl_light_profile *out, tl_error *err)
{
    tl_status status = TL_OK;
    tl_photometry photometry = {0};
    char *text = NULL;
    size_t size = 0;
    TRY(tl_whole_file_read(path, TL_IES_TEXT_LIMIT, &text, &size, err));
    TRY(tl_photometry_parse(text, size, path, &photometry, err));
    TRY(tl_photometry_resample(&photometry, out, err));
done:
    tl_photometry_clear(&photometry);
    free(text);
    return status;
}

static tl_status add_profile(const tl_place *at,
                             const char *field,
                             const char *name,
                             tl_light_set *set,
                             uint32_t *out,
                             tl_error *err)
{
    tl_light_profile made = {0};
    tl_status status = TL_OK;
    tl_error why;
    char *const path = tl_light_path(set->folder, name);
    if (!path)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for the name of a profile");
    status = read_profile(path, &made, &why);
    if (status != TL_OK)
        TRY(tl_fail(err, status, "%s:%s \"%s\": %s", at->source, at->inside, field,
                    why.message));
    TRY(tl_light_set_add_profile(set, name, &made, out, err));
done:
    free(path);
    return status;
}

tl_status tl_light_profile_read(const tl_place *at,
                                const char *field,
                                const json_t *value,
                                tl_light_set *set,
                                uint32_t *out,
                                tl_error *err)
{
    const char *const name = json_string_value(value);
    if (!name || !name[0] || strcmp(name, "-") == 0) /* which would be standard input */
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s:%s \"%s\" must be a string, the name of an IES file", at->source,
                       at->inside, field);
    for (size_t i = 0; i < set->profile_count; i++)
        if (strcmp(set->profiles[i].path, name) == 0) {
            *out = (uint32_t)i + 1;
            return TL_OK;
        }
    return add_profile(at, field, name, set, out, err);
}
