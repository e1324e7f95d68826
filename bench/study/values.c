#include "values.h"

#include <math.h>
#include <string.h>

#define TIME_ROW(name, word, meaning) [name] = {word, "", meaning},
#define VALUE_ROW(name, word, unit, meaning) [name] = {word, unit, meaning},
const tl_study_row tl_study_time_rows[TL_STUDY_TIME_COUNT] = {TL_STUDY_TIMES(TIME_ROW)};
const tl_study_row tl_study_value_rows[TL_STUDY_VALUE_COUNT] = {TL_STUDY_VALUES(VALUE_ROW)};

typedef struct span {
    double least, most;
} span;

static span span_of(const double *blocks, int count)
{
    span s = {blocks[0], blocks[0]};
    for (int i = 1; i < count; i++) {
        s.least = fmin(s.least, blocks[i]);
        s.most = fmax(s.most, blocks[i]);
    }
    return s;
}

/* All blocks are there. */
static int drifts(const double *blocks)
{
    enum { K = TL_STUDY_BLOCK_COUNT / 2 };
    const span first = span_of(blocks, K), last = span_of(blocks + K + 1, K);
    return first.most < last.least || first.least > last.most;
}

tl_study_time tl_study_time_of(const double *blocks, int count, size_t samples)
{
    const span all = span_of(blocks, count);
    double sorted[TL_STUDY_BLOCK_COUNT];
    memcpy(sorted, blocks, (size_t)count * sizeof *sorted);
    return (tl_study_time){.median = tl_summarize(sorted, (size_t)count).median,
                           .low = all.least,
                           .high = all.most,
                           .samples = samples,
                           .is_unstable = count == TL_STUDY_BLOCK_COUNT && drifts(blocks)};
}

const tl_study_time_name tl_study_lit_times[TL_STUDY_LIT_COUNT] = {
    TL_TIME_CULL, TL_TIME_SHADE, TL_TIME_LIGHT, TL_TIME_LIGHT_RATIO};

void tl_study_note_blocks(tl_study_record *record)
{
    const tl_study_blocks *lit = &record->lit;
    for (int i = 0; i < TL_STUDY_LIT_COUNT; i++)
        record->times[tl_study_lit_times[i]] =
            tl_study_time_of(lit->medians[i], lit->count, lit->samples);
}

static double choose(int n, int k)
{
    double product = 1.0;
    for (int i = 1; i <= k; i++)
        product *= (double)(n - k + i) / i;
    return product;
}

double tl_study_interval_coverage(void)
{
    enum { K = TL_STUDY_BLOCK_COUNT / 2 };
    return 1.0 - 2.0 * choose(3 * K + 1, K) / choose(4 * K + 2, 2 * K + 1);
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
    record.again = tl_study_time_known((double)NAN);
    return record;
}

tl_study_time_name tl_study_judged(const tl_study_record *record)
{
    return record->times[TL_TIME_LIGHT_RATIO].samples > 0 ? TL_TIME_LIGHT_RATIO
                                                          : TL_TIME_JOB_RATIO;
}

int tl_study_stays(const tl_study_record *record)
{
    const tl_study_time *stated = &record->times[tl_study_judged(record)];
    if (isnan(record->again.median))
        return -1;
    return record->again.median >= stated->low && record->again.median <= stated->high;
}

void tl_study_note_again(tl_study_record *record,
                         const tl_study_time times[TL_STUDY_TIME_COUNT])
{
    const tl_study_time_name judged = tl_study_judged(record);
    record->again = times[judged];
    record->times[judged].is_unstable |= !tl_study_stays(record);
}

int tl_study_is_for_screen(const tl_study_config *config)
{
    return config->output == TL_STUDY_PNG;
}
