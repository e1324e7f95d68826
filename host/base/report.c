#define _POSIX_C_SOURCE 200809L
#include "tilelight/report.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

double tl_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
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
