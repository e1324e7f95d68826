#define _GNU_SOURCE /* asprintf, flock, futimens */
#include "program_cache.h"

#include "atomic_file.h"
#include "tilelight/report.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

/* Changes with the layout of an entry; the letters keep other files out. */
static const char magic[8] = "tlprog1";

static const char entry_suffix[] = ".program", lock_suffix[] = ".lock";

/* What a file begins with; key, note and binary follow, each padded to 8 bytes. Numbers are in the
 * byte order of the machine: an entry of another machine has another key. */
typedef struct entry_header {
    char magic[8];
    uint64_t key_size, note_size, binary_size; /* without padding */
    XXH128_hash_t checksum;                    /* of the header with this zero, and the rest */
} entry_header;

enum {
    MAX_ENTRY_SIZE =
        1 << 30,          /* beyond every program; bounds what a damaged header can ask for */
    LEFTOVER_AGE_S = 3600 /* no process writes one file for an hour */
};

char *tl_program_cache_folder(void)
{
    const char *own = getenv("TILELIGHT_CACHE");
    const char *caches = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char *folder = NULL;
    if (own)
        return own[0] ? strdup(own) : NULL;
    if (caches && caches[0] == '/')
        return asprintf(&folder, "%s/tilelight", caches) < 0 ? NULL : folder;
    if (home && home[0] == '/')
        return asprintf(&folder, "%s/.cache/tilelight", home) < 0 ? NULL : folder;
    return NULL;
}

/* The caller frees it; NULL if memory ran out. */
static char *path_of(const char *folder, tl_bytes key, const char *suffix)
{
    const XXH128_hash_t hash = XXH3_128bits(key.data, key.size);
    char *path = NULL;
    return asprintf(&path, "%s/%016llx%016llx%s", folder, (unsigned long long)hash.high64,
                    (unsigned long long)hash.low64, suffix) < 0
               ? NULL
               : path;
}

static uint64_t padded(uint64_t size)
{
    return (size + 7) / 8 * 8;
}

static XXH128_hash_t checksum_of(const entry_header *header, const void *body, size_t size)
{
    entry_header blank = *header;
    blank.checksum = (XXH128_hash_t){0};
    return XXH3_128bits_withSeed(body, size, XXH3_64bits(&blank, sizeof blank));
}

/* The whole file, or NULL. */
static void *load(int descriptor, size_t *size)
{
    struct stat seen;
    size_t got = 0;
    if (fstat(descriptor, &seen) != 0 || !S_ISREG(seen.st_mode) ||
        seen.st_size < (off_t)sizeof(entry_header) || seen.st_size > MAX_ENTRY_SIZE)
        return NULL;
    *size = (size_t)seen.st_size;
    char *bytes = malloc(*size);
    while (bytes && got < *size) {
        const ssize_t count = read(descriptor, bytes + got, *size - got);
        if (count <= 0 && !(count < 0 && errno == EINTR)) {
            free(bytes);
            return NULL;
        }
        got += count > 0 ? (size_t)count : 0;
    }
    return bytes;
}

/* Whether `size` bytes are an entry of this key, whole and undamaged. */
static bool is_sound(const char *bytes, size_t size, tl_bytes key)
{
    entry_header header;
    memcpy(&header, bytes, sizeof header);
    const char *body = bytes + sizeof header;
    const size_t body_size = size - sizeof header;
    if (memcmp(header.magic, magic, sizeof magic) != 0 || header.key_size != key.size ||
        header.note_size > MAX_ENTRY_SIZE || header.binary_size > MAX_ENTRY_SIZE ||
        padded(header.key_size) + padded(header.note_size) + padded(header.binary_size) !=
            body_size)
        return false;
    return XXH128_isEqual(checksum_of(&header, body, body_size), header.checksum) &&
           memcmp(body, key.data, key.size) == 0;
}

