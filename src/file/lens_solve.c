/* file/lens_solve.c - thicknesses and curvatures that follow from rays. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_solve.h"

#include "optics/first_order.h"

#include <math.h>

/*
 * The field that is farthest out, of angles and heights in the y-z plane; a round lens has the same
 * rays about any other. NaN without one.
 */
static double edge_of_field(const struct lens *lens)
{
    double field = NAN, largest = NAN;
    for (size_t i = 0; i < lens->field_count; i++) {
        /* the last one first: it stays where others are as far out */
        const struct lens_field *one = &lens->fields[i > 0 ? i - 1 : lens->field_count - 1];
        const double at[2] = {one->at[0].value.hi, one->at[1].value.hi};
        double here = field_extent(lens->field_kind, at);
        if (!(here <= largest)) {
            largest = here;
            field = at[0] == 0 || !lens_is_round(lens) ? at[1] : here;
        }
    }
    return field;
}

/* Height and n u before the first vertex. */
static bool solve_start(const struct lens *lens, enum solve_ray ray, struct arena *arena,
                        double *height, double *slope, struct error *error)
{
    struct first_order first;
    struct aperture_setting aperture = lens_aperture(lens);
    struct conjugate_object object = lens_object(lens);
    double field = edge_of_field(lens);
    enum field_kind kind = isnan(field) ? FIELD_NONE : lens->field_kind;
    if (!first_order_of_lens(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &first,
                             error)) {
        return false;
    }
    bool none = aperture.kind == APERTURE_NONE ||
                !first_order_aperture(&first, &object, &aperture, kind, field, error);
    if (ray == SOLVE_CHIEF) {
        if (none && aperture.kind != APERTURE_NONE) {
            return false;
        }
        *height = first.chief_y;
        *slope = first.chief_v;
        return (isfinite(*height) && isfinite(*slope)) ||
               fail(error, ERROR_DOMAIN, "a solve of a chief ray needs a stop and a field");
    }
    *height = first.marginal_y;
    *slope = first.marginal_v;
    if (none || !isfinite(*height) || !isfinite(*slope)) { /* any ray from there does */
        *height = object.is_infinite ? 1 : object.distance.hi;
        *slope = object.is_infinite ? 0 : first.index_object;
    }
    return true;
}

/* A ray through the first `count` surfaces; `heights` null: those on its way are not wanted. */
static bool follow_paraxial(const struct lens *lens, size_t count, enum solve_ray ray,
                            struct arena *arena, struct solve_state *state, double *heights,
                            struct error *error)
{
    const struct arena_mark mark = arena_mark(arena);
    struct paraxial_system system;
    double height, slope;
    const bool done =
        solve_start(lens, ray, arena, &height, &slope, error) &&
        paraxial_compile(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &system, error);
    struct pair y = pair_of(done ? height : 0), v = pair_of(done ? slope : 0);
    for (size_t i = 0; done && i < count; i++) {
        if (i > 0) {
            y = pair_add(y, pair_multiply(system.surfaces[i - 1].reduced, v));
        }
        state->before = v;
        v = pair_subtract(v, pair_multiply(y, system.surfaces[i].power));
        if (heights != NULL) {
            heights[i] = y.hi;
        }
    }
    if (done) {
        state->y = y;
        state->after = v;
        state->index_before = system.index[count - 1];
        state->index_after = system.index[count];
    }
    arena_reset(arena, mark);
    return done;
}

bool solve_follow(const struct lens *lens, size_t surface, enum solve_ray ray, struct arena *arena,
                  struct solve_state *state, struct error *error)
{
    return follow_paraxial(lens, surface + 1, ray, arena, state, NULL, error);
}

bool solve_heights(const struct lens *lens, enum solve_ray ray, struct arena *arena,
                   double *heights, struct error *error)
{
    struct solve_state state;
    return follow_paraxial(lens, lens->surface_count, ray, arena, &state, heights, error);
}

struct pair solve_thickness(const struct solve_state *state, struct pair height)
{
    return pair_divide(pair_multiply(pair_subtract(height, state->y), state->index_after),
                       state->after);
}

struct pair solve_curvature(const struct solve_state *state, struct pair angle)
{
    struct pair wanted = pair_multiply(angle, state->index_after);
    return pair_divide(
        pair_subtract(state->before, wanted),
        pair_multiply(state->y, pair_subtract(state->index_after, state->index_before)));
}
