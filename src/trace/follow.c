/* trace/follow.c - one ray seen at every surface, exact and paraxial. */
/* SPDX-License-Identifier: MIT */
#include "trace/follow.h"

#include "optics/paraxial.h"
#include "trace/dispatch.h"

#include <math.h>

static void frame_turn(const struct surface_frame *frame, const double from[3], double to[3])
{
    for (int i = 0; i < 3; i++) {
        const double *row = &frame->turn[(ptrdiff_t)3 * i];
        to[i] = row[0] * from[0] + row[1] * from[1] + row[2] * from[2];
    }
}

void ray_follow(const struct system *system, const struct ray *start, struct arena *arena,
                struct ray_intersection *meetings)
{
    struct rays rays = rays_new(arena, 1);
    double before[3] = {start->cosine[0], start->cosine[1], start->cosine[2]};
    const struct surface_frame *frames = system_frames(system, arena);
    const size_t last = system->lens->surface_count - 1;
    rays_set(&rays, 0, system->index_first, start);
    for (size_t place = 0; place < system->places; place++) {
        struct ray_intersection *meeting = &meetings[place];
        rays_trace_part(system, place, place + 1, &rays, NULL);
        meeting->ray = rays_get(&rays, 0, system_index_after(system, place));
        meeting->angles = (struct ray_angles){NAN, NAN};
        if (meeting->ray.status != RAY_OK) {
            struct ray *ray = &meeting->ray;
            for (int i = 0; i < 3; i++) {
                ray->point[i] = ray->cosine[i] = NAN;
            }
            ray->path = NAN;
            continue;
        }
        const size_t surface = system_surface(system, place);
        const struct surface_frame *frame = &frames[surface < last ? surface : last];
        /*
         * Directions of different frames are compared in the frame of the first vertex, to which
         * `frame` leads.
         */
        const struct ray *after = &meeting->ray;
        double normal[3] = {0, 0, 1}, normal_first[3], behind[3];
        if (surface < system->lens->surface_count) {
            system_normal(system, surface, after->point, normal);
        }
        frame_turn(frame, normal, normal_first);
        frame_turn(frame, after->cosine, behind);
        meeting->angles = ray_angles(normal_first, before, behind);
        frame_turn(frame, meeting->ray.cosine, before);
    }
}

/* One section: heights at the surfaces and slopes behind them. */
static bool paraxial_section_follow(const struct lens *lens, double wavelength,
                                    enum lens_section section, double height, double slope,
                                    struct arena *arena, double *heights, double *slopes,
                                    struct error *error)
{
    struct paraxial_system system;
    if (!paraxial_compile(lens, wavelength, section, arena, &system, error)) {
        return false;
    }
    struct paraxial_ray *rays = ARENA_ARRAY(arena, system.count, struct paraxial_ray);
    paraxial_follow(&system, pair_of(height), pair_of(slope * system.index[0].hi), rays);
    for (size_t i = 0; i < system.count; i++) {
        heights[i] = rays[i].y;
        slopes[i] = rays[i].after / system.index[i + 1].hi;
    }
    return true;
}

bool ray_follow_paraxially(const struct lens *lens, double wavelength, const struct ray *start,
                           struct arena *arena, struct paraxial_intersection *meetings,
                           struct error *error)
{
    size_t count = lens->surface_count;
    double *values = ARENA_ARRAY(arena, 4 * count, double);
    for (int i = 0; i < 2; i++) {
        enum lens_section section = i == 0 ? SECTION_X : SECTION_Y;
        double n = start->cosine[2], slope = n > 0 ? start->cosine[i] / n : (double)NAN;
        double *at = values + 2 * (size_t)i * count;
        if (!paraxial_section_follow(lens, wavelength, section,
                                     start->point[i] - start->point[2] * slope, slope, arena, at,
                                     at + count, error)) {
            return false;
        }
    }
    for (size_t i = 0; i < count; i++) {
        meetings[i] = (struct paraxial_intersection){values[i], values[2 * count + i],
                                                     values[count + i], values[3 * count + i]};
    }
    return true;
}
