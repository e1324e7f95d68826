#include "bounds/sphere_families.h"

static const double pi = 3.14159265358979323846;

tl_camera tl_test_camera(double fov, double offset, uint32_t width, uint32_t height)
{
    const double tangent = tan(0.5 * fov * pi / 180.0);
    return (tl_camera){.projection = TL_PERSPECTIVE,
                       .width = width,
                       .height = height,
                       .left = (float)(tangent * (offset - 1.0)),
                       .right = (float)(tangent * (offset + 1.0)),
                       .bottom = (float)-tangent,
                       .top = (float)tangent,
                       .near = 0.1f,
                       .far = 100.0f,
                       .view_from_world = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

const tl_named_sphere tl_named_spheres[TL_NAMED_SPHERES] = {
    {"in front", {1, 2, -10}, 1},
    {"eye inside", {0.5f, 0, -0.5f}, 3},
    {"eye on the surface", {0, 0, -2}, 2},
    {"eye one ulp outside", {0, 0, -2}, 0x1.fffffep0f},
    {"eye one ulp outside, beside", {2, 0, 0}, 0x1.fffffep0f},
    {"eye one ulp outside, aslant", {0.6f, 0.8f, -2}, 0x1.1e377ap1f},
    {"eye one ulp outside, ahead", {0, 1, -2.55f}, 0x1.466664p1f},
    {"centre behind the eye", {1, 1, 2}, 5},
    {"centre behind, eye on the surface", {3.6f, 1.3f, 1.5f}, 3.9f},
    {"centre behind, eye outside", {3, 0.5f, 0.5f}, 2.9f},
    {"centre beside the eye", {3, 0, 0}, 2},
    {"centre beside, reaching in", {0.4f, 0, 0}, 0.3f},
    {"depth equal to the radius", {3, 1, -2}, 2},
    {"depth equal to the radius, eye outside", {-0.6f, 1, -1.9f}, 1.9f},
    {"minus depth equal to the radius", {3, 1, 2}, 2},
    {"touching near from behind", {0, 0, 0.9f}, 1},
    {"barely through near", {0.01f, 0, 0.9f}, 0x1.000002p0f},
    {"across near, centre in front", {0.3f, 0.1f, -0.3f}, 0.25f},
    {"tangent to far", {0, 0, -101}, 1},
    {"across far", {30, 0, -100}, 5},
    {"radius 0", {0.3f, 0.2f, -5}, 0},
    {"denormal radius", {0.3f, 0.2f, -5}, 1e-42f},
    {"tiny and far", {0.3f, 0.2f, -90}, 1e-5f},
    {"small and far", {17, -7.6666665f, -20}, 0.01f},
    {"everything tiny", {1e-30f, 0, -1e-30f}, 1e-30f},
    {"everything huge", {1e30f, 0, -1e30f}, 1e30f},
    {"the eye its centre", {0, 0, 0}, 1},
    {"the eye its centre, radius below near", {0, 0, 0}, 0.05f},
};

/* One image in ten is as small as can be along an axis, one as large. */
static uint32_t draw_extent(tl_draws *d)
{
    const double kind = draw(d, 0.0, 1.0);
    return kind < 0.1   ? 1u
           : kind < 0.2 ? (uint32_t)TL_MAX_EXTENT
                        : (uint32_t)draw_magnitude(d, 1.0, TL_MAX_EXTENT);
}

static tl_camera camera_of_field(tl_draws *d, double fov, double offset)
{
    const uint32_t width = draw_extent(d), height = draw_extent(d);
    return tl_test_camera(fov, offset, width, height);
}

static float next_above(float v, float low)
{
    return v > low ? v : nextafterf(low, INFINITY);
}

/* Every field of view, on the axis or off it, every image, every pair of planes; one in five with parallel
 * rays. */
static tl_camera draw_camera(tl_draws *d)
{
    const double fov = draw_magnitude(d, 0.01, 179.9);
    const double offset = draw_chance(d, 0.5) ? 0.0 : draw(d, -3.0, 3.0);
    tl_camera c = camera_of_field(d, fov, offset);
    const float aspect = (float)draw_magnitude(d, 0.1, 10.0);
    c.left *= aspect;
    c.right = next_above(c.right * aspect, c.left);
    c.near = (float)draw_magnitude(d, 1e-3, 1e3);
    c.far = draw_chance(d, 0.3)
                ? INFINITY
                : next_above(c.near * (float)draw_magnitude(d, 1.0, 1e6), c.near);
    if (draw_chance(d, 0.2)) {
        c.projection = TL_ORTHOGRAPHIC;
        c.near = draw_chance(d, 0.3) ? -c.near : c.near;
    }
    return c;
}

/* A depth between the planes, or near them where there is no far plane. */
static double depth_between(tl_draws *d, const tl_camera *c)
{
    const double near = (double)c->near, far = (double)c->far;
    if (isinf(c->far))
        return near + fabs(near) * draw_magnitude(d, 1e-6, 1e6);
    return near + (far - near) * draw_magnitude(d, 1e-6, 1.0);
}

/* A point of the image's plane at a depth, a little outside of the image too. */
static void place_in_view(tl_draws *d, tl_sphere_case *s, double depth)
{
    const tl_camera *c = &s->camera;
    const double unit = c->projection == TL_ORTHOGRAPHIC ? 1.0 : depth;
    const double width = (double)c->right - (double)c->left;
    const double height = (double)c->top - (double)c->bottom;
    s->center[0] = (float)(unit * ((double)c->left + width * draw(d, -0.2, 1.2)));
    s->center[1] = (float)(unit * ((double)c->bottom + height * draw(d, -0.2, 1.2)));
    s->center[2] = (float)-depth;
}

static void place_anywhere(tl_draws *d, tl_sphere_case *s, double low, double high)
{
    for (int i = 0; i < 3; i++)
        s->center[i] = draw_signed(d, low, high);
}

/* Of all that may be close to another: behind the eye, beside it, in view, out of it. */
static void place_around(tl_draws *d, tl_sphere_case *s)
{
    if (draw_chance(d, 0.5))
        place_in_view(d, s, depth_between(d, &s->camera));
    else
        place_anywhere(d, s, 1e-2, 1e4);
}

static double distance(const tl_sphere_case *s, int axis)
{
    return hypot((double)s->center[axis], (double)s->center[2]);
}

static tl_sphere_case with_camera(tl_draws *d)
{
    return (tl_sphere_case){.camera = draw_camera(d)};
}

static tl_sphere_case in_view(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const double depth = depth_between(d, &s.camera);
    place_in_view(d, &s, depth);
    s.radius = (float)(fabs(depth) * draw_magnitude(d, 1e-7, 2.0));
    return s;
}

static tl_sphere_case any_magnitudes(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    place_anywhere(d, &s, 1.5e-45, 3.4e38);
    s.radius = (float)draw_magnitude(d, 1.5e-45, 3.4e38);
    return s;
}

/* A scene that is 1e-30 to 1e30 times as large. */
static tl_sphere_case any_scale(tl_draws *d)
{
    tl_sphere_case s = in_view(d);
    const float scale = (float)draw_magnitude(d, 1e-27, 1e27);
    s.camera.near *= scale;
    s.camera.far = next_above(s.camera.far * scale, s.camera.near);
    for (int i = 0; i < 3; i++)
        s.center[i] *= scale;
    s.radius *= scale;
    if (s.camera.projection == TL_ORTHOGRAPHIC) {
        s.camera.left *= scale;
        s.camera.right = next_above(s.camera.right * scale, s.camera.left);
        s.camera.bottom *= scale;
        s.camera.top = next_above(s.camera.top * scale, s.camera.bottom);
    }
    return s;
}

static tl_sphere_case eye_inside(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    place_around(d, &s);
    s.radius =
        (float)(hypot(distance(&s, 0), (double)s.center[1]) * draw_magnitude(d, 1.0, 100.0));
    return s;
}

static tl_sphere_case eye_on_surface(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const int axis = draw_index(d, 2);
    place_around(d, &s);
    if (draw_chance(d, 0.3))
        s.center[axis] = 0.0f;
    s.radius = fabsf(draw_beside(d, distance(&s, axis), 2));
    return s;
}

/* How far the centre is from the ray of a slope; for parallel rays, from where it is. */
static double from_ray(const tl_sphere_case *s, int axis, double at)
{
    const double c = (double)s->center[axis], depth = -(double)s->center[2];
    return s->camera.projection == TL_ORTHOGRAPHIC ? fabs(c - at)
                                                   : fabs(c - at * depth) / hypot(1.0, at);
}

static tl_sphere_case tangent_to_side(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const int side = draw_index(d, 4);
    const float edges[] = {s.camera.left, s.camera.right, s.camera.bottom, s.camera.top};
    place_around(d, &s);
    s.radius = fabsf(draw_beside(d, from_ray(&s, side / 2, (double)edges[side]), 2));
    return s;
}

static tl_sphere_case tangent_to_near(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    place_around(d, &s);
    if (draw_chance(d, 0.5))
        s.center[2] = -s.camera.near + (float)draw_magnitude(d, 1e-6, 1e3);
    s.radius = fabsf(draw_beside(d, fabs(-(double)s.center[2] - (double)s.camera.near), 2));
    return s;
}

static tl_sphere_case tangent_to_far(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    if (isinf(s.camera.far))
        s.camera.far = 1e6f;
    place_in_view(d, &s, (double)s.camera.far * draw(d, 0.5, 2.0));
    s.radius = fabsf(draw_beside(d, fabs(-(double)s.center[2] - (double)s.camera.far), 2));
    return s;
}

static tl_sphere_case centre_behind(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    place_around(d, &s);
    s.center[2] = fabsf(s.center[2]);
    s.radius = (float)(((double)s.center[2] + fabs((double)s.camera.near)) *
                       draw_magnitude(d, 0.9, 100.0));
    return s;
}

static tl_sphere_case centre_beside(tl_draws *d)
{
    static const float depths[] = {0.0f, -0.0f, 1e-45f, -1e-45f, 1e-38f, -1e-30f, 1e-10f};
    tl_sphere_case s = with_camera(d);
    place_around(d, &s);
    s.center[2] = depths[draw_index(d, 7)];
    s.radius = (float)(fabs((double)s.camera.near) * draw_magnitude(d, 0.5, 1e4));
    return s;
}

static tl_sphere_case depth_is_radius(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    place_around(d, &s);
    s.radius = fabsf(draw_beside(d, (double)s.center[2], 1));
    const float beside = draw_chance(d, 0.5) ? s.radius : -s.radius;
    if (draw_chance(d, 0.2)) /* an axis, too */
        s.center[draw_index(d, 2)] = beside;
    return s;
}

static tl_sphere_case no_radius(tl_draws *d)
{
    static const float radii[] = {0.0f, 1e-45f, 1e-42f, 1.17549421e-38f, 1e-37f, 1e-30f};
    tl_sphere_case s = in_view(d);
    s.radius = radii[draw_index(d, 6)];
    if (draw_chance(d, 0.1)) /* on the near plane */
        s.center[2] = -s.camera.near;
    return s;
}

/* The slope of a pixel's centre, or of the border between two. */
static double slope_in_image(tl_draws *d, const tl_camera *c, int axis)
{
    const int count = (int)(axis ? c->height : c->width);
    const double begin = (double)(axis ? c->top : c->left);
    const double end = (double)(axis ? c->bottom : c->right);
    const double half = draw_chance(d, 0.7) ? 0.5 : 0.0;
    return begin + (draw_index(d, count) + half) * (end - begin) / count;
}

static tl_sphere_case tangent_to_pixel(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const int axis = draw_index(d, 2);
    place_around(d, &s);
    s.radius = fabsf(draw_beside(d, from_ray(&s, axis, slope_in_image(d, &s.camera, axis)), 2));
    return s;
}

/* Where its surface crosses the near or the far plane, there is the centre of a pixel. */
static tl_sphere_case crossing_at_pixel(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const int axis = draw_index(d, 2);
    const double plane =
        (double)(isinf(s.camera.far) || draw_chance(d, 0.5) ? s.camera.near : s.camera.far);
    const double unit = s.camera.projection == TL_ORTHOGRAPHIC ? 1.0 : plane;
    place_around(d, &s);
    s.radius =
        draw_beside(d,
                    hypot(slope_in_image(d, &s.camera, axis) * unit - (double)s.center[axis],
                          plane + (double)s.center[2]),
                    2);
    return s;
}

/* The tangent's point is on the near plane or on the far plane. */
static tl_sphere_case tangent_point_on_plane(tl_draws *d)
{
    tl_sphere_case s = in_view(d);
    const double c = (double)s.center[0], depth = -(double)s.center[2];
    const double away = hypot(c, depth);
    s.radius = (float)(away * draw_magnitude(d, 1e-6, 1.0));
    const double angle = atan2(c, depth) + (draw_chance(d, 0.5) ? 1.0 : -1.0) *
                                               asin(fmin((double)s.radius / away, 1.0));
    const double at =
        cos(angle) * sqrt(fmax(away * away - (double)s.radius * (double)s.radius, 0.0));
    if (!(at > 1e-30))
        return s;
    s.camera.near = fmaxf(draw_beside(d, at, 2), 1e-30f);
    s.camera.far = INFINITY;
    if (draw_chance(d, 0.5)) {
        s.camera.far = s.camera.near;
        s.camera.near *= (float)draw(d, 0.01, 0.99);
    }
    return s;
}

static tl_sphere_case narrow_fields(tl_draws *d)
{
    const double fov = draw(d, 0.01, 0.1), offset = draw(d, -2.0, 2.0);
    tl_sphere_case s = {.camera = camera_of_field(d, fov, offset)};
    place_in_view(d, &s, draw_magnitude(d, 0.05, 200.0));
    s.radius = (float)draw_magnitude(d, 1e-9, 10.0);
    return s;
}

static tl_sphere_case wide_fields(tl_draws *d)
{
    const double fov = draw(d, 170.0, 179.9), offset = draw(d, -0.5, 0.5);
    tl_sphere_case s = {.camera = camera_of_field(d, fov, offset)};
    s.camera.left *= 2.0f;
    s.camera.right *= 2.0f;
    place_in_view(d, &s, draw_magnitude(d, 0.05, 200.0));
    s.radius = (float)(distance(&s, 0) * draw_magnitude(d, 1e-6, 1.0));
    return s;
}

/* Windows of a large picture: the edges are close to each other and far from the view axis. */
static tl_sphere_case windows(tl_draws *d)
{
    const double fov = draw_magnitude(d, 0.01, 120.0), offset = draw_magnitude(d, 1.0, 1e5);
    const double sign = draw_chance(d, 0.5) ? 1.0 : -1.0;
    tl_sphere_case s = {.camera = camera_of_field(d, fov, sign * offset)};
    s.camera.right = next_above(s.camera.right, s.camera.left);
    place_in_view(d, &s, draw_magnitude(d, 0.05, 200.0));
    s.radius = (float)(distance(&s, 0) * draw_magnitude(d, 1e-9, 1.0));
    return s;
}

static tl_sphere_case parallel_rays(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    const float size = (float)draw_magnitude(d, 1e-3, 1e3);
    s.camera.projection = TL_ORTHOGRAPHIC;
    s.camera.near *= draw_chance(d, 0.5) ? -1.0f : 1.0f;
    s.camera.left *= size;
    s.camera.right = next_above(s.camera.right * size, s.camera.left);
    place_around(d, &s);
    s.radius = (float)draw_magnitude(d, 1e-6, 1e4);
    return s;
}

static tl_sphere_case least_images(tl_draws *d)
{
    tl_sphere_case s = in_view(d);
    s.camera.width = 1u + (uint32_t)draw_index(d, 3);
    s.camera.height = 1u + (uint32_t)draw_index(d, 3);
    return s;
}

static tl_sphere_case largest_images(tl_draws *d)
{
    tl_sphere_case s = in_view(d);
    s.camera.width = s.camera.height = TL_MAX_EXTENT;
    return s;
}

/* All that cancels at the near plane, which is next to the eye as seen from the sphere: the eye on its
 * surface, and where it crosses the plane in the image. */
static tl_sphere_case near_at_eye(tl_draws *d)
{
    tl_sphere_case s = with_camera(d);
    s.camera.projection = TL_PERSPECTIVE;
    s.camera.near = (float)draw_magnitude(d, 1e-30, 1e-3);
    s.camera.far = INFINITY;
    const double depth = (double)(float)draw_magnitude(d, 1e-2, 1e2);
    const double near = (double)s.camera.near;
    const double m = slope_in_image(d, &s.camera, 0);
    s.center[2] = (float)-depth;
    s.center[1] = draw_signed(d, 1e-20, 1e2);
    s.radius = (float)depth;
    /* (m near - c)^2 + (near - depth)^2 = depth^2 */
    s.center[0] =
        draw_beside(d, m * near - sqrt(fmax(2.0 * depth * near - near * near, 0.0)), 2);
    if (draw_chance(d, 0.5)) {
        s.center[0] = (float)(depth * draw_magnitude(d, 1e-3, 1e3));
        s.radius = draw_beside(d, hypot((double)s.center[0] - m * near, depth - near), 2);
    }
    return s;
}

static tl_sphere_case named_about(tl_draws *d)
{
    static const double fovs[] = {0.01, 1, 60, 90, 120, 179.9}, offsets[] = {0, 0.3, -1, -2};
    static const uint32_t extents[] = {1, 3, 1080, 1920, TL_MAX_EXTENT};
    const tl_named_sphere *named = &tl_named_spheres[draw_index(d, TL_NAMED_SPHERES)];
    const double fov = fovs[draw_index(d, 6)], offset = offsets[draw_index(d, 4)];
    const uint32_t width = extents[draw_index(d, 5)], height = extents[draw_index(d, 5)];
    tl_sphere_case s = {.camera = tl_test_camera(fov, offset, width, height)};
    s.camera.projection = draw_chance(d, 0.2) ? TL_ORTHOGRAPHIC : TL_PERSPECTIVE;
    for (int i = 0; i < 3; i++)
        s.center[i] = draw_beside(d, (double)named->center[i], 2);
    s.radius = fabsf(draw_beside(d, (double)named->radius, 2));
    return s;
}

const tl_sphere_family tl_sphere_families[TL_SPHERE_FAMILIES] = {
    {"in view", in_view},
    {"all magnitudes, 1.5e-45 to 3.4e38 m", any_magnitudes},
    {"scenes of every scale, 1e-30 to 1e30", any_scale},
    {"eye inside", eye_inside},
    {"eye on the surface, 2 ulps about", eye_on_surface},
    {"tangent to a side of the image, 2 ulps about", tangent_to_side},
    {"tangent to near, 2 ulps about", tangent_to_near},
    {"tangent to far, 2 ulps about", tangent_to_far},
    {"tangent to a pixel's ray, 2 ulps about", tangent_to_pixel},
    {"crossing near or far at a pixel's ray", crossing_at_pixel},
    {"tangent's point on near or far", tangent_point_on_plane},
    {"centre behind the eye", centre_behind},
    {"centre beside the eye", centre_beside},
    {"depth equal to the radius, an ulp about", depth_is_radius},
    {"radius 0 or next to it", no_radius},
    {"fields of view of 0.01 to 0.1 degrees", narrow_fields},
    {"fields of view of 170 to 179.9 degrees", wide_fields},
    {"windows far off the view axis", windows},
    {"parallel rays", parallel_rays},
    {"images of 1 to 3 px", least_images},
    {"images of 16384 px", largest_images},
    {"near plane next to the eye", near_at_eye},
    {"named cases, 2 ulps about", named_about},
};
