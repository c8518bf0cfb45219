/* optics/melt.h - a medium whose index and dispersion are a little off. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_MELT_H
#define LENSCALC_OPTICS_MELT_H

#include "base/arena.h"
#include "optics/medium.h"

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
