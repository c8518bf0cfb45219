/* trace/pupil/pupil_boundary.c - centre, directions and corners of a clear pupil. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/pupil_boundary_search.h"

#include "base/constants.h"
#include "trace/pupil/pupil_parts.h"

#include <math.h>

enum { DIRECTIONS = 32, MORE_DIRECTIONS = 256, EXTRA = 32 };

/* Excesses that count as none; of a sliver a share of how deep its middle is. */
static const double roughly = 1e-7, of_depth = 1e-2;

/* -------- the centre -------- */

/* A ray that passes; it is the one looked at last. */
static bool find_centre(const struct clearances *margins, struct arena *arena, double centre[2])
{
    static const double middle[1][2] = {{0, 0}}, low[2] = {-1.5, -1.5}, high[2] = {1.5, 1.5};
    centre[0] = centre[1] = 0;
    clearances_look(margins, middle, 1);
    if (margins->excess[0] <= 0) {
        return true;
    }
    const struct arena_mark mark = arena_mark(arena);
    struct pupil_parts *parts = ARENA_NEW(arena, struct pupil_parts);
    pupil_parts_find(margins, low, high, parts);
    bool found = pupil_parts_middle(parts, centre);
    if (!found) {
        pupil_parts_find(margins, NULL, NULL, parts);
        found = pupil_parts_middle(parts, centre);
    }
    arena_reset(arena, mark);
    if (found) {
        const double at[1][2] = {{centre[0], centre[1]}};
        clearances_look(margins, at, 1);
    }
    return found;
}

/* Centroid and widths of what lies within edges in equal directions. */
static void pupil_boundary_measure(const struct pupil_boundary *boundary, double centroid[2],
                                   double widths[2])
{
    const struct edge_frame *frame = &boundary->frame;
    double area = 0, moment[2] = {0, 0}, low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < boundary->count; i++) {
        double at[2], r = boundary->edges[i].radius;
        edge_point(frame, boundary->angles[i], r, at);
        area += r * r / 2;
        for (int k = 0; k < 2; k++) {
            moment[k] += r * r / 3 * (at[k] - frame->centre[k]);
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        widths[k] = high[k] - low[k];
        centroid[k] = frame->centre[k] + moment[k] / area;
        /* what symmetry makes 0 */
        centroid[k] = fabs(centroid[k]) < 1e-6 * widths[k] ? 0 : centroid[k];
    }
}

/* About the centroid, stretched as the edge is. Result: false: directions are to be made anew. */
static bool fit_frame(const struct pupil_boundary_search *search)
{
    struct pupil_boundary *boundary = search->boundary;
    struct edge_frame frame = boundary->frame;
    double centroid[2], widths[2];
    pupil_boundary_measure(boundary, centroid, widths);
    if (!(widths[0] > 0 && widths[1] > 0 && isfinite(centroid[0] + centroid[1]))) {
        return true;
    }
    clearances_look(search->margins, (const double(*)[2])centroid, 1);
    if (!(search->margins->excess[0] <= 0)) {
        return true;
    }
    for (int k = 0; k < 2; k++) {
        frame.centre[k] = centroid[k];
        frame.stretch[k] = widths[k] / 2;
    }
    /* the same edges in another frame, where they may be out of order, or far apart */
    const double widest = 0.45;
    bool sound = true;
    for (size_t i = 0; i < boundary->count; i++) {
        double point[2], before = i > 0 ? boundary->angles[i - 1] : boundary->angles[0];
        edge_point(&boundary->frame, boundary->angles[i], boundary->edges[i].radius, point);
        edge_polar(&frame, point, before, &boundary->angles[i], &boundary->edges[i].radius);
        double gap = boundary->angles[i] - before;
        sound = sound && (i == 0 || (gap > 0 && gap < widest));
    }
    double gap = boundary->angles[0] + 2 * PI - boundary->angles[boundary->count - 1];
    boundary->frame = frame;
    return sound && gap > 0 && gap < widest;
}

/* -------- directions -------- */

