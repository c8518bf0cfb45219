/* photo/stops.c - light lost on the way to the film, in stops; shutter angles. */
/* SPDX-License-Identifier: MIT */
#include "photo/stops.h"

#include "base/constants.h"

#include <math.h>

#include "photo/given.h"

static const double log10_of_2 = 0.30102999566398119521;

double stops_from_density(double D)
{
    return D / log10_of_2;
}

double stops_from_factor(double F)
{
    return log2(F);
}

double stops_from_transmittance(double transmittance)
{
    return -log2(transmittance);
}

bool check_transmittance(double transmittance, struct error *error)
{
    return (transmittance > 0 && transmittance <= TRANSMITTANCE_MOST) ||
           fail(error, ERROR_DOMAIN, "{transmittance} %.10g must lie above 0 and up to %g",
                transmittance, TRANSMITTANCE_MOST);
}

bool t_stop(double N, double transmittance, double *T, struct error *error)
{
    *T = N / sqrt(transmittance);
    return require_positive("f-number", "", N, error) && check_transmittance(transmittance, error);
}

bool transmittance_from_t_stop(double N, double T, double *transmittance, struct error *error)
{
    if (!require_positive("f-number", "", N, error) || !require_positive("T-stop", "", T, error)) {
        return false;
    }
    if (!(T >= N)) {
        return fail(error, ERROR_DOMAIN, "{T-stop} %.10g must not lie below {the f-number} %.10g",
                    T, N);
    }
    *transmittance = (N / T) * (N / T);
    return true;
}

/* Loss of the lens itself: absorption and extension. */
static bool lens_loss(const struct light_loss *loss, double *stops, struct error *error)
{
    *stops = 0;
    if (is_given(loss->transmittance)) {
        if (!check_transmittance(loss->transmittance, error)) {
            return false;
        }
        *stops += stops_from_transmittance(loss->transmittance);
    }
    if (is_given(loss->m)) {
        const double P = is_given(loss->P) ? loss->P : 1, stretch = 1 + loss->m / P;
        if (!check_not_negative("magnification", "", loss->m, error) ||
            !require_positive("pupil magnification", "", P, error)) {
            return false;
        }
        *stops += 2 * log2(stretch);
    }
    return true;
}

bool light_loss(const struct light_loss *loss, double *stops, struct error *error)
{
    double density = is_given(loss->density) ? loss->density : 0;
    double factor = is_given(loss->factor) ? loss->factor : 1;
    double extra = is_given(loss->stops) ? loss->stops : 0;
    double lens = 0;
    /* 30 densities or 100 stops are past anything that passes light at all */
    if (!require_within("density", "", density, 0, 30, error) ||
        !require_within("filter factor", "", factor, 1, 1e30, error) ||
        !require_within("light loss", " stops", extra, 0, 100, error) ||
        !lens_loss(loss, &lens, error)) {
        return false;
    }
    *stops = stops_from_density(density) + stops_from_factor(factor) + extra + lens;
    return true;
}

bool shutter_solve(struct shutter *shutter, struct error *error)
{
    const struct given numbers[] = {{"shutter angle", " rad", shutter->angle},
                                    {"frame rate", " fps", shutter->rate},
                                    {"exposure time", " s", shutter->t}};
    if (given_missing(numbers, 3) != 1) {
        return fail(error, ERROR_USAGE,
                    "give exactly two of {shutter angle}, {frame rate} and {exposure time}");
    }
    if (!given_positive(numbers, 3, error)) {
        return false;
    }
    if (!is_given(shutter->t)) {
        shutter->t = shutter->angle / (2 * PI * shutter->rate);
    } else if (!is_given(shutter->rate)) {
        shutter->rate = shutter->angle / (2 * PI * shutter->t);
    } else {
        shutter->angle = 2 * PI * shutter->rate * shutter->t;
    }
    /* 1e-12: an angle of 360 deg may arrive with rounding from 1/24 s at 24 fps */
    return shutter->angle <= 2 * PI * (1 + 1e-12) ||
           fail(error, ERROR_DOMAIN,
                "a shutter angle of %.10g deg exceeds 360 deg: the exposure is longer than "
                "the frame",
                shutter->angle * DEGREES_PER_RADIAN);
}
