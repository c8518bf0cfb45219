/* trace/pupil/pupil_boundary_edges.c - the edge of a boundary: what ends it, and its corners. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "trace/pupil/pupil_boundary_search.h"

#include <math.h>
#include <string.h>

/* -------- between directions -------- */

/* Enter a corner in its place. */
static void boundary_enter_corner(struct pupil_boundary *boundary, double angle, double radius)
{
    size_t k = boundary->corner_count++;
    for (; k > 0 && boundary->corners[k - 1] > angle; k--) {
        boundary->corners[k] = boundary->corners[k - 1];
        boundary->radii[k] = boundary->radii[k - 1];
    }
    boundary->corners[k] = angle;
    boundary->radii[k] = radius;
}

void pupil_boundary_join(struct pupil_boundary *boundary)
{
    size_t i = 0, k = 0, count = 0;
    while (i < boundary->count || k < boundary->corner_count) {
        const bool is_edge = k == boundary->corner_count ||
                             (i < boundary->count && boundary->angles[i] <= boundary->corners[k]);
        boundary->knots[count] = is_edge ? boundary->angles[i] : boundary->corners[k];
        boundary->knot_radii[count++] =
            is_edge ? boundary->edges[i++].radius : boundary->radii[k++];
    }
    boundary->knot_count = count;
}

double pupil_boundary_near(const struct pupil_boundary *boundary, double angle)
{
    const size_t count = boundary->knot_count;
    const double turns = (angle - boundary->knots[0]) * (1 / (2 * PI));
    const double whole = (double)(long)turns, part = turns - whole + (turns < whole ? 1 : 0);
    const double at = boundary->knots[0] + 2 * PI * part;
    /* they lie about as far from each other everywhere */
    size_t i = (size_t)(part * (double)count);
    i = i < count ? i : count - 1;
    while (i > 0 && boundary->knots[i] > at) {
        i--;
    }
    while (i + 1 < count && boundary->knots[i + 1] <= at) {
        i++;
    }
    const size_t next = i + 1 < count ? i + 1 : 0;
    const double above = boundary->knots[next] + (next == 0 ? 2 * PI : 0),
                 below = boundary->knots[i];
    const double share = above > below ? (at - below) / (above - below) : 0;
    return boundary->knot_radii[i] + (boundary->knot_radii[next] - boundary->knot_radii[i]) * share;
}

void pupil_boundary_edges(const struct clearances *margins, const struct pupil_boundary *boundary,
                          const double *angles, size_t count, struct arena *arena,
                          struct edge *edges)
{
    const struct arena_mark mark = arena_mark(arena);
    double *near = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        near[i] = pupil_boundary_near(boundary, angles[i]);
    }
    edges_find(margins, &boundary->frame, angles, near, count, 0, PUPIL_BOUNDARY_ROUNDING, edges);
    arena_reset(arena, mark);
}

/* -------- what ends an edge -------- */

void pupil_boundary_intervals(const struct clearances *margins, const struct edge_frame *frame,
                              const double *angles, size_t count, const struct edge *edges,
                              struct clear_intervals *intervals)
{
    const struct stop_beam *beam = margins->beam;
    const double *centre = frame->centre;
    double from[2], ends[RAYS_BLOCK][2], points[RAYS_BLOCK][2];
    stop_beam_place(beam, centre[0], centre[1], from);
    for (size_t i = 0; i < count; i++) {
        intervals[i] = clear_intervals_whole;
    }
    for (size_t done = 0; done < count && margins->full != NULL; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            edge_point(frame, angles[done + i], edges[done + i].radius, points[i]);
            stop_beam_place(beam, points[i][0], points[i][1], ends[i]);
        }
        clear_intervals_find(margins, from, (const double(*)[2])ends, here, intervals + done);
        for (size_t i = 0; i < here; i++) {
            struct clear_intervals *clear = &intervals[done + i];
            for (size_t k = 0; k < clear->count; k++) {
                clear->low[k] = stop_beam_share(beam, centre, points[i], clear->low[k]);
                clear->high[k] = stop_beam_share(beam, centre, points[i], clear->high[k]);
            }
        }
    }
}