static void pupil_boundary_scan(const struct pupil_boundary_search *search, size_t directions)
{
    struct pupil_boundary *boundary = search->boundary;
    double near[MORE_DIRECTIONS];
    boundary->count = directions;
    for (size_t i = 0; i < boundary->count; i++) {
        boundary->angles[i] = 2 * PI * ((double)i + 0.5) / (double)boundary->count;
        near[i] =
            search->before != NULL ? pupil_boundary_near(search->before, boundary->angles[i]) : 0;
    }
    const size_t own = pupil_boundary_is_mirrored(search) ? directions / 2 : directions;
    pupil_boundary_limits_find(search, boundary->angles, search->before != NULL ? near : NULL, own,
                               boundary->edges);
    for (size_t i = own; i < directions; i++) {
        boundary->edges[i] = boundary->edges[directions - 1 - i];
    }
}

/* A piece of the edge that may be hidden between directions: its excess peaks about here. */
static bool may_peak(double before, double here, double after, double *where)
{
    double bend = before - 2 * here + after, slope = (after - before) / 2;
    if (!(here > before + 1e-6 && here >= after && bend < 0)) {
        return false;
    }
    *where = -slope / bend;
    return here - slope * slope / (2 * bend) > -0.03;
}

/* Directions in between where another margin comes near to 0 without ending an edge. */
static void pupil_boundary_scan_between(const struct pupil_boundary_search *search)
{
    struct pupil_boundary *boundary = search->boundary;
    const struct clearances *margins = search->margins;
    double points[DIRECTIONS][2], angles[EXTRA], near[EXTRA];
    struct edge edges[EXTRA];
    size_t extra = 0;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        edge_point(&boundary->frame, boundary->angles[i], boundary->edges[i].radius, points[i]);
    }
    clearances_look(margins, (const double(*)[2])points, DIRECTIONS);
    clearances_narrow(margins, DIRECTIONS);
    for (size_t k = 0; k < margins->count; k++) {
        const double *row = margins->rows + k * RAYS_BLOCK;
        for (size_t i = 0; i < DIRECTIONS && extra < EXTRA; i++) {
            const size_t last = (i + DIRECTIONS - 1) % DIRECTIONS, next = (i + 1) % DIRECTIONS;
            double where;
            if (boundary->edges[i].limit != k && boundary->edges[last].limit != k &&
                boundary->edges[next].limit != k &&
                may_peak(row[last], row[i], row[next], &where)) {
                near[extra] = boundary->edges[i].radius;
                angles[extra++] = boundary->angles[i] +
                                  where * pupil_boundary_gap(boundary, where > 0 ? i : last);
            }
        }
    }
    if (extra == 0) {
        return;
    }
    pupil_boundary_limits_find(search, angles, near, extra, edges);
    for (size_t i = 0; i < extra; i++) {
        pupil_boundary_enter(boundary, angles[i], &edges[i]);
    }
}

/* -------- all of it -------- */

/* Is one thing all of the edge, and as far on one side of the centre as on the other? */
static bool pupil_boundary_is_even(const struct clearances *margins,
                                   const struct pupil_boundary *boundary)
{
    const double alike = 1e-6;
    const size_t half = boundary->count / 2;
    bool even = !margins->is_listed && boundary->count == DIRECTIONS;
    for (size_t i = 0; i < boundary->count && even; i++) {
        const struct edge *edge = &boundary->edges[i],
                          *other = &boundary->edges[(i + half) % boundary->count];
        even = edge->limit == boundary->edges[0].limit &&
               fabs(edge->radius - other->radius) < alike * edge->radius;
    }
    return even;
}

/* Does nothing but the stop or the disc end it? */
static bool pupil_boundary_is_whole(const struct clearances *margins,
                                    const struct pupil_boundary *boundary)
{
    const size_t first = boundary->edges[0].limit;
    bool whole = first < margins->count && !margins->is_listed && boundary->frame.centre[0] == 0 &&
                 boundary->frame.centre[1] == 0;
    for (size_t i = 0; i < boundary->count; i++) {
        whole = whole && boundary->edges[i].limit == first;
    }
    return whole && (margins->all[first].surface == LENS_NONE ||
                     margins->all[first].surface == margins->system->stop);
}

