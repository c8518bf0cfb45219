/* trace/star.c - centre, directions and corners of a clear pupil. */
/* SPDX-License-Identifier: MIT */
#include "trace/star.h"

#include "base/constants.h"
#include "trace/parts.h"

#include <math.h>

enum { DIRECTIONS = 32, MORE_DIRECTIONS = 256, EXTRA = 32, ROUNDS = 10, PARTS = 5 };

/* Excesses that count as none; of a sliver a share of how deep its middle is. */
static const double roughly = 1e-7, of_depth = 1e-2, at_corner = 1e-11;

struct search {
    const struct margins *margins;
    const struct probe *probe;
    struct star *star;
    const struct star *before; /* one close by; null: nothing is known */
    double tolerance;          /* of edges that are only compared */
};

/* -------- what ends an edge -------- */

void star_spans(const struct margins *margins, const struct probe *probe,
                const struct edge_directions *directions, const struct edge *edges,
                struct spans *spans)
{
    const struct stop_beam *beam = margins->beam;
    const size_t count = directions->count;
    const double *centre = directions->frame.centre;
    double from[2], ends[RAYS_BLOCK][2], points[RAYS_BLOCK][2];
    stop_beam_place(beam, centre[0], centre[1], from);
    for (size_t i = 0; i < count; i++) {
        spans[i] = spans_whole;
    }
    for (size_t done = 0; done < count && probe->full != NULL; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            edge_point(&directions->frame, directions->angles[done + i], edges[done + i].radius,
                       points[i]);
            stop_beam_place(beam, points[i][0], points[i][1], ends[i]);
        }
        spans_find(probe, from, (const double(*)[2])ends, here, spans + done);
        for (size_t i = 0; i < here; i++) {
            struct spans *clear = &spans[done + i];
            for (size_t k = 0; k < clear->count; k++) {
                clear->low[k] = stop_beam_share(beam, centre, points[i], clear->low[k]);
                clear->high[k] = stop_beam_share(beam, centre, points[i], clear->high[k]);
            }
        }
    }
}

/* Where apertures are listed it counts which piece of one ends an edge, and what is crossed. */
static void tell_parts(const struct search *search, const double *angles, size_t count,
                       struct edge *edges)
{
    const struct margins *margins = search->margins;
    double at[RAYS_BLOCK][2];
    struct clear_edge ends[RAYS_BLOCK];
    struct spans spans[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        const struct edge *edge = &edges[i];
        double point[2];
        edge_point(&search->star->frame, angles[i], edge->radius, point);
        stop_beam_place(margins->beam, point[0], point[1], at[i]);
        bool known = edge->limit < margins->count;
        size_t surface = known ? margins->all[edge->limit].surface : LENS_NONE;
        ends[i] = (struct clear_edge){.status = surface != LENS_NONE ? RAY_CLIPPED : RAY_OK,
                                      .surface = surface != LENS_NONE ? surface + 1 : 0};
    }
    probe_parts(search->probe, (const double(*)[2])at, count, ends);
    const struct edge_directions directions = {search->star->frame, angles, NULL, count, 0};
    star_spans(margins, search->probe, &directions, edges, spans);
    for (size_t i = 0; i < count; i++) {
        size_t *limit = &edges[i].limit;
        *limit = (*limit * 1000003 + ends[i].part) * 1000003 + spans[i].part;
    }
}

/* Edges to compare with each other. */
static void find_limits(const struct search *search, const double *angles, const double *near,
                        size_t count, struct edge *edges)
{
    const struct margins *margins = search->margins;
    const struct edge_directions directions = {search->star->frame, angles, near, count, 0};
    edges_find(margins, &directions, search->tolerance, edges);
    for (size_t done = 0; done < count && margins->is_listed; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        tell_parts(search, angles + done, here, edges + done);
    }
}

/* -------- the centre -------- */

