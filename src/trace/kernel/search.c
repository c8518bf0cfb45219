/* trace/kernel/search.c - steps along the ray, then halving. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/search.h"

#include <float.h>
#include <math.h>

/* S at r^2 = u. */
static double asphere_departure(const struct step *s, double u)
{
    double even = 0, odd = 0;
    for (int i = s->terms - 1; i >= 0; i--) {
        even = (even + s->coefficient[i]) * u;
    }
    if (s->kind != STEP_ODD) {
        return even;
    }
    for (int i = STEP_TERMS - 1; i >= 0; i--) {
        odd = odd * u + s->odd[i];
    }
    return even + sqrt(u) * odd;
}

/* No sag is larger up to r, and no slope: sums without signs. */
static double most_departure(const struct step *s, double r)
{
    double u = r * r, even = 0, odd = 0;
    for (int i = STEP_TERMS - 1; i >= 0; i--) {
        even = (even + fabs(s->coefficient[i])) * u;
        odd = odd * u + fabs(s->odd[i]);
    }
    return fabs(s->c) * u + even + r * odd;
}

/* A cone's own slope is no bend. */
static double most_slope(const struct step *s, double r)
{
    double u = r * r, even = 0, odd = 0;
    for (int i = STEP_TERMS - 1; i >= 0; i--) {
        even = even * u + fabs(s->slope[i]);
        odd = odd * u + fabs(s->odd_slope[i]);
    }
    return fabs(s->c) * r + 2 * (even * r + (odd - fabs(s->odd_slope[0])));
}

/* Is the sag more than 100 times the radius there and beyond, as the highest even power rules? */
static bool step_is_far_off(const struct step *s, double r)
{
    double highest = s->terms > 0 ? fabs(s->coefficient[s->terms - 1]) : 0;
    for (int i = 0; i < s->terms; i++) {
        highest *= r * r;
    }
    return s->kind != STEP_ODD && 2 * highest - most_departure(s, r) > 100 * r;
}

void search_prepare(struct step *step)
{
    enum { HALVES = 200 };
    const double bend = step->one_k * step->c * step->c;
    const double domain = bend > 0 ? 1 / bend : (double)INFINITY;
    double inner = step->inner, rim;
    if (!(inner > 0)) { /* from 1e30 mm down to where the slope is 1 at most */
        inner = 0x1p100;
        for (int i = 0; i < HALVES && !(most_slope(step, inner) <= 1); i++) {
            inner /= 2;
        }
    }
    rim = 1000 * inner;
    while (rim > 2 * inner && step_is_far_off(step, rim / 1.25)) {
        rim /= 1.25;
    }
    step->rim2 = fmin(fmin(step->clear2, rim * rim), domain);
    step->inner = inner * inner > step->rim2 ? sqrt(step->rim2) : inner;
    step->depth = most_departure(step, sqrt(step->rim2)) * (1 + 1e-9);
}

/* A ray that is looked at; d along it. */
struct asphere_line {
    const struct step *step;
    double point[3], direction[3];
    double low, high; /* of d: the part that is looked at */
    double middle;    /* nearest to the axis */
    double fine;      /* step about there */
};

/* How far behind the surface, in the sense of the light. */
static double distance_behind(const struct asphere_line *line, double d)
{
    const struct step *s = line->step;
    double x = line->point[0] + d * line->direction[0], y = line->point[1] + d * line->direction[1];
    double u = s->weight_x * x * x + s->weight_y * y * y;
    double inside = 1 - s->one_k * s->c * s->c * u;
    double sag = s->c * u / (1 + sqrt(inside > 0 ? inside : 0)) + asphere_departure(s, u);
    return s->direction * (line->point[2] + d * line->direction[2] - sag);
}

/* Cut the part to what lies between two values of d; infinities are none. */
static void line_cut(struct asphere_line *line, double low, double high)
{
    line->low = low > line->low ? low : line->low;
    line->high = high < line->high ? high : line->high;
}

static bool set_part(struct asphere_line *line)
{
    const struct step *s = line->step;
    const double *x = line->point, *p = line->direction;
    double a = s->weight_x * p[0] * p[0] + s->weight_y * p[1] * p[1];
    double b = s->weight_x * x[0] * p[0] + s->weight_y * x[1] * p[1];
    double beyond = s->weight_x * x[0] * x[0] + s->weight_y * x[1] * x[1] - s->rim2;
    double slow = fabs(p[2]);
    line->low = -DBL_MAX;
    line->high = DBL_MAX;
    line->middle = line->fine = 0;
    if (a > 1e-30 * (a + p[2] * p[2])) {
        double square = b * b - a * beyond;
        if (!(square > 0)) {
            return false;
        }
        line->middle = -b / a;
        line->fine = s->inner / 24 / sqrt(a);
        line_cut(line, line->middle - sqrt(square) / a, line->middle + sqrt(square) / a);
    } else if (!(beyond < 0)) {
        return false;
    }
    if (slow > 0) {
        double to_plane = -x[2] / p[2], way = s->depth / slow;
        line_cut(line, to_plane - way, to_plane + way);
    }
    return line->low < line->high && line->high < DBL_MAX && line->low > -DBL_MAX;
}

