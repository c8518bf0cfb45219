/* analysis/illumination.c - integrals over what passes of a bundle, doubled until they stand. */
/* SPDX-License-Identifier: MIT */
#include "analysis/illumination.h"

#include "base/constants.h"
#include "optics/aperture.h"
#include "trace/clear.h"
#include "trace/sample.h"
#include "trace/spans.h"
#include "trace/tangent.h"

#include <math.h>
#include <string.h>

/* Edges and points along each of their arms: of the first try and of the last. */
enum { EDGES_FIRST = 128, POINTS_FIRST = 4, DOUBLINGS = 5, POINTS_MOST = 32 };

/* A point of the beam and what it stands for. */
typedef void visit_point(void *context, const double at[2], double weight);

/* Gauss's points on the clear parts of every arm; weights add up to the area, mm^2. */
static void each_point(const struct clear_pupil *clear, size_t points, visit_point *visit,
                       void *context)
{
    double x[POINTS_MOST], w[POINTS_MOST];
    const double *c = clear->centre;
    gauss_rule(points, x, w);
    for (size_t i = 0; i < clear->arm_count; i++) {
        const struct clear_arm *arm = &clear->arms[i];
        const struct spans *spans = arm->spans;
        for (size_t k = 0; k < points * spans->count; k++) {
            double low = spans->low[k / points], width = spans->high[k / points] - low;
            double t = low + width * x[k % points];
            const double at[2] = {c[0] + t * (arm->edge.at[0] - c[0]),
                                  c[1] + t * (arm->edge.at[1] - c[1])};
            visit(context, at, 2 * arm->area * t * width * w[k % points]);
        }
    }
}

/* -------- rays of a point of the film: its own side -------- */

struct film_sum {
    const struct beam *beam;
    double sum;
};

static void add_film(void *context, const double at[2], double weight)
{
    struct film_sum *film = context;
    const struct beam *beam = film->beam;
    const double d = fabs(beam->distance), rho = sqrt(d * d + at[0] * at[0] + at[1] * at[1]);
    const struct ray ray = beam_ray(beam, at[0], at[1]);
    film->sum += weight * d / (rho * rho * rho) * fabs(ray.cosine[2]);
}

static double sum_film(const struct illumination_question *question,
                       const struct clear_pupil *clear, size_t points, struct arena *arena)
{
    struct film_sum film = {.beam = question->beam};
    const double n = question->open->index_first / question->open->index_last;
    (void)arena;
    each_point(clear, points, add_film, &film);
    return n * n * film.sum;
}

/* -------- rays of a point of the object: behind the lens -------- */

struct field_sum {
    const struct illumination_question *question;
    struct derivative_tape tape;
    struct ray_block *start, *tangents; /* one, and two */
    double weights[RAYS_BLOCK];
    size_t count;
    double sum;
};

/* Trace what waits, with its derivatives. */
static void flush(struct field_sum *field)
{
    const struct system *system = field->question->open;
    const struct ray_block *a = &field->tangents[0], *b = &field->tangents[1];
    derivative_trace(system, field->start, SET_BEST, &field->tape);
    tangent_trace(system, NULL, 2, SET_BEST, &field->tape, field->tangents);
    const double over = 1 / (system->index_first * system->index_first);
    for (size_t i = 0; i < field->count; i++) {
        double area = fabs(a->p[i] * b->q[i] - b->p[i] * a->q[i]);
        /* a ray on the edge may be lost by rounding */
        field->sum += isfinite(area) ? field->weights[i] * over * area : 0;
    }
    field->count = 0;
}

static void add_field(void *context, const double at[2], double weight)
{
    struct field_sum *field = context;
    const struct beam *beam = field->question->beam;
    const struct ray ray = beam_ray(beam, at[0], at[1]);
    const struct rays start = {field->start, RAYS_BLOCK};
    const size_t i = field->count;
    rays_set(&start, i, beam->n, &ray);
    for (int k = 0; k < 2; k++) {
        double point[3], direction[3];
        struct ray_block *tangent = &field->tangents[k];
        beam_slope(beam, at, k, point, direction);
        tangent->x[i] = point[0];
        tangent->y[i] = point[1];
        tangent->z[i] = point[2];
        tangent->p[i] = direction[0];
        tangent->q[i] = direction[1];
        tangent->r[i] = direction[2];
        tangent->path[i] = 0;
    }
    field->weights[i] = weight;
    field->count++;
    if (field->count == RAYS_BLOCK) {
        flush(field);
    }
}

