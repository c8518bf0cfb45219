/* trace/pupil/clear_cross.c - edges across a beam, to both sides of a ray that passes. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clear_cross.h"

#include "base/constants.h"
#include "trace/pupil/clear_intervals.h"

#include <math.h>

/* Directions of the ends; angles count from b towards a. */
static const double directions[4] = {PI / 2, 0, -PI / 2, PI};

/* What is looked with: u and v are the coordinates from the centre, in radii of the guess. */
struct cross_search {
    struct stop_beam frame;
    struct clearances margins;
    struct clear_cross *cross;
};

static bool cross_passes(const struct cross_search *search, double u, double v)
{
    const double point[1][2] = {{u, v}};
    clearances_look(&search->margins, point, 1);
    return search->margins.excess[0] <= 0;
}

/* The last ray that passes on the way to an end, to the bit, about where its edge was found; there
   itself, if none about it is seen to pass. */
static double cross_last(const struct cross_search *search, size_t end, double radius)
{
    enum { PARTS = RAYS_FEWEST, TURNS = 60 };
    const double sign = end < 2 ? 1 : -1;
    double slack = 1e-14, low = radius * (1 - slack), high = radius * (1 + slack), last = radius;
    for (int turn = 0; turn < TURNS && nextafter(low, high) < high; turn++) {
        double points[PARTS][2] = {{0}}, radii[PARTS];
        size_t dark = 0;
        for (size_t i = 0; i < PARTS; i++) {
            radii[i] = low + (high - low) * ((double)i / (PARTS - 1));
            points[i][end % 2] = sign * radii[i];
        }
        clearances_look(&search->margins, (const double(*)[2])points, PARTS);
        while (dark < PARTS && ray_block_status(search->margins.work.blocks, dark) == RAY_OK) {
            dark++;
        }
        if (dark == 0 || dark == PARTS) {
            slack *= PARTS;
        }
        last = dark == 0 ? last : radii[dark - 1];
        low = dark == 0 ? radius * (1 - slack) : last;
        high = dark == PARTS ? radius * (1 + slack) : radii[dark];
    }
    return sign * last;
}

/*
 * Both edges along one axis, and the point halfway between them if that passes. `mirrors`: one is
 * the image of the other.
 */
static void cross_halve(struct cross_search *search, int axis, bool mirrors)
{
    struct clear_cross *cross = search->cross;
    for (int k = 0; k < 2; k++) {
        search->frame.origin[k] = cross->centre[k];
    }
    /* the edges on one side of an axis (count 1) or on both, from the centre */
    const size_t count = mirrors ? 1 : 2;
    const double farthest = 60;
    const double angles[2] = {directions[axis], directions[axis + 2]};
    struct edge_frame frame = {.stretch = {1, 1}};
    struct edge edges[2];
    bool is_closed = false;
    for (int turn = 0; turn < 60 && !is_closed; turn++) {
        edges_find(&search->margins, &frame, angles, NULL, count, 0, 1e-14, edges);
        is_closed = edges[0].radius < farthest && (count < 2 || edges[1].radius < farthest);
        if (!is_closed) {
            frame.stretch[0] = frame.stretch[1] *= 32;
        }
    }
    for (size_t i = 0; i < count; i++) {
        const size_t end = (size_t)axis + 2 * i;
        const double radius = edges[i].radius * frame.stretch[0];
        cross->ends[end] = clear_edge_of(&search->margins, &frame, angles[i], &edges[i]);
        cross->ends[end].at[axis] =
            cross->centre[axis] + search->frame.axes[0] * cross_last(search, end, radius);
        cross->ends[end].at[1 - axis] = cross->centre[1 - axis];
    }
    if (mirrors) {
        cross->ends[axis + 2] = cross->ends[axis];
        cross->ends[axis + 2].at[axis] = -cross->ends[axis].at[axis];
        return;
    }
    const double high = cross->ends[axis].at[axis], low = cross->ends[axis + 2].at[axis];
    double middle = (high + low) / 2;
    /* what symmetry makes 0 */
    middle = fabs(middle) > 1e-12 * (high - low) ? middle : 0;
    const double by = (middle - cross->centre[axis]) / search->frame.axes[0];
    if (cross_passes(search, axis == 0 ? by : 0, axis == 1 ? by : 0)) {
        cross->centre[axis] = middle;
    }
}

/* What is cut out within the edges may reach as far as they do: the last rays that pass. */
static void cross_draw_in(const struct cross_search *search)
{
    struct clear_cross *cross = search->cross;
    double ends[4][2];
    struct clear_intervals intervals[4];
    for (size_t i = 0; i < 4; i++) {
        ends[i][0] = cross->ends[i].at[0];
        ends[i][1] = cross->ends[i].at[1];
    }
    clear_intervals_find(&search->margins, cross->centre, (const double(*)[2])ends, 4, intervals);
    for (size_t i = 0; i < 4; i++) {
        double far = intervals[i].count > 0 ? intervals[i].high[intervals[i].count - 1] : 1;
        for (int k = 0; k < 2 && far < 1; k++) {
            cross->ends[i].at[k] = cross->centre[k] + far * (ends[i][k] - cross->centre[k]);
        }
    }
}

void clear_across(const struct system *system, const struct beam *beam,
                  const struct clear_guess *guess, bool is_round, struct arena *arena,
                  struct clear_cross *cross)
{
    struct cross_search search = {.frame = {.system = system,
                                            .beam = beam,
                                            .axes = {guess->radius, 0, 0, guess->radius},
                                            .radius = INFINITY,
                                            .weight = WEIGHT_BEAM},
                                  .cross = cross};
    /* to the bit only where the axes of the beam are those of the lens */
    const bool x = beam->axis[0] != 0, y = beam->axis[1] != 0;
    const bool aside = is_round && !(x && y), upwards = is_round && !x && !y;
    *cross = (struct clear_cross){.is_empty = false};
    cross->is_empty = !pupil_inside_find(system, beam, guess, arena, cross->centre);
    if (cross->is_empty) {
        return;
    }
    search.margins = clearances_open(&search.frame, arena);
    search.frame.origin[1] = cross->centre[1];
    if (is_round && (cross->centre[0] == 0 || cross_passes(&search, 0, 0))) {
        cross->centre[0] = 0;
    } else {
        cross_halve(&search, 0, false);
    }
    cross_halve(&search, 1, upwards && cross->centre[1] == 0);
    cross_halve(&search, 0, aside && cross->centre[0] == 0);
    if (search.margins.full != NULL) {
        cross_draw_in(&search);
    }
}
