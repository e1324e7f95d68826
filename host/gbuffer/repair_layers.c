#include "packing.h"
#include "parallel.h"
#include "repair.h"

typedef struct scan {
    tl_gbuffer *layer;
    tl_unpacking unpacking;
    tl_faults *faults;
    atomic_uint from, to; /* rows that show something */
} scan;

/* As occlusion, which is from 0 to 1 too. */
static float repaired(float opacity)
{
    return tl_repaired_value(TL_OCCLUSION, opacity);
}

/* Of pixels [begin, end) of a row. Returns whether they show anything. */
static bool clear_sky(const scan *s, uint32_t row, uint32_t begin, uint32_t end, float *opacity)
{
    enum { SPAN = 128 };
    float depths[SPAN], *to[TL_PLANE_COUNT] = {[TL_DEPTH] = depths};
    bool shows = false;
    for (uint32_t first = begin; first < end; first += SPAN) {
        const uint32_t last = end - first < SPAN ? end : first + SPAN;
        tl_unpack_span(&s->unpacking, row, first, last, to);
        for (uint32_t x = first; x < last; x++) {
            opacity[x] = depths[x - first] < INFINITY ? opacity[x] : 0.0f;
            shows = shows || opacity[x] > 0.0f;
        }
    }
    return shows;
}

static bool repair_row(const scan *s, uint32_t row, tl_fault_counts *counts)
{
    const uint32_t width = s->layer->camera.width;
    float *opacity = s->layer->opacity + (size_t)row * s->layer->pitch;
    uint32_t begin = width, end = 0;
    for (uint32_t x = 0; x < width; x++) {
        if (!(opacity[x] == repaired(opacity[x]))) {
            opacity[x] = repaired(opacity[x]);
            tl_faults_note(s->faults, row, x, TL_OPACITY_FAULT);
            counts->value++;
        }
        if (opacity[x] > 0.0f) {
            begin = x < begin ? x : begin;
            end = x + 1;
        }
    }
    return clear_sky(s, row, begin, end, opacity);
}

static void repair_rows(void *context, size_t begin, size_t end)
{
    scan *s = context;
    tl_fault_counts counts = {0, 0, 0};
    for (uint32_t row = (uint32_t)begin; row < end; row++) {
        unsigned from, to;
        if (!repair_row(s, row, &counts))
            continue;
        from = atomic_load(&s->from);
        while (row < from && !atomic_compare_exchange_weak(&s->from, &from, row))
            ;
        to = atomic_load(&s->to);
        while (row + 1 > to && !atomic_compare_exchange_weak(&s->to, &to, row + 1))
            ;
    }
    tl_faults_add(s->faults, counts);
}

void tl_repair_opacity(tl_gbuffer *layer, tl_faults *faults)
{
    scan s = {.layer = layer, .unpacking = tl_unpacking_of(layer), .faults = faults};
    atomic_init(&s.from, layer->camera.height);
    atomic_init(&s.to, 0);
    tl_parallel(layer->camera.height, 16, repair_rows, &s);
    layer->shown_to = atomic_load(&s.to);
    layer->shown_from = atomic_load(&s.from) < layer->shown_to ? atomic_load(&s.from) : 0;
}
