#define _POSIX_C_SOURCE 200809L
#include "interrupts.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t seen;

static void note(int signal_number)
{
    if (seen) {
        signal(signal_number, SIG_DFL);
        raise(signal_number); /* arrives once this returns */
    }
    seen = signal_number;
}

void interrupts_listen(void)
{
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int interrupts_seen(void)
{
    return (int)seen;
}
