/* trace/pupil/clear_cross.c - edges across a beam, a few rays at a time. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clear_cross.h"

#include "trace/aim/multisection.h"
#include "trace/pupil/clear_intervals.h"
#include "trace/pupil/probe.h"

#include <math.h>

/* One edge, while it is looked for: it lies between two neighbours of `points`. */
struct trail {
    double way[2];                                  /* from the centre, of length 1 */
    struct multisection_point points[RAYS_FEW + 2]; /* how far, mm; the excess there */
    size_t count, between;                          /* between 0: nothing is lost yet */
    size_t turns;                                   /* since there is something lost */
    struct clear_edge edge;
};

static double low_of(const struct trail *trail)
{
    return trail->points[trail->between > 0 ? trail->between - 1 : trail->count - 1].at;
}

static bool trail_is_open(const struct trail *trail)
{
    double low = low_of(trail);
    return trail->between == 0 ||
           trail->points[trail->between].at - low > 2e-16 * trail->points[trail->between].at;
}

/* The places to try next: outwards by doubling, equal parts once, then about where it should be. */
static void choose_places(const struct trail *trail, double radius, size_t lanes, double *places)
{
    double low = low_of(trail);
    if (trail->between == 0) {
        for (size_t i = 0; i < lanes; i++) {
            places[i] = ldexp(low > 0 ? 2 * low : radius / 64, (int)i);
        }
        return;
    }
    /* a narrow gap in front of the edge shows in equal parts */
    const struct multisection_point blind[2] = {{low, NAN},
                                                {trail->points[trail->between].at, NAN}};
    if (trail->turns == 0) {
        multisection_places(blind, 2, 1, lanes, places);
    } else {
        multisection_places(trail->points, trail->count, trail->between, lanes, places);
    }
}

/*
 * What the places have shown: the first ray that is lost, and the last that passes before it. Has
 * the bracket become narrower?
 */
static bool take_places(const struct probe *probe, size_t first, size_t lanes, const double *places,
                        const double *excess, struct trail *trail)
{
    struct trail next = {.way = {trail->way[0], trail->way[1]}, .edge = trail->edge};
    const bool closed = trail->between > 0;
    const double low = low_of(trail), high = closed ? trail->points[trail->between].at : INFINITY;
    next.points[next.count++] = trail->points[closed ? trail->between - 1 : trail->count - 1];
    for (size_t i = 0; i < lanes; i++) {
        if (!(places[i] > next.points[next.count - 1].at && places[i] < high)) {
            continue; /* nothing lies between */
        }
        /* another surface than those looked at may end the ray, or none: no number for it */
        const bool passes = probe_passes(probe, first + i);
        bool tells = excess[first + i] < PROBE_LOST && passes == (excess[first + i] <= 0);
        next.points[next.count] =
            (struct multisection_point){places[i], tells ? excess[first + i] : (double)NAN};
        if (next.between == 0 && !passes) {
            next.between = next.count;
            next.edge.status = ray_block_status(probe->work.blocks, first + i);
            next.edge.surface = ray_block_surface(probe->work.blocks, first + i);
        }
        next.count++;
    }
    if (closed) {
        next.points[next.count] = trail->points[trail->between];
        next.between = next.between == 0 ? next.count : next.between;
        next.count++;
    }
    next.turns = closed ? trail->turns + 1 : 0;
    *trail = next;
    return low_of(trail) > low || (trail->between > 0 && trail->points[trail->between].at < high);
}

/* Places to try on all trails; the surfaces that end them as far as is known, else null. */
static const size_t *trails_choose_rays(const struct trail *trails, size_t count, double radius,
                                        double *places, size_t *surfaces)
{
    const size_t lanes = RAYS_FEW / count;
    bool known = true;
    for (size_t i = 0; i < count; i++) {
        choose_places(&trails[i], radius, lanes, places + i * lanes);
        known = known && trails[i].turns > 0 && trails[i].edge.status == RAY_CLIPPED;
        surfaces[i] = trails[i].edge.surface - 1;
    }
    surfaces[count] = LENS_NONE;
    return known ? surfaces : NULL;
}

