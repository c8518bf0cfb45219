/* optics/air.c - refractive index of air, and of a glass that is not at its reference state. */
/* SPDX-License-Identifier: MIT */
#include "optics/air.h"

#include <math.h>

const struct word air_models[] = {
    {"edlen", "Edlen 1966"},
    {"ciddor", "Ciddor 1996, by Edlen's factor of density"},
    {"kohlrausch", "as in programs with AGF catalogues"},
    {NULL, NULL},
};

/* Edlen's density of air over that of his standard state. */
static double air_density(double t, double p)
{
    return p / 96095.43 * (1 + 1e-8 * (0.613 - 0.00998 * t) * p) / (1 + 0.003661 * t);
}

static double edlen(const struct air *air, double l)
{
    double s = 1 / (l * l);
    return 1e-8 * (8342.13 + 2406030 / (130 - s) + 15997 / (38.9 - s)) *
           air_density(air->temperature, air->pressure);
}

static double ciddor(const struct air *air, double l)
{
    double s = 1 / (l * l);
    return (0.05792105 / (238.0185 - s) + 0.00167917 / (57.362 - s)) *
           (air_density(air->temperature, air->pressure) / air_density(15, AIR_STANDARD_PRESSURE));
}

static double kohlrausch(const struct air *air, double l)
{
    double x = l * l;
    return 1e-8 * (6432.8 + 2949810 * x / (146 * x - 1) + 25540 * x / (41 * x - 1)) *
           (air->pressure / AIR_STANDARD_PRESSURE) / (1 + (air->temperature - 15) * 3.4785e-3);
}

double air_refractivity(const struct air *air, double wavelength)
{
    static double (*const models[])(const struct air *, double) = {edlen, ciddor, kohlrausch};
    return models[air->model](air, wavelength);
}

/* l^2 less the square of the resonance, which has the sign of the resonance. */
static double resonance_gap(const struct glass_thermal *thermal, double l)
{
    return l * l - copysign(thermal->resonance * thermal->resonance, thermal->resonance);
}

double glass_dn_dT(const struct glass *glass, double wavelength, double temperature)
{
    const struct glass_thermal *t = &glass->thermal;
    double n = glass_n(glass, wavelength), dT = temperature - t->reference;
    return (n * n - 1) / (2 * n) *
           (t->d0 + 2 * t->d1 * dT + 3 * t->d2 * dT * dT +
            (t->e0 + 2 * t->e1 * dT) / resonance_gap(t, wavelength));
}

static bool not_known(const struct glass *glass, const char *what, struct error *error)
{
    return fail(error, ERROR_DOMAIN, "the catalogue gives no %s of %.*s:%.*s", what,
                (int)glass->catalog.length, glass->catalog.start, (int)glass->name.length,
                glass->name.start);
}

bool glass_in_air(const struct glass *glass, double wavelength, const struct air *air,
                  struct glass_state *state, struct error *error)
{
    const struct glass_thermal *thermal = &glass->thermal;
    struct glass_index index = glass_index(glass, pair_of(wavelength));
    double dT = air->temperature - thermal->reference, change = 0;
    if (isnan(dT)) {
        return not_known(glass, "reference temperature", error);
    }
    if (fabs(dT) > 0) {
        /* Change of the index from the reference temperature on: the integral of glass_dn_dT. */
        double n = index.n.hi;
        double bracket = thermal->d0 + dT * (thermal->d1 + dT * thermal->d2) +
                         (thermal->e0 + dT * thermal->e1) / resonance_gap(thermal, wavelength);
        change = (n * n - 1) / (2 * n) * bracket * dT;
    }
    if (isnan(change)) {
        return not_known(glass, "dn/dT", error);
    }
    const struct air reference = {air->model, thermal->reference, AIR_STANDARD_PRESSURE};
    double before = air_refractivity(&reference, wavelength);
    double after = air_refractivity(air, wavelength);
    /* n (1 + before)/(1 + after), by the difference: no digit is lost where they agree */
    double ratio = (before - after) / (1 + after);
    state->n = index.n.hi + (index.n.lo + index.n.hi * ratio + change / (1 + after));
    /* the dispersion of air and of that change are below 1e-5 of the glass's own */
    state->slope = index.slope * (1 + ratio);
    state->dn_dT = glass_dn_dT(glass, wavelength, air->temperature);
    return true;
}
