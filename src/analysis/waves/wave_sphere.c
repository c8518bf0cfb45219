/* analysis/waves/wave_sphere.c - the sphere that fits the wave fronts of a field best. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/wave_sphere.h"

#include "analysis/pupil/quadrature.h"
#include "base/linear.h"
#include "trace/dispatch.h"

#include <math.h>

enum { FIRST_RAYS = 300, MOST_RAYS = 1 << 15, STEPS = 50, UNKNOWNS = 3 };

/*
 * Root mean squares of what changes of the wave front, wavelengths: a step that changes less is the
 * last one, for which rounding of long ways may leave too much; so much the last of all steps, and
 * twice the rays, may change.
 */
static const double still = 1e-9, settled = 1e-6, alike = 1e-6;

/* Rays that arrive, and what each counts. */
struct sheaf {
    struct ray *rays;
    double *weights; /* their roots, over the wavelength */
    size_t *lights;
    size_t count;
    double total; /* sum of the weights themselves */
};

double wave_light_weight(const struct wave_light *light)
{
    const struct stop_beam *beam = &light->source.pupil;
    const double *axes = beam->axes;
    return light->weight * (beam->has_disc ? 1 : fabs(axes[0] * axes[3] - axes[1] * axes[2]));
}

struct ray wave_light_trace(const struct system *system, const struct ray *start,
                            struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct rays one = rays_new(arena, 1);
    rays_set(&one, 0, system->index_first, start);
    rays_trace(system, &one, NULL);
    const struct ray end = rays_get(&one, 0, system->index_last);
    arena_reset(arena, mark);
    return end;
}

static void wave_sphere_add_light(const struct wave_lights *lights, size_t g,
                                  struct quadrature *all, struct sheaf *sheaf)
{
    const struct wave_light *light = &lights->list[g];
    rays_trace(light->system, &all->rays, NULL);
    for (size_t i = 0; i < all->sample.count; i++) {
        struct ray ray = rays_get(&all->rays, i, light->system->index_last);
        double weight = light->weight * all->sample.points[i].weight;
        if (ray.status == RAY_OK && weight > 0) {
            sheaf->rays[sheaf->count] = ray;
            sheaf->weights[sheaf->count] = sqrt(weight) / light->wavelength;
            sheaf->lights[sheaf->count++] = g;
            sheaf->total += weight;
        }
    }
}

/* The clear parts of all wavelengths, found once. */
static struct quadrature_region *open_regions(const struct wave_lights *lights, struct arena *arena)
{
    struct quadrature_region *regions = ARENA_ARRAY(arena, lights->count, struct quadrature_region);
    for (size_t g = 0; g < lights->count; g++) {
        regions[g] = quadrature_open(&lights->list[g].source.pupil, arena);
    }
    return regions;
}

static bool sheaf_fill(const struct wave_lights *lights, struct quadrature_region *regions,
                       size_t rays, struct arena *arena, struct sheaf *sheaf, struct error *error)
{
    struct quadrature *all = ARENA_ARRAY(arena, lights->count, struct quadrature);
    size_t room = 1;
    for (size_t g = 0; g < lights->count; g++) {
        all[g] = quadrature_fill(&regions[g], rays, arena);
        room += all[g].is_empty ? 0 : all[g].sample.count;
    }
    *sheaf = (struct sheaf){.rays = ARENA_ARRAY(arena, room, struct ray),
                            .weights = ARENA_ARRAY(arena, room, double),
                            .lights = ARENA_ARRAY(arena, room, size_t)};
    for (size_t g = 0; g < lights->count; g++) {
        if (!all[g].is_empty) {
            wave_sphere_add_light(lights, g, &all[g], sheaf);
        }
    }
    return sheaf->count > UNKNOWNS + lights->count ||
           fail(error, ERROR_DOMAIN, "no ray arrives: there is no wave front to fit");
}

/*
 * What a step changes of the wave fronts, root mean square in wavelengths: about what it changes of
 * the chief ray's, which is no less than about their means.
 */
