/* What would be imported: files, planes, frame and camera, before a pixel is read. */
#ifndef TL_IMPORT_PLAN_H
#define TL_IMPORT_PLAN_H

#include "aliases.h"
#include "source.h"
#include "tilelight/import.h"

/* Where a camera came from. */
typedef struct tl_found_camera {
    tl_camera camera;
    bool is_exact;              /* our own attributes: near and far with it */
    bool is_placed;             /* in a world; else the world is its view space */
    char lens[128], place[128]; /* for notices: what said so */
    char missing[768];          /* why there is none; "" where there is one */
} tl_found_camera;

/* Must not move while it is open. All zero is valid to close. */
typedef struct tl_import_plan {
    const tl_import_options *options; /* the caller's */
    tl_source *sources;               /* [source_count]; 0 is the capture, where there is one */
    uint32_t source_count;
    bool has_capture;
    tl_binding bindings[TL_IMPORT_COUNT];
    uint32_t width, height; /* px, of the frame; 0 where no plane was found */
    double pixel_aspect;
    tl_found_camera camera;
    uint32_t present;   /* planes of the G-buffer */
    char missing[1024]; /* why it cannot be lit; "" where it can */
} tl_import_plan;

/* Opens every file and binds planes. path may be NULL. What is missing for lighting is no failure: see
 * `missing`. Fails as tl_import_read. */
tl_status tl_import_plan_open(tl_import_plan *plan,
                              const char *path,
                              const tl_import_options *options,
                              const tl_notices *notices,
                              tl_error *err);
void tl_import_plan_close(tl_import_plan *plan);

/* The part that a plane is read from; the plane is bound. */
const tl_source_part *tl_import_part(const tl_import_plan *plan, tl_import_plane plane);

/* Finds the camera of a frame of the plan's size. `missing` says why there is none. Fails where what is
 * given is wrong. */
tl_status tl_import_find_camera(tl_import_plan *plan, const tl_notices *notices, tl_error *err);

/* Camera files: docs/file-formats.md. Width, height and pixel_aspect are the frame's. Fails with
 * TL_ERR_READ, TL_ERR_FORMAT or TL_ERR_MEMORY, naming the field. */
tl_status tl_camera_file_read(const char *path,
                              uint32_t width,
                              uint32_t height,
                              double pixel_aspect,
                              tl_camera *out,
                              tl_error *err);

#endif
