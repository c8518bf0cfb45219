/* optics/focusing.c - bring an image to a fixed plane by changing gaps of a lens. */
/* SPDX-License-Identifier: MIT */
#include "optics/focusing.h"

#include "base/polynomial.h"

#include <math.h>
#include <stdlib.h>

/* The system as functions of the movement. */
struct movement_terms {
    const struct focus_mechanism *focusing;
    const struct conjugate_question *question;
    struct paraxial_system system;
    struct polynomial a, b, c, d; /* the whole */
    struct polynomial a1, b1;     /* before the stop */
    struct polynomial plane;      /* image plane from the last vertex */
    struct polynomial length;     /* first to last vertex */
    double low, high;             /* of the movement */
};

static struct polynomial focusing_constant(double value)
{
    return (struct polynomial){0, {pair_of(value)}};
}

static struct polynomial negated(const struct polynomial *a)
{
    return polynomial_scale(a, pair_of(-1));
}

/* a + f b */
static struct polynomial plus_times(const struct polynomial *a, const struct polynomial *f,
                                    const struct polynomial *b)
{
    const struct polynomial product = polynomial_multiply(f, b);
    return polynomial_add(a, &product);
}

static double focusing_weight_of(const struct focus_mechanism *focusing, size_t surface)
{
    double weight = 0;
    for (size_t i = 0; i < focusing->gap_count; i++) {
        weight += focusing->gaps[i].surface == surface ? focusing->gaps[i].weight : 0;
    }
    return weight;
}

static struct pair focusing_thickness_of(const struct focus_mechanism *focusing, size_t surface)
{
    bool last = surface + 1 == focusing->lens->surface_count;
    return last ? focusing->image_plane : focusing->lens->surfaces[surface].thickness.value;
}

/* The Gaussian constants of the lens, its length and its image plane over the movement. */
static void trace_moving(struct movement_terms *all)
{
    const struct paraxial_system *system = &all->system;
    struct polynomial gap, power;
    all->a = all->d = all->a1 = focusing_constant(1);
    all->b = all->c = all->b1 = all->length = focusing_constant(0);
    for (size_t i = 0; i < system->count; i++) {
        if (i == system->stop) {
            all->a1 = all->a;
            all->b1 = all->b;
        }
        power = (struct polynomial){0, {pair_negate(system->surfaces[i].power)}};
        all->c = plus_times(&all->c, &power, &all->a);
        all->d = plus_times(&all->d, &power, &all->b);
        /* t + w e, without a term that is always 0. */
        double weight = focusing_weight_of(all->focusing, i);
        gap = polynomial_linear(focusing_thickness_of(all->focusing, i), pair_of(weight));
        gap.degree = weight == 0 ? 0 : 1;
        if (i + 1 < system->count) {
            all->length = polynomial_add(&all->length, &gap);
            gap = polynomial_scale(&gap, pair_divide(pair_of(1), system->index[i + 1]));
            all->a = plus_times(&all->a, &gap, &all->c);
            all->b = plus_times(&all->b, &gap, &all->d);
        } else {
            all->plane = gap;
        }
    }
}

/* An object at a distance from the image plane stays before the first vertex. */
static bool limit_object(struct movement_terms *all, struct error *error)
{
    const struct conjugate_question *question = all->question;
    bool from_sensor = question->asked == CONJUGATE_OBJECT &&
                       question->from == CONJUGATE_FROM_SENSOR && !isinf(question->distance);
    if (!from_sensor) {
        return true;
    }
    const struct polynomial track = polynomial_add(&all->length, &all->plane);
    double room = question->distance - track.c[0].hi, slope = track.degree > 0 ? track.c[1].hi : 0;
    if (slope > 0) {
        all->high = fmin(all->high, room / slope);
    } else if (slope < 0) {
        all->low = fmax(all->low, room / slope);
    }
    if ((slope == 0 && room < 0) || all->low > all->high) {
        return fail(error, ERROR_DOMAIN,
                    "an object %.10g mm from the image plane is not in front of the lens, which "
                    "reaches %.10g mm from there",
                    question->distance, track.c[0].hi);
    }
    return true;
}

