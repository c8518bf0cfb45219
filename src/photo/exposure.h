/* photo/exposure.h - exposure: aperture, time, speed and light, each from the others. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_EXPOSURE_H
#define LENSCALC_PHOTO_EXPOSURE_H

#include "base/error.h"

/* Meter calibration constants that are taken when none is given. */
#define EXPOSURE_K                                                                                 \
    12.5 /* reflected light, cd s/(m^2 ISO): Canon, Nikon, Sekonic; 14 Kenko, Pentax */
#define EXPOSURE_C 250 /* incident light on a flat receptor, lx s/ISO; 340 on a dome */

/* One photographic situation; NaN is "not given". At most one of the four lights is given. */
struct exposure_given {
    double N;     /* f-number, > 0 */
    double t;     /* exposure time, s, > 0 */
    double S;     /* ISO arithmetic speed, > 0 */
    double ev100; /* light as exposure value at ISO 100, -100..100 */
    double ev;    /* light as exposure value at the speed S, -100..100 */
    double L;     /* scene luminance, cd/m^2, > 0 */
    double E;     /* illuminance on the subject, lx, > 0 */
    double K, C;  /* meter constants, > 0; NaN: EXPOSURE_K, EXPOSURE_C */
    double
        loss; /* stops lost between scene and film, LOSS_LEAST..200; NaN: 0 (see photo/stops.h) */
    double compensation; /* stops to expose more (+) or less (-) than metered; NaN: 0 */
};

/* Which quantity was the unknown. */
enum exposure_unknown { EXPOSURE_N, EXPOSURE_T, EXPOSURE_S, EXPOSURE_LIGHT };

/* The situation complete. */
struct exposure {
    double N, t, S;        /* f-number, s, ISO */
    double ev100, ev;      /* metered: at ISO 100 and at S */
    double ev_set;         /* of the camera: log2(N^2/t); ev without loss and compensation */
    double L, E;           /* cd/m^2, lx */
    double Av, Tv, Sv, Bv; /* APEX: Av + Tv = ev_set, Bv + Sv = ev */
    enum exposure_unknown unknown;
    bool speed_assumed; /* S was not given and not solvable: taken as 100 */
};

/*
 * Solve the exposure equation for whichever of aperture, time, speed or light is missing.
 *
 * Given     given   three of N, t, S and one light; two of N, t and light without S take S = 100
 * Result    x       everything; ev in stops, L in cd/m^2, E in lx
 * Formula   N^2/t = (L S/K) 2^-(loss + compensation) = (E S/C) 2^-(loss + compensation);
 *           EV100 = log2(100 L/K) = log2(100 E/C), EV = EV100 + log2(S/100);
 *           Av = 2 log2 N, Tv = -log2 t, Sv = log2(S/3.125), Bv = EV100 - 5
 * Source    ISO 2720:1974 (K, C); ASA PH2.5-1960 (APEX, as in Wikipedia "APEX system")
 * Errors    too few or too many numbers, lights that differ by over 0.005 stop, a speed asked from
 *           an EV at that speed (ERROR_USAGE); a number outside its range, an answer that is not
 *           finite (ERROR_DOMAIN)
 * Limits    K and C describe the meter; two meters may differ by log2(14/12.5) = 0.16 stop. No
 *           reciprocity failure (photo/reciprocity.h)
 */
bool exposure_solve(const struct exposure_given *given, struct exposure *x, struct error *error);

/*
 * How far given settings are off in given light.
 *
 * Given     given   N, t, S (NaN: 100) and one light
 * Result    stops   exposure above (+) or below (-) what the meter asks for, with loss and
 *                   compensation counted
 * Formula   EV - loss - compensation - log2(N^2/t)
 * Source    as exposure_solve
 * Errors    a missing number (ERROR_USAGE), a number outside its range (ERROR_DOMAIN)
 */
bool exposure_deviation(const struct exposure_given *given, double *stops, struct error *error);

/*
 * Luminance of a white that scatters alike in all directions, in light of an exposure value.
 *
 * Given     ev100  at ISO 100
 * Result    cd/m^2: C/K/pi = 6.4 times what a meter takes for the mean of a scene
 * Formula   L = E/pi, E = C 2^EV100/100, C = 250
 * Source    ISO 2720:1974; Lambert's law
 */
double exposure_white(double ev100);

/* What the camera is set to. */
struct camera_setting {
    double N; /* f-number, > 0 */
    double t; /* s, > 0 */
    double S; /* ISO, > 0 */
};

/*
 * Stops from one setting to another in the same light.
 *
 * Given     from, to   settings
 * Result    stops; + means that `to` records more light or amplifies it more
 * Formula   log2((t2/t1)(S2/S1)(N1/N2)^2)
 * Source    lecture: f/16 1/8 s, f/4 1/125 s, f/2 1/500 s are one exposure; as labels they differ
 *           by log2(128/125) = 0.034 stop
 * Errors    a member that is not above 0
 */
bool exposure_stops(const struct camera_setting *from, const struct camera_setting *to,
                    double *stops, struct error *error);

/* One line of a table of equivalent exposures. */
struct equivalent_exposure {
    double N;        /* f-number asked for */
    double t;        /* exact time for it, s */
    double t_series; /* nearest time of the series 2^(i/k), s: where the shutter can stand */
    double residual; /* stops by which t_series exposes more (+) or less (-) than t */
};

/*
 * The time that goes with an aperture for one exposure value, and the nearest time of a series.
 *
 * Given     ev_set    log2(N^2/t) of the camera, -100..100
 *           N         f-number > 0
 *           per_stop  k, 1..12: full stops 1, halves 2, thirds 3
 * Result    line; |residual| <= 1/(2k)
 * Formula   Tv = ev_set - Av, t = 2^-Tv, series Tv' = round(k Tv)/k, residual = Tv - Tv'
 * Source    ASA PH2.5-1960 (APEX)
 * Errors    numbers outside their ranges
 * Limits    the series is exact, the shutter's label is not (1/125 for 1/128): cli shows it
 */
bool exposure_equivalent(double ev_set, double N, int per_stop, struct equivalent_exposure *line,
                         struct error *error);

#endif
