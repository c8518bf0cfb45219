/* optics/lensmaker.c - one lens: the lens-maker's formula, thin or thick, in any media. */
/* SPDX-License-Identifier: MIT */
#include "optics/lensmaker.h"

#include "base/pair.h"

#include <math.h>
#include <stddef.h>

/* Differences of products that nearly cancel are made of pairs. */
static struct pair lensmaker_scaled(struct pair a, double k)
{
    return pair_multiply(a, pair_of(k));
}

/* A radius as a quotient a/b, so that a plane is 1/0 and needs no case of its own. */
struct radius {
    double a, b;
};

static struct radius lensmaker_radius_of(double R)
{
    return isinf(R) ? (struct radius){1, 0} : (struct radius){R, 1};
}

/* What all formulas are made of: n - n0, n1 - n and the products with R1, R2. */
struct lensmaker_terms {
    struct radius r1, r2;
    struct pair step1, step2;  /* n - n0, n1 - n */
    struct pair first, second; /* n (n - n0) b1 a2, n (n1 - n) b2 a1 */
    struct pair between;       /* -d (n - n0)(n1 - n) b1 b2 */
    struct pair M;             /* their sum: n a1 a2 P */
};

static struct lensmaker_terms terms_of(const struct lensmaker *lens)
{
    struct lensmaker_terms t = {.r1 = lensmaker_radius_of(lens->R1),
                                .r2 = lensmaker_radius_of(lens->R2),
                                .step1 = pair_sum(lens->n, -lens->n0),
                                .step2 = pair_sum(lens->n1, -lens->n)};
    t.first = lensmaker_scaled(lensmaker_scaled(t.step1, lens->n), t.r1.b * t.r2.a);
    t.second = lensmaker_scaled(lensmaker_scaled(t.step2, lens->n), t.r2.b * t.r1.a);
    t.between = lensmaker_scaled(pair_multiply(t.step1, t.step2), -lens->d * (t.r1.b * t.r2.b));
    t.M = pair_add(pair_add(t.first, t.second), t.between);
    return t;
}

/* n a - d step b: what the other surface sees of one of radius a/b. */
static struct pair reduced(const struct lensmaker *lens, struct radius r, struct pair step)
{
    return pair_add(pair_multiply(pair_of(lens->n), pair_of(r.a)),
                    lensmaker_scaled(step, -lens->d * r.b));
}

void lensmaker_facts(const struct lensmaker *lens, struct lensmaker_facts *facts)
{
    struct lensmaker_terms t = terms_of(lens);
    double n0 = lens->n0, n = lens->n, n1 = lens->n1, d = lens->d;
    double a1 = t.r1.a, a2 = t.r2.a, M = t.M.hi;
    struct pair back = lensmaker_scaled(reduced(lens, t.r1, t.step1), n1);
    struct pair front = lensmaker_scaled(reduced(lens, t.r2, t.step2), -n0);
    facts->P1 = t.r1.b == 0 ? 0 : t.step1.hi / a1;
    facts->P2 = t.r2.b == 0 ? 0 : t.step2.hi / a2;
    facts->power = M / (n * a1 * a2);
    facts->efl = M == 0 ? INFINITY : n * a1 * a2 / M;
    facts->front_focal = M == 0 ? -INFINITY : -n0 * facts->efl;
    facts->rear_focal = n1 * facts->efl;
    facts->bfl = back.hi * a2 / M;
    facts->ffl = front.hi * a1 / M;
    double H_rear = -n1 * d * t.step1.hi * t.r1.b * a2;
    double H = n0 * d * t.step2.hi * t.r2.b * a1;
    facts->H_rear = H_rear == 0 && M != 0 ? 0 : H_rear / M;
    facts->H = H == 0 && M != 0 ? 0 : H / M;
    /* N' - F' = -n0/P and N - F = n1/P, with the sum made before the division */
    struct pair media = lensmaker_scaled(pair_multiply(pair_sum(n1, -n0), pair_of(n)), a1);
    struct pair rear = pair_add(media, lensmaker_scaled(t.step1, -n1 * d * t.r1.b));
    media = lensmaker_scaled(pair_multiply(pair_sum(n1, -n0), pair_of(n)), a2);
    struct pair fore = pair_add(media, lensmaker_scaled(t.step2, n0 * d * t.r2.b));
    facts->N_rear = rear.hi == 0 && M != 0 ? 0 : rear.hi * a2 / M;
    facts->N = fore.hi == 0 && M != 0 ? 0 : fore.hi * a1 / M;
    double size = fabs(t.first.hi) + fabs(t.second.hi) + fabs(t.between.hi);
    facts->condition = M != 0 ? size / fabs(M) : 1;
}

