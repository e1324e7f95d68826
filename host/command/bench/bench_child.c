#define _GNU_SOURCE
#include "bench_child.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_ENVIRONMENT = 4096 };

tl_status bench_folder_make(const char *wanted_by, char folder[BENCH_PATH_SIZE], tl_error *err)
{
    const char *temporary = getenv("TMPDIR");
    snprintf(folder, BENCH_PATH_SIZE - 32, "%s/tilelight-bench-XXXXXX",
             temporary ? temporary : "/tmp");
    if (mkdtemp(folder))
        return TL_OK;
    const int reason = errno;
    const tl_status status =
        tl_fail(err, TL_ERR_WRITE, "%s: cannot be made for the frames of %s: %s", folder,
                wanted_by, strerror(reason));
    folder[0] = '\0';
    return status;
}

static int remove_entry(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about, (void)kind, (void)place;
    return remove(path);
}

void bench_folder_remove(const char *folder)
{
    if (folder[0])
        nftw(folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

/* Ours, with compiled programs kept in `cache` and nowhere else. `variable`: its memory. */
static tl_status make_environment(const char *cache,
                                  char variable[BENCH_PATH_SIZE + 32],
                                  char *environment[MOST_ENVIRONMENT],
                                  tl_error *err)
{
    size_t count = 0;
    snprintf(variable, BENCH_PATH_SIZE + 32, "TILELIGHT_CACHE=%s", cache);
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

tl_status bench_child_run(char *const *arguments,
                          const char *cache,
                          const char *report,
                          tl_error *err)
{
    static char *environment[MOST_ENVIRONMENT];
    char program[] = "/proc/self/exe", variable[BENCH_PATH_SIZE + 32];
    posix_spawn_file_actions_t actions;
    pid_t child;
    int wait_status = 0;
    const tl_status status = make_environment(cache, variable, environment, err);
    if (status != TL_OK)
        return status;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, report,
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
