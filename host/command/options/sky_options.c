#include "sky_options.h"

#include "console.h"
#include "try.h"
#include "values.h"

#include <math.h>
#include <string.h>

enum { OPTION_SKY = 256, OPTION_INTENSITY, OPTION_ROTATION, OPTION_LIGHT };

static const double degree = 0.017453292519943295;

sky_choice sky_choice_default(void)
{
    return (sky_choice){.intensity = -1.0, .light = -1.0, .rotation = (double)NAN};
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    sky_choice *choice = state->input;
    switch (key) {
    case OPTION_SKY: choice->image = text; return 0;
    case OPTION_INTENSITY:
        choice->intensity = value_number(state, "--sky-intensity", text, 0.0, 1e30);
        return 0;
    case OPTION_ROTATION:
        choice->rotation = value_number(state, "--sky-rotation", text, -1e6, 1e6);
        return 0;
    case OPTION_LIGHT:
        choice->light = value_number(state, "--sky-light", text, 0.0, 1e30);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options_table[] = {
    {"sky", OPTION_SKY, "FILE|none", 0,
     "A map of latitude and longitude, OpenEXR or PNG, as the sky that is seen and that lights "
     "surfaces, in place of the lights' own; none: no sky",
     0},
    {"sky-intensity", OPTION_INTENSITY, "SCALE", 0,
     "What the sky's radiance is multiplied with, as it is seen and as it lights (default: "
     "what the "
     "lights say, 1 with --sky)",
     0},
    {"sky-rotation", OPTION_ROTATION, "DEGREES", 0,
     "Turns the map anticlockwise as seen from above (default: what the lights say, 0 with "
     "--sky)",
     0},
    {"sky-light", OPTION_LIGHT, "SCALE", 0,
     "What of the sky's radiance lights surfaces; 0: it is background alone (default: what the "
     "lights say, 1 with --sky)",
     0},
    {0},
};

const struct argp sky_argp = {.options = options_table, .parser = parse};

static void remove_sky(tl_light_set *lights)
{
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    lights->sky_type = TL_SKY_CONSTANT;
    lights->sky_image = 0;
    lights->sky_intensity = lights->sky_rotation = lights->sky_light = 0.0f;
    memcpy(lights->sky, black, sizeof black);
    memcpy(lights->zenith, black, sizeof black);
    memcpy(lights->ground, black, sizeof black);
}

/* A gradient has its intensity in its colours. */
static void brighten(tl_light_set *lights, double by)
{
    float *const colors[] = {lights->sky, lights->zenith, lights->ground};
    if (lights->sky_type == TL_SKY_IMAGE) {
        lights->sky_intensity = (float)by;
        return;
    }
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            colors[k][c] = (float)((double)colors[k][c] * by);
}

static tl_status check_use(const sky_choice *choice, const tl_light_set *lights, tl_error *err)
{
    const char *const given = choice->intensity >= 0.0   ? "--sky-intensity"
                              : choice->light >= 0.0     ? "--sky-light"
                              : !isnan(choice->rotation) ? "--sky-rotation"
                                                         : NULL;
    if (given && !tl_light_set_has_sky(lights))
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "%s is for nothing: the lights have no sky; --sky FILE brings one",
                       given);
    if (!isnan(choice->rotation) && lights->sky_type != TL_SKY_IMAGE)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "--sky-rotation is for nothing: a sky of colours alone is the same all "
                       "around; --sky FILE brings a map");
    return TL_OK;
}

tl_status sky_choose(const sky_choice *choice, tl_light_set *lights, tl_error *err)
{
    tl_status status = TL_OK;
    if (choice->image)
        remove_sky(lights);
    if (choice->image && strcmp(choice->image, "none") != 0) {
        TRY(tl_light_set_read_sky(lights, choice->image, err));
        lights->sky_light = 1.0f;
    }
    TRY(check_use(choice, lights, err));
    if (choice->intensity >= 0.0)
        brighten(lights, choice->intensity);
    if (choice->light >= 0.0)
        lights->sky_light = (float)choice->light;
    if (!isnan(choice->rotation))
        lights->sky_rotation = (float)(choice->rotation * degree);
    TRY(tl_light_set_check(lights, "the sky's options", err));
done:
    return status;
}
