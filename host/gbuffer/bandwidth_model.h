/* Bytes that a deferred renderer moves, as N. Thibieroz counts them: "Deferred Shading with Multiple
 * Render Targets", ShaderX2, 2003, equations 4 to 7 and table 1.
 *
 * It is the model of another machine than ours: an immediate-mode GPU without caches that draws a
 * full-screen pass per light. What our own passes move: pass_bytes.h.
 *
 * Where it is wider than the article: targets need not have one size, and a depth buffer that the
 * shading passes read as a texture is counted there. For n targets of one size that hold everything
 * both are n times the size, which is the article's case. */
#ifndef TL_BANDWIDTH_MODEL_H
#define TL_BANDWIDTH_MODEL_H

/* Table 1. Bytes are per pixel or texel. */
typedef struct tl_bandwidth_variables {
    double width, height;     /* W, H: px */
    double depth_bytes;       /* Z_BPP */
    double back_buffer_bytes; /* BB_BPP */
    double overdraw;          /* fragments per pixel */
    double sorting;           /* of those, the ones that pass the depth test: 1 to overdraw */
    double texture_bytes;     /* T_BPP, on average */
    double building_lookups;  /* T_B: texture look-ups a fragment of the building pass */
    double shading_lookups;   /* T_S: the same of a shading pass */
    double shading_passes;    /* n, over the full screen */
    double geometry_bytes;    /* C_geometry, a frame */
    double frames_per_second;
} tl_bandwidth_variables;

/* What table 1 and the example behind it assume, in bytes: 1024 x 768, 60 frames a second. Depth is 4
 * bytes as in the table; the example multiplies by 8. */
tl_bandwidth_variables tl_bandwidth_variables_default(void);

/* The targets of a layout, in bytes per pixel. */
typedef struct tl_target_bytes {
    double written; /* by the building pass, the depth buffer apart */
    double read;    /* by each shading pass */
} tl_target_bytes;

/* `count` targets of `bits` each, written and read whole. */
tl_target_bytes tl_targets_alike(double count, double bits);

/* Equation 4: bytes of a frame's building pass. */
double tl_bandwidth_building(const tl_bandwidth_variables *of, tl_target_bytes targets);

/* Equation 5: bytes of a frame's shading passes. */
double tl_bandwidth_shading(const tl_bandwidth_variables *of, tl_target_bytes targets);

/* Equation 6: bytes a second. */
double tl_bandwidth(const tl_bandwidth_variables *of, tl_target_bytes targets);

/* Equation 7, the "gross approximation" of 6 for the example's variables, from which table 2 follows:
 * bytes a second. */
double tl_bandwidth_rounded(double target_bytes);

#endif