static double sheaf_change(const struct sheaf *sheaf, const struct ray *chief,
                           const struct opd_reference *reference, const double move[3])
{
    double sum = 0, middle[3];
    opd_path_by_centre(reference, chief, middle);
    for (size_t i = 0; i < sheaf->count; i++) {
        double slope[3], off = 0;
        opd_path_by_centre(reference, &sheaf->rays[i], slope);
        for (int k = 0; k < UNKNOWNS; k++) {
            off += (slope[k] - middle[k]) * move[k];
        }
        sum += pow(sheaf->weights[i] * off, 2);
    }
    return sqrt(sum / sheaf->total);
}

/*
 * W = W0 - C.(slope of the path), and a piston for each wavelength, in wavelengths and by the roots
 * of the weights: the least squares of a row [slope, pistons] = W0 for each ray.
 */
static bool sheaf_step(const struct sheaf *sheaf, size_t lights,
                       const struct opd_reference *reference, struct arena *arena, double move[3])
{
    const struct arena_mark mark = arena_mark(arena);
    size_t columns = UNKNOWNS + lights;
    double *a = ARENA_ARRAY(arena, sheaf->count * columns, double);
    double *b = ARENA_ARRAY(arena, sheaf->count, double);
    double *x = ARENA_ARRAY(arena, columns, double);
    bool found = true;
    for (size_t i = 0; i < sheaf->count; i++) {
        double *row = a + i * columns, weight = sheaf->weights[i], slope[UNKNOWNS];
        opd_path_by_centre(reference, &sheaf->rays[i], slope);
        for (size_t k = 0; k < columns; k++) {
            row[k] = k < UNKNOWNS ? weight * slope[k] : 0;
        }
        row[UNKNOWNS + sheaf->lights[i]] = weight;
        b[i] = -weight * opd_path(reference, &sheaf->rays[i]);
        found = found && isfinite(b[i]) && isfinite(slope[0] + slope[1] + slope[2]);
    }
    if (found) {
        const struct linear_factors factors = linear_factor(a, sheaf->count, columns, 1e-12, arena);
        linear_solve(&factors, b, x);
        for (size_t k = 0; k < UNKNOWNS; k++) {
            move[k] = x[k];
        }
    }
    arena_reset(arena, mark);
    return found;
}

static bool reference_move(const struct wave_light *first, double pupil, const double move[3],
                           struct opd_reference *reference, struct error *error)
{
    double centre[3];
    for (int k = 0; k < UNKNOWNS; k++) {
        centre[k] = reference->centre[k] + move[k];
        /* what rounding leaves of a symmetry */
        centre[k] = fabs(centre[k]) < 1e-15 * fmin(reference->radius, 1e6) ? 0 : centre[k];
    }
    return opd_sphere(&first->chief, pupil, reference->n, centre, reference, error);
}

/* Gauss's and Newton's steps to the sphere that fits these rays; gives what the first changed. */
static bool sheaf_fit(const struct sheaf *sheaf, const struct wave_lights *lights, double pupil,
                      struct arena *arena, struct opd_reference *reference, double *changed,
                      struct error *error)
{
    const struct wave_light *first = &lights->list[0];
    double change = INFINITY;
    for (int i = 0; i < STEPS && change > still; i++) {
        double move[UNKNOWNS];
        if (!sheaf_step(sheaf, lights->count, reference, arena, move)) {
            return fail(error, ERROR_DOMAIN, "no sphere fits the wave front");
        }
        change = sheaf_change(sheaf, &first->chief, reference, move);
        *changed = i == 0 ? change : *changed;
        if (!reference_move(first, pupil, move, reference, error)) {
            return false;
        }
    }
    return change <= settled ||
           fail(error, ERROR_DOMAIN,
                "the sphere that fits the wave front best is not found in %d steps", STEPS);
}

bool wave_sphere_fit(const struct wave_lights *lights, double pupil, struct arena *arena,
                     struct opd_reference *reference, double *doubt, struct error *error)
{
    struct quadrature_region *regions = open_regions(lights, arena);
    *doubt = INFINITY;
    for (size_t rays = FIRST_RAYS; rays <= MOST_RAYS && *doubt > alike; rays *= 2) {
        const struct arena_mark mark = arena_mark(arena);
        struct sheaf sheaf;
        if (!sheaf_fill(lights, regions, rays, arena, &sheaf, error) ||
            !sheaf_fit(&sheaf, lights, pupil, arena, reference, doubt, error)) {
            return false;
        }
        arena_reset(arena, mark);
    }
    return true;
}
