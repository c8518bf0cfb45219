/* analysis/waves/hopkins.h - contrast as the overlap of an exit pupil with itself. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_HOPKINS_H
#define LENSCALC_ANALYSIS_WAVES_HOPKINS_H

#include "analysis/waves/exit_front.h"
#include "trace/aim/sample.h"

#include <stdbool.h>
#include <stddef.h>

/* Is there an overlap to be found, where the front's series leave so much of it (`off`)? */
bool overlap_is_known(double off);

/*
 * Integrals over the overlap: with the wave front, complex, and with a perfect one. NaN: not known,
 * their error is infinite, or not asked for.
 */
struct overlap {
    double re, im, perfect;
    double error; /* of each */
    bool has_converged;
};

/*
 * The pupil, and the same moved along its lines.
 *
 * Given     shift         in a and b, 0 and more: wavelength times frequency over the index
 *           error         that is wanted, in shares of the pupil's energy
 *           only_perfect  the wave front is not asked for
 * Formula   integral of A1 A2 exp(2 pi i (W1 - W2)) over what is clear at both, 1 at half the shift
 *           against the lines, 2 along them: so that its angle is that of the Fourier transform of
 *           the light over the image, which counts from the reference. Gauss's points along clear
 *           parts of lines and across them, between places where the parts change, as many as
 *           W1 - W2 turns the phase, ever more until the error is met, or a quarter of what the
 *           front's series leave: points do not make up for these
 * Source    [Hopkins55]; tested against the closed form of a round pupil, and Fourier transforms
 * Limits    16 million points: where W1 - W2 turns the phase some thousands of times each way, or
 *           is so rough that its series fail, the integrals are not known
 */
struct overlap overlap_find(const struct exit_front *front, struct gauss_rules *rules, double shift,
                            double error, bool only_perfect);

#endif