/* ---- what is asked for ---- */

static bool check_positive(double value, const char *what, struct error *error)
{
    return isnan(value) || (value > 0 && isfinite(value)) ||
           fail(error, ERROR_DOMAIN, "index %s %.6g is out of range: it must be above 0", what,
                value);
}

static bool lensmaker_check(const struct lensmaker *lens, struct error *error)
{
    if (!check_positive(lens->n0, "before the lens", error) ||
        !check_positive(lens->n, "of the lens", error) ||
        !check_positive(lens->n1, "after the lens", error)) {
        return false;
    }
    if (lens->R1 == 0 || lens->R2 == 0) {
        return fail(error, ERROR_DOMAIN, "radius 0 mm is not a surface: inf is a plane");
    }
    if (lens->f == 0) {
        return fail(error, ERROR_DOMAIN,
                    "focal length 0 mm is not a lens: it must be above or below 0; inf is afocal");
    }
    if (!isnan(lens->d) && (!(lens->d >= 0) || isinf(lens->d))) {
        return fail(error, ERROR_DOMAIN,
                    "thickness %.6g mm is out of range: it must be 0 mm or more", lens->d);
    }
    return true;
}

static double shape_factor(double R1, double R2)
{
    if (isinf(R1)) {
        return isinf(R2) ? NAN : -1;
    }
    if (isinf(R2)) {
        return 1;
    }
    return R1 == R2 ? INFINITY : (R2 + R1) / (R2 - R1) + 0.0; /* no -0 */
}

/* One radius and the shape factor give the other radius: R2 (q - 1) = R1 (q + 1). */
static bool apply_shape(struct lensmaker *lens, struct error *error)
{
    bool first = isnan(lens->R2); /* R1 is given */
    double q = lens->q, known = first ? lens->R1 : lens->R2;
    if (isinf(q)) {
        lens->R1 = lens->R2 = known;
        return true;
    }
    double up = first ? q + 1 : q - 1, down = first ? q - 1 : q + 1;
    if (isinf(known) && up == 0) {
        return true; /* still one radius: the shape factor says no more than the plane */
    }
    if (up == 0) {
        return fail(error, ERROR_DOMAIN,
                    "shape factor %.6g makes the %s surface plane: a radius of %.6g mm there does "
                    "not go with it",
                    q, first ? "first" : "second", known);
    }
    double other = down == 0 || isinf(known) ? INFINITY : known * (up / down);
    if (first) {
        lens->R2 = other;
    } else {
        lens->R1 = other;
    }
    return true;
}