/* A ray that passes; it is the one looked at last. */
static bool find_centre(const struct margins *margins, struct arena *arena, double centre[2])
{
    static const double middle[1][2] = {{0, 0}}, low[2] = {-1.5, -1.5}, high[2] = {1.5, 1.5};
    centre[0] = centre[1] = 0;
    margins_look(margins, middle, 1);
    if (margins->excess[0] <= 0) {
        return true;
    }
    const struct arena_mark mark = arena_mark(arena);
    struct parts *parts = ARENA_NEW(arena, struct parts);
    parts_find(margins, low, high, parts);
    bool found = parts_middle(parts, centre);
    if (!found) {
        parts_find(margins, NULL, NULL, parts);
        found = parts_middle(parts, centre);
    }
    arena_reset(arena, mark);
    if (found) {
        const double at[1][2] = {{centre[0], centre[1]}};
        margins_look(margins, at, 1);
    }
    return found;
}

/* Centroid and widths of what lies within edges in equal directions. */
static void measure(const struct star *star, double centroid[2], double widths[2])
{
    const struct edge_frame *frame = &star->frame;
    double area = 0, moment[2] = {0, 0}, low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < star->count; i++) {
        double at[2], r = star->edges[i].radius;
        edge_point(frame, star->angles[i], r, at);
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

/* The same edges in another frame; false where they are out of order there, or far apart. */
static bool change_frame(struct star *star, const struct edge_frame *frame)
{
    const double widest = 0.45;
    bool sound = true;
    for (size_t i = 0; i < star->count; i++) {
        double point[2], before = i > 0 ? star->angles[i - 1] : star->angles[0];
        edge_point(&star->frame, star->angles[i], star->edges[i].radius, point);
        edge_polar(frame, point, before, &star->angles[i], &star->edges[i].radius);
        double gap = star->angles[i] - before;
        sound = sound && (i == 0 || (gap > 0 && gap < widest));
    }
    double gap = star->angles[0] + 2 * PI - star->angles[star->count - 1];
    star->frame = *frame;
    return sound && gap > 0 && gap < widest;
}

/* About the centroid, stretched as the edge is. Result: false: directions are to be made anew. */
static bool fit_frame(const struct search *search)
{
    struct star *star = search->star;
    struct edge_frame frame = star->frame;
    double centroid[2], widths[2];
    measure(star, centroid, widths);
    if (!(widths[0] > 0 && widths[1] > 0 && isfinite(centroid[0] + centroid[1]))) {
        return true;
    }
    margins_look(search->margins, (const double(*)[2])centroid, 1);
    if (!(search->margins->excess[0] <= 0)) {
        return true;
    }
    for (int k = 0; k < 2; k++) {
        frame.centre[k] = centroid[k];
        frame.stretch[k] = widths[k] / 2;
    }
    return change_frame(star, &frame);
}

/* -------- directions -------- */

/* Are the halves of a star on both sides of u = 0, from where angles count, mirror images? */
static bool is_mirrored(const struct search *search)
{
    return search->margins->is_mirrored && search->star->frame.centre[0] == 0;
}

static void scan(const struct search *search, size_t directions)
{
    struct star *star = search->star;
    double near[MORE_DIRECTIONS];
    star->count = directions;
    for (size_t i = 0; i < star->count; i++) {
        star->angles[i] = 2 * PI * ((double)i + 0.5) / (double)star->count;
        near[i] = search->before != NULL ? star_near(search->before, star->angles[i]) : 0;
    }
    const size_t own = is_mirrored(search) ? directions / 2 : directions;
    find_limits(search, star->angles, search->before != NULL ? near : NULL, own, star->edges);
    for (size_t i = own; i < directions; i++) {
        star->edges[i] = star->edges[directions - 1 - i];
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

/* From a direction to the next one. */
static double gap_of(const struct star *star, size_t i)
{
    bool is_last = i + 1 == star->count;
    return star->angles[is_last ? 0 : i + 1] + (is_last ? 2 * PI : 0) - star->angles[i];
}

/* Directions in between where another margin comes near to 0 without ending an edge. */
static void look_between(const struct search *search)
{
    struct star *star = search->star;
    const struct margins *margins = search->margins;
    double points[DIRECTIONS][2], angles[EXTRA], near[EXTRA];
    struct edge edges[EXTRA];
    size_t extra = 0;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        edge_point(&star->frame, star->angles[i], star->edges[i].radius, points[i]);
    }
    margins_look(margins, (const double(*)[2])points, DIRECTIONS);
    margins_narrow(margins, DIRECTIONS);
    for (size_t k = 0; k < margins->count; k++) {
        const double *row = margins->rows + k * RAYS_BLOCK;
        for (size_t i = 0; i < DIRECTIONS && extra < EXTRA; i++) {
            const size_t last = (i + DIRECTIONS - 1) % DIRECTIONS, next = (i + 1) % DIRECTIONS;
            double where;
            if (star->edges[i].limit != k && star->edges[last].limit != k &&
                star->edges[next].limit != k && may_peak(row[last], row[i], row[next], &where)) {
                near[extra] = star->edges[i].radius;
                angles[extra++] = star->angles[i] + where * gap_of(star, where > 0 ? i : last);
            }
        }
    }
    if (extra == 0) {
        return;
    }
    find_limits(search, angles, near, extra, edges);
    for (size_t i = 0; i < extra; i++) {
        size_t k = star->count++;
        for (; k > 0 && star->angles[k - 1] > angles[i]; k--) {
            star->angles[k] = star->angles[k - 1];
            star->edges[k] = star->edges[k - 1];
        }
        star->angles[k] = angles[i];
        star->edges[k] = edges[i];
    }
}

/* -------- corners -------- */

/* Two directions with a corner between them. */
struct bracket {
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
static bool step_corners(const struct margins *margins, struct bracket *const *brackets,
                         size_t count, double (*at)[2])
{
    static const double h = 1e-6, there = 1e-14;
    double points[RAYS_BLOCK][2];
    bool stands = true;
    for (size_t i = 0; i < 3 * count; i++) {
        points[i][0] = at[i / 3][0] + (i % 3 == 1 ? h : 0);
        points[i][1] = at[i / 3][1] + (i % 3 == 2 ? h : 0);
    }
    margins_look(margins, (const double(*)[2])points, 3 * count);
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

/* Where a corner is looked for first: where one was before, or in the middle. */
static void guess_corner(const struct search *search, const struct bracket *bracket, double at[2])
{
    const double nearby = 0.1; /* rad */
    const struct edge_frame *frame = &search->star->frame;
    const double middle = (bracket->low + bracket->high) / 2;
    edge_point(frame, middle, (bracket->before.radius + bracket->after.radius) / 2, at);
    for (size_t k = 0; search->before != NULL && k < search->before->corner_count; k++) {
        double point[2], angle, radius;
        edge_point(&search->before->frame, search->before->corners[k], search->before->radii[k],
                   point);
        edge_polar(frame, point, middle, &angle, &radius);
        if (angle > bracket->low - nearby && angle < bracket->high + nearby) {
            at[0] = point[0];
            at[1] = point[1];
        }
    }
}

/* Corners of two margins each, all at once; those that lie elsewhere stay as they are. */
static void meet_margins(const struct search *search, struct bracket *const *brackets, size_t count)
{
    enum { STEPS = 7 };
    const struct edge_frame *frame = &search->star->frame;
    const struct margins *margins = search->margins;
    double at[AT_ONCE][2];
    for (size_t i = 0; i < count; i++) {
        guess_corner(search, brackets[i], at[i]);
    }
    for (int step = 0; step < STEPS && !step_corners(margins, brackets, count, at); step++) {
    }
    for (size_t i = 0; i < count; i++) {
        struct bracket *one = brackets[i];
        double a = margins->rows[one->before.limit * RAYS_BLOCK + 3 * i];
        double b = margins->rows[one->after.limit * RAYS_BLOCK + 3 * i];
        edge_polar(frame, at[i], (one->low + one->high) / 2, &one->angle, &one->radius);
        one->is_found = fabs(a) <= at_corner && fabs(b) <= at_corner &&
                        margins->excess[3 * i] <= at_corner && one->angle > one->low - 1e-12 &&
                        one->angle < one->high + 1e-12;
    }
}

/* Brackets that are kept, as far as there is room. */
struct kept {
    struct bracket brackets[STAR_CORNERS];
    size_t count;
};

static void keep(struct kept *kept, const struct bracket *bracket)
{
    if (kept->count < STAR_CORNERS) {
        kept->brackets[kept->count] = *bracket;
    }
    kept->count++;
}

/* The parts of a bracket between whose ends something changes. */
static void keep_parts(const struct bracket *whole, const double *angles, const struct edge *edges,
                       struct kept *kept)
{
    struct bracket part = {.low = whole->low, .before = whole->before};
    for (size_t j = 0; j < PARTS; j++) {
        bool is_last = j == PARTS - 1;
        part.high = is_last ? whole->high : angles[j];
        part.after = is_last ? whole->after : edges[j];
        if (part.before.limit != part.after.limit) {
            keep(kept, &part);
        }
        part.low = part.high;
        part.before = part.after;
    }
}

/* Cut brackets into parts, and keep those between whose ends something changes. */
static size_t cut_brackets(const struct search *search, struct bracket *brackets, size_t count)
{
    double angles[STAR_CORNERS * (PARTS - 1)], near[STAR_CORNERS * (PARTS - 1)];
    struct edge edges[STAR_CORNERS * (PARTS - 1)];
    struct kept kept = {.count = 0};
    size_t asked = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 1; j < PARTS && !brackets[i].is_found; j++) {
            double share = (double)j / PARTS;
            near[asked] = brackets[i].before.radius +
                          share * (brackets[i].after.radius - brackets[i].before.radius);
            angles[asked++] = brackets[i].low + share * (brackets[i].high - brackets[i].low);
        }
    }
    find_limits(search, angles, near, asked, edges);
    asked = 0;
    for (size_t i = 0; i < count; i++) {
        if (brackets[i].is_found) {
            keep(&kept, &brackets[i]);
        } else {
            keep_parts(&brackets[i], angles + asked, edges + asked, &kept);
            asked += PARTS - 1;
        }
    }
    for (size_t i = 0; i < kept.count && i < STAR_CORNERS; i++) {
        brackets[i] = kept.brackets[i];
    }
    return kept.count;
}

/* One round: Newton's method where two margins meet, cuts elsewhere. Are any left to be found? */
static bool narrow(const struct search *search, struct bracket *brackets, size_t *count)
{
    const struct margins *margins = search->margins;
    struct bracket *open[STAR_CORNERS];
    size_t tried = 0, left = 0;
    for (size_t i = 0; i < *count && !margins->is_listed; i++) {
        struct bracket *one = &brackets[i];
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
    return left > 0 && *count <= STAR_CORNERS;
}

static void find_corners(const struct search *search)
{
    struct star *star = search->star;
    struct bracket brackets[STAR_CORNERS];
    const bool is_half = is_mirrored(search);
    const size_t most = is_half ? STAR_CORNERS / 2 : STAR_CORNERS;
    size_t count = 0;
    star->corner_count = 0;
    for (size_t i = 0; i < star->count; i++) {
        const size_t next = (i + 1) % star->count;
        const bool is_other = is_half && !(sin(star->angles[i] + gap_of(star, i) / 2) > 0);
        if (star->edges[i].limit == star->edges[next].limit || is_other) {
            continue;
        }
        if (count == most) {
            return;
        }
        brackets[count++] = (struct bracket){.low = star->angles[i],
                                             .high = star->angles[next] + (next == 0 ? 2 * PI : 0),
                                             .before = star->edges[i],
                                             .after = star->edges[next]};
    }
    for (int round = 0; round < ROUNDS && narrow(search, brackets, &count); round++) {
    }
    if (count > most) {
        return;
    }
    for (size_t k = 0; k < count; k++) {
        const struct bracket *one = &brackets[k];
        star->corners[k] = one->is_found ? one->angle : (one->low + one->high) / 2;
        star->radii[k] = one->is_found ? one->radius : (one->before.radius + one->after.radius) / 2;
    }
    star->corner_count = count;
    if (is_half) {
        star_mirror_corners(star);
    }
}

/* Is one thing all of the edge, and as far on one side of the centre as on the other? */
static bool is_even(const struct margins *margins, const struct star *star)
{
    const double alike = 1e-6;
    const size_t half = star->count / 2;
    bool even = !margins->is_listed && star->count == DIRECTIONS;
    for (size_t i = 0; i < star->count && even; i++) {
        const struct edge *edge = &star->edges[i], *other = &star->edges[(i + half) % star->count];
        even = edge->limit == star->edges[0].limit &&
               fabs(edge->radius - other->radius) < alike * edge->radius;
    }
    return even;
}

/* Does nothing but the stop or the disc end it? */
static bool is_whole(const struct margins *margins, const struct star *star)
{
    const size_t first = star->edges[0].limit;
    bool whole = first < margins->count && !margins->is_listed && star->frame.centre[0] == 0 &&
                 star->frame.centre[1] == 0;
    for (size_t i = 0; i < star->count; i++) {
        whole = whole && star->edges[i].limit == first;
    }
    return whole && (margins->all[first].surface == LENS_NONE ||
                     margins->all[first].surface == margins->system->stop);
}

/* Is it much wider in one direction than in the other, as its frame sees it? */
static bool is_long(const struct star *star)
{
    double shortest = INFINITY, longest = 0;
    for (size_t i = 0; i < star->count; i++) {
        shortest = fmin(shortest, star->edges[i].radius);
        longest = fmax(longest, star->edges[i].radius);
    }
    return longest > 2 * shortest;
}

/* Do rays end some of the edge that miss a surface or are reflected? No margin says where. */
static bool loses(const struct star *star)
{
    bool some = false;
    for (size_t i = 0; i < star->count; i++) {
        some = some || margins_lost(star->edges[i].limit);
    }
    return some;
}

/* An excess that says enough of where an edge is, about the ray looked at last, the centre. */
static double choose_tolerance(const struct margins *margins)
{
    return margins->is_listed ? 1e-12 : fmin(roughly, of_depth * -margins->excess[0]);
}

/* What a frame that fits, and edges in it, do not say yet. */
static void finish(const struct search *search)
{
    const struct margins *margins = search->margins;
    struct star *star = search->star;
    star->is_plain = !margins->is_listed && !loses(star);
    if (star->is_plain) {
        look_between(search);
    } else if (!margins->is_listed) {
        scan(search, MORE_DIRECTIONS);
    }
    star->is_whole = is_whole(margins, star) || is_even(margins, star);
    find_corners(search);
    star_join(star);
}

bool star_find(const struct margins *margins, const struct probe *probe, struct arena *arena,
               struct star *star)
{
    enum { FITS = 12 };
    struct search search = {margins, probe, star, NULL, 0};
    star->frame = (struct edge_frame){.stretch = {1, 1}};
    star->count = 0;
    star->corner_count = 0;
    margins_widen(margins);
    if (!find_centre(margins, arena, star->frame.centre)) {
        return false;
    }
    for (int fit = 0;; fit++) {
        search.tolerance = choose_tolerance(margins);
        scan(&search, margins->is_listed ? MORE_DIRECTIONS : DIRECTIONS);
        bool fits = (is_whole(margins, star) || is_even(margins, star)) && !is_long(star);
        if (fits || margins->is_listed || fit == FITS || fit_frame(&search)) {
            break;
        }
    }
    finish(&search);
    return true;
}

bool star_follow(const struct margins *margins, const struct probe *probe,
                 const struct star *before, struct star *star)
{
    struct search search = {margins, probe, star, before, 0};
    if (margins->is_listed || before->count == 0 || !before->is_plain) {
        return false;
    }
    star->frame = before->frame;
    star->corner_count = 0;
    margins_widen(margins);
    margins_look(margins, (const double(*)[2])star->frame.centre, 1);
    search.tolerance = choose_tolerance(margins);
    if (!(margins->excess[0] <= 0)) {
        return false;
    }
    scan(&search, DIRECTIONS);
    const bool fits = is_whole(margins, star) || is_even(margins, star);
    if (loses(star) || is_long(star) || (!fits && !fit_frame(&search))) {
        return false;
    }
    finish(&search);
    return star->corner_count == before->corner_count && star->is_whole == before->is_whole;
}
