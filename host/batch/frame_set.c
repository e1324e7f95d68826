#define _POSIX_C_SOURCE 200809L
#include "frame_set.h"

#include "try.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Between two commas. */
typedef struct item {
    const char *text;
    size_t length;
    long first, last, step; /* step is above 0 */
    char kind;              /* 'x', 'y' or ':' */
} item;

static const char *skip_spaces(const char *at)
{
    while (isspace((unsigned char)*at))
        at++;
    return at;
}

/* A whole number within TL_FARTHEST_FRAME; NULL where there is none. */
static const char *read_number(const char *at, long *out)
{
    at = skip_spaces(at);
    const int is_negative = *at == '-';
    long value = 0;
    at = skip_spaces(at + is_negative);
    if (!isdigit((unsigned char)*at))
        return NULL;
    for (; isdigit((unsigned char)*at); at++) {
        value = 10 * value + (*at - '0');
        if (value > TL_FARTHEST_FRAME)
            return NULL;
    }
    *out = is_negative ? -value : value;
    return skip_spaces(at);
}

/* The step of a range; NULL where it is none, is 0, or leads away from the end. */
static const char *read_step(const char *at, item *out)
{
    long step;
    out->kind = *at;
    at = read_number(at + 1, &step);
    if (!at || step == 0 || (step < 0 && (out->kind != 'x' || out->last > out->first)))
        return NULL;
    out->step = labs(step);
    return at;
}

/* Up to the comma behind it, or the end; NULL where it is none. */
static const char *read_item(const char *text, item *out)
{
    *out = (item){.text = text, .length = strcspn(text, ","), .step = 1, .kind = 'x'};
    const char *at = read_number(text, &out->first);
    if (!at)
        return NULL;
    out->last = out->first;
    if (*at == '-') {
        at = read_number(at + 1, &out->last);
        if (at && *at && strchr("xy:", *at))
            at = read_step(at, out);
    }
    return at && (*at == ',' || *at == '\0') ? at : NULL;
}

/* Frames as they come, also again. */
typedef struct collector {
    tl_frames all;
    size_t capacity;
} collector;

static tl_status collect(collector *to, long frame, tl_error *err)
{
    if (to->all.count == 2 * (size_t)TL_MOST_FRAMES)
        return tl_fail(err, TL_ERR_ARGUMENT,
                       "more than %u frames in one set, those that come again among them",
                       2 * TL_MOST_FRAMES);
    if (to->all.count == to->capacity) {
        const size_t capacity = to->capacity ? 2 * to->capacity : 256;
        int32_t *grown = realloc(to->all.of, capacity * sizeof *grown);
        if (!grown)
            return tl_fail(err, TL_ERR_MEMORY, "out of memory for a set of frames");
        to->all.of = grown;
        to->capacity = capacity;
    }
    to->all.of[to->all.count++] = (int32_t)frame;
    return TL_OK;
}

/* Those that are a multiple of the step away from the first, or the others. */
static tl_status collect_run(
    collector *to, const item *of, long step, int others, tl_error *err)
{
    const long towards = of->last < of->first ? -1 : 1, extent = labs(of->last - of->first);
    tl_status status = TL_OK;
    for (long i = 0; i <= extent && status == TL_OK; i += others ? 1 : step)
        if (!others || i % step != 0)
            status = collect(to, of->first + towards * i, err);
    return status;
}

/* Steps that grow smaller, each with what those before left. Steps beyond the end have the first alone. */
static tl_status collect_stagger(collector *to, const item *of, tl_error *err)
{
    const long towards = of->last < of->first ? -1 : 1, extent = labs(of->last - of->first);
    tl_status status = TL_OK;
    unsigned char *seen = calloc((size_t)extent + 1, 1);
    if (!seen)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a set of frames");
    for (long step = of->step > extent ? extent + 1 : of->step; step >= 1; step--)
        for (long i = 0; i <= extent && status == TL_OK; i += step)
            if (!seen[i]) {
                seen[i] = 1;
                status = collect(to, of->first + towards * i, err);
            }
    free(seen);
    return status;
}

static long count_of(const item *of)
{
    const long extent = labs(of->last - of->first);
    const long multiples = extent / of->step + 1;
    return of->kind == 'x' ? multiples : extent + 1 - (of->kind == 'y' ? multiples : 0);
}

static tl_status collect_item(collector *to, const item *of, tl_error *err)
{
    if (count_of(of) > (long)TL_MOST_FRAMES)
        return tl_fail(err, TL_ERR_ARGUMENT, "%ld frames: %u at most in one set", count_of(of),
                       TL_MOST_FRAMES);
    if (count_of(of) ==
        0) /* all are multiples of a step of 1: there are no others to look for */
        return TL_OK;
    if (of->kind == ':')
        return collect_stagger(to, of, err);
    return collect_run(to, of, of->step, of->kind == 'y', err);
}

