/* camera/film/pupil_outline.c - edges and holes of pupils, found about a ray that passes. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/pupil_outline.h"

#include "base/constants.h"
#include "camera/film/outline_rays.h"
#include "camera/film/outline_search.h"
#include "trace/pupil/pupil_boundary.h"

#include <math.h>
#include <string.h>

/* Edges are searched to a share of what regions are grown by. */
static const double roughly = 1e-4, farthest = 100;

/* -------- holes -------- */

/* Directions towards the corners of the ring, and how far the edge is. */
struct spokes {
    size_t count;
    double angles[FILM_SECTORS + 1];
    struct edge ends[FILM_SECTORS + 1];
};

/* How deep rays at shares of the spokes are within what blocks. */
static void look_at_spokes(const struct outline_rays *sight, const struct spokes *spokes,
                           const double *shares, double *depth)
{
    for (size_t done = 0; done < spokes->count; done += RAYS_BLOCK) {
        const size_t left = spokes->count - done, here = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        double at[RAYS_BLOCK][2];
        size_t parts[RAYS_BLOCK];
        for (size_t i = 0; i < here; i++) {
            const size_t k = done + i;
            double uv[2];
            edge_point(&sight->frame, spokes->angles[k], shares[k] * spokes->ends[k].radius, uv);
            stop_beam_place(&sight->disc, uv[0], uv[1], at[i]);
        }
        probe_depth(&sight->probe, (const double(*)[2])at, here, depth + done, parts);
    }
}

/* Where the dark ends, about as far out as it did; false: somewhere it is not so any more. */
static bool follow_hole(const struct outline_rays *sight, const struct spokes *spokes,
                        double *shares)
{
    enum { HALVES = 8 };
    const double slack = 0.25;
    double dark[FILM_SECTORS + 1], lit[FILM_SECTORS + 1], tried[FILM_SECTORS + 1];
    double depth[FILM_SECTORS + 1], beyond[FILM_SECTORS + 1];
    bool holds = true;
    for (size_t k = 0; k < spokes->count; k++) {
        dark[k] = (1 - slack) * shares[k];
        lit[k] = fmin((1 + slack) * shares[k], 0.999);
    }
    look_at_spokes(sight, spokes, dark, depth);
    look_at_spokes(sight, spokes, lit, beyond);
    for (size_t k = 0; k < spokes->count; k++) {
        holds = holds && depth[k] > 0 && beyond[k] <= 0;
    }
    for (int turn = 0; turn < HALVES && holds; turn++) {
        for (size_t k = 0; k < spokes->count; k++) {
            tried[k] = (dark[k] + lit[k]) / 2;
        }
        look_at_spokes(sight, spokes, tried, depth);
        for (size_t k = 0; k < spokes->count; k++) {
            *(depth[k] > 0 ? &dark[k] : &lit[k]) = tried[k];
        }
    }
    for (size_t k = 0; k < spokes->count && holds; k++) {
        shares[k] = dark[k];
    }
    return holds;
}

/* Where it ends on the way out, wherever that is. */
static void search_hole(const struct outline_rays *sight, const struct spokes *spokes,
                        double *shares)
{
    struct clear_intervals spans[FILM_SECTORS + 1];
    const struct edge_directions directions = {sight->frame, spokes->angles, NULL, spokes->count,
                                               0};
    pupil_boundary_spans(&sight->margins, &sight->probe, &directions, spokes->ends, spans);
    for (size_t k = 0; k < spokes->count; k++) {
        shares[k] = spans[k].count > 0 ? spans[k].low[0] : 1;
    }
}

