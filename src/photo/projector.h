/* photo/projector.h - throw, image size and brightness of a projector. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_PROJECTOR_H
#define LENSCALC_PHOTO_PROJECTOR_H

#include "base/error.h"

/* A projector and its screen; NaN = not given, to be found where it can be. */
struct projector {
    double throw_ratio;             /* distance over width of the image, > 0 */
    double distance;                /* lens to screen, mm, > 0 */
    double aspect;                  /* width over height of the image, > 0; always given */
    double width, height, diagonal; /* of the image, mm, > 0; at most one is given */
    double gain;                    /* of the screen along its normal, > 0; always given */
    double flux;                    /* lm, > 0 */
    double illuminance;             /* on the screen, lx, > 0 */
    double luminance;               /* of white, cd/m2, > 0 */
};

/*
 * Complete what is known of a projector: image size, throw and light each as far as they are given.
 *
 * Given     projector  of width, height and diagonal at most one; of flux, illuminance and
 *                      luminance one, or flux and another, which then give the image size
 * Result    projector  complete but for what nothing was given of: NaN
 * Formula   W = d a/sqrt(1 + a^2) = h a; R = D/W; E = Phi/(W h); L = G E/pi, in foot-lamberts
 *           G times lumens over square feet
 * Source    definitions: the throw ratio is that of makers; a screen of gain 1 is a perfect
 *           Lambertian diffuser, L = E/pi
 * Errors    ERROR_USAGE: too much or too little is given; ERROR_DOMAIN: a number not above 0
 * Limits    the flux falls evenly on the image and on nothing else; the gain is that on the axis.
 *           Throws of ultra-short lenses count from the mirror
 */
bool projector_solve(struct projector *projector, struct error *error);

#endif
