/* analysis/rays/illumination.c - integrals over what passes of a bundle, doubled until they stand. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/illumination.h"

#include "analysis/pupil/quadrature.h"
#include "base/constants.h"
#include "optics/aperture.h"
#include "trace/pupil/pupil_inside.h"
#include "trace/tangent.h"

#include <math.h>
#include <string.h>

/* Rays of the first value that may do; how often they are doubled at most. */
enum { RAYS_FIRST = 100, DOUBLINGS = 9 };

/*
 * A change that vanishes by chance is not believed: the share of the one before that counts. Areas
 * behind a lens are less smooth than those of beams.
 */
static const double doubted_film = 0.002, doubted_field = 0.05;

/* Changes that fall to more than this share do not fall as those of Gauss's rule in the end do. */
static const double slow = 0.1;

/* No slower fall is believed: changes that grow do not go on to. */
static const double slowest = 0.9;

/* What sums of this many terms may be off by rounding. */
static const double least = 5e-14;

/* What of the beam passes, ready to be filled with rays. */
struct bundle_part {
    struct stop_beam beam;
    struct quadrature_region region;
    double area; /* of the unit disc of u and v, mm^2 */
    /* behind the lens, of the rays of the last sum: what stands for their areas, the least and the
       most; of which sign some are: turned over, as they were */
    double least, most;
    bool turns[2];
};

/* The place of a point of a quadrature; what it stands for, which adds up to the area, mm^2. */
static double part_point(const struct bundle_part *part, const struct pupil_point *point,
                         double at[2])
{
    stop_beam_place(&part->beam, point->x, point->y, at);
    return point->weight * part->area;
}

/* -------- rays of a point of the film: its own side -------- */

static double sum_film(const struct illumination_question *question, struct bundle_part *part,
                       size_t rays, struct arena *arena)
{
    const struct quadrature all = quadrature_fill(&part->region, rays, arena);
    const struct beam *beam = question->beam;
    const double n = question->open->index_first / question->open->index_last;
    const double d = fabs(beam->distance), side = beam->distance > 0 ? 1 : -1;
    double sum = 0;
    for (size_t i = 0; i < all.sample.count && !all.is_empty; i++) {
        double at[2], share = 1;
        const double weight = part_point(part, &all.sample.points[i], at);
        const double rho2 = d * d + at[0] * at[0] + at[1] * at[1];
        const double along =
            d * beam->axis[2] + side * (at[0] * beam->across[0][2] + at[1] * beam->across[1][2]);
        if (question->pass != NULL) {
            const struct ray ray = beam_ray(beam, at[0], at[1]);
            share = question->pass(question->open, &ray, arena);
        }
        /* d/rho^3 times the cosine to the axis, along/rho */
        sum += weight * d / (rho2 * rho2) * fabs(along) * share;
    }
    return n * n * sum;
}

/* -------- rays of a point of the object: behind the lens -------- */

/* Trace a block with its derivatives: what a and b become of n L and n M, lane by lane. */
static void field_areas(const struct illumination_question *question, struct ray_block *block,
                        size_t used, struct ray_block *tangents, double *areas)
{
    const struct ray_block *u = &tangents[0], *v = &tangents[1];
    const int lanes = kernel_lanes(used);
    beam_tangents(question->beam, (double[2]){1, 0}, block, (size_t)lanes, &tangents[0]);
    beam_tangents(question->beam, (double[2]){0, 1}, block, (size_t)lanes, &tangents[1]);
    tangent_follow(question->open, lanes, 2, block, tangents);
    for (size_t k = 0; k < used; k++) {
        areas[k] = u->p[k] * v->q[k] - v->p[k] * u->q[k];
    }
}

