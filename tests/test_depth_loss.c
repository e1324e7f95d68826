/* Is what depth loses within its bound, and does the textbook's form lose what kernels do not? */
#include "testing.h"

#include "depth_loss.h"
#include "layout.h"
#include "tilelight/error_bounds.h"

static const double u = 0x1p-24;

/* At an angle and off the origin, for positions in world space. */
static tl_camera a_camera(double near, double far)
{
    static const double eye[3] = {1, 2, 3}, target[3] = {2, 1.5, -4}, up[3] = {0, 1, 0};
    return tl_camera_look_at(eye, target, up, 1.0, 640, 480, near, far);
}

static const struct {
    double near, far;
} planes[] = {{0.1, 1000.0}, {0.01, 10000.0}, {1.0, 2.0}};

/* The largest of both ends and the middle: a bound grows with depth, and a bit where it passes a power of
 * two. */
static double bound_near(const tl_camera *camera, enum tl_layout_name layout, double depth)
{
    double most = 0.0;
    for (int i = 0; i <= 64; i++) {
        double at = fmin(depth * (1.0 + 0.1 * i / 64), (double)camera->far), bound[3];
        const double view[3] = {(double)camera->right * at, (double)camera->top * at, -at};
        tl_position_bound(camera, layout, view, bound);
        most = fmax(most, bound[2] / at);
    }
    return most;
}

static void losses_are_within_the_bound(void **state)
{
    (void)state;
    for (size_t p = 0; p < COUNT_OF(planes); p++) {
        const tl_camera camera = a_camera(planes[p].near, planes[p].far);
        for (int i = 0; i < TL_LAYOUT_COUNT; i++)
            for (double depth = (double)camera.near; depth < (double)camera.far; depth *= 3.7) {
                const enum tl_layout_name layout = (enum tl_layout_name)i;
                /* Its bound is one of each pixel's own: test_layout_round_trip asserts it. */
                if (tl_layouts[i].depth.code == TL_DEPTH_WORLD_POSITION)
                    continue;
                tl_depth_loss loss;
                tl_error err;
                ASSERT_OK(tl_depth_loss_find(&camera, layout, depth, &loss, &err), err);
                const double bound = bound_near(&camera, layout, depth);
                if (loss.stored + loss.read > bound * (1.0 + 1e-3))
                    fail_msg("%s at %g m of %g to %g: stored %g, read %g, bound %g",
                             tl_layout_word(layout), depth, planes[p].near, planes[p].far,
                             loss.stored, loss.read, bound);
            }
    }
}

/* 3u of the depth where a projection is read, 2u more from whole numbers: depth_code.h derives it. The
 * textbook's constants are as large as 1/near, and far away they nearly cancel: u depth/near is left. */
static void only_the_textbook_cancels(void **state)
{
    static const enum tl_layout_name forward[] = {TL_LAYOUT_FLOAT_FORWARD, TL_LAYOUT_FLOAT_NDC,
                                                  TL_LAYOUT_TUTORIAL_U24,
                                                  TL_LAYOUT_TUTORIAL_3X8};
    const tl_camera camera = a_camera(0.1, 1000.0);
    (void)state;
    for (size_t i = 0; i < COUNT_OF(forward); i++) {
        tl_depth_loss loss;
        tl_error err;
        ASSERT_OK(tl_depth_loss_find(&camera, forward[i], 900.0, &loss, &err), err);
        if (loss.read > 5.0 * u * 1.001 || loss.textbook < 0.1 * u * 900.0 / 0.1)
            fail_msg("%s: %g u read, %g u by the textbook", tl_layout_word(forward[i]),
                     loss.read / u, loss.textbook / u);
    }
    tl_depth_loss reversed;
    tl_error err;
    ASSERT_OK(tl_depth_loss_find(&camera, TL_LAYOUT_FLOAT_REVERSED, 900.0, &reversed, &err),
              err);
    assert_true(reversed.textbook <= 3.0 * u * 1.001);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(losses_are_within_the_bound),
        cmocka_unit_test(only_the_textbook_cancels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