/* What is dark in the middle, if it is so in all directions. */
static void pupil_outline_find_hole(const struct outline_rays *sight, const double *angles,
                                    const struct edge *edges, struct pupil_outline *outline)
{
    struct spokes spokes = {.count = pupil_outline_sectors(outline) + 1};
    const size_t step = PUPIL_OUTLINE_STEPS / (spokes.count - 1) / outline->each;
    outline->has_hole = outline->asks_hole && sight->probe.full != NULL;
    if (!outline->has_hole) {
        return;
    }
    for (size_t k = 0; k < spokes.count; k++) {
        spokes.angles[k] = angles[step * k];
        spokes.ends[k] = edges[step * k];
    }
    if (!(outline->knows_hole && follow_hole(sight, &spokes, outline->share))) {
        search_hole(sight, &spokes, outline->share);
    }
    for (size_t k = 0; k < spokes.count; k++) {
        double at[2];
        edge_point(&sight->frame, spokes.angles[k], outline->share[k] * spokes.ends[k].radius, at);
        outline->hole[k] = outline_rays_from_disc(sight, at);
        outline->has_hole = outline->has_hole && outline->share[k] > 0;
    }
    outline->knows_hole = outline->has_hole;
}

/* -------- outlines -------- */

/* Half widths of what was found, and its centroid. */
static void pupil_outline_measure(const struct pupil_outline *outline,
                                  struct pupil_outline_point *size,
                                  struct pupil_outline_point *centroid)
{
    struct pupil_outline_point low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    struct pupil_outline_point moment = {0, 0};
    const size_t each = outline->each;
    double area = 0;
    for (size_t i = 0; i <= PUPIL_OUTLINE_STEPS; i += each) {
        const struct pupil_outline_point at = outline->edge[i];
        const struct pupil_outline_point next =
            outline->edge[i < PUPIL_OUTLINE_STEPS ? i + each : i];
        const double x = at.x - outline->centre.x, next_x = next.x - outline->centre.x;
        const double y = at.y - outline->centre.y, next_y = next.y - outline->centre.y;
        const double part = x * next_y - next_x * y;
        low = (struct pupil_outline_point){fmin(low.x, at.x), fmin(low.y, at.y)};
        high = (struct pupil_outline_point){fmax(high.x, at.x), fmax(high.y, at.y)};
        area += part;
        moment.x += part * (x + next_x) / 3;
        moment.y += part * (y + next_y) / 3;
    }
    const bool has_area = area != 0;
    *size = (struct pupil_outline_point){outline->is_half ? high.x : (high.x - low.x) / 2,
                                         (high.y - low.y) / 2};
    *centroid = outline->centre;
    centroid->x += has_area && !outline->is_half ? moment.x / area : 0;
    centroid->y += has_area ? moment.y / area : 0;
}

static struct pupil_outline_point pupil_outline_opposite(struct pupil_outline_point at)
{
    return (struct pupil_outline_point){-at.x, -at.y};
}

struct pupil_outline pupil_outline_turned(const struct pupil_outline *outline)
{
    struct pupil_outline turned = *outline;
    turned.place.x = -outline->place.x;
    turned.place.y = -outline->place.y;
    turned.centre = pupil_outline_opposite(outline->centre);
    for (size_t i = 0; i <= PUPIL_OUTLINE_STEPS; i++) {
        turned.edge[i] = pupil_outline_opposite(
            outline->edge[(i + PUPIL_OUTLINE_STEPS / 2) % PUPIL_OUTLINE_STEPS]);
    }
    for (size_t k = 0; k <= FILM_SECTORS; k++) {
        const size_t other = (k + FILM_SECTORS / 2) % FILM_SECTORS;
        turned.hole[k] = pupil_outline_opposite(outline->hole[other]);
        turned.share[k] = outline->share[other];
    }
    return turned;
}

void pupil_outline_foresee(const struct pupil_outline *last, const struct pupil_outline *before,
                           double share, struct pupil_outline *here)
{
    struct pupil_outline_point ignored, middle, earlier;
    pupil_outline_measure(last, &here->size, &middle);
    here->centre = middle;
    if (before != NULL) {
        pupil_outline_measure(before, &ignored, &earlier);
        here->centre.x += share * (middle.x - earlier.x);
        here->centre.y += share * (middle.y - earlier.y);
    }
}

