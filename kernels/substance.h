/* What the surface of a pixel is made of, whatever planes say it: all that a model may take of it. */
#ifndef TL_SUBSTANCE_H
#define TL_SUBSTANCE_H

#include "frame.h"
#include "material.h"
#include "needs.h"

/* One pixel (a vector of them) as loaded; what the frame lacks has the value planes.h gives it. */
typedef struct pixel {
    real depth;
    vec3 normal, albedo, specular, emissive, tangent;
    real shininess, metallic, roughness, occlusion, brdf;
} pixel;

typedef struct substance {
    integer model;          /* a row of models.h; reflects_by is what to ask */
    vec3 diffuse, specular; /* linear Rec. 709 */
    real shininess;         /* exponent, 0 to 10000 */
} substance;

TL_INLINE substance substance_of(const tl_frame *frame, tl_needs needs, pixel of)
{
    substance m;
    (void)frame;
    m.model = (integer)needs.model;
    if (needs.present & TL_GROUP_METAL_ROUGH) {
        const phong_material mapped =
            phong_of_metal_rough(of.albedo, of.metallic, of.roughness);
        m.diffuse = mapped.diffuse;
        m.specular = mapped.specular;
        m.shininess = mapped.shininess;
    } else {
        m.diffuse = of.albedo;
        m.specular = of.specular;
        m.shininess = of.shininess;
    }
    return m;
}

#endif
