/* What a study lights: a frame and its lights. */
#ifndef TL_STUDY_FRAME_H
#define TL_STUDY_FRAME_H

#include "tilelight/gbuffer.h"
#include "tilelight/lights.h"

/* All zero is empty. */
typedef struct tl_study_frame {
    char name[64];       /* of its own among those of a study, fit for the name of a file */
    const char *source;  /* where it is from, for people; borrowed */
    tl_gbuffer *gbuffer; /* in full float, through tl_gbuffer_repair */
    tl_light_set lights;
} tl_study_frame;

/* Frames that are computed: no files, the same on every machine. */
typedef struct tl_study_built_in {
    const char *name, *meaning;
    const char *scene, *material; /* of the bench */
    uint32_t light_count;
    double lights_per_tile; /* sets their range */
    int is_endless; /* 1: they have no range, and fall off with the square of the distance */
} tl_study_built_in;
extern const tl_study_built_in tl_study_built_ins[];
extern const int tl_study_built_in_count;

/* Fails with TL_ERR_ARGUMENT (sizes out of range) or TL_ERR_MEMORY. */
tl_status tl_study_built_in_make(const tl_study_built_in *row,
                                 uint32_t width,
                                 uint32_t height,
                                 tl_study_frame *out,
                                 tl_error *err);

enum { TL_STUDY_IDENTITY_SIZE = 33 };

/* Of pixels, camera and lights: two frames with one identity are the same. Fails with TL_ERR_MEMORY. */
tl_status tl_study_frame_identify(const tl_study_frame *frame,
                                  char text[TL_STUDY_IDENTITY_SIZE],
                                  tl_error *err);

/* Leaves it empty. */
void tl_study_frame_clear(tl_study_frame *frame);

#endif
