#include "claims.h"

#include "depth_loss.h"
#include "tilelight/layouts.h"
#include "try.h"

#include <math.h>

const tl_position_operations tl_position_operations_of[TL_POSITION_OPERATION_ROWS] = {
    {"forward", {1, 0, 1, 1}, {1, 2, 3, 1}},
    {"ndc", {0, 0, 2, 1}, {0, 2, 4, 1}},
    {"reversed", {0, 0, 1, 1}, {0, 2, 3, 1}},
    {"metres", {0, 0, 0, 0}, {0, 2, 2, 0}},
};

/* Looking along -z from the origin, a right angle wide. */
static tl_camera camera_to(double far)
{
    static const double eye[3] = {0.0, 0.0, 0.0}, target[3] = {0.0, 0.0, -1.0},
                        up[3] = {0.0, 1.0, 0.0};
    return tl_camera_look_at(eye, target, up, 1.5707963267948966, 64, 64, 0.1, far);
}

tl_status tl_claim_operations(const tl_claim_options *options,
                              tl_claim_figures *out,
                              tl_error *err)
{
    static const double depths[] = {1.0, 10.0, 100.0, 900.0}; /* m */
    static const char *const words[4] = {"additions", "multiplications", "multiply-adds",
                                         "divisions"};
    static const double theirs[4] = {0.0, 0.0, 1.0, 1.0};
    const tl_camera camera = camera_to(1000.0);
    const tl_position_operations *forward = &tl_position_operations_of[0],
                                 *reversed = &tl_position_operations_of[2];
    tl_claim_figures made = {.count = 0};
    tl_status status = TL_OK;
    (void)options;
    for (int i = 0; i < 4; i++)
        tl_claim_add(&made, "a pixel", theirs[i], theirs[i], forward->of_depth[i],
                     "%s of depth, stored forward", words[i]);
    for (int i = 0; i < 4; i++)
        tl_claim_add(&made, "a pixel", theirs[i], theirs[i], reversed->of_depth[i],
                     "%s of depth, stored reversed", words[i]);
    for (int i = 0; i < 4; i++)
        tl_claim_add(&made, "a pixel", (double)NAN, (double)NAN,
                     reversed->of_position[i] - reversed->of_depth[i],
                     "%s of ray and position beside that", words[i]);
    for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
        tl_depth_loss loss;
        TRY(tl_depth_loss_find(&camera, TL_LAYOUT_FLOAT_FORWARD, depths[i], &loss, err));
        tl_claim_add(&made, "of depth", loss.textbook, loss.textbook, loss.read,
                     "largest error at %g m of either form", depths[i]);
    }
    *out = made;
done:
    return status;
}

tl_status tl_claim_half_positions(const tl_claim_options *options,
                                  tl_claim_figures *out,
                                  tl_error *err)
{
    static const double depths[] = {1.0, 10.0, 100.0, 1000.0, 10000.0}; /* m */
    static const struct {
        enum tl_layout_name layout;
        const char *what;
    } ways[] = {{TL_LAYOUT_SHADERX2_128, "positions in 3 x 16-bit float"},
                {TL_LAYOUT_TUTORIAL_U24, "depth buffer of 24 bits"},
                {TL_LAYOUT_FLOAT_REVERSED, "reversed depth buffer of 32-bit float"}};
    const tl_camera camera = camera_to(20000.0);
    tl_claim_figures made = {.count = 0};
    tl_status status = TL_OK;
    (void)options;
    for (size_t way = 0; way < sizeof ways / sizeof ways[0]; way++)
        for (size_t i = 0; i < sizeof depths / sizeof depths[0]; i++) {
            tl_depth_loss loss;
            TRY(tl_depth_loss_find(&camera, ways[way].layout, depths[i], &loss, err));
            tl_claim_add(&made, "m", (double)NAN, (double)NAN, loss.stored * depths[i],
                         "error at %g m: %s", depths[i], ways[way].what);
        }
    *out = made;
done:
    return status;
}