/* A frame and which it was of those that came. */
typedef struct arrival {
    int32_t frame;
    uint32_t place;
} arrival;

static int by_frame(const void *a, const void *b)
{
    const arrival *left = a, *right = b;
    if (left->frame != right->frame)
        return left->frame < right->frame ? -1 : 1;
    return left->place < right->place ? -1 : 1;
}

static int by_place(const void *a, const void *b)
{
    const arrival *left = a, *right = b;
    return left->place < right->place ? -1 : left->place > right->place;
}

static bool is_ascending(const tl_frames *frames)
{
    for (size_t i = 1; i < frames->count; i++)
        if (frames->of[i - 1] >= frames->of[i])
            return false;
    return true;
}

/* Leaves the first of each, in their order. */
static tl_status keep_first(tl_frames *frames, tl_error *err)
{
    if (is_ascending(frames))
        return TL_OK;
    arrival *all = malloc((frames->count + 1) * sizeof *all);
    size_t kept = 0;
    if (!all)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a set of frames");
    for (size_t i = 0; i < frames->count; i++)
        all[i] = (arrival){frames->of[i], (uint32_t)i};
    qsort(all, frames->count, sizeof *all, by_frame);
    for (size_t i = 0; i < frames->count; i++)
        if (i == 0 || all[i].frame != all[kept - 1].frame)
            all[kept++] = all[i];
    qsort(all, kept, sizeof *all, by_place);
    for (size_t i = 0; i < kept; i++)
        frames->of[i] = all[i].frame;
    frames->count = kept;
    free(all);
    return TL_OK;
}

tl_status tl_frames_parse(const char *text, tl_frames *out, tl_error *err)
{
    tl_status status = TL_OK;
    collector made = {.capacity = 0};
    const char *at = text, *end;
    for (;; at = end + 1) {
        item next;
        end = read_item(at, &next);
        if (!end)
            TRY(tl_fail(err, TL_ERR_ARGUMENT,
                        "\"%.*s\" is no set of frames: write 7, 1-100, 1-100x5 (every fifth), "
                        "1-100y5 (the others) or 1-100:5 (coarse first), with commas between",
                        (int)(next.length > 60 ? 60 : next.length), next.text));
        TRY(collect_item(&made, &next, err));
        if (*end == '\0')
            break;
    }
    TRY(keep_first(&made.all, err));
    if (made.all.count == 0)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "\"%.60s\" has no frames", text));
    if (made.all.count > TL_MOST_FRAMES)
        TRY(tl_fail(err, TL_ERR_ARGUMENT, "%zu frames: %u at most in one set", made.all.count,
                    TL_MOST_FRAMES));
    tl_frames_clear(out);
    *out = made.all;
    made.all = (tl_frames){NULL, 0};
done:
    tl_frames_clear(&made.all);
    return status;
}

/* How many from `begin` on are one step apart; at least 1. */
static size_t run_length(const tl_frames *frames, size_t begin, long *step)
{
    size_t length = 1;
    *step = 0;
    for (size_t i = begin + 1; i < frames->count; i++, length++) {
        const long next = (long)frames->of[i] - frames->of[i - 1];
        if (length > 1 && next != *step)
            break;
        *step = next;
    }
    return length;
}

/* One item of what is written: a run that is worth a range, else a frame. Returns how many it is of. */
static size_t format_item(const tl_frames *frames, size_t begin, FILE *to)
{
    long step;
    const size_t length = run_length(frames, begin, &step);
    const int first = frames->of[begin];
    fputs(begin ? "," : "", to);
    if (length < 3 && !(length == 2 && labs(step) == 1)) {
        fprintf(to, "%d", first);
        return 1;
    }
    fprintf(to, "%d-%d", first, frames->of[begin + length - 1]);
    if (labs(step) != 1)
        fprintf(to, "x%ld", labs(step));
    return length;
}

tl_status tl_frames_format(const tl_frames *frames, char **out, tl_error *err)
{
    char *text = NULL;
    size_t size = 0;
    FILE *to = open_memstream(&text, &size);
    if (!to)
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a set of frames");
    for (size_t i = 0; i < frames->count;)
        i += format_item(frames, i, to);
    if (fclose(to) != 0 || !text) {
        free(text);
        return tl_fail(err, TL_ERR_MEMORY, "out of memory for a set of frames");
    }
    *out = text;
    return TL_OK;
}

void tl_frames_clear(tl_frames *frames)
{
    free(frames->of);
    *frames = (tl_frames){NULL, 0};
}