/* R2 from f, R1, n, d. */
static bool solve_rear_radius(struct lensmaker *lens, const char *which, struct error *error)
{
    if (lens->n == lens->n1) {
        return fail(error, ERROR_DOMAIN,
                    "equal indices %.6g on both sides of the %s surface: no radius there has any "
                    "effect",
                    lens->n, which);
    }
    struct radius r1 = lensmaker_radius_of(lens->R1);
    struct pair step1 = pair_sum(lens->n, -lens->n0), step2 = pair_sum(lens->n1, -lens->n);
    struct pair up = pair_multiply(step2, reduced(lens, r1, step1));
    struct pair down = lensmaker_scaled(step1, -lens->n * r1.b); /* f infinite: P = 0 */
    if (isfinite(lens->f)) {
        down = pair_add(pair_multiply(pair_of(lens->n), pair_of(r1.a)),
                        lensmaker_scaled(down, lens->f));
        up = lensmaker_scaled(up, lens->f);
    }
    if (up.hi == 0) {
        return fail(error, ERROR_DOMAIN,
                    "the other surface has its focus in the vertex of the %s one: no radius there "
                    "changes the focal length",
                    which);
    }
    lens->R2 = down.hi == 0 ? INFINITY : up.hi / down.hi;
    return true;
}

static bool solve_thickness(struct lensmaker *lens, struct error *error)
{
    struct lensmaker thin = *lens;
    thin.d = 0;
    struct lensmaker_terms t = terms_of(&thin);
    struct pair step = lensmaker_scaled(pair_multiply(t.step1, t.step2), t.r1.b * t.r2.b);
    if (step.hi == 0) {
        return fail(error, ERROR_DOMAIN,
                    "a surface without power: the thickness does not change the focal length");
    }
    /* d step = n a1 a2 (P thin - P) */
    struct pair wanted = {0, 0};
    if (isfinite(lens->f)) {
        struct pair product =
            lensmaker_scaled(pair_multiply(pair_of(-t.r1.a), pair_of(t.r2.a)), lens->n);
        double q = product.hi / lens->f;
        wanted = (struct pair){q, (fma(-q, lens->f, product.hi) + product.lo) / lens->f};
    }
    lens->d = pair_add(t.M, wanted).hi / step.hi;
    if (lens->d == 0 || lens->d > 0) {
        return true;
    }
    double f0 = lens->n * t.r1.a * t.r2.a / t.M.hi;
    return fail(error, ERROR_DOMAIN,
                "the thickness would be %.6g mm: these radii thin have a focal length of %.6g mm, "
                "and thickness only moves the power %s, not to %.6g mm",
                lens->d, f0, step.hi * t.r1.a * t.r2.a > 0 ? "down" : "up", lens->f);
}

/*
 * Roots of a x^2 + b x + e = 0, that first which stays as `vanishing` (a, or e) goes to 0.
 *
 * Result    how many: 0 to 2; -1 if every x is one or none can be
 */
static int quadratic(double a, double b, double e, bool e_vanishes, double roots[2])
{
    double discriminant = fma(b, b, -4 * a * e);
    if (a == 0) {
        roots[0] = -e / b;
        return b == 0 ? -1 : 1;
    }
    if (!(discriminant >= 0)) {
        return 0;
    }
    double t = -(b + copysign(sqrt(discriminant), b)) / 2;
    if (t == 0) {
        roots[0] = 0;
        return 1;
    }
    double large = t / a, small = e / t;
    roots[0] = e_vanishes ? large : small;
    roots[1] = e_vanishes ? small : large;
    return discriminant > 0 ? 2 : 1;
}

static bool lensmaker_choose(const double *roots, struct lensmaker_choice *choice, double *root,
                             struct error *error)
{
    if (choice->second && choice->count < 2) {
        return fail(error, ERROR_DOMAIN, "there is only one such lens, no second one");
    }
    *root = roots[choice->second ? 1 : 0];
    return true;
}

