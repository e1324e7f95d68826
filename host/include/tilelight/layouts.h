/* G-buffers from one layout to another. What each layout is: kernels/layout.h. */
#ifndef TL_LAYOUTS_PUBLIC_H
#define TL_LAYOUTS_PUBLIC_H

#include "gbuffer.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a layout is called on the command line and in files. */
const char *tl_layout_word(enum tl_layout_name layout);

/* Fails with TL_ERR_ARGUMENT, listing the layouts there are. */
tl_status tl_layout_find(const char *word, enum tl_layout_name *out, tl_error *err);

/* Planes (planes.h) that the layout can hold, bits 1 << plane. */
uint32_t tl_layout_planes(enum tl_layout_name layout);

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
