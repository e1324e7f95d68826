/* Compiled once per instruction set: TL_ADD_PIECE is the name it then has. */
#include "sky_tile.h"

tl_sky_add_piece TL_ADD_PIECE;

/* Texels have nothing in common: vectors of them, whatever their width, have the same bits. */
void TL_ADD_PIECE(tl_sky_tile *t, const tl_sky_node *node)
{
    const double x = node->toward[0], y = node->toward[1], z = node->toward[2];
    const double red = node->radiance[0], green = node->radiance[1], blue = node->radiance[2];
    const double alpha2 = t->alpha2, solid_angle = node->solid_angle;
    for (int i = 0; i < TL_SKY_TILE; i++) {
        const double c = x * t->toward[0][i] + y * t->toward[1][i] + z * t->toward[2][i];
        const double wide = 1.0 - c + alpha2 * (1.0 + c);
        const double weight = (c > 0.0 ? c : 0.0) * solid_angle / (wide * wide);
        t->sum[0][i] += weight * red;
        t->sum[1][i] += weight * green;
        t->sum[2][i] += weight * blue;
        t->weight[i] += weight;
    }
}
