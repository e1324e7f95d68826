#define _GNU_SOURCE
#include "batch_cost.h"

#include "parallel.h"

#include <stdio.h>
#include <sys/resource.h>

static const struct {
    const char *word, *meaning;
} stages[BATCH_STAGE_COUNT] = {
#define ROW(name, word, meaning) [name] = {word, meaning},
    TL_BATCH_STAGES(ROW)
#undef ROW
};

batch_clock batch_clock_now(void)
{
    return (batch_clock){tl_seconds(), tl_thread_seconds() + tl_parallel_seconds()};
}

void batch_cost_begin(batch_cost *cost)
{
    *cost = (batch_cost){.start_s = tl_seconds(),
                         .start_processor_s = tl_processor_seconds(),
                         .main_s = tl_thread_seconds()};
    pthread_mutex_init(&cost->lock, NULL);
}

batch_clock batch_cost_end_stage(batch_cost *cost, batch_stage stage, batch_clock since)
{
    const batch_clock now = batch_clock_now();
    pthread_mutex_lock(&cost->lock);
    cost->wall_s[stage] += now.wall_s - since.wall_s;
    cost->processor_s[stage] += now.processor_s - since.processor_s;
    pthread_mutex_unlock(&cost->lock);
    return now;
}

void batch_cost_add_timings(batch_cost *cost, const tl_timings *timings)
{
    pthread_mutex_lock(&cost->lock);
    for (int i = 0; i < timings->count; i++)
        tl_timings_add(&cost->timings, timings->stages[i].name, timings->stages[i].ms);
    pthread_mutex_unlock(&cost->lock);
}

void batch_cost_take(batch_cost *cost, uint64_t bytes)
{
    pthread_mutex_lock(&cost->lock);
    cost->bytes += bytes;
    if (cost->bytes > cost->most_bytes)
        cost->most_bytes = cost->bytes;
    pthread_mutex_unlock(&cost->lock);
}

void batch_cost_give_back(batch_cost *cost, uint64_t bytes)
{
    pthread_mutex_lock(&cost->lock);
    cost->bytes -= bytes;
    pthread_mutex_unlock(&cost->lock);
}

/* What a whole batch took. */
typedef struct batch_sum {
    double seconds, processor_s, driver_s, busy;
    double per_second; /* frames that were lit */
    uint64_t peak_bytes;
} batch_sum;

static batch_sum sum_of(const batch_cost *cost, size_t lit_count)
{
    struct rusage usage = {0};
    batch_sum sum = {.seconds = tl_seconds() - cost->start_s,
                     .processor_s = tl_processor_seconds() - cost->start_processor_s};
    sum.driver_s = sum.processor_s - (tl_thread_seconds() - cost->main_s);
    for (int i = 0; i < BATCH_STAGE_COUNT; i++)
        sum.driver_s -= cost->processor_s[i];
    sum.busy = sum.processor_s / (sum.seconds * tl_thread_count());
    sum.per_second = (double)lit_count / sum.seconds;
    getrusage(RUSAGE_SELF, &usage);
    sum.peak_bytes = (uint64_t)usage.ru_maxrss << 10;
    return sum;
}

json_t *batch_cost_json(batch_cost *cost, size_t lit_count)
{
    const batch_sum sum = sum_of(cost, lit_count);
    json_t *of_stages = json_object(), *timings = json_object();
    for (int i = 0; i < BATCH_STAGE_COUNT; i++)
        json_object_set_new(of_stages, stages[i].word,
                            json_pack("{sf sf}", "wall_s", cost->wall_s[i], "processor_s",
                                      cost->processor_s[i]));
    json_object_set_new(of_stages, "driver", json_pack("{sf}", "processor_s", sum.driver_s));
    for (int i = 0; i < cost->timings.count; i++)
        json_object_set_new(timings, cost->timings.stages[i].name,
                            json_real(cost->timings.stages[i].ms));
    return json_pack("{sf sf sf sf sI sI sI so so}", "seconds", sum.seconds, "processor_s",
                     sum.processor_s, "processors_busy", sum.busy, "frames_per_second",
                     sum.per_second, "processors", (json_int_t)tl_thread_count(),
                     "most_frame_bytes", (json_int_t)cost->most_bytes, "most_resident_bytes",
                     (json_int_t)sum.peak_bytes, "stages", of_stages, "timings_ms", timings);
}

void batch_cost_print(batch_cost *cost, size_t lit_count)
{
    const batch_sum sum = sum_of(cost, lit_count);
    fprintf(stderr, "%-8s %10s %12s\n", "stage", "wall s", "processor s");
    for (int i = 0; i < BATCH_STAGE_COUNT; i++)
        fprintf(stderr, "%-8s %10.3f %12.3f  %s\n", stages[i].word, cost->wall_s[i],
                cost->processor_s[i], stages[i].meaning);
    fprintf(stderr, "%-8s %10s %12.3f  threads of the device's driver\n", "driver", "",
            sum.driver_s);
    fprintf(stderr, "%-8s %10.3f %12.3f  %.0f %% of %u processors busy; %.3g frames a second\n",
            "all", sum.seconds, sum.processor_s, 100.0 * sum.busy, tl_thread_count(),
            sum.per_second);
    for (int i = 0; i < cost->timings.count; i++)
        fprintf(stderr, "%-12s %10.2f ms\n", cost->timings.stages[i].name,
                cost->timings.stages[i].ms);
}

void batch_cost_end_all(batch_cost *cost)
{
    pthread_mutex_destroy(&cost->lock);
}
