/* exchange/zemax/zemax_user_aperture.h - apertures of .zmx files that stand in .uda files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_ZEMAX_ZEMAX_USER_APERTURE_H
#define LENSCALC_EXCHANGE_ZEMAX_ZEMAX_USER_APERTURE_H

#include "exchange/zemax/zemax_parse.h"
#include "optics/aperture.h"

/*
 * The shapes of the file that USAP, USOB or UDAD name, from the folder of the lens file: polygons
 * (LIN x y, or x y, up to BRK, or in old files to 0 0) and circles (CIR x y r).
 *
 * Given     apertures, count  receive them, in the frame of the surface
 * Source    public readers and writers of such files (acorn, kgpy); that a circle may have a number
 *           of sides behind its radius, of which it is drawn
 * Result    false without an error: they are lost, which is said
 * Errors    a loss: no such file, other words, several shapes of which one is to pass light
 */
bool zemax_user_apertures(struct zemax_file *file, const struct zemax_surface *from,
                          struct aperture **apertures, size_t *count, struct error *error);

#endif
