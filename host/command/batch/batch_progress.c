#define _POSIX_C_SOURCE 200809L
#include "batch_progress.h"

#include "console.h"
#include "printable.h"

#include <stdio.h>
#include <unistd.h>

enum { LONGEST = 256 };

batch_progress batch_progress_begin(batch_progress_kind chosen)
{
    batch_progress progress = {.kind = chosen, .start_s = tl_seconds()};
    if (chosen == BATCH_PROGRESS_AUTO)
        progress.kind = isatty(STDERR_FILENO) ? BATCH_PROGRESS_BAR : BATCH_PROGRESS_PLAIN;
    progress.told_s = progress.start_s;
    return progress;
}

static size_t ended(const size_t of[BATCH_OUTCOME_COUNT])
{
    return of[BATCH_DONE] + of[BATCH_UP_TO_DATE] + of[BATCH_FAILED];
}

/* "3 h 20 min", "4 min", "20 s". */
static void format_time(double seconds, char *text, size_t size)
{
    if (seconds < 90.0)
        snprintf(text, size, "%.0f s", seconds);
    else if (seconds < 5400.0)
        snprintf(text, size, "%.0f min", seconds / 60.0);
    else
        snprintf(text, size, "%.0f h %02.0f min", (double)(long)(seconds / 3600.0),
                 (double)((long)(seconds / 60.0) % 60));
}

/* What was up to date took next to no time, and says nothing of what is left. */
static void format_line(const batch_progress *p,
                        size_t count,
                        const size_t of[BATCH_OUTCOME_COUNT],
                        char *line)
{
    const double seconds = tl_seconds() - p->start_s;
    const size_t made = of[BATCH_DONE] + of[BATCH_FAILED], left = count - ended(of);
    const double rate = (double)made / seconds;
    char time[32], failed[48] = "", rest[96] = "";
    if (of[BATCH_FAILED] > 0)
        snprintf(failed, sizeof failed, ", %zu failed", of[BATCH_FAILED]);
    if (made > 0) {
        format_time((double)left / rate, time, sizeof time);
        snprintf(rest, sizeof rest, ", %.3g a second, %s left", rate, time);
    }
    snprintf(line, LONGEST, "%zu of %zu frames%s%s", ended(of), count, failed, rest);
}

/* How often each kind tells, s. */
static const double periods[BATCH_PROGRESS_COUNT] = {
    [BATCH_PROGRESS_BAR] = 0.2,
    [BATCH_PROGRESS_PLAIN] = 10.0,
    [BATCH_PROGRESS_OPENJD] = 1.0,
};

static void tell_openjd(const batch_progress *p,
                        size_t count,
                        const size_t of[BATCH_OUTCOME_COUNT])
{
    char line[LONGEST];
    format_line(p, count, of, line);
    printf("openjd_progress: %.1f\nopenjd_status: %s\n",
           100.0 * (double)ended(of) / (double)count, line);
    fflush(stdout);
}

void batch_progress_tell(batch_progress *p,
                         size_t count,
                         const size_t of[BATCH_OUTCOME_COUNT],
                         bool ends)
{
    const double now = tl_seconds();
    char line[LONGEST];
    if (p->kind == BATCH_PROGRESS_NONE || (!ends && now - p->told_s < periods[p->kind]))
        return;
    if (p->kind == BATCH_PROGRESS_OPENJD && (ends || p->told != ended(of)))
        tell_openjd(p, count, of);
    format_line(p, count, of, line);
    if (p->kind == BATCH_PROGRESS_BAR)
        console_progress(ends ? NULL : line);
    if (p->kind == BATCH_PROGRESS_PLAIN && !ends)
        console_say(line);
    p->told_s = now;
    p->told = ended(of);
}

void batch_progress_fail(const batch_progress *p, const char *sentence)
{
    if (p->kind != BATCH_PROGRESS_OPENJD)
        return;
    fputs("openjd_fail: ", stdout);
    for (; *sentence; sentence++)
        putchar(tl_printable(*sentence));
    putchar('\n');
    fflush(stdout);
}
