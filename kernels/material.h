/* What a surface reflects under the Phong models.
 *
 * A frame with metallic and roughness is mapped to Phong: diffuse = base (1 - metallic), specular
 * = mix(0.04, base, metallic) as in glTF's appendix B, and the exponent 2/alpha^2 - 2 whose
 * Blinn-Phong lobe has the width of Beckmann's with alpha = roughness^2 (Walter et al., "Microfacet
 * Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2). alpha is not below
 * 0.01414, where the exponent is 10000: smoother surfaces show no highlight wider than a pixel. */
#ifndef TL_MATERIAL_H
#define TL_MATERIAL_H

#include "vec3.h"

#define TL_LEAST_ALPHA2 R(0.00019996000799840032) /* 2/10002: exponent 10000 */
#define TL_DIELECTRIC R(0.04) /* reflectance at normal incidence, index 1.5 */

TL_STRUCT(phong_material)
{
    vec3 diffuse, specular; /* linear Rec. 709 */
    real shininess;         /* Blinn-Phong exponent, 0 to 10000 */
};

/* Roughness as artists see it, alpha its square; not below what no pixel would show. */
TL_INLINE real alpha2_of_roughness(real roughness)
{
    const real alpha = roughness * roughness;
    const real alpha2 = alpha * alpha;
    return pick(alpha2 > TL_LEAST_ALPHA2, alpha2, TL_LEAST_ALPHA2);
}

/* The other way. */
TL_INLINE real alpha2_of_exponent(real exponent)
{
    return R(2.0) / (exponent + R(2.0));
}

TL_INLINE phong_material phong_of_metal_rough(vec3 base, real metallic, real roughness)
{
    const real dielectric = R(1.0) - metallic;
    const real safe_alpha2 = alpha2_of_roughness(roughness);
    const phong_material m = {{base.x * dielectric, base.y * dielectric, base.z * dielectric},
                              {FMA(metallic, base.x - TL_DIELECTRIC, TL_DIELECTRIC),
                               FMA(metallic, base.y - TL_DIELECTRIC, TL_DIELECTRIC),
                               FMA(metallic, base.z - TL_DIELECTRIC, TL_DIELECTRIC)},
                              R(2.0) / safe_alpha2 - R(2.0)};
    return m;
}

#endif
