/* tone/operator.h - light of a scene to that of a display. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_OPERATOR_H
#define LENSCALC_TONE_OPERATOR_H

#include "tone/histogram.h"

enum tone_operator { TONE_LINEAR, TONE_GAMMA, TONE_FILMIC, TONE_WARD };

/* John Hable's curve: its white, and what a middle grey is there. */
#define FILMIC_WHITE 11.2
#define TONE_GREY    0.18

struct tone_way {
    enum tone_operator operation;
    enum histogram_ceiling ceiling; /* of TONE_WARD */
    double white; /* cd/m^2 that become the display's most; NaN: chosen. Not of TONE_WARD */
    double gamma; /* of TONE_GAMMA, > 0 */
    struct display display;
    bool as_light; /* the result is cd/m^2; else shares of the display's range */
};

/* What became of it. */
struct toned {
    double white;               /* that of the way, or the one chosen */
    double log_mean;            /* exp of the mean of ln L, cd/m^2 */
    struct histogram histogram; /* of TONE_WARD */
    size_t clipped;             /* pixels brighter than white */
};

/*
 * Show a picture, in place.
 *
 * Given     foveal  its samples, of which are the log mean and the histogram
 *           image   linear sRGB, three channels, cd/m^2; becomes that of the display, linear
 * Formula   with s = L/white and the display's range l..m: LINEAR L_d = m s; GAMMA m s^(1/gamma);
 *           FILMIC each channel m h(11.2 s)/h(11.2), h(x) = (x (A x + C B) + D E)/(x (A x + B) + D
 *           F) - E/F, A 0.15, B 0.5, C 0.1, D 0.2, E 0.02, F 0.3; WARD histogram_shown. A share is
 *           (L_d - l)/(m - l). Of all but FILMIC the colours of a pixel keep their proportions, or
 *           are mixed with as bright a grey as far as the display cannot show them
 *           White, where it is chosen: LINEAR what makes the log mean TONE_GREY of it, GAMMA
 *           what makes it s^(1/gamma) = TONE_GREY, FILMIC 11.2/2 times that of LINEAR
 * Source    [Hable10] for h, which takes a white paper for x = 2
 * Errors    as histogram_adjust
 * Limits    curves are tables of 256 steps an octave, with straight lines between: within 1e-6,
 *           and 1e-3 where the curve has a corner
 */
bool tone_show(const struct tone_way *way, const struct foveal *foveal, struct image *image,
               struct arena *arena, struct toned *toned, struct error *error);

#endif
