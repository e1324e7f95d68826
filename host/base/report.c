#define _GNU_SOURCE /* CLOCK_BOOTTIME */
#include "tilelight/report.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double tl_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double tl_processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double tl_thread_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds since this process began, as the system says: in whole ticks. Negative if it does not. */
static double age_in_ticks(double tick)
{
    enum { START_FIELD = 22 }; /* of proc_pid_stat(5), counted from 1 */
    char text[1024] = "";
    struct timespec now;
    unsigned long long ticks = 0;
    FILE *file = fopen("/proc/self/stat", "r");
    if (!file)
        return -1.0;
    const char *at = fgets(text, sizeof text, file) ? strrchr(text, ')') : NULL;
    fclose(file);
    for (int field = 2; at && field < START_FIELD; field++)
        at = strchr(at + 1, ' ');
    if (!at || sscanf(at, "%llu", &ticks) != 1)
        return -1.0;
    clock_gettime(CLOCK_BOOTTIME, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec - (double)ticks * tick;
}

/* A process that never had to wait is as old as the processor time it took; what the system says
 * bounds that from both sides. */
double tl_process_start(void)
{
    const double tick = 1.0 / (double)sysconf(_SC_CLK_TCK), now = tl_seconds();
    const double most = age_in_ticks(tick);
    double age = tl_processor_seconds();
    if (most >= 0.0 && age < most - tick)
        age = most - tick;
    if (most >= 0.0 && age > most)
        age = most;
    return now - age;
}

void tl_timings_add(tl_timings *timings, const char *name, double ms)
{
    int i = 0;
    if (!timings)
        return;
    while (i < timings->count && strcmp(timings->stages[i].name, name) != 0)
        i++;
    if (i == TL_MAX_STAGES)
        return;
    if (i == timings->count) {
        timings->stages[i].name = name;
        timings->stages[i].ms = 0.0;
        timings->count++;
    }
    timings->stages[i].ms += ms;
}

double tl_timings_end(tl_timings *timings, const char *name, double start)
{
    const double now = tl_seconds();
    tl_timings_add(timings, name, 1e3 * (now - start));
    return now;
}

void tl_notice(const tl_notices *notices, const char *format, ...)
{
    char sentence[1024];
    va_list args;
    if (!notices || !notices->say)
        return;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    notices->say(notices->context, sentence);
}