/* Where apertures are listed it counts which piece of one ends an edge, and what is crossed. */
static void boundary_tell_parts(const struct pupil_boundary_search *search, const double *angles,
                                size_t count, struct edge *edges)
{
    const struct clearances *margins = search->margins;
    double at[RAYS_BLOCK][2];
    size_t surfaces[RAYS_BLOCK], parts[RAYS_BLOCK];
    struct clear_intervals intervals[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        double point[2];
        edge_point(&search->boundary->frame, angles[i], edges[i].radius, point);
        stop_beam_place(margins->beam, point[0], point[1], at[i]);
        const bool known = edges[i].limit < margins->count;
        surfaces[i] = known ? margins->all[edges[i].limit].surface : LENS_NONE;
    }
    clearances_parts(margins, (const double(*)[2])at, count, surfaces, parts);
    pupil_boundary_intervals(margins, &search->boundary->frame, angles, count, edges, intervals);
    for (size_t i = 0; i < count; i++) {
        size_t *limit = &edges[i].limit;
        *limit = (*limit * 1000003 + parts[i]) * 1000003 + intervals[i].part;
    }
}

void pupil_boundary_limits_find(const struct pupil_boundary_search *search, const double *angles,
                                const double *near, size_t count, struct edge *edges)
{
    const struct clearances *margins = search->margins;
    edges_find(margins, &search->boundary->frame, angles, near, count, 0, search->tolerance, edges);
    for (size_t done = 0; done < count && margins->is_listed; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        boundary_tell_parts(search, angles + done, here, edges + done);
    }
}

/* -------- corners -------- */

enum { ROUNDS = 10, PARTS = 5 };

/* An excess that counts as none at a corner; one that rounding alone does not make. */
static const double at_corner = 1e-11, clearly = 1e-9;

double pupil_boundary_gap(const struct pupil_boundary *boundary, size_t i)
{
    if (i + 1 == boundary->count) {
        return boundary->angles[0] + 2 * PI - boundary->angles[i];
    }
    return boundary->angles[i + 1] - boundary->angles[i];
}

void pupil_boundary_enter(struct pupil_boundary *boundary, double angle, const struct edge *edge)
{
    size_t k = boundary->count++;
    for (; k > 0 && boundary->angles[k - 1] > angle; k--) {
        boundary->angles[k] = boundary->angles[k - 1];
        boundary->edges[k] = boundary->edges[k - 1];
    }
    boundary->angles[k] = angle;
    boundary->edges[k] = *edge;
}

/* Two directions with a corner between them. */
struct corner_bracket {
    double low, high;
    struct edge before, after;
    double angle, radius; /* of the corner, once it is found */
    bool is_found;
};

enum { AT_ONCE = RAYS_BLOCK / 3 };

/*
 * One step of Newton's method towards the points where two excesses are 0. Result: they are there;
 * what is asked of the margins stands in every third lane.
 */
static bool step_corners(const struct clearances *margins, struct corner_bracket *const *brackets,
                         size_t count, double (*at)[2])
{
    static const double h = 1e-6, there = 1e-14;
    double points[RAYS_BLOCK][2];
    bool stands = true;
    for (size_t i = 0; i < 3 * count; i++) {
        points[i][0] = at[i / 3][0] + (i % 3 == 1 ? h : 0);
        points[i][1] = at[i / 3][1] + (i % 3 == 2 ? h : 0);
    }
    clearances_look(margins, (const double(*)[2])points, 3 * count);
    for (size_t i = 0; i < count; i++) {
        const double *a = margins->rows + brackets[i]->before.limit * RAYS_BLOCK + 3 * i;
        const double *b = margins->rows + brackets[i]->after.limit * RAYS_BLOCK + 3 * i;
        stands = stands && fabs(a[0]) <= there && fabs(b[0]) <= there;
    }
    for (size_t i = 0; i < count && !stands; i++) {
        const double *a = margins->rows + brackets[i]->before.limit * RAYS_BLOCK + 3 * i;
        const double *b = margins->rows + brackets[i]->after.limit * RAYS_BLOCK + 3 * i;
        double au = a[1] - a[0], av = a[2] - a[0], bu = b[1] - b[0], bv = b[2] - b[0];
        double scale = h / (au * bv - av * bu);
        at[i][0] -= (bv * a[0] - av * b[0]) * scale;
        at[i][1] -= (au * b[0] - bu * a[0]) * scale;
    }
    return stands;
}

