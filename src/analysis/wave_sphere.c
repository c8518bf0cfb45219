/* analysis/wave_sphere.c - the sphere that fits the wave fronts of a field best. */
/* SPDX-License-Identifier: MIT */
#include "analysis/wave_sphere.h"

#include "analysis/quadrature.h"
#include "base/linear.h"
#include "trace/dispatch.h"

#include <math.h>

enum { RAYS = 600, STEPS = 8, UNKNOWNS = 3 };

/* Rays that arrive, and what each counts. */
struct sheaf {
    struct ray *rays;
    double *weights; /* their roots, over the wavelength */
    size_t *lights;
    size_t count;
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

static void add_light(const struct wave_lights *lights, size_t g, struct quadrature *all,
                      struct sheaf *sheaf)
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
        }
    }
}

static bool collect(const struct wave_lights *lights, struct arena *arena, struct sheaf *sheaf,
                    struct error *error)
{
    struct quadrature *all = ARENA_ARRAY(arena, lights->count, struct quadrature);
    size_t room = 1;
    for (size_t g = 0; g < lights->count; g++) {
        all[g] = quadrature_make(&lights->list[g].source.pupil, RAYS, arena);
        room += all[g].is_empty ? 0 : all[g].sample.count;
    }
    *sheaf = (struct sheaf){.rays = ARENA_ARRAY(arena, room, struct ray),
                            .weights = ARENA_ARRAY(arena, room, double),
                            .lights = ARENA_ARRAY(arena, room, size_t)};
    for (size_t g = 0; g < lights->count; g++) {
        if (!all[g].is_empty) {
            add_light(lights, g, &all[g], sheaf);
        }
    }
    return sheaf->count > UNKNOWNS + lights->count ||
           fail(error, ERROR_DOMAIN, "no ray arrives: there is no wave front to fit");
}

/*
 * W = W0 - n C.e, and a piston for each wavelength, in wavelengths and by the roots of the weights:
 * the least squares of a row [n e, pistons] = W0 for each ray.
 */
static bool step(const struct sheaf *sheaf, size_t lights, const struct opd_reference *reference,
                 struct arena *arena, double move[3])
{
    size_t columns = UNKNOWNS + lights;
    double *a = ARENA_ARRAY(arena, sheaf->count * columns, double);
    double *b = ARENA_ARRAY(arena, sheaf->count, double);
    double *x = ARENA_ARRAY(arena, columns, double);
    for (size_t i = 0; i < sheaf->count; i++) {
        double *row = a + i * columns, weight = sheaf->weights[i];
        for (size_t k = 0; k < columns; k++) {
            row[k] = k < UNKNOWNS ? weight * reference->n * sheaf->rays[i].cosine[k] : 0;
        }
        row[UNKNOWNS + sheaf->lights[i]] = weight;
        b[i] = -weight * opd_path(reference, &sheaf->rays[i]);
        if (!isfinite(b[i])) {
            return false;
        }
    }
    struct linear_factors factors = linear_factor(a, sheaf->count, columns, 1e-12, arena);
    linear_solve(&factors, b, x);
    for (size_t k = 0; k < UNKNOWNS; k++) {
        move[k] = x[k];
    }
    return true;
}

bool wave_sphere_fit(const struct wave_lights *lights, double pupil, struct arena *arena,
                     struct opd_reference *reference, struct error *error)
{
    const struct wave_light *first = &lights->list[0];
    struct sheaf sheaf;
    double size = INFINITY;
    if (!collect(lights, arena, &sheaf, error)) {
        return false;
    }
    for (int i = 0; i < STEPS && size > 1e-12; i++) {
        double move[3], centre[3];
        if (!step(&sheaf, lights->count, reference, arena, move)) {
            return fail(error, ERROR_DOMAIN, "no sphere fits the wave front");
        }
        size = 0;
        for (int k = 0; k < 3; k++) {
            centre[k] = reference->centre[k] + move[k];
            /* what rounding leaves of a symmetry */
            centre[k] = fabs(centre[k]) < 1e-15 * fmin(reference->radius, 1e6) ? 0 : centre[k];
            size = fmax(size, fabs(move[k]));
        }
        if (!opd_sphere(&first->chief, pupil, reference->n, centre, reference, error)) {
            return false;
        }
        size /= fmin(reference->radius, 1e6);
    }
    return true;
}