static bool lensmaker_solve_index(struct lensmaker *lens, struct lensmaker_choice *choice,
                                  struct error *error)
{
    struct radius r1 = lensmaker_radius_of(lens->R1), r2 = lensmaker_radius_of(lens->R2);
    double P = r1.a * r2.a / lens->f; /* times a1 a2, as everything here */
    double both = lens->d * (r1.b * r2.b), one = r1.b * r2.a, two = r2.b * r1.a;
    double a = pair_add(pair_sum(one, -two), pair_of(both)).hi;
    double b = pair_add(pair_add(pair_multiply(pair_of(-lens->n0), pair_of(one)),
                                 pair_multiply(pair_of(lens->n1), pair_of(two))),
                        pair_sum(-P, -both * (lens->n0 + lens->n1)))
                   .hi;
    double roots[2], legal[2] = {NAN, NAN};
    int count = quadratic(a, b, both * lens->n0 * lens->n1, true, roots);
    if (count < 0) {
        return fail(error, ERROR_DOMAIN,
                    "equal curvatures and no thickness: the index does not change the power");
    }
    choice->count = 0;
    for (int i = 0; i < count; i++) {
        if (roots[i] >= 1 && isfinite(roots[i])) {
            legal[choice->count++] = roots[i];
        }
    }
    if (choice->count == 0 && count > 0) {
        return fail(error, ERROR_DOMAIN,
                    "the index would be %.6g: it must be 1 or more (has the focal length the sign "
                    "that these radii make?)",
                    roots[0]);
    }
    if (choice->count == 0) {
        return fail(error, ERROR_DOMAIN,
                    "no index gives these radii and this thickness a focal length of %.6g mm",
                    lens->f);
    }
    return lensmaker_choose(legal, choice, &lens->n, error);
}

/* Both radii from f, n, q. */
static bool solve_bending(struct lensmaker *lens, struct lensmaker_choice *choice,
                          struct error *error)
{
    bool steep = fabs(lens->q) > 1; /* then in terms of 1/q */
    double w = steep ? 1 / lens->q : lens->q;
    double k1 = steep ? 1 + w : w + 1, k2 = steep ? 1 - w : w - 1;
    double step1 = lens->n - lens->n0, step2 = lens->n1 - lens->n;
    double A = -lens->d / lens->n * step1 * step2 * k1 * k2;
    double B = pair_add(pair_multiply(pair_of(step1), pair_of(k1)),
                        pair_multiply(pair_of(step2), pair_of(k2)))
                   .hi;
    double P = 1 / lens->f, roots[2], x = NAN;
    choice->count = quadratic(A, B, -P, false, roots);
    if (choice->count < 0) {
        return fail(error, ERROR_DOMAIN,
                    "a thin lens of shape factor %.6g has no power in these media", lens->q);
    }
    if (choice->count == 0) {
        double most = -B * B / (4 * A);
        return fail(error, ERROR_DOMAIN,
                    "no lens of this shape, index and thickness has a focal length of %.6g mm: its "
                    "power is at %s %.6g dioptres, %.6g mm",
                    lens->f, A > 0 ? "least" : "most", 1000 * most, 1 / most);
    }
    if (!lensmaker_choose(roots, choice, &x, error)) {
        return false;
    }
    lens->R1 = k1 * x == 0 ? INFINITY : 1 / (k1 * x);
    lens->R2 = k2 * x == 0 ? INFINITY : 1 / (k2 * x);
    return true;
}

static bool too_little(struct error *error)
{
    return fail(error, ERROR_USAGE,
                "too little is given: two radii and the index; or the focal length and two of "
                "first radius, second radius (or shape factor) and index");
}

/* A shape factor stands for the radius that is missing; with both radii it is too much. */
static bool use_shape(struct lensmaker *lens, struct error *error)
{
    if (isnan(lens->q)) {
        return true;
    }
    int radii = !isnan(lens->R1) + !isnan(lens->R2);
    if (radii == 2) {
        return fail(error, ERROR_USAGE,
                    "too much is given: the shape factor follows from the two radii");
    }
    return radii == 0 || apply_shape(lens, error);
}

