/* G-buffers from one layout to another. What each layout is: kernels/layout.h. */
#ifndef TL_LAYOUTS_PUBLIC_H
#define TL_LAYOUTS_PUBLIC_H

#include "gbuffer.h"
#include "report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a layout is called on the command line and in files. */
const char *tl_layout_word(enum tl_layout_name layout);

/* Fails with TL_ERR_ARGUMENT, listing the layouts there are. */
tl_status tl_layout_find(const char *word, enum tl_layout_name *out, tl_error *err);

/* Planes (planes.h) that the layout can hold, bits 1 << plane. */
uint32_t tl_layout_planes(enum tl_layout_name layout);

/* Those of `wanted` that a frame in the layout has: where an index takes the bits of the specular colour
 * (merlin), a frame with indices has no such colour, and keeps the exponent; which does not stand alone where
 * there is neither. */
uint32_t tl_layout_planes_of(enum tl_layout_name layout, uint32_t wanted);

/* Formats of render targets, by OpenGL's names. X(name, word, bytes of a texel, channels)
 *
 * A layout's words are the memory of its targets, little-endian, channel after channel from the lowest
 * bit (GL_UNSIGNED_INT_2_10_10_10_REV for RGB10_A2). R32UI: packed by the shader, for want of a format
 * that OpenGL renders to. D24 and D32F are depth buffers. */
#define TL_FORMATS(X)                                \
    X(TL_FORMAT_RGBA32F, "RGBA32F", 16, 4)           \
    X(TL_FORMAT_R32F, "R32F", 4, 1)                  \
    X(TL_FORMAT_RGBA16F, "RGBA16F", 8, 4)            \
    X(TL_FORMAT_RG16F, "RG16F", 4, 2)                \
    X(TL_FORMAT_R16F, "R16F", 2, 1)                  \
    X(TL_FORMAT_RGBA8, "RGBA8", 4, 4)                \
    X(TL_FORMAT_RGBA8_SNORM, "RGBA8_SNORM", 4, 4)    \
    X(TL_FORMAT_RGB10_A2, "RGB10_A2", 4, 4)          \
    X(TL_FORMAT_RG8, "RG8", 2, 2)                    \
    X(TL_FORMAT_R32UI, "R32UI", 4, 1)                \
    X(TL_FORMAT_D24, "D24", 4, 1) /* bits 0 to 23 */ \
    X(TL_FORMAT_D32F, "D32F", 4, 1)

#define TL_FORMAT_NAME(name, word, bytes, channels) name,
enum tl_format { TL_FORMATS(TL_FORMAT_NAME) TL_FORMAT_COUNT };
#undef TL_FORMAT_NAME

typedef struct tl_format_row {
    const char *word;
    uint32_t bytes, channels;
} tl_format_row;

const tl_format_row *tl_format_describe(enum tl_format format);

enum { TL_MAX_TARGETS = 8 }; /* of OpenGL at once, everywhere */

/* A render target and the words it is read as. It is made where the frame has one of them; what the
 * texel holds beyond its words (a fourth channel) is not stored. */
typedef struct tl_target {
    enum tl_format format;
    uint32_t first_word, word_count;
    const char *holds;
} tl_target;

typedef struct tl_layout_info {
    const char *source;  /* author, title, year, section */
    const char *summary; /* a line */
    uint32_t target_count;
    tl_target targets[TL_MAX_TARGETS]; /* every word in one of them, in the words' order */
} tl_layout_info;

/* Where the layout is from and what the geometry pass renders it to. Cannot fail. */
const tl_layout_info *tl_layout_describe(enum tl_layout_name layout);

/* What of a group of planes `dropped` holds is called. */
const char *tl_dropped_name(size_t group, uint32_t dropped);

/* Names in a notice the groups of planes that `dropped` holds, if any. file: what they were dropped of. */
void tl_layout_tell_dropped(enum tl_layout_name layout,
                            const char *file,
                            uint32_t dropped,
                            const tl_notices *notices);

/* What packing could not keep. */
typedef struct tl_packing_report {
    uint32_t dropped; /* planes that the layout has no place for */
    /* Pixels with a value in this plane beyond what the layout can say: it was cut. */
    uint64_t cut[TL_PLANE_COUNT];
    uint64_t lost; /* pixels whose position cannot be said, not even nearly: they became sky */
} tl_packing_report;

/* From full float, through tl_gbuffer_repair, to `layout`; on all threads. What is made has been through
 * tl_gbuffer_repair too, and has its slack. A metal-rough G-buffer becomes a Phong one
 * (kernels/material.h) where the layout has no place for metallic and roughness. The caller
 * releases *out with tl_gbuffer_destroy; report may be NULL. Fails with TL_ERR_UNSUPPORTED (the other way
 * round; a convention of depth that this camera has not) or TL_ERR_MEMORY. */
tl_status tl_gbuffer_pack(const tl_gbuffer *from,
                          enum tl_layout_name layout,
                          tl_gbuffer **out,
                          tl_packing_report *report,
                          tl_error *err);

/* To full float, as float kernels read it; depth where positions are stored. On all threads. The caller
 * releases *out with tl_gbuffer_destroy. Fails with TL_ERR_MEMORY. */
tl_status tl_gbuffer_unpack(const tl_gbuffer *from, tl_gbuffer **out, tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
