#include "reading.h"

#include "try.h"

#include <assert.h>

void tl_reading_add(tl_reading *reading,
                    const tl_binding *binding,
                    unsigned numbers,
                    float *const *planes)
{
    for (unsigned i = 0; i < numbers; i++) {
        assert(reading->count < TL_MAX_READ);
        reading->items[reading->count].source = binding->source;
        reading->items[reading->count].channel = binding->channels[i];
        reading->items[reading->count].plane = planes[i];
        reading->items[reading->count++].is_done = false;
    }
}

static bool is_among(const uint32_t *channels, size_t count, uint32_t channel)
{
    for (size_t i = 0; i < count; i++)
        if (channels[i] == channel)
            return true;
    return false;
}

/* What is left of the part of item `first`, each channel once: one that is wanted twice is read
 * again. */
static tl_status read_part(
    tl_reading *reading, size_t first, tl_source *source, size_t pitch, tl_error *err)
{
    uint32_t channels[TL_MAX_READ];
    float *planes[TL_MAX_READ];
    size_t count = 0;
    const uint32_t part = source->channels[reading->items[first].channel].part;
    for (size_t i = first; i < reading->count; i++) {
        const uint32_t channel = reading->items[i].channel;
        if (reading->items[i].is_done ||
            reading->items[i].source != reading->items[first].source ||
            source->channels[channel].part != part || is_among(channels, count, channel))
            continue;
        channels[count] = channel;
        planes[count++] = reading->items[i].plane;
        reading->items[i].is_done = true;
    }
    return source->format->read(source, channels, planes, count, pitch, err);
}

tl_status tl_reading_run(tl_reading *reading, tl_source *sources, size_t pitch, tl_error *err)
{
    tl_status status = TL_OK;
    for (size_t i = 0; i < reading->count; i++)
        if (!reading->items[i].is_done)
            TRY(read_part(reading, i, &sources[reading->items[i].source], pitch, err));
done:
    return status;
}
