/* What batches are told: does any text of frames, pattern or manifest do more than be refused? A set that is
 * taken is written as what is read as the same set, and a manifest's items each have what a batch needs.
 *
 * The first byte chooses what the rest is. */
#include "fuzz.h"

#include "frame_set.h"
#include "manifest.h"
#include "pattern.h"

#include <stdlib.h>
#include <string.h>

/* Longer sets, and of frames farther away, take seconds each. */
enum { MOST_SIGNS = 100, MOST_DIGITS = 5 };

static bool is_quick(const char *text)
{
    size_t digits = 0;
    for (size_t i = 0; text[i]; i++) {
        digits = text[i] >= '0' && text[i] <= '9' ? digits + 1 : 0;
        if (i == MOST_SIGNS || digits > MOST_DIGITS)
            return false;
    }
    return true;
}

static void must_be_same(const tl_frames *a, const tl_frames *b, const char *text)
{
    fuzz_must(a->count == b->count && memcmp(a->of, b->of, a->count * sizeof *a->of) == 0,
              "\"%s\" is another set", text);
}

static void try_frames(const char *text)
{
    tl_error err = {.status = TL_OK};
    tl_frames frames = {.of = NULL}, again = {.of = NULL};
    char *written = NULL;
    if (is_quick(text) && tl_frames_parse(text, &frames, &err) == TL_OK) {
        fuzz_must(tl_frames_format(&frames, &written, &err) == TL_OK, "%s", err.message);
        fuzz_must(tl_frames_parse(written, &again, &err) == TL_OK, "%s", err.message);
        must_be_same(&frames, &again, written);
    }
    free(written);
    tl_frames_clear(&again);
    tl_frames_clear(&frames);
}

static void try_pattern(const char *text)
{
    tl_error err = {.status = TL_OK};
    tl_pattern pattern;
    char *made = NULL;
    if (tl_pattern_read(text, &pattern, &err) != TL_OK)
        return;
    fuzz_must(pattern.before <= pattern.behind && pattern.behind <= strlen(text),
              "a number from %zu to %zu", pattern.before, pattern.behind);
    fuzz_must(tl_pattern_fill(&pattern, -7, "name", &made, &err) == TL_OK, "%s", err.message);
    free(made);
}

static void try_manifest(const char *text)
{
    const char *path = fuzz_file(text, strlen(text));
    tl_error err = {.status = TL_OK};
    tl_item_list list = {.of = NULL};
    const tl_status status = tl_manifest_read(path, false, &list, &err);
    fuzz_must_tell(status, &err, path);
    for (size_t i = 0; status == TL_OK && i < list.count; i++) {
        const tl_item *item = &list.of[i];
        fuzz_must(item->name && item->input && item->output_count > 0, "item %zu lacks a part",
                  i);
        for (size_t k = 0; k < item->output_count; k++)
            fuzz_must(item->outputs[k] != NULL, "item %zu has no output %zu", i, k);
    }
    tl_items_clear(&list);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static void (*const tries[])(const char *text) = {try_frames, try_pattern, try_manifest};
    if (size == 0)
        return 0;
    char *text = malloc(size);
    fuzz_must(text != NULL, "out of memory for %zu bytes", size);
    memcpy(text, data + 1, size - 1);
    text[size - 1] = '\0';
    tries[data[0] % (sizeof tries / sizeof tries[0])](text);
    free(text);
    return 0;
}
