/* analysis/rays/chromatic.c - colour of a lens: its foci and chief rays by wavelength. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/chromatic.h"

#include "trace/aim/aim.h"
#include "trace/dispatch.h"

#include <math.h>

bool chromatic_focus(const struct setup *setup, double wavelength, struct chromatic_focus *focus,
                     struct error *error)
{
    struct paraxial_system system;
    struct paraxial_trace trace;
    if (!paraxial_compile(setup->lens, wavelength, setup->section, setup->arena, &system, error)) {
        return false;
    }
    paraxial_trace(&system, &trace);
    const struct paraxial_matrix *m = &trace.whole;
    struct pair y = m->a, v = m->c;
    if (!setup->object.is_infinite) {
        const struct pair x = pair_divide(setup->object.distance, system.index[0]);
        y = pair_add(pair_multiply(m->a, x), m->b);
        v = pair_add(pair_multiply(m->c, x), m->d);
    }
    const bool parallel = setup->object.is_infinite && paraxial_is_afocal(&system, &trace);
    const struct pair image = pair_divide(pair_multiply(system.index[system.count], y), v);
    focus->image = parallel ? (double)INFINITY : -image.hi;
    focus->vergence = parallel ? 0 : -pair_divide(v, y).hi;
    focus->status = RAY_OK;
    return true;
}

struct chromatic_axial chromatic_axial(const struct chromatic_focus *shortest,
                                       const struct chromatic_focus *middle,
                                       const struct chromatic_focus *longest)
{
    const bool finite =
        isfinite(shortest->image) && isfinite(middle->image) && isfinite(longest->image);
    const double below = middle->image - shortest->image, above = middle->image - longest->image;
    struct chromatic_axial axial = {NAN, NAN};
    if (finite) {
        axial.primary = shortest->image - longest->image;
        const bool between = middle != shortest && middle != longest;
        axial.secondary = between ? 0.0 - (below + above) / 2 : (double)NAN;
    }
    return axial;
}

/* A ray from its start to the image plane, or behind the last surface. */
static bool chromatic_follow(const struct setup *one, const struct ray *start, bool to_image,
                             struct ray *end, struct error *error)
{
    const struct system *system =
        setup_system(one, 0, SETUP_OPEN | (to_image ? SETUP_IMAGE : 0), error);
    if (system == NULL) {
        return false;
    }
    struct rays rays = rays_new(one->arena, 1);
    rays_set(&rays, 0, system->index_first, start);
    rays_trace(system, &rays, NULL);
    *end = rays_get(&rays, 0, system->index_last);
    return true;
}

/* A ray at a height of the pupil, in the section of the setup. */
static bool chromatic_aim(const struct setup *one, const struct beam *beam, double zone,
                          bool entrance, struct ray *ray, struct error *error)
{
    struct aim aimed;
    double at[2] = {0, 0};
    at[setup_axis(one)] = zone;
    if (entrance || one->first.is_telecentric) {
        return aim_at_entrance(beam, &one->first, at[0], at[1], ray, error);
    }
    const struct system *open = setup_system(one, 0, SETUP_OPEN, error);
    if (open == NULL || !aim_open(open, beam, one->arena, &aimed, error)) {
        return false;
    }
    *ray = zone == 0 ? aim_chief(&aimed) : aim_ray(&aimed, at[0], at[1]);
    return true;
}

bool chromatic_zone(const struct setup *setup, double wavelength, double zone, bool entrance,
                    struct chromatic_focus *focus, struct error *error)
{
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    const struct field_point axis = {.kind = FIELD_NONE};
    const size_t k = setup_axis(setup);
    struct beam beam;
    struct ray ray;
    *focus = (struct chromatic_focus){NAN, NAN, RAY_OK};
    if (zone == 0) {
        return chromatic_focus(setup, wavelength, focus, error);
    }
    if (!setup_beam(&one, &axis, &beam, error) ||
        !chromatic_aim(&one, &beam, zone, entrance, &ray, error)) {
        return false;
    }
    if (ray.status == RAY_OK && !chromatic_follow(&one, &ray, false, &ray, error)) {
        return false;
    }
    focus->status = ray.status;
    if (ray.status != RAY_OK) {
        return true;
    }
    const double slope = ray.cosine[k] / ray.cosine[2];
    const double height = ray.point[k] - ray.point[2] * slope;
    focus->image = slope != 0 ? -height / slope : (double)INFINITY;
    focus->vergence = -setup->first.index_image * slope / height;
    return true;
}

bool chromatic_chief(const struct setup *setup, const struct field_point *field, double wavelength,
                     struct chromatic_chief *chief, struct error *error)
{
    const struct setup one = setup_at_wavelength(setup, wavelength, setup->arena);
    struct beam beam;
    struct ray ray;
    *chief = (struct chromatic_chief){{NAN, NAN}, {NAN, NAN}, RAY_MISS};
    if (!setup_beam(&one, field, &beam, error) ||
        !chromatic_aim(&one, &beam, 0, false, &ray, error)) {
        return false;
    }
    if (ray.status == RAY_OK && !chromatic_follow(&one, &ray, !isnan(one.image), &ray, error)) {
        return false;
    }
    chief->status = ray.status;
    for (int i = 0; i < 2 && ray.status == RAY_OK; i++) {
        chief->slope[i] = ray.cosine[i] / ray.cosine[2];
        chief->height[i] = isnan(one.image) ? (double)NAN : ray.point[i];
    }
    return true;
}

struct chromatic_lateral chromatic_lateral(const struct chromatic_chief *primary,
                                           const struct chromatic_chief *other,
                                           const double along[2])
{
    double height = 0, before = 0, step = 0;
    for (int i = 0; i < 2; i++) {
        height += (other->height[i] - primary->height[i]) * along[i];
        before += primary->slope[i] * along[i];
        step += (other->slope[i] - primary->slope[i]) * along[i];
    }
    return (struct chromatic_lateral){.height = height,
                                      .angle = atan(step / (1 + before * (before + step)))};
}
