/* SIGINT and SIGTERM, for work that ends in order: the first is noted, a second one ends the process at once. */
#ifndef TL_INTERRUPTS_H
#define TL_INTERRUPTS_H

void interrupts_listen(void);

/* The signal that came; 0: none. */
int interrupts_seen(void);

#endif
