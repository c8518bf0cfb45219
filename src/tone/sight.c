/* tone/sight.c - what the eye sees: contrast, detail and colour by the light it is used to. */
/* SPDX-License-Identifier: MIT */
#include "tone/sight.h"

#include "light/colour.h"

#include <math.h>

double sight_threshold(double adaptation)
{
    const double x = log10(adaptation);
    double log_threshold = x - 1.255;
    if (x < -3.94) {
        log_threshold = -2.86;
    } else if (x < -1.44) {
        log_threshold = pow(0.405 * x + 1.6, 2.18) - 2.86;
    } else if (x < -0.0184) {
        log_threshold = x - 0.395;
    } else if (x < 1.9) {
        log_threshold = pow(0.249 * x + 0.65, 2.7) - 0.72;
    }
    return pow(10, log_threshold);
}

double sight_acuity(double adaptation)
{
    return 17.25 * atan(1.4 * log10(fmax(adaptation, SIGHT_LEAST)) + 0.35) + 25.72;
}

static double rods(struct colour xyz)
{
    const double X = xyz.part[0], Y = xyz.part[1], Z = xyz.part[2];
    return X > 0 ? fmax(0, Y * (1.33 * (1 + (Y + Z) / X) - 1.68)) : 0;
}

double sight_scotopic(const double rgb[3])
{
    const struct colour white = colour_turned(&colour_xyz_of_srgb, (struct colour){{1, 1, 1}});
    const struct colour xyz =
        colour_turned(&colour_xyz_of_srgb, (struct colour){{rgb[0], rgb[1], rgb[2]}});
    return rods(xyz) / rods(white);
}
