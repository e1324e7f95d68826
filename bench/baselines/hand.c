/* The whole frame by hand, on all threads: bounds of tiles, rectangles of lights, then lists and
 * light, a row of tiles at a time. */
#include "hand.h"

#include "baseline_tables.h"
#include "hand_worker.h"
#include "parallel.h"
#include "try.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

/* Best first; the last one runs everywhere. */
static const struct {
    const char *name;
    const hand_code *exact, *relaxed;
} sets[] = {
#ifdef TL_HAS_X86_HAND
    {"avx512", &hand_exact_avx512, &hand_relaxed_avx512},
    {"avx2", &hand_exact_avx2, &hand_relaxed_avx2},
#endif
    {"portable", &hand_exact_portable, &hand_relaxed_portable},
};
enum { SET_COUNT = sizeof sets / sizeof sets[0] };

typedef struct hand_state {
    const hand_code *code;
    tl_prepared prepared;
    hand_frame frame;
    hand_box *boxes;
    tl_tile_rect *rects;
    hand_worker *workers; /* [worker_count] */
    size_t worker_count;
    atomic_size_t next_worker, next_row;
} hand_state;

/* TILELIGHT_HAND names a set to use if the processor has it; the best one else. */
static size_t chosen_set(void)
{
    const char *wanted = getenv("TILELIGHT_HAND");
    for (size_t i = 0; wanted && i < SET_COUNT; i++)
        if (strcmp(sets[i].name, wanted) == 0 && sets[i].exact->is_supported())
            return i;
    size_t best = 0;
    while (best + 1 < SET_COUNT && !sets[best].exact->is_supported())
        best++;
    return best;
}

const char *tl_hand_instruction_set(void)
{
    return sets[chosen_set()].name;
}

void hand_destroy(void *state)
{
    hand_state *h = state;
    if (!h)
        return;
    for (size_t i = 0; h->workers && i < h->worker_count; i++)
        hand_worker_clear(&h->workers[i]);
    free(h->workers);
    free(h->boxes);
    free(h->rects);
    tl_prepared_clear(&h->prepared);
    free(h);
}

/* Lights that reach everything are within range of everything, in the exact loops too. */
static void open_ranges(tl_prepared *prepared)
{
    for (uint32_t i = 0; i < prepared->frame.global_count; i++)
        prepared->lights[i].range2 = INFINITY;
}

static bool is_grey(const tl_gbuffer *g)
{
    const float *r = tl_gbuffer_plane(g, TL_SPECULAR_R);
    const float *green = tl_gbuffer_plane(g, TL_SPECULAR_G);
    const float *b = tl_gbuffer_plane(g, TL_SPECULAR_B);
    for (size_t i = 0; r && i < (size_t)g->rows * g->pitch; i++)
        if (r[i] != green[i] || r[i] != b[i])
            return false;
    return true;
}

/* hand_frame.has_one_color. Of lights with a range alone: the others have code of their own. */
static bool has_one_color(const tl_baseline_input *input, const tl_prepared *prepared)
{
    return prepared->needs.model == TL_MODEL_BLINN_PHONG_NORMALIZED &&
           !(prepared->needs.present & TL_GROUP_METAL_ROUGH) &&
           prepared->frame.global_count == 0 && prepared->two_colored_count == 0 &&
           is_grey(input->gbuffer);
}

static tl_status create(const tl_baseline_input *input,
                        const hand_code *code,
                        bool is_relaxed,
                        void **out,
                        tl_error *err)
{
    tl_status status = TL_OK;
    hand_state *h = calloc(1, sizeof *h);
    if (!h)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline");
    h->code = code;
    h->worker_count = tl_thread_count();
    TRY(tl_prepare(input->gbuffer, input->lights,
                   &(tl_prepare_options){.tile_size = HAND_TILE, .box_count = 1}, NULL,
                   &h->prepared, err));
    h->frame = (hand_frame){.prepared = &h->prepared,
                            .has_one_color = is_relaxed && has_one_color(input, &h->prepared)};
    const uint32_t models =
        h->frame.has_one_color ? 1u << TL_MODEL_BLINN_PHONG_NORMALIZED : 1u << TL_MODEL_PHONG;
    TRY(tl_baseline_check(&h->prepared.needs, models, ~0u, err));
    open_ranges(&h->prepared);
    const tl_frame *f = &h->prepared.frame;
    h->boxes = calloc((size_t)f->tiles_x * f->tiles_y, sizeof *h->boxes);
    h->rects = calloc(f->light_count + 1u, sizeof *h->rects);
    h->workers = calloc(h->worker_count, sizeof *h->workers);
    if (!h->boxes || !h->rects || !h->workers)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for a baseline"));
    for (size_t i = 0; i < h->worker_count; i++)
        TRY(hand_worker_create(&h->workers[i], f->light_count - f->global_count, err));
    h->frame.boxes = h->boxes;
    h->frame.rects = h->rects;
    for (enum tl_plane p = 0; p < TL_PLANE_COUNT; p++)
        h->frame.planes[p] = tl_gbuffer_plane(input->gbuffer, p);
    *out = h;
    h = NULL;
done:
    hand_destroy(h);
    return status;
}

