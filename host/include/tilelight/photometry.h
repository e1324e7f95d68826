/* Photometry of a luminaire: luminous intensity by direction, as files of LM-63 hold it.
 *
 * Directions are angles of type C: `vertical` from the nadir, straight down, 0 to 180 degrees; `horizontal`
 * around it, 0 to 360, against the clock as seen from above. Between a file's angles intensity is linear in
 * both. Where a file has fewer planes than the whole circle, the others are their mirror images; beyond its
 * vertical angles it is dark. */
#ifndef TL_PHOTOMETRY_H
#define TL_PHOTOMETRY_H

#include "lights.h"

#ifdef __cplusplus
extern "C" {
#endif

/* X(name, first line of the file, what info calls it) */
#define TL_IES_EDITIONS(X)                           \
    X(TL_IES_1986, "", "LM-63-1986")                 \
    X(TL_IES_1991, "IESNA91", "LM-63-1991")          \
    X(TL_IES_1995, "IESNA:LM-63-1995", "LM-63-1995") \
    X(TL_IES_2002, "IESNA:LM-63-2002", "LM-63-2002") \
    X(TL_IES_2019, "IES:LM-63-2019", "LM-63-2019")

typedef enum tl_ies_edition {
#define TL_IES_EDITION_NAME(name, line, word) name,
    TL_IES_EDITIONS(TL_IES_EDITION_NAME)
#undef TL_IES_EDITION_NAME
        TL_IES_EDITION_COUNT
} tl_ies_edition;

extern const char *const tl_ies_edition_words[TL_IES_EDITION_COUNT];

/* Which planes a file has, by its first and last horizontal angle.
 * X(name, what info calls it) */
#define TL_PHOTOMETRY_SYMMETRIES(X)                          \
    X(TL_SYMMETRY_AXIAL, "the same all around")              \
    X(TL_SYMMETRY_QUADRANT, "four quadrants alike")          \
    X(TL_SYMMETRY_ALONG, "two halves, alike beside 0-180")   \
    X(TL_SYMMETRY_ACROSS, "two halves, alike beside 90-270") \
    X(TL_SYMMETRY_NONE, "no symmetry")

typedef enum tl_photometry_symmetry {
#define TL_SYMMETRY_NAME(name, word) name,
    TL_PHOTOMETRY_SYMMETRIES(TL_SYMMETRY_NAME)
#undef TL_SYMMETRY_NAME
        TL_SYMMETRY_COUNT
} tl_photometry_symmetry;

extern const char *const tl_photometry_symmetry_words[TL_SYMMETRY_COUNT];

/* All zero is empty; release with tl_photometry_clear. */
typedef struct tl_photometry {
    tl_ies_edition edition;
    tl_photometry_symmetry symmetry;
    double lamp_lumens; /* of all lamps; below 0: absolute photometry, the file claims none */
    double factor;      /* multiplier and ballast factors, which are in `candela` */
    double seam; /* cd that the plane at 360 degrees differed from that at 0, which counts */
    size_t vertical_count, horizontal_count;
    double *vertical, *horizontal; /* degrees, ascending; owned */
    double *candela;               /* [horizontal_count][vertical_count], >= 0; owned */
} tl_photometry;

#define TL_MOST_PHOTOMETRY_ANGLES 2048       /* each way */
#define TL_IES_TEXT_LIMIT ((size_t)16 << 20) /* bytes of a file */

/* A file of LM-63-1986, 1991, 1995, 2002 or 2019, of type C. Fails with TL_ERR_FORMAT, in a sentence that
 * names `source`, the line and what was expected there; with TL_ERR_UNSUPPORTED for photometry of types A and
 * B, and for a tilt that stands in another file; with TL_ERR_MEMORY. *out is replaced on success. */
tl_status tl_photometry_parse(
    const char *text, size_t size, const char *source, tl_photometry *out, tl_error *err);

/* Leaves it empty. Accepts an empty one. */
void tl_photometry_clear(tl_photometry *photometry);

/* Candela in a direction; degrees, vertical 0 to 180, horizontal 0 to 360. */
double tl_photometry_at(const tl_photometry *photometry, double horizontal, double vertical);

double tl_photometry_peak(const tl_photometry *photometry); /* cd */

/* Lumens: the integral over all directions, exact but for rounding in double. */
double tl_photometry_flux(const tl_photometry *photometry);

/* The same on an even grid, as lights have it; with path NULL. Where all angles are multiples of a step that
 * does not make the grid too large, it is the same function; else *out says how far it is off. The caller
 * releases out->shares. Fails with TL_ERR_MEMORY. */
tl_status tl_photometry_resample(const tl_photometry *photometry,
                                 tl_light_profile *out,
                                 tl_error *err);

#ifdef __cplusplus
}
#endif

#endif
