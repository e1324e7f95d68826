#include "hand_worker.h"

#include <stdlib.h>

enum { WIDEST = 16 }; /* lanes: candidates are filled up to whole vectors */

tl_status hand_worker_create(hand_worker *worker, size_t light_count, tl_error *err)
{
    const size_t capacity = light_count + WIDEST;
    hand_candidates *c = &worker->candidates;
    worker->values = malloc(6 * capacity * sizeof *worker->values);
    c->lights = malloc(capacity * sizeof *c->lights);
    if (!worker->values || !c->lights)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for %zu lights", light_count);
    float **const arrays[] = {&c->x, &c->y, &c->z, &c->range2, &c->first, &c->end};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++)
        *arrays[i] = worker->values + i * capacity;
    return TL_OK;
}

void hand_worker_clear(hand_worker *worker)
{
    free(worker->values);
    free(worker->candidates.lights);
    free(worker->list);
    *worker = (hand_worker){0};
}

static void set_candidate(hand_candidates *c,
                          size_t at,
                          const tl_view_light *light,
                          tl_tile_rect rect)
{
    c->x[at] = light->position[0];
    c->y[at] = light->position[1];
    c->z[at] = light->position[2];
    c->range2[at] = light->range2;
    c->first[at] = (float)rect.x0;
    c->end[at] = (float)rect.x1;
    c->lights[at] = light;
}

void hand_worker_collect(hand_worker *worker, const hand_frame *frame, uint32_t row)
{
    static const tl_view_light none = {.range2 = -1.0f};
    static const tl_tile_rect nowhere = {0, 0, 0, 0};
    const tl_prepared *prepared = frame->prepared;
    hand_candidates *c = &worker->candidates;
    c->count = 0;
    for (uint32_t i = prepared->frame.global_count; i < prepared->frame.light_count; i++) {
        const tl_tile_rect rect = frame->rects[i];
        if ((int)row >= rect.y0 && (int)row < rect.y1)
            set_candidate(c, c->count++, &prepared->lights[i], rect);
    }
    for (size_t i = 0; i < WIDEST; i++)
        set_candidate(c, c->count + i, &none, nowhere);
}

const tl_view_light **hand_worker_reserve(hand_worker *worker, size_t count)
{
    const size_t needed = worker->list_length + count;
    if (needed > worker->list_capacity) {
        const size_t capacity = 2 * needed;
        const tl_view_light **grown = realloc(worker->list, capacity * sizeof *grown);
        if (!grown) {
            worker->failed = true;
            return NULL;
        }
        worker->list = grown;
        worker->list_capacity = capacity;
    }
    return worker->list + worker->list_length;
}
