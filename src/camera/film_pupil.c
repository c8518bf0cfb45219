/* camera/film_pupil.c - where rays from the film may leave a lens: its pupil, by film radius. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_pupil.h"

#include "base/constants.h"
#include "trace/clear_guess.h"
#include "trace/edges.h"
#include "trace/probe.h"

#include <assert.h>
#include <string.h>

/* Directions that are looked in: the corners, and the middles of the sectors. */
enum { DIRECTIONS = 2 * FILM_PUPIL_CORNERS };

/* Of an edge's excess; room for what lies between the directions, and beside a kink in the edge. */
static const double tolerance = 1e-7, room = 2e-4, kink = 0.01;

/* The pupil of one point of the film, as it is followed from the one before. */
struct trail {
    bool is_empty;
    double centre[2];          /* in the beam, mm */
    double angles[DIRECTIONS]; /* rad */
    double near[DIRECTIONS];   /* mm; 0: not known */
    struct edge edges[DIRECTIONS];
};

/* That point's directions, cosines. */
struct seen {
    double centre[2], at[DIRECTIONS][2];
};

static struct beam beam_at(const struct film_pupil_question *question, double radius)
{
    return beam_to_pupil((double[3]){0, radius, question->image}, question->first->exit_pupil,
                         question->systems[0]->index_first);
}

static void place(const struct trail *trail, size_t i, double to[2])
{
    const double radius = trail->edges[i].radius;
    to[0] = trail->centre[0] + radius * sin(trail->angles[i]);
    to[1] = trail->centre[1] + radius * cos(trail->angles[i]);
}

/* The edges about the centre, the farthest of all wavelengths; false: the centre is dark. */
static bool find_edges(const struct film_pupil_question *question, const struct beam *beam,
                       struct trail *trail, struct arena *arena)
{
    struct edge edges[DIRECTIONS];
    double least = INFINITY;
    for (size_t w = 0; w < question->system_count; w++) {
        const struct clear_guess guess =
            clear_guess_of(question->systems[w], beam, question->first);
        const double scale = guess.radius;
        const struct stop_beam around = {.system = question->systems[w],
                                         .beam = beam,
                                         .origin = {trail->centre[0], trail->centre[1]},
                                         .axes = {scale, 0, 0, scale},
                                         .radius = question->systems[w]->stop_radius,
                                         .weight = WEIGHT_BEAM};
        const struct margins margins = margins_open(&around, arena);
        double near[DIRECTIONS];
        for (size_t i = 0; i < DIRECTIONS; i++) {
            near[i] = trail->near[i] / scale;
        }
        const struct edge_directions directions = {.frame = {.stretch = {1, 1}},
                                                   .angles = trail->angles,
                                                   .near = near,
                                                   .count = DIRECTIONS};
        edges_find(&margins, &directions, tolerance, edges);
        for (size_t i = 0; i < DIRECTIONS; i++) {
            edges[i].radius *= scale;
            if (w == 0 || edges[i].radius > trail->edges[i].radius) {
                trail->edges[i] = edges[i];
            }
            least = fmin(least, edges[i].radius);
        }
    }
    return least > 0;
}

/* The same from where a ray is known to pass; empty: none does. */
static void search(const struct film_pupil_question *question, const struct beam *beam,
                   struct trail *trail, struct arena *arena)
{
    const struct clear_guess guess = clear_guess_of(question->systems[0], beam, question->first);
    const struct probe probe = probe_open(question->systems[0], beam, arena);
    trail->is_empty = !probe_inside(&probe, &guess, trail->centre);
    for (size_t i = 0; i < DIRECTIONS; i++) {
        trail->angles[i] = 2 * PI * (double)i / DIRECTIONS;
        trail->near[i] = 0;
    }
    trail->is_empty = trail->is_empty || !find_edges(question, beam, trail, arena);
}

static double cross(const double centre[2], const double a[2], const double b[2])
{
    return (a[0] - centre[0]) * (b[1] - centre[1]) - (a[1] - centre[1]) * (b[0] - centre[0]);
}

