/* exchange/zemax/zemax_user_aperture.h - polygons and circles of .zmx and .uda files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_USER_APERTURE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_USER_APERTURE_H

#include "exchange/zemax/zemax_parse.h"
#include "optics/aperture.h"

/*
 * The shapes of the file that USAP, USOB or UDAD name, as UDAD has them row by row (UDAD 1 x y 0,
 * where 0 0 ends a polygon), else from the folder of the lens file: polygons (LIN x y, or x y, up
 * to BRK, or in old files to 0 0) and circles (CIR x y r).
 *
 * Given     apertures, count  receive them, in the frame of the surface
 * Source    rows of UDAD in sample files of the program (a slit, a grating); public readers and
 *           writers of such files (acorn, kgpy); that a circle may have a number of sides behind
 *           its radius, of which it is drawn
 * Result    false without an error: they are lost, which is said
 * Errors    a loss: no such file, a row of another form, other words, several shapes of which one
 *           is to pass light, but polygons apart in x or y, which become one
 */
bool zemax_user_apertures(struct zemax_file *file, const struct zemax_surface *from,
                          struct aperture **apertures, size_t *count, struct error *error);

#endif
