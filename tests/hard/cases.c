#include "hard_case.h"

/* What is tried, where cases try the same. */
static const char sphere_pixels[] = "pixels that a light reaches, in its rectangle";
static const char cone_pixels[] =
    "pixels in reach of a spot: in its cone or not, and its share";

const hard_case hard_cases[] = {
    {1, "camera-inside",
     "A light that the camera is inside of, or that has its centre behind it, has no outline "
     "to project and is skipped or cut.",
     "The interval of x/depth over the part of the sphere before the near plane; nothing is "
     "divided by the light's depth.",
     "playcanvas 4795, korangar 124", sphere_pixels, "centre +- radius/depth",
     hard_camera_inside},
    {2, "small-rectangle",
     "The picture of a sphere off the middle is an ellipse, longer than radius over depth "
     "says.",
     "Tangents from the eye, axis by axis, in double.", "cesium 1316, niagara 17",
     sphere_pixels, "centre +- radius/depth", hard_small_rectangle},
    {3, "scissor",
     "The end of a rectangle is cut to the whole pixel below it, and the last column is lost.",
     "Every pixel whose centre is in the closed interval is kept.", "godot 46892",
     sphere_pixels, "both ends truncated", hard_scissor},
    {4, "left-tile", "The first column of tiles is rounded, and one is missing on the left.",
     "The first tile is the one that the widened left end is in.", "filament 2402",
     "tiles with pixels that a light reaches, in its rectangle", "the first column rounded",
     hard_left_tile},
    {5, "far-plane",
     "A light that crosses the far plane or has its centre behind it is culled, or a surface "
     "on that plane is taken for sky.",
     "Only the part of the sphere before the far plane counts, and no layout stores a surface "
     "as sky.",
     "godot 77112 and 84961, filament 3141 and 4916, bevy 20136",
     "pixels that a light reaches, in its rectangle; and surfaces of every layout that are no "
     "sky",
     "no light with its centre behind far", hard_far_plane},
    {6, "near-gap",
     "Surfaces between the near plane and the first slice of depth get no light.",
     "There are no slices: a tile's box is that of its pixels' positions.", "armory 2125",
     sphere_pixels, "no light with its centre before near", hard_near_gap},
    {7, "wide-cone",
     "A cone of 90 degrees and more is taken for one of 90 degrees less, or for none.",
     "The cosine is squared with its sign, up to half a turn.",
     "godot 48054, 100236 and 110367", cone_pixels, "squares without signs", hard_wide_cone},
    {8, "narrow-cone",
     "A cone of 0 degrees divides by the difference of two cosines that are one.",
     "The difference is 0.001 at least, and what floats cannot tell from no cone lights "
     "nothing.",
     "filament 4785, playcanvas 4861, bevy 25360", cone_pixels, "a quotient without a limit",
     hard_narrow_cone},
    {9, "quarter-turn", "At a quarter of a turn, as a float, the tangent has changed its sign.",
     "No tangent is taken; that float means exactly half of space.", "bevy 25368", cone_pixels,
     "distance from the axis against the tangent", hard_quarter_turn},
    {10, "cone-sphere", "The sphere around a wide cone grows beyond all bounds, r/(2 cos^2).",
     "Up to 45 degrees the sphere through apex and rim, beyond it that around the rim, never "
     "more than the light's own.",
     "WickedEngine, in its source",
     "rectangles of spots: no larger than their sphere's, with all pixels that are lit",
     "r/(2 cos^2)", hard_cone_sphere},
    {11, "cone-edge", "The edge of a cone is off by what its packed cosine is rounded by.",
     "Decided by squares in float, within 7u of the cosine.", "godot 71832 and 82546",
     cone_pixels, "the cosine in 16 bits", hard_cone_edge},
    {12, "cone-axis",
     "On the axis of a cone the root of l.l - (a.l)^2 is that of a negative number.",
     "Tests of cones take no root of a difference.", "bevy 6167 and 7176", cone_pixels,
     "the root of the difference", hard_cone_axis},
    {13, "orthographic", "Bounds made for a perspective camera are used for parallel rays.",
     "Intervals of x in metres; depths may be 0 and negative.",
     "o3de 18516, bevy 9614, filament 5322", sphere_pixels, "centre +- radius/depth",
     hard_orthographic},
    {14, "frustum",
     "A frustum that is very wide, very narrow or off its axis is taken for a common one.",
     "Edges of the image are four numbers; margins grow with the longest ray.",
     "bevy 4395 and 5946", sphere_pixels, "the right edge alone, as if symmetric",
     hard_frustum},
    {15, "long-lists", "A tile's list is full, and the lights behind are dropped.",
     "Lists are counted before they are written, and grow.",
     "HDRP 5771, bevy 3915, filament 70", "lists of tiles that all lights reach, in full",
     "256 lights a list", hard_long_lists},
    {16, "resize", "After a resize a frame is lit by the lists of the one before.",
     "Lists are made anew for every frame; what grows is made before it is used.", "HDRP 609",
     NULL, NULL, hard_resize},
    {17, "odd-sizes",
     "Images that are no multiple of the tile, or one pixel wide, lose their rims.",
     "Planes are filled up with sky, and tiles counted up.", "bevy's tests, HDRP's source",
     "pixels with a value", "tiles counted down", hard_odd_sizes},
    {18, "sky", "A tile of sky, or with some sky in it, gets bounds that are infinite.",
     "Sky is left out of boxes, and a box without a surface is met by no light.",
     "HDRP's source", "pixels: sky as it is, surfaces lit", "cells of depth, sky among them",
     hard_sky},
    {19, "one-depth",
     "In a tile of one single depth 1/(far - near) is infinite, and 0 times that no number.",
     "Nothing is divided by a tile's depth.", "WickedEngine, in its source", "surfaces lit",
     "cells of depth by a factor", hard_one_depth},
    {20, "scaled-view",
     "The view's matrix scales, and a light's range is not in the space of the test.",
     "A camera that scales is refused; up to a thousandth, which may be rounding, all agree.",
     "three.js 33749", "pixels within a light's range in world space, and cameras refused",
     "the range as it is", hard_scaled_view},
    {21, "light-order", "The order that lights are listed in shows in the picture.",
     "Lights add up in the order of the file, on both paths, in every run.",
     "godot 46353, bevy 11248", "pixels of eight runs", "lists in reverse", hard_light_order},
    {22, "touching",
     "A light in the surface divides by distance 0; so does a falloff that begins where it "
     "ends.",
     "Nearer than 1e-12 m a light adds 0, and such a falloff is a step.", "ISPC, in its source",
     "pixels and lights that reach them: a finite value", "quotients as they stand",
     hard_touching},
    {23, "powers", "The power of a negative cosine, or 0 to the power 0, is no number.",
     "No lobe where the half vector is not above the surface; the power is our own, of any "
     "cosine from 0 on.",
     "several, in their sources", "pixels, lights and models: a finite value",
     "pow of the cosine as it is", hard_powers},
    {24, "no-normal", "A normal of length 0 is normalised to no number.",
     "It stays 0, and no light reaches it; lengths whose squares leave the floats are made 0.",
     "OpenUSD 2016", "pixels without a normal: ambient light alone", "n over its length",
     hard_no_normal},
    {25, "nan-pixel", "One pixel that is no number is smeared over the image.",
     "Numbers are repaired where they enter; and without that they stay in their pixel.",
     "overte 2297", "pixels beside: the same bits", "a mean over neighbours of a plane",
     hard_nan_pixel},
    {26, "own-shadow",
     "A surface aslant to the light darkens itself in stripes; a bias that is large enough for "
     "it parts shadows from what casts them.",
     "Texels have slopes, from which follows what a surface rises by between their centre and "
     "a place.",
     "godot 38932, panda3d 547, cubos 1308",
     "points of planes and folds at many angles, in every kind of map: all light arrives",
     "a constant bias of a texel's width", hard_own_shadow},
    {27, "far-shadow",
     "Depths stored as 1 - near/w cannot tell surfaces apart that are far from a light.",
     "near/w is stored, whose rounding is a share of the distance, whatever near is.",
     "playcanvas 524",
     "points behind and before a plate by 0.01 to 1 % of their distance: dark or lit",
     "1 - near/w", hard_far_shadow},
    {28, "cube-seam",
     "A filter at the edge of a cube map's side leaves its view: a seam of light or dark.",
     "Views are wider than their sides by what the widest filter needs.",
     "urho3d 2606, sbox 10960",
     "points within half a filter of a side's edges: lit on a plane, dark behind it",
     "views of 90 degrees, and light beyond them", hard_cube_seam},
    {29, "flat-occlusion",
     "Ambient occlusion darkens planes, most where they are seen aslant, as if they hid "
     "themselves.",
     "Only what rises above the pixel's own plane counts, by its own place.",
     "OloEngineBase 408, QGIS 49702", "pixels of planes at many angles: exactly open",
     "depths of points in the hemisphere, with a constant bias", hard_flat_occlusion},
#ifdef TL_HARD_CAPTURE
    {30, "pane-order",
     "Surfaces that blend are drawn in the order of their centres, and are wrong where they "
     "cut "
     "each other.",
     "They are peeled pixel by pixel, by the bits of their depths.",
     "facemask-plugin 66, upbge 878",
     "pixels of ten panes that cross, where rays tell: as those are blended",
     "sorted by their centres", hard_pane_order},
#endif
    {31, "edge-neighbours",
     "A table of a pixel's neighbours has one twice, lacks another, and half of it is used: "
     "edges on two sides are not seen.",
     "All eight, as four pairs on opposite sides.", "Policarpo and Fonseca 2005, listing 21",
     "pixels beside another normal: smoothed", "the sum over that table", hard_edge_neighbours},
    {32, "edge-plane",
     "Depth differs from pixel to pixel on a floor that is seen aslant, which is smoothed "
     "away.",
     "The second difference of 1/depth, which is 0 on every plane.",
     "equation 7 of the same, taken of depths", "pixels of a floor: the same bits",
     "differences to neighbours", hard_edge_plane},
    {33, "grey-bloom",
     "Squares of colours are added up in place of colours, and every light glows grey.",
     "Seven taps of each colour.", "Policarpo and Fonseca 2005, listing 22",
     "pixels that a coloured light scatters to: its hue",
     "the dot product of a colour by itself", hard_grey_bloom},
    {34, "nan-bloom", "One pixel that is no number is a square of them once it is blurred.",
     "Such pixels become the mean of their neighbours before anything is mixed.", "overte 2297",
     "pixels of a picture with four of them: finite", "seven taps across and down",
     hard_nan_bloom},
    {39, "profile-seam",
     "The first and the last plane of a light's profile do not meet: a stripe of light or "
     "dark, or "
     "one plane for the whole circle.",
     "Planes come round: behind the last is the first, and one at 360 degrees is that at 0.",
     "three.js 34626, Nabla 671", "directions around C0: the share in double",
     "a texture that ends at its edges", hard_profile_seam},
    {40, "profile-axis",
     "The angle from the axis of a light is taken from its cosine, which near the axis tells "
     "few angles apart, and is above 1.",
     "It is an arc tangent of two sums, as accurate at the poles as elsewhere.",
     "Q2RTX 214", "directions along narrow beams: the share in double",
     "an arc cosine in float", hard_profile_axis},
};

const size_t hard_case_count = COUNT_OF(hard_cases);

int hard_passes(const hard_case *of, const hard_result *result)
{
    return result->wrong == 0 && result->lost == 0 && result->beyond == 0 &&
           result->tried + result->pixels > 0 && (!of->counted || result->tried > 0) &&
           (!of->usual || result->usual_wrong > 0);
}
