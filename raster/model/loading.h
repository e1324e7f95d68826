/* The steps of tl_model_load, in their order. Each fills its part of the model, which is released
 * with it whether the step succeeds or not. */
#ifndef TL_LOADING_H
#define TL_LOADING_H

#include "accessor.h"
#include "model.h"

/* Where meshes stand; what becomes draws. */
typedef struct tl_placements {
    size_t count;
    tl_placed *meshes; /* [count], owned by the caller */
} tl_placements;

/* Walks the default scene: sets cameras, lights and *out. Fails with TL_ERR_FORMAT, naming the node,
 * for what is no tree of nodes with finite transforms, or TL_ERR_MEMORY. */
tl_status tl_load_nodes(tl_model *model,
                        const tl_notices *notices,
                        tl_placements *out,
                        tl_error *err);

/* Reads the meshes that are placed: sets vertices, parts and draws. Fails as
 * tl_accessor_read_attribute does, and with TL_ERR_UNSUPPORTED beyond TL_MAX_DRAW_COUNT. */
tl_status tl_load_geometry(tl_model *model,
                           const tl_placements *placements,
                           const tl_notices *notices,
                           tl_error *err);

/* Checks the materials that parts use: sets materials, textures and pixels. Textures whose image is
 * missing are left out, which is told. Fails with TL_ERR_FORMAT, TL_ERR_UNSUPPORTED or
 * TL_ERR_MEMORY, naming the material or image. */
tl_status tl_load_materials(tl_model *model, const tl_notices *notices, tl_error *err);

/* Gives tangents to what has a normal map and none in the file: vertices of its own, for those of the
 * file may need several. Parts without the map's coordinates stay without. Fails with TL_ERR_MEMORY. */
tl_status tl_load_tangents(tl_model *model, tl_error *err);

/* Which of the model's pixels show `image` this way: ones that are there already, or new ones, for
 * which there is room. *out is PIXELS_MISSING where the file's bytes are: that is told. Format and
 * size are checked, nothing is decoded. Fails with TL_ERR_FORMAT or TL_ERR_UNSUPPORTED (neither PNG
 * nor JPEG, or too large), naming the image. */
tl_status tl_find_pixels(tl_model *model,
                         int image,
                         bool srgb,
                         bool mipmaps,
                         const tl_notices *notices,
                         size_t *out,
                         tl_error *err);

static const size_t PIXELS_MISSING = (size_t)-1;

#endif
