/* Runs the real program, in a folder of the test's own. */
#ifndef TL_PROGRAM_H
#define TL_PROGRAM_H

#include "testing.h"

#include <dirent.h>
#include <sys/stat.h>
#include <sys/wait.h>

typedef struct program_run {
    int exit_status;
    char out[65536], err[65536]; /* NUL-terminated, cut to fit */
} program_run;

/* An empty folder in the scratch folder; the process changes into it. */
static inline void enter_empty_folder(const char *name)
{
    char path[4096], command[8300];
    scratch_path(path, sizeof path, name);
    snprintf(command, sizeof command, "chmod -R u+w '%s' 2>&-; rm -rf '%s'", path, path);
    assert_int_equal(system(command), 0);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_int_equal(chdir(path), 0);
}

static inline void read_text(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

/* Runs a shell command in which $T is the program and $D the folder of scenes. Its output lands in
 * the folder above, so that the test's own holds what the program wrote and nothing else. */
static inline const program_run *run_shell(const char *command)
{
    static program_run run;
    static char line[8192];
    snprintf(line, sizeof line,
             "{ T=\"$TILELIGHT_PROGRAM\" D=\"$TILELIGHT_SOURCE/data\"; %s\n} "
             ">../out.%ld 2>../err.%ld </dev/null",
             command, (long)getpid(), (long)getpid());
    const int status = system(line);
    assert_true(WIFEXITED(status));
    run.exit_status = WEXITSTATUS(status);
    snprintf(line, sizeof line, "../out.%ld", (long)getpid());
    read_text(line, run.out, sizeof run.out);
    remove(line);
    snprintf(line, sizeof line, "../err.%ld", (long)getpid());
    read_text(line, run.err, sizeof run.err);
    remove(line);
    return &run;
}

/* Fails unless the command ended with this status and every word stands in what it said. */
static inline const program_run *expect_run(const char *command,
                                            int exit_status,
                                            const char *out_word,
                                            const char *err_word)
{
    const program_run *run = run_shell(command);
    if (run->exit_status != exit_status || !strstr(run->out, out_word) ||
        !strstr(run->err, err_word))
        fail_msg("%s\nended with %d, not %d; it should say \"%s\" and \"%s\", and said\n%s\n%s",
                 command, run->exit_status, exit_status, out_word, err_word, run->out,
                 run->err);
    return run;
}

/* How many files the current folder holds, hidden and temporary ones too. */
static inline size_t count_files(void)
{
    size_t count = 0;
    DIR *folder = opendir(".");
    assert_non_null(folder);
    for (const struct dirent *entry; (entry = readdir(folder));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(folder);
    return count;
}

#endif
