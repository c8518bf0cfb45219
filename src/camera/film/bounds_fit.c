/* camera/film/bounds_fit.c - sectors of polygons, moved out by the points that lie beyond them. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/bounds_fit.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

static const double grown = 1.003, shrunk = 0.985;

/* What is stretched, by an outline: polygons and their centres, at the rows of a place. */
struct fit {
    const struct exit_pupil_bounds *region;
    const struct film_place *place;
    double *const *corners;
    double *const *centres;
    const struct film_nodes *nodes;
    struct pupil_outline_point centre; /* of them all */
    size_t sectors;
    bool is_half, is_hole;
};

/* The corner between the rows, as seen from the centre between them. */
static struct pupil_outline_point corner_of(const struct fit *fit, size_t k)
{
    const size_t corner = fit->is_half ? k : k % FILM_SECTORS;
    struct pupil_outline_point sum = {0, 0};
    for (size_t n = 0; n < fit->nodes->count; n++) {
        const size_t i = fit->nodes->of[n] * FILM_CORNERS + corner;
        sum.x += fit->corners[0][i];
        sum.y += fit->corners[1][i];
    }
    const double share = 1 / (double)fit->nodes->count;
    return (struct pupil_outline_point){share * sum.x - fit->centre.x,
                                        share * sum.y - fit->centre.y};
}

static void bounds_fit_stretch(const struct fit *fit, size_t node, size_t corner, double by)
{
    for (int k = 0; k < 2; k++) {
        const double centre = fit->centres[k][node];
        double *place = &fit->corners[k][node * FILM_CORNERS + corner];
        *place = centre + (*place - centre) * by;
    }
}

/*
 * How far out a point is, in a sector from a centre whose other corners are a and b: 1 on the line
 * through them; NaN outside of the sector.
 */
static double depth_in(struct pupil_outline_point at, struct pupil_outline_point a,
                       struct pupil_outline_point b)
{
    const double whole = a.x * b.y - a.y * b.x;
    const double of_a = (at.x * b.y - at.y * b.x) / whole;
    const double of_b = (a.x * at.y - a.y * at.x) / whole;
    return of_a > -1e-9 && of_b > -1e-9 ? of_a + of_b : (double)NAN;
}

/* Stretch sector k if the point lies in it, wrongly; false: it does not lie in it. */
static bool fit_sector(const struct fit *fit, struct pupil_outline_point at, size_t k, double by)
{
    const size_t next = fit->is_half ? k + 1 : (k + 1) % FILM_SECTORS;
    const double depth = depth_in(at, corner_of(fit, k), corner_of(fit, k + 1));
    if (fit->is_hole ? depth < 1 : depth > 1) {
        for (size_t n = 0; n < fit->nodes->count; n++) {
            bounds_fit_stretch(fit, fit->nodes->of[n], k, by * depth);
            bounds_fit_stretch(fit, fit->nodes->of[n], next, by * depth);
        }
    }
    return !isnan(depth);
}

/* The sector that a point lies in is near one that is known, or any. */
static void fit_point(const struct fit *fit, struct pupil_outline_point at, size_t about, double by)
{
    enum { NEAR = 3 };
    bool found = false;
    at = exit_pupil_bounds_reduced(fit->region, fit->place, at);
    at.x -= fit->centre.x;
    at.y -= fit->centre.y;
    for (size_t step = 0; step <= 2 * NEAR; step++) {
        const size_t turned = about + FILM_SECTORS + step - NEAR;
        const size_t k = turned % FILM_SECTORS;
        if (!fit->is_half || (turned >= FILM_SECTORS && k < fit->sectors)) {
            found = fit_sector(fit, at, k, by) || found;
        }
    }
    for (size_t k = 0; k < fit->sectors && !found; k++) {
        found = fit_sector(fit, at, k, by);
    }
}

static struct fit fit_of(const struct exit_pupil_bounds *region, const struct film_nodes *nodes,
                         const struct pupil_outline *outline, bool is_hole)
{
    struct fit fit = {.region = region,
                      .place = &outline->place,
                      .corners = is_hole ? region->inner : region->outer,
                      .centres = region->centre,
                      .nodes = nodes,
                      .sectors = pupil_outline_sectors(outline),
                      .is_half = outline->is_half,
                      .is_hole = is_hole};
    for (size_t n = 0; n < nodes->count; n++) {
        fit.centre.x += region->centre[0][nodes->of[n]] / (double)nodes->count;
        fit.centre.y += region->centre[1][nodes->of[n]] / (double)nodes->count;
    }
    return fit;
}

/*
 * Where an edge seems to have a corner between two of its points: what goes on straight from before
 * the first meets what comes straight to the second. NaN: it turns by no more than twice what a
 * circle does.
 */
