/* scene/sky.h - how bright a sky is, from horizon to zenith and about the sun. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SKY_H
#define LENSCALC_SCENE_SKY_H

#include "scene/scene.h"

/*
 * Luminance of the sky as a share of that in the zenith.
 *
 * Given     sky  uniform, overcast or clear: CIE's types 5, 1 and 12
 *           sun  towards it, of length 1; of a clear sky
 *           way  where one looks, of length 1, y up
 * Result    0 on the horizon and below it
 * Formula   f(X) g(Z)/(f(Zs) g(0)), g(Z) = 1 + a e^(b/cos Z), f(X) = 1 + c (e^(d X) - e^(d pi/2)) +
 *           e cos^2 X, with the angles Z and Zs of the way and the sun from the zenith and X
 *           between them; overcast a = 4, b = -0.7, c = 0; clear a = -1, b = -0.32, c = 10, d = -3,
 *           e = 0.45
 * Source    [ISO15469] 4 and table 1
 */
double sky_share(enum scene_sky sky, struct vector sun, struct vector direction);

#endif
