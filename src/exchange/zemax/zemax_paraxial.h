/* exchange/zemax/zemax_paraxial.h - the ideal thin lens of a .zmx file, as a thick lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_PARAXIAL_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_PARAXIAL_H

#include "exchange/zemax/zemax_parse.h"

/*
 * A surface of the type PARAXIAL: a thick lens whose principal planes fall together.
 *
 * Given     focal  PARM 1 after its pick-up: 1/power in any media, mm
 *           to     receives it; its medium and place are set already
 * Formula   n' u' = n u - h/f with u the tangents, as thick_lens_slope
 * Errors    ERROR_DATA: no focal length, or 0; a mirror; further parameters, unless lossy.
 *           PARM 2 says how paths are counted, and moves no ray
 */
bool zemax_set_paraxial(struct zemax_file *file, const struct zemax_surface *from,
                        struct figure focal, struct surface *to, struct error *error);

#endif