/* Corners of two margins each, all at once; those that lie elsewhere stay as they are. */
static void meet_margins(const struct pupil_boundary_search *search,
                         struct corner_bracket *const *brackets, size_t count)
{
    enum { STEPS = 7 };
    const struct edge_frame *frame = &search->boundary->frame;
    const struct clearances *margins = search->margins;
    double at[AT_ONCE][2];
    for (size_t i = 0; i < count; i++) {
        /* where a corner is looked for first: where one was before, or in the middle */
        const struct corner_bracket *bracket = brackets[i];
        const double nearby = 0.1; /* rad */
        const double middle = (bracket->low + bracket->high) / 2;
        edge_point(frame, middle, (bracket->before.radius + bracket->after.radius) / 2, at[i]);
        for (size_t k = 0; search->before != NULL && k < search->before->corner_count; k++) {
            double point[2], angle, radius;
            edge_point(&search->before->frame, search->before->corners[k], search->before->radii[k],
                       point);
            edge_polar(frame, point, middle, &angle, &radius);
            if (angle > bracket->low - nearby && angle < bracket->high + nearby) {
                at[i][0] = point[0];
                at[i][1] = point[1];
            }
        }
    }
    for (int step = 0; step < STEPS && !step_corners(margins, brackets, count, at); step++) {
    }
    for (size_t i = 0; i < count; i++) {
        struct corner_bracket *one = brackets[i];
        double a = margins->rows[one->before.limit * RAYS_BLOCK + 3 * i];
        double b = margins->rows[one->after.limit * RAYS_BLOCK + 3 * i];
        edge_polar(frame, at[i], (one->low + one->high) / 2, &one->angle, &one->radius);
        one->is_found = fabs(a) <= at_corner && fabs(b) <= at_corner &&
                        margins->excess[3 * i] <= at_corner && one->angle > one->low - 1e-12 &&
                        one->angle < one->high + 1e-12;
    }
}

/* Cut brackets into parts, and keep those between whose ends something changes. */
static size_t cut_brackets(const struct pupil_boundary_search *search,
                           struct corner_bracket *brackets, size_t count)
{
    enum { MOST = PARTS * PUPIL_BOUNDARY_CORNERS };
    double angles[MOST], near[MOST];
    struct edge edges[MOST];
    struct corner_bracket kept[MOST];
    size_t asked = 0, left = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 1; j < PARTS && !brackets[i].is_found; j++) {
            double share = (double)j / PARTS;
            near[asked] = brackets[i].before.radius +
                          share * (brackets[i].after.radius - brackets[i].before.radius);
            angles[asked++] = brackets[i].low + share * (brackets[i].high - brackets[i].low);
        }
    }
    pupil_boundary_limits_find(search, angles, near, asked, edges);
    asked = 0;
    for (size_t i = 0; i < count; i++) {
        struct corner_bracket part = brackets[i];
        if (part.is_found) {
            kept[left++] = part;
            continue;
        }
        for (size_t j = 0; j < PARTS; j++) {
            const bool is_last = j == PARTS - 1;
            part.high = is_last ? brackets[i].high : angles[asked];
            part.after = is_last ? brackets[i].after : edges[asked];
            asked += is_last ? 0 : 1;
            if (part.before.limit != part.after.limit) {
                kept[left++] = part;
            }
            part.low = part.high;
            part.before = part.after;
        }
    }
    for (size_t i = 0; i < left && i < PUPIL_BOUNDARY_CORNERS; i++) {
        brackets[i] = kept[i];
    }
    return left;
}

/* One round: Newton's method where two margins meet, cuts elsewhere. Are any left to be found? */
static bool corners_narrow(const struct pupil_boundary_search *search,
                           struct corner_bracket *brackets, size_t *count)
{
    const struct clearances *margins = search->margins;
    struct corner_bracket *open[PUPIL_BOUNDARY_CORNERS];
    size_t tried = 0, left = 0;
    for (size_t i = 0; i < *count && !margins->is_listed; i++) {
        struct corner_bracket *one = &brackets[i];
        if (!one->is_found && one->before.limit < margins->count &&
            one->after.limit < margins->count) {
            open[tried++] = one;
        }
    }
    for (size_t done = 0; done < tried; done += AT_ONCE) {
        meet_margins(search, open + done, tried - done < AT_ONCE ? tried - done : AT_ONCE);
    }
    for (size_t i = 0; i < *count; i++) {
        left += !brackets[i].is_found;
    }
    if (left > 0) {
        *count = cut_brackets(search, brackets, *count);
    }
    return left > 0 && *count <= PUPIL_BOUNDARY_CORNERS;
}

