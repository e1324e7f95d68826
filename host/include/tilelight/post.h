/* What is done to a lit picture before it leaves: stages after lighting, in one order, each off unless it is
 * asked for (docs/post-processing.md). */
#ifndef TL_POST_H
#define TL_POST_H

#include "gbuffer.h"
#include "image.h"
#include "lighting.h"
#include "report.h"

#ifdef __cplusplus
extern "C" {
#endif

/* In the order in which they run. Those before `resolve` see a picture of samples, as large as its G-buffer;
 * those behind it one of pixels.
 * X(name, word, what it reads around a pixel, meaning) */
#define TL_POST_STAGES(X)                                                                     \
    X(TL_POST_MEND, "mend", "the picture, 1 row around",                                      \
      "pixels that are NaN or infinite are counted, and become the mean of their neighbours") \
    X(TL_POST_EDGES, "edges", "the picture, depth and normals, 1 row around",                 \
      "edges of surfaces are smoothed")                                                       \
    X(TL_POST_RESOLVE, "resolve", "the picture, a pixel's own samples",                       \
      "a pixel becomes the mean of its samples")                                              \
    X(TL_POST_BLOOM, "bloom", "the picture, as many rows around as its width asks for",       \
      "what is bright scatters over what is around")                                          \
    X(TL_POST_SCALE, "scale", "the picture, the rows that the filter reaches",                \
      "the picture gets another size, by a filter")

typedef enum tl_post_stage {
#define TL_POST_NAME(name, word, reads, meaning) name,
    TL_POST_STAGES(TL_POST_NAME)
#undef TL_POST_NAME
        TL_POST_STAGE_COUNT
} tl_post_stage;

typedef struct tl_post_stage_row {
    const char *word, *reads, *meaning;
} tl_post_stage_row;

extern const tl_post_stage_row tl_post_stage_rows[TL_POST_STAGE_COUNT];

/* What counts as an edge. A straight one is smoothed from the threshold on, and in full where what it makes
 * of kernels/edges.h's sum is twice that of the threshold; those of both attributes add up. */
typedef struct tl_edge_options {
    int normals, depth; /* 1: edges are looked for in it; both 0: the stage is off */
    /* rad, above 0 to pi, by which normals turn; 0: TL_DEFAULT_EDGE_ANGLE */
    float angle;
    /* the step in depth, as a share of a pixel's own, above 0 to 1; 0: TL_DEFAULT_EDGE_STEP */
    float step;
} tl_edge_options;

#define TL_DEFAULT_EDGE_ANGLE 0.5235987755982988f /* 30 degrees */
#define TL_MOST_EDGE_ANGLE 3.1415927f
#define TL_DEFAULT_EDGE_STEP 0.02f

/* What is bright scatters over what is around: kernels/bloom.h. */
typedef struct tl_bloom_options {
    float
        strength; /* what is added, as a share of what is over the threshold; 0: the stage is off */
    float threshold; /* radiance, of a pixel's largest number; 0: everything is bright */
    float knee; /* 0 to 1: half the width in which the threshold fades in, as a share of it */
    float
        width; /* px, the standard deviation of what a pixel becomes; 0: TL_DEFAULT_BLOOM_WIDTH */
    uint32_t
        side; /* blurred is a picture of 1/2 or 1/4 of the size; 0: TL_DEFAULT_BLOOM_SIDE */
} tl_bloom_options;

#define TL_DEFAULT_BLOOM_WIDTH 6.0f
#define TL_DEFAULT_BLOOM_SIDE 4
#define TL_DEFAULT_BLOOM_KNEE 0.5f
#define TL_MOST_BLOOM_STRENGTH 1000.0f
#define TL_MOST_BLOOM_THRESHOLD 1e30f

/* The widths that a picture of this size can be blurred by: 1.5 to 19 px at half, 3 to 39 at a quarter. */
double tl_least_bloom_width(uint32_t side);
double tl_most_bloom_width(uint32_t side);

/* What a picture of another size is made by: a weight by the distance from the middle of a pixel, in pixels
 * of the coarser of both pictures. Those that ring go below 0 beside what is much brighter. X(name, word on
 * the command line, where it ends, px, whether it rings, source) */
#define TL_FILTERS(X)                                                                   \
    X(TL_FILTER_MITCHELL, "mitchell", 2, 1, "Mitchell and Netravali 1988, B = C = 1/3") \
    X(TL_FILTER_BOX, "box", 0.5, 0, "the mean of the area that a pixel covers")         \
    X(TL_FILTER_TENT, "tent", 1, 0, "linear between pixels")                            \
    X(TL_FILTER_CATMULL_ROM, "catmull-rom", 2, 1,                                       \
      "Catmull and Rom 1974: the same as mitchell with B = 0, C = 1/2, sharper")        \
    X(TL_FILTER_LANCZOS3, "lanczos3", 3, 1,                                             \
      "Duchon 1979: a sinc in the window of its own "                                   \
      "middle lobe, the sharpest")

typedef enum tl_filter {
#define TL_FILTER_NAME(name, word, radius, rings, source) name,
    TL_FILTERS(TL_FILTER_NAME)
#undef TL_FILTER_NAME
        TL_FILTER_COUNT
} tl_filter;

/* All zero: every stage but `resolve`, which samples call for, is off. */
typedef struct tl_post_options {
    /* 1: pixels that are NaN or infinite are looked for. Lighting leaves none; a kernel of the user's may */
    int mend;
    tl_edge_options edges;
    tl_bloom_options bloom;
    /* px, 1 to TL_MAX_EXTENT each, of the picture that leaves; 0: as it is */
    uint32_t width, height;
    tl_filter filter; /* that it gets this size by */
} tl_post_options;

/* What a picture came to. */
typedef struct tl_post_counts {
    uint32_t stages;       /* that ran, bits 1 << tl_post_stage */
    uint64_t mended_count; /* pixels (samples) that were NaN or infinite */
    int is_bright;         /* 1: bloom has found something bright; else nothing was blurred */
    uint32_t
        band_count; /* the most parts that a stage ran in, to fit the memory limit; 0: none ran */
    uint64_t device_bytes;                 /* of the device's own buffers, at their largest */
    double device_ms[TL_POST_STAGE_COUNT]; /* from profiling events; 0 on the CPU paths */
} tl_post_counts;

/* Bytes per pixel that the stages which are asked for read and write at least, resolving left out: what they
 * take is no less than that over the bandwidth. has_no_colors: there are pixels to mend. */
double tl_post_bytes(const tl_post_options *options,
                     const tl_gbuffer *gbuffer,
                     int has_no_colors);

/* Holds programs, buffers and a second picture from picture to picture. */
typedef struct tl_post tl_post;

/* lighting: of it precision, path, vector_width and memory_limit say how stages are computed, as they do for
 * tl_lighting, which has refused what cannot be. device may be NULL if the precision needs none, and
 * outlives *out, which the caller releases with tl_post_destroy. Fails with TL_ERR_ARGUMENT (an option is
 * outside its range) or TL_ERR_MEMORY. */
tl_status tl_post_create(tl_device *device,
                         const tl_lighting_options *lighting,
                         const tl_post_options *options,
                         tl_post **out,
                         tl_error *err);

/* Other options from now on, for pictures to come. Fails with TL_ERR_ARGUMENT (one is outside its range; then
 * the options stay). */
tl_status tl_post_choose(tl_post *post, const tl_post_options *options, tl_error *err);

/* Accepts NULL. */
void tl_post_destroy(tl_post *post);

/* How many pixels of the G-buffer around one are read for it, at most, by all stages that a picture of it
 * has. */
uint32_t tl_post_halo(const tl_post *post, const tl_gbuffer *gbuffer);

/* Runs the stages over *image, the picture of the G-buffer with its layers blended; *image becomes what they
 * make of it: perhaps another picture, of another size where samples are resolved, which the caller owns in
 * place of the one that was given. Bits depend on precision alone: not on path, vectors, memory limit or
 * threads, and a device's float has those of TL_PRECISION_TWIN. Where nothing is called for, *image is left
 * as it is, and nothing is built, allocated or computed. timings, notices, counts may be NULL. Fails with
 * TL_ERR_ARGUMENT (one row is beyond the memory limit), TL_ERR_DEVICE or TL_ERR_MEMORY; *image is then a
 * picture of no meaning, still the caller's. */
tl_status tl_post_run(tl_post *post,
                      const tl_gbuffer *gbuffer,
                      tl_image **image,
                      tl_timings *timings,
                      const tl_notices *notices,
                      tl_post_counts *counts,
                      tl_error *err);

/* What tl_image_to_rgb8 gives of the picture, bit for bit, computed on the device where the precision is
 * TL_PRECISION_FLOAT and floats hold the exposure (within 100 stops), in bands within the memory limit, of a
 * row at least. rgb: [height][width][3]. timings, device_ms (from profiling events) may be NULL. Fails with
 * TL_ERR_DEVICE or TL_ERR_MEMORY. */
tl_status tl_post_codes(tl_post *post,
                        const tl_image *image,
                        float exposure,
                        tl_look look,
                        uint8_t *rgb,
                        tl_timings *timings,
                        double *device_ms,
                        tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
