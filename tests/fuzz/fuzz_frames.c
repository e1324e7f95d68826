/* Sets of frames and patterns of names: does any text do more than be refused? What is read is what is
 * written, and names of frames tell them apart. */
#include "fuzz.h"

#include "frame_set.h"
#include "pattern.h"

#include <stdlib.h>
#include <string.h>

/* The set as text, read again, is the same; of two neighbours none is the other. */
static void must_survive(const tl_frames *frames)
{
    tl_error err = {.status = TL_OK};
    tl_frames again = {NULL, 0};
    char *text = NULL;
    fuzz_must(tl_frames_format(frames, &text, &err) == TL_OK, "%s", err.message);
    fuzz_must(tl_frames_parse(text, &again, &err) == TL_OK, "%s", err.message);
    fuzz_must(again.count == frames->count &&
                  memcmp(again.of, frames->of, frames->count * sizeof *frames->of) == 0,
              "%zu frames, and %zu of \"%.100s\"", frames->count, again.count, text);
    for (size_t i = 1; i < frames->count; i++)
        fuzz_must(frames->of[i - 1] != frames->of[i], "frame %d twice", (int)frames->of[i]);
    free(text);
    tl_frames_clear(&again);
}

/* Names of two frames differ where there is a number. */
static void must_tell_apart(const char *text)
{
    tl_error err = {.status = TL_OK};
    tl_pattern pattern;
    char *first = NULL, *second = NULL;
    if (tl_pattern_read(text, &pattern, &err) != TL_OK)
        return;
    fuzz_must(pattern.before <= pattern.behind && pattern.behind <= strlen(text),
              "a number from %zu to %zu", pattern.before, pattern.behind);
    fuzz_must(tl_pattern_fill(&pattern, 7, NULL, &first, &err) == TL_OK, "%s", err.message);
    fuzz_must(tl_pattern_fill(&pattern, -7, NULL, &second, &err) == TL_OK, "%s", err.message);
    fuzz_must((strcmp(first, second) != 0) == (pattern.digits > 0), "%s: %s and %s", text,
              first, second);
    free(first);
    free(second);
}

/* Sets of millions take their time, and are those of fewer otherwise. */
static bool is_long(const char *text)
{
    size_t digits = 0;
    for (; *text; text++) {
        digits = *text >= '0' && *text <= '9' ? digits + 1 : 0;
        if (digits > 5)
            return true;
    }
    return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tl_error err = {.status = TL_OK};
    tl_frames frames = {NULL, 0};
    char text[256];
    const size_t length = size < sizeof text - 1 ? size : sizeof text - 1;
    memcpy(text, data, length);
    text[length] = '\0';
    must_tell_apart(text);
    if (is_long(text))
        return 0;
    const tl_status status = tl_frames_parse(text, &frames, &err);
    if (status == TL_OK)
        must_survive(&frames);
    else
        fuzz_must(status == TL_ERR_ARGUMENT && err.message[0], "status %d: %s", (int)status,
                  err.message);
    tl_frames_clear(&frames);
    return 0;
}
