#include "front.h"

#include <math.h>

/* A question of its own: which time, and who competes. */
typedef struct race {
    tl_study_time_name time;
    tl_study_value_name front;
    int needs_usual_files;
} race;

static const race races[] = {
    {TL_TIME_LIGHT_RATIO, TL_VALUE_FRONT_LIGHT, 1},
    {TL_TIME_JOB_RATIO, TL_VALUE_FRONT_JOB, 0},
};

static int competes(const race *r, const tl_study_record *record)
{
    return isfinite(record->times[r->time].median) &&
           isfinite(record->values[TL_VALUE_ERROR_RMS]) &&
           (!r->needs_usual_files || tl_study_config_is_usual(&record->config, 1));
}

static int beats(const race *r,
                 const tl_study_record *a,
                 const tl_study_record *b,
                 int is_earlier)
{
    const double time_a = a->times[r->time].median, time_b = b->times[r->time].median;
    const double error_a = a->values[TL_VALUE_ERROR_RMS],
                 error_b = b->values[TL_VALUE_ERROR_RMS];
    return tl_study_is_for_screen(&a->config) == tl_study_is_for_screen(&b->config) &&
           time_a <= time_b && error_a <= error_b &&
           (time_a < time_b || error_a < error_b || is_earlier);
}

static int is_on_front(const race *r, const tl_study_record *records, size_t count, size_t one)
{
    if (!competes(r, &records[one]))
        return 0;
    for (size_t i = 0; i < count; i++)
        if (i != one && competes(r, &records[i]) &&
            beats(r, &records[i], &records[one], i < one))
            return 0;
    return 1;
}

void tl_study_front_find(tl_study_record *records, size_t count)
{
    for (size_t k = 0; k < sizeof races / sizeof races[0]; k++)
        for (size_t i = 0; i < count; i++)
            records[i].values[races[k].front] = is_on_front(&races[k], records, count, i);
}