bool tl_program_cache_read(const char *folder, tl_bytes key, tl_program_entry *entry)
{
    entry_header header;
    size_t size = 0;
    char *path = path_of(folder, key, entry_suffix);
    const int descriptor = path ? open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC) : -1;
    free(path);
    *entry = (tl_program_entry){0};
    if (descriptor < 0)
        return false;
    char *bytes = load(descriptor, &size);
    if (bytes && is_sound(bytes, size, key)) {
        memcpy(&header, bytes, sizeof header);
        const char *note = bytes + sizeof header + padded(header.key_size);
        *entry = (tl_program_entry){{note, header.note_size},
                                    {note + padded(header.note_size), header.binary_size},
                                    bytes};
        futimens(descriptor, NULL);
        bytes = NULL;
    }
    free(bytes);
    close(descriptor);
    return entry->memory != NULL;
}

void tl_program_entry_release(tl_program_entry *entry)
{
    free(entry->memory);
    *entry = (tl_program_entry){0};
}

/* Every folder on the way, as the XDG base directory specification has them. */
void tl_program_cache_make_folder(const char *folder)
{
    char *path = strdup(folder);
    for (char *at = path; at && (at = strchr(at + 1, '/'));) {
        *at = '\0';
        mkdir(path, 0700);
        *at = '/';
    }
    if (path)
        mkdir(path, 0700);
    free(path);
}

/* The bytes of an entry's file. The caller frees them; NULL if memory ran out. */
static char *assemble(tl_bytes key, tl_bytes note, tl_bytes binary, size_t *size)
{
    const tl_bytes parts[] = {key, note, binary};
    entry_header header = {
        .key_size = key.size, .note_size = note.size, .binary_size = binary.size};
    memcpy(header.magic, magic, sizeof magic);
    *size = sizeof header + padded(key.size) + padded(note.size) + padded(binary.size);
    char *bytes = calloc(1, *size), *at = bytes ? bytes + sizeof header : NULL;
    if (!bytes)
        return NULL;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (parts[i].size > 0)
            memcpy(at, parts[i].data, parts[i].size);
        at += padded(parts[i].size);
    }
    header.checksum = checksum_of(&header, bytes + sizeof header, *size - sizeof header);
    memcpy(bytes, &header, sizeof header);
    return bytes;
}

bool tl_program_cache_write(const char *folder, tl_bytes key, tl_bytes note, tl_bytes binary)
{
    tl_atomic_file file = {0};
    size_t size = 0;
    bool written = false;
    char *path = path_of(folder, key, entry_suffix);
    char *bytes = assemble(key, note, binary, &size);
    tl_program_cache_make_folder(folder);
    if (path && bytes && size <= MAX_ENTRY_SIZE &&
        tl_atomic_file_begin(&file, path, NULL) == TL_OK)
        written = tl_write_all(file.descriptor, bytes, size) == 0 &&
                  tl_atomic_file_commit(&file, NULL) == TL_OK;
    tl_atomic_file_abandon(&file);
    free(bytes);
    free(path);
    return written;
}

static void sleep_for(double seconds)
{
    const struct timespec duration = {0, (long)(1e9 * seconds)};
    nanosleep(&duration, NULL);
}

/* An exclusive lock on the file that bears the name now: whoever gives a lock up removes its file,
 * and a lock on a removed one excludes nobody. Sets *wait where another holds it. */
static int try_lock(const char *path, bool *wait)
{
    struct stat held, named;
    const int lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    *wait = false;
    if (lock < 0)
        return -1;
    if (flock(lock, LOCK_EX | LOCK_NB) == 0) {
        if (fstat(lock, &held) == 0 && stat(path, &named) == 0 && held.st_ino == named.st_ino &&
            held.st_dev == named.st_dev)
            return lock;
        *wait = true;
    } else {
        *wait = errno == EWOULDBLOCK || errno == EINTR;
    }
    close(lock);
    return -1;
}

/* Tells a file from what is put in its place; 0 if there is none. */
static ino_t identity(const char *path)
{
    struct stat seen;
    return stat(path, &seen) == 0 ? seen.st_ino : 0;
}

