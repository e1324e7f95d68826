#include "stages.h"

#include "try.h"

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

tl_status tl_study_stages_take(tl_study_pictures *pictures,
                               tl_study_file_times *files,
                               const char *folder,
                               double seconds,
                               const tl_study_record *usual,
                               tl_study_record *record,
                               tl_error *err)
{
    const tl_sampling_rule rule = {.least_samples = 2,
                                   .seconds = seconds / TL_STUDY_BLOCK_COUNT};
    const tl_study_config default_one = tl_study_config_default();
    const int is_default = tl_study_config_is_same(&record->config, &default_one);
    tl_status status = TL_OK;
    if (usual && !is_default && tl_study_config_is_usual(&record->config, 0))
        take_lighting(record, usual);
    else
        TRY(tl_study_time_lighting(pictures, &rule, record, err));
    if (folder) {
        TRY(tl_study_time_files(files, pictures, folder, &rule, record, err));
        sum_job(record, usual ? usual : record);
    }
done:
    return status;
}
