/* trace/tangent.c - what each parameter changes of each step. */
/* SPDX-License-Identifier: MIT */
#include "trace/tangent.h"

#include "trace/adjoint.h"
#include "trace/rigid.h"

#include <assert.h>
#include <math.h>

/* Mirrors stand in the medium before them. */
static size_t medium_before_mirrors(const struct lens *lens, size_t surface)
{
    while (surface != LENS_NONE && surface_reflects(&lens->surfaces[surface])) {
        surface = surface > 0 ? surface - 1 : LENS_NONE;
    }
    return surface;
}

/* Media before and behind a place. */
static void media_of(const struct system *system, size_t place, size_t media[2])
{
    const struct lens *lens = system->lens;
    size_t count = lens->surface_count, surface = system_surface(system, place);
    size_t left = surface > 0 ? surface - 1 : LENS_NONE;
    bool reverse = system->options.reverse;
    if (surface == count) {
        media[0] = media[1] = reverse ? LENS_NONE : medium_before_mirrors(lens, count - 1);
        return;
    }
    media[0] = medium_before_mirrors(lens, reverse ? surface : left);
    media[1] = medium_before_mirrors(lens, reverse ? left : surface);
}

/* The thickness passed on the way to a place: of the surface left of the gap. */
static void seed_thickness(const struct system *system, const struct parameter *by, size_t place,
                           const struct step *step, struct tangent_seed *seed)
{
    size_t count = system->lens->surface_count;
    bool reverse = system->options.reverse;
    if (place == 0 || (place == count && reverse) ||
        by->surface != (reverse ? count - 1 - place : place - 1)) {
        return;
    }
    if (reverse && step->kind == STEP_MOVE &&
        system->lens->surfaces[by->surface + 1].coordinate_break) {
        seed->t_behind = 1; /* the way lies along the axis that is turned to */
    } else {
        seed->t = reverse ? -1 : 1;
    }
}

static struct tangent_seed seed_of(const struct system *system, const struct parameter *by,
                                   size_t place, size_t i)
{
    struct tangent_seed seed = {0};
    const struct step *step = &system->steps[i];
    bool here = step->kind != STEP_MOVE && by->surface == system_surface(system, place);
    if (by->kind == PARAMETER_THICKNESS && i == system->begin[place]) {
        seed_thickness(system, by, place, step, &seed);
    } else if (by->kind == PARAMETER_INDEX && step->kind != STEP_MOVE) {
        size_t media[2], medium = medium_before_mirrors(system->lens, by->surface);
        media_of(system, place, media);
        if (media[0] == medium) {
            seed.n11 = 2 * sqrt(step->n11);
        }
        seed.dn = (media[1] == medium ? 2 * sqrt(step->n22) : 0) - seed.n11;
    } else if (by->kind == PARAMETER_CURVATURE) {
        seed.c = here ? 1 : 0;
    } else if (by->kind == PARAMETER_CONIC) {
        seed.k = here ? 1 : 0;
    } else if (by->kind == PARAMETER_COEFFICIENT && here) {
        int term = surface_term(by->order);
        seed.is_odd = term >= LENS_EVEN;
        if (seed.is_odd) {
            seed.odd[term - LENS_EVEN] = 1;
        } else {
            seed.coefficient[term] = 1;
        }
        seed.series = true;
    }
    return seed;
}

/* A rigid motion: by `sign` times the shift, and turned about an axis through `at`. */
static void add_rigid(const struct rigid *motion, const struct ray_block *restrict rays,
                      struct ray_block *restrict tangent)
{
    const double sign = motion->sign, *e = motion->shift, *a = motion->axis, *at = motion->at;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        double x = rays->x[i] - at[0], y = rays->y[i] - at[1], z = rays->z[i] - at[2];
        double p = rays->p[i], q = rays->q[i], r = rays->r[i];
        tangent->x[i] += sign * (e[0] + (a[1] * z - a[2] * y));
        tangent->y[i] += sign * (e[1] + (a[2] * x - a[0] * z));
        tangent->z[i] += sign * (e[2] + (a[0] * y - a[1] * x));
        tangent->p[i] += sign * (a[1] * r - a[2] * q);
        tangent->q[i] += sign * (a[2] * p - a[0] * r);
        tangent->r[i] += sign * (a[0] * q - a[1] * p);
    }
}

