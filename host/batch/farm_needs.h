/* Memory and time as Slurm writes them, for every scheduler. */
#ifndef TL_FARM_NEEDS_H
#define TL_FARM_NEEDS_H

#include <stdbool.h>
#include <stdint.h>

/* "512", "512M", "4G", up to 1T: MiB unless it ends in K, M, G or T; part of a MiB is a whole one. False, and
 * *mib left alone, for anything else and for 0. */
bool tl_farm_memory(const char *text, uint64_t *mib);

/* "90" minutes, "90:30" with seconds, "1:30:00" hours, "2-12" days and hours, "2-12:30", "2-12:30:00";
 * up to 365 days. False, and *seconds left alone, for anything else and for 0. */
bool tl_farm_time(const char *text, uint64_t *seconds);

/* Whether it can be a partition's name, or several with commas between, in an option of sbatch: letters,
 * digits and ".,_+-". */
bool tl_farm_partition(const char *text);

#endif
