/* design/merit/merit_incidence.c - operands of angles of incidence. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_incidence.h"

#include "design/merit/merit_ray.h"

#include <math.h>

/* A ray of a field: a place in the stop. */
static const double pupils[][2] = {{0, 0}, {0, 1}, {0, -1}};
enum { PUPILS = sizeof pupils / sizeof pupils[0] };

static size_t field_count(const struct merit_place *place, const struct operand *operand)
{
    return operand->field != NULL ? 1 : place->setup.field_count;
}

static const struct field_point *merit_incidence_field_at(const struct merit_place *place,
                                                          const struct operand *operand, size_t i)
{
    return operand->field != NULL ? &operand->field->point : &place->setup.fields[i].point;
}

/* A plane that only is the stop, or one within a medium, bends nothing. */
static bool bends(const struct lens *lens, size_t i)
{
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &lens->surfaces[i - 1].medium : &lens->object_medium;
    return surface_reflects(surface) ||
           (surface_has(surface, SURFACE_HAS_MEDIUM) && !medium_is_same(before, &surface->medium));
}

static struct dual cross_square(const struct dual a[3], const struct dual b[3])
{
    struct dual sum = dual_of(0);
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        const struct dual part =
            dual_subtract(dual_multiply(a[k], b[l]), dual_multiply(a[l], b[k]));
        sum = dual_add(sum, dual_multiply(part, part));
    }
    return sum;
}

static struct dual merit_incidence_square(const struct dual a[3])
{
    struct dual sum = dual_of(0);
    for (int i = 0; i < 3; i++) {
        sum = dual_add(sum, dual_multiply(a[i], a[i]));
    }
    return sum;
}

/* The angle whose sine is |p x p'|/(n |p' - p|): of the tangent, so that 90 deg is no pole. */
static struct dual incidence(const struct merit_ray *before, const struct merit_ray *after)
{
    struct dual step[3], dot = dual_of(0);
    for (int i = 0; i < 3; i++) {
        step[i] = dual_subtract(after->along[i], before->along[i]);
        dot = dual_add(dot, dual_multiply(step[i], before->along[i]));
    }
    const struct dual cross = cross_square(before->along, after->along);
    const struct dual size = merit_incidence_square(step);
    if (!(cross.value > 1e-28 * size.value)) {
        return dual_of(0); /* at right angles: the slope of |i| has no sign there */
    }
    const struct dual tangent = dual_divide(dual_root(cross), dual_absolute(dot));
    return dual_arc_tangent(tangent);
}

/* Which ray the number i is. */
static struct merit_ray_question
merit_incidence_question_of(struct merit *merit, const struct merit_slot *slot, size_t i)
{
    const double *pupil = pupils[i % PUPILS];
    return (struct merit_ray_question){
        .slot = slot,
        .light = merit_light(merit, slot, slot->operand->wavelength),
        .field = merit_incidence_field_at(&merit->places[slot->place], slot->operand, i / PUPILS),
        .pupil = {pupil[0], pupil[1]}};
}

/* Aim all rays of a slot. */
static struct merit_ray **merit_incidence_aim_all(struct merit *merit,
                                                  const struct merit_slot *slot)
{
    const struct merit_place *place = &merit->places[slot->place];
    struct aim_near *near = slot->own;
    const size_t count = field_count(place, slot->operand) * PUPILS;
    struct merit_ray **starts = ARENA_ARRAY(merit->arena, count, struct merit_ray *);
    for (size_t i = 0; i < count; i++) {
        struct merit_ray_question question = merit_incidence_question_of(merit, slot, i);
        question.near = &near[i / PUPILS];
        starts[i] = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
        if (!merit_ray_start(merit, &question, merit->arena, starts[i])) {
            starts[i] = NULL;
        }
    }
    return starts;
}

/* -------- the largest -------- */

