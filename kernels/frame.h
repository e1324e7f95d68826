/* What crosses from host memory to device memory, apart from the planes (planes.h).
 *
 * Structures are whole rows of four 32-bit scalars, so host and device cannot disagree about
 * padding. Sizes are asserted here under both compilers; tests/test_frame_layout.c reads the
 * offsets back from the device. */
#ifndef TL_FRAME_H
#define TL_FRAME_H

#include "dialect.h"
#include "largest.h"
#include "planes.h"

/* Rays of the camera: pixel (column, row) is seen along (x0 + column dx, y0 + row dy, -1) times
 * its depth (perspective), or at (x0 + column dx, y0 + row dy) in m, its depth behind
 * (orthographic). Pixel centres are in x0, y0 already; dy is negative, row 0 being the top. */
typedef struct tl_rays {
    float x0, dx, y0, dy;
    /* Of the picture, where planes are a part of it (tl_needs.window; else 0): add to columns, rows. */
    float column0, row0;
    float unused[2];
} tl_rays;

/* One frame, or a band of its tile rows that is lit alone because the whole does not fit. The planes
 * are filled up with sky, so that no kernel has an edge case. */
typedef struct tl_frame {
    tl_rays rays;
    float view_from_world[3][4]; /* a rotation; column 3 a translation, m */
    float ambient[3];            /* linear Rec. 709 */
    tl_u32 tile_size;            /* px: 8, 16, 32 or 64 */
    float sky[3];                /* radiance where nothing was hit */
    tl_u32 box_count;            /* boxes per tile that lights are tested against: 0 to 2 */
    tl_u32 pitch, rows;          /* px; the planes are [rows][pitch] */
    tl_u32 tiles_x, tiles_y;     /* those of the band that hold pixels of the image */
    tl_u32 box_pitch;            /* boxes per row of tiles, tiles_x up to a multiple of 16 */
    tl_u32 global_count;         /* lights before this index reach everything */
    tl_u32 light_count;          /* all lights */
    tl_u32 first_row;            /* the band's first row in the image, px */
    tl_u32 buffer_row;           /* where that row stands in the planes that are there, px */
    tl_u32 list_capacity;        /* entries that the lists of the band may have in all */
    tl_u32 cell_capacity;        /* entries that the lists of cells may have in all */
    tl_u32 has_cells;            /* 1: lights are listed by cell first */
    float depth_slope, depth_offset; /* from stored depth to metres: depth_code.h */
    float slack_x, slack_y; /* stored positions off their rays, at most: x/depth or m */
    /* Sections behind the lights and their cones: where each begins, in rows of 16 bytes from the start
     * of the buffer of lights. 0: the frame has none. */
    tl_u32 brdfs_at, shapes_at, sky_at;
    tl_u32 calls_at;        /* what each light calls for: choices.h */
    float exponent;         /* of all surfaces, where they have one (needs.h); else 0 */
    tl_u32 surroundings_at; /* what keeps ambient light from pixels: occlusion.h */
    tl_u32 is_layer;        /* 1: is blended (blend.h), and what it says of sky not read */
    tl_u32 sky_light_at;    /* of the sky on surfaces: sky_light.h */
} tl_frame;
TL_STATIC_ASSERT(sizeof(tl_frame) == 208, frame_is_thirteen_rows);

#define TL_SECTION_ROW 16 /* bytes */

#define TL_MAX_BOXES 2 /* per tile */

/* Lights that a row of tiles is culled against at a time (cull_rows.cl): a multiple of 64. */
#define TL_LIGHT_BLOCK 1024

/* Of the path for GPUs: work-items per group, a multiple of 32, and tiles along the side of a cell. */
#define TL_GROUP 64
#define TL_CELL 8
#define TL_CELLS(tiles) (((tiles) + TL_CELL - 1) / TL_CELL)

/* A light as the kernels take it: view space, colours multiplied out. All finite. Lights that
 * reach everything (no range, or directional) stand before all others. */
