/* Stages after lighting, as the room knows them: a table of functions, and what they work on. */
#ifndef TL_STAGE_H
#define TL_STAGE_H

#include "launch.h"
#include "stage_rows.h"

#include "tilelight/post.h"

struct tl_post {
    tl_device *device;
    tl_lighting_options lighting; /* precision, path, vector_width, memory_limit */
    tl_post_options options;
    tl_buffers buffers;
    tl_image *spare; /* what a stage writes; NULL: not needed yet; owned */
    float *numbers;  /* [number_capacity], of stages on the host, between their steps; owned */
    size_t number_capacity;
};

/* One picture on its way through the stages. */
typedef struct tl_post_work {
    tl_post *post;
    const tl_gbuffer *gbuffer; /* that the picture is of */
    tl_image *from, *to;       /* read and written; owned; `to` NULL until a stage writes */
    tl_pass_context context;   /* on a device; its frame is a stage's own affair */
    tl_view_picture view;      /* of the rows that are at work */
    int is_on_device;          /* 1: POST_FROM holds the whole picture `from` */
    int is_stale;              /* 1: and the host does not */
    double compile_ms; /* what compiling has taken so far, which no stage's time has in it */
    tl_timings *timings;
    const tl_notices *notices;
    tl_post_counts counts;
} tl_post_work;

/* What a stage is made of. */
typedef struct tl_stage {
    tl_post_stage name;
    int (*is_on)(const tl_post *post, const tl_gbuffer *gbuffer);
    /* Rows that are read above and below those that are written. */
    uint32_t (*halo)(const tl_post *post);
    /* Bytes of the device's own memory per row that is written, beside pictures; NULL: none. */
    uint64_t (*row_size)(const tl_post_work *work);
    /* Reads work->view's rows of POST_FROM and writes them in POST_TO; *wrote is 0 where they stay as
     * they are and nothing is written. NULL: the stage is the host's on every path. */
    tl_status (*on_device)(tl_post_work *work, int *wrote, tl_error *err);
    /* The same from work->from to work->to, by tl_post_rows. */
    tl_status (*on_host)(tl_post_work *work, int *wrote, tl_error *err);
} tl_stage;

extern const tl_stage tl_stage_mend, tl_stage_edges, tl_stage_resolve, tl_stage_bloom, tl_stage_scale;

/* post->numbers has room for so many; what was there is lost. Fails with TL_ERR_MEMORY. */
tl_status tl_post_reserve_numbers(tl_post *post, size_t count, tl_error *err);

/* work->to is of the size of `from`. Fails with TL_ERR_MEMORY. */
tl_status tl_post_reserve_to(tl_post_work *work, tl_error *err);

/* What was written is what is read next. */
void tl_post_swap(tl_post_work *work);

/* Until the next picture: programs are kept, and the caller may do with its own memory as it likes. */
void tl_post_let_go(tl_post_work *work);

/* Runs a stage on the device, in bands where the memory limit asks for them. */
tl_status tl_post_run_on_device(tl_post_work *work, const tl_stage *stage, tl_error *err);

/* Rows [first, end) of a picture and `halo` around them, in steps in which bands go, as far as there are any:
 * of a picture's planes, padding included. */
typedef struct tl_post_rows_span {
    uint32_t first, count;
} tl_post_rows_span;
tl_post_rows_span tl_post_rows_around(const tl_image *image,
                                      uint32_t first,
                                      uint32_t end,
                                      uint32_t halo);

/* The host's memory of the picture becomes what the device has. */
tl_status tl_post_bring_back(tl_post_work *work, tl_error *err);

/* Finds a program with these options for the stage and launches its kernel over the view's rows, padded to
 * whole groups; `kernel` is the place of its handle in a tl_program. first: the kernel's first argument. */
#define TL_POST_LAUNCH(work, part, kernel, first, rows, pitch, ms, err, ...)                \
    tl_launch_with(&(work)->context, part, (work)->context.programs[part]->kernel, #kernel, \
                   first, sizeof *(first), (tl_buffer_name[]){__VA_ARGS__},                 \
                   sizeof((tl_buffer_name[]){__VA_ARGS__}) / sizeof(tl_buffer_name),        \
                   tl_post_items((work)->context.programs[part], rows, pitch), ms, err)

/* Work-items for rows of so many pixels: a vector each. pitch: a multiple of 64. */
tl_work tl_post_items(const tl_program *program, size_t rows, size_t pitch);

/* The part's program, for what `more` has beside vectors, path and precision; NULL: nothing. */
tl_status tl_post_find_program(tl_post_work *work,
                               tl_program_part part,
                               const tl_kernel_options *more,
                               tl_error *err);

/* POST_COUNT becomes 0; is read. Both wait for the device. */
tl_status tl_post_clear_count(tl_post_work *work, tl_error *err);
tl_status tl_post_read_count(tl_post_work *work, uint32_t *count, tl_error *err);

/* Rows [0, rows) on all threads, in the arithmetic of the work's precision. */
void tl_post_rows(const tl_post_work *work,
                  tl_post_step step,
                  tl_post_rows_job *job,
                  size_t rows);

#endif
