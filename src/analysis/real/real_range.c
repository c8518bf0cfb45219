/* analysis/real/real_range.c - what is sharp before a real lens, and where its film may stand. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_range.h"

#include <math.h>

/* A quantity that changes its sign, to be solved for. */
struct equation {
    const struct real_focus *focus;
    double front, c;
    double film;                    /* of the blur of objects */
    const struct real_point *point; /* of the blur on films */
    struct error *error;
    bool has_failed; /* the error says why */
};

/* Its value at x; NaN with the error set: it has none. */
typedef double excess(struct equation *equation, double x);

/* What an object says on a film, and where it is sharpest itself. */
static bool real_range_look(struct equation *equation, double vergence, double *blur,
                            double *sharpest)
{
    struct arena *arena = equation->focus->arena;
    const struct arena_mark mark = arena_mark(arena);
    struct real_point point;
    /* the object lies so far before the first vertex, by its vergence from the principal plane */
    const double object = vergence > 0 ? 1 / vergence - equation->front : INFINITY;
    const bool found = real_focus_point(equation->focus, object, &point, equation->error);
    *sharpest = found ? point.sharpest : (double)NAN;
    *blur = found ? real_focus_blur(equation->focus, &point, equation->film) : (double)NAN;
    arena_reset(arena, mark);
    equation->has_failed = equation->has_failed || !found;
    return found;
}

/* Squares are nearly parabolas where blurs themselves have a corner. */
static double excess_of_object(struct equation *equation, double vergence)
{
    double blur, sharpest;
    real_range_look(equation, vergence, &blur, &sharpest);
    return blur * blur - equation->c * equation->c;
}

static double excess_of_film(struct equation *equation, double film)
{
    const double blur = real_focus_blur(equation->focus, equation->point, film);
    return blur * blur - equation->c * equation->c;
}

static double excess_of_focus(struct equation *equation, double vergence)
{
    double blur, sharpest;
    real_range_look(equation, vergence, &blur, &sharpest);
    return sharpest - equation->film;
}

/*
 * The root between two places of different signs, by the Illinois method: the end that stays has
 * its value halved, so that both ends close in.
 */
static double root_between(excess *value, struct equation *equation, double low, double at_low,
                           double high, double at_high)
{
    enum { TURNS = 100 };
    for (int turn = 0; turn < TURNS && fabs(high - low) > 2e-16 * fabs(high); turn++) {
        const double x = high - at_high * (high - low) / (at_high - at_low);
        const double y = value(equation, x);
        if (y == 0 || isnan(y) || x == high) {
            return isnan(y) ? y : x;
        }
        if ((y > 0) != (at_high > 0)) {
            low = high;
            at_low = at_high;
        } else {
            at_low /= 2;
        }
        high = x;
        at_high = y;
    }
    return high;
}

/* From where the value is below 0, in steps, to where it is above; NaN: not before `end`. */
static double root_beyond(excess *value, struct equation *equation, double from, double step,
                          double end)
{
    enum { STEPS = 400 };
    double low = from, at_low = value(equation, low);
    for (int i = 0; i < STEPS && low != end && !isnan(at_low); i++) {
        double high = low + step, at_high;
        if (step > 0 ? high > end : high < end) {
            high = end;
        }
        at_high = value(equation, high);
        if (at_high > 0) {
            return root_between(value, equation, low, at_low, high, at_high);
        }
        low = high;
        at_low = at_high;
        step *= 1.25;
    }
    return NAN;
}

static bool check_reach(const struct real_focus *focus, double c, struct error *error)
{
    return c < blur_rule_reach(focus->rule) ||
           fail(error, ERROR_DOMAIN,
                "at %.6g/mm the contrast says nothing of a circle of confusion of %.6g mm: below "
                "%.6g mm it does",
                focus->rule.at, c, blur_rule_reach(focus->rule));
}

/* Films between which the point is sharp enough. */
static void find_films(struct equation *equation, struct real_range *range)
{
    const double step = equation->c / sqrt(equation->point->spread) / 16;
    range->film_low =
        root_beyond(excess_of_film, equation, equation->point->sharpest, -step, -INFINITY);
    range->film_high =
        root_beyond(excess_of_film, equation, equation->point->sharpest, step, INFINITY);
}

