/* How long the program takes to its first kernel: child processes that light a small frame, with
 * nothing compiled before (cold) and with everything (warm). */
#define _GNU_SOURCE
#include "bench_json.h"
#include "bench_session.h"
#include "console.h"
#include "json_values.h"
#include "tilelight/gbuffer_file.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* A cold start takes seconds, and differs little from the next: 3, or fewer where fewer are asked
 * for. */
enum { MOST_COLD_STARTS = 3, PATH_SIZE = 256, MOST_ENVIRONMENT = 4096 };

typedef struct start_times {
    tl_samples first_kernel, process; /* ms */
} start_times;

typedef struct startup {
    const char *device;      /* selector; NULL: the default */
    char folder[PATH_SIZE];  /* of our own, removed at the end; empty: none */
    char gbuffer[PATH_SIZE]; /* files in it */
    char picture[PATH_SIZE], report[PATH_SIZE];
    start_times cold, warm;
} startup;

static tl_status make_frame(bench_session *s, startup *u, tl_error *err)
{
    tl_bench_lists lists = s->options->lists;
    const char *temporary = getenv("TMPDIR");
    tl_status status = TL_OK;
    lists.of[TL_AXIS_SIZE] = "64x64";
    lists.of[TL_AXIS_LIGHTS] = "8";
    TRY(tl_bench_cases_add(&s->cases, &lists, err));
    const char *word = s->cases.cases[0].words[TL_AXIS_DEVICE];
    u->device = strcmp(word, tl_bench_axes[TL_AXIS_DEVICE].usual) == 0 ? NULL : word;
    TRY(tl_bench_frame_make(&s->frame, &s->cases.cases[0], err));
    snprintf(u->folder, sizeof u->folder - 32, "%s/tilelight-bench-XXXXXX",
             temporary ? temporary : "/tmp");
    if (!mkdtemp(u->folder)) {
        const int reason = errno;
        const tl_status failed =
            tl_fail(err, TL_ERR_WRITE, "%s: cannot be made for the frame of --startup: %s",
                    u->folder, strerror(reason));
        u->folder[0] = '\0';
        TRY(failed);
    }
    snprintf(u->gbuffer, sizeof u->gbuffer, "%.200s/frame.exr", u->folder);
    snprintf(u->picture, sizeof u->picture, "%.200s/lit.exr", u->folder);
    snprintf(u->report, sizeof u->report, "%.200s/report.json", u->folder);
    TRY(tl_gbuffer_write(u->gbuffer, s->frame.gbuffer, &s->frame.lights, err));
done:
    return status;
}

/* Ours, with compiled programs kept in `cache` and nowhere else. `variable`: its memory. */
static tl_status make_environment(const char *cache,
                                  char variable[PATH_SIZE + 32],
                                  char *environment[MOST_ENVIRONMENT],
                                  tl_error *err)
{
    size_t count = 0;
    snprintf(variable, PATH_SIZE + 32, "TILELIGHT_CACHE=%s", cache);
    for (char **entry = environ; *entry; entry++) {
        if (strncmp(*entry, "TILELIGHT_CACHE=", 16) == 0 ||
            strncmp(*entry, "POCL_CACHE_DIR=", 15) == 0)
            continue;
        if (count == MOST_ENVIRONMENT - 2)
            return tl_fail(err, TL_ERR_ARGUMENT, "the environment has more than %d variables",
                           MOST_ENVIRONMENT - 2);
        environment[count++] = *entry;
    }
    environment[count++] = variable;
    environment[count] = NULL;
    return TL_OK;
}

/* A `tilelight light` of the frame, its report going to a file. */
static tl_status run_child(const startup *u, char **environment, tl_error *err)
{
    char program[] = "/proc/self/exe", name[] = "tilelight", light[] = "light", o[] = "-o",
         json[] = "--json", timings[] = "--timings", device[] = "--device";
    char gbuffer[PATH_SIZE], picture[PATH_SIZE], selector[TL_BENCH_WORD_SIZE] = "";
    char *arguments[] = {name,     light, gbuffer, o,
                         picture,  json,  timings, u->device ? device : NULL,
                         selector, NULL};
    posix_spawn_file_actions_t actions;
    pid_t child;
    int wait_status = 0;
    snprintf(gbuffer, sizeof gbuffer, "%s", u->gbuffer);
    snprintf(picture, sizeof picture, "%s", u->picture);
    if (u->device)
        snprintf(selector, sizeof selector, "%s", u->device);
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, u->report,
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int failure = posix_spawn(&child, program, &actions, NULL, arguments, environment);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0)
        return tl_fail(err, TL_ERR_DIFFERENT, "the program cannot be started: %s",
                       strerror(failure));
    while (waitpid(child, &wait_status, 0) < 0 && errno == EINTR)
        ;
    if (!WIFEXITED(wait_status) || WEXITSTATUS(wait_status) != 0)
        return tl_fail(err, TL_ERR_DIFFERENT,
                       "the program, started to be measured, failed to light a frame");
    return TL_OK;
}

