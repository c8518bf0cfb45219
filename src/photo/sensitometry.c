/* photo/sensitometry.c - light on the film or sensor, and the speeds defined from it. */
/* SPDX-License-Identifier: MIT */
#include "photo/sensitometry.h"

#include <math.h>

#include "photo/given.h"
#include "photo/stops.h"

static const double quarter_pi = 0.78539816339744830962;

bool lens_q(double T, double v, double theta, double *q, struct error *error)
{
    if (!check_transmittance(T, error)) {
        return false;
    }
    if (!(v > 0 && v <= 1)) {
        return fail(error, ERROR_DOMAIN, "{vignetting} %.10g must lie above 0 and up to 1", v);
    }
    if (!(theta >= 0 && theta < 2 * quarter_pi)) {
        return fail(error, ERROR_DOMAIN, "{field angle} %.10g deg must lie from 0 to below 90 deg",
                    theta * 45 / quarter_pi);
    }
    double c2 = cos(theta) * cos(theta);
    *q = quarter_pi * T * v * c2 * c2;
    return true;
}

bool focal_plane_exposure(double q, double L, double N, double t, double loss, double *H,
                          struct error *error)
{
    if (!(q > 0 && q <= quarter_pi * TRANSMITTANCE_MOST)) {
        return fail(error, ERROR_DOMAIN, "q %.10g must lie above 0 and up to %.4g", q,
                    quarter_pi * TRANSMITTANCE_MOST);
    }
    *H = q * L * t / (N * N) * exp2(-loss);
    return require_positive("luminance", " cd/m^2", L, error) &&
           require_positive("f-number", "", N, error) &&
           require_positive("exposure time", " s", t, error) &&
           require_within("light loss", " stops", loss, LOSS_LEAST, 200, error) &&
           answer_positive("the focal-plane exposure", *H, error);
}

double saturation_speed(double H)
{
    return 78 / H;
}

double saturation_exposure(double S)
{
    return 78 / S;
}

double recommended_exposure(double S)
{
    return 10 / S;
}