/*
 * The next place to look at: farther apart the farther from the axis, and closer again towards the
 * ends, for at its rim a conic is steep.
 */
static double line_next(const struct asphere_line *line, double d)
{
    double off = fabs(d - line->middle) - 24 * line->fine, size = line->high - line->low;
    double step = line->fine + (off > 0 ? off / 5 : 0), least = size / 4096, most = size / 16;
    double end = d - line->low < line->high - d ? d - line->low : line->high - d;
    most = end / 5 < most ? end / 5 : most;
    step = step > most || !(step > 0) ? most : step;
    step = step < least ? least : step;
    return d + step < line->high ? d + step : line->high;
}

/* From the front at one d to the back at another: between which neighbours does the sign change? */
static double line_halve(const struct asphere_line *line, double front, double back)
{
    enum { HALVES = 200 };
    for (int i = 0; i < HALVES; i++) {
        double middle = 0.5 * (front + back);
        if (!(middle != front && middle != back)) {
            break;
        }
        if (distance_behind(line, middle) >= 0) {
            back = middle;
        } else {
            front = middle;
        }
    }
    return fabs(distance_behind(line, front)) < fabs(distance_behind(line, back)) ? front : back;
}

/*
 * Three places on one side of the surface, the middle one the nearest to it: one on the other side
 * if there is any between them, else where it is nearest. `side` is 1 from the front, -1 from
 * behind.
 */
static double nearest_between(const struct asphere_line *line, double side, double low, double high)
{
    enum { TURNS = 40 };
    static const double golden = 0.6180339887498949;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = side * distance_behind(line, left),
           at_right = side * distance_behind(line, right);
    for (int i = 0; i < TURNS && at_left < 0 && at_right < 0; i++) {
        if (at_left > at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = side * distance_behind(line, left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = side * distance_behind(line, right);
        }
    }
    return at_left > at_right ? left : right;
}

/* Does the ray go through and back between three places on one side of the surface? */
static bool line_touches(const struct asphere_line *line, const double d[3], const double h[3],
                         double *where)
{
    double side = h[1] < 0 ? 1 : -1;
    if (!(side * h[0] < side * h[1] && side * h[1] < 0 && side * h[2] <= side * h[1])) {
        return false;
    }
    double near = nearest_between(line, side, d[0], d[2]);
    if (!(side * distance_behind(line, near) > 0)) {
        return false;
    }
    *where = side > 0 ? line_halve(line, d[0], near) : line_halve(line, near, d[2]);
    return true;
}

/*
 * A ray along the axis is at one height, where the sign changes once. Places on both sides of that,
 * by steps that double: halving ends between the same neighbours as from afar.
 *
 * Result    false: there are none within the part that is looked at
 */
static bool bracket_along_axis(const struct asphere_line *line, double *front, double *back)
{
    enum { DOUBLINGS = 40 };
    const double slow = line->step->direction * line->direction[2];
    if (!(slow > 0) || line->fine > 0) { /* it goes aside, or back */
        return false;
    }
    const double guess = -distance_behind(line, 0) / slow;
    double step = DBL_EPSILON * fabs(guess) + DBL_MIN;
    *front = *back = guess;
    for (int i = 0;
         i < DOUBLINGS && !(distance_behind(line, *front) < 0 && distance_behind(line, *back) >= 0);
         i++) {
        *front = guess - step;
        *back = guess + step;
        step *= 2;
    }
    return *front > line->low && *back < line->high && distance_behind(line, *front) < 0 &&
           distance_behind(line, *back) >= 0;
}

double search_meet(const struct step *step, const double point[3], const double direction[3])
{
    /* from near the surface: far away steps are lost in the distance */
    double ahead = fabs(direction[2]) > 0 ? -point[2] / direction[2] : 0;
    ahead = isfinite(ahead) ? ahead : 0;
    struct asphere_line line = {.step = step,
                                .direction = {direction[0], direction[1], direction[2]}};
    for (int i = 0; i < 3; i++) {
        line.point[i] = point[i] + ahead * direction[i];
    }
    if (!set_part(&line)) {
        return (double)NAN;
    }
    double front, back;
    if (bracket_along_axis(&line, &front, &back)) {
        return ahead + line_halve(&line, front, back);
    }
    /* the last three places */
    double d[3] = {line.low, line.low, line.low}, where;
    double h[3] = {(double)NAN, (double)NAN, distance_behind(&line, line.low)};
    while (d[2] < line.high) {
        d[0] = d[1], h[0] = h[1];
        d[1] = d[2], h[1] = h[2];
        d[2] = line_next(&line, d[1]);
        if (!(d[2] > d[1])) {
            break; /* a grazing ray from afar: no step is left between two doubles */
        }
        h[2] = distance_behind(&line, d[2]);
        if (line_touches(&line, d, h, &where)) {
            return ahead + where;
        }
        if (h[1] < 0 && h[2] >= 0) {
            return ahead + line_halve(&line, d[1], d[2]);
        }
    }
    return (double)NAN;
}