/* The ray from the axial object point before the lens. */
static void focusing_start(const struct movement_terms *all, struct polynomial *y,
                           struct polynomial *v)
{
    const struct conjugate_question *question = all->question;
    const struct pair n = all->system.index[0];
    struct polynomial one = focusing_constant(1), rest;
    if (isinf(question->distance)) {
        *y = one;
        *v = focusing_constant(0);
        return;
    }
    const struct polynomial s = {0, {pair_divide(pair_of(question->distance), n)}};
    switch (question->from) {
    case CONJUGATE_FROM_PRINCIPAL:
    case CONJUGATE_FROM_FOCAL:
        *v = all->c;
        rest = negated(&all->d);
        rest = plus_times(&rest, &s, &all->c);
        *y = question->from == CONJUGATE_FROM_FOCAL ? rest : polynomial_add(&rest, &one);
        return;
    case CONJUGATE_FROM_ENTRANCE:
        *v = all->a1;
        rest = negated(&all->b1);
        *y = plus_times(&rest, &s, &all->a1);
        return;
    case CONJUGATE_FROM_SENSOR:
        *v = one;
        rest = polynomial_add(&all->length, &all->plane);
        rest = polynomial_scale(&rest, pair_divide(pair_of(-1), n));
        *y = polynomial_add(&s, &rest);
        return;
    default:
        *v = one;
        *y = s;
    }
}

/* The polynomial that is 0 when the image lies in its plane. */
static struct polynomial condition(const struct movement_terms *all)
{
    const struct polynomial back = polynomial_scale(
        &all->plane, pair_divide(pair_of(1), all->system.index[all->system.count]));
    const struct polynomial top = plus_times(&all->a, &back, &all->c);
    if (all->question->asked == CONJUGATE_MAGNIFICATION) {
        const struct polynomial m = focusing_constant(-all->question->magnification);
        return polynomial_add(&top, &m);
    }
    struct polynomial y, v;
    const struct polynomial bottom = plus_times(&all->b, &back, &all->d);
    focusing_start(all, &y, &v);
    const struct polynomial right = polynomial_multiply(&bottom, &v);
    return plus_times(&right, &top, &y);
}

static struct focused state_at(const struct focus_mechanism *focusing, struct pair movement,
                               struct arena *arena)
{
    const struct lens *lens = focusing->lens;
    struct lens *copy = lens_copy(lens, arena);
    struct focused focused = {copy, movement, focusing->image_plane};
    for (size_t i = 0; i < lens->surface_count; i++) {
        double weight = focusing_weight_of(focusing, i);
        if (weight == 0) {
            continue;
        }
        struct pair t =
            pair_add(focusing_thickness_of(focusing, i), pair_multiply(pair_of(weight), movement));
        copy->surfaces[i].thickness = figure_number(t);
        if (i + 1 == lens->surface_count) {
            focused.image_plane = t;
        }
    }
    return focused;
}

/* What the lens focuses on after a movement: "850.3 mm", "inf". */
static const char *reach_at(const struct movement_terms *all, double movement, struct arena *arena)
{
    const struct focus_mechanism *focusing = all->focusing;
    const struct focused focused = state_at(focusing, pair_of(movement), arena);
    const struct conjugate_question image = {CONJUGATE_IMAGE, CONJUGATE_FROM_FRONT,
                                             focused.image_plane.hi, 0};
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct conjugate_ray rays[2];
    struct conjugate_points points;
    struct error ignored;
    if (!paraxial_compile(focused.lens, focusing->wavelength, focusing->section, arena, &system,
                          &ignored)) {
        return "?";
    }
    paraxial_trace(&system, &trace);
    if (conjugate_find(&system, &trace, &image, rays, &ignored) == 0) {
        return "?";
    }
    conjugate_compute(&system, &trace, &rays[0], &points);
    return fabs(points.object) > 1e12 ? "infinity" : arena_printf(arena, "%.5g mm", points.object);
}

static double focusing_scale_of(const struct movement_terms *all)
{
    double sum = 1e-3;
    for (size_t i = 0; i < all->system.count; i++) {
        sum += fabs(focusing_thickness_of(all->focusing, i).hi);
    }
    return sum;
}

/* The whole lens between a subject and a sensor: is there such a distance at all? */
static bool is_too_near(const struct movement_terms *all, struct error *error)
{
    const struct focus_mechanism *focusing = all->focusing;
    struct paraxial_trace trace;
    struct conjugate_ray rays[2];
    bool whole =
        focusing->gap_count == 1 && focusing->gaps[0].surface + 1 == focusing->lens->surface_count;
    if (!whole || all->question->asked != CONJUGATE_OBJECT ||
        all->question->from != CONJUGATE_FROM_SENSOR) {
        return false;
    }
    paraxial_trace(&all->system, &trace);
    return conjugate_find(&all->system, &trace, all->question, rays, error) == 0;
}

