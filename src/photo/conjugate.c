/* photo/conjugate.c - conjugate points: focal length, distances and magnification. */
/* SPDX-License-Identifier: MIT */
#include "photo/conjugate.h"

#include <math.h>
#include <stddef.h>

/* The bits of the given quantities, in the order of quantities[]. */
enum { HAS_F = 1, HAS_S = 2, HAS_V = 4, HAS_M = 8, HAS_T = 16 };

/* Relative slack at T = 4 f + hiatus: 33.3 x 4 and 133.2 differ by rounding only. */
static const double one_to_one_slack = 1e-12;

static bool from_f_s(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    if (!(g->s > g->f)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %g mm lies within {the focal length} %g mm: no real image, a "
                    "magnifier and not a photograph (more than %g mm)",
                    g->s, g->f, g->f);
    }
    r->m = g->f / (g->s - g->f);
    return true;
}

static bool from_f_v(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    if (!(g->v >= g->f)) {
        return fail(
            error, ERROR_DOMAIN,
            "{image distance} %g mm lies within {the focal length} %g mm: focused beyond infinity "
            "(%g mm or more)",
            g->v, g->f, g->f);
    }
    r->m = (g->v - g->f) / g->f;
    return true;
}

static bool from_f_m(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    (void)g;
    (void)r;
    (void)error;
    return true;
}

static bool from_f_T(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    double x = (g->T - g->hiatus - 4 * g->f) / g->f;
    if (!(x >= -one_to_one_slack)) {
        return fail(
            error, ERROR_DOMAIN,
            "{sensor distance} %g mm is too short for {the focal length} %g mm: no real image "
            "(4 f + hiatus = %g mm or more)",
            g->T, g->f, 4 * g->f + g->hiatus);
    }
    x = fmax(x, 0);
    double large = isinf(x) ? x : (2 + x + sqrt(x * (x + 4))) / 2;
    if (g->choice == CONJUGATES_ENLARGED && isinf(large)) {
        return fail(error, ERROR_DOMAIN,
                    "{sensor distance} inf has no enlarged image (a finite distance)");
    }
    r->m = g->choice == CONJUGATES_ENLARGED ? large : 1 / large;
    return true;
}

static bool from_s_v(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    (void)error;
    r->m = g->v / g->s;
    r->f = g->v / (1 + r->m);
    return true;
}

