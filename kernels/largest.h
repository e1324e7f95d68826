/* The largest numbers that lighting takes, and why nothing that is not finite leaves it (docs/input.md).
 *
 * Beyond them input is refused, or of pixels repaired, where it enters. Behind that:
 *
 *   1. Places. Coordinates of surfaces are up to 1e18 m in view space, those of lights up to
 *      (sqrt(3) + 1) 1e18 m, for the camera stands up to 1e18 m from the origin: they differ by 3.8e18 m,
 *      and a squared distance is 4.4e37 at most.
 *   2. A light's colour is cut at 1e30 once it is multiplied by intensity and lobe, and again by its
 *      texture. Its weight is 1e4 at most: 1 cm away, or by its table.
 *   3. What a lobe makes of that is 1e26 at most. Ward's and Cook and Torrance's are the largest: the
 *      quotient by cos^4 is below 2^40 (gaussian_slopes), that by alpha^2 is 1/4 over 2e-4, and the third
 *      2^20 (TL_LEAST_HALF2, TL_LEAST_FACING); metal-rough has 2500/1e-12.
 *   4. So a light adds a finite number >= 0 times a finite number >= 0: one that is >= 0, or infinite, never
 *      NaN; and so are sums of them.
 *   5. What is received is multiplied by colours >= 0, and by one that is 0 to 0 (pixel.h). What comes out
 *      is cut at the largest float, in double too: a value that was cut is that number, and no other is. */
#ifndef TL_LARGEST_H
#define TL_LARGEST_H

/* m, each coordinate; of an edge of a perspective camera m per m of depth */
#define TL_FARTHEST 1e18f
/* Of a light: cd, lx; of emission, ambient light and sky: radiance. */
#define TL_BRIGHTEST 1e30f
/* Of a normal, a tangent or a direction, its largest part: squares neither overflow nor vanish in float. */
#define TL_SHORTEST 1e-18f
#define TL_LONGEST 1e18f
/* What the weight of a light and a lobe come to. */
#define TL_MOST_OF_LIGHT 1e26

#endif
