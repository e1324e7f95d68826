/* Compiled programs, and skies as surfaces mirror them, kept on disk: a folder of entries, one a file, found
 * by key.
 *
 * An entry holds its whole key, so a collision of names is seen; a checksum of all its bytes, so
 * damage is; and its own lengths, so a cut is. What is damaged, cut, of an older format or of
 * another key counts as missing and is replaced by the next write. Entries appear whole or not at
 * all (atomic_file.h), so processes that read and write one folder need no agreement; a lock only
 * spares all but one of them the work of making the same entry.
 *
 * Nothing here fails: a folder that is missing, full or read-only costs time, and no more. */
#ifndef TL_PROGRAM_CACHE_H
#define TL_PROGRAM_CACHE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tl_bytes {
    const void *data; /* may be NULL where size is 0 */
    size_t size;
} tl_bytes;

/* What is kept under a key. */
typedef struct tl_program_entry {
    tl_bytes note;   /* the caller's own words on the binary */
    tl_bytes binary; /* aligned to 8 bytes */
    void *memory;    /* owned, holds both; NULL where there is no entry */
} tl_program_entry;

/* Of a folder, bytes: 500 programs of a quarter of a megabyte, or 20 skies. */
#define TL_CACHE_LIMIT ((uint64_t)128 << 20)

/* The folder by the environment: TILELIGHT_CACHE; else tilelight in XDG_CACHE_HOME, if that is an
 * absolute path; else .cache/tilelight in HOME. The caller frees it. NULL where caching is off:
 * TILELIGHT_CACHE is empty, there is no home, or memory ran out. The folder need not exist. */
char *tl_program_cache_folder(void);

/* Makes the folder, for its owner alone, and every one on the way. What fails shows when a file is written.
 * */
void tl_program_cache_make_folder(const char *folder);

/* What the names of other files end with that are kept beside the programs, of promises
 * (host/promise/memory.h): trimming counts and removes them alike. */
#define TL_PROMISE_SUFFIX ".promise.json"

/* Whether there is a sound entry; *entry is then released with tl_program_entry_release, and is all
 * zero if not. Marks the entry as used now. */
bool tl_program_cache_read(const char *folder, tl_bytes key, tl_program_entry *entry);

/* Accepts one that is all zero, and leaves it so. */
void tl_program_entry_release(tl_program_entry *entry);

/* Makes the folder (for its owner alone) and puts the entry in place of any of that key. Returns
 * whether it did. */
bool tl_program_cache_write(const char *folder, tl_bytes key, tl_bytes note, tl_bytes binary);

/* Waits to be the one process, and the one caller in it, that makes the entry of this key. Returns
 * a descriptor for tl_program_cache_unlock, or -1: waited for `seconds`, an entry appeared
 * meanwhile, or the folder cannot hold locks. A process that dies gives up its lock. */
int tl_program_cache_lock(const char *folder, tl_bytes key, double seconds);

/* Accepts -1. */
void tl_program_cache_unlock(const char *folder, tl_bytes key, int lock);

/* Removes the entries used longest ago until all together have at most `limit` bytes, and what
 * killed processes left behind. */
void tl_program_cache_trim(const char *folder, uint64_t limit);

#endif
