#include "light_control_options.h"

#include "values.h"

#include <stdio.h>
#include <string.h>

/* Of each kind its key: OPTION_FIRST + kind. */
enum { OPTION_FIRST = 256 };

/* Behind the last '=' of NAME=SCALE, which names may have, too. */
static float take_scale(const char *option, char *text, struct argp_state *state)
{
    char *const sign = strrchr(text, '=');
    char with_name[160];
    if (!sign || sign == text) {
        argp_error(state, "%s: \"%s\" must be NAME=SCALE or NAME=off", option, text);
        return 0.0f;
    }
    *sign = '\0';
    snprintf(with_name, sizeof with_name, "%s %.100s (a scale, or off)", option, text);
    if (strcmp(sign + 1, "off") == 0)
        return 0.0f;
    return (float)value_number(state, with_name, sign + 1, 0.0, 1e30);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    light_controls *const controls = state->input;
    tl_light_control control = {.scale = 1.0f};
    if (key < OPTION_FIRST || key >= OPTION_FIRST + TL_LIGHT_CONTROL_COUNT)
        return ARGP_ERR_UNKNOWN;
    control.kind = (tl_light_control_kind)(key - OPTION_FIRST);
    const char *const option = tl_light_control_options[control.kind];
    if (controls->count == MOST_LIGHT_CONTROLS)
        argp_error(state, "%s: at most %d of --light, --group and --solo are taken", option,
                   MOST_LIGHT_CONTROLS);
    if (control.kind != TL_CONTROL_SOLO)
        control.scale = take_scale(option, text, state);
    control.name = text;
    controls->of[controls->count++] = control;
    return 0;
}

static const struct argp_option options_table[] = {
    {"light", OPTION_FIRST + TL_CONTROL_LIGHT, "NAME=SCALE|off", 0,
     "Scale lights, or switch them off, which costs nothing: by name, by index (from 0), or by "
     "a "
     "pattern with *, ? and [...]; may be given several times, and scales multiply",
     0},
    {"group", OPTION_FIRST + TL_CONTROL_GROUP, "NAME=SCALE|off", 0,
     "The same for all lights of a group", 0},
    {"solo", OPTION_FIRST + TL_CONTROL_SOLO, "NAME", 0,
     "Lights or groups of this name alone, all others off; may be given several times", 0},
    {0},
};

const struct argp light_control_argp = {.options = options_table, .parser = parse};
