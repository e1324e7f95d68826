/* A program's tie to its entry in the cache (program_cache.h): taken from there if it is there, put
 * there once the program has run.
 *
 * Once it has run, because drivers compile a second time at the first launch, for what they
 * specialise launches by: PoCL for the work-group size, and for grids below 2^16 items. So an entry
 * also says which launches its binary is ready for, and a process that needed others adds them. */
#ifndef TL_PROGRAM_KEEPER_H
#define TL_PROGRAM_KEEPER_H

#include "device.h"
#include "program_cache.h"

/* What a driver may have compiled one kernel for. */
typedef struct tl_launch_shape {
    uint32_t kernel;   /* in the order of TL_KERNELS */
    uint32_t group;    /* work-items per group */
    uint32_t is_large; /* 1: 2^16 work-items or more */
} tl_launch_shape;

enum { TL_MAX_LAUNCH_SHAPES = 32 }; /* further ones are compiled in every process */

/* All zero is a keeper that keeps nothing. */
typedef struct tl_keeper {
    char *folder; /* owned; NULL: no caching */
    char *key;    /* owned, [key_size] */
    size_t key_size;
    int lock;                    /* held while this process makes the entry; -1: not held */
    int is_loaded;               /* 1: the program came from the entry */
    int shape_count, kept_count; /* shapes so far; of these, in the entry */
    tl_launch_shape shapes[TL_MAX_LAUNCH_SHAPES];
} tl_keeper;

/* For a program of these texts. Cannot fail: it then keeps nothing. */
void tl_keeper_begin(tl_keeper *keeper,
                     const tl_device *device,
                     const char *const *texts,
                     size_t text_count,
                     const char *flags);

/* The program from its entry, built; NULL where there is none, or none that the driver takes. If
 * another process is making the entry, waits for that, within limits. After NULL, this process makes
 * it: others wait until tl_keeper_keep or tl_keeper_release. The caller releases the program. */
cl_program tl_keeper_load(tl_keeper *keeper, const tl_device *device, const char *flags);

/* What tl_keeper_load gave is unfit: it counts as nothing. */
void tl_keeper_reject(tl_keeper *keeper);

/* To be called for every launch. */
void tl_keeper_note_launch(tl_keeper *keeper, uint32_t kernel, size_t items, size_t group);

/* Whether there were launches that the entry is not ready for. */
int tl_keeper_has_news(const tl_keeper *keeper);

/* Puts the program, built from source, into the entry, and lets others go on. NULL: only the
 * latter. */
void tl_keeper_keep(tl_keeper *keeper, cl_program program);

/* Lets others go on. Leaves it all zero. */
void tl_keeper_release(tl_keeper *keeper);

#endif
