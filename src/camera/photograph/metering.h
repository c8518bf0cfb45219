/* camera/photograph/metering.h - the mean light on a film: by rays from it, and by rays to what shines. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_METERING_H
#define LENSCALC_CAMERA_PHOTOGRAPH_METERING_H

#include "camera/photograph/tile_rays.h"

struct metering_question {
    const struct tile_rays *rays; /* their subject is a scene */
    double width, height;         /* of the film, mm */
    double scale;                 /* of irradiance: (n'/n)^2 */
};

struct metered {
    double mean[TILE_CHANNELS]; /* illuminance of the film by channel, lx */
    double error;               /* standard error of its luminance, as a share of it */
    bool is_direct;             /* by rays to lights, too */
};

/*
 * Meter.
 *
 * Given     scratch  of one thread; its sums are used, its counts stay
 * Result    of 16384 rays all over the film, and from the middle of the entrance pupil 4096 to
 *           things that shine and as many to suns and stars, 8 each at least: the same for every
 *           crop and number of samples. Small lights, which few of the former meet, are found by
 *           the latter. The error is of 8 parts of all, each with rays enough for all of 64 bands
 * Formula   E = L (E/L)(r) (dA/dw)/A, with r where the chief ray of that direction meets the film,
 *           dA/dw by these rays, and A the film's area; what both find is weighed by the squares of
 *           their densities
 * Source    [Veach97] section 9.2.3 (power heuristic); derived here: a light of the solid angle dw
 *           that is seen directly has an image of the area dA
 * Limits    only rays from the film, which meet small lights by chance, where the lens is not round
 *           or is telecentric in the scene, or where things move before a shutter that is not
 *           global. Else of things that shine near the lens parallax over the pupil is left out,
 *           of lights at the film's border their blur, and coma: what offends against the sine
 *           condition, as a parabola of f/4 with its whole rim by 0.8 %, is as far off
 */
void metering_take(const struct metering_question *question, struct arena *arena,
                   struct tile_scratch *scratch, struct metered *metered);

#endif
