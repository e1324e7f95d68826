/* What C and GLSL agree on: locations and units. Read by both, so it holds numbers only. */

/* Attributes stand in the order of TL_GLTF_ATTRIBUTES. */
#define ATTRIBUTE_POSITION 0
#define ATTRIBUTE_NORMAL 1
#define ATTRIBUTE_TANGENT 2
#define ATTRIBUTE_TEXCOORD_0 3
#define ATTRIBUTE_COLOR 11

/* Sets of texture coordinates, from ATTRIBUTE_TEXCOORD_0 on. Few materials look at more than
 * two, so shaders for more are others. */
#define MOST_SETS 8
#define FEW_SETS 2
#ifdef MANY_SETS
#    define SET_COUNT MOST_SETS
#else
#    define SET_COUNT FEW_SETS
#endif

/* Texture units, and the order of per-slot uniforms: that of TL_GLTF_SLOTS. */
#define SLOT_BASE_COLOR 0
#define SLOT_METALLIC_ROUGHNESS 1
#define SLOT_NORMAL_MAP 2
#define SLOT_OCCLUSION 3
#define SLOT_EMISSIVE 4
#define SLOT_COUNT 5

/* And behind them what peeling looks at: peel.glsl. */
#define SLOT_BACK SLOT_COUNT
#define SLOT_TAKEN_FRONT (SLOT_COUNT + 1)
#define SLOT_TAKEN_CHOICE (SLOT_COUNT + 2)
#define SLOT_FRONT (SLOT_COUNT + 3)
#define SLOT_CHOICE (SLOT_COUNT + 4)

#define UNIFORM_CLIP_FROM_VIEW 0
#define UNIFORM_VIEW_FROM_MODEL 1
#define UNIFORM_NORMAL_FROM_MODEL 2
#define UNIFORM_TANGENT_FROM_MODEL 3
#define UNIFORM_WORLD_FROM_VIEW 4
#define UNIFORM_BITANGENT_SIGN 5
#define UNIFORM_BASE_COLOR 6
#define UNIFORM_EMISSIVE 7
#define UNIFORM_FACTORS 8 /* metallic, roughness, normal scale, occlusion strength */
#define UNIFORM_ALPHA_CUTOFF 9
#define UNIFORM_COORDINATES 10                        /* [SLOT_COUNT] */
#define UNIFORM_UV (UNIFORM_COORDINATES + SLOT_COUNT) /* [2 SLOT_COUNT] rows of matrices */
#define UNIFORM_EYE (UNIFORM_UV + 2 * SLOT_COUNT)     /* in world space, m */
#define UNIFORM_DEPTH_RANGE (UNIFORM_EYE + 1)         /* near, far in m; 1: parallel rays */
#define UNIFORM_ANISOTROPY \
    (UNIFORM_DEPTH_RANGE + 1) /* [SLOT_COUNT]; 1: as the sampler alone has it */
#define UNIFORM_BRDF (UNIFORM_ANISOTROPY + SLOT_COUNT) /* index of the BRDF, 0: none */
#define UNIFORM_RANK (UNIFORM_BRDF + 1)                /* of the first triangle: peel.glsl */
#define UNIFORM_OBJECT (UNIFORM_RANK + 1)              /* id, where ids are drawn */
