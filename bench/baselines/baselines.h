/* Other ways to light the same frame: the yardsticks of the bench.
 *
 * A family, one const struct each; the bench and the tests loop over the table. Each lights the
 * frames that tl_lighting_run lights, to within its tolerance. */
#ifndef TL_BASELINES_H
#define TL_BASELINES_H

#include "tilelight/lighting.h"

/* What a baseline is created for. Everything is borrowed, and kept until destroy. */
typedef struct tl_baseline_input {
    tl_device *device;         /* for the baselines that need one, else NULL */
    const tl_gbuffer *gbuffer; /* repaired */
    const tl_light_set *lights;
} tl_baseline_input;

typedef struct tl_baseline {
    const char *name;    /* a word: a column of tables, a key of JSON */
    const char *meaning; /* what it is, a sentence */
    const char *source;  /* whose method it is */
    int needs_device;
    /* How far a frame may be from the double reference: RMS and largest difference, over the
     * frame's mean radiance. The file of each derives or states it. */
    double rms_tolerance, max_tolerance;

    /* Makes ready for this frame whatever is done once (threads' memory, compiled programs,
     * uploaded textures), so that a run is warm. The caller releases *state with destroy. Fails
     * with TL_ERR_MEMORY, TL_ERR_DEVICE, or TL_ERR_UNSUPPORTED for a frame that the method
     * cannot light, saying why. */
    tl_status (*create)(const tl_baseline_input *input, void **state, tl_error *err);

    /* Lights the frame: *image, of the G-buffer's size, is written in full. Adds the stages'
     * times to timings (may be NULL); their sum is what the frame cost. */
    tl_status (*run)(void *state, tl_image *image, tl_timings *timings, tl_error *err);

    void (*destroy)(void *state); /* accepts NULL */
} tl_baseline;

/* [tl_baseline_count] */
extern const tl_baseline *const tl_baselines[];
extern const int tl_baseline_count;

/* NULL where none has that name. */
const tl_baseline *tl_baseline_find(const char *name);

/* The instruction set that `hand` and `hand_relaxed` run with here: "avx512", "avx2" or
 * "portable". */
const char *tl_hand_instruction_set(void);

#endif