/* Through one more surface; the ray that meets it at the largest angle, front->count: none does. */
static size_t merit_incidence_pass(struct merit_front *front, size_t surface, struct arena *arena,
                                   double *largest)
{
    struct merit_ray *before = ARENA_ARRAY(arena, front->count, struct merit_ray);
    size_t which = front->count;
    *largest = -1;
    for (size_t i = 0; i < front->count; i++) {
        before[i] = merit_front_ray(front, i);
    }
    merit_front_pass(front, surface);
    for (size_t i = 0; i < front->count; i++) {
        const struct merit_ray after = merit_front_ray(front, i);
        const double angle = merit_front_lost(front, i) ? -1 : incidence(&before[i], &after).value;
        which = angle > *largest ? i : which;
        *largest = fmax(angle, *largest);
    }
    return which;
}

/* Its angle and its derivatives into merit->change. */
static bool merit_incidence_derive(struct merit *merit, const struct merit_ray_question *question,
                                   size_t surface, const struct merit_ray *start)
{
    const size_t columns = merit_columns(merit);
    struct merit_ray *before = ARENA_ARRAY(merit->arena, columns, struct merit_ray);
    struct merit_ray *after = ARENA_ARRAY(merit->arena, columns, struct merit_ray);
    if (!merit_ray_follow(merit, question, surface, start, merit->arena, before) ||
        !merit_ray_follow(merit, question, surface + 1, start, merit->arena, after)) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        merit->change[j] = incidence(&before[j], &after[j]);
    }
    return true;
}

static bool merit_incidence_fill(struct merit *merit, const struct merit_slot *slot,
                                 double *residuals, double *jacobian)
{
    const struct lens *lens = merit->places[slot->place].lens;
    struct merit_ray **starts = merit_incidence_aim_all(merit, slot);
    const struct merit_ray_question first = merit_incidence_question_of(merit, slot, 0);
    const size_t count = field_count(&merit->places[slot->place], slot->operand) * PUPILS;
    struct merit_front front;
    double largest;
    size_t at = 0, from, end;
    merit_surfaces(slot->operand, lens, &from, &end);
    if (!merit_front_open(merit, &first, starts, count, &front)) {
        return false;
    }
    for (size_t i = 0; i < end; i++) {
        const size_t which = merit_incidence_pass(&front, i, merit->arena, &largest);
        if (i < from || !bends(lens, i)) {
            continue;
        }
        if (which == front.count) {
            return fail(&merit->why, ERROR_DOMAIN, "no ray arrives at surface %zu", i + 1);
        }
        const struct merit_ray_question question = merit_incidence_question_of(merit, slot, which);
        merit->change[0] = dual_of(largest);
        if ((merit->derives && !merit_incidence_derive(merit, &question, i, starts[which])) ||
            !merit_put(merit, slot, at++, residuals, jacobian)) {
            return false;
        }
    }
    return true;
}

bool merit_fill_incidence(struct merit *merit, const struct merit_slot *slot, double *residuals,
                          double *jacobian)
{
    const struct arena_mark mark = arena_mark(merit->arena);
    const bool done = merit_incidence_fill(merit, slot, residuals, jacobian);
    arena_reset(merit->arena, mark);
    return done;
}

size_t merit_prepare_incidence(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                               struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct operand *operand = slot->operand;
    const struct lens *lens = place->lens;
    size_t count = 0, from, end;
    if (!merit_needs_aperture(place, error)) {
        return 0;
    }
    for (size_t i = 0; i < field_count(place, operand); i++) {
        if (!merit_ray_check(place, merit_incidence_field_at(place, operand, i), error)) {
            return 0;
        }
    }
    merit_surfaces(operand, lens, &from, &end);
    for (size_t i = from; i < end && i < lens->surface_count; i++) {
        count += bends(lens, i);
        if (lens->surfaces[i].coordinate_break != NULL) {
            fail(error, ERROR_DOMAIN, "surface %zu stands behind a coordinate break", i + 1);
            return 0;
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "none of these surfaces bends light");
    }
    slot->own = ARENA_ARRAY(arena, field_count(place, operand), struct aim_near);
    return count;
}
