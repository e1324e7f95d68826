/* A script for sbatch. Its last task is the gather, so one file is all that is submitted. */
#include "farm_schedulers.h"
#include "farm_shell.h"

#include <inttypes.h>

static void print_use(const tl_farm_plan *plan, FILE *out)
{
    char size[48];
    tl_farm_size(plan, size);
    fprintf(out,
            "#!/bin/bash\n"
            "# %s, by Slurm. With this in FILE:\n"
            "#\n"
            "#   job=$(sbatch --parsable FILE)\n"
            "#   sbatch --array=%zu --dependency=afterany:$job FILE\n"
            "#\n"
            "# The second line is the gather: it waits for all workers, however they end, does "
            "what is\n"
            "# missing, and ends with the list of failures, with status 1 if there are any.\n",
            size, plan->chunk_count);
    tl_farm_print_advice(out, "# ");
}

/* sbatch reads its options up to the first command. What stands on its own command line goes before them. */
static void print_options(const tl_farm_plan *plan, FILE *out)
{
    const tl_farm_needs *needs = &plan->needs;
    fprintf(out, "#SBATCH --job-name=tilelight\n#SBATCH --array=0-%zu\n",
            plan->chunk_count - 1);
    if (needs->processors > 0)
        fprintf(out, "#SBATCH --cpus-per-task=%" PRIu32 "\n", needs->processors);
    if (needs->memory_mib > 0)
        fprintf(out, "#SBATCH --mem=%" PRIu64 "M\n", needs->memory_mib);
    if (needs->seconds > 0)
        fprintf(out, "#SBATCH --time=%" PRIu64 ":%02" PRIu64 "\n", needs->seconds / 60,
                needs->seconds % 60);
    if (needs->partition)
        fprintf(out, "#SBATCH --partition=%s\n", needs->partition);
}

tl_status tl_farm_print_slurm(const tl_farm_plan *plan, FILE *out, tl_error *err)
{
    (void)err;
    print_use(plan, out);
    print_options(plan, out);
    fputs("chunks=(\n", out);
    for (size_t i = 0; i < plan->chunk_count; i++)
        fprintf(out, "    %s\n", plan->chunks[i]);
    fprintf(out, "    %s # the gather\n)\n", plan->gather);
    tl_farm_print_worker(out, plan);
    fputs("light \"${chunks[SLURM_ARRAY_TASK_ID]}\"\n", out);
    return TL_OK;
}