static double sum_field(const struct illumination_question *question,
                        const struct clear_pupil *clear, size_t points, struct arena *arena)
{
    struct field_sum *field = ARENA_NEW(arena, struct field_sum);
    field->question = question;
    field->tape = derivative_tape_new(question->open, arena);
    field->start = rays_new(arena, RAYS_BLOCK).blocks;
    field->tangents = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    each_point(clear, points, add_field, field);
    flush(field);
    return field->sum;
}

/* -------- until it stands -------- */

typedef double sum_bundle(const struct illumination_question *question,
                          const struct clear_pupil *clear, size_t points, struct arena *arena);

static size_t edges_of(int doubled)
{
    return (size_t)EDGES_FIRST << doubled;
}

static double sum_once(const struct illumination_question *question, sum_bundle *sum, int doubled,
                       struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const size_t points = (size_t)POINTS_FIRST << doubled;
    struct clear_guess guess = clear_guess_of(question->clipped, question->beam, question->first);
    struct clear_pupil clear;
    if (question->inside != NULL) {
        guess.centre[0] = question->inside[0];
        guess.centre[1] = question->inside[1];
    }
    clear_find(question->clipped, question->beam, &guess, edges_of(doubled), arena, &clear);
    double value = clear.is_empty
                       ? 0
                       : sum(question, &clear, points < POINTS_MOST ? points : POINTS_MOST, arena);
    arena_reset(arena, mark);
    return value;
}

/* May something end the beam beside the stop, between two edges that do not see it? */
static bool hides_edges(const struct system *system)
{
    const struct lens *lens = system->lens;
    bool hides = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        hides =
            hides || surface->aperture_count > 0 || (i != system->stop && surface->has_diameter);
    }
    return hides;
}

static struct illumination converge(const struct illumination_question *question, sum_bundle *sum,
                                    struct arena *arena)
{
    struct illumination light = {.value = sum_once(question, sum, 0, arena)};
    const bool hides = hides_edges(question->clipped);
    for (int doubled = 1; doubled <= DOUBLINGS && !light.is_met; doubled++) {
        const double before = light.value, step = 2 * PI / (double)edges_of(doubled);
        /* a straight edge cuts a quarter of this off a disc between two directions */
        const double unseen = hides ? step * step * step / (3 * PI) : 0;
        light.value = sum_once(question, sum, doubled, arena);
        light.error = fmax(fabs(light.value - before), fmax(unseen, 1e-14) * light.value);
        light.is_met = light.error <= question->error * light.value;
    }
    return light;
}

struct illumination illumination_of_film(const struct illumination_question *question,
                                         struct arena *arena)
{
    return converge(question, sum_film, arena);
}

struct illumination illumination_of_field(const struct illumination_question *question,
                                          struct arena *arena)
{
    return converge(question, sum_field, arena);
}

/* The shapes of the stop that pass light, without what blocks. */
static void keep_passes(struct surface *stop, struct arena *arena)
{
    struct aperture *kept = ARENA_ARRAY(arena, stop->aperture_count + 1, struct aperture);
    size_t count = 0;
    for (size_t i = 0; i < stop->aperture_count; i++) {
        if (!stop->apertures[i].blocks) {
            kept[count++] = stop->apertures[i];
        }
    }
    stop->apertures = count > 0 ? kept : NULL;
    stop->aperture_count = count;
}

const struct lens *illumination_stop_only(const struct lens *lens, struct arena *arena)
{
    struct lens *bare = ARENA_NEW(arena, struct lens);
    struct surface *surfaces = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    *bare = *lens;
    for (size_t i = 0; i < lens->surface_count; i++) {
        surfaces[i] = lens->surfaces[i];
        if (i == lens->stop) {
            keep_passes(&surfaces[i], arena);
        } else {
            surfaces[i].has_diameter = false;
            surfaces[i].apertures = NULL;
            surfaces[i].aperture_count = 0;
        }
    }
    bare->surfaces = surfaces;
    return bare;
}
