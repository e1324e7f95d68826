#define _POSIX_C_SOURCE 200809L
#include "record.h"

#include "named_files.h"
#include "regular_file.h"
#include "try.h"

#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

enum {
    SLOTS = 1024, /* for files that are kept, each where its path says, the last one there */
    PIECE = 256 << 10, /* bytes that are read at once */
    SETTLED_S = 2      /* since a file's last change, for it to be kept */
};

/* By which a file is told to be the one of before. */
typedef struct stamp {
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec modified, changed;
} stamp;

/* A file and what it came to. All zero is empty. */
typedef struct known {
    char *path;
    tl_record_role role;
    stamp seen;
    XXH128_hash_t hash;   /* of its content */
    tl_named_files names; /* that its role makes count */
} known;

struct tl_record_cache {
    pthread_mutex_t lock;
    known slots[SLOTS];
};

tl_status tl_record_cache_create(tl_record_cache **out, tl_error *err)
{
    tl_record_cache *made = calloc(1, sizeof *made);
    if (!made || pthread_mutex_init(&made->lock, NULL) != 0) {
        free(made);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for hashes of files");
    }
    *out = made;
    return TL_OK;
}

static void forget(known *slot)
{
    free(slot->path);
    tl_named_files_clear(&slot->names);
    *slot = (known){.path = NULL};
}

void tl_record_cache_destroy(tl_record_cache *cache)
{
    if (!cache)
        return;
    for (size_t i = 0; i < SLOTS; i++)
        forget(&cache->slots[i]);
    pthread_mutex_destroy(&cache->lock);
    free(cache);
}

static bool is_same_time(struct timespec a, struct timespec b)
{
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

static bool is_same(const stamp *a, const stamp *b)
{
    return a->device == b->device && a->inode == b->inode && a->size == b->size &&
           is_same_time(a->modified, b->modified) && is_same_time(a->changed, b->changed);
}

static tl_status take_stamp(const char *path, stamp *out, tl_error *err)
{
    struct stat seen;
    if (stat(path, &seen) != 0)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, strerror(errno));
    *out = (stamp){seen.st_dev, seen.st_ino, seen.st_size, seen.st_mtim, seen.st_ctim};
    return TL_OK;
}

