/* analysis/rays/fresnel.c - what uncoated faces let pass. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/fresnel.h"

#include "optics/surface.h"
#include "trace/follow.h"

#include <math.h>

static double fresnel_square(double x)
{
    return x * x;
}

/* Does light lose some of itself here by reflection? */
static bool is_face(const struct system *system, size_t place)
{
    const struct lens *lens = system->lens;
    const size_t surface = system_surface(system, place);
    return surface < lens->surface_count && !surface_reflects(&lens->surfaces[surface]) &&
           !surface_has(&lens->surfaces[surface], SURFACE_HAS_FOCAL);
}

double fresnel_pass(const struct system *system, const struct ray *start, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct ray_intersection *meetings = ARENA_ARRAY(arena, system->places, struct ray_intersection);
    double across = 1, along = 1, before = fabs(system->index_first);
    ray_follow(system, start, arena, meetings);
    for (size_t i = 0; i < system->places; i++) {
        const double behind = fabs(system_index_after(system, i));
        if (is_face(system, i) && behind != before) {
            const double in = cos(meetings[i].angles.incidence);
            const double out = cos(meetings[i].angles.refraction);
            across *=
                1 - fresnel_square((before * in - behind * out) / (before * in + behind * out));
            along *=
                1 - fresnel_square((behind * in - before * out) / (behind * in + before * out));
        }
        before = behind;
    }
    arena_reset(arena, mark);
    return (across + along) / 2;
}
