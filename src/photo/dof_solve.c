/* photo/dof_solve.c - the settings that give a wanted depth of field. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof_solve.h"

#include <math.h>

#include "base/roots.h"
#include "photo/dof_problem.h"

/* How far the setting found may miss a target, relative, times the target's condition. */
#define TOLERANCE 1e-9

/* The focal lengths tried, each so much shorter than the last: 13 decades. */
#define SCAN_RATIO 0.9
enum { SCAN_STEPS = 300 };

/* -- what follows directly -- */

static void dof_solve_settle(struct problem *p, unsigned unknown, unsigned target)
{
    p->unknown &= ~unknown;
    p->open &= ~target;
}

/* The f-number or the circle of confusion from N c. */
static void set_product(struct problem *p, double Nc)
{
    if (p->unknown & FNUMBER) {
        p->a.N = Nc / p->a.c;
    } else {
        p->a.c = Nc / p->a.N;
    }
    dof_solve_settle(p, PRODUCT, 0);
}

static void set_magnification(struct problem *p, double m)
{
    p->a.s = p->a.f + p->a.f / m;
    dof_solve_settle(p, DISTANCE, 0);
}

static double focal_from_hyperfocal(double H, double Nc)
{
    return 2 * H * (Nc / (Nc + sqrt(Nc * Nc + 4 * H * Nc)));
}

/* Any two of near, far and depth become near and far. */
static bool join_limits(struct problem *p, struct error *error)
{
    if (problem_has(p, NEAR | FAR | TOTAL)) {
        return fail(error, ERROR_USAGE,
                    "{near limit}, {far limit}, {depth of field}: give two of them, not three");
    }
    if (problem_has(p, NEAR | TOTAL)) {
        p->t.far = p->t.near + p->t.total;
    } else if (problem_has(p, FAR | TOTAL)) {
        p->t.near = p->t.far - p->t.total;
        if (!(p->t.near > 0)) {
            return fail(
                error, ERROR_DOMAIN,
                "{depth of field} %.15g mm must be below {the far limit} %.15g mm, both finite",
                p->t.total, p->t.far);
        }
    } else {
        return true;
    }
    p->open = (p->open & ~(unsigned)TOTAL) | NEAR | FAR;
    return true;
}

/* Magnification and hyperfocal distance, wherever all but one of their settings is known. */
static void settle_direct(struct problem *p)
{
    for (int pass = 0; pass < 2; pass++) {
        unsigned mine = p->unknown & (FOCAL | DISTANCE);
        double m = p->t.magnification;
        if (problem_has(p, MAGNIFICATION) && problem_count(mine) == 1) {
            if (mine == DISTANCE) {
                p->a.s = p->a.f + p->a.f / m;
            } else {
                p->a.f = p->a.s * (m / (1 + m));
            }
            dof_solve_settle(p, mine, MAGNIFICATION);
        }
        mine = p->unknown & (FOCAL | PRODUCT);
        if (problem_has(p, HYPERFOCAL) && problem_count(mine) == 1) {
            if (mine == FOCAL) {
                p->a.f = focal_from_hyperfocal(p->t.hyperfocal, p->a.N * p->a.c);
            } else {
                set_product(p, p->a.f * (p->a.f / (p->t.hyperfocal - p->a.f)));
            }
            dof_solve_settle(p, mine, HYPERFOCAL);
        }
    }
}

/* -- near and far together -- */

struct dof_solve_pair {
    double m, e;
};

/* Focus and blur that make these the limits; both inf when the lens is too long for them. */
static struct dof_solve_pair pair_of(double f, double P, double near, double far)
{
    double q = f - f / P, a = near - q, b = far - q;
    double half = f / 2 * (1 / a + 1 / b), rest = 1 - half / P;
    if (!(a > 0 && rest > 0)) {
        return (struct dof_solve_pair){INFINITY, INFINITY};
    }
    double m = half / rest;
    double between = far < INFINITY ? (far - near) / a / b : 1 / a;
    return (struct dof_solve_pair){m, f / 2 * (1 + m / P) * between};
}

static bool solve_pair(struct problem *p, struct error *error)
{
    struct dof_solve_pair x = pair_of(p->a.f, p->a.P, p->t.near, p->t.far);
    if (!(x.m < INFINITY)) {
        return fail(error, ERROR_DOMAIN,
                    "{near limit} %.15g mm and {far limit} %.15g mm are too near for {the focal "
                    "length} %.15g mm: no real image between them",
                    p->t.near, p->t.far, p->a.f);
    }
    set_magnification(p, x.m);
    set_product(p, x.e * p->a.f);
    dof_solve_settle(p, 0, NEAR | FAR);
    return true;
}

