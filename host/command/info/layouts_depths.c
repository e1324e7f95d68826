/* `tilelight layouts --depth`. */
#include "depth_loss.h"
#include "json_values.h"
#include "layout.h"
#include "layouts.h"
#include "try.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

static const double depths[] = {0.1, 1.0, 10.0, 100.0, 900.0}; /* m, of layouts_camera() */
enum { DEPTH_COUNT = sizeof depths / sizeof depths[0] };

static const struct {
    const char *key, *word;
    size_t offset; /* of a double in tl_depth_loss */
} losses[] = {
    {"stored", "stored", offsetof(tl_depth_loss, stored)},
    {"read", "read", offsetof(tl_depth_loss, read)},
    {"textbook", "by textbook", offsetof(tl_depth_loss, textbook)},
};
enum { LOSS_COUNT = sizeof losses / sizeof losses[0] };

static double loss_of(const tl_depth_loss *loss, int index)
{
    return *(const double *)(const void *)((const char *)loss + losses[index].offset);
}

static bool same_depth(const tl_layout *a, const tl_layout *b)
{
    return a->depth.code == b->depth.code &&
           a->depth.channels[0].number == b->depth.channels[0].number &&
           a->depth.channels[0].bits == b->depth.channels[0].bits;
}

/* Whether no layout before it stores depth in this way. */
static bool is_first(int layout)
{
    for (int i = 0; i < layout; i++)
        if (same_depth(&tl_layouts[i], &tl_layouts[layout]))
            return false;
    return true;
}

static tl_status find_all(enum tl_layout_name layout,
                          tl_depth_loss found[DEPTH_COUNT],
                          tl_error *err)
{
    const tl_camera camera = layouts_camera();
    tl_status status = TL_OK;
    for (int d = 0; d < DEPTH_COUNT; d++)
        TRY(tl_depth_loss_find(&camera, layout, fmax(depths[d], (double)camera.near), &found[d],
                               err));
done:
    return status;
}

static void print_loss(double loss)
{
    if (loss > 0.0)
        printf(" %9.1e", loss);
    else
        printf(" %9s", "exact");
}

static tl_status print_losses(enum tl_layout_name layout, tl_error *err)
{
    tl_depth_loss found[DEPTH_COUNT];
    const tl_status status = find_all(layout, found, err);
    for (int l = 0; status == TL_OK && l < LOSS_COUNT; l++) {
        if (isnan(loss_of(&found[0], l)))
            continue;
        printf("%-18s %-12s", l == 0 ? tl_layout_word(layout) : "", losses[l].word);
        for (int d = 0; d < DEPTH_COUNT; d++)
            print_loss(loss_of(&found[d], l));
        putchar('\n');
    }
    return status;
}

tl_status depths_print(tl_error *err)
{
    const tl_camera camera = layouts_camera();
    tl_status status = TL_OK;
    printf(
        "The largest relative errors of depth in each 10 %% from a distance on; near %g m, far "
        "%g m. A layout for\neach way to store it.\n\n%-31s",
        (double)camera.near, (double)camera.far, "");
    for (int d = 0; d < DEPTH_COUNT; d++)
        printf(" %7g m", depths[d]);
    putchar('\n');
    for (int i = 0; i < TL_LAYOUT_COUNT; i++)
        if (is_first(i))
            TRY(print_losses((enum tl_layout_name)i, err));
    puts("\nstored: what the number says, computed exactly. read: what kernels make of it in "
         "float, beside\ncomputing it exactly. by textbook: the same by 1 / (d/P34 + P33/P34), "
         "one fma and one division.");
done:
    return status;
}

static tl_status losses_json(enum tl_layout_name layout, json_t *rows, tl_error *err)
{
    tl_depth_loss found[DEPTH_COUNT];
    json_t *row = NULL;
    const tl_status status = find_all(layout, found, err);
    if (status != TL_OK)
        return status;
    row = json_pack("{ss}", "layout", tl_layout_word(layout));
    for (int l = 0; l < LOSS_COUNT; l++) {
        json_t *values = json_array();
        for (int d = 0; d < DEPTH_COUNT; d++)
            json_array_append_new(values, tl_json_number(loss_of(&found[d], l)));
        json_object_set_new(row, losses[l].key, values);
    }
    json_array_append_new(rows, row);
    return TL_OK;
}

tl_status depths_json(json_t **out, tl_error *err)
{
    tl_status status = TL_OK;
    json_t *rows = json_array(), *metres = json_array();
    for (int d = 0; d < DEPTH_COUNT; d++)
        json_array_append_new(metres, json_real(depths[d]));
    for (int i = 0; i < TL_LAYOUT_COUNT; i++)
        if (is_first(i))
            TRY(losses_json((enum tl_layout_name)i, rows, err));
    *out = json_pack("{sO sO}", "depths_m", metres, "relative_errors", rows);
done:
    json_decref(metres);
    json_decref(rows);
    return status;
}