static struct pupil_outline_point fit_meet(const struct pupil_outline *outline, size_t i)
{
    const size_t each = outline->each, all = PUPIL_OUTLINE_STEPS;
    const bool is_half = outline->is_half;
    if (is_half && (i < each || i + 2 * each > all)) {
        return (struct pupil_outline_point){NAN, NAN};
    }
    const struct pupil_outline_point a = outline->edge[i >= each ? i - each : all - each];
    const struct pupil_outline_point b = outline->edge[i], c = outline->edge[i + each];
    const struct pupil_outline_point d = outline->edge[i + 2 * each <= all ? i + 2 * each : each];
    const struct pupil_outline_point ab = {b.x - a.x, b.y - a.y}, dc = {c.x - d.x, c.y - d.y};
    const double across = ab.x * dc.y - ab.y * dc.x, along = -ab.x * dc.x - ab.y * dc.y;
    const double usual = (is_half ? 2 : 4) * PI * (double)each / (double)all;
    if (!(fabs(atan2(across, along)) > 1.5 * usual)) {
        return (struct pupil_outline_point){NAN, NAN};
    }
    const double far = ((c.x - b.x) * dc.y - (c.y - b.y) * dc.x) / across;
    return (struct pupil_outline_point){b.x + far * ab.x, b.y + far * ab.y};
}

bool bounds_fit_is_smooth(const struct pupil_outline *outline)
{
    bool is_smooth = true;
    for (size_t i = 0; i < PUPIL_OUTLINE_STEPS; i += outline->each) {
        is_smooth = is_smooth && isnan(fit_meet(outline, i).x);
    }
    return is_smooth;
}

void bounds_fit(const struct exit_pupil_bounds *region, const struct film_nodes *nodes,
                const struct pupil_outline *outline)
{
    if (outline->is_empty) {
        return;
    }
    const struct fit fit = fit_of(region, nodes, outline, false);
    const size_t each = PUPIL_OUTLINE_STEPS / fit.sectors;
    for (size_t i = 0; i <= PUPIL_OUTLINE_STEPS; i += outline->each) {
        fit_point(&fit, outline->edge[i], i / each, 1);
        if (i < PUPIL_OUTLINE_STEPS) {
            /*
             * the point where two pieces of an edge meet, if it lies between i and the next, not
             * far beyond
             */
            const size_t about = i / each;
            const double farthest = 2;
            const struct pupil_outline_point at = fit_meet(outline, i), centre = outline->centre;
            const struct pupil_outline_point a = outline->edge[i],
                                             b = outline->edge[i + outline->each];
            const double depth =
                depth_in((struct pupil_outline_point){at.x - centre.x, at.y - centre.y},
                         (struct pupil_outline_point){a.x - centre.x, a.y - centre.y},
                         (struct pupil_outline_point){b.x - centre.x, b.y - centre.y});
            if (depth > 1 && depth < farthest) {
                fit_point(&fit, at, about, 1);
            }
        }
    }
    if (region->has_hole && outline->has_hole) {
        const struct fit hole = fit_of(region, nodes, outline, true);
        for (size_t k = 0; k <= hole.sectors; k++) {
            fit_point(&hole, outline->hole[k], k, 1);
        }
    }
}

void bounds_fit_points(const struct exit_pupil_bounds *region, const struct film_nodes *nodes,
                       const struct pupil_outline *outline,
                       const struct pupil_outline_point *points, size_t count)
{
    const double inside = 0.6, more = 1.1;
    const struct fit fit = fit_of(region, nodes, outline, false);
    for (size_t i = 0; i < count; i++) {
        const double x = (points[i].x - outline->centre.x) / outline->size.x;
        const double y = (points[i].y - outline->centre.y) / outline->size.y;
        if (x * x + y * y > inside * inside) {
            const double turn = atan2(x, y) / (2 * PI);
            const double sector = FILM_SECTORS * (turn < 0 ? turn + 1 : turn);
            fit_point(&fit, points[i], (size_t)sector, more);
        }
    }
}

void bounds_fit_start(const struct exit_pupil_bounds *region, const struct pupil_outline *outline,
                      size_t row, size_t node)
{
    const size_t sectors = pupil_outline_sectors(outline), each = PUPIL_OUTLINE_STEPS / sectors;
    const bool goes_on = outline->is_empty && row > 1;
    const struct pupil_outline_point middle =
        exit_pupil_bounds_reduced(region, &outline->place, outline->centre);
    const double centre[2] = {middle.x, middle.y};
    for (int k = 0; k < 2; k++) {
        double *here = &region->centre[k][node];
        double *corners = &region->outer[k][node * FILM_CORNERS];
        *here = goes_on ? 2 * here[-1] - here[-2] : centre[k];
        for (size_t i = 0; i <= sectors; i++) {
            const struct pupil_outline_point edge =
                exit_pupil_bounds_reduced(region, &outline->place, outline->edge[each * i]);
            if (goes_on) {
                corners[i] = *here + corners[(ptrdiff_t)i - FILM_CORNERS] - here[-1];
            } else if (k == 0) {
                corners[i] = edge.x;
            } else {
                corners[i] = edge.y;
            }
        }
    }
}

