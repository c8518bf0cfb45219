/* photo/conjugate.c - conjugate points: focal length, distances and magnification. */
/* SPDX-License-Identifier: MIT */
#include "photo/conjugate.h"

#include "photo/given.h"

#include <math.h>

/* The bits of the given quantities. */
enum { HAS_F = 1, HAS_S = 2, HAS_V = 4, HAS_M = 8, HAS_T = 16 };

/* Relative slack at T = 4 f + hiatus: 33.3 x 4 and 133.2 differ by rounding only. */
static const double one_to_one_slack = 1e-12;

/* Magnification from the focal length and one more. */
static bool conjugates_with_f(unsigned has, const struct conjugates_given *g, struct conjugates *r,
                              struct error *error)
{
    const double f = g->f;
    if (has == (HAS_F | HAS_S)) {
        r->m = f / (g->s - f);
        return g->s > f ||
               fail(error, ERROR_DOMAIN,
                    "{distance} %g mm lies within {the focal length} %g mm: no real image, a "
                    "magnifier and not a photograph (more than %g mm)",
                    g->s, f, f);
    }
    if (has == (HAS_F | HAS_V)) {
        r->m = (g->v - f) / f;
        return g->v >= f ||
               fail(error, ERROR_DOMAIN,
                    "{image distance} %g mm lies within {the focal length} %g mm: focused beyond "
                    "infinity (%g mm or more)",
                    g->v, f, f);
    }
    if (has == (HAS_F | HAS_M)) {
        return true;
    }
    double x = (g->T - g->hiatus - 4 * f) / f;
    if (!(x >= -one_to_one_slack)) {
        return fail(error, ERROR_DOMAIN,
                    "{sensor distance} %g mm is too short for {the focal length} %g mm: no real "
                    "image (4 f + hiatus = %g mm or more)",
                    g->T, f, 4 * f + g->hiatus);
    }
    x = fmax(x, 0);
    const double large = isinf(x) ? x : (2 + x + sqrt(x * (x + 4))) / 2;
    const bool is_enlarged = g->choice == CONJUGATES_ENLARGED;
    r->m = is_enlarged ? large : 1 / large;
    return !(is_enlarged && isinf(large)) ||
           fail(error, ERROR_DOMAIN,
                "{sensor distance} inf has no enlarged image (a finite distance)");
}

/* Focal length and magnification from two others. */
static bool conjugates_without_f(unsigned has, const struct conjugates_given *g,
                                 struct conjugates *r, struct error *error)
{
    const double between = g->T - g->hiatus;
    switch (has) {
    case HAS_S | HAS_M:
        r->f = g->s * g->m / (1 + g->m);
        return (isfinite(g->s) && g->m > 0) ||
               fail(error, ERROR_DOMAIN,
                    "{distance} %g mm with {magnification} %g leaves the focal length open (a "
                    "finite distance and a magnification above 0)",
                    g->s, g->m);
    case HAS_V | HAS_M:
        r->f = g->v / (1 + g->m);
        return true;
    case HAS_M | HAS_T:
        r->f = between / (1 + g->m) * (g->m / (1 + g->m));
        return (isfinite(between) && between > 0 && g->m > 0) ||
               fail(error, ERROR_DOMAIN,
                    "{sensor distance} %g mm with {magnification} %g leaves the focal length open "
                    "(finite and more than the hiatus %g mm, a magnification above 0)",
                    g->T, g->m, g->hiatus);
    case HAS_S | HAS_T:
        r->v = between - g->s;
        if (!(r->v > 0 && isfinite(r->v))) {
            return fail(error, ERROR_DOMAIN,
                        "{sensor distance} %g mm leaves no room for an image behind {the "
                        "distance} %g mm (finite and more than %g mm)",
                        g->T, g->s, g->s + g->hiatus);
        }
        break;
    case HAS_V | HAS_T:
        r->s = between - g->v;
        if (!(r->s > 0)) {
            return fail(error, ERROR_DOMAIN,
                        "{sensor distance} %g mm leaves no room for a subject before {the image "
                        "distance} %g mm (more than %g mm)",
                        g->T, g->v, g->v + g->hiatus);
        }
        break;
    default: /* s and v */
        break;
    }
    r->m = r->v / r->s;
    r->f = r->v / (1 + r->m);
    return true;
}

bool conjugates_solve(const struct conjugates_given *given, struct conjugates *result,
                      struct error *error)
{
    unsigned has = 0; /* which are given, as bits */
    const double values[] = {given->f, given->s, given->v, given->m, given->T};
    const struct given finite[] = {{"focal length", " mm", given->f},
                                   {"image distance", " mm", given->v}};
    const struct given others[] = {{"distance", " mm", given->s},
                                   {"sensor distance", " mm", given->T}};
    for (unsigned i = 0; i < sizeof values / sizeof values[0]; i++) {
        has |= isnan(values[i]) ? 0 : 1U << i;
    }
    if (!given_positive(finite, 2, error) || !given_above_0(others, 2, error) ||
        (!isnan(given->m) && !check_not_negative("magnification", "", given->m, error)) ||
        !check_finite("hiatus", " mm", given->hiatus, error)) {
        return false;
    }
    *result = (struct conjugates){
        .f = given->f, .s = given->s, .v = given->v, .m = given->m, .T = given->T};
    const unsigned rest = has & (has - 1); /* without the first of them */
    if (rest == 0 || (rest & (rest - 1)) != 0) {
        return fail(error, ERROR_USAGE,
                    "give exactly two of {focal length}, {distance}, {image distance}, "
                    "{magnification} and {sensor distance}");
    }
    if (!((has & HAS_F) != 0 ? conjugates_with_f(has, given, result, error)
                             : conjugates_without_f(has, given, result, error))) {
        return false;
    }
    /* From f and m everything else; what was given or solved before stays as it is. */
    result->extension = result->f * result->m;
    result->twin_magnification = 1 / result->m;
    if (!(has & HAS_S) && isnan(result->s)) {
        result->s = result->f * (1 + 1 / result->m);
    }
    if (!(has & HAS_V) && isnan(result->v)) {
        result->v = result->f * (1 + result->m);
    }
    if (!(has & HAS_T)) {
        result->T = result->s + result->v + given->hiatus;
    }
    return true;
}

bool conjugates_exposure(double N, double m, double P, struct conjugates_exposure *result,
                         struct error *error)
{
    if (!check_positive("f-number", "", N, error) ||
        !check_not_negative("magnification", "", m, error) ||
        !check_positive("pupil magnification", "", P, error)) {
        return false;
    }
    const double ratio = 1 + m / P;
    *result = (struct conjugates_exposure){
        .working_fnumber = N * ratio, .factor = ratio * ratio, .stops = 2 * log1p(m / P) / log(2)};
    return true;
}

bool conjugates_working_distance(double s, double front_principal, double *distance,
                                 struct error *error)
{
    *distance = s - front_principal;
    return *distance > 0 ||
           fail(error, ERROR_DOMAIN,
                "subject %g mm from the principal plane lies inside the lens, whose front is "
                "%g mm before that plane (more than %g mm)",
                s, front_principal, front_principal);
}

double conjugates_pupil_distance(double f, double m, double P)
{
    return f * (1 / m + 1 / P);
}
