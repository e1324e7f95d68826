/* A picture file as named channels of numbers, whatever its format: what planes are imported from. */
#ifndef TL_IMPORT_SOURCE_H
#define TL_IMPORT_SOURCE_H

#include "exr_part.h"
#include "tilelight/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A part of an OpenEXR file; the whole of another. Names are the source's. */
typedef struct tl_source_part {
    const char *name;                  /* "" where it has none */
    uint32_t width, height;            /* px, of the frame: the display window */
    char refusal[512];                 /* why it cannot be read; "" where it can */
    tl_exr_part exr;                   /* of OpenEXR */
    const char *storage, *compression; /* words; "" where the format has one of each */
} tl_source_part;

typedef struct tl_source_channel {
    uint32_t part;
    const char *name;
    const char *type; /* "half", "float", "uint", "8 or 16 bits" */
    bool is_number;   /* can be read: no whole numbers without a scale */
    bool is_whole;    /* such whole numbers: can be read as indices */
} tl_source_channel;

/* TL_MAX_READ: all numbers of all kinds of planes. */
enum { TL_MAX_SOURCE_PARTS = 256, TL_MAX_SOURCE_CHANNELS = 4096, TL_MAX_READ = 32 };

typedef struct tl_source tl_source;

/* What reads a format. */
typedef struct tl_source_format {
    const char *name; /* "OpenEXR" */
    bool (*recognises)(const unsigned char *bytes, size_t size);
    /* Fills parts and channels of a source whose path is set. */
    tl_status (*open)(tl_source *source, tl_error *err);
    /* Into planes[i] = [height][pitch] the number of channel indices[i]: all of one part, no two
     * alike, 1 to TL_MAX_READ of them. Beside the data window planes stay as they are. */
    tl_status (*read)(tl_source *source,
                      const uint32_t *indices,
                      float *const *planes,
                      size_t count,
                      size_t pitch,
                      tl_error *err);
    void (*close)(tl_source *source);
} tl_source_format;

struct tl_source {
    const char *path; /* the caller's */
    const tl_source_format *format;
    tl_source_part *parts; /* [part_count] */
    uint32_t part_count;
    tl_source_channel *channels; /* [channel_count], in the file's order */
    uint32_t channel_count;
    uint64_t file_size; /* bytes */
    bool needs_srgb;    /* colours are encoded for screens */
    tl_exr_stream stream;
    void *pixels; /* of formats that are decoded when opened */
};

extern const tl_source_format tl_source_exr, tl_source_pfm, tl_source_png;
extern const tl_source_format *const tl_source_formats[];
extern const size_t tl_source_format_count;

/* Must not move while it is open. All zero is valid to close. Fails with TL_ERR_READ, TL_ERR_FORMAT,
 * TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. A part that cannot be read is no failure: its refusal says
 * why. */
tl_status tl_source_open(tl_source *source, const char *path, tl_error *err);
void tl_source_close(tl_source *source);

/* For the formats: appends, with memory of its own for the array alone. */
tl_status tl_source_add_part(tl_source *source, const tl_source_part *part, tl_error *err);
tl_status tl_source_add_channel(tl_source *source,
                                const tl_source_channel *channel,
                                tl_error *err);

/* The one part of a format without parts, and its channels: Y, or R, G, B. */
tl_status tl_source_add_picture(tl_source *source,
                                uint32_t width,
                                uint32_t height,
                                size_t numbers,
                                const char *type,
                                tl_error *err);

#endif
