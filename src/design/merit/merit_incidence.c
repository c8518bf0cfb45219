/* design/merit/merit_incidence.c - operands of angles of incidence. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"

#include "design/merit/merit_ray.h"

#include <math.h>

/* A plane that only is the stop, or one within a medium, bends nothing. */
static bool bends(const struct lens *lens, size_t i)
{
    const struct surface *surface = &lens->surfaces[i];
    const struct medium *before = i > 0 ? &lens->surfaces[i - 1].medium : &lens->object_medium;
    return surface_reflects(surface) ||
           (surface_has(surface, SURFACE_HAS_MEDIUM) && !medium_is_same(before, &surface->medium));
}

/* The angle whose sine is |p x p'|/(n |p' - p|): of the tangent, so that 90 deg is no pole. */
static struct dual incidence(const struct merit_ray *before, const struct merit_ray *after)
{
    struct dual step[3], dot = dual_of(0);
    for (int i = 0; i < 3; i++) {
        step[i] = dual_subtract(after->along[i], before->along[i]);
        dot = dual_add(dot, dual_multiply(step[i], before->along[i]));
    }
    const struct dual *a = before->along, *b = after->along;
    struct dual cross = dual_of(0);
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        const struct dual part =
            dual_subtract(dual_multiply(a[k], b[l]), dual_multiply(a[l], b[k]));
        cross = dual_add(cross, dual_multiply(part, part));
    }
    struct dual size = dual_of(0);
    for (int i = 0; i < 3; i++) {
        size = dual_add(size, dual_multiply(step[i], step[i]));
    }
    if (!(cross.value > 1e-28 * size.value)) {
        return dual_of(0); /* at right angles: the slope of |i| has no sign there */
    }
    const struct dual tangent = dual_divide(dual_root(cross), dual_absolute(dot));
    return dual_arc_tangent(tangent);
}

/* -------- the largest -------- */

/* Its angle and its derivatives into merit->change, of the ray that was traced last. */
static bool merit_incidence_derive(struct merit *merit, const struct merit_beams *beams, size_t ray,
                                   size_t surface)
{
    const size_t columns = merit_columns(merit);
    struct merit_ray *before = ARENA_ARRAY(merit->arena, columns + 1, struct merit_ray);
    struct merit_ray *after = ARENA_ARRAY(merit->arena, columns + 1, struct merit_ray);
    if (!merit_ray_derive(merit, beams, ray, surface, before) ||
        !merit_ray_derive(merit, beams, ray, surface + 1, after)) {
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
    struct merit_beams *beams = slot->own;
    size_t at = 0, from, end;
    merit_surfaces(slot->operand, lens, &from, &end);
    double *largest = ARENA_ARRAY(merit->arena, end, double);
    size_t *which = ARENA_ARRAY(merit->arena, end, size_t);
    for (size_t i = 0; i < end; i++) {
        largest[i] = -1;
    }
    for (size_t k = 0; k < beams->bundle.block_count; k++) {
        struct merit_ray before, after;
        const bool is_there = merit_ray_trace(merit, beams, k);
        for (size_t i = from; i < end && is_there; i++) {
            const bool arrives =
                merit_ray_at(beams, k, i, &before) && merit_ray_at(beams, k, i + 1, &after);
            const double angle = arrives ? incidence(&before, &after).value : -1;
            which[i] = angle > largest[i] ? k : which[i];
            largest[i] = fmax(angle, largest[i]);
        }
    }
    for (size_t i = from; i < end; i++) {
        if (!bends(lens, i)) {
            continue;
        }
        if (largest[i] < 0) {
            return fail(&merit->why, ERROR_DOMAIN, "no ray arrives at surface %zu", i + 1);
        }
        merit->change[0] = dual_of(largest[i]);
        if ((merit->derives && (!merit_ray_trace(merit, beams, which[i]) ||
                                !merit_incidence_derive(merit, beams, which[i], i))) ||
            !merit_put(merit, slot, at++, residuals, jacobian)) {
            return false;
        }
    }
    return true;
}

bool merit_fill_incidence(struct merit *merit, const struct merit_slot *slot, double *residuals,
                          double *jacobian)
{
    if (!merit_beams_aim(merit, slot, slot->own)) {
        return false;
    }
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
    /* the chief ray, and those through the upper and the lower edge of the stop */
    static const struct pupil_point pupils[] = {{0, 0, 1}, {0, 1, 1}, {0, -1, 1}};
    struct setup_wavelength *lights = ARENA_NEW(arena, struct setup_wavelength);
    struct bundle_wish wish = {.fields =
                                   operand->field != NULL ? operand->field : place->setup.fields,
                               .field_count = operand->field != NULL ? 1 : place->setup.field_count,
                               .wavelengths = lights,
                               .wavelength_count = 1,
                               .points = pupils,
                               .point_count = sizeof pupils / sizeof pupils[0],
                               .is_bare = true};
    size_t count = 0, from, end;
    *lights =
        (struct setup_wavelength){merit_light(merit, slot, operand->wavelength)->wavelength, 1};
    if (!merit_needs_aperture(place, error)) {
        return 0;
    }
    for (size_t i = 0; i < wish.field_count; i++) {
        if (!merit_ray_check(place, &wish.fields[i].point, error)) {
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
    slot->own = ARENA_NEW(arena, struct merit_beams);
    return count > 0 && merit_ray_open(merit, slot, &wish, arena, slot->own, error) ? count : 0;
}
