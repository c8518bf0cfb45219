/* exchange/pbrt.h - lens tables of the realistic camera of pbrt. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_PBRT_H
#define LENSCALC_EXCHANGE_PBRT_H

#include "exchange/foreign.h"

/*
 * The .dat tables of pbrt-v3 and pbrt-v4: numbers in fours, from the front to the film: radius,
 * distance to the next, index behind (0 is air), clear diameter; in mm; # comments. Radius 0 is the
 * stop, a plane that does not refract. The first comment is the title, the others are notes.
 *
 * Refused   reading: radius 0 between two media, a second stop, numbers that are not in fours, a
 *           diameter or index below 0.
 *           writing: mirrors, cylinders, a surface without diameter, a medium in front of the lens
 * Lost      writing: what is not of those four numbers. Dispersion: the index at the primary
 *           wavelength is written. A plane that refracts becomes a radius of 100 m: pbrt's floats
 *           have no place for a longer one; of a stop that refracts the same before it
 * Source    pbrt-v4, lens description files and the comments of RealisticCamera
 */
extern const struct foreign_format pbrt_format;

#endif
