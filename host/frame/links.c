#define _POSIX_C_SOURCE 200809L
#include "links.h"

#include "falloff.h"
#include "parallel.h"
#include "sections.h"
#include "suggest.h"
#include "try.h"

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BITS = 32 };

/* The links of a frame: which of the set's they are, and which ids they keep lights from. */
typedef struct linking {
    const tl_gbuffer *gbuffer;
    const tl_objects *objects;
    const tl_light_set *lights;
    uint32_t *
        numbers; /* [lights->link_count]: 1 + index in the frame; 0: no light of the frame has it */
    uint32_t count; /* in the frame */
    size_t planes;
    /* ids that links name, and all that have names, by rising ids */
    uint32_t *ids; /* [id_count] */
    size_t id_count;
    /* [id_count + 1][planes]: bits of links that keep lights from the id; the last: from all others */
    uint32_t *words;
    tl_u32 at; /* row of the planes */
} linking;

/* --- objects ---------------------------------------------------------------------------------------- */

/* What messages call a light: by its name, or where it stands in the set. */
static void call_light(const tl_light_set *lights,
                       const tl_light *light,
                       char *text,
                       size_t size)
{
    if (light->name[0])
        snprintf(text, size, "light \"%s\"", light->name);
    else
        snprintf(text, size, "lights[%zu]", (size_t)(light - lights->lights));
}

/* Of a name that no object has: what there is. */
static tl_status no_such_object(const linking *l,
                                const tl_light *light,
                                const char *typed,
                                tl_error *err)
{
    enum { SHOWN = 12 };
    char list[1024] = "";
    size_t length = 0;
    const char *words[256] = {NULL};
    const uint32_t count = l->objects->count;
    uint32_t word_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (word_count < 256)
            words[word_count++] = l->objects->of[i].name;
        if (i < SHOWN && length < sizeof list)
            length +=
                (size_t)snprintf(list + length, sizeof list - length, "%s%.40s (%u)",
                                 i ? ", " : "", l->objects->of[i].name, l->objects->of[i].id);
    }
    const char *meant = tl_suggest(typed, words, word_count);
    char called[96];
    call_light(l->lights, light, called, sizeof called);
    return tl_fail(err, TL_ERR_FORMAT,
                   "%s is linked to \"%s\", and the capture has no such object%s%s%s; it "
                   "has %s%s",
                   called, typed, meant ? ": did you mean \"" : "", meant ? meant : "",
                   meant ? "\"?" : "", count ? list : "none with a name",
                   count > SHOWN ? ", ..." : "");
}

static int is_called(const tl_object *object, const char *name, int is_exact)
{
    return is_exact ? strcmp(object->name, name) == 0 : fnmatch(name, object->name, 0) == 0;
}

/* Whether an object is called just so: then * and ? are letters of it. */
static int is_name(const linking *l, const char *name)
{
    for (uint32_t i = 0; i < l->objects->count; i++)
        if (is_called(&l->objects->of[i], name, 1))
            return 1;
    return 0;
}

static int compare_ids(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Where the words of an id stand. */
static size_t row_of(const linking *l, uint32_t id)
{
    const uint32_t *found = bsearch(&id, l->ids, l->id_count, sizeof *l->ids, compare_ids);
    return found ? (size_t)(found - l->ids) : l->id_count;
}

/* All that a link may name. */
static tl_status list_ids(linking *l, tl_error *err)
{
    size_t most = l->objects->count, count = 0;
    for (size_t i = 0; i < l->lights->link_count; i++)
        most += l->lights->links[i].count;
    l->ids = malloc((most + 1) * sizeof *l->ids);
    if (!l->ids)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for links of lights");
    for (uint32_t i = 0; i < l->objects->count; i++)
        l->ids[count++] = l->objects->of[i].id;
    for (size_t i = 0; i < l->lights->link_count; i++)
        for (size_t k = 0; k < l->lights->links[i].count; k++)
            if (!l->lights->links[i].of[k].name[0])
                l->ids[count++] = l->lights->links[i].of[k].id;
    qsort(l->ids, count, sizeof *l->ids, compare_ids);
    for (size_t i = 0; i < count; i++)
        if (l->id_count == 0 || l->ids[l->id_count - 1] != l->ids[i])
            l->ids[l->id_count++] = l->ids[i];
    return TL_OK;
}

/* --- links ------------------------------------------------------------------------------------------ */

/* Those of the frame's lights, in the order in which lights come. */
static tl_status number_links(linking *l, const tl_prepared *prepared, tl_error *err)
{
    l->numbers = calloc(l->lights->link_count + 1, sizeof *l->numbers);
    if (!l->numbers)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for links of lights");
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const uint32_t link = l->lights->lights[prepared->sources[i]].link;
        if (link > 0 && l->numbers[link - 1] == 0)
            l->numbers[link - 1] = ++l->count;
    }
    l->planes = (l->count + BITS - 1) / BITS;
    return TL_OK;
}

static void set_bit(linking *l, size_t row, uint32_t number, int kept_away)
{
    uint32_t *word = &l->words[row * l->planes + (number - 1) / BITS];
    const uint32_t bit = 1u << ((number - 1) % BITS);
    *word = kept_away ? *word | bit : *word & ~bit;
}

