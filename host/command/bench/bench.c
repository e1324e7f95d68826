/* tilelight bench: how fast frames are lit. */
#include "baselines.h"
#include "bench_session.h"
#include "commands.h"
#include "console.h"
#include "effect_frames.h"
#include "try.h"

#include <stdio.h>

static void list_axes(void)
{
    puts("Axes:");
    for (int i = 0; i < TL_AXIS_COUNT; i++)
        printf("  --%-11s %s (default %s)\n", tl_bench_axes[i].name, tl_bench_axes[i].meaning,
               tl_bench_axes[i].usual);
}

static void list_sets(void)
{
    puts("\nSets of cases, for --case; (+): run only where it is named:");
    for (int i = 0; i < tl_bench_set_count; i++) {
        printf("  %-9s %-3s %s:", tl_bench_sets[i].name,
               tl_bench_sets[i].only_if_named ? "(+)" : "", tl_bench_sets[i].meaning);
        for (int axis = 0; axis < TL_AXIS_COUNT; axis++)
            if (tl_bench_sets[i].lists.of[axis])
                printf(" --%s %s", tl_bench_axes[axis].name, tl_bench_sets[i].lists.of[axis]);
        putchar('\n');
    }
}

static void list_scenes_and_baselines(void)
{
    puts("\nScenes, for --scene:");
    for (int i = 0; i < tl_bench_scene_count; i++)
        printf("  %-13s %s\n", tl_bench_scenes[i].name, tl_bench_scenes[i].meaning);
    puts("\nMaterials, for --material:");
    for (int i = 0; i < tl_bench_material_count; i++)
        printf("  %-13s %s\n", tl_bench_materials[i].name, tl_bench_materials[i].meaning);
    puts("\nOther ways to light a frame, for --baselines:");
    for (int i = 0; i < tl_baseline_count; i++)
        printf("  %-13s %s (%s)\n", tl_baselines[i]->name, tl_baselines[i]->meaning,
               tl_baselines[i]->source);
}

static void list_effect_frames(void)
{
    puts("\nFrames of --effects, from the plainest to the richest:");
    for (int i = 0; i < tl_effect_frame_count; i++)
        printf("  %-15s %s\n", tl_effect_frame_about(i).name, tl_effect_frame_about(i).meaning);
    puts("\nEffects of --effects that no tile uses:");
    for (int i = 0; i < tl_unused_effect_count; i++)
        printf("  %-15s %s\n", tl_unused_effect_about(i).name,
               tl_unused_effect_about(i).meaning);
}

static tl_status (*const modes[])(bench_session *session, tl_error *err) = {
    [BENCH_CASES] = bench_run_cases,     [BENCH_BASELINES] = bench_run_baselines,
    [BENCH_BATCH] = bench_run_batch,     [BENCH_GROWTH] = bench_run_growth,
    [BENCH_STARTUP] = bench_run_startup, [BENCH_EFFECTS] = bench_run_effects,
    [BENCH_SKY] = bench_run_sky,         [BENCH_KERNEL] = bench_run_kernel,
};

static tl_status run(bench_session *session, const bench_options *options, tl_error *err)
{
    tl_status status = TL_OK;
    if (options->mode == BENCH_LIST) {
        list_axes();
        list_sets();
        list_scenes_and_baselines();
        list_effect_frames();
        goto done;
    }
    TRY(bench_session_begin(session, options, err));
    TRY(modes[options->mode](session, err));
done:
    return status;
}

int command_bench(int argc, char **argv)
{
    bench_options options = bench_options_default();
    bench_session session = {0};
    tl_error err;
    bench_parse(argc, argv, &options);
    const tl_status status = run(&session, &options, &err);
    bench_session_end(&session);
    return console_finish(status, &err);
}
