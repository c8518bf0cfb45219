/* optics/medium.h - what lies behind a surface, and its index of refraction. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_MEDIUM_H
#define LENSCALC_OPTICS_MEDIUM_H

#include "base/arena.h"
#include "base/error.h"
#include "base/pair.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

enum medium_kind {
    MEDIUM_CONSTANT, /* one index at all wavelengths; air is 1 */
    MEDIUM_MODEL,    /* nd and Vd */
    MEDIUM_TABLE,    /* index at some wavelengths */
    MEDIUM_GLASS     /* of a catalogue */
};

/* The index of a catalogue glass. `glass` is what the catalogue's reader put into the medium. */
typedef bool medium_index_function(const void *glass, double wavelength, struct pair *index,
                                   struct error *error);

/* Index of refraction at one wavelength. */
struct index_point {
    double wavelength; /* um */
    struct pair index;
};

struct medium {
    enum medium_kind kind;
    struct text written;              /* as typed: "air", "1.670/47.1", "SCHOTT:N-BK7" */
    struct pair index;                /* of a constant; nd of a model */
    struct pair abbe;                 /* Vd of a model */
    const struct index_point *points; /* of a table, by rising wavelength; in the lens's arena */
    size_t point_count;
    medium_index_function *glass_index; /* of a glass; null = nobody knows it */
    const void *glass;
    double density;      /* of a glass, g/cm^3; 0 = not known */
    double price;        /* of a glass, of a mass beside that of a usual crown; 0 = not known */
    const char *warning; /* what is doubtful in the data of a glass; null = nothing */
};

extern const struct medium medium_air;

bool medium_is_air(const struct medium *medium);

/* Are they written alike? */
bool medium_is_same(const struct medium *a, const struct medium *b);

/*
 * Index of refraction.
 *
 * Given     wavelength  um
 *           index       receives n, relative to air, above 0
 * Formula   model: as glass_nd_vd
 *           table: polynomial in 1/l^2 through the three nearest points (two: a line, one: the
 *           index itself at all wavelengths)
 * Errors    ERROR_DOMAIN: outside the table's or the glass's range, a model below 100 nm, an index
 *           of 0 or less, a glass that is in no catalogue
 */
bool medium_index(const struct medium *medium, double wavelength, struct pair *index,
                  struct error *error);

/* -------- a medium whose index and dispersion are a little off -------- */

enum { MELT_WAVELENGTHS = 12 }; /* whose index is kept; of others it is found anew */

/* A medium, and what was melted in its place. */
struct melt {
    struct medium base, now;
    bool has_abbe;    /* else the index changes by the same at all wavelengths */
    double nd, Vd;    /* of the base */
    double by, scale; /* n' = nd + by + (n - nd) scale */
    int count;        /* of the wavelengths that were asked for */
    double wavelengths[MELT_WAVELENGTHS];
    struct pair indices[MELT_WAVELENGTHS];
};

/* Given     base  any medium but a mirror; its own nd and Vd are those at the lines d, F and C */
void melt_open(const struct medium *base, struct melt *melt);

/*
 * Change it.
 *
 * Given     index, abbe  what is added to nd and Vd
 * Result    a medium, until the next call; of no change the base itself
 * Formula   n'(l) = nd' + (n(l) - nd) (nd' - 1)/(nd - 1) Vd/Vd': all dispersion in proportion; of a
 *           model nd/Vd that is the model of nd'/Vd', whose dispersion is (nd - 1)/Vd times a
 *           function of the wavelength
 * Source    derived here
 */
const struct medium *melt_set(struct melt *melt, double index, double abbe);

/*
 * The medium as a .lens file holds it.
 *
 * Given     wavelengths  um, at which it has its index there; in any order
 * Result    a number, nd/Vd, or a table
 */
struct text melt_written(struct melt *melt, const double *wavelengths, size_t count,
                         struct arena *arena);

#endif
