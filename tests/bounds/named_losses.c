#include "bounds/named_losses.h"

#include "bounds/textbook.h"

static uint64_t lost_by(const tl_sphere_case *of, tl_pixel_rect rect)
{
    return tl_judge_sphere(of, &rect).lost_px;
}

tl_named_loss tl_lose_named(const tl_named_sphere *named)
{
    tl_sphere_case of = {.camera = tl_test_camera(60.0, 0.0, 1920, 1080),
                         .center = {named->center[0], named->center[1], named->center[2]},
                         .radius = named->radius};
    const tl_pixel_rect none = {0, 0, 0, 0};
    tl_pixel_rect ours;
    of.camera.right = of.camera.top * 16.0f / 9.0f;
    of.camera.left = -of.camera.right;
    tl_sphere_bounds(&of.camera, of.center, of.radius, &ours);
    return (tl_named_loss){.seen = tl_judge_sphere(&of, &none).seen_px,
                           .listing_16 = lost_by(&of, tl_listing_16(&of)),
                           .mara_mcguire = lost_by(&of, tl_mara_mcguire(&of)),
                           .ours = lost_by(&of, ours)};
}
