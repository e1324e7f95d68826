#include "sampling.h"

#include "tilelight/report.h"

#include <stdlib.h>

/* Beyond this many, further ones are a matter of the machine's drift and not of chance. */
enum { MOST_SAMPLES = 1000 };

tl_sampling_rule tl_sampling_rule_default(void)
{
    return (tl_sampling_rule){.least_samples = 10, .deviation = 0.01, .seconds = 2.0};
}

tl_status tl_samples_add(tl_samples *samples, double value, tl_error *err)
{
    if (samples->count == samples->capacity) {
        const size_t capacity = samples->capacity ? 2 * samples->capacity : 16;
        double *grown = realloc(samples->values, capacity * sizeof *grown);
        if (!grown)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for samples");
        samples->values = grown;
        samples->capacity = capacity;
    }
    samples->values[samples->count++] = value;
    return TL_OK;
}

tl_summary tl_samples_summarize(const tl_samples *samples)
{
    return tl_summarize(samples->values, samples->count);
}

void tl_samples_clear(tl_samples *samples)
{
    free(samples->values);
    *samples = (tl_samples){0};
}

int tl_sampling_done(const tl_sampling_rule *rule, const tl_samples *samples, double start)
{
    if (samples->count < rule->least_samples)
        return 0;
    if (samples->count >= MOST_SAMPLES || tl_seconds() - start >= rule->seconds)
        return 1;
    const tl_summary summary = tl_samples_summarize(samples);
    return tl_relative_deviation(&summary) <= rule->deviation;
}