/* Find what is not given. */
static bool lensmaker_complete(struct lensmaker *lens, struct lensmaker_choice *choice,
                               struct error *error)
{
    if (!isnan(lens->f)) {
        /* f is given: find the one or two that are missing. */
        bool thin = isnan(lens->d);
        int radii = !isnan(lens->R1) + !isnan(lens->R2);
        if (radii == 2 && !isnan(lens->n)) {
            return thin ? solve_thickness(lens, error)
                        : fail(error, ERROR_USAGE,
                               "too much is given: the focal length follows from radii, index and "
                               "thickness");
        }
        lens->d = thin ? 0 : lens->d;
        if (radii == 2) {
            return lensmaker_solve_index(lens, choice, error);
        }
        if (isnan(lens->n)) {
            return too_little(error);
        }
        if (radii == 1) {
            if (isnan(lens->R2)) {
                return solve_rear_radius(lens, "second", error);
            }
            struct lensmaker other = (struct lensmaker){lens->n1,  lens->n, lens->n0, -lens->R2,
                                                        -lens->R1, lens->d, lens->f,  -lens->q};
            if (!solve_rear_radius(&other, "first", error)) {
                return false;
            }
            lens->R1 = isinf(other.R2) ? INFINITY : -other.R2;
            return true;
        }
        return isnan(lens->q) ? too_little(error) : solve_bending(lens, choice, error);
    }
    lens->d = isnan(lens->d) ? 0 : lens->d;
    return (!isnan(lens->R1) && !isnan(lens->R2) && !isnan(lens->n)) || too_little(error);
}

bool lensmaker_solve(struct lensmaker *lens, struct lensmaker_choice *choice, struct error *error)
{
    choice->count = 1;
    bool shape = !isnan(lens->q);
    if (!lensmaker_check(lens, error) || !use_shape(lens, error) ||
        !lensmaker_complete(lens, choice, error)) {
        return false;
    }
    if (choice->second && choice->count < 2) {
        return fail(error, ERROR_DOMAIN, "there is only one such lens, no second one");
    }
    if (!shape) {
        lens->q = shape_factor(lens->R1, lens->R2);
    }
    struct lensmaker_facts facts;
    lensmaker_facts(lens, &facts);
    if (!isfinite(facts.power)) {
        return fail(error, ERROR_DOMAIN,
                    "these radii and indices are too small or too large for "
                    "the numbers of this program");
    }
    if (isnan(lens->f)) {
        lens->f = facts.efl;
    }
    return true;
}

bool lensmaker_solve_ball(struct lensmaker *lens, struct lensmaker_choice *choice,
                          struct error *error)
{
    double n0 = lens->n0, n = lens->n, n1 = lens->n1;
    choice->count = 1;
    if (!lensmaker_check(lens, error)) {
        return false;
    }
    if (!isnan(lens->R1) || !isnan(lens->R2) || !isnan(lens->q)) {
        return fail(
            error, ERROR_USAGE,
            "a ball has no radii or shape factor of its own: its thickness is its diameter");
    }
    if (isnan(lens->d) + isnan(n) + isnan(lens->f) != 1) {
        return fail(error, ERROR_USAGE,
                    "of a ball give two of diameter (thickness), index and focal length");
    }
    if (isnan(lens->d)) {
        lens->d = 2 * lens->f * ((n - n0) + (n - n1) - 2 * (n - n0) * (n - n1) / n);
        if (!(lens->d > 0) || isinf(lens->d)) {
            return fail(
                error, ERROR_DOMAIN,
                "the diameter would be %.6g mm: no ball of index %.6g has a focal length of "
                "%.6g mm in these media",
                lens->d, n, lens->f);
        }
        double f = lens->f;
        lens->f = NAN;
        lens->R1 = lens->d / 2;
        lens->R2 = -lens->R1;
        bool done = lensmaker_solve(lens, choice, error);
        lens->f = f;
        return done;
    }
    if (!(lens->d > 0)) {
        return fail(error, ERROR_DOMAIN, "a ball of diameter %.6g mm: it must be above 0 mm",
                    lens->d);
    }
    lens->R1 = lens->d / 2;
    lens->R2 = -lens->R1;
    return lensmaker_solve(lens, choice, error);
}
