/* exchange/own_glass.h - indices of a file under the name of a catalogue glass. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_OWN_GLASS_H
#define LENSCALC_EXCHANGE_OWN_GLASS_H

#include "exchange/foreign.h"

/* A glass of a file, by name and by indices; the program means the indices. */
struct own_glass {
    struct foreign_job *job;
    struct lens_build *build;
    struct text name;
    const double *wavelengths; /* um, at which the file has indices */
    size_t count;
    double rounding; /* of the indices */
};

/* How far a typed index may be from what it stands for: half of its last digit, at most 5e-5. */
double own_glass_rounding(const struct figure *index);

/*
 * Say where the file's indices are not those of the catalogue's glass, beyond rounding, with both
 * at the wavelength where they differ most.
 *
 * Given     found   the catalogue's glass
 *           medium  with the file's indices; receives found, with --glass-numbers catalog
 */
void own_glass_compare(const struct own_glass *own, const struct medium *found,
                       struct medium *medium);

#endif
