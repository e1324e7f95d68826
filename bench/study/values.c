#include "values.h"

#include <math.h>

#define TIME_ROW(name, word, meaning) [name] = {word, "", meaning},
#define VALUE_ROW(name, word, unit, meaning) [name] = {word, unit, meaning},
const tl_study_row tl_study_time_rows[TL_STUDY_TIME_COUNT] = {TL_STUDY_TIMES(TIME_ROW)};
const tl_study_row tl_study_value_rows[TL_STUDY_VALUE_COUNT] = {TL_STUDY_VALUES(VALUE_ROW)};

tl_study_time tl_study_time_of(const tl_summary halves[2])
{
    const tl_interval *a = &halves[0].interval, *b = &halves[1].interval;
    return (tl_study_time){.median = 0.5 * (halves[0].median + halves[1].median),
                           .low = fmin(a->low, b->low),
                           .high = fmax(a->high, b->high),
                           .samples = halves[0].count + halves[1].count,
                           .is_unstable = a->low > b->high || b->low > a->high};
}

tl_study_time tl_study_time_known(double value)
{
    return (tl_study_time){.median = value, .low = value, .high = value};
}

tl_study_record tl_study_record_empty(const tl_study_config *config, double seconds)
{
    tl_study_record record = {.config = *config, .seconds = seconds};
    for (int i = 0; i < TL_STUDY_TIME_COUNT; i++)
        record.times[i] = tl_study_time_known((double)NAN);
    for (int i = 0; i < TL_STUDY_VALUE_COUNT; i++)
        record.values[i] = (double)NAN;
    return record;
}

int tl_study_is_for_screen(const tl_study_config *config)
{
    return config->output == TL_STUDY_PNG;
}
