/* photo/exposure.c - exposure: aperture, time, speed and light, each from the others. */
/* SPDX-License-Identifier: MIT */
#include "photo/exposure.h"

#include "base/constants.h"

#include <float.h>
#include <math.h>

#include "photo/given.h"
#include "photo/stops.h"

static const double log2_of_100 = 6.6438561897747246957;
static const double log2_of_3_125 = 1.6438561897747246957; /* ISO 3.125 is Sv 0 */

/* Twice what any light on Earth spans; beyond it exp2 soon leaves the doubles. */
static const double ev_limit = 100;

/* What the light may be given as, in a message. */
#define ANY_LIGHT                                                                                  \
    "{scene}, {exposure value at ISO 100}, {exposure value at the ISO speed}, {luminance} or "     \
    "{illuminance}"

static double exposure_or_else(double value, double otherwise)
{
    return is_given(value) ? value : otherwise;
}

static void fill_defaults(struct exposure_given *g)
{
    g->K = exposure_or_else(g->K, EXPOSURE_K);
    g->C = exposure_or_else(g->C, EXPOSURE_C);
    g->loss = exposure_or_else(g->loss, 0);
    g->compensation = exposure_or_else(g->compensation, 0);
}

static bool exposure_check_ranges(const struct exposure_given *g, struct error *error)
{
    const struct given positive[] = {{"f-number", "", g->N},        {"exposure time", " s", g->t},
                                     {"ISO speed", "", g->S},       {"luminance", " cd/m^2", g->L},
                                     {"illuminance", " lx", g->E},  {"meter constant K", "", g->K},
                                     {"meter constant C", "", g->C}};
    return given_positive(positive, sizeof positive / sizeof *positive, error) &&
           require_within("exposure value at ISO 100", "", exposure_or_else(g->ev100, 0), -ev_limit,
                          ev_limit, error) &&
           require_within("exposure value at the ISO speed", "", exposure_or_else(g->ev, 0),
                          -ev_limit, ev_limit, error) &&
           require_within("light loss", " stops", g->loss, LOSS_LEAST, 200, error) &&
           require_within("exposure compensation", " stops", g->compensation, -ev_limit, ev_limit,
                          error);
}

/* The light as EV100; an EV at ISO needs the speed. */
static double light_ev100(const struct exposure_given *g)
{
    if (is_given(g->ev100)) {
        return g->ev100;
    }
    if (is_given(g->L)) {
        return log2(100 * (g->L / g->K));
    }
    return is_given(g->E) ? log2(100 * (g->E / g->C)) : g->ev - (log2(g->S) - log2_of_100);
}

/* Stops. Of less no meter knows, and an answer that is printed to five digits is that exact. */
static const double same_light = 0.005;

/* A light may be given in several units, as the rows of an answer have it, if all say the same. */
static bool exposure_count_lights(const struct exposure_given *g, int *lights, struct error *error)
{
    const struct {
        const char *name;
        double value, ev100;
    } all[] = {
        {"exposure value at ISO 100", g->ev100, g->ev100},
        {"luminance", g->L, log2(100 * (g->L / g->K))},
        {"illuminance", g->E, log2(100 * (g->E / g->C))},
        {"exposure value at the ISO speed", g->ev, g->ev - (log2(g->S) - log2_of_100)},
    };
    *lights = is_given(g->ev100) + is_given(g->ev) + is_given(g->L) + is_given(g->E);
    const double light = *lights > 1 ? light_ev100(g) : (double)NAN;
    const size_t compared = *lights > 1 ? sizeof all / sizeof all[0] : 0;
    for (size_t i = 0; i < compared; i++) {
        if (is_given(all[i].value) && !(fabs(all[i].ev100 - light) <= same_light)) {
            fail(error, ERROR_USAGE,
                 "give only one of {exposure value at ISO 100}, {exposure value at the ISO "
                 "speed}, {luminance} and {illuminance}");
            return error_hint(error,
                              "they may stand together where all say the same light, but {%s} "
                              "%.6g is not that of EV %.6g at ISO 100",
                              all[i].name, all[i].value, light);
        }
    }
    return true;
}

/*
 * 2^ev. Scenes state logarithms of whole numbers (sunny 16: of 25600): where the rounding of ev
 * does not tell the power from a whole number, that is meant.
 */
static double power_of_two(double ev)
{
    double power = exp2(ev), whole = round(power);
    return fabs(power - whole) <= 2 * DBL_EPSILON * fmax(1, fabs(ev)) * power ? whole : power;
}

/* The light as 2^EV100, without a logarithm on the way where none is given. */
static double light_ratio(const struct exposure_given *g)
{
    if (is_given(g->ev100)) {
        return power_of_two(g->ev100);
    }
    if (is_given(g->L)) {
        return 100 * (g->L / g->K);
    }
    return is_given(g->E) ? 100 * (g->E / g->C) : power_of_two(g->ev) / (g->S / 100);
}