void tangent_trace_start(const struct system *system, size_t places, size_t count,
                         enum instruction_set set, const struct derivative_tape *tape,
                         struct ray_block *tangents)
{
    static const struct tangent_seed nothing[TANGENTS_MOST];
    const struct tangent_seeds all = {nothing, count, tape->lanes};
    for (size_t i = 0; i < system->begin[places]; i++) {
        KERNEL_FOR(set, kernel_tangent)
        (&system->steps[i], &tape->blocks[i], &tape->blocks[i + 1], &all, tangents);
    }
}

/* NaN where a ray is lost. */
static void forget_lost(const struct ray_block *end, int lanes, size_t count,
                        struct ray_block *tangents)
{
    double none = 0;
    for (int i = 0; i < lanes; i++) {
        none += 0 * end->x[i];
    }
    for (size_t j = 0; j < count && isnan(none); j++) {
        double *of[] = {tangents[j].x, tangents[j].y, tangents[j].z,   tangents[j].p,
                        tangents[j].q, tangents[j].r, tangents[j].path};
        for (size_t k = 0; k < sizeof of / sizeof of[0]; k++) {
            for (int i = 0; i < lanes; i++) {
                of[k][i] += 0 * end->x[i];
            }
        }
    }
}

void tangent_trace(const struct system *system, const struct parameter *parameters, size_t count,
                   enum instruction_set set, const struct derivative_tape *tape,
                   struct ray_block *tangents)
{
    kernel_tangent *kernel = KERNEL_FOR(set, kernel_tangent);
    struct tangent_seed seeds[TANGENTS_MOST] = {{0}};
    const struct tangent_seeds all = {seeds, count, tape->lanes};
    for (size_t j = 0; j < count && parameters != NULL; j++) {
        assert(parameter_type(parameters[j].kind)->basis == parameters[j].kind);
    }
    for (size_t place = 0; place < system->places; place++) {
        for (size_t i = system->begin[place]; i < system->begin[place + 1]; i++) {
            for (size_t j = 0; j < count && parameters != NULL; j++) {
                struct rigid motion;
                seeds[j] = seed_of(system, &parameters[j], place, i);
                if (rigid_before(system, parameters[j].kind, parameters[j].surface, i, &motion)) {
                    add_rigid(&motion, &tape->blocks[i], &tangents[j]);
                }
            }
            kernel(&system->steps[i], &tape->blocks[i], &tape->blocks[i + 1], &all, tangents);
            for (size_t j = 0; j < count && parameters != NULL; j++) {
                struct rigid motion;
                if (rigid_behind(system, parameters[j].kind, parameters[j].surface, i, &motion)) {
                    add_rigid(&motion, &tape->blocks[i + 1], &tangents[j]);
                }
            }
        }
    }
    forget_lost(&tape->blocks[system->begin[system->places]], tape->lanes, count, tangents);
}

void tangent_follow(const struct system *system, int lanes, size_t count, struct ray_block rays[2],
                    struct ray_block *tangents)
{
    kernel_tape *trace = KERNEL_FOR(SET_BEST, kernel_tape);
    kernel_tangent *kernel = KERNEL_FOR(SET_BEST, kernel_tangent);
    const struct tangent_seed seeds[TANGENTS_MOST] = {{0}};
    const struct tangent_seeds all = {seeds, count, lanes};
    for (size_t i = 0; i < system->begin[system->places]; i++) {
        trace(&system->steps[i], 1, system->options.path, lanes, rays);
        kernel(&system->steps[i], &rays[0], &rays[1], &all, tangents);
        ray_block_copy(&rays[0], &rays[1], (size_t)lanes);
    }
    forget_lost(&rays[0], lanes, count, tangents);
}
