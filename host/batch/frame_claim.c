#include "frame_claim.h"

#include "held_name.h"
#include "try.h"

#include <stdlib.h>

/* Every output's name is held: until the last of them is in place, some are, and no other takes them all. */
struct tl_frame_claim {
    size_t count; /* that are held */
    tl_held_name names[];
};

tl_status tl_frame_claim_take(char *const *outputs,
                              size_t count,
                              tl_frame_claim **out,
                              tl_error *err)
{
    tl_status status = TL_OK;
    bool is_held = true;
    tl_frame_claim *made = calloc(1, sizeof *made + count * sizeof *made->names);
    if (!made)
        TRY(tl_fail(err, TL_ERR_MEMORY, "%s: out of memory", outputs[0]));
    while (is_held && made->count < count) {
        TRY(tl_held_name_take(outputs[made->count], &made->names[made->count], &is_held, err));
        made->count += is_held;
    }
    *out = NULL;
    if (is_held) {
        *out = made;
        made = NULL;
    }
done:
    tl_frame_claim_end(made);
    return status;
}

void tl_frame_claim_end(tl_frame_claim *claim)
{
    if (!claim)
        return;
    for (size_t i = 0; i < claim->count; i++)
        tl_held_name_drop(&claim->names[i]);
    free(claim);
}

void tl_frame_claim_sweep(char *const *outputs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        tl_held_name name;
        bool is_held = false;
        if (tl_held_name_is_there(outputs[i]) &&
            tl_held_name_take(outputs[i], &name, &is_held, NULL) == TL_OK && is_held)
            tl_held_name_drop(&name);
    }
}
