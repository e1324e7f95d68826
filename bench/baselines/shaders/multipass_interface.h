/* What C and the shaders of the multi-pass baselines agree on. Read by both, so it holds numbers
 * only. */

/* Per corner of the volume, and per light. */
#define ATTRIBUTE_CORNER 0
#define ATTRIBUTE_RECTANGLE 1
#define ATTRIBUTE_POSITION_RANGE2 2
#define ATTRIBUTE_DIFFUSE_FADE 3
#define ATTRIBUTE_SPECULAR 4
#define ATTRIBUTE_FALLOFF 5

#define UNIFORM_CLIP_FROM_VIEW 0
#define UNIFORM_RAYS 1

/* Texture units: what lights look at, and what the last pass adds. */
#define UNIT_DEPTH 0
#define UNIT_NORMAL_EXPONENT 1
#define UNIT_DIFFUSE 2
#define UNIT_SPECULAR 3
#define UNIT_UNLIT 4
#define UNIT_DIFFUSE_LIGHT 5
#define UNIT_SPECULAR_LIGHT 6

/* Rows of kernels/falloff.h. */
#define FADE_LINEAR 0
#define FADE_INVERSE_SQUARE 1
#define FADE_NONE 2
