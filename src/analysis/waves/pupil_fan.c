/* analysis/waves/pupil_fan.c - pupil aberrations along two sections of the entrance pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_fan.h"

#include "trace/dispatch.h"

#include <float.h>
#include <math.h>

/* What is nothing but rounding in a lens of that size is 0. */
static double pupil_fan_rounded(double off, const struct first_order *first)
{
    const double size = fabs(first->entrance_pupil) + fabs(first->length);
    const double ulps = 16 * DBL_EPSILON * (1 + (isfinite(size) ? size / first->stop_radius : 0));
    return fabs(off) <= ulps ? 0 : off;
}

/* Rays of both sections where they start, through places of the paraxial entrance pupil. */
static bool pupil_fan_aim(const struct setup *setup, const struct beam *beam,
                          const struct fan_ray *list, const struct rays *rays, struct error *error)
{
    for (size_t i = 0; i < rays->count; i++) {
        struct ray ray;
        if (!aim_at_entrance(beam, &setup->first, list[i].pupil[0], list[i].pupil[1], &ray,
                             error)) {
            return false;
        }
        rays_set(rays, i, beam->n, &ray);
    }
    return true;
}

/* Where the rays of one wavelength cross the stop, beside their paraxial places. */
static bool pupil_fan_cross(const struct bundle_question *bundle, const struct beam *beam,
                            size_t wavelength, size_t count, struct arena *arena,
                            struct fan_ray *list, struct error *error)
{
    const struct setup *setup = bundle->setup;
    const struct system *open = setup_system(setup, wavelength, SETUP_OPEN, error);
    const struct system *clipped =
        open != NULL && bundle->clip ? setup_system(setup, wavelength, SETUP_CLIPPED, error) : open;
    const struct rays rays = rays_room(arena, count), tried = rays_room(arena, count);
    if (clipped == NULL || !pupil_fan_aim(setup, beam, list, &rays, error) ||
        !pupil_fan_aim(setup, beam, list, &tried, error)) {
        return false;
    }
    const size_t stop = system_place(open, open->stop);
    rays_trace_part(open, 0, stop + 1, &rays, NULL);
    rays_trace_part(clipped, 0, stop, &tried, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct ray ray = rays_get(&rays, i, open->index_last);
        const struct ray before = rays_get(&tried, i, open->index_last);
        const struct ray *ends = before.status != RAY_OK ? &before : &ray;
        list[i].status = ends->status;
        list[i].surface = ends->surface;
        for (int k = 0; k < 2 && ends->status == RAY_OK; k++) {
            const double off = ray.point[k] / setup->first.stop_radius - list[i].pupil[k];
            list[i].off[k] = pupil_fan_rounded(off, &setup->first);
        }
    }
    return true;
}

bool pupil_fan_trace(const struct bundle_question *bundle, size_t points, struct arena *arena,
                     struct fan *fan, struct error *error)
{
    const struct setup *setup = bundle->setup;
    const size_t each = FAN_SECTIONS * points, count = setup->wavelength_count * each;
    struct fan_ray *rays = ARENA_ARRAY(arena, count, struct fan_ray);
    const size_t lines = setup->wavelength_count * FAN_SECTIONS;
    struct fan_ends *ends = ARENA_ARRAY(arena, lines, struct fan_ends);
    struct beam beam;
    bool some = false;
    for (size_t i = 0; i < lines; i++) {
        ends[i].count = 0;
    }
    *fan = (struct fan){.reference = {NAN, NAN, NAN},
                        .radius = NAN,
                        .no_opd = "they are not of a pupil's fan",
                        .rays = rays,
                        .points = points,
                        .ends = ends};
    wave_section(bundle->field, fan->along);
    if (setup->lens->stop == LENS_NONE || !(setup->first.stop_radius > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the lens has no stop of a known size, whose paraxial pupil has aberrations");
    }
    if (!setup_beam(setup, bundle->field, &beam, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const double h = 2 * (double)(i % points) / (double)(points - 1) - 1;
        const bool tangential = i % each < points;
        rays[i] =
            (struct fan_ray){.pupil = {h * fan->along[tangential ? 0 : 1] + 0.0,
                                       h * (tangential ? fan->along[1] : -fan->along[0]) + 0.0},
                             .off = {NAN, NAN},
                             .opd = NAN,
                             .cosine = {NAN, NAN, NAN}};
    }
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        if (!pupil_fan_cross(bundle, &beam, g, each, arena, rays + g * each, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < count; i++) {
        some = some || rays[i].status == RAY_OK;
    }
    return some || fail(error, ERROR_DOMAIN,
                        "no ray through the paraxial entrance pupil reaches the stop: that of its "
                        "middle is lost at surface %zu (%s)",
                        rays[points / 2].surface, ray_status_name(rays[points / 2].status));
}