tl_status hand_create_exact(const tl_baseline_input *input, void **out, tl_error *err)
{
    return create(input, sets[chosen_set()].exact, false, out, err);
}

tl_status hand_create_relaxed(const tl_baseline_input *input, void **out, tl_error *err)
{
    return create(input, sets[chosen_set()].relaxed, true, out, err);
}

static void bound_rows(void *context, size_t begin, size_t end)
{
    const hand_state *h = context;
    for (size_t row = begin; row < end; row++)
        for (uint32_t x = 0; x < h->prepared.frame.tiles_x; x++)
            h->code->bound_tile(&h->frame, x, (uint32_t)row);
}

static void find_rects(hand_state *h)
{
    const tl_frame *f = &h->prepared.frame;
    double near = (double)INFINITY, far = (double)-INFINITY;
    for (size_t i = 0; i < (size_t)f->tiles_x * f->tiles_y; i++) {
        near = fmin(near, -(double)h->boxes[i].high[2]);
        far = fmax(far, -(double)h->boxes[i].low[2]);
    }
    const tl_view_window window =
        view_window(f, near, far, (int)h->prepared.needs.orthographic);
    for (uint32_t i = f->global_count; i < f->light_count; i++)
        h->rects[i] = tile_rect_of(window, f, h->prepared.lights[i]);
}

static double list_row(hand_state *h, hand_worker *worker, uint32_t row)
{
    const uint32_t tiles_x = h->prepared.frame.tiles_x;
    const double start = tl_seconds();
    worker->list_length = 0;
    hand_worker_collect(worker, &h->frame, row);
    for (uint32_t x = 0; x < tiles_x && !worker->failed; x++) {
        const tl_view_light **list = hand_worker_reserve(worker, worker->candidates.count);
        if (list)
            worker->list_length +=
                h->code->list_tile(&h->frame, &worker->candidates, x, row, list);
        worker->ends[x] = worker->list_length;
    }
    return start;
}

/* One thread: rows until there are none. */
static void light_rows(void *context, size_t begin, size_t end)
{
    hand_state *h = context;
    if (begin == end)
        return;
    hand_worker *worker = &h->workers[atomic_fetch_add(&h->next_worker, 1)];
    for (;;) {
        const uint32_t row = (uint32_t)atomic_fetch_add(&h->next_row, 1);
        if (row >= h->prepared.frame.tiles_y || worker->failed)
            return;
        const double start = list_row(h, worker, row), listed = tl_seconds();
        for (uint32_t x = 0; x < h->prepared.frame.tiles_x && !worker->failed; x++) {
            const size_t first = x ? worker->ends[x - 1] : 0;
            h->code->shade_tile(&h->frame, x, row, worker->list + first,
                                worker->ends[x] - first);
        }
        worker->list_seconds += listed - start;
        worker->shade_seconds += tl_seconds() - listed;
    }
}

/* The stages of one pass over the rows share its wall time as they share its threads' time. */
static void report(hand_state *h, double seconds, tl_timings *timings)
{
    double list = 0.0, shade = 0.0;
    for (size_t i = 0; i < h->worker_count; i++) {
        list += h->workers[i].list_seconds;
        shade += h->workers[i].shade_seconds;
        h->workers[i].list_seconds = h->workers[i].shade_seconds = 0.0;
    }
    const double share = list + shade > 0.0 ? list / (list + shade) : 0.0;
    tl_timings_add(timings, "list", 1e3 * seconds * share);
    tl_timings_add(timings, "shade", 1e3 * seconds * (1.0 - share));
}

tl_status hand_run(void *state, tl_image *image, tl_timings *timings, tl_error *err)
{
    hand_state *h = state;
    double clock = tl_seconds();
    for (unsigned i = 0; i < 3; i++)
        h->frame.radiance[i] = tl_image_plane(image, i);
    tl_parallel(h->prepared.frame.tiles_y, 1, bound_rows, h);
    clock = tl_timings_end(timings, "bounds", clock);
    find_rects(h);
    clock = tl_timings_end(timings, "rectangles", clock);
    atomic_store(&h->next_worker, 0);
    atomic_store(&h->next_row, 0);
    tl_parallel(h->worker_count, 1, light_rows, h);
    report(h, tl_seconds() - clock, timings);
    for (size_t i = 0; i < h->worker_count; i++)
        if (h->workers[i].failed)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for lists of lights");
    return TL_OK;
}