/* Go on from here: to the centroid, which lies in the meridional plane. */
static void move_centre(const double points[DIRECTIONS + 1][2], double centre[2])
{
    double moment = 0, whole = 0;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        const double area = cross(centre, points[i], points[i + 1]);
        whole += area;
        moment += area * (points[i][1] + points[i + 1][1] - 2 * centre[1]) / 3;
    }
    centre[0] = 0;
    centre[1] += moment / whole;
}

/* The centroid, angles that cut the outline in equal areas about it, and the radii there. */
static void look_ahead(struct trail *trail)
{
    double points[DIRECTIONS + 1][2], areas[DIRECTIONS + 1] = {0};
    for (size_t i = 0; i <= DIRECTIONS; i++) {
        place(trail, i % DIRECTIONS, points[i]);
    }
    move_centre((const double(*)[2])points, trail->centre);
    for (size_t i = 0; i < DIRECTIONS; i++) {
        areas[i + 1] = areas[i] + fabs(cross(trail->centre, points[i], points[i + 1]));
    }
    size_t k = 0;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        const double wanted = areas[DIRECTIONS] * (double)i / DIRECTIONS;
        while (k + 1 < DIRECTIONS && areas[k + 1] <= wanted) {
            k++;
        }
        const double share = (wanted - areas[k]) / (areas[k + 1] - areas[k]);
        const double x = points[k][0] + share * (points[k + 1][0] - points[k][0]);
        const double y = points[k][1] + share * (points[k + 1][1] - points[k][1]);
        trail->angles[i] = atan2(x - trail->centre[0], y - trail->centre[1]);
        trail->near[i] = hypot(x - trail->centre[0], y - trail->centre[1]);
    }
}

static void follow(const struct film_pupil_question *question, double radius, struct trail *trail,
                   struct seen *seen, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    const struct beam beam = beam_at(question, radius);
    if (trail->is_empty || !find_edges(question, &beam, trail, arena)) {
        trail->is_empty = false;
        search(question, &beam, trail, arena);
    }
    struct ray ray = beam_ray(&beam, trail->centre[0], trail->centre[1]);
    memcpy(seen->centre, ray.cosine, sizeof seen->centre);
    for (size_t i = 0; i < DIRECTIONS; i++) {
        double at[2];
        place(trail, i, at);
        ray = beam_ray(&beam, at[0], at[1]);
        memcpy(seen->at[i], trail->is_empty ? seen->centre : ray.cosine, sizeof seen->centre);
    }
    arena_reset(arena, mark);
}

/*
 * How far out a point lies in the triangle of two corners and a centre: 1 on their side; 0 where it
 * is not in that sector.
 */
static double outwards(const double centre[2], const double a[2], const double b[2],
                       const double point[2])
{
    const double ax = a[0] - centre[0], ay = a[1] - centre[1], bx = b[0] - centre[0];
    const double by = b[1] - centre[1], x = point[0] - centre[0], y = point[1] - centre[1];
    const double whole = ax * by - ay * bx;
    const double alpha = (x * by - y * bx) / whole, beta = (ax * y - ay * x) / whole;
    return alpha >= -1e-12 && beta >= -1e-12 ? alpha + beta : 0;
}

static void grow(struct film_outline *outline, const double factors[FILM_PUPIL_CORNERS])
{
    for (size_t k = 0; k <= FILM_PUPIL_CORNERS; k++) {
        for (int axis = 0; axis < 2; axis++) {
            double *corner = &outline->corners[k][axis];
            *corner = outline->centre[axis] +
                      factors[k % FILM_PUPIL_CORNERS] * (*corner - outline->centre[axis]);
        }
    }
}

/* What both corners of a sector must grow by. */
static void widen(double factors[FILM_PUPIL_CORNERS], size_t sector, double factor)
{
    const size_t next = (sector + 1) % FILM_PUPIL_CORNERS;
    factors[sector] = fmax(factors[sector], factor);
    factors[next] = fmax(factors[next], factor);
}

