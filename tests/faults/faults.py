"""Faults that are planted, one at a time, and the test that has to catch each.

A fault is a text that stands once in a file, and what takes its place. Where it does not stand there once any
more, planting fails, and so does the test faults_apply: the fault moves with the code.
"""
import collections

# what: what is wrong then. target, test: the program that has to fail, and its arguments.
Fault = collections.namedtuple("Fault", "name what file before after target arguments")


def hard(name):
    """A case of tests/hard/cases.c."""
    return "test_hard_cases", [name]


FAULTS = [
    # Intervals and rectangles.
    Fault("bounds-sign", "a sign of the tangent's slope is flipped", "kernels/sphere_bounds.h",
          "over = c * length + depth * r", "over = c * length - depth * r", *hard("small-rectangle")),
    Fault("bounds-eye", "a camera inside the sphere has a tangent all the same", "kernels/sphere_bounds.h",
          "if (!(power > 0.0) || !(tangent_depth >= near))", "if (!(tangent_depth >= near) && power > 0.0)",
          *hard("camera-inside")),
    Fault("bounds-near", "what ends behind the near plane counts by its centre", "kernels/sphere_bounds.h",
          "sign_of_sum(depth, r, -near) < 0.0", "sign_of_sum(depth, 0.0, -near) < 0.0", *hard("near-gap")),
    Fault("bounds-far", "what begins before the far plane counts by its centre", "kernels/sphere_bounds.h",
          "sign_of_sum(depth, -r, -far) > 0.0", "sign_of_sum(depth, 0.0, -far) > 0.0", *hard("far-plane")),
    Fault("bounds-parallel", "parallel rays are bounded as those through the eye", "kernels/sphere_bounds.h",
          "const double right = orthographic ? largest_x(c, depth, r, near, far)",
          "const double right = orthographic ? largest_slope(c, depth, r, near, far)", *hard("orthographic")),
    Fault("scissor-truncated", "the end of a rectangle is cut to the pixel below", "host/scene/bounds.c",
          "(uint32_t)to + 1 : count", "(uint32_t)to : count", *hard("scissor")),
    Fault("frustum-centred", "the left edge is taken for that of a centred image", "host/scene/bounds.c",
          "cells_of(x, (double)camera->left,", "cells_of(x, -(double)camera->right,", *hard("frustum")),
    Fault("left-column", "the first column of tiles is rounded", "kernels/tile_rect.h",
          "const double tile = floor(low / tile_size);", "const double tile = floor(low / tile_size + 0.5);",
          *hard("left-tile")),
    Fault("last-column", "the last column of tiles is dropped", "kernels/tile_rect.h",
          "(int)tile + 1 : count", "(int)tile : count", "test_tile_rect", []),
    Fault("slack-ignored", "stored positions are taken for being on their rays", "kernels/tile_rect.h",
          "+\n                 (double)frame->slack_x;", ";", "test_tile_rect", []),
    Fault("cone-sphere", "the sphere around a narrow cone is as small as that around its rim",
          "kernels/tile_rect.h", "(c > s ? away : range * s)", "(range * s)", *hard("cone-sphere")),
    # Which lights reach which pixels.
    Fault("range-closed", "a light reaches what is exactly at its range", "kernels/reach.h",
          "return distance2 < light.range2;", "return distance2 <= light.range2;",
          "test_lighting_formulas", []),
    Fault("clamp-low", "lights before a box are not clamped to it", "kernels/reach.h",
          "return pick(low > not_above, low, not_above);", "return pick(low > not_above, not_above, low);",
          *hard("left-tile")),
    Fault("cone-unsigned", "the square of the cosine loses its sign", "kernels/spot.h",
          "return v * ABSOLUTE(v);", "return v * v;", *hard("wide-cone")),
    Fault("cone-margin", "the cone that planes part from boxes is no wider than the cone of pixels",
          "host/frame/spot_cone.c", "widened_by = 0x1p-20;", "widened_by = -0x1p-17;",
          "test_spot_culling", []),
    Fault("cone-quotient", "a cone without a penumbra divides by 0", "host/frame/spot_cone.c",
          "(float)(1.0 / fmax(least_fall, fall))", "(float)(1.0 / fall)", *hard("narrow-cone")),
    Fault("cone-empty", "a cone of 0 degrees is one like others", "host/frame/spot_cone.c",
          "tl_spot_is_empty(light) ? 2.0 : cosine(light->outer_cone);", "cosine(light->outer_cone);",
          *hard("narrow-cone")),
    Fault("cone-quarter", "a quarter of a turn is taken for less", "host/frame/spot_cone.c",
          "return half_angle == quarter_turn ? 0.0 : cos((double)half_angle);",
          "return half_angle == quarter_turn ? 1e-5 : cos((double)half_angle);", *hard("quarter-turn")),
    Fault("cone-edge", "the edge of a cone is its packed cosine", "host/frame/spot_cone.c",
          ".least_cos2 = (float)(outer * fabs(outer)),",
          ".least_cos2 = (float)(rint(outer * 2048.0) / 2048.0 * fabs(outer)),", *hard("cone-edge")),
    Fault("cone-axis", "the distance from the axis is the root of a difference, which may be negative",
          "kernels/spot.h", "return signed_square(along_axis(spot, l)) > spot.least_cos2 * distance2;",
          "const real along = along_axis(spot, l);\n"
          "    return SQRT(distance2 - along * along) * (real)spot.least_cos <\n"
          "           along * SQRT((real)(R(1.0) - spot.least_cos * spot.least_cos));", *hard("cone-axis")),
    # Tiles and lists.
    Fault("box-short", "the box of a tile leaves out its last pixel", "kernels/cull_tiles.cl",
          "i < frame->tile_size * frame->tile_size; i += TL_GROUP",
          "i < frame->tile_size * frame->tile_size - 1; i += TL_GROUP", *hard("sky")),
    Fault("box-column", "the box of a tile leaves out its last column of blocks", "kernels/cull_rows.cl",
          "for (uint column = 0; column < columns; column++) {",
          "for (uint column = 0; column < max(columns, 2u) - 1; column++) {", *hard("left-tile")),
    Fault("split-half", "both boxes of a deep tile are of its near half", "kernels/cull_rows.cl",
          "far = box_of_positions(frame, &at, column, middle, MAXFLOAT);",
          "far = box_of_positions(frame, &at, column, -INFINITY, middle);", *hard("resize")),
    Fault("sky-first", "a tile that begins with sky is taken for one without surfaces",
          "kernels/cull_rows.cl",
          "near = box_of_positions(frame, &at, column, -INFINITY, MAXFLOAT);",
          "if (any_lane(at.depth[0] <= MAXFLOAT))\n"
          "                near = box_of_positions(frame, &at, column, -INFINITY, MAXFLOAT);", *hard("sky")),
    Fault("one-depth", "a column of one single depth has no place across", "kernels/cull_rows.cl",
          "const mask any = nearest <= farthest;", "const mask any = nearest < farthest;",
          *hard("one-depth")),
    Fault("list-order", "lists are in reverse, 64 lights at a time", "kernels/cull_rows.cl",
          "for (; bits; bits &= bits - 1)\n"
          "                list[end++] = t->lights[32 * word + popcount((bits & -bits) - 1)];",
          "for (; bits; bits &= ~(1ul << (63 - clz(bits))))\n"
          "                list[end++] = t->lights[32 * word + 63 - clz(bits)];", *hard("light-order")),
    Fault("list-short", "the last light of a list is dropped", "kernels/cull_rows.cl",
          "        t->ends[tile] = end;\n    }",
          "        t->ends[tile] = end - (end > t->starts[tile]);\n    }",
          *hard("long-lists")),
    Fault("stale-lists", "frames of as many columns of tiles keep the lists of the frame before",
          "host/lighting/cull_pass.c", "    TRY(find_rects(c, ms, err));\n    TRY(list_lights(c, ms, err));",
          "    static cl_uint columns;\n"
          "    TRY(find_rects(c, ms, err));\n"
          "    if (columns != c->frame.tiles_x)\n"
          "        TRY(list_lights(c, ms, err));\n"
          "    columns = c->frame.tiles_x;\n"
          "    c->frame.list_capacity = capacity_of(c, TL_BUFFER_LIST);\n"
          "    c->frame.cell_capacity = capacity_of(c, TL_BUFFER_CELL_LIST);", *hard("resize")),
    Fault("tiles-down", "tiles are counted down", "host/frame/frame.c",
          ".tiles_x = (camera->width + tile_size - 1) / tile_size,",
          ".tiles_x = (camera->width + tile_size - 2) / tile_size,", *hard("odd-sizes")),
    # Pixels, their formulas and what they are stored as.
    Fault("normal-guard", "a normal of length 0 is divided by its length", "kernels/vec3.h",
          "pick(length2 > R(0.0), R(1.0) / SQRT(length2), R(0.0))", "R(1.0) / SQRT(length2)",
          *hard("no-normal")),
    Fault("touching-guard", "a light in the surface has a direction", "kernels/light.h",
          "#define TL_LEAST_DISTANCE2 R(1e-24)", "#define TL_LEAST_DISTANCE2 R(-1.0)", *hard("touching")),
    Fault("repair-normal", "a normal that is no number is not repaired", "host/gbuffer/repair.c",
          "return isnan(nx) || isnan(ny) ||", "return isnan(ny) ||", "test_repair", []),
    Fault("repair-value", "a colour that is no number is not repaired", "host/gbuffer/repair.c",
          "if (!(v == repaired_value)) {", "if (v < repaired_value || v > repaired_value) {",
          "test_repair", []),
    Fault("power-unbounded", "powers too small for a float are taken for its bits", "kernels/power.h",
          "pick(below > R(-64.0), below, R(-64.0))", "below", *hard("powers")),
    Fault("cut-removed", "what is no number leaves its pixel", "kernels/pixel.h",
          "pick(radiance < TL_MOST_FLOAT, radiance, TL_MOST_FLOAT)", "radiance", *hard("nan-pixel")),
    Fault("scaled-view", "a camera that scales is taken", "host/scene/camera.c",
          "rotation_tolerance = 1e-3;", "rotation_tolerance = 3e-2;", *hard("scaled-view")),
    Fault("far-is-sky", "the far plane's depth is stored as sky's", "kernels/pack.h",
          "return q > R(0x1p-126) ? q : R(0x1p-126);", "return q;", *hard("far-plane")),
    Fault("code-truncated", "codes are cut down, not rounded", "kernels/encode.h",
          "WHOLE_TO_WORD(FLOOR(value + R(0.5)))", "WHOLE_TO_WORD(FLOOR(value))",
          "test_layout_round_trip", []),
    Fault("lobe-sign", "the part of the half vector across the normal has the wrong sign",
          "kernels/halfway.h",
          "a.across = fma3(s.normal, -a.n_dot_h, h);", "a.across = fma3(s.normal, a.n_dot_h, h);",
          "test_model_accuracy", []),
    Fault("model-constant", "diffuse light under a coat is bounded by 1.05", "kernels/lobe_metal_rough.h",
          "FMA(-graze, f.f90, R(1.0))", "FMA(-graze, f.f90, R(1.05))", "test_model_accuracy", []),
    # What accuracy is given away for.
    Fault("short-polynomial", "a coefficient of a polynomial of degree 5 is off in its fourth digit",
          "kernels/power.h", "FMA(m, p, R(0.4846482816))", "FMA(m, p, R(0.4849482816))",
          "test_knob_formulas", []),
    Fault("guess-constant", "the guess of 1/x is not the best", "kernels/root.h",
          "#define TL_GUESS_OF_RECIPROCAL 0x7ef31200", "#define TL_GUESS_OF_RECIPROCAL 0x7ef11200",
          "test_knob_formulas", []),
    Fault("root-unallowed", "what is checked may not be off by as much as the knob of roots says",
          "host/frame/approximations.c", "sum.root += off->root;", "sum.root += 0.0 * off->root;",
          "test_knob_frames", []),
]