typedef struct tl_view_light {
    float position[3]; /* m; of a directional light the unit vector towards it */
    float range2;      /* m^2, see reach.h; of no meaning for a light that reaches everything */
    float diffuse[3];  /* cd or lx, linear Rec. 709 */
    float fade;        /* 1/range, 1/range^2 or 1/(range - begin): see falloff.h */
    float specular[3]; /* cd or lx */
    tl_u32 falloff;    /* a row of falloff.h, as falloff_row() reads it */
} tl_view_light;
TL_STATIC_ASSERT(sizeof(tl_view_light) == 48, view_light_is_three_rows);

/* The cone that a spot light shines into; of every other light one that is the whole of space. Where the
 * scene has spots (TL_SPOTS), light_count of them stand behind the lights, in their order. */
typedef struct tl_view_spot {
    float axis[3];            /* unit, view space, from what is lit towards the light; else 0 */
    float least_cos;          /* cosine of the outer half-angle; 2 where the cone is empty */
    float least_cos2;         /* that times its magnitude */
    float scale;              /* of the cosine above it, to 1 at the inner half-angle */
    float cull_cos, cull_sin; /* of a half-angle that rounding cannot leave: spot.h */
} tl_view_spot;
TL_STATIC_ASSERT(sizeof(tl_view_spot) == 32, view_spot_is_two_rows);

/* How a surface reflects whose pixels say so: a row of the table that planes of indices lead to. What is
 * not given is the pixel's own. */
typedef struct tl_brdf {
    tl_u32 model;      /* a row of models.h */
    tl_u32 given;      /* what of this replaces the pixel's: bits of tl_brdf_parameter */
    float exponent;    /* 0 to 10000 */
    float k;           /* Minnaert's exponent */
    float diffuse[3];  /* linear Rec. 709 */
    float roughness;   /* 0 to 1, as artists see it; along the direction where they are two */
    float specular[3]; /* linear Rec. 709 */
    float across;      /* roughness at right angles to the direction */
    float direction[3], unused; /* world space, of any length */
} tl_brdf;
TL_STATIC_ASSERT(sizeof(tl_brdf) == 64, brdf_is_four_rows);

/* A picture in the buffer of lights, and how it stands in view space: texture.h. Directions are of unit
 * length, unless they are scaled so that lookups give pixels at once. */
typedef struct tl_view_map {
    float right[3];
    /* row of the buffer: [height][width] of R, G, B, 0; 0: there is no picture */
    tl_u32 pixels_at;
    float up[3];
    tl_u32 width; /* px */
    float ahead[3];
    tl_u32 height;
} tl_view_map;
TL_STATIC_ASSERT(sizeof(tl_view_map) == 48, view_map_is_three_rows);

/* What few lights have beside the rest: shape.h. A light that has it says so by `falloff`. */
typedef struct tl_view_shape {
    tl_view_map map;  /* what colours are multiplied with */
    float ambient[3]; /* cd or lx, of the lobe that asks for no normal */
    tl_u32 falloff;   /* that of the light, as others have it; TL_FADE_TABLE: by the table */
    /* bit 0: the map is projected over the cone, not all around; from bit 1 on: 1 + the index of its link
     * (link.h), 0: it lights everything */
    tl_u32 spot_and_link;
    tl_u32 table_at; /* row of the buffer where the table begins */
    /* index of the last of its numbers, at the range; `fade` is that over the range */
    tl_u32 table_last;
    tl_u32
        shadow_at; /* row of the buffer where its tl_view_shadow is; 0: nothing stands in its way */
    tl_u32
        profile_at; /* row of the buffer where its tl_view_profile is; 0: alike in all directions */
    tl_u32 reserved[3];
} tl_view_shape;
TL_STATIC_ASSERT(sizeof(tl_view_shape) == 96, view_shape_is_six_rows);

/* The profile of a light in the buffer of lights, and how it stands in view space: profile.h. Directions are
 * of unit length and at right angles. */
typedef struct tl_view_profile {
    float c90[3];
    tl_u32 shares_at; /* row of the buffer: [rows][columns] */
    float nadir[3];
    tl_u32 columns; /* around, of a whole turn */
    float c0[3];
    tl_u32 rows;
    tl_u32 first_row;         /* from the nadir, of the first that is there */
    tl_u32 rows_of_half_turn; /* steps from the nadir to the zenith */
    tl_u32 reserved[2];
} tl_view_profile;
TL_STATIC_ASSERT(sizeof(tl_view_profile) == 64, view_profile_is_four_rows);

