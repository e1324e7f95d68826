/* Of the configurations of a frame, those that none beats in time and in error. */
#ifndef TL_STUDY_FRONT_H
#define TL_STUDY_FRONT_H

#include "values.h"

#include <stddef.h>

/* Sets TL_VALUE_FRONT_LIGHT and TL_VALUE_FRONT_JOB of all records, to 0 or 1. One beats another that is not
 * faster and has no smaller RMS error, where it is better in one of the two; of equals the first is taken.
 *
 * Of lighting only those compete whose files are the default's: times are ratios of lighting. Of jobs all
 * do, radiance with radiance and screens with screens, for errors of the one say nothing of the other.
 * Those without a time or an error are on neither. Cannot fail. */
void tl_study_front_find(tl_study_record *records, size_t count);

#endif