/* times NULL: the start only fills the cache. */
static tl_status start_once(const startup *u,
                            const char *cache,
                            start_times *times,
                            tl_error *err)
{
    tl_status status = TL_OK;
    char variable[PATH_SIZE + 32];
    static char *environment[MOST_ENVIRONMENT];
    json_t *report = NULL;
    TRY(make_environment(cache, variable, environment, err));
    const double start = tl_seconds();
    TRY(run_child(u, environment, err));
    const double process_ms = 1e3 * (tl_seconds() - start);
    if (!times)
        goto done;
    TRY(tl_json_read(u->report, &report, err));
    TRY(tl_samples_add(&times->process, process_ms, err));
    TRY(tl_samples_add(&times->first_kernel,
                       json_number_value(json_object_get(report, "first_kernel_ms")), err));
done:
    json_decref(report);
    return status;
}

static tl_status measure(const bench_session *s, startup *u, tl_error *err)
{
    tl_status status = TL_OK;
    char cache[PATH_SIZE + 16] = "";
    const size_t asked = s->options->rule.least_samples;
    for (size_t i = 0; i < MOST_COLD_STARTS && i < asked; i++) {
        console_stage("starting cold");
        snprintf(cache, sizeof cache, "%s/cache-%zu", u->folder, i);
        TRY(start_once(u, cache, &u->cold, err));
    }
    TRY(start_once(u, cache, NULL, err)); /* the disk's cache too */
    console_stage("starting warm");
    const double start = tl_seconds();
    do {
        TRY(start_once(u, cache, &u->warm, err));
    } while (!tl_sampling_done(&s->options->rule, &u->warm.first_kernel, start));
    console_stage(NULL);
done:
    return status;
}

static void print_times(FILE *out, const char *name, const start_times *times)
{
    const tl_summary first = tl_samples_summarize(&times->first_kernel);
    const tl_summary process = tl_samples_summarize(&times->process);
    fprintf(out, "%-6s %15.1f %10.1f %10.1f %15.1f %8zu\n", name, first.median, first.least,
            first.p90, process.median, first.count);
}

static json_t *times_json(const start_times *times)
{
    const tl_summary first = tl_samples_summarize(&times->first_kernel);
    const tl_summary process = tl_samples_summarize(&times->process);
    return json_pack("{so so}", "first_kernel_ms", tl_bench_json_summary(&first), "process_ms",
                     tl_bench_json_summary(&process));
}

static int remove_entry(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about, (void)kind, (void)place;
    return remove(path);
}

static void release(startup *u)
{
    if (u->folder[0])
        nftw(u->folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    tl_samples_clear(&u->cold.first_kernel);
    tl_samples_clear(&u->cold.process);
    tl_samples_clear(&u->warm.first_kernel);
    tl_samples_clear(&u->warm.process);
}

tl_status bench_run_startup(bench_session *s, tl_error *err)
{
    tl_status status = TL_OK;
    startup u = {.device = NULL};
    TRY(make_frame(s, &u, err));
    TRY(measure(s, &u, err));
    if (s->table) {
        fprintf(s->table, "%-6s %15s %10s %10s %15s %8s\n", "start", "first kernel ms", "least",
                "p90", "whole process", "samples");
        print_times(s->table, "cold", &u.cold);
        print_times(s->table, "warm", &u.warm);
    }
    if (s->options->json) {
        json_t *report = tl_bench_json_begin(&s->machine);
        json_object_set_new(
            report, "startup",
            json_pack("{so so}", "cold", times_json(&u.cold), "warm", times_json(&u.warm)));
        TRY(tl_json_write(s->options->json, report, err));
    }
done:
    release(&u);
    return status;
}