static double sum_field(const struct illumination_question *question, struct bundle_part *part,
                        size_t rays, struct arena *arena)
{
    const struct quadrature all = quadrature_fill(&part->region, rays, arena);
    const struct system *system = question->open;
    const struct beam *beam = question->beam;
    struct ray_block *block = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    struct ray_block *tangents = rays_room(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    const double over = 1 / (system->index_first * system->index_first);
    double a[RAYS_BLOCK] = {0}, b[RAYS_BLOCK] = {0}, weights[RAYS_BLOCK], areas[RAYS_BLOCK];
    double sum = 0;
    const size_t count = all.is_empty ? 0 : all.sample.count;
    part->turns[0] = part->turns[1] = false;
    part->least = INFINITY;
    part->most = 0;
    for (size_t i = 0, used = 0; i < count; i++) {
        double at[2];
        weights[used] = part_point(part, &all.sample.points[i], at);
        a[used] = at[0];
        b[used++] = at[1];
        if (used < RAYS_BLOCK && i + 1 < count) {
            continue;
        }
        beam_start(beam, a, b, used, block);
        field_areas(question, block, used, tangents, areas);
        for (size_t k = 0; k < used; k++) {
            /* a ray on the edge may be lost by rounding */
            if (isfinite(areas[k])) {
                sum += weights[k] * over * fabs(areas[k]);
                part->turns[areas[k] > 0] = true;
                part->least = fmin(part->least, fabs(areas[k]));
                part->most = fmax(part->most, fabs(areas[k]));
            }
        }
        used = 0;
    }
    return sum;
}

/*
 * Are rays at the rim turned over that are not within, or the other way round? Between its last
 * ring and the rim Gauss's rule sees nothing, and a bundle that folds there has the sum of one that
 * does not.
 */
static bool field_folds_at_rim(const struct illumination_question *question,
                               const struct bundle_part *part, struct arena *arena)
{
    enum { ARMS = 16 };
    const struct arena_mark mark = arena_mark(arena);
    const double almost = 0.999, alike = 0.5;
    double angles[ARMS], areas[ARMS];
    bool folds = false;
    if (part->least > alike * part->most) {
        return false; /* it is far from folding */
    }
    for (int i = 0; i < ARMS; i++) {
        angles[i] = 2 * PI * i / ARMS;
    }
    const struct rays rays = rays_new(arena, ARMS);
    struct ray_block *tangents = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    const struct quadrature_rim rim = quadrature_edge(&part->region, angles, ARMS, NULL, 0, arena);
    quadrature_rays_within(&part->region, &rim, &almost, 1, &rays);
    field_areas(question, rays.blocks, rim.count, tangents, areas);
    for (size_t i = 0; i < rim.count; i++) {
        folds = folds || (isfinite(areas[i]) && !part->turns[areas[i] > 0]);
    }
    arena_reset(arena, mark);
    return folds;
}

/* -------- until it stands -------- */

typedef double sum_bundle(const struct illumination_question *question, struct bundle_part *part,
                          size_t rays, struct arena *arena);

static double sum_once(const struct illumination_question *question, sum_bundle *sum,
                       struct bundle_part *part, size_t rays, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    double value = sum(question, part, rays, arena);
    arena_reset(arena, mark);
    return value;
}

/*
 * What the third of four values is off by, each of twice the rays of the one before: twice its
 * change. Where changes do not fall as Gauss's rule makes them, the last may be small by chance,
 * and where each is nearly as large as the one before, as where rays graze the edge, all those
 * that would follow add up: twice the sum of the geometric series.
 */
static double illumination_error_of(const double values[4], double doubted)
{
    const double first = fabs(values[1] - values[0]), last = fabs(values[2] - values[1]);
    const double change = fabs(values[3] - values[2]);
    if (change > slow * last || last > slow * first) {
        const double rest = 1 - fmin(change / last, slowest);
        return fmax(4 * fmax(change, last / 8), change > 0 ? 2 * change / rest : 0);
    }
    return 2 * fmax(change, doubted * last);
}

/*
 * The value before the last one: what the last changes of it is what it is off by. Of the last
 * one nothing is known but that it is off by much less.
 */
static struct illumination illumination_converge(const struct illumination_question *question,
                                                 sum_bundle *sum, double doubted,
                                                 struct arena *arena)
{
    struct bundle_part *part = ARENA_NEW(arena, struct bundle_part);
    /* The part about a point. It points into itself. */
    const struct clear_guess guess =
        clear_guess_of(question->clipped, question->beam, question->first);
    const double *inside = question->inside != NULL ? question->inside : guess.centre;
    part->beam = (struct stop_beam){.system = question->clipped,
                                    .beam = question->beam,
                                    .origin = {inside[0], inside[1]},
                                    .axes = {guess.radius, 0, 0, guess.radius},
                                    .radius = question->clipped->stop_radius,
                                    .weight = WEIGHT_BEAM};
    part->area = PI * guess.radius * guess.radius;
    part->region = quadrature_open(&part->beam, arena);
    part->region.in_r = true;
    part->region.in_beam = true;
    part->region.in_half = true;
    size_t rays = RAYS_FIRST;
    double values[4] = {NAN, NAN, sum(question, part, rays / 2, arena),
                        sum_once(question, sum, part, rays, arena)};
    struct illumination light = {.value = values[3]};
    for (int doubled = 1; doubled <= DOUBLINGS && !light.is_met; doubled++) {
        rays *= 2;
        memmove(values, values + 1, 3 * sizeof *values);
        values[3] = sum_once(question, sum, part, rays, arena);
        light.value = values[2];
        light.error = fmax(illumination_error_of(values, doubted), least * light.value);
        if (part->turns[0] && part->turns[1]) { /* folds make kinks: changes fall by chance */
            const double change = fmax(fabs(values[3] - values[2]), fabs(values[2] - values[1]));
            light.error = fmax(light.error, 4 * change);
        }
        light.is_met =
            light.error <= question->error * light.value &&
            !(sum == sum_field && light.value > 0 && field_folds_at_rim(question, part, arena));
    }
    if (question->islands != NULL) {
        *question->islands = quadrature_islands(&part->region, arena);
    }
    return light;
}

struct illumination illumination_of_film(const struct illumination_question *question,
                                         struct arena *arena)
{
    return illumination_converge(question, sum_film, doubted_film, arena);
}

struct illumination illumination_of_field(const struct illumination_question *question,
                                          struct arena *arena)
{
    return illumination_converge(question, sum_field, doubted_field, arena);
}

const struct lens *illumination_stop_only(const struct lens *lens, struct arena *arena)
{
    struct lens *bare = ARENA_NEW(arena, struct lens);
    struct surface *surfaces = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    *bare = *lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        surfaces[i] = lens->surfaces[i];
        if (i == lens->stop) {
            /* The shapes of the stop that pass light, without what blocks. */
            struct aperture *kept =
                ARENA_ARRAY(arena, surfaces[i].aperture_count + 1, struct aperture);
            size_t count = 0;
            for (size_t j = 0; j < surfaces[i].aperture_count; j++) {
                if (!surfaces[i].apertures[j].blocks) {
                    kept[count++] = surfaces[i].apertures[j];
                }
            }
            surfaces[i].apertures = count > 0 ? kept : NULL;
            surfaces[i].aperture_count = count;
        } else {
            surfaces[i].has_diameter = false;
            surfaces[i].apertures = NULL;
            surfaces[i].aperture_count = 0;
        }
    }
    bare->surfaces = surfaces;
    return bare;
}