void bounds_fit_start_hole(const struct exit_pupil_bounds *region, const struct pupil_outline *low,
                           const struct pupil_outline *high, double share, size_t node)
{
    const struct pupil_outline *next = high->has_hole ? high : low;
    for (size_t k = 0; k <= pupil_outline_sectors(low); k++) {
        const struct pupil_outline_point a =
            exit_pupil_bounds_reduced(region, &low->place, low->hole[k]);
        const struct pupil_outline_point b =
            exit_pupil_bounds_reduced(region, &next->place, next->hole[k]);
        region->inner[0][node * FILM_CORNERS + k] = a.x + share * (b.x - a.x);
        region->inner[1][node * FILM_CORNERS + k] = a.y + share * (b.y - a.y);
    }
}

static double bounds_fit_radius_of(const struct exit_pupil_bounds *region, size_t node, size_t k)
{
    const size_t i = node * FILM_CORNERS + k;
    return hypot(region->outer[0][i] - region->centre[0][node],
                 region->outer[1][i] - region->centre[1][node]);
}

const double *bounds_fit_radii(const struct exit_pupil_bounds *region, size_t nodes,
                               struct arena *arena)
{
    double *radii = ARENA_ARRAY(arena, nodes * FILM_CORNERS, double);
    for (size_t i = 0; i < nodes * FILM_CORNERS; i++) {
        radii[i] = bounds_fit_radius_of(region, i / FILM_CORNERS, i % FILM_CORNERS);
    }
    return radii;
}

void bounds_fit_follow(const struct exit_pupil_bounds *region, const double *before, size_t row)
{
    const struct fit fit = {.corners = region->outer, .centres = region->centre};
    for (size_t k = 0; k < FILM_CORNERS; k++) {
        double by = 1;
        for (size_t node = row - 1; node <= row + 1; node += 2) {
            const double old = before[node * FILM_CORNERS + k];
            by = old > 0 ? fmax(by, bounds_fit_radius_of(region, node, k) / old) : by;
        }
        bounds_fit_stretch(&fit, row, k, by);
    }
}

/* Where one has a corner that another has at k: the same, or after half a turn the opposite. */
static size_t turned_corner(const struct exit_pupil_bounds *region, size_t k)
{
    return region->turns ? k : (k + FILM_SECTORS / 2) % FILM_SECTORS;
}

void bounds_fit_unite(const struct exit_pupil_bounds *region, size_t node, size_t other)
{
    const struct fit outer = {.corners = region->outer, .centres = region->centre};
    for (size_t k = 0; k < FILM_CORNERS; k++) {
        const double here = bounds_fit_radius_of(region, node, k);
        const double there = bounds_fit_radius_of(region, other, turned_corner(region, k));
        bounds_fit_stretch(&outer, node, k, here > 0 ? fmax(1, there / here) : 1);
    }
}

void bounds_fit_copy(const struct exit_pupil_bounds *region, size_t from, size_t to)
{
    const double sign = region->turns ? 1 : -1;
    for (int k = 0; k < 2; k++) {
        region->centre[k][to] = sign * region->centre[k][from];
        for (size_t i = 0; i < FILM_CORNERS; i++) {
            const size_t there = from * FILM_CORNERS + turned_corner(region, i);
            region->outer[k][to * FILM_CORNERS + i] = sign * region->outer[k][there];
            region->inner[k][to * FILM_CORNERS + i] = sign * region->inner[k][there];
        }
    }
}

void bounds_fit_finish(const struct exit_pupil_bounds *region, bool is_half)
{
    const size_t nodes = exit_pupil_bounds_nodes(region);
    for (int hole = 0; hole <= region->has_hole; hole++) {
        double *const *corners = hole ? region->inner : region->outer;
        const struct fit fit = {.corners = corners, .centres = region->centre};
        for (size_t node = 0; node < nodes; node++) {
            for (size_t k = 0; k <= FILM_SECTORS; k++) {
                bounds_fit_stretch(&fit, node, k, hole ? shrunk : grown);
            }
            /* the other half of a polygon, or its last corner, which is the first again */
            double *x = &corners[0][node * FILM_CORNERS], *y = &corners[1][node * FILM_CORNERS];
            for (size_t k = is_half ? FILM_SECTORS / 2 + 1 : FILM_SECTORS; k <= FILM_SECTORS; k++) {
                x[k] = is_half ? -x[FILM_SECTORS - k] : x[0];
                y[k] = y[FILM_SECTORS - k];
            }
        }
    }
}
