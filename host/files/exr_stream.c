#define _GNU_SOURCE /* sync_file_range */
#include "exr_stream.h"

#include "atomic_file.h"
#include "regular_file.h"
#include "tilelight/camera.h"
#include "try.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const size_t largest_allocation = (size_t)1 << 30; /* bytes; what a header may ask for */

/* How often memory did run out, on whatever thread and stream. The library says so too of headers that
 * ask for more than is allowed, and of chunks whose packed sizes do not fit. */
static atomic_uint allocations_failed;

static void *bounded_allocation(size_t size)
{
    void *made = size <= largest_allocation ? malloc(size) : NULL;
    if (!made && size <= largest_allocation)
        atomic_fetch_add(&allocations_failed, 1u);
    return made;
}

static void keep_error_number(tl_exr_stream *stream, int error_number)
{
    pthread_mutex_lock(&stream->lock);
    if (stream->error_number == 0)
        stream->error_number = error_number;
    pthread_mutex_unlock(&stream->lock);
}

static void keep_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    void *data = NULL;
    (void)code;
    if (!context || exr_get_user_data(context, &data) != EXR_ERR_SUCCESS || !data)
        return;
    tl_exr_stream *stream = data;
    pthread_mutex_lock(&stream->lock);
    if (!stream->message[0])
        snprintf(stream->message, sizeof stream->message, "%s", message);
    pthread_mutex_unlock(&stream->lock);
}

/* While writing, the library may report with its lock held, which asking it for the stream
 * would wait for: tl_exr_check then has the code's own words. */
static void drop_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context;
    (void)code;
    (void)message;
}

static int64_t file_size(exr_const_context_t context, void *data)
{
    const tl_exr_stream *stream = data;
    struct stat seen;
    (void)context;
    return fstat(stream->descriptor, &seen) == 0 ? (int64_t)seen.st_size : -1;
}

static int64_t read_at(exr_const_context_t context,
                       void *data,
                       void *buffer,
                       uint64_t size,
                       uint64_t offset,
                       exr_stream_error_func_ptr_t report)
{
    tl_exr_stream *stream = data;
    size_t got;
    (void)context;
    (void)report; /* tl_exr_check has the words */
    if (tl_regular_file_read_at(stream->descriptor, buffer, size, offset, &got))
        return (int64_t)got;
    keep_error_number(stream, errno);
    return -1;
}

/* Has the kernel write out what has filled since, so that the sync at the end finds little to do:
 * a 124 MB frame took 155 ms in place of 220, as long as a plain copy of the file with a sync. Only
 * a hint: where it fails, nothing is lost. */
static void start_writing_out(int descriptor, uint64_t begin, uint64_t end)
{
    const uint64_t window = (uint64_t)8 << 20;
    const uint64_t full = end / window * window;
    if (begin < full)
        sync_file_range(descriptor, (off_t)(full - window), (off_t)window,
                        SYNC_FILE_RANGE_WRITE);
}

static int64_t write_at(exr_const_context_t context,
                        void *data,
                        const void *buffer,
                        uint64_t size,
                        uint64_t offset,
                        exr_stream_error_func_ptr_t report)
{
    tl_exr_stream *stream = data;
    uint64_t done = 0;
    (void)context;
    (void)report;
    while (done < size) {
        const ssize_t put = pwrite(stream->descriptor, (const char *)buffer + done, size - done,
                                   (off_t)(offset + done));
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0) {
            keep_error_number(stream, errno);
            return -1;
        }
        done += (uint64_t)put;
    }
    start_writing_out(stream->descriptor, offset, offset + size);
    return (int64_t)done;
}

static exr_context_initializer_t initializer_for(tl_exr_stream *stream)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = keep_message;
    initializer.alloc_fn = bounded_allocation;
    initializer.free_fn = free;
    initializer.user_data = stream;
    return initializer;
}