/* -- one limit, or the depth -- */

/* m for the distance at which the one target is met; below 0 or NaN where there is none. */
static double magnification_for(const struct problem *p)
{
    double f = p->a.f, P = p->a.P, e = p->a.N * p->a.c / f, q = f - f / P;
    if (problem_has(p, NEAR)) {
        return (f - (p->t.near - q) * e) / (p->t.near - f);
    }
    if (problem_has(p, FAR)) {
        return p->t.far < INFINITY ? (f + (p->t.far - q) * e) / (p->t.far - f) : e;
    }
    double T = p->t.total, g = f * e / P;
    return T < INFINITY ? g / T + sqrt(g / T * (g / T) + e * e + 2 * f * e / T) : e;
}

static bool solve_distance(struct problem *p, struct error *error)
{
    double m = magnification_for(p), f = p->a.f;
    if (!(m >= 0 && m < INFINITY)) {
        return fail(
            error, ERROR_DOMAIN,
            "{near limit} %.15g mm must lie between {the focal length} %.15g mm and %.15g mm, "
            "where it lies with the lens at infinity",
            p->t.near, f, f - f / p->a.P + f / (p->a.N * p->a.c / f));
    }
    if (!(m > 0) && !problem_has(p, NEAR)) {
        return fail(error, ERROR_DOMAIN,
                    "{circle of confusion} %.15g mm must be above 0 mm: it gives no depth of field",
                    p->a.c);
    }
    set_magnification(p, m);
    dof_solve_settle(p, 0, NEAR | FAR | TOTAL);
    return true;
}

/* e for which the one target is met. */
static double blur_for(const struct problem *p)
{
    double f = p->a.f, s = p->a.s, q = f - f / p->a.P, m = f / (s - f), X = s - f + f / p->a.P;
    if (problem_has(p, NEAR)) {
        return s < INFINITY ? m * (s - p->t.near) / (p->t.near - q) : f / (p->t.near - q);
    }
    if (problem_has(p, FAR)) {
        return p->t.far < INFINITY ? m * (p->t.far - s) / (p->t.far - q) : m;
    }
    return p->t.total < INFINITY ? m * (p->t.total / (X + hypot(X, p->t.total))) : m;
}

static bool solve_blur(struct problem *p, struct error *error)
{
    if (!(p->a.s < INFINITY) && !problem_has(p, NEAR)) {
        return fail(
            error, ERROR_DOMAIN,
            "{distance} inf has no far limit and no finite depth: it must be finite, or give "
            "{near limit}");
    }
    set_product(p, blur_for(p) * p->a.f);
    dof_solve_settle(p, 0, NEAR | FAR | TOTAL);
    return true;
}

/* -- unknown focal length -- */

/* The setting that goes with this focal length, the other unknowns following from it. */
static struct dof_setting dof_solve_complete(const struct problem *p, double f)
{
    struct dof_setting a = p->a;
    a.f = f;
    if (problem_has(p, MAGNIFICATION)) {
        a.s = f + f / p->t.magnification;
    }
    if (problem_has(p, HYPERFOCAL)) {
        a.c = 1;
        a.N = f * (f / (p->t.hyperfocal - f));
    }
    return a;
}

/* (value - wanted)/(value + wanted): the sign of the difference, never beyond +-1. */
static double dof_solve_compare(double value, double wanted)
{
    if (!(value > 0)) {
        return -1;
    }
    return value < INFINITY ? (value - wanted) / (value + wanted) : 1;
}

static double pair_residual(double f, const void *context)
{
    const struct problem *p = context;
    struct dof_solve_pair x = pair_of(f, p->a.P, p->t.near, p->t.far);
    if (problem_has(p, MAGNIFICATION)) {
        return dof_solve_compare(x.m, p->t.magnification);
    }
    return problem_has(p, HYPERFOCAL) ? dof_solve_compare(f / x.e + f, p->t.hyperfocal)
                                      : dof_solve_compare(x.e * f, p->a.N * p->a.c);
}

static double single_residual(double f, const void *context)
{
    const struct problem *p = context;
    struct dof_setting a = dof_solve_complete(p, f);
    struct error ignored;
    struct dof d;
    if (!dof_compute(&a, DOF_EXACT, &d, &ignored)) {
        return 1;
    }
    if (problem_has(p, NEAR)) {
        return dof_solve_compare(d.near, p->t.near);
    }
    return problem_has(p, FAR) ? dof_solve_compare(d.far, p->t.far)
                               : dof_solve_compare(d.total, p->t.total);
}

