#include "stages.h"

#include <math.h>

/* Lighting that is the default's by definition, and was measured for that. */
static void take_lighting(tl_study_record *record, const tl_study_record *usual)
{
    record->times[TL_TIME_LIGHT] = usual->times[TL_TIME_LIGHT];
    record->times[TL_TIME_CULL] = usual->times[TL_TIME_CULL];
    record->times[TL_TIME_SHADE] = usual->times[TL_TIME_SHADE];
    record->times[TL_TIME_LIGHT_RATIO] = tl_study_time_known(1.0);
    record->values[TL_VALUE_MOVED] = usual->values[TL_VALUE_MOVED];
}

static const struct {
    tl_study_time_name ms, ratio;
} stages[] = {{TL_TIME_READ, TL_TIME_READ_RATIO},
              {TL_TIME_LIGHT, TL_TIME_LIGHT_RATIO},
              {TL_TIME_WRITE, TL_TIME_WRITE_RATIO}};
enum { STAGE_COUNT = sizeof stages / sizeof stages[0] };

static void sum_job(tl_study_record *record, const tl_study_record *usual)
{
    tl_study_time ms = {0}, ratio = {0};
    double whole = 0.0;
    for (int i = 0; i < STAGE_COUNT; i++)
        whole += usual->times[stages[i].ms].median;
    for (int i = 0; i < STAGE_COUNT; i++) {
        const tl_study_time *stage = &record->times[stages[i].ms],
                            *of_usual = &record->times[stages[i].ratio];
        const double share = usual->times[stages[i].ms].median / whole;
        ms.median += stage->median;
        ms.low += stage->low;
        ms.high += stage->high;
        ratio.median += share * of_usual->median;
        ratio.low += share * of_usual->low;
        ratio.high += share * of_usual->high;
        ms.samples += stage->samples;
        ratio.samples += of_usual->samples;
        ms.is_unstable |= stage->is_unstable;
        ratio.is_unstable |= of_usual->is_unstable;
    }
    record->times[TL_TIME_JOB] = ms;
    record->times[TL_TIME_JOB_RATIO] = ratio;
}

int tl_study_lighting_is_known(const tl_study_config *config)
{
    return tl_study_config_is_usual(config, 0) && !tl_study_config_is_usual(config, 1);
}

void tl_study_stages_sum(tl_study_record *record, const tl_study_record *usual)
{
    if (tl_study_lighting_is_known(&record->config))
        take_lighting(record, usual);
    if (!isnan(record->times[TL_TIME_READ].median))
        sum_job(record, usual);
}
