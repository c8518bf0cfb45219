/* trace/pupil/clear.c - arms to the edge of a clear pupil, and the curve through their ends. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clear.h"

#include "base/constants.h"
#include "trace/aim/sample.h"
#include "trace/pupil/pupil_boundary.h"

#include <math.h>

/* Arms of an edge without corners; of one that has too many. */
enum { CIRCLE = 128, MANY = 1024 };

/* How far beside a corner its edges are, rad. */
static const double beside = 3e-8;

/* A pupil at work. */
struct clear_search {
    const struct clearances *margins;
    const struct pupil_boundary *boundary;
    struct arena *arena;
};

/* Edges in some directions, with their rays. */
static struct clear_edge *clear_find_edges(const struct clear_search *search, const double *angles,
                                           size_t count, struct edge *found)
{
    const struct pupil_boundary *boundary = search->boundary;
    struct clear_edge *edges = ARENA_ARRAY(search->arena, count, struct clear_edge);
    pupil_boundary_edges(search->margins, boundary, angles, count, search->arena, found);
    for (size_t i = 0; i < count; i++) {
        edges[i] = clear_edge_of(search->margins, &boundary->frame, angles[i], &found[i]);
    }
    return edges;
}

/* Counterclockwise from below: angles of boundaries count the other way, from above. */
static double clear_angle(size_t i, size_t count)
{
    return PI - 2 * PI * ((double)i / (double)count);
}

/* The edges just before and just behind the beginning of every piece. */
static void clear_put_corners(const struct clear_search *search, struct clear_pupil *pupil)
{
    const size_t count = 2 * pupil->arcs;
    double *angles = ARENA_ARRAY(search->arena, count, double);
    struct edge *found = ARENA_ARRAY(search->arena, count, struct edge);
    for (size_t i = 0; i < count; i++) {
        const size_t next = (pupil->arcs - i / 2) % pupil->arcs;
        angles[i] = search->boundary->corners[next] + (i % 2 == 0 ? beside : -beside);
    }
    pupil->corners = clear_find_edges(search, angles, count, found);
    pupil->corner_count = count;
}

/* The arms, from angles to areas: r^2/2 of each, in stretched coordinates. */
static void clear_put_arms(const struct clear_search *search, struct clear_pupil *pupil)
{
    const struct edge_frame *frame = &search->boundary->frame;
    const double *axes = search->margins->beam->axes;
    const double unit = frame->stretch[0] * frame->stretch[1] * axes[0] * axes[3];
    /* something that is the last in no direction but one has no arc of its own */
    pupil->arcs = search->boundary->corner_count >= 2 ? search->boundary->corner_count : 0;
    pupil->arm_count = search->margins->is_listed ? MANY : CIRCLE;
    if (pupil->arcs > 0) {
        pupil->arm_count = pupil->arcs * CLEAR_ARC;
    }
    const size_t count = pupil->arm_count;
    double *angles = ARENA_ARRAY(search->arena, count, double);
    struct edge *found = ARENA_ARRAY(search->arena, count, struct edge);
    struct clear_intervals *intervals = ARENA_ARRAY(search->arena, count, struct clear_intervals);
    pupil->arms = ARENA_ARRAY(search->arena, count, struct clear_arm);
    /* directions of the arms, and what angles they stand for */
    const double *corners = search->boundary->corners;
    double *widths = ARENA_ARRAY(search->arena, pupil->arcs, double);
    for (size_t i = 0; i < pupil->arm_count && pupil->arcs == 0; i++) {
        angles[i] = clear_angle(i, pupil->arm_count);
        pupil->arms[i].area = 2 * PI / (double)pupil->arm_count;
    }
    for (size_t i = 0; i < pupil->arm_count && pupil->arcs > 0; i++) {
        const size_t arc = i / CLEAR_ARC, last = pupil->arcs - 1 - arc;
        const double low = corners[last];
        const double high = last + 1 < pupil->arcs ? corners[last + 1] : corners[0] + 2 * PI;
        double share = pupil->nodes[i % CLEAR_ARC], weight = pupil->gauss[i % CLEAR_ARC];
        if (pupil->is_cut) {
            weight *= PI / 2 * sin(PI * share);
            share = (1 - cos(PI * share)) / 2;
        }
        angles[i] = high - share * (high - low);
        widths[arc] = high - low;
        pupil->arms[i].area = weight * (high - low);
    }
    pupil->arc_angles = widths;
    clear_put_corners(search, pupil);
    const struct clear_edge *edges = clear_find_edges(search, angles, count, found);
    pupil_boundary_intervals(search->margins, frame, angles, count, found, intervals);
    for (size_t i = 0; i < count; i++) {
        struct clear_arm *arm = &pupil->arms[i];
        double share = 0; /* that is clear */
        for (size_t k = 0; k < intervals[i].count; k++) {
            const double low = intervals[i].low[k], high = intervals[i].high[k];
            share += (high - low) * (high + low);
        }
        arm->edge = edges[i];
        arm->area *= unit * found[i].radius * found[i].radius / 2;
        arm->intervals = &intervals[i];
        pupil->area += arm->area * share;
        pupil->within += arm->area;
    }
    pupil->is_empty = !(pupil->area > 0);
}