/* The shadow map of a light in the buffer of lights, and how a surface finds its place in it: shadow.h.
 * right, down and ahead are directions in view space: of a spot's map unit ones; of a cube's map the axes
 * of the world; of a parallel one scaled, so that a position's product with them, and _at, are texels and
 * stored depth. */
typedef struct tl_view_shadow {
    float right[3], right_at; /* texels from the view's left edge: of what is straight ahead */
    float down[3], down_at;   /* texels from its upper edge */
    float ahead[3], ahead_at; /* ahead_at: of parallel maps; else 0 */
    tl_u32 kind;              /* TL_SHADOW_SPOT and its like */
    tl_u32 texels_at;         /* row of the buffer: [views][size][size] of depth and slopes */
    tl_u32 size;              /* texels, each way */
    tl_u32 filter;            /* width of what visibility is the mean over, texels */
    float scale;              /* texels per right/ahead, of perspective maps */
    float near;               /* m, of them: what stored depths are shares of */
    float slope_x, slope_y; /* of a plane's depth per texel: of right.n/facing, down.n/facing */
    /* m that a surface may lie off its place, with its depth d: slack + d (per_depth + d per_depth2) */
    float slack, slack_per_depth, slack_per_depth2;
    float offset; /* of the way to the light, of parallel maps m: TL_SHADOW_OFFSET */
} tl_view_shadow;
TL_STATIC_ASSERT(sizeof(tl_view_shadow) == 96, view_shadow_is_six_rows);

/* How what stands around pixels keeps ambient light from them: occlusion.h. */
typedef struct tl_view_surroundings {
    float radius;     /* m, within which */
    float reach;      /* px across that it spans 1 m away; of parallel rays, anywhere */
    float most_reach; /* px across that are sampled at most */
    float slack, slack_per_depth, slack_per_depth2; /* as those of tl_view_shadow */
    tl_u32 slices, steps; /* of a pixel; looks to either side of a slice */
    tl_u32 table_at;      /* row of the buffer: directions and steps of slices */
    tl_u32 planes_at;     /* row of the buffer behind all sections: planes of the picture */
    tl_u32 rows;          /* of those */
    tl_u32 halvings;      /* looks more to either side of a slice, for its horizon */
} tl_view_surroundings;
TL_STATIC_ASSERT(sizeof(tl_view_surroundings) == 48, view_surroundings_is_three_rows);

/* Which pixels lights are kept from that are linked to objects: link.h. Where some are, it is the row of the
 * buffer before their shapes. */
typedef struct tl_view_links {
    tl_u32 words_at;    /* row of the buffer: planes of words, one for each 32 links */
    tl_u32 rows;        /* of a plane, which has the frame's pitch */
    tl_u32 reserved[2]; /* 0 */
} tl_view_links;
TL_STATIC_ASSERT(sizeof(tl_view_links) == 16, view_links_is_one_row);

/* A sky that is not of one colour: sky.h. */
typedef struct tl_view_sky {
    tl_view_map map;  /* of a gradient the directions alone */
    float zenith[3];  /* radiance; frame.sky is that at the horizon */
    tl_u32 reserved0; /* 0 */
    float ground[3];
    tl_u32 reserved1; /* 0 */
} tl_view_sky;
TL_STATIC_ASSERT(sizeof(tl_view_sky) == 80, view_sky_is_five_rows);

/* The light of the sky on surfaces: sky_light.h. Axes are those of the sky's map, unit, in view space; *_at
 * are rows of the buffer. */
typedef struct tl_view_sky_light {
    float right[3];
    tl_u32 texels_at; /* [count] of R, G, B, 0: all levels, one after another */
    float up[3];
    tl_u32
        levels_at; /* [TL_SKY_LEVELS] of a level's first texel, and its size without border */
    float ahead[3];
    tl_u32 table_at; /* [TL_SKY_TABLE][TL_SKY_TABLE] of shares */
    /* a channel's terms in the normal, in view space: 1, x, y, z, xx, yy, zz, xy, yz, zx, 0, 0 */
    float irradiance[3][12];
} tl_view_sky_light;
TL_STATIC_ASSERT(sizeof(tl_view_sky_light) == 192, view_sky_light_is_twelve_rows);

#endif
