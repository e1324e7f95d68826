#include "words_read.h"

#include "packing.h"
#include "parallel.h"
#include "try.h"

#include <stdatomic.h>
#include <stdlib.h>

/* Numbers of one channel that are several words. */
typedef struct splitting {
    const tl_word_channel *channel;
    tl_word_planes planes;
    const tl_gbuffer *gbuffer;
    uint32_t *numbers;     /* [height][pitch] */
    atomic_bool is_beyond; /* a number has more bits than its words */
} splitting;

static void split_rows(void *context, size_t begin, size_t end)
{
    splitting *s = context;
    const tl_word_channel *c = s->channel;
    for (size_t row = begin; row < end; row++)
        for (size_t x = 0; x < s->gbuffer->camera.width; x++) {
            const size_t at = row * s->gbuffer->pitch + x;
            uint32_t rest = s->numbers[at];
            if (c->bits < 32 && rest >> c->bits)
                atomic_store(&s->is_beyond, true);
            for (uint32_t w = c->first_word; w < c->first_word + c->word_count; w++) {
                const uint32_t bits = 8 * s->planes.layout->words[w].bytes;
                tl_word_put(&s->planes, w, at, rest);
                rest = bits < 32 ? rest >> bits : 0;
            }
        }
}

static tl_status split(const tl_exr_part *part, splitting *s, tl_error *err)
{
    atomic_init(&s->is_beyond, false);
    tl_parallel(s->gbuffer->camera.height, 16, split_rows, s);
    if (atomic_load(&s->is_beyond))
        return tl_fail(err, TL_ERR_FORMAT,
                       "%s: channel \"%s\" has a number of more than %u bits",
                       part->stream->path, s->channel->name, s->channel->bits);
    return TL_OK;
}

/* Channels that memory holds as the file does are read in place; others beside it, then split. */
tl_status tl_words_read(const tl_exr_part *part,
                        const tl_gbuffer_header *of,
                        tl_gbuffer *gbuffer,
                        tl_error *err)
{
    tl_status status = TL_OK;
    tl_exr_target targets[TL_MAX_WORDS] = {{.channel = NULL}};
    splitting split_ones[TL_MAX_WORDS];
    size_t split_count = 0;
    for (size_t i = 0; i < of->channel_count; i++) {
        const tl_word_channel *c = &of->channels[i];
        targets[i] = (tl_exr_target){.channel = c->name, .held = (exr_pixel_type_t)c->held};
        if (tl_word_is_whole(c)) {
            targets[i].plane = tl_gbuffer_words(gbuffer, c->first_word);
            continue;
        }
        splitting *s = &split_ones[split_count++];
        *s =
            (splitting){.channel = c, .planes = tl_word_planes_of(gbuffer), .gbuffer = gbuffer};
        targets[i].plane = s->numbers =
            malloc((size_t)gbuffer->pitch * gbuffer->camera.height * sizeof *s->numbers);
        if (!s->numbers)
            TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory for channel \"%s\"",
                        part->stream->path, c->name));
    }
    TRY(tl_exr_part_pixels(part, targets, of->channel_count, gbuffer->pitch, err));
    for (size_t i = 0; i < split_count; i++)
        TRY(split(part, &split_ones[i], err));
done:
    while (split_count > 0)
        free(split_ones[--split_count].numbers);
    return status;
}