/* How the vergence of objects changes with the place of their image, about. */
static double vergence_step(struct equation *equation, double distance, double shift)
{
    double blur, here, there;
    const double v = isinf(distance) ? 0 : 1 / distance;
    const double more = v > 0 ? 1e-4 * v : 1e-7;
    if (!real_range_look(equation, v, &blur, &here) ||
        !real_range_look(equation, v + more, &blur, &there)) {
        return NAN;
    }
    return fabs(shift * more / (there - here));
}

/* Of the far limit; 0: infinity is sharp; NaN: it is not found. */
static double far_vergence(struct equation *equation, double v, double step, double at_infinity)
{
    const bool sharp = !(at_infinity > equation->c);
    /* contrast may come back after it was lost */
    if (sharp && equation->focus->rule.measure != BLUR_MTF) {
        return 0;
    }
    const double far = root_beyond(excess_of_object, equation, v, -step, 0);
    return sharp && isnan(far) ? 0 : far;
}

static bool find_objects(struct equation *equation, double distance, double step,
                         struct real_range *range)
{
    const double v = isinf(distance) ? 0 : 1 / distance;
    double blur, near, far = 0;
    if (!real_range_look(equation, 0, &range->blur_at_infinity, &range->film_far)) {
        return false;
    }
    /* An object may come as near as the first vertex. */
    const double inside = 1 - 1e-9;
    near = root_beyond(excess_of_object, equation, v, step,
                       equation->front > 0 ? inside / equation->front : INFINITY);
    if (v > 0) {
        far = far_vergence(equation, v, step, range->blur_at_infinity);
    }
    if (!(range->blur_at_infinity < blur_rule_reach(equation->focus->rule))) {
        range->blur_at_infinity = NAN;
    }
    range->near = 1 / near;
    range->far = far > 0 ? 1 / far : INFINITY;
    if (isnan(near) || isnan(far)) {
        return !equation->has_failed &&
               fail(equation->error, ERROR_DOMAIN, "the %s",
                    isnan(near) ? "near limit lies inside the lens" : "far limit is not found");
    }
    return real_range_look(equation, near, &blur, &range->film_near) &&
           (!(far > 0) || real_range_look(equation, far, &blur, &range->film_far));
}

bool real_range_find(const struct real_focus *focus, double front, double distance, double c,
                     struct real_range *range, struct error *error)
{
    struct equation equation = {.focus = focus, .front = front, .c = c, .error = error};
    const struct arena_mark mark = arena_mark(focus->arena);
    struct real_point subject;
    if (!check_reach(focus, c, error) ||
        !real_focus_point(focus, isinf(distance) ? distance : distance - front, &subject, error)) {
        return false;
    }
    equation.point = &subject;
    equation.film = range->film = subject.sharpest;
    range->blur = real_focus_blur(focus, &subject, subject.sharpest);
    if (!(range->blur < c)) {
        return fail(error, ERROR_DOMAIN,
                    "no distance is sharp: even the sharpest image is as blurred as a disc of "
                    "%.4g mm, the circle of confusion is %.4g mm",
                    range->blur, c);
    }
    find_films(&equation, range);
    const double shift = (range->film_high - range->film_low) / 8;
    const bool found =
        find_objects(&equation, distance, vergence_step(&equation, distance, shift), range);
    arena_reset(focus->arena, mark);
    return found;
}

bool real_range_hyperfocal(const struct real_focus *focus, double front, double c,
                           double *hyperfocal, double *blur, struct error *error)
{
    struct equation equation = {.focus = focus, .front = front, .c = c, .error = error};
    const struct arena_mark mark = arena_mark(focus->arena);
    struct real_range range;
    struct real_point infinity;
    *hyperfocal = NAN;
    if (!check_reach(focus, c, error) || !real_focus_point(focus, INFINITY, &infinity, error)) {
        return false;
    }
    *blur = real_focus_blur(focus, &infinity, infinity.sharpest);
    if (!(*blur < c)) {
        return true;
    }
    equation.point = &infinity;
    find_films(&equation, &range);
    equation.film = range.film_high;
    const double step = vergence_step(&equation, INFINITY, range.film_high - infinity.sharpest);
    const double vergence = root_beyond(excess_of_focus, &equation, 0, step / 2, INFINITY);
    *hyperfocal = 1 / vergence;
    arena_reset(focus->arena, mark);
    return !equation.has_failed;
}