void pupil_boundary_corners_find(const struct pupil_boundary_search *search)
{
    struct pupil_boundary *boundary = search->boundary;
    struct corner_bracket brackets[PUPIL_BOUNDARY_CORNERS];
    const bool is_half = pupil_boundary_is_mirrored(search);
    const size_t most = is_half ? PUPIL_BOUNDARY_CORNERS / 2 : PUPIL_BOUNDARY_CORNERS;
    size_t count = 0;
    boundary->corner_count = 0;
    for (size_t i = 0; i < boundary->count; i++) {
        const size_t next = (i + 1) % boundary->count;
        const bool is_other =
            is_half && !(sin(boundary->angles[i] + pupil_boundary_gap(boundary, i) / 2) > 0);
        if (boundary->edges[i].limit == boundary->edges[next].limit || is_other) {
            continue;
        }
        if (count == most) {
            return;
        }
        brackets[count++] =
            (struct corner_bracket){.low = boundary->angles[i],
                                    .high = boundary->angles[next] + (next == 0 ? 2 * PI : 0),
                                    .before = boundary->edges[i],
                                    .after = boundary->edges[next]};
    }
    for (int round = 0; round < ROUNDS && corners_narrow(search, brackets, &count); round++) {
    }
    if (count > most) {
        return;
    }
    for (size_t k = 0; k < count; k++) {
        const struct corner_bracket *one = &brackets[k];
        boundary->corners[k] = one->is_found ? one->angle : (one->low + one->high) / 2;
        boundary->radii[k] =
            one->is_found ? one->radius : (one->before.radius + one->after.radius) / 2;
    }
    boundary->corner_count = count;
    if (is_half) {
        /* corners on one side of u = 0, with those on the other that mirror them */
        double angles[PUPIL_BOUNDARY_CORNERS], radii[PUPIL_BOUNDARY_CORNERS];
        const size_t half = boundary->corner_count;
        memcpy(angles, boundary->corners, half * sizeof *angles);
        memcpy(radii, boundary->radii, half * sizeof *radii);
        boundary->corner_count = 0;
        for (size_t i = 0; i < half; i++) {
            const double angle = angles[i] - 2 * PI * floor(angles[i] / (2 * PI));
            boundary_enter_corner(boundary, angle, radii[i]);
            boundary_enter_corner(boundary, 2 * PI - angle, radii[i]);
        }
    }
}

/* -------- corners that others show -------- */

/* How many corners lie between a direction and the next. */
static size_t corners_behind(const struct pupil_boundary *boundary, size_t k)
{
    size_t count = 0;
    for (size_t i = 0; i < boundary->corner_count; i++) {
        const double turns = floor((boundary->corners[i] - boundary->angles[k]) / (2 * PI));
        count += boundary->corners[i] - 2 * PI * turns <
                 boundary->angles[k] + pupil_boundary_gap(boundary, k);
    }
    return count;
}

/*
 * Does an edge behind the k-th direction end at what is not known there? Pieces between
 * corners may have no direction; what ends those beside it must be clearly less, not by rounding.
 */
static bool is_news(const struct clearances *margins, const struct pupil_boundary *boundary,
                    size_t k, double angle, const struct edge *edge)
{
    const size_t limit = boundary->edges[k].limit,
                 other = boundary->edges[(k + 1) % boundary->count].limit;
    double point[1][2];
    if (edge->limit == limit || edge->limit == other || corners_behind(boundary, k) > 1) {
        return false;
    }
    edge_point(&boundary->frame, angle, edge->radius, point[0]);
    clearances_look(margins, (const double(*)[2])point, 1);
    return limit >= margins->count || margins->rows[limit * RAYS_BLOCK] < -clearly;
}

bool pupil_boundary_learn(const struct clearances *margins, const double *angles, size_t count,
                          const struct edge *edges, struct pupil_boundary *boundary)
{
    const size_t known = boundary->count;
    struct pupil_boundary before;
    size_t k = 0; /* the direction before the edge: edges ascend but for one step back */
    for (size_t i = 0; i < count && !margins->is_listed; i++) {
        double angle = angles[i];
        angle += angle < boundary->angles[0] ? 2 * PI : 0;
        angle -= angle >= boundary->angles[0] + 2 * PI ? 2 * PI : 0;
        k = boundary->angles[k] > angle ? 0 : k;
        while (k + 1 < boundary->count && boundary->angles[k + 1] <= angle) {
            k++;
        }
        if (boundary->count == PUPIL_BOUNDARY_DIRECTIONS ||
            !is_news(margins, boundary, k, angle, &edges[i])) {
            continue;
        }
        if (boundary->count == known) {
            before = *boundary;
        }
        pupil_boundary_enter(boundary, angle, &edges[i]);
    }
    if (boundary->count == known) {
        return false;
    }
    const struct pupil_boundary_search search = {margins, boundary, NULL, boundary->tolerance};
    pupil_boundary_corners_find(&search);
    boundary->is_whole = false;
    pupil_boundary_join(boundary);
    const bool is_better = boundary->corner_count > before.corner_count;
    if (!is_better) {
        *boundary = before;
    }
    return is_better;
}
