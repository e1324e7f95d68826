#include "study_claims.h"

#include <math.h>

static void print_figure(FILE *out, const tl_claim_figure *f)
{
    char theirs[64] = "-", ours[96];
    if (f->theirs[0] == f->theirs[1])
        snprintf(theirs, sizeof theirs, "%.3g", f->theirs[0]);
    else if (!isnan(f->theirs[0]))
        snprintf(theirs, sizeof theirs, "%.3g to %.3g", f->theirs[0], f->theirs[1]);
    if (f->low < f->high)
        snprintf(ours, sizeof ours, "%.3g (%.3g to %.3g)", f->ours, f->low, f->high);
    else
        snprintf(ours, sizeof ours, "%.3g", f->ours);
    fprintf(out, "  %-58s %10s  %-24s %s\n", f->what, theirs, ours, f->unit);
}

void study_print_claims(FILE *out, const tl_study *study)
{
    for (int i = 0; i < TL_CLAIM_COUNT; i++) {
        if (study->claims[i].count == 0)
            continue;
        fprintf(out, "\n%s (%s):\n  %-58s %10s  %s\n", tl_claims[i].claim, tl_claims[i].source,
                "", "theirs", "ours");
        for (size_t k = 0; k < study->claims[i].count; k++)
            print_figure(out, &study->claims[i].of[k]);
    }
}
