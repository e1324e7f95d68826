/* Captures of any kind, ours or another program's: one table decides which reader a file goes to. */
#ifndef TL_CAPTURE_READ_H
#define TL_CAPTURE_READ_H

#include "tilelight/gbuffer.h"
#include "tilelight/image.h"
#include "tilelight/import.h"
#include "tilelight/lights.h"
#include "tilelight/report.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What formats are told apart by. */
typedef struct tl_capture_start {
    const char *path;         /* its end may tell, where a format has no magic number */
    unsigned char bytes[160]; /* the file's first; 0 beyond its end */
    size_t size;              /* of them in the file */
    uint64_t file_size;
} tl_capture_start;

/* What is to be read. */
typedef struct tl_capture_request {
    const char *path;          /* NULL where maps of `import` name a file for every plane */
    const tl_notices *notices; /* what was assumed; NULL: nobody listens */
    const tl_import_options
        *import; /* what another program's numbers mean; NULL: as by default */
    /* Others stand in for lights inside of ours, which are not read then, whatever is wrong with them. */
    bool without_lights;
} tl_capture_request;

/* All zero is empty. */
typedef struct tl_captured {
    tl_gbuffer *gbuffer;
    tl_light_set lights;
    bool has_lights;  /* the file brought lights, even where there are none */
    bool is_imported; /* of another program */
    tl_import_counts counts;
    bool has_look; /* pictures of it are shown so, unless asked otherwise */
    tl_look look;
} tl_captured;

typedef struct tl_capture_format {
    const char *name; /* for sentences: "starts as none of: OpenEXR, ..." */
    bool (*recognises)(const tl_capture_start *start);
    /* Into an empty *out, which it leaves empty where it fails. */
    tl_status (*read)(const tl_capture_request *request, tl_captured *out, tl_error *err);
    bool takes_options; /* of importing; else it says itself what its numbers mean */
} tl_capture_format;

/* The first that recognises a file reads it; formats with a magic number stand before others. */
extern const tl_capture_format tl_capture_formats[];
extern const size_t tl_capture_format_count;

/* The format that recognises the file; NULL where none does, or it cannot be read. */
const tl_capture_format *tl_capture_format_of(const char *path);

/* Reads a capture by the table. Pixels are as the file has them: see tl_gbuffer_repair. The
 * caller releases *out with tl_captured_clear. Fails with TL_ERR_ARGUMENT where options of
 * importing are given that the format has no use for; else with TL_ERR_READ, TL_ERR_FORMAT,
 * TL_ERR_UNSUPPORTED or TL_ERR_MEMORY. */
tl_status tl_capture_read(const tl_capture_request *request, tl_captured *out, tl_error *err);

/* Leaves it empty. Accepts an empty one. */
void tl_captured_clear(tl_captured *captured);

#endif