/* Find the one unknown; a missing speed is either that or assumed. */
static bool exposure_find_unknown(struct exposure_given *g, struct exposure *x, struct error *error)
{
    int lights = 0;
    if (!exposure_count_lights(g, &lights, error)) {
        return false;
    }
    int missing = !is_given(g->N) + !is_given(g->t) + (lights == 0);
    bool speed = is_given(g->S);
    if (missing > 1 || (missing == 0 && speed)) {
        if (missing == 0) {
            return fail(error, ERROR_USAGE,
                        "nothing is left to solve for: leave out one of {f-number}, {exposure "
                        "time}, {ISO speed} and a light (" ANY_LIGHT ")");
        }
        fail(error, ERROR_USAGE,
             "too little is given: of {f-number}, {exposure time} and a light (" ANY_LIGHT
             ") two are needed ({ISO speed} is 100 unless given)");
        return is_given(g->t) && g->loss > 0
                   ? error_hint(error, "a time metered without the filter is {metered time}")
                   : false;
    }
    if (missing == 0 && is_given(g->ev)) {
        return fail(error, ERROR_USAGE,
                    "{exposure value at the ISO speed} with {f-number} and {exposure time} leaves "
                    "{ISO speed} open: give {exposure value at ISO 100} (the "
                    "light at ISO 100) to solve for the speed");
    }
    if (missing == 0) {
        x->unknown = EXPOSURE_S;
    } else if (!is_given(g->N)) {
        x->unknown = EXPOSURE_N;
    } else if (!is_given(g->t)) {
        x->unknown = EXPOSURE_T;
    } else {
        x->unknown = EXPOSURE_LIGHT;
    }
    x->speed_assumed = missing == 1 && !speed;
    if (x->speed_assumed) {
        g->S = 100;
    }
    return true;
}

bool exposure_solve(const struct exposure_given *given, struct exposure *x, struct error *error)
{
    struct exposure_given g = *given;
    fill_defaults(&g);
    if (!exposure_check_ranges(&g, error) || !exposure_find_unknown(&g, x, error)) {
        return false;
    }
    /* The exposure equation in stops: ev_set = ev100 + log2(S/100) - less. */
    double less = g.loss + g.compensation, kept = exp2(-less);
    double speed = log2(g.S) - log2_of_100;
    double light =
        x->unknown == EXPOSURE_LIGHT ? g.N * g.N / g.t / (kept * (g.S / 100)) : light_ratio(&g);
    x->N = g.N;
    x->t = g.t;
    x->S = g.S;
    x->ev100 =
        x->unknown == EXPOSURE_LIGHT ? log2(g.N * g.N / g.t) + less - speed : light_ev100(&g);
    x->ev_set = x->ev100 + speed - less;
    if (x->unknown == EXPOSURE_N) {
        x->N = sqrt(g.t * (light * kept) * (g.S / 100));
    } else if (x->unknown == EXPOSURE_T) {
        x->t = g.N * g.N / (light * kept * (g.S / 100));
    } else if (x->unknown == EXPOSURE_S) {
        x->ev_set = log2(g.N * g.N / g.t);
        x->S = 100 * (g.N * g.N / g.t / (light * kept));
    }
    x->ev = x->ev100 + (log2(x->S) - log2_of_100);
    x->L = is_given(g.L) ? g.L : g.K * light / 100;
    x->E = is_given(g.E) ? g.E : g.C * light / 100;
    x->Av = 2 * log2(x->N);
    x->Tv = -log2(x->t);
    x->Sv = log2(x->S) - log2_of_3_125;
    x->Bv = x->ev100 - (log2_of_100 - log2_of_3_125);
    return answer_positive("the f-number", x->N, error) &&
           answer_positive("the exposure time", x->t, error) &&
           answer_positive("the ISO speed", x->S, error) &&
           answer_positive("the luminance", x->L, error) &&
           answer_positive("the illuminance", x->E, error);
}

bool exposure_deviation(const struct exposure_given *given, double *stops, struct error *error)
{
    struct exposure_given g = *given;
    int lights = 0;
    fill_defaults(&g);
    g.S = exposure_or_else(g.S, 100);
    if (!exposure_check_ranges(&g, error) || !exposure_count_lights(&g, &lights, error) ||
        !require_positive("f-number", "", g.N, error) ||
        !require_positive("exposure time", " s", g.t, error)) {
        return false;
    }
    if (lights == 0) {
        return fail(error, ERROR_USAGE, "give the light: " ANY_LIGHT);
    }
    *stops = light_ev100(&g) + (log2(g.S) - log2_of_100) - g.loss - g.compensation -
             log2(g.N * g.N / g.t);
    return true;
}

static bool exposure_check_setting(const struct camera_setting *setting, struct error *error)
{
    return require_positive("f-number", "", setting->N, error) &&
           require_positive("exposure time", " s", setting->t, error) &&
           require_positive("ISO speed", "", setting->S, error);
}

bool exposure_stops(const struct camera_setting *from, const struct camera_setting *to,
                    double *stops, struct error *error)
{
    *stops = log2(to->t / from->t) + log2(to->S / from->S) + 2 * log2(from->N / to->N);
    return exposure_check_setting(from, error) && exposure_check_setting(to, error);
}

bool exposure_equivalent(double ev_set, double N, int per_stop, struct equivalent_exposure *line,
                         struct error *error)
{
    if (!require_within("exposure value at ISO 100", "", ev_set, -ev_limit, ev_limit, error) ||
        !require_positive("f-number", "", N, error) ||
        !require_within("steps of the series", " steps a stop", per_stop, 1, 12, error)) {
        return false;
    }
    double Tv = ev_set - 2 * log2(N);
    double Tv_series = round(Tv * per_stop) / per_stop;
    line->N = N;
    line->t = exp2(-Tv);
    line->t_series = exp2(-Tv_series);
    /* what the rounding of the logarithms leaves is no residual */
    line->residual = fabs(Tv - Tv_series) < 1e-12 ? 0 : Tv - Tv_series;
    return answer_positive("the exposure time", line->t, error);
}

double exposure_white(double ev100)
{
    return EXPOSURE_C * exp2(ev100) / 100 / PI;
}