/* The longest focal length worth a look. */
static double longest_focal(const struct problem *p)
{
    double longest = 1e9;
    if (!(p->unknown & DISTANCE)) {
        longest = fmin(longest, nextafter(p->a.s, 0));
    }
    if (problem_has(p, HYPERFOCAL)) {
        longest = fmin(longest, nextafter(p->t.hyperfocal, 0));
    }
    if (problem_has(p, NEAR)) { /* a nearer limit would have no real image */
        longest = fmin(longest, nextafter(p->t.near, 0));
    }
    if (problem_has(p, FAR)) {
        longest = fmin(longest, nextafter(p->t.far, 0));
    }
    return longest;
}

/* Three focal lengths, the middle one nearest to a solution; the residual has one sign at all. */
struct dip {
    double low, middle, high;
    double least; /* |residual| in the middle */
};

/* Narrow the dip down until the sign changes in it; false when it stays above 0. */
static bool sink(struct dip *dip, const struct problem *p, root_function *residual, double sign)
{
    for (int step = 0; step < 100; step++) {
        bool upper = dip->high - dip->middle > dip->middle - dip->low;
        double probe = dip->middle + 0.381966 * ((upper ? dip->high : dip->low) - dip->middle);
        double value = residual(probe, p);
        bool better = fabs(value) < dip->least, crossed = (value <= 0) != (sign <= 0);
        if (better || crossed) {
            if (upper) {
                dip->low = dip->middle;
            } else {
                dip->high = dip->middle;
            }
            dip->middle = probe;
            dip->least = fabs(value);
        } else {
            if (upper) {
                dip->high = probe;
            } else {
                dip->low = probe;
            }
        }
        if (crossed) {
            return true;
        }
    }
    return false;
}

/* Shorten the focal length until the sign changes, then close in: the longest that will do. */
static bool search_focal(struct problem *p, root_function *residual, struct error *error)
{
    double longest = longest_focal(p), sign = residual(longest, p), high = longest;
    struct dip dip = {.least = INFINITY};
    for (int i = 0; i < SCAN_STEPS; i++) {
        double low = high * SCAN_RATIO, value = residual(low, p);
        if ((value <= 0) != (sign <= 0)) {
            return root_find(residual, p, low, high, &p->a.f, error);
        }
        if (fabs(value) < dip.least) {
            dip = (struct dip){low * SCAN_RATIO, low, high, fabs(value)};
        }
        high = low;
    }
    if (sink(&dip, p, residual, sign)) {
        return root_find(residual, p, dip.middle, dip.high, &p->a.f, error);
    }
    return fail(error, ERROR_DOMAIN, "no focal length from 0 to %.15g mm meets these conditions",
                longest);
}

/* Infinity shall be sharp: s = H, no search needed. */
static bool solve_focal_at_hyperfocal(struct problem *p, struct error *error)
{
    if (problem_has(p, HYPERFOCAL)) {
        if (!(p->unknown & DISTANCE)) {
            return problem_undetermined(p, error);
        }
        p->a.s = p->t.hyperfocal;
        dof_solve_settle(p, DISTANCE, FAR | TOTAL);
        settle_direct(p);
        return true;
    }
    double Nc = p->a.N * p->a.c;
    if (problem_has(p, MAGNIFICATION)) {
        p->a.f = Nc / p->t.magnification; /* m = e */
    } else {
        p->a.f = focal_from_hyperfocal(p->a.s, Nc);
    }
    dof_solve_settle(p, FOCAL, FAR | TOTAL);
    settle_direct(p);
    return true;
}

static bool solve_focal_single(struct problem *p, struct error *error)
{
    if ((p->unknown & DISTANCE) && !problem_has(p, MAGNIFICATION) &&
        !(problem_has(p, HYPERFOCAL) && (p->t.far == INFINITY || p->t.total == INFINITY))) {
        return problem_undetermined(p, error);
    }
    if ((p->unknown & PRODUCT) && !problem_has(p, HYPERFOCAL)) {
        return problem_undetermined(p, error);
    }
    if (p->t.far == INFINITY || p->t.total == INFINITY) {
        return solve_focal_at_hyperfocal(p, error);
    }
    if (!search_focal(p, single_residual, error)) {
        return false;
    }
    dof_solve_settle(p, FOCAL, NEAR | FAR | TOTAL);
    settle_direct(p);
    return true;
}