int tl_program_cache_lock(const char *folder, tl_bytes key, double seconds)
{
    const double end = tl_seconds() + seconds;
    char *path = path_of(folder, key, lock_suffix);
    char *entry = path_of(folder, key, entry_suffix);
    bool wait = path && entry, appeared = false;
    int lock = -1;
    tl_program_cache_make_folder(folder);
    /* What is there already was read and found unfit. */
    const ino_t unfit = entry ? identity(entry) : 0;
    while (wait && lock < 0 && !appeared) {
        lock = try_lock(path, &wait);
        const ino_t now = identity(entry);
        appeared = now != 0 && now != unfit;
        wait = wait && tl_seconds() < end;
        if (wait && lock < 0 && !appeared)
            sleep_for(0.01);
    }
    if (appeared) {
        tl_program_cache_unlock(folder, key, lock);
        lock = -1;
    }
    free(entry);
    free(path);
    return lock;
}

void tl_program_cache_unlock(const char *folder, tl_bytes key, int lock)
{
    if (lock < 0)
        return;
    char *path = path_of(folder, key, lock_suffix);
    if (path)
        unlink(path);
    free(path);
    close(lock);
}

typedef struct found_file {
    char name[256];
    uint64_t size;
    struct timespec used;
} found_file;

typedef struct found_files {
    found_file *of;
    size_t count, room;
    uint64_t size;
} found_files;

static bool ends_with(const char *name, const char *suffix)
{
    const size_t length = strlen(name), end = strlen(suffix);
    return length > end && strcmp(name + length - end, suffix) == 0;
}

static void note_entry(found_files *found, const char *name, const struct stat *seen)
{
    if (found->count == found->room) {
        const size_t room = found->room ? 2 * found->room : 64;
        found_file *grown = realloc(found->of, room * sizeof *grown);
        if (!grown)
            return;
        found->of = grown;
        found->room = room;
    }
    found_file *made = &found->of[found->count++];
    *made = (found_file){.size = (uint64_t)seen->st_size, .used = seen->st_mtim};
    snprintf(made->name, sizeof made->name, "%s", name);
    found->size += made->size;
}

/* Entries; and leftovers, which are removed: locks and half-written files that nobody has touched
 * for long. Their names are told by the suffixes; nothing else in the folder is ours. */
static void look_through(int folder, DIR *opened, found_files *found)
{
    struct stat seen;
    const time_t now = time(NULL);
    for (const struct dirent *entry; (entry = readdir(opened));) {
        const char *name = entry->d_name;
        const bool is_entry = name[0] != '.' && (ends_with(name, entry_suffix) ||
                                                 ends_with(name, TL_PROMISE_SUFFIX));
        const bool is_leftover = ends_with(name, lock_suffix) ||
                                 (name[0] == '.' && (strstr(name, ".program.tilelight-") ||
                                                     strstr(name, ".promise.json.tilelight-")));
        if ((!is_entry && !is_leftover) ||
            fstatat(folder, name, &seen, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(seen.st_mode))
            continue;
        if (is_entry)
            note_entry(found, name, &seen);
        else if (now - seen.st_mtime > LEFTOVER_AGE_S)
            unlinkat(folder, name, 0);
    }
}

static int by_use(const void *a, const void *b)
{
    const struct timespec *s = &((const found_file *)a)->used;
    const struct timespec *t = &((const found_file *)b)->used;
    if (s->tv_sec != t->tv_sec)
        return s->tv_sec < t->tv_sec ? -1 : 1;
    return s->tv_nsec < t->tv_nsec ? -1 : s->tv_nsec > t->tv_nsec;
}

void tl_program_cache_trim(const char *folder, uint64_t limit)
{
    found_files found = {0};
    DIR *opened = opendir(folder);
    if (!opened)
        return;
    look_through(dirfd(opened), opened, &found);
    if (found.count > 0)
        qsort(found.of, found.count, sizeof found.of[0], by_use);
    for (size_t i = 0; i < found.count && found.size > limit; i++) {
        unlinkat(dirfd(opened), found.of[i].name, 0);
        found.size -= found.of[i].size;
    }
    free(found.of);
    closedir(opened);
}