static tl_status hash_content(const char *path, XXH128_hash_t *out, tl_error *err)
{
    tl_status status = TL_OK;
    uint64_t size, at = 0;
    int file = -1;
    XXH3_state_t *state = XXH3_createState();
    char *piece = malloc(PIECE);
    size_t got = 0;
    if (!state || !piece)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its hash", path));
    XXH3_128bits_reset(state);
    TRY(tl_regular_file_open(path, &file, &size, err));
    do {
        if (!tl_regular_file_read_at(file, piece, PIECE, at, &got))
            TRY(tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", path, strerror(errno)));
        XXH3_128bits_update(state, piece, got);
        at += got;
    } while (got == PIECE);
    *out = XXH3_128bits_digest(state);
done:
    if (file >= 0)
        close(file);
    free(piece);
    XXH3_freeState(state);
    return status;
}

static tl_status find_names(const tl_record_file *file, tl_named_files *out, tl_error *err)
{
    if (file->role == TL_RECORD_LIGHTS)
        return tl_lights_named_files(file->path, out, err);
    if (file->role == TL_RECORD_CAPTURE)
        return tl_capture_named_files(file->path, out, err);
    return TL_OK;
}

/* Reads the file; *out is released with forget, also where it fails. */
static tl_status look(const tl_record_file *file, known *out, tl_error *err)
{
    tl_status status = TL_OK;
    *out = (known){.path = strdup(file->path), .role = file->role};
    if (!out->path)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for its hash", file->path));
    TRY(take_stamp(file->path, &out->seen, err));
    TRY(hash_content(file->path, &out->hash, err));
    TRY(find_names(file, &out->names, err));
done:
    return status;
}

static known *slot_of(tl_record_cache *cache, const tl_record_file *file)
{
    return &cache->slots[XXH3_64bits_withSeed(file->path, strlen(file->path), file->role) %
                         SLOTS];
}

static tl_status copy_names(const tl_named_files *from, tl_named_files *out, tl_error *err)
{
    tl_named_files made = {.of = calloc(from->count + 1, sizeof *made.of)};
    for (; made.of && made.count < from->count; made.count++)
        if (!(made.of[made.count] = strdup(from->of[made.count])))
            break;
    if (!made.of || made.count < from->count) {
        tl_named_files_clear(&made);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for names of files");
    }
    *out = made;
    return TL_OK;
}

/* *is_known: whether the slot has the file as it is now; then *out is a copy, without path, which forget
 * releases. */
static tl_status recall(tl_record_cache *cache,
                        const tl_record_file *file,
                        bool *is_known,
                        known *out,
                        tl_error *err)
{
    stamp now = {0};
    tl_status status = take_stamp(file->path, &now, err);
    if (status != TL_OK)
        return status;
    pthread_mutex_lock(&cache->lock);
    const known *slot = slot_of(cache, file);
    *is_known = slot->path && slot->role == file->role && strcmp(slot->path, file->path) == 0 &&
                is_same(&slot->seen, &now);
    if (*is_known) {
        *out = (known){.hash = slot->hash};
        status = copy_names(&slot->names, &out->names, err);
    }
    pthread_mutex_unlock(&cache->lock);
    return status;
}

/* Another change within the same tick of the clock would not show. */
static bool is_settled(const stamp *seen)
{
    return time(NULL) - seen->changed.tv_sec >= SETTLED_S;
}

/* Moves it into the cache, in the place of what was there. */
static void keep(tl_record_cache *cache, const tl_record_file *file, known *found)
{
    pthread_mutex_lock(&cache->lock);
    known *slot = slot_of(cache, file);
    forget(slot);
    *slot = *found;
    *found = (known){.path = NULL};
    pthread_mutex_unlock(&cache->lock);
}

/* Adds a file's content, and those of the files that it names. */
static tl_status add_file(tl_record_cache *cache,
                          const tl_record_file *file,
                          XXH3_state_t *state,
                          tl_error *err)
{
    tl_status status = TL_OK;
    known found = {.path = NULL};
    bool is_known = false;
    if (file->role != TL_RECORD_CAPTURE)
        TRY(recall(cache, file, &is_known, &found, err));
    if (!is_known)
        TRY(look(file, &found, err));
    const bool is_new = !is_known && file->role != TL_RECORD_CAPTURE && is_settled(&found.seen);
    XXH128_canonical_t hash;
    XXH128_canonicalFromHash(&hash, found.hash);
    XXH3_128bits_update(state, &hash, sizeof hash);
    for (size_t i = 0; i < found.names.count; i++)
        TRY(add_file(cache, &(tl_record_file){found.names.of[i], TL_RECORD_PLAIN}, state, err));
    if (is_new)
        keep(cache, file, &found);
done:
    forget(&found);
    return status;
}

/* With its NUL, so that no two lists of texts read the same. */
static void add_text(XXH3_state_t *state, const char *text)
{
    XXH3_128bits_update(state, text, strlen(text) + 1);
}

tl_status tl_record_of(tl_record_cache *cache,
                       const char *options,
                       const char *version,
                       const tl_record_file *files,
                       size_t count,
                       char out[TL_RECORD_SIZE],
                       tl_error *err)
{
    tl_status status = TL_OK;
    XXH3_state_t *state = XXH3_createState();
    if (!state)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a record"));
    XXH3_128bits_reset(state);
    add_text(state, version);
    add_text(state, options);
    for (size_t i = 0; i < count; i++)
        TRY(add_file(cache, &files[i], state, err));
    const XXH128_hash_t hash = XXH3_128bits_digest(state);
    snprintf(out, TL_RECORD_SIZE, "1 %016llx%016llx", (unsigned long long)hash.high64,
             (unsigned long long)hash.low64);
done:
    XXH3_freeState(state);
    return status;
}