static bool from_s_m(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    if (!(isfinite(g->s) && g->m > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{distance} %g mm with {magnification} %g leaves the focal length open (a "
                    "finite distance and a magnification above 0)",
                    g->s, g->m);
    }
    r->f = g->s * g->m / (1 + g->m);
    return true;
}

static bool from_s_T(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    double v = g->T - g->hiatus - g->s;
    if (!(v > 0 && isfinite(v))) {
        return fail(
            error, ERROR_DOMAIN,
            "{sensor distance} %g mm leaves no room for an image behind {the distance} %g mm "
            "(finite and more than %g mm)",
            g->T, g->s, g->s + g->hiatus);
    }
    r->v = v;
    r->m = v / g->s;
    r->f = v / (1 + r->m);
    return true;
}

static bool from_v_m(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    (void)error;
    r->f = g->v / (1 + g->m);
    return true;
}

static bool from_v_T(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    double s = g->T - g->hiatus - g->v;
    if (!(s > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{sensor distance} %g mm leaves no room for a subject before {the image "
                    "distance} %g mm "
                    "(more than %g mm)",
                    g->T, g->v, g->v + g->hiatus);
    }
    r->s = s;
    r->m = g->v / s;
    r->f = g->v / (1 + r->m);
    return true;
}

static bool from_m_T(const struct conjugates_given *g, struct conjugates *r, struct error *error)
{
    double D = g->T - g->hiatus;
    if (!(isfinite(D) && D > 0 && g->m > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "{sensor distance} %g mm with {magnification} %g leaves the focal length open "
                    "(finite and more than the hiatus %g mm, a magnification above 0)",
                    g->T, g->m, g->hiatus);
    }
    r->f = D / (1 + g->m) * (g->m / (1 + g->m));
    return true;
}

/* Each sets f and m from its pair; f and m are already there if they were given. */
static const struct solver {
    unsigned has;
    bool (*solve)(const struct conjugates_given *, struct conjugates *, struct error *);
} solvers[] = {
    {HAS_F | HAS_S, from_f_s}, {HAS_F | HAS_V, from_f_v}, {HAS_F | HAS_M, from_f_m},
    {HAS_F | HAS_T, from_f_T}, {HAS_S | HAS_V, from_s_v}, {HAS_S | HAS_M, from_s_m},
    {HAS_S | HAS_T, from_s_T}, {HAS_V | HAS_M, from_v_m}, {HAS_V | HAS_T, from_v_T},
    {HAS_M | HAS_T, from_m_T},
};

/* The five quantities with their legal ranges, one bit each. */
static const struct quantity {
    size_t offset;
    const char *name, *unit, *range;
    bool zero, infinite; /* are these legal */
} quantities[] = {
    {offsetof(struct conjugates_given, f), "focal length", " mm", "above 0 mm, finite", 0, 0},
    {offsetof(struct conjugates_given, s), "distance", " mm", "above 0 mm, may be inf", 0, 1},
    {offsetof(struct conjugates_given, v), "image distance", " mm", "above 0 mm, finite", 0, 0},
    {offsetof(struct conjugates_given, m), "magnification", "", "0 or more, finite", 1, 0},
    {offsetof(struct conjugates_given, T), "sensor distance", " mm", "above 0 mm, may be inf", 0,
     1},
};

static double quantity_value(const struct conjugates_given *given, const struct quantity *q)
{
    return *(const double *)(const void *)((const char *)given + q->offset);
}

/* Which are given, as bits; false and an error if one is out of its range. */
static bool given_bits(const struct conjugates_given *given, unsigned *has, struct error *error)
{
    *has = 0;
    for (unsigned i = 0; i < sizeof quantities / sizeof *quantities; i++) {
        const struct quantity *q = &quantities[i];
        double x = quantity_value(given, q);
        if (isnan(x)) {
            continue;
        }
        if (!(x > 0 || (q->zero && x >= 0)) || (isinf(x) && !q->infinite)) {
            return fail(error, ERROR_DOMAIN, "{%s} %g%s is out of range (%s)", q->name, x, q->unit,
                        q->range);
        }
        *has |= 1U << i;
    }
    if (!isfinite(given->hiatus)) {
        return fail(error, ERROR_DOMAIN, "{hiatus} %g mm is out of range (finite)", given->hiatus);
    }
    return true;
}

/* From f and m everything else; what was given or solved before stays as it is. */
static void conjugate_complete(unsigned has, double hiatus, struct conjugates *r)
{
    r->extension = r->f * r->m;
    r->twin_magnification = 1 / r->m;
    if (!(has & HAS_S) && isnan(r->s)) {
        r->s = r->f * (1 + 1 / r->m);
    }
    if (!(has & HAS_V) && isnan(r->v)) {
        r->v = r->f * (1 + r->m);
    }
    if (!(has & HAS_T)) {
        r->T = r->s + r->v + hiatus;
    }
}

bool conjugates_solve(const struct conjugates_given *given, struct conjugates *result,
                      struct error *error)
{
    unsigned has;
    if (!given_bits(given, &has, error)) {
        return false;
    }
    *result = (struct conjugates){
        .f = given->f, .s = given->s, .v = given->v, .m = given->m, .T = given->T};
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
        if (solvers[i].has == has) {
            if (!solvers[i].solve(given, result, error)) {
                return false;
            }
            conjugate_complete(has, given->hiatus, result);
            return true;
        }
    }
    return fail(
        error, ERROR_USAGE,
        "give exactly two of {focal length}, {distance}, {image distance}, {magnification} and "
        "{sensor distance}");
}

bool conjugates_exposure(double N, double m, double P, struct conjugates_exposure *result,
                         struct error *error)
{
    if (!(N > 0 && isfinite(N))) {
        return fail(error, ERROR_DOMAIN, "{f-number} %g is out of range (above 0, finite)", N);
    }
    if (!(m >= 0 && isfinite(m))) {
        return fail(error, ERROR_DOMAIN, "{magnification} %g is out of range (0 or more, finite)",
                    m);
    }
    if (!(P > 0 && isfinite(P))) {
        return fail(error, ERROR_DOMAIN,
                    "{pupil magnification} %g is out of range (above 0, finite)", P);
    }
    double ratio = 1 + m / P;
    if (!(ratio <= 1e150)) {
        return fail(error, ERROR_DOMAIN,
                    "{the magnification} %g is out of range: at most 1e150 times "
                    "{the pupil magnification} %g",
                    m, P);
    }
    if (!(N * ratio < 1e300)) {
        return fail(error, ERROR_DOMAIN,
                    "{f-number} %g is out of range: with {magnification} %g it must be below %g", N,
                    m, 1e300 / ratio);
    }
    *result = (struct conjugates_exposure){
        .working_fnumber = N * ratio, .factor = ratio * ratio, .stops = 2 * log1p(m / P) / log(2)};
    return true;
}

bool conjugates_working_distance(double s, double front_principal, double *distance,
                                 struct error *error)
{
    *distance = s - front_principal;
    if (!(*distance > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "subject %g mm from the principal plane lies inside the lens, whose front is "
                    "%g mm before that plane (more than %g mm)",
                    s, front_principal, front_principal);
    }
    return true;
}

double conjugates_pupil_distance(double f, double m, double P)
{
    return f * (1 / m + 1 / P);
}