/* -------- the curve -------- */

enum { NODES = 16, FEW_NODES = 6 };

/* The polynomial through some arms of a piece, in the numbers that they are placed by. */
struct edge_piece {
    size_t count;
    double at[NODES], value[NODES], weight[NODES];
};

static void piece_weigh(struct edge_piece *piece)
{
    for (size_t i = 0; i < piece->count; i++) {
        double product = 1;
        for (size_t k = 0; k < piece->count; k++) {
            product *= k != i ? piece->at[i] - piece->at[k] : 1;
        }
        piece->weight[i] = 1 / product;
    }
}

/* [Berrut04] (4.2) */
static double piece_value(const struct edge_piece *piece, double x)
{
    double above = 0, below = 0;
    for (size_t i = 0; i < piece->count; i++) {
        double gap = x - piece->at[i];
        if (!(fabs(gap) > 1e-14)) {
            return piece->value[i];
        }
        above += piece->weight[i] / gap * piece->value[i];
        below += piece->weight[i] / gap;
    }
    return above / below;
}

/* Its largest value between two places with one hill between them: narrower and narrower. */
static double piece_peak(const struct edge_piece *piece, double low, double high)
{
    enum { ROUNDS = 6 };
    double middle = (low + high) / 2, half = (high - low) / 2, best = -INFINITY;
    bool rises = true;
    for (int round = 0; round < ROUNDS && rises; round++) {
        const double before = best;
        const double from = fmax(middle - half, low), to = fmin(middle + half, high);
        const double a = piece_value(piece, from), b = piece_value(piece, (from + to) / 2);
        const double c = piece_value(piece, to), bend = a - 2 * b + c;
        double step = a > c ? -1 : 1;
        if (bend < 0) {
            step = (a - c) / (2 * bend);
        }
        step = fmax(-1, fmin(step, 1));
        best = fmax(best, fmax(a, fmax(b, c)));
        rises = best > before;
        middle = (from + to) / 2 + step * (to - from) / 2;
        half = (to - from) / 8;
    }
    return fmax(best, piece_value(piece, middle));
}

/* The peak of the polynomial through so many arms about the best one. */
static double hill_of(const struct clear_pupil *pupil, const double (*arms)[2], int axis,
                      double sign, size_t best, size_t nodes)
{
    const double *x = pupil->nodes;
    const size_t arc = best / CLEAR_ARC, k = best % CLEAR_ARC, count = pupil->arm_count;
    struct edge_piece piece = {.count = nodes};
    size_t first = k < nodes / 2 ? 0 : k - nodes / 2;
    first = first > CLEAR_ARC - nodes ? CLEAR_ARC - nodes : first;
    for (size_t i = 0; i < nodes; i++) {
        const bool pieces = pupil->arcs > 0;
        const size_t arm =
            pieces ? arc * CLEAR_ARC + first + i : (best + count + i - nodes / 2) % count;
        piece.at[i] = pieces ? x[first + i] : (double)i - (double)(nodes / 2);
        piece.value[i] = sign * arms[arm][axis];
    }
    piece_weigh(&piece);
    if (pupil->arcs == 0) {
        return piece_peak(&piece, -1, 1);
    }
    return piece_peak(&piece, k > 0 ? x[k - 1] : 0, k + 1 < CLEAR_ARC ? x[k + 1] : 1);
}

