/* The device memory of a frame: made once, grown where a frame is larger than every one before. */
#ifndef TL_BUFFERS_H
#define TL_BUFFERS_H

#include "device.h"

/* X(name, shape) */
#define TL_BUFFERS(X)                                                                         \
    X(TL_BUFFER_BOXES, "[2][6][tiles_y][box_pitch] scalars")                                  \
    X(TL_BUFFER_COUNTS, "[tiles_y][box_pitch] int")                                           \
    X(TL_BUFFER_BITS, "[tiles_y][TL_LIGHT_BLOCK / 32][box_pitch] int")                        \
    X(TL_BUFFER_LIGHTS, "[light_count] tl_view_light, tl_view_spot, ...")                     \
    X(TL_BUFFER_RECTS, "[TL_RECT_PLANE_COUNT][TL_RECT_PITCH] int")                            \
    X(TL_BUFFER_STARTS, "[tiles_y * tiles_x] uint")                                           \
    X(TL_BUFFER_ENDS, "[tiles_y * tiles_x] uint")                                             \
    X(TL_BUFFER_CELLS, "[3][cells] uint")                                                     \
    X(TL_BUFFER_LIST_END, "[2] uint")                                                         \
    X(TL_BUFFER_CELL_LIST, "[entries of all cells] uint")                                     \
    X(TL_BUFFER_LIST, "[list_length] uint")                                                   \
    X(TL_BUFFER_PLANES, "[plane_count][rows][pitch] float, the G-buffer's")                   \
    X(TL_BUFFER_RADIANCE, "[3, and 3 a term][rows][pitch] float, the image's")                \
    X(TL_BUFFER_TIMES, "[tiles_y * tiles_x][2] ulong")                                        \
    X(TL_BUFFER_OPACITY, "[rows][pitch] float, the layer's")                                  \
    X(TL_BUFFER_BEHIND, "as RADIANCE, the image's; RADIANCE is a layer's then")               \
    X(TL_BUFFER_POST_FROM, "[3][plane_rows][pitch] float, what a stage after lighting reads") \
    X(TL_BUFFER_POST_TO, "the same, what it writes")                                          \
    X(TL_BUFFER_POST_COUNT, "[1] uint")                                                       \
    X(TL_BUFFER_POST_EDGES, "[TL_EDGE_PLANE_COUNT][rows][pitch] float")                       \
    X(TL_BUFFER_POST_SMALL, "[3][rows][pitch] float, of a smaller picture")                   \
    X(TL_BUFFER_POST_SMALL_TOO, "the same")                                                   \
    X(TL_BUFFER_POST_NUMBERS, "[] float, tables of the last stages")                          \
    X(TL_BUFFER_POST_BETWEEN, "[3][rows of a band][pitch] float, scaled along columns")       \
    X(TL_BUFFER_POST_CODES, "[rows of a band][width][3] uchar, codes of a screen")

typedef enum tl_buffer_name {
#define TL_BUFFER_NAME(name, shape) name,
    TL_BUFFERS(TL_BUFFER_NAME)
#undef TL_BUFFER_NAME
        TL_BUFFER_COUNT
} tl_buffer_name;

typedef struct tl_buffers {
    struct {
        cl_mem memory;
        size_t size; /* bytes */
        void *host;  /* the caller's memory that the buffer is, or NULL: the device's own */
    } of[TL_BUFFER_COUNT];
} tl_buffers;

/* At least `size` bytes, at least four, of device memory; loses its contents if it grows. */
tl_status tl_buffers_reserve(tl_buffers *buffers,
                             const tl_device *device,
                             tl_buffer_name name,
                             size_t size,
                             tl_error *err);

/* Makes the buffer be `host` (page-aligned, `size` bytes), which the caller keeps until the next
 * call or tl_buffers_release. Only for devices that share memory. */
tl_status tl_buffers_share(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           void *host,
                           size_t size,
                           tl_error *err);

/* Tells OpenCL, before whatever is queued next, that the host reads or writes (flags) the first
 * `size` bytes of a shared buffer. Waits for nothing. */
tl_status tl_buffers_touch(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           cl_map_flags flags,
                           size_t size,
                           tl_error *err);

/* Writes `size` bytes to the start of the buffer, which has room; nothing for a size of 0. */
tl_status tl_buffers_write(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           const void *from,
                           size_t size,
                           tl_error *err);

/* The same without waiting: `from` stays as it is until the device's next clFinish. */
tl_status tl_buffers_send(tl_buffers *buffers,
                          const tl_device *device,
                          tl_buffer_name name,
                          const void *from,
                          size_t size,
                          tl_error *err);

/* Maps the first `size` bytes for the host; unmap with tl_buffers_unmap. Waits for the device. */
tl_status tl_buffers_map(tl_buffers *buffers,
                         const tl_device *device,
                         tl_buffer_name name,
                         cl_map_flags flags,
                         size_t size,
                         void **out,
                         tl_error *err);
tl_status tl_buffers_unmap(tl_buffers *buffers,
                           const tl_device *device,
                           tl_buffer_name name,
                           void *mapped,
                           tl_error *err);

/* What the device's own buffers take, in bytes. */
uint64_t tl_buffers_size(const tl_buffers *buffers);

/* Of memory of the caller's, so that the caller may free it. */
void tl_buffers_let_go(tl_buffers *buffers);

/* Leaves it all zero. */
void tl_buffers_release(tl_buffers *buffers);

#endif
