#define _POSIX_C_SOURCE 200809L
#include "console.h"

#include "printable.h"

#include <errno.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* of what follows */
static bool is_quiet, line_shown;
static const tl_notices *borrower; /* of notices; NULL: they are said */

void console_quiet(bool quiet)
{
    is_quiet = quiet;
}

void console_lend(const tl_notices *to)
{
    pthread_mutex_lock(&lock);
    borrower = to;
    pthread_mutex_unlock(&lock);
}

static bool is_lent(void)
{
    pthread_mutex_lock(&lock);
    const bool lent = borrower != NULL;
    pthread_mutex_unlock(&lock);
    return lent;
}

/* Under the lock. */
static void show_line(const char *line, const char *end)
{
    /* Back to the line's start, and what stands there erased (ECMA-48, EL). */
    static const char clear_line[] = "\r\033[K";
    if (line_shown)
        fputs(clear_line, stderr);
    line_shown = line && !is_quiet && isatty(STDERR_FILENO);
    if (line_shown)
        fprintf(stderr, "tilelight: %s%s", line, end);
    fflush(stderr);
}

void console_progress(const char *line)
{
    pthread_mutex_lock(&lock);
    show_line(line, "");
    pthread_mutex_unlock(&lock);
}

void console_stage(const char *stage)
{
    pthread_mutex_lock(&lock);
    if (!borrower)
        show_line(stage, " ...");
    pthread_mutex_unlock(&lock);
}

/* Names of files may be in it; lines and tabs are those of a compiler's log. */
void console_complain(const char *sentence)
{
    char shown[sizeof(tl_error)];
    size_t length = 0;
    for (; sentence[length] && length < sizeof shown - 1; length++) {
        const char c = sentence[length];
        shown[length] = c == '\n' || c == '\t' ? c : tl_printable(c);
    }
    shown[length] = '\0';
    pthread_mutex_lock(&lock);
    show_line(NULL, "");
    fprintf(stderr, "tilelight: %s\n", shown);
    pthread_mutex_unlock(&lock);
}

void console_say(const char *sentence)
{
    if (!is_quiet)
        console_complain(sentence);
}

static void say(void *context, const char *sentence)
{
    (void)context;
    if (is_lent() && !is_quiet)
        borrower->say(borrower->context, sentence);
    else
        console_say(sentence);
}

const tl_notices console_notices = {.say = say};

int console_finish(tl_status status, const tl_error *err)
{
    console_progress(NULL);
    if (status != TL_OK)
        console_complain(err->message);
    return tl_exit_status(status);
}

tl_status console_flush(tl_error *err)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout))
        return TL_OK;
    return tl_fail(err, TL_ERR_WRITE, "standard output could not be written: %s",
                   errno ? strerror(errno) : "an earlier write failed");
}