double clear_extreme(const struct clear_pupil *pupil, const double (*points)[2], int axis,
                     double sign, size_t *which)
{
    const double alike = 1e-3;
    const size_t tips = pupil->corner_count;
    const double(*arms)[2] = points + tips;
    double lowest = INFINITY;
    size_t best = 0;
    for (size_t i = 0; i < pupil->arm_count; i++) {
        best = sign * arms[i][axis] > sign * arms[best][axis] ? i : best;
        lowest = fmin(lowest, sign * arms[i][axis]);
    }
    double highest = sign * arms[best][axis];
    const double hill = hill_of(pupil, arms, axis, sign, best, NODES);
    const double few = hill_of(pupil, arms, axis, sign, best, FEW_NODES);
    /* at a step of the edge polynomials overshoot */
    bool smooth = fabs(hill - few) <= alike * (highest - lowest);
    highest = smooth ? fmax(highest, hill) : highest;
    *which = tips + best;
    for (size_t i = 0; i < tips; i++) {
        *which = sign * points[i][axis] > highest ? i : *which;
        highest = fmax(highest, sign * points[i][axis]);
    }
    return sign * highest;
}

const struct clear_edge *clear_edge_at(const struct clear_pupil *pupil, size_t which)
{
    const size_t tips = pupil->corner_count;
    return which < tips ? &pupil->corners[which] : &pupil->arms[which - tips].edge;
}

void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil)
{
    struct stop_beam frame = {.system = system,
                              .beam = beam,
                              .axes = {guess->radius, 0, 0, guess->radius},
                              .radius = system->stop_radius,
                              .weight = WEIGHT_BEAM};
    *pupil = (struct clear_pupil){.is_cut = system->outer != NULL};
    gauss_rule(CLEAR_ARC, pupil->nodes, pupil->gauss);
    pupil->is_empty = !pupil_inside_find(system, beam, guess, arena, frame.origin);
    if (pupil->is_empty) {
        return;
    }
    const struct clearances margins = clearances_open(&frame, arena);
    struct pupil_boundary *boundary = ARENA_NEW(arena, struct pupil_boundary);
    const struct clear_search search = {&margins, boundary, arena};
    pupil->is_empty = !pupil_boundary_find(&margins, arena, boundary);
    if (pupil->is_empty) {
        return;
    }
    stop_beam_place(&frame, boundary->frame.centre[0], boundary->frame.centre[1], pupil->centre);
    clear_put_arms(&search, pupil);
    /* how far the edge reaches along both axes, and where */
    const size_t count = pupil->corner_count + pupil->arm_count;
    double(*at)[2] = arena_array(arena, count, sizeof *at);
    for (size_t i = 0; i < count; i++) {
        at[i][0] = clear_edge_at(pupil, i)->at[0];
        at[i][1] = clear_edge_at(pupil, i)->at[1];
    }
    for (int k = 0; k < 2; k++) {
        const double(*points)[2] = (const double(*)[2])at;
        pupil->high[k] = clear_extreme(pupil, points, k, 1, &pupil->ends[k]);
        pupil->low[k] = clear_extreme(pupil, points, k, -1, &pupil->ends[k + 2]);
    }
    double *angles = ARENA_ARRAY(arena, directions, double);
    for (size_t i = 0; i < directions; i++) {
        angles[i] = clear_angle(i, directions);
    }
    pupil->edge_count = directions;
    pupil->edges =
        clear_find_edges(&search, angles, directions, ARENA_ARRAY(arena, directions, struct edge));
    pupil->islands = pupil_islands_find(&margins, boundary, arena);
}
