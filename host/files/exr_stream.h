/* An OpenEXR context on a file descriptor of ours, with what went wrong kept for our sentence. */
#ifndef TL_EXR_STREAM_H
#define TL_EXR_STREAM_H

#include "tilelight/error.h"

#include <openexr.h>

#include <pthread.h>
#include <stdint.h>

/* Must not move while it is open: the context points at it. */
typedef struct tl_exr_stream {
    exr_context_t context; /* NULL while closed */
    const char *path;      /* for sentences; the caller's */
    int descriptor;        /* the caller's */
    pthread_mutex_t
        lock; /* chunks fail on several threads at once; the first failure is kept */
    unsigned allocations_failed; /* of all streams, when this one was opened */
    int error_number;            /* errno of a failed system call; 0 if none failed */
    char message[512];           /* the library's own words; empty if it had none */
} tl_exr_stream;

/* Opens for reading: the header is parsed. Pictures beyond TL_MAX_EXTENT, and single allocations
 * beyond 1 GiB, are refused by the library. Fails with TL_ERR_FORMAT, TL_ERR_READ or
 * TL_ERR_MEMORY. */
tl_status tl_exr_stream_read(tl_exr_stream *stream,
                             const char *path,
                             int descriptor,
                             tl_error *err);

/* Opens a regular file and reads it as above; *file_size is in bytes. Released with
 * tl_exr_stream_close_file, which accepts a closed stream. Fails as above. */
tl_status tl_exr_stream_open(tl_exr_stream *stream,
                             const char *path,
                             uint64_t *file_size,
                             tl_error *err);
void tl_exr_stream_close_file(tl_exr_stream *stream);

/* Opens for writing. zip_level is zlib's. Fails with TL_ERR_WRITE or TL_ERR_MEMORY. */
tl_status tl_exr_stream_write(
    tl_exr_stream *stream, const char *path, int descriptor, int zip_level, tl_error *err);

/* TL_OK for EXR_ERR_SUCCESS; else the sentence for a call that failed on this stream. */
tl_status tl_exr_check(tl_exr_stream *stream, exr_result_t result, tl_error *err);

/* Finishes the file; the header's chunk table is written here, so this can fail as writing can.
 * Accepts a closed stream. */
tl_status tl_exr_stream_close(tl_exr_stream *stream, tl_error *err);

#endif
