/* PFM files as sources. */
#include "pfm.h"
#include "source.h"
#include "try.h"

#include <stdlib.h>

static tl_status open_pfm(tl_source *source, tl_error *err)
{
    tl_status status = TL_OK;
    tl_pfm *of = calloc(1, sizeof *of);
    source->pixels = of;
    if (!of)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", source->path));
    TRY(tl_pfm_read(source->path, of, err));
    TRY(tl_source_add_picture(source, of->width, of->height, of->numbers, "float", err));
done:
    return status;
}

static tl_status read_pfm(tl_source *source,
                          const uint32_t *indices,
                          float *const *planes,
                          size_t count,
                          size_t pitch,
                          tl_error *err)
{
    const tl_pfm *of = source->pixels;
    (void)err;
    for (size_t y = 0; y < of->height; y++)
        for (size_t x = 0; x < of->width; x++)
            for (size_t i = 0; i < count; i++)
                planes[i][y * pitch + x] = tl_pfm_number(of, x, y, indices[i]);
    return TL_OK;
}

static void close_pfm(tl_source *source)
{
    if (source->pixels)
        tl_pfm_clear(source->pixels);
    free(source->pixels);
}

const tl_source_format tl_source_pfm = {"PFM", tl_pfm_recognises, open_pfm, read_pfm,
                                        close_pfm};
