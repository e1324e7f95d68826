#define _POSIX_C_SOURCE 200809L
#include "farm_submit.h"

#include "farm_schedulers.h"
#include "try.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { JOB_SIZE = 64 }; /* "12" or, of several clusters, "12;cluster" */

/* Starts sbatch, which reads `script` and writes to `answer`. */
static tl_status start(
    char *const *arguments, int script, int answer, pid_t *child, tl_error *err)
{
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, script, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, answer, STDOUT_FILENO);
    const int error_number =
        posix_spawnp(child, arguments[0], &files, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    if (error_number == 0)
        return TL_OK;
    return tl_fail(err, TL_ERR_UNSUPPORTED,
                   "sbatch cannot be run: %s; without --submit the script is printed, to be "
                   "submitted elsewhere",
                   strerror(error_number));
}

/* The job's number, which sbatch --parsable writes alone on a line. */
static tl_status read_job(FILE *answer, char job[JOB_SIZE], tl_error *err)
{
    rewind(answer);
    if (!fgets(job, JOB_SIZE, answer))
        return tl_fail(err, TL_ERR_WRITE, "sbatch did not say which job it made");
    job[strcspn(job, ";\n")] = '\0';
    return TL_OK;
}

static tl_status submit(char *const *arguments, FILE *script, char job[JOB_SIZE], tl_error *err)
{
    tl_status status = TL_OK;
    pid_t child;
    int ended = 0;
    FILE *answer = tmpfile();
    if (!answer || lseek(fileno(script), 0, SEEK_SET) != 0)
        TRY(tl_fail(err, TL_ERR_WRITE, "no temporary file can be made: %s", strerror(errno)));
    TRY(start(arguments, fileno(script), fileno(answer), &child, err));
    while (waitpid(child, &ended, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 0)
        TRY(tl_fail(err, TL_ERR_WRITE, "sbatch refused the job"));
    TRY(read_job(answer, job, err));
done:
    if (answer)
        fclose(answer);
    return status;
}

static tl_status submit_gather(const tl_farm_plan *plan,
                               const char *array_job,
                               FILE *script,
                               char job[JOB_SIZE],
                               tl_error *err)
{
    char task[48], behind[JOB_SIZE + 32];
    char name[] = "sbatch", parsable[] = "--parsable";
    char *const arguments[] = {name, parsable, task, behind, NULL};
    tl_error why;
    snprintf(task, sizeof task, "--array=%zu", plan->chunk_count);
    snprintf(behind, sizeof behind, "--dependency=afterany:%s", array_job);
    const tl_status status = submit(arguments, script, job, &why);
    return status == TL_OK ? TL_OK
                           : tl_fail(err, status, "%s: job %s runs without a gather behind it",
                                     why.message, array_job);
}

tl_status farm_submit(const tl_farm_plan *plan, tl_error *err)
{
    char name[] = "sbatch", parsable[] = "--parsable";
    char *const arguments[] = {name, parsable, NULL};
    char array_job[JOB_SIZE], gather_job[JOB_SIZE];
    tl_status status = TL_OK;
    FILE *script = tmpfile();
    if (!script)
        TRY(tl_fail(err, TL_ERR_WRITE, "no temporary file can be made: %s", strerror(errno)));
    TRY(tl_farm_print_slurm(plan, script, err));
    if (fflush(script) != 0)
        TRY(tl_fail(err, TL_ERR_WRITE, "the script cannot be written: %s", strerror(errno)));
    TRY(submit(arguments, script, array_job, err));
    TRY(submit_gather(plan, array_job, script, gather_job, err));
    printf("job %s: %zu chunks of %zu frames; gather: job %s\n", array_job, plan->chunk_count,
           plan->frame_count, gather_job);
done:
    if (script)
        fclose(script);
    return status;
}