static bool solve_focal_pair(struct problem *p, struct error *error)
{
    unsigned rest = p->open & (HYPERFOCAL | MAGNIFICATION);
    if (!(p->unknown & DISTANCE) || (!rest && (p->unknown & PRODUCT))) {
        return problem_undetermined(p, error);
    }
    if (!search_focal(p, pair_residual, error)) {
        return false;
    }
    struct dof_solve_pair x = pair_of(p->a.f, p->a.P, p->t.near, p->t.far);
    set_magnification(p, x.m);
    if (p->unknown & PRODUCT) {
        set_product(p, x.e * p->a.f);
    }
    dof_solve_settle(p, FOCAL, NEAR | FAR | rest);
    return true;
}

/* -- all together -- */

static bool dof_solve_rest(struct problem *p, struct error *error)
{
    unsigned limits = p->open & (NEAR | FAR | TOTAL), others = p->open & ~limits;
    if ((p->unknown & PRODUCT) == PRODUCT || (!limits && p->open)) {
        return problem_undetermined(p, error);
    }
    if (p->unknown & FOCAL) {
        return limits == (NEAR | FAR) ? solve_focal_pair(p, error) : solve_focal_single(p, error);
    }
    if (others) {
        return problem_undetermined(p, error);
    }
    if (limits == (NEAR | FAR) && (p->unknown & DISTANCE) && (p->unknown & PRODUCT)) {
        return solve_pair(p, error);
    }
    if (problem_count(limits) != 1 || problem_count(p->unknown) != 1) {
        return p->open ? problem_undetermined(p, error) : true;
    }
    return p->unknown == DISTANCE ? solve_distance(p, error) : solve_blur(p, error);
}

/* Where infinity shall be sharp, step over the last bits that rounding left out. */
static void include_infinity(struct problem *p, unsigned solved)
{
    struct dof_setting *a = &p->a;
    struct error ignored;
    struct dof d;
    double *which = solved & FNUMBER ? &a->N : &a->c;
    if (!(solved & ~(unsigned)FOCAL)) {
        which = &a->f;
    } else if (solved & DISTANCE) {
        which = &a->s;
    }
    double end = which == &a->f ? 0 : INFINITY;
    for (int step = 0; step < 16; step++) {
        if (!dof_compute(a, DOF_EXACT, &d, &ignored) || !(d.far < INFINITY)) {
            return;
        }
        *which = nextafter(*which, end);
    }
}

static bool met(double value, double wanted, double condition)
{
    return isnan(wanted) || value == wanted ||
           fabs(value - wanted) <= TOLERANCE * condition * fabs(wanted);
}

/* The solution, put back, must give the targets. */
static bool verify(const struct problem *p, struct error *error)
{
    struct dof d;
    if (!dof_compute(&p->a, DOF_EXACT, &d, error)) {
        return false;
    }
    const struct dof_targets *t = &p->t;
    double near = d.near_condition < INFINITY ? d.near_condition : 1;
    double far = d.far_condition < INFINITY ? d.far_condition : 1;
    double focus = p->a.s < INFINITY ? p->a.s / (p->a.s - p->a.f) : 1;
    double depth = p->a.s < INFINITY ? far + p->a.s / d.total : far;
    return (met(d.near, t->near, near) && met(d.far, t->far, far) &&
            met(d.total, t->total, depth * focus) && met(d.hyperfocal, t->hyperfocal, 1) &&
            met(d.magnification, t->magnification, focus)) ||
           fail(error, ERROR_DOMAIN,
                "no setting meets all of these: the nearest, %.15g mm f/%.15g at %.15g mm with "
                "{circle of confusion} %.15g mm, is sharp from %.15g mm to %.15g mm",
                p->a.f, p->a.N, p->a.s, p->a.c, d.near, d.far);
}

bool dof_solve(struct dof_setting *setting, const struct dof_targets *targets, struct error *error)
{
    struct problem p = {.a = *setting, .t = *targets};
    problem_collect(&p);
    unsigned solved = p.unknown;
    if (!problem_check_count(&p, error) || !problem_check_targets(&p.t, error) ||
        !problem_check_known(&p, error) || !join_limits(&p, error)) {
        return false;
    }
    settle_direct(&p);
    if (!problem_check_limits(&p, error) || !dof_solve_rest(&p, error)) {
        return false;
    }
    if (targets->far == INFINITY || targets->total == INFINITY) {
        include_infinity(&p, solved);
    }
    if (!verify(&p, error)) {
        return false;
    }
    *setting = p.a;
    return true;
}
