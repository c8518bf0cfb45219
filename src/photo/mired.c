/* photo/mired.c - colour temperatures, and the filters that turn one into another. */
/* SPDX-License-Identifier: MIT */
#include "photo/mired.h"

#include "photo/given.h"

#include <math.h>

static bool check_temperature(double T, struct error *error)
{
    return require_within("colour temperature", " K", T, 500, 100000, error);
}

bool mired_shift(double from, double to, double *shift, struct error *error)
{
    *shift = 1e6 / to - 1e6 / from;
    return check_temperature(from, error) && check_temperature(to, error);
}

bool mired_filtered(double from, double shift, double *to, struct error *error)
{
    double mired = 1e6 / from + shift;
    *to = 1e6 / mired;
    return check_temperature(from, error) &&
           (mired > 0 || fail(error, ERROR_DOMAIN,
                              "filters of %.4g mired make light of %.6g K bluer than any colour "
                              "temperature",
                              shift, from));
}

double mired_transmittance(double shift, double wavelength)
{
    static const double c2 = 14387.77, middle = 0.555;
    return exp(-1e-6 * shift * c2 * (1 / wavelength - 1 / middle));
}
