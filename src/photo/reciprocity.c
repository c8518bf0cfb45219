/* photo/reciprocity.c - reciprocity failure of films: metered time to corrected time and back. */
/* SPDX-License-Identifier: MIT */
#include "photo/reciprocity.h"

#include <math.h>

#include "photo/given.h"

static const double gainer_exponent = 1.62;

/* Two metered times nearer than this are one: there the published correction jumps. */
static const double jump = 1 + 1e-9;

/* The segment of a table that ends at or behind x. */
static int find_segment(const double *ascending, int points, double x)
{
    int i = 1;
    while (i < points - 1 && x > ascending[i]) {
        i++;
    }
    return i;
}

/* Straight line in log-log through (x0, y0), (x1, y1); exact at the far end. */
static double line_log_log(double x0, double y0, double x1, double y1, double x)
{
    return x < x1 ? y0 * exp2(log2(y1 / y0) * (log2(x / x0) / log2(x1 / x0))) : y1;
}

static double reciprocity_correct(const struct reciprocity *film, double Tm)
{
    if (film->model == RECIPROCITY_NONE || !(Tm > film->onset)) {
        return Tm;
    }
    if (film->model == RECIPROCITY_POWER) {
        return pow(Tm, film->p);
    }
    if (film->model == RECIPROCITY_GAINER) {
        return Tm + film->a * pow(Tm, gainer_exponent);
    }
    int i = find_segment(film->metered, film->points, Tm);
    return line_log_log(film->metered[i - 1], film->corrected[i - 1], film->metered[i],
                        film->corrected[i], Tm);
}

bool reciprocity_corrected(const struct reciprocity *film, double Tm, double *Tc,
                           struct error *error)
{
    if (!require_positive("exposure time", " s", Tm, error)) {
        return false;
    }
    if (!(Tm <= film->valid_to)) {
        return fail(error, ERROR_DOMAIN,
                    "{exposure time} %.10g s lies beyond the film's published range, up to %.10g s",
                    Tm, film->valid_to);
    }
    *Tc = reciprocity_correct(film, Tm);
    return answer_positive("the corrected time", *Tc, error);
}

static bool fail_gap(double Tc, double from, double to, struct error *error)
{
    return fail(error, ERROR_DOMAIN,
                "no metered time has the corrected time %.10g s: the film's published correction "
                "jumps from %.6g s to %.6g s",
                Tc, from, to);
}

static bool gainer_metered(const struct reciprocity *film, double Tc, double *Tm,
                           struct error *error)
{
    /* both terms are positive, so each alone bounds the root from above */
    double x = fmin(Tc, pow(Tc / film->a, 1 / gainer_exponent));
    for (int i = 0; i < 60; i++) {
        double power = film->a * pow(x, gainer_exponent);
        double step = (x + power - Tc) / (1 + gainer_exponent * power / x);
        x -= step;
        if (fabs(step) <= 1e-9 * x) { /* Newton squares the error: the next step is rounding */
            *Tm = x;
            return true;
        }
    }
    return fail(error, ERROR_DOMAIN, "no metered time found for %.10g s within 60 steps", Tc);
}

bool reciprocity_metered(const struct reciprocity *film, double Tc, double *Tm, struct error *error)
{
    double longest = reciprocity_correct(film, film->valid_to);
    if (!require_positive("exposure time", " s", Tc, error)) {
        return false;
    }
    if (!(Tc <= longest)) {
        return fail(error, ERROR_DOMAIN,
                    "{exposure time} %.10g s lies beyond the film's published range, up to %.10g s "
                    "corrected",
                    Tc, longest);
    }
    if (film->model == RECIPROCITY_NONE || !(Tc > film->onset)) {
        *Tm = Tc;
        return true;
    }
    if (film->model == RECIPROCITY_POWER) {
        *Tm = pow(Tc, 1 / film->p);
        if (!(*Tm >= film->onset)) {
            return fail_gap(Tc, film->onset, pow(film->onset, film->p), error);
        }
        return true;
    }
    if (film->model == RECIPROCITY_GAINER) {
        return gainer_metered(film, Tc, Tm, error);
    }
    int i = find_segment(film->corrected, film->points, Tc);
    double m0 = film->metered[i - 1], m1 = film->metered[i];
    double c0 = film->corrected[i - 1], c1 = film->corrected[i];
    if (Tc < c1 && !(m1 > m0 * jump)) {
        return fail_gap(Tc, c0, c1, error);
    }
    *Tm = line_log_log(c0, m0, c1, m1, Tc);
    return true;
}

double reciprocity_stops(double Tm, double Tc)
{
    return log2(Tc / Tm);
}
