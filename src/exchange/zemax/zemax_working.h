/* exchange/zemax/zemax_working.h - the working f-number of a near object in .zmx files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_WORKING_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_WORKING_H

#include "exchange/zemax/zemax_parse.h"

/*
 * FNUM N 1 is the paraxial working f-number; of a near object it becomes the diameter of the
 * entrance pupil that gives it.
 *
 * Given     file  its lens is complete but for this aperture
 * Formula   N = 1/(2 n' |u'|), with u' of the paraxial marginal ray behind the last surface, which
 *           grows with the diameter: D = N(D = 1 mm)/N
 * Source    [OpticStudio25], paraxial working F/#
 * Errors    ERROR_DATA: a lens without entrance pupil or image, unless lossy: it gets no aperture
 */
bool zemax_set_working_aperture(struct zemax_file *file, struct error *error);

#endif
