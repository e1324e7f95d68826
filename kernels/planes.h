/* The planes of a G-buffer in full float, as host and device hold them.
 *
 * X(name, channel in the file, value where nothing was hit, meaning)
 *
 * A plane is float32 [rows][pitch]. A frame holds the planes its scene has, in this order, without
 * gaps: plane p stands in slot TL_SLOT(present, p). Depth, normal and albedo are always present. */
#ifndef TL_PLANES_H
#define TL_PLANES_H

#define TL_PLANES(X)                                                                           \
    X(TL_DEPTH, "Z", INFINITY, "m along the view axis, positive; +infinity is sky")            \
    X(TL_NORMAL_X, "N.X", 0.0f, "world space, towards the viewer's side of the surface")       \
    X(TL_NORMAL_Y, "N.Y", 0.0f, "world space")                                                 \
    X(TL_NORMAL_Z, "N.Z", 0.0f, "world space")                                                 \
    X(TL_ALBEDO_R, "albedo.R", 0.0f, "diffuse colour, or base colour where metallic is there") \
    X(TL_ALBEDO_G, "albedo.G", 0.0f, "linear Rec. 709, 0 to 1")                                \
    X(TL_ALBEDO_B, "albedo.B", 0.0f, "linear Rec. 709, 0 to 1")                                \
    X(TL_SPECULAR_R, "specular.R", 0.0f, "specular colour of a Phong material")                \
    X(TL_SPECULAR_G, "specular.G", 0.0f, "linear Rec. 709, 0 to 1")                            \
    X(TL_SPECULAR_B, "specular.B", 0.0f, "linear Rec. 709, 0 to 1")                            \
    X(TL_SHININESS, "shininess", 0.0f, "Blinn-Phong exponent, 0 to 10000")                     \
    X(TL_METALLIC, "metallic", 0.0f, "0 to 1")                                                 \
    X(TL_ROUGHNESS, "roughness", 0.0f, "perceptual, 0 to 1: alpha is its square")              \
    X(TL_OCCLUSION, "ao", 1.0f, "share of the ambient light that arrives, 0 to 1")             \
    X(TL_EMISSIVE_R, "emissive.R", 0.0f, "radiance the surface sends out by itself")           \
    X(TL_EMISSIVE_G, "emissive.G", 0.0f, "linear Rec. 709, 0 and above")                       \
    X(TL_EMISSIVE_B, "emissive.B", 0.0f, "linear Rec. 709, 0 and above")                       \
    X(TL_BRDF, "brdf", 0.0f, "row of the materials, 1 to 255; 0: the frame's own model")       \
    X(TL_TANGENT_X, "T.X", 0.0f, "world space, along the surface's grain; unit, or 0")         \
    X(TL_TANGENT_Y, "T.Y", 0.0f, "world space")                                                \
    X(TL_TANGENT_Z, "T.Z", 0.0f, "world space")

#define TL_PLANE_NAME(name, channel, empty, meaning) name,
enum tl_plane { TL_PLANES(TL_PLANE_NAME) TL_PLANE_COUNT };
#undef TL_PLANE_NAME

/* Sets of planes, as bits 1 << plane. Every set is whole: a file with one of a group has all. But the
 * exponent may stand without a specular colour beside an index, for rows of materials can bring one. */
#define TL_HAS(plane) (1u << (plane))
#define TL_THREE(first) (7u << (first))
#define TL_GROUP_BASE (TL_HAS(TL_DEPTH) | TL_THREE(TL_NORMAL_X) | TL_THREE(TL_ALBEDO_R))
#define TL_GROUP_PHONG (TL_THREE(TL_SPECULAR_R) | TL_HAS(TL_SHININESS))
#define TL_GROUP_METAL_ROUGH (TL_HAS(TL_METALLIC) | TL_HAS(TL_ROUGHNESS))
#define TL_GROUP_OCCLUSION TL_HAS(TL_OCCLUSION)
#define TL_GROUP_EMISSIVE TL_THREE(TL_EMISSIVE_R)
#define TL_GROUP_BRDF TL_HAS(TL_BRDF)
#define TL_GROUP_TANGENT TL_THREE(TL_TANGENT_X)

#define TL_MAX_MATERIALS 255 /* indices of TL_BRDF beside 0 */

/* How many planes of `present` stand before `plane`. */
#ifdef __OPENCL_C_VERSION__
#    define TL_SLOT(present, plane) popcount((present) & ((1u << (plane)) - 1u))
#else
#    define TL_SLOT(present, plane) \
        ((uint32_t)__builtin_popcount((present) & ((1u << (plane)) - 1u)))
#endif

#endif
