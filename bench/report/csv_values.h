/* Values of CSV (RFC 4180). */
#ifndef TL_CSV_VALUES_H
#define TL_CSV_VALUES_H

#include <stdio.h>

/* In quotes where it needs them. */
void tl_csv_text(FILE *out, const char *text);

/* After a comma; nothing where it is not finite. */
void tl_csv_number(FILE *out, double value);

#endif
