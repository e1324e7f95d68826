/* How functions report failure.
 *
 * A function that can fail returns tl_status and takes `tl_error *err` as its last argument. On
 * failure it has released everything it acquired, left its outputs alone, and, where err is not
 * NULL, written one sentence that says what failed, where, and what to do. The caller owns the
 * tl_error, so concurrent calls never share one. */
#ifndef TL_ERROR_H
#define TL_ERROR_H

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#    define TL_PRINTF_LIKE(string, args) __attribute__((format(printf, string, args)))
#else
#    define TL_PRINTF_LIKE(string, args)
#endif

/* X(name, exit status of the command, meaning) */
#define TL_STATUSES(X)                                                                 \
    X(TL_OK, 0, "done")                                                                \
    X(TL_ERR_DIFFERENT, 1, "a comparison exceeded its tolerance, or some item failed") \
    X(TL_ERR_MEMORY, 1, "host memory ran out")                                         \
    X(TL_ERR_ARGUMENT, 2, "an option or argument is outside what the call accepts")    \
    X(TL_ERR_READ, 3, "a file could not be opened or read")                            \
    X(TL_ERR_FORMAT, 3, "a file was read but is not what it must be")                  \
    X(TL_ERR_UNSUPPORTED, 3, "a file is valid but needs something this build lacks")   \
    X(TL_ERR_NO_DEVICE, 4, "no OpenCL device fits")                                    \
    X(TL_ERR_DEVICE, 4, "OpenCL or OpenGL reported an error")                          \
    X(TL_ERR_DEVICE_MEMORY, 4, "the device ran out of memory")                         \
    X(TL_ERR_WRITE, 5, "output could not be written")

typedef enum tl_status {
#define TL_STATUS_NAME(name, exit_status, meaning) name,
    TL_STATUSES(TL_STATUS_NAME)
#undef TL_STATUS_NAME
} tl_status;

typedef struct tl_error {
    tl_status status;
    char message[4096]; /* NUL-terminated; a compiler's log is cut to fit */
} tl_error;

/* Fills *err (if not NULL) and returns `status`, so that a check reads
 *     if (!file)
 *         return tl_fail(err, TL_ERR_READ, "%s: cannot be opened: %s", path, reason);      */
tl_status tl_fail(tl_error *err, tl_status status, const char *format, ...)
    TL_PRINTF_LIKE(3, 4);

/* The exit status of a command that ends with `status`; see TL_STATUSES. */
int tl_exit_status(tl_status status);

#ifdef __cplusplus
}
#endif

#endif
