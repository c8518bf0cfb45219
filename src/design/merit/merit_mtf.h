/* design/merit/merit_mtf.h - contrast at a spatial frequency as an operand. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_MTF_H
#define LENSCALC_DESIGN_MERIT_MERIT_MTF_H

#include "analysis/waves/pupil_wave.h"
#include "design/merit/merit_beams.h"

/*
 * mtf, gmtf: of the field of the operand or of each one, tangential, sagittal or both: what
 * analysis/image/mtf.h says of the whole pupil, all wavelengths by their weights, or of that of the
 * operand.
 *
 * Formula   |sum w S|/sum w E, by wavelengths: of mtf S by pupil_overlap_find and E the area of
 *           the beam; of gmtf sums over rays of areas of the beam times exp(-2 pi i f x), and of
 *           areas. Below 1e-6, where |S| has no derivative, (|S|^2/1e-6 + 1e-6)/2. Of fields with a
 *           weight residuals count by its root
 * Errors    of merit_prepare_mtf: as merit_beams_open; points of another pattern than gauss, or
 *           clipped ones; more than 1000 rays; a frequency not of 1e-6 to 1e6/mm, or of mtf beyond
 *           the cut-off. Of merit_fill_mtf: a ray that is lost, or cannot be aimed; as
 *           pupil_wave_find
 * Limits    beyond the cut-off of the lens as it is now there is no contrast, nor a derivative
 */
merit_fill merit_fill_mtf;
merit_prepare merit_prepare_mtf;

/* The contrast |S| itself, of what the operand makes of it. */
double merit_mtf_contrast(double operand);

/*
 * What the contrast of a group's field in a direction is by its rays, for tests: of the last
 * evaluation with derivatives.
 *
 * Given     direction  0 tangential, 1 sagittal
 */
struct merit_mtf_look {
    const struct merit_bundle *bundle;
    const double *back[PUPIL_PARTS];
};
struct merit_mtf_look merit_mtf_look(const struct merit_slot *slot, size_t group, int direction);

#endif
