/* tests/unit/first_meeting.h - where a ray first meets an asphere, by search instead of Newton. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_FIRST_MEETING_H
#define LENSCALC_TESTS_UNIT_FIRST_MEETING_H

#include <math.h>
#include <stdbool.h>

#if defined(__SIZEOF_FLOAT128__) || defined(__FLOAT128__)
__extension__ typedef __float128 real;
#else
typedef long double real;
#endif

/*
 * Nothing here is taken from the program: z is the sag as everyone writes it down, a meeting a
 * change of sign of z(ray) - sag(ray) found by steps and halved to the last bit of 113, the law of
 * refraction that of vectors of unit length.
 */
struct asphere {
    double c, k, A[21]; /* A[i] r^i */
    double rim;         /* not looked at beyond this r, mm */
};

static inline real root_of(real x)
{
    real y = (real)sqrtl((long double)x);
    return y > 0 ? ((y + x / y) / 2 + x / ((y + x / y) / 2)) / 2 : 0;
}

/* NaN beyond the conic's domain. */
static inline real asphere_sag(const struct asphere *s, real r, real *slope)
{
    real inside = 1 - (1 + (real)s->k) * s->c * s->c * r * r, sum = 0, growth = 0;
    if (inside < 0) {
        *slope = (real)NAN;
        return (real)NAN;
    }
    for (int i = 20; i > 0; i--) {
        growth = growth * r + i * (real)s->A[i];
        sum = (sum + s->A[i]) * r;
    }
    real root = root_of(inside);
    *slope = growth + s->c * r / root;
    return sum + s->c * r * r / (1 + root);
}

/* How far a point of the ray is behind the surface, along z; and quickly, in 53 bits. */
static inline real behind_surface(const struct asphere *s, const real x[3], const real p[3], real d)
{
    real X = x[0] + d * p[0], Y = x[1] + d * p[1], slope;
    return x[2] + d * p[2] - asphere_sag(s, root_of(X * X + Y * Y), &slope);
}

static inline double behind_quickly(const struct asphere *s, const double x[3], const double p[3],
                                    double d)
{
    double X = x[0] + d * p[0], Y = x[1] + d * p[1], r = sqrt(X * X + Y * Y), sum = 0;
    double inside = 1 - (1 + s->k) * s->c * s->c * r * r;
    for (int i = 20; i > 0; i--) {
        sum = (sum + s->A[i]) * r;
    }
    return x[2] + d * p[2] - (sum + s->c * r * r / (1 + sqrt(inside)));
}

/*
 * The first place where the ray goes through the surface from its front to its back; light goes
 * towards +z if direction is 1. False: there is none with r below the rim, as far as `steps` along
 * the chord show.
 */
static inline bool first_meeting(const struct asphere *s, const double x[3], const double p[3],
                                 double direction, int steps, real *where)
{
    double domain = (1 + s->k) * s->c * s->c, rim2 = s->rim * s->rim;
    rim2 = domain > 0 && rim2 * domain > 1 ? 1 / domain : rim2;
    double a = p[0] * p[0] + p[1] * p[1], b = x[0] * p[0] + x[1] * p[1];
    double rest = x[0] * x[0] + x[1] * x[1] - rim2, square = b * b - a * rest;
    real X[3] = {x[0], x[1], x[2]}, P[3] = {p[0], p[1], p[2]};
    if (!(square > 0 && a > 0)) {
        if (rest > 0 || a > 0) {
            return false;
        }
        *where = -behind_surface(s, X, P, 0) / P[2]; /* along the axis */
        return true;
    }
    double half = sqrt(square) / a * (1 - 1e-12), middle = -b / a, low = -half, before = NAN;
    for (int i = 0; i <= steps; i++) {
        double at = half * (2.0 * i / steps - 1);
        double here = direction * behind_quickly(s, x, p, middle + at);
        if (before < 0 && here >= 0) {
            real front = middle + (real)low, back = middle + (real)at;
            for (int k = 0; k < 120; k++) {
                real between = (front + back) / 2;
                bool is_behind = direction * behind_surface(s, X, P, between) >= 0;
                front = is_behind ? front : between;
                back = is_behind ? between : back;
            }
            *where = (front + back) / 2;
            return true;
        }
        before = here;
        low = at;
    }
    return false;
}

/*
 * Beyond the surface: direction cosines behind it at a point r away from the axis; false where the
 * light is totally reflected.
 */
static inline bool bend_at(const struct asphere *s, const real point[3], bool reflects, double n1,
                           double n2, real cosine[3])
{
    real r = root_of(point[0] * point[0] + point[1] * point[1]), slope;
    asphere_sag(s, r, &slope);
    real N[3] = {r > 0 ? -slope * point[0] / r : 0, r > 0 ? -slope * point[1] / r : 0, 1};
    real length = root_of(N[0] * N[0] + N[1] * N[1] + 1), along = 0, ratio = (real)n1 / n2;
    for (int i = 0; i < 3; i++) {
        N[i] /= length;
        along += N[i] * cosine[i];
    }
    real square = 1 - ratio * ratio * (1 - along * along);
    if (!reflects && square < 0) {
        return false;
    }
    real more = (along < 0 ? -1 : 1) * root_of(square) - ratio * along;
    for (int i = 0; i < 3; i++) {
        cosine[i] = reflects ? cosine[i] - 2 * along * N[i] : ratio * cosine[i] + more * N[i];
    }
    return true;
}

/* Numbers that look random, the same everywhere: 0 to 1. */
static inline double chance(unsigned long long *state)
{
    *state = *state * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static inline double chance_between(unsigned long long *state, double low, double high)
{
    return low + (high - low) * chance(state);
}

#endif
