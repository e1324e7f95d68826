/* A script around GNU parallel. File names are in a function that parallel never reads, so none of them can
 * be taken for one of its replacement strings. */
#include "farm_schedulers.h"
#include "farm_shell.h"

#include <inttypes.h>

static void print_use(const tl_farm_plan *plan, FILE *out)
{
    char size[48];
    tl_farm_size(plan, size);
    fprintf(out,
            "#!/bin/bash\n"
            "# %s, by GNU parallel. With this in FILE:\n"
            "#\n"
            "#   bash FILE                             here, one worker at a time\n"
            "#   bash FILE --jobs 2                    two of them\n"
            "#   bash FILE --sshlogin alpha,beta,:     one on each machine, and one here\n"
            "#\n"
            "# The gather behind does what is missing, and ends with the list of failures, "
            "with status\n"
            "# 1 if there are any. tilelight-farm.log, where it was started, says how each "
            "worker ended.\n",
            size);
    tl_farm_print_advice(out, "# ");
}

tl_status tl_farm_print_parallel(const tl_farm_plan *plan, FILE *out, tl_error *err)
{
    (void)err;
    print_use(plan, out);
    tl_farm_print_worker(out, plan);
    fputs("export -f light\n"
          "# Functions are read by the shell that parallel starts.\n"
          "export PARALLEL_SHELL=$BASH\n"
          "parallel --jobs 1 --retries 3 --joblog tilelight-farm.log --env light",
          out);
    if (plan->needs.memory_mib > 0)
        fprintf(out, " --memfree %" PRIu64 "M", plan->needs.memory_mib);
    if (plan->needs.seconds > 0)
        fprintf(out, " --timeout %" PRIu64, plan->needs.seconds);
    fputs(" \"$@\" light <<'END'\n", out);
    for (size_t i = 0; i < plan->chunk_count; i++)
        fprintf(out, "%s\n", plan->chunks[i]);
    fprintf(out, "END\nlight %s\n", plan->gather);
    return TL_OK;
}