static void begin(tl_exr_stream *stream, const char *path, int descriptor)
{
    *stream = (tl_exr_stream){.path = path,
                              .descriptor = descriptor,
                              .allocations_failed = atomic_load(&allocations_failed)};
    pthread_mutex_init(&stream->lock, NULL);
}

/* The context is gone already where opening failed. */
static tl_status end_unopened(tl_exr_stream *stream, exr_result_t result, tl_error *err)
{
    const tl_status status = tl_exr_check(stream, result, err);
    stream->context = NULL;
    pthread_mutex_destroy(&stream->lock);
    return status;
}

tl_status tl_exr_stream_read(tl_exr_stream *stream,
                             const char *path,
                             int descriptor,
                             tl_error *err)
{
    begin(stream, path, descriptor);
    exr_context_initializer_t initializer = initializer_for(stream);
    initializer.read_fn = read_at;
    initializer.size_fn = file_size;
    initializer.max_image_width = TL_MAX_EXTENT;
    initializer.max_image_height = TL_MAX_EXTENT;
    /* A file cut short is refused, never patched up. */
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    const exr_result_t result = exr_start_read(&stream->context, path, &initializer);
    return result == EXR_ERR_SUCCESS ? TL_OK : end_unopened(stream, result, err);
}

tl_status tl_exr_stream_open(tl_exr_stream *stream,
                             const char *path,
                             uint64_t *file_size,
                             tl_error *err)
{
    int descriptor;
    tl_status status = tl_regular_file_open(path, &descriptor, file_size, err);
    if (status != TL_OK)
        return status;
    status = tl_exr_stream_read(stream, path, descriptor, err);
    if (status != TL_OK)
        close(descriptor);
    return status;
}

void tl_exr_stream_close_file(tl_exr_stream *stream)
{
    if (!stream->context)
        return;
    const int descriptor = stream->descriptor;
    tl_exr_stream_close(stream, NULL);
    close(descriptor);
}

tl_status tl_exr_stream_write(
    tl_exr_stream *stream, const char *path, int descriptor, int zip_level, tl_error *err)
{
    begin(stream, path, descriptor);
    exr_context_initializer_t initializer = initializer_for(stream);
    initializer.error_handler_fn = drop_message;
    initializer.write_fn = write_at;
    initializer.zip_level = zip_level;
    const exr_result_t result =
        exr_start_write(&stream->context, path, EXR_WRITE_FILE_DIRECTLY, &initializer);
    return result == EXR_ERR_SUCCESS ? TL_OK : end_unopened(stream, result, err);
}

tl_status tl_exr_check(tl_exr_stream *stream, exr_result_t result, tl_error *err)
{
    if (result == EXR_ERR_SUCCESS)
        return TL_OK;
    const char *words =
        stream->message[0] ? stream->message : exr_get_default_error_message(result);
    if (result == EXR_ERR_OUT_OF_MEMORY &&
        stream->allocations_failed != atomic_load(&allocations_failed))
        return tl_fail(err, TL_ERR_MEMORY, "%s: out of memory: %s", stream->path, words);
    if (result == EXR_ERR_WRITE_IO && stream->error_number != 0)
        return tl_write_failed(stream->path, stream->error_number, err);
    if (stream->error_number != 0)
        return tl_fail(err, TL_ERR_READ, "%s: cannot be read: %s", stream->path,
                       strerror(stream->error_number));
    if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        return tl_fail(err, TL_ERR_UNSUPPORTED, "%s: the OpenEXR library cannot do this: %s",
                       stream->path, words);
    return tl_fail(err, TL_ERR_FORMAT, "%s: is damaged or no OpenEXR file: %s", stream->path,
                   words);
}

tl_status tl_exr_stream_close(tl_exr_stream *stream, tl_error *err)
{
    if (!stream->context)
        return TL_OK;
    const tl_status status = tl_exr_check(stream, exr_finish(&stream->context), err);
    stream->context = NULL;
    pthread_mutex_destroy(&stream->lock);
    return status;
}
