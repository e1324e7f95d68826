/* The machine that measures, as far as times depend on it. */
#ifndef TL_MACHINE_H
#define TL_MACHINE_H

#include <stddef.h>

typedef struct tl_machine {
    char processor[128]; /* as the system calls it; "unknown" */
    unsigned threads;    /* that the process may use */
    /* of the last minute, when it was asked: above 0 something else runs too; NAN unknown */
    double load;
} tl_machine;

/* Cannot fail. */
tl_machine tl_machine_ask(void);

#endif