/* Is it much wider in one direction than in the other, as its frame sees it? */
static bool is_long(const struct pupil_boundary *boundary)
{
    double shortest = INFINITY, longest = 0;
    for (size_t i = 0; i < boundary->count; i++) {
        shortest = fmin(shortest, boundary->edges[i].radius);
        longest = fmax(longest, boundary->edges[i].radius);
    }
    return longest > 2 * shortest;
}

/* Do rays end some of the edge that miss a surface or are reflected? No margin says where. */
static bool loses_rays(const struct pupil_boundary *boundary)
{
    bool some = false;
    for (size_t i = 0; i < boundary->count; i++) {
        some = some || clearances_lost(boundary->edges[i].limit);
    }
    return some;
}

/* An excess that says enough of where an edge is, about the ray looked at last, the centre. */
static double choose_tolerance(const struct clearances *margins)
{
    return margins->is_listed ? 1e-12 : fmin(roughly, of_depth * -margins->excess[0]);
}

/* What a frame that fits, and edges in it, do not say yet. */
static void pupil_boundary_finish(const struct pupil_boundary_search *search)
{
    const struct clearances *margins = search->margins;
    struct pupil_boundary *boundary = search->boundary;
    boundary->is_plain = !margins->is_listed && !loses_rays(boundary);
    if (boundary->is_plain) {
        pupil_boundary_scan_between(search);
    } else if (!margins->is_listed) {
        pupil_boundary_scan(search, MORE_DIRECTIONS);
    }
    boundary->tolerance = search->tolerance;
    boundary->is_whole =
        pupil_boundary_is_whole(margins, boundary) || pupil_boundary_is_even(margins, boundary);
    pupil_boundary_corners_find(search);
    pupil_boundary_join(boundary);
}

bool pupil_boundary_find(const struct clearances *margins, struct arena *arena,
                         struct pupil_boundary *boundary)
{
    enum { FITS = 12 };
    struct pupil_boundary_search search = {margins, boundary, NULL, 0};
    boundary->frame = (struct edge_frame){.stretch = {1, 1}};
    boundary->count = 0;
    boundary->corner_count = 0;
    clearances_widen(margins);
    if (!find_centre(margins, arena, boundary->frame.centre)) {
        return false;
    }
    for (int fit = 0;; fit++) {
        search.tolerance = choose_tolerance(margins);
        pupil_boundary_scan(&search, margins->is_listed ? MORE_DIRECTIONS : DIRECTIONS);
        bool fits = (pupil_boundary_is_whole(margins, boundary) ||
                     pupil_boundary_is_even(margins, boundary)) &&
                    !is_long(boundary);
        if (fits || margins->is_listed || fit == FITS || fit_frame(&search)) {
            break;
        }
    }
    pupil_boundary_finish(&search);
    return true;
}

bool pupil_boundary_follow(const struct clearances *margins, const struct pupil_boundary *before,
                           struct pupil_boundary *boundary)
{
    struct pupil_boundary_search search = {margins, boundary, before, 0};
    if (margins->is_listed || before->count == 0 || !before->is_plain) {
        return false;
    }
    boundary->frame = before->frame;
    boundary->corner_count = 0;
    clearances_widen(margins);
    clearances_look(margins, (const double(*)[2])boundary->frame.centre, 1);
    search.tolerance = choose_tolerance(margins);
    if (!(margins->excess[0] <= 0)) {
        return false;
    }
    pupil_boundary_scan(&search, DIRECTIONS);
    const bool fits =
        pupil_boundary_is_whole(margins, boundary) || pupil_boundary_is_even(margins, boundary);
    if (loses_rays(boundary) || is_long(boundary) || (!fits && !fit_frame(&search))) {
        return false;
    }
    pupil_boundary_finish(&search);
    return boundary->corner_count == before->corner_count && boundary->is_whole == before->is_whole;
}