static void focusing_refuse(const struct movement_terms *all, const struct polynomial *g,
                            struct arena *arena, struct error *error)
{
    const char *range, *reach;
    if (is_too_near(all, error)) {
        return;
    }
    if (polynomial_is_constant(g, focusing_scale_of(all))) {
        fail(error, ERROR_DOMAIN, "this movement does not move the image");
        return;
    }
    double low = all->low, high = all->high;
    if (isinf(low) && isinf(high)) {
        range = "wherever it goes";
        reach = "";
    } else if (isinf(low) || isinf(high)) {
        double end = isinf(low) ? high : low;
        range = arena_printf(arena, "%s %.6g mm", isinf(low) ? "up to" : "from", end);
        reach = arena_printf(arena, ", where the lens focuses %s before its first vertex",
                             reach_at(all, end, arena));
    } else {
        range = arena_printf(arena, "from %.6g to %.6g mm", low, high);
        reach = arena_printf(arena,
                             ", where the lens focuses %s and %s before its first "
                             "vertex",
                             reach_at(all, low, arena), reach_at(all, high, arena));
    }
    fail(error, ERROR_DOMAIN,
         "no movement brings the image to its plane; no gap becomes negative %s%s", range, reach);
}

static int focusing_by_size(const void *left, const void *right)
{
    double a = fabs(((const struct pair *)left)->hi), b = fabs(((const struct pair *)right)->hi);
    return (a > b) - (a < b);
}

size_t focus_solve(const struct focus_mechanism *focusing,
                   const struct conjugate_question *question, struct arena *arena,
                   struct focused solutions[FOCUS_SOLUTIONS], struct error *error)
{
    struct movement_terms all = {.focusing = focusing, .question = question};
    struct pair roots[POLYNOMIAL_DEGREE];
    if (question->asked == CONJUGATE_IMAGE) {
        fail(error, ERROR_USAGE, "focusing has its image plane: give an object or a magnification");
        return 0;
    }
    if (!isfinite(focusing->image_plane.hi)) {
        fail(error, ERROR_DOMAIN, "the lens has no image plane: its image is infinitely far");
        return 0;
    }
    if (!paraxial_compile(focusing->lens, focusing->wavelength, focusing->section, arena,
                          &all.system, error)) {
        return 0;
    }
    trace_moving(&all);
    /* No moved gap may change its sign. */
    all.low = -INFINITY;
    all.high = INFINITY;
    for (size_t i = 0; i < all.system.count; i++) {
        double weight = focusing_weight_of(focusing, i), t = focusing_thickness_of(focusing, i).hi;
        double sign = t != 0 ? t : all.system.index[i + 1].hi;
        if (weight * sign > 0) {
            all.low = fmax(all.low, -t / weight);
        } else if (weight * sign < 0) {
            all.high = fmin(all.high, -t / weight);
        }
    }
    if (!limit_object(&all, error)) {
        return 0;
    }
    const struct polynomial g = condition(&all);
    size_t count = polynomial_roots(&g, all.low, all.high, focusing_scale_of(&all), roots);
    if (count == 0) {
        focusing_refuse(&all, &g, arena, error);
        return 0;
    }
    qsort(roots, count, sizeof roots[0], focusing_by_size);
    for (size_t i = 0; i < count; i++) {
        solutions[i] = state_at(focusing, roots[i], arena);
    }
    return count;
}

bool focus_object(const struct focused *focused, const struct paraxial_system *system,
                  const struct paraxial_trace *trace, const struct conjugate_question *question,
                  struct conjugate_ray *ray, struct error *error)
{
    struct conjugate_ray rays[2];
    struct conjugate_question asked = *question;
    if (question->asked == CONJUGATE_OBJECT && question->from == CONJUGATE_FROM_SENSOR) {
        asked.from = CONJUGATE_FROM_FRONT;
        asked.distance -= system->length + focused->image_plane.hi;
    }
    if (conjugate_find(system, trace, &asked, rays, error) == 0) {
        return false;
    }
    *ray = rays[0];
    return true;
}