/* Where to look first: each direction, a half width away or where a neighbour has its edge. */
static void guess_edge(const struct outline_rays *sight, const struct pupil_outline *outline,
                       const struct pupil_outline *near, double *angles, double *radii)
{
    const double all = outline->is_half ? PI : 2 * PI;
    for (size_t k = 0; k <= PUPIL_OUTLINE_STEPS / outline->each; k++) {
        const size_t i = k * outline->each;
        const double angle = all * (double)i / PUPIL_OUTLINE_STEPS;
        struct pupil_outline_point at = {outline->size.x * sin(angle),
                                         outline->size.y * cos(angle)};
        double uv[2];
        if (near != NULL) {
            at = (struct pupil_outline_point){near->edge[i].x - near->centre.x,
                                              near->edge[i].y - near->centre.y};
        }
        at.x += outline->centre.x;
        at.y += outline->centre.y;
        outline_rays_to_disc(sight, at, uv);
        edge_polar(&sight->frame, uv, 0, &angles[k], &radii[k]);
    }
}

/* The edge as seen in a disc; does the disc itself end some of it? */
static bool look_within(const struct outline_rays *sight, const struct pupil_outline *near,
                        struct pupil_outline *outline)
{
    double angles[PUPIL_OUTLINE_STEPS + 1], radii[PUPIL_OUTLINE_STEPS + 1];
    struct edge edges[PUPIL_OUTLINE_STEPS + 1];
    bool fills = false;
    if (near != NULL && near->knows_hole) {
        outline->knows_hole = true;
        memcpy(outline->share, near->share, sizeof near->share);
    }
    guess_edge(sight, outline, near, angles, radii);
    const struct edge_directions directions = {sight->frame, angles, near != NULL ? radii : NULL,
                                               PUPIL_OUTLINE_STEPS / outline->each + 1, 0};
    edges_find(&sight->margins, &directions, roughly, edges);
    for (size_t k = 0; k <= PUPIL_OUTLINE_STEPS / outline->each; k++) {
        double at[2];
        edge_point(&sight->frame, angles[k], edges[k].radius, at);
        outline->edge[k * outline->each] = outline_rays_from_disc(sight, at);
        fills = fills || edges[k].limit == 0; /* the first margin is the disc */
    }
    pupil_outline_find_hole(sight, angles, edges, outline);
    return fills;
}

/*
 * The edge about the centre that the outline has, in a disc of some of its half widths.
 *
 * Given     near  the outline of a neighbour; null: none
 * Result    false: the centre is dark
 */
static bool pupil_outline_look(const struct pupil_outline_search *search, size_t wavelength,
                               const struct pupil_outline *near, struct pupil_outline *outline)
{
    static const double middle[1][2] = {{0, 0}};
    bool fills = true;
    for (double widths = SIGHT_AROUND; fills && widths < farthest; widths *= 2) {
        const struct arena_mark mark = arena_mark(search->arena);
        struct outline_rays sight;
        outline_rays_open(search, wavelength, outline, widths, &sight);
        clearances_look(&sight.margins, middle, 1);
        const bool is_dark = !(sight.margins.excess[0] <= 0);
        fills = !is_dark && look_within(&sight, near, outline);
        arena_reset(search->arena, mark);
        if (is_dark) {
            return false;
        }
    }
    return true;
}

void pupil_outline_find(const struct pupil_outline_search *search, size_t wavelength,
                        const struct pupil_outline *near, struct pupil_outline *outline)
{
    if (near != NULL && pupil_outline_look(search, wavelength, near, outline)) {
        outline->is_empty = false;
        return;
    }
    const bool is_lit = near != NULL ? outline_is_lit(search, wavelength, outline)
                                     : outline_discover(search, wavelength, outline);
    outline->is_empty = !is_lit || !pupil_outline_look(search, wavelength, NULL, outline);
    if (!outline->is_empty) {
        /* seen from its middle, if that is clear */
        const struct pupil_outline first = *outline;
        pupil_outline_measure(&first, &outline->size, &outline->centre);
        if (!pupil_outline_look(search, wavelength, NULL, outline)) {
            *outline = first;
        }
    }
}
