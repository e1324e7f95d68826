#include "exr_compression.h"

static const exr_compression_t compressions[TL_EXR_COMPRESSION_COUNT] = {
    [TL_EXR_NONE] = EXR_COMPRESSION_NONE, [TL_EXR_RLE] = EXR_COMPRESSION_RLE,
    [TL_EXR_ZIPS] = EXR_COMPRESSION_ZIPS, [TL_EXR_ZIP] = EXR_COMPRESSION_ZIP,
    [TL_EXR_PIZ] = EXR_COMPRESSION_PIZ,   [TL_EXR_PXR24] = EXR_COMPRESSION_PXR24,
    [TL_EXR_B44] = EXR_COMPRESSION_B44,   [TL_EXR_B44A] = EXR_COMPRESSION_B44A,
    [TL_EXR_DWAA] = EXR_COMPRESSION_DWAA, [TL_EXR_DWAB] = EXR_COMPRESSION_DWAB,
};

exr_compression_t tl_exr_compression_of(tl_exr_form form)
{
    if (form.compression == TL_EXR_USUAL)
        return form.half ? EXR_COMPRESSION_ZIP : EXR_COMPRESSION_NONE;
    return compressions[form.compression];
}

exr_pixel_type_t tl_exr_type_of(tl_exr_form form)
{
    return form.half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
}