/* Edges along one or two ways from a point inside. */
static void trails_find_edges(const struct probe *probe, const double centre[2], double radius,
                              struct trail *trails, size_t count)
{
    enum { TURNS = 300 };
    const size_t lanes = RAYS_FEW / count;
    double places[RAYS_FEW], at[RAYS_FEW][2], excess[RAYS_FEW];
    size_t surfaces[3];
    bool busy = true;
    for (size_t i = 0; i < count; i++) {
        trails[i].points[0] = (struct multisection_point){0, NAN};
        trails[i].count = 1;
    }
    for (int turn = 0; turn < TURNS && busy; turn++) {
        const size_t *limits = trails_choose_rays(trails, count, radius, places, surfaces);
        for (size_t i = 0; i < RAYS_FEW; i++) {
            const double *way = trails[i / lanes].way;
            at[i][0] = centre[0] + places[i] * way[0];
            at[i][1] = centre[1] + places[i] * way[1];
        }
        probe_excess(probe, limits, (const double(*)[2])at, RAYS_FEW, excess);
        busy = false;
        for (size_t i = 0; i < count; i++) {
            size_t first = i * lanes;
            bool moved = take_places(probe, first, lanes, places + first, excess, &trails[i]);
            busy = busy || (moved && trail_is_open(&trails[i]));
        }
    }
    for (size_t i = 0; i < count; i++) {
        double t = low_of(&trails[i]);
        trails[i].edge.at[0] = centre[0] + t * trails[i].way[0];
        trails[i].edge.at[1] = centre[1] + t * trails[i].way[1];
    }
}

/*
 * Both edges along one axis, and the point halfway between them if that passes. `mirrors`: one is
 * the image of the other.
 */
static void cross_halve(const struct probe *probe, double radius, int axis, bool mirrors,
                        struct clear_cross *cross)
{
    struct trail trails[2] = {{.count = 0}, {.count = 0}};
    double middle[2] = {cross->centre[0], cross->centre[1]};
    trails[0].way[axis] = 1;
    trails[1].way[axis] = -1;
    trails_find_edges(probe, cross->centre, radius, trails, mirrors ? 1 : 2);
    cross->ends[axis] = cross->ends[axis + 2] = trails[0].edge;
    if (mirrors) {
        cross->ends[axis + 2].at[axis] = -trails[0].edge.at[axis];
        return;
    }
    cross->ends[axis + 2] = trails[1].edge;
    double high = trails[0].edge.at[axis], low = trails[1].edge.at[axis];
    middle[axis] = (high + low) / 2;
    /* what symmetry makes 0 */
    middle[axis] = fabs(middle[axis]) > 1e-12 * (high - low) ? middle[axis] : 0;
    if (middle[axis] == cross->centre[axis] || probe_passes_one(probe, middle)) {
        cross->centre[axis] = middle[axis];
    }
}

/* What is cut out within the edges may reach as far as they do: the last rays that pass. */
static void draw_in(const struct probe *probe, struct clear_cross *cross)
{
    double ends[4][2];
    struct clear_intervals spans[4];
    for (size_t i = 0; i < 4; i++) {
        ends[i][0] = cross->ends[i].at[0];
        ends[i][1] = cross->ends[i].at[1];
    }
    clear_intervals_find(probe, cross->centre, (const double(*)[2])ends, 4, spans);
    for (size_t i = 0; i < 4; i++) {
        double far = spans[i].count > 0 ? spans[i].high[spans[i].count - 1] : 1;
        for (int k = 0; k < 2 && far < 1; k++) {
            cross->ends[i].at[k] = cross->centre[k] + far * (ends[i][k] - cross->centre[k]);
        }
    }
}

void clear_across(const struct system *system, const struct beam *beam,
                  const struct clear_guess *guess, bool is_round, struct arena *arena,
                  struct clear_cross *cross)
{
    const struct probe probe = probe_open(system, beam, arena);
    /* to the bit only where the axes of the beam are those of the lens */
    const bool x = beam->axis[0] != 0, y = beam->axis[1] != 0;
    const bool aside = is_round && !(x && y), upwards = is_round && !x && !y;
    *cross = (struct clear_cross){.is_empty = false};
    cross->is_empty = !probe_inside(&probe, guess, cross->centre);
    if (cross->is_empty) {
        return;
    }
    if (is_round &&
        (cross->centre[0] == 0 || probe_passes_one(&probe, (double[2]){0, cross->centre[1]}))) {
        cross->centre[0] = 0;
    } else {
        cross_halve(&probe, guess->radius, 0, false, cross);
    }
    cross_halve(&probe, guess->radius, 1, upwards && cross->centre[1] == 0, cross);
    cross_halve(&probe, guess->radius, 0, aside && cross->centre[0] == 0, cross);
    if (probe.full != NULL) {
        draw_in(&probe, cross);
    }
}
