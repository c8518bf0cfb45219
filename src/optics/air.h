/* optics/air.h - refractive index of air, and of a glass that is not at its reference state. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_AIR_H
#define LENSCALC_OPTICS_AIR_H

#include "optics/glass.h"

/* The pressure at which catalogues state indices, Pa. */
#define AIR_STANDARD_PRESSURE 101325.0

enum air_model { AIR_EDLEN, AIR_CIDDOR, AIR_KOHLRAUSCH };

/* Words of the models, ends with null; the place is the enum. */
extern const struct word air_models[];

/* The state of air: temperature C, pressure Pa (0 is vacuum). */
struct air {
    enum air_model model;
    double temperature, pressure;
};

/*
 * Refractivity n - 1 of dry air.
 *
 * Given     wavelength  um; temperature above -100 C, pressure 0 or more Pa
 * Formula   s = 1/l^2
 *           AIR_EDLEN       (n-1) 1e8 = 8342.13 + 2406030/(130 - s) + 15997/(38.9 - s), times
 *                           (p/96095.43)(1 + 1e-8 (0.613 - 0.00998 t) p)/(1 + 0.003661 t)
 *           AIR_CIDDOR      n-1 = 0.05792105/(238.0185 - s) + 0.00167917/(57.362 - s) at 15 C and
 *                           101325 Pa; to other states by the density factor of AIR_EDLEN
 *           AIR_KOHLRAUSCH  (n-1) 1e8 = [6432.8 + 2949810 l^2/(146 l^2 - 1) + 25540 l^2/(41 l^2 -
 *                           1)] P/(1 + 0.0034785 (t - 15)), P = p/101325 Pa, as AGF users have it
 * Source    [Edlen66]; [Ciddor96]; [Kohlrausch68]
 * Limits    the wavelength is taken as that in vacuum (0.03 % longer than in air: 1e-8 of n)
 */
double air_refractivity(const struct air *air, double wavelength);

/* Index of a glass in another state. */
struct glass_state {
    double n;     /* relative to that air; to vacuum with pressure 0 */
    double slope; /* dn/dl, 1/um */
    double dn_dT; /* dn/dT in vacuum at that temperature, 1/K; NaN if not known */
};

/*
 * Refractive index at another temperature and pressure.
 *
 * Given     air  temperature of glass and air, pressure
 * Formula   n_vacuum(T) = n n_air(T0) + (n^2 - 1)/(2 n) [D0 dT + D1 dT^2 + D2 dT^3 +
 *           (E0 dT + E1 dT^2)/(l^2 - s)], dT = T - T0, s = sign(lTK) lTK^2;
 *           n(T, p) = n_vacuum(T)/n_air(T, p)
 * Source    [Schott16] eq. 6, integrated
 * Errors    ERROR_DOMAIN: the catalogue gives no reference temperature or no D0 .. lTK while T
 *           is another than T0
 * Limits    from -100 to 140 C; the wavelength stays that in air at T0
 */
bool glass_in_air(const struct glass *glass, double wavelength, const struct air *air,
                  struct glass_state *state, struct error *error);

/* dn/dT in vacuum, 1/K; NaN where the catalogue does not give it. */
double glass_dn_dT(const struct glass *glass, double wavelength, double temperature);

#endif
