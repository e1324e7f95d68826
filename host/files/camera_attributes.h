/* A camera as attributes of an OpenEXR file: exactly, in ours, and as matrices that other programs
 * read, in the standard ones. */
#ifndef TL_CAMERA_ATTRIBUTES_H
#define TL_CAMERA_ATTRIBUTES_H

#include "exr_stream.h"
#include "tilelight/camera.h"

#include <openexr.h>

/* OpenEXR's worldToCamera: left-handed, x right, y up, looking along +z; m[4 * i + j], applied to
 * row vectors: out[j] = sum of in[i] * m[4 * i + j]. */
exr_attr_m44f_t tl_world_to_camera(const tl_camera *camera);

/* OpenEXR's worldToNDC: after division by w, (0, 0) is the upper left corner of the image and
 * (1, 1) the lower right; z is 0 on the near plane and 1 on the far plane, where far is finite. */
exr_attr_m44f_t tl_world_to_ndc(const tl_camera *camera);

/* Sets the attributes of a part. Fails with TL_ERR_MEMORY. */
tl_status tl_camera_attributes_write(tl_exr_stream *stream,
                                     int part,
                                     const tl_camera *camera,
                                     tl_error *err);

/* Reads them back, bit for bit, and checks them. Fails with TL_ERR_FORMAT, naming the attribute, or
 * TL_ERR_UNSUPPORTED. */
tl_status tl_camera_attributes_read(tl_exr_stream *stream,
                                    int part,
                                    uint32_t width,
                                    uint32_t height,
                                    tl_camera *out,
                                    tl_error *err);

#endif