/* The polygon that holds the middles of its sectors too. */
static void enclose(const struct trail *trail, const struct seen *seen,
                    struct film_outline *outline)
{
    double factors[FILM_PUPIL_CORNERS];
    memcpy(outline->centre, seen->centre, sizeof outline->centre);
    for (size_t k = 0; k < FILM_PUPIL_CORNERS; k++) {
        factors[k] = 1 + room;
        memcpy(outline->corners[k], seen->at[2 * k], sizeof outline->corners[k]);
    }
    memcpy(outline->corners[FILM_PUPIL_CORNERS], outline->corners[0], sizeof outline->corners[0]);
    for (size_t k = 0; k < FILM_PUPIL_CORNERS; k++) {
        const struct edge *edges = trail->edges;
        const size_t ends[] = {edges[2 * k].limit, edges[2 * k + 1].limit,
                               edges[(2 * k + 2) % DIRECTIONS].limit};
        const bool is_kink = ends[0] != ends[1] || ends[1] != ends[2];
        const double out = outwards(seen->centre, outline->corners[k], outline->corners[k + 1],
                                    seen->at[2 * k + 1]);
        widen(factors, k, fmax(out, 1) + (is_kink ? kink : room));
    }
    grow(outline, factors);
}

/* Grow two neighbours until the outline of a point halfway between them lies within. */
static void enclose_between(const struct seen *seen, struct film_outline *low,
                            struct film_outline *high)
{
    double factors[FILM_PUPIL_CORNERS];
    struct film_outline middle = *low;
    for (int axis = 0; axis < 2; axis++) {
        middle.centre[axis] = (low->centre[axis] + high->centre[axis]) / 2;
        for (size_t k = 0; k <= FILM_PUPIL_CORNERS; k++) {
            middle.corners[k][axis] = (low->corners[k][axis] + high->corners[k][axis]) / 2;
        }
    }
    for (size_t k = 0; k < FILM_PUPIL_CORNERS; k++) {
        factors[k] = 1;
    }
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (size_t k = 0; k < FILM_PUPIL_CORNERS; k++) {
            const double out =
                outwards(middle.centre, middle.corners[k], middle.corners[k + 1], seen->at[i]);
            if (out > 1 - room) {
                widen(factors, k, out + room);
            }
        }
    }
    grow(low, factors);
    grow(high, factors);
}

bool film_pupil_open(const struct film_pupil_question *question, struct arena *arena,
                     struct film_pupil *pupil, struct error *error)
{
    const double step = question->reach / (FILM_PUPIL_RADII - 1);
    struct trail trail = {.is_empty = true};
    struct seen seen;
    assert(question->reach > 0);
    if (!lens_is_round(question->systems[0]->lens)) {
        return fail(error, ERROR_DOMAIN, "the lens is not the same in all directions");
    }
    if (!(question->systems[0]->stop_radius > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the stop has no diameter: the amount of light is unknown");
    }
    pupil->image = question->image;
    pupil->reach = question->reach;
    for (size_t i = 0; i < FILM_PUPIL_RADII; i++) {
        follow(question, step * (double)i, &trail, &seen, arena);
        enclose(&trail, &seen, &pupil->at[i]);
        if (i == 0 && trail.is_empty) {
            return fail(error, ERROR_DOMAIN, "no light arrives on the axis of the film");
        }
        if (!trail.is_empty) {
            look_ahead(&trail);
        }
    }
    trail.is_empty = true;
    for (size_t i = 0; i + 1 < FILM_PUPIL_RADII; i++) {
        follow(question, step * ((double)i + 0.5), &trail, &seen, arena);
        if (!trail.is_empty) {
            enclose_between(&seen, &pupil->at[i], &pupil->at[i + 1]);
            look_ahead(&trail);
        }
    }
    return true;
}
