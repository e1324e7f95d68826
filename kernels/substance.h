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
    real alpha2;  /* square of the lobe's width; along the direction where there are two */
    real across2; /* of that across it */
    real k;       /* Minnaert's exponent */
    real below;   /* of diffuse light, what metal-rough's surface lets in at normal incidence */
    vec3 along;   /* view space, of any length: where the lobe has a direction */
} substance;

TL_INLINE real largest(vec3 c)
{
    const real a = pick(c.x > c.y, c.x, c.y);
    return pick(a > c.z, a, c.z);
}

/* What metal-rough lets in under a specular colour: KHR_materials_pbrSpecularGlossiness. */
TL_INLINE real below_specular(vec3 specular)
{
    return R(1.0) - largest(specular);
}

/* Minnaert's exponent of a surface that only says how rough it is: from 1, Lambert's, to 1/2, which is the
 * full Moon's. */
TL_INLINE real k_of_alpha2(real alpha2)
{
    return FMA(SQRT(SQRT(alpha2)), R(-0.5), R(1.0));
}

TL_INLINE substance substance_of(const tl_frame *frame, tl_needs needs, pixel of)
{
    substance m;
    m.model = (integer)needs.model;
    if (needs.present & TL_GROUP_METAL_ROUGH) {
        const phong_material mapped =
            phong_of_metal_rough(of.albedo, of.metallic, of.roughness);
        m.diffuse = mapped.diffuse;
        m.specular = mapped.specular;
        m.shininess = mapped.shininess;
        m.alpha2 = alpha2_of_roughness(of.roughness);
        m.below = R(1.0) - TL_DIELECTRIC;
    } else {
        m.diffuse = of.albedo;
        m.specular = of.specular;
        m.shininess = of.shininess;
        m.alpha2 = alpha2_of_exponent(of.shininess);
        m.below = below_specular(of.specular);
    }
    if (needs.fixed_exponent) {
        m.shininess = (real)frame->exponent;
        m.alpha2 = alpha2_of_exponent(m.shininess);
    }
    m.across2 = m.alpha2;
    m.k = k_of_alpha2(m.alpha2);
    m.along.x = (real)frame->view_from_world[0][1];
    m.along.y = (real)frame->view_from_world[1][1];
    m.along.z = (real)frame->view_from_world[2][1];
    return m;
}

#endif
