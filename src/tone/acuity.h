/* tone/acuity.h - a picture as sharp, and as coloured, as an eye sees it in its light. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_ACUITY_H
#define LENSCALC_TONE_ACUITY_H

#include "tone/foveal.h"

/*
 * Take away what is too fine for the eye.
 *
 * Given     foveal  the luminance that the eye is used to, between its cells in straight lines
 *           image   linear sRGB, three channels, cd/m^2
 *           made    receives it
 * Formula   pixels are means of 2^n x 2^n, between two n and between four of them in straight
 *           lines, so large that two of them are a cycle of sight_acuity; a pixel is as large as in
 *           the middle of the picture; of pixels that are not square first means that are, along
 *           their shorter side
 * Source    [WardLarson97]: variable resolution filtering by a pyramid
 * Errors    as image_new
 */
bool acuity_blur(const struct foveal *foveal, const struct image *image, struct arena *arena,
                 struct image *made, struct error *error);

/*
 * Take away the colours that rods do not see, in place.
 *
 * Formula   with c = (L - SIGHT_SCOTOPIC)/(SIGHT_PHOTOPIC - SIGHT_SCOTOPIC), held in 0..1, of each
 *           pixel: c of its colour and 1 - c of a grey of sight_scotopic
 * Source    [WardLarson97]
 */
void acuity_fade(struct image *image);

#endif
