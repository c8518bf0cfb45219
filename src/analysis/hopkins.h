/* analysis/hopkins.h - contrast as the overlap of an exit pupil with itself. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_HOPKINS_H
#define LENSCALC_ANALYSIS_HOPKINS_H

#include "analysis/exit_lines.h"

#include <stdbool.h>

/* Integrals over the overlap: with the wave front, complex, and with a perfect one. */
struct overlap {
    double re, im, perfect;
    double error; /* of each */
    bool has_converged;
};

/*
 * The pupil, and the same moved along its lines.
 *
 * Given     shift  in a and b, 0 and more: wavelength times frequency over the index
 *           error  that is wanted, in shares of pupil->energy
 * Formula   integral of A1 A2 exp(2 pi i (W1 - W2)) over what is clear at both, 1 at half the shift
 *           against the lines, 2 along them: so that its angle is that of the Fourier transform of
 *           the light over the image, which counts from the reference. Gauss's points along clear
 *           parts of lines and across them, between places where the parts change, ever more until
 *           the error is met
 * Source    [Hopkins55]; tested against the closed form of a round pupil, and Fourier transforms
 */
struct overlap overlap_find(const struct exit_pupil *pupil, const struct exit_lines *lines,
                            double shift, double error, struct arena *arena);

#endif
