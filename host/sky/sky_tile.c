/* Compiled once per instruction set: TL_ADD_PIECE is the name it then has. */
#include "sky_tile.h"

tl_sky_add_piece TL_ADD_PIECE;

/* Twice 1 - c is the chord's square, which keeps its digits where c is nearly 1. */
static inline float chord2(const tl_sky_tile *t, int i, float x, float y, float z)
{
    const float dx = t->toward[0][i] - x, dy = t->toward[1][i] - y, dz = t->toward[2][i] - z;
    return dx * dx + dy * dy + dz * dz;
}

/* Texels have nothing in common: vectors of them, whatever their width, have the same bits. Two share a
 * division, which takes as long as all else of one. 4 (1 - c + alpha^2 (1 + c))^2 is at least
 * 16 alpha^4, 6e-7, so that a product of two is in the range of float. */
void TL_ADD_PIECE(tl_sky_tile *t, const tl_sky_node *node)
{
    enum { HALF = TL_SKY_TILE / 2 };
    const float x = node->toward[0], y = node->toward[1], z = node->toward[2];
    const float red = node->radiance[0], green = node->radiance[1], blue = node->radiance[2];
    const float alpha2 = t->alpha2, least = 4.0f * alpha2, slope = 1.0f - alpha2;
    const float solid_angle = node->solid_angle * 8.0f * alpha2 * alpha2;
    for (int i = 0; i < HALF; i++) {
        const float off = chord2(t, i, x, y, z), other_off = chord2(t, i + HALF, x, y, z);
        const float wide = off * slope + least, other_wide = other_off * slope + least;
        const float c = 2.0f - off, other_c = 2.0f - other_off;
        const float wide2 = wide * wide, other_wide2 = other_wide * other_wide;
        const float share = solid_angle / (wide2 * other_wide2);
        const float weight = (c > 0.0f ? c : 0.0f) * (share * other_wide2);
        const float other = (other_c > 0.0f ? other_c : 0.0f) * (share * wide2);
        t->sum[0][i] += weight * red;
        t->sum[1][i] += weight * green;
        t->sum[2][i] += weight * blue;
        t->weight[i] += weight;
        t->sum[0][i + HALF] += other * red;
        t->sum[1][i + HALF] += other * green;
        t->sum[2][i + HALF] += other * blue;
        t->weight[i + HALF] += other;
    }
}
