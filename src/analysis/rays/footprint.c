/* analysis/rays/footprint.c - where the beam of a field crosses the surfaces of a lens. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/footprint.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

enum { AROUND = 720, MOST = AROUND + PUPIL_BOUNDARY_CORNERS };

/* Shares of the way to the edge; rays on it are not clipped by rounding. */
static const double rings[] = {0.25, 0.5, 0.75, 0.9375, 1 - 1e-12};
enum { RINGS = sizeof rings / sizeof rings[0], EDGE = RINGS - 1 };

/* Directions in order, corners among them. */
static size_t footprint_directions(const struct pupil_boundary *boundary, double angles[MOST])
{
    size_t count = 0;
    for (size_t i = 0; i < AROUND; i++) {
        const double angle = 2 * PI * (double)i / AROUND, next = angle + 2 * PI / AROUND;
        angles[count++] = angle;
        for (size_t k = 0; k < boundary->corner_count; k++) {
            const double turns = floor(boundary->corners[k] / (2 * PI));
            const double corner = boundary->corners[k] - 2 * PI * turns;
            if (corner > angle && corner < next) {
                angles[count++] = corner;
            }
        }
    }
    return count;
}

/* The highest of values once about: of a parabola through it and its neighbours, alike far. */
static double footprint_highest(const double *values, const double *angles, size_t count)
{
    size_t best = 0;
    for (size_t i = 1; i < count; i++) {
        best = values[i] > values[best] ? i : best;
    }
    const size_t last = (best + count - 1) % count, next = (best + 1) % count;
    const double slope = (values[next] - values[last]) / 2;
    const double bend = values[last] - 2 * values[best] + values[next];
    const double before = angles[best] - angles[last] + (best == 0 ? 2 * PI : 0);
    const double after = angles[next] - angles[best] + (next == 0 ? 2 * PI : 0);
    const bool even = fabs(before - after) < 1e-9;
    return even && bend < 0 && fabs(slope) <= -bend ? values[best] - slope * slope / (2 * bend)
                                                    : values[best];
}

/* What rays say of a surface, ring after ring. */
static void footprint_measure(const struct rays *rays, const struct system *system,
                              const double *angles, size_t count, struct arena *arena,
                              struct footprint *footprint)
{
    double(*outline)[2] = arena_array(arena, count, sizeof *outline);
    const struct arena_mark mark = arena_mark(arena);
    double *values = ARENA_ARRAY(arena, 5 * count, double);
    double most[5] = {-INFINITY, -INFINITY, -INFINITY, -INFINITY, 0};
    for (size_t ring = 0; ring < RINGS; ring++) {
        for (size_t i = 0; i < count; i++) {
            const struct ray ray = rays_get(rays, ring * count + i, system->index_last);
            const bool arrives = ray.status == RAY_OK;
            const double x = arrives ? ray.point[0] : (double)NAN;
            const double y = arrives ? ray.point[1] : (double)NAN;
            const double said[5] = {x, y, -x, -y, hypot(x, y)};
            for (size_t k = 0; k < 5; k++) {
                values[k * count + i] = said[k];
                most[k] = fmax(most[k], said[k]);
            }
            if (ring == EDGE) {
                outline[i][0] = x;
                outline[i][1] = y;
            }
        }
    }
    for (size_t k = 0; k < 5; k++) {
        most[k] = fmax(most[k], footprint_highest(values + k * count, angles, count));
    }
    arena_reset(arena, mark);
    *footprint = (struct footprint){.low = {-most[2] + 0.0, -most[3] + 0.0},
                                    .high = {most[0], most[1]},
                                    .radius = most[4],
                                    .outline = (const double(*)[2])outline,
                                    .count = count};
}

bool footprints_find(const struct bundle_question *bundle, struct arena *arena,
                     struct footprint *footprints, struct error *error)
{
    const struct setup *setup = bundle->setup;
    struct bundle_question *asked = ARENA_NEW(arena, struct bundle_question);
    struct bundle_source *source = ARENA_NEW(arena, struct bundle_source);
    double angles[MOST];
    *asked = *bundle;
    asked->pattern = PATTERN_GAUSS;
    if (!bundle_open(asked, arena, source, error)) {
        return false;
    }
    const struct pupil_boundary *boundary = quadrature_boundary(source->region, arena);
    if (boundary == NULL) {
        return bundle_fail_dark(source, 0, arena, error);
    }
    const struct system *open =
        setup_system(setup, bundle->wavelength, SETUP_OPEN, error); /* without the image plane */
    if (open == NULL) {
        return false;
    }
    const size_t count = footprint_directions(boundary, angles);
    const struct quadrature_rim edge =
        quadrature_edge(source->region, angles, count, NULL, 0, arena);
    const struct rays rays = rays_room(arena, RINGS * count);
    quadrature_rays_within(source->region, &edge, rings, RINGS, &rays);
    for (size_t place = 0; place < open->places; place++) {
        rays_trace_part(open, place, place + 1, &rays, NULL);
        for (size_t i = 0; i < setup->lens->surface_count; i++) {
            if (system_place(open, i) == place) {
                footprint_measure(&rays, open, angles, count, arena, &footprints[i]);
            }
        }
    }
    return true;
}
