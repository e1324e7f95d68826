#define _POSIX_C_SOURCE 200809L
#include "console.h"

#include "printable.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool is_quiet, stage_shown;

void console_quiet(bool quiet)
{
    is_quiet = quiet;
}

void console_stage(const char *stage)
{
    /* Back to the line's start, and what stands there erased (ECMA-48, EL). */
    static const char clear_line[] = "\r\033[K";
    if (stage_shown)
        fputs(clear_line, stderr);
    stage_shown = stage && !is_quiet && isatty(STDERR_FILENO);
    if (stage_shown)
        fprintf(stderr, "tilelight: %s ...", stage);
    fflush(stderr);
}

/* Names of files may be in it; lines and tabs are those of a compiler's log. */
static void print_sentence(const char *sentence)
{
    char shown[sizeof(tl_error)];
    size_t length = 0;
    for (; sentence[length] && length < sizeof shown - 1; length++) {
        const char c = sentence[length];
        shown[length] = c == '\n' || c == '\t' ? c : tl_printable(c);
    }
    shown[length] = '\0';
    console_stage(NULL);
    fprintf(stderr, "tilelight: %s\n", shown);
}

static void say(void *context, const char *sentence)
{
    (void)context;
    if (!is_quiet)
        print_sentence(sentence);
}

const tl_notices console_notices = {.say = say};

int console_finish(tl_status status, const tl_error *err)
{
    console_stage(NULL);
    if (status != TL_OK)
        print_sentence(err->message);
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
