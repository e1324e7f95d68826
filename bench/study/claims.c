#include "claims.h"

#include <stdarg.h>
#include <stdio.h>

#define SHADERX2 "Thibieroz, \"Deferred Shading with Multiple Render Targets\", ShaderX2, 2003"

const tl_claim tl_claims[TL_CLAIM_COUNT] = {
    {"position-buffer",
     "Computing positions from depth, in place of storing them, makes a renderer 10 to 20 % "
     "faster",
     "Merlin3D, \"Faster Deferred Shading\", 2011",
     "The layout merlin-position over merlin, by turns, on our frame of spheres: what a frame "
     "takes more "
     "where positions are stored in half floats. With one light that reaches nothing little is "
     "left "
     "but to read the pixels; with many, lighting hides it.",
     tl_claim_position_buffer},
    {"scissors",
     "Of the fragments of three lights on 512 x 512 pixels, scissors save about a half, on "
     "average of "
     "where the viewer is",
     "Policarpo and Fonseca, \"Deferred Shading Tutorial\", 2005, section 3.4.2",
     "Counted in a cubic room with three lights at random places, from 16 random places of the "
     "viewer in "
     "it, with the tutorial's field of view; the tutorial does not say how far its lights "
     "reach, so "
     "that is tried. Scissors: the rectangles of tl_sphere_bounds. Tiles: what our culling "
     "lists. In reach: "
     "pixels that light arrives at, more than which nothing can save.",
     tl_claim_scissors},
    {"bandwidth",
     "Eight full-screen passes at 1024 x 768 and 60 frames a second move 14 to 42 GB a second, "
     "by the "
     "number and size of targets",
     SHADERX2 ", table 2",
     "By its own equation 6 and the variables of its table 1: the example behind table 2 "
     "counts depth as 8 "
     "bytes, not 4, and rounds. Beside that what our passes move for eight lights on the full "
     "screen, "
     "counted from the tables of layouts: a pixel is read once for all lights.",
     tl_claim_bandwidth},
    {"position-operations",
     "A view-space position takes one multiply-add and one division, and an interpolated ray "
     "or another "
     "multiply-add",
     "\"Deferred Shading Tricks\", section \"Who Needs a Position Buffer, Anyway?\"",
     "The operations of our formula, counted by a test that runs it on numbers that count; "
     "nothing is "
     "interpolated, so two multiply-adds make the ray, and two products replace the division "
     "of x and y. "
     "The errors of both forms in float, near 0.1 m and far 1000 m, are found by trying.",
     tl_claim_operations},
    {"half-positions", "16-bit floats are ideal to store positions",
     SHADERX2 ", section \"Pixel Position\"; likewise "
              "\"Deferred Shading\", 2022, section \"Packing the GBuffer Efficiently\"",
     "The largest error of depth of the layout shaderx2-128 from a distance to a tenth beyond "
     "it, found by "
     "trying; beside that what depth buffers of as many bits or twice as many lose, near 0.1 m "
     "and far "
     "20 km.",
     tl_claim_half_positions},
};

tl_claim_figure *tl_claim_add(tl_claim_figures *figures,
                              const char *unit,
                              double theirs_from,
                              double theirs_to,
                              double ours,
                              const char *what,
                              ...)
{
    tl_claim_figure *f = &figures->of[figures->count++];
    va_list list;
    *f = (tl_claim_figure){
        .theirs = {theirs_from, theirs_to}, .ours = ours, .low = ours, .high = ours};
    snprintf(f->unit, sizeof f->unit, "%s", unit);
    va_start(list, what);
    vsnprintf(f->what, sizeof f->what, what, list);
    va_end(list);
    return f;
}