/* Of one object of a link: light: one that has it, for messages. */
static tl_status mark(linking *l,
                      const tl_light *light,
                      const tl_light_link *link,
                      const tl_link_object *object,
                      uint32_t number,
                      tl_error *err)
{
    const int is_exact = is_name(l, object->name);
    int found = 0;
    if (!object->name[0]) {
        set_bit(l, row_of(l, object->id), number, link->except);
        return TL_OK;
    }
    for (uint32_t i = 0; i < l->objects->count; i++)
        if (is_called(&l->objects->of[i], object->name, is_exact)) {
            set_bit(l, row_of(l, l->objects->of[i].id), number, link->except);
            found = 1;
        }
    return found ? TL_OK : no_such_object(l, light, object->name, err);
}

static tl_status fill_words(linking *l, const tl_prepared *prepared, tl_error *err)
{
    tl_status status = TL_OK;
    l->words = calloc((l->id_count + 1) * l->planes, sizeof *l->words);
    if (!l->words)
        TRY(tl_fail(err, TL_ERR_MEMORY, "out of memory for links of lights"));
    uint32_t done_count = 0;
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const tl_light *light = &l->lights->lights[prepared->sources[i]];
        const uint32_t number = light->link ? l->numbers[light->link - 1] : 0;
        if (number <= done_count) /* none, or one that lights before this have */
            continue;
        const tl_light_link *link = &l->lights->links[light->link - 1];
        done_count = number;
        for (size_t row = 0; row <= l->id_count; row++)
            set_bit(l, row, number, !link->except);
        for (size_t k = 0; k < link->count; k++)
            TRY(mark(l, light, link, &link->of[k], number, err));
    }
done:
    return status;
}

/* --- pixels ----------------------------------------------------------------------------------------- */

typedef struct job {
    const linking *l;
    uint32_t *to; /* [planes][rows][pitch] */
} job;

/* Neighbours show the same object as a rule. */
static void fill_rows(void *context, size_t begin, size_t end)
{
    const job *j = context;
    const tl_gbuffer *g = j->l->gbuffer;
    const size_t plane = (size_t)g->pitch * g->rows;
    uint32_t last = 0;
    size_t row = row_of(j->l, last);
    for (size_t at = begin * g->pitch; at < end * g->pitch; at++) {
        if (g->ids[at] != last) {
            last = g->ids[at];
            row = row_of(j->l, last);
        }
        for (size_t p = 0; p < j->l->planes; p++)
            j->to[p * plane + at] = j->l->words[row * j->l->planes + p];
    }
}

static tl_status add_planes(linking *l, tl_prepared *prepared, tl_error *err)
{
    const tl_gbuffer *g = l->gbuffer;
    tl_view_links view = {.rows = g->rows};
    tl_status status = TL_OK;
    void *memory = NULL;
    TRY(tl_section_add(prepared, l->planes * g->pitch * g->rows * sizeof(uint32_t),
                       &view.words_at, &memory, err));
    tl_parallel(g->rows, 16, fill_rows, &(job){l, memory});
    memcpy(tl_section_at(prepared, prepared->frame.shapes_at - 1), &view, sizeof view);
done:
    return status;
}

static void number_shapes(const linking *l, tl_prepared *prepared)
{
    tl_view_shape *shapes = tl_section_at(prepared, prepared->frame.shapes_at);
    for (uint32_t i = 0; i < prepared->frame.light_count; i++) {
        const uint32_t link = l->lights->lights[prepared->sources[i]].link;
        if (link > 0)
            shapes[prepared->lights[i].falloff - TL_FADE_COUNT].spot_and_link |=
                l->numbers[link - 1] << 1;
    }
}

static const tl_light *first_linked(const tl_light_set *lights, const tl_prepared *prepared)
{
    for (uint32_t i = 0; i < prepared->frame.light_count; i++)
        if (lights->lights[prepared->sources[i]].link > 0)
            return &lights->lights[prepared->sources[i]];
    return NULL;
}

tl_status tl_links_add(const tl_gbuffer *gbuffer,
                       const tl_light_set *lights,
                       tl_prepared *prepared,
                       tl_error *err)
{
    const tl_light *first = first_linked(lights, prepared);
    linking l = {
        .gbuffer = gbuffer, .objects = &tl_gbuffer_owner(gbuffer)->objects, .lights = lights};
    char called[96];
    tl_status status = TL_OK;
    if (!first)
        return TL_OK;
    call_light(lights, first, called, sizeof called);
    if (!gbuffer->ids)
        TRY(tl_fail(err, TL_ERR_FORMAT,
                    "%s is linked to objects, and the capture does not tell any apart: "
                    "capture the scene with --ids, or with these lights",
                    called));
    TRY(number_links(&l, prepared, err));
    TRY(list_ids(&l, err));
    TRY(fill_words(&l, prepared, err));
    TRY(add_planes(&l, prepared, err));
    number_shapes(&l, prepared);
done:
    free(l.numbers);
    free(l.ids);
    free(l.words);
    return status;
}
