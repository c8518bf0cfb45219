/* camera/film/pupil_outline.c - edges and holes of pupils, found about a ray that passes. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/pupil_outline.h"

#include "base/constants.h"
#include "trace/pupil/pupil_boundary.h"
#include "trace/pupil/pupil_inside.h"

#include <math.h>
#include <string.h>

/* Edges are searched to a share of what regions are grown by. */
static const double roughly = 1e-4, farthest = 100;

/* -------- a disc of rays from a point of the film -------- */

/* Half widths that discs have where nothing asks for more. */
#define SIGHT_AROUND 2.0

/* One point of the film at one wavelength. */
struct outline_rays {
    const struct film_lens *lens;
    double tangent;
    struct film_place place;
    struct beam beam;
    struct stop_beam disc;
    struct clearances margins;
    struct edge_frame frame;
};

/* The coordinates in the beam of a direction. */
static void to_beam(const struct outline_rays *sight, struct pupil_outline_point way, double at[2])
{
    const struct film_place *place = &sight->place;
    const double film = sight->lens->film, size2 = way.x * way.x + way.y * way.y;
    /* a guess may lie beyond all directions */
    const double left2 = 1 + sight->tangent * size2 - size2;
    const double far = fabs(film) / sqrt(fmax(left2, 1e-12));
    const double x = way.x * place->up[1] + way.y * place->up[0];
    const double y = way.y * place->up[1] - way.x * place->up[0];
    beam_place(&sight->beam, (double[3]){place->x + far * x, place->y + far * y, 0}, at);
}

static struct pupil_outline_point outline_rays_from_disc(const struct outline_rays *sight,
                                                         const double uv[2])
{
    const double *up = sight->place.up;
    double at[2];
    stop_beam_place(&sight->disc, uv[0], uv[1], at);
    const struct ray ray = beam_ray(&sight->beam, at[0], at[1]);
    const double x = ray.cosine[0] * up[1] - ray.cosine[1] * up[0];
    const double y = ray.cosine[0] * up[0] + ray.cosine[1] * up[1];
    const double left2 = fmax(1 - sight->tangent * (x * x + y * y), 1e-12);
    return (struct pupil_outline_point){x / sqrt(left2), y / sqrt(left2)};
}

/* Look with a disc of so many half widths of an outline about its centre. */
static void rays_open(const struct pupil_outline_search *search, size_t wavelength,
                      const struct pupil_outline *about, double widths, struct outline_rays *sight)
{
    const struct film_lens *lens = search->lens;
    const struct system *system = lens->systems[wavelength];
    const struct pupil_outline_point centre = about->centre, size = about->size;
    double right[2], up[2];
    sight->lens = lens;
    sight->tangent = search->tangent;
    sight->place = about->place;
    sight->beam = beam_to_pupil((double[3]){about->place.x, about->place.y, lens->film},
                                lens->first->exit_pupil, system->index_first);
    sight->disc = (struct stop_beam){
        .system = system, .beam = &sight->beam, .radius = NAN, .weight = WEIGHT_BEAM};
    const double *middle = sight->disc.origin;
    to_beam(sight, centre, sight->disc.origin);
    to_beam(sight, (struct pupil_outline_point){centre.x + size.x, centre.y}, right);
    to_beam(sight, (struct pupil_outline_point){centre.x, centre.y + size.y}, up);
    const double radius = widths * fmax(hypot(right[0] - middle[0], right[1] - middle[1]),
                                        hypot(up[0] - middle[0], up[1] - middle[1]));
    sight->disc.axes[0] = sight->disc.axes[3] = radius;
    sight->frame = (struct edge_frame){.stretch = {1 / widths, 1 / widths}};
    sight->margins = clearances_open(&sight->disc, search->arena);
}

/* -------- where light comes from -------- */

enum { SIDE = 11, ALL = SIDE * SIDE };

/*
 * Grids over squares of u, v, each about the rays of the one before that pass, or about that which
 * fails by least; in a lens with two halves those in the middle tell how it passes.
 */
bool outline_is_lit(const struct pupil_outline_search *search, size_t wavelength,
                    struct pupil_outline *outline)
{
    enum { LEVELS = 9, ENOUGH = 5 };
    const struct arena_mark mark = arena_mark(search->arena);
    double middle[2] = {0}, half[2] = {0.8, 0.8}, points[RAYS_BLOCK][2], least = INFINITY;
    struct outline_rays sight;
    size_t lit = 0, deepest = 0;
    bool is_dark = false;
    rays_open(search, wavelength, outline, SIGHT_AROUND, &sight);
    const double *excess = sight.margins.excess;
    for (int level = 0; level < LEVELS && lit < ENOUGH && !is_dark; level++) {
        for (size_t i = 0; i < 2 * ALL; i++) {
            const double place = (double)(i % 2 == 0 ? i / 2 % SIDE : i / 2 / SIDE);
            points[i / 2][i % 2] = middle[i % 2] + (place * 2 / (SIDE - 1) - 1) * half[i % 2];
        }
        clearances_look(&sight.margins, (const double(*)[2])points, ALL);
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        size_t best = 0;
        lit = 0;
        deepest = ALL / 2;
        for (size_t i = 0; i < ALL; i++) {
            const bool counts = !outline->is_half || i % SIDE == SIDE / 2;
            best = excess[i] < excess[best] ? i : best;
            deepest = counts && excess[i] < excess[deepest] ? i : deepest;
            lit += excess[i] <= 0;
        }
        for (size_t i = 0; i < ALL; i++) {
            for (int k = 0; k < 2 && (lit == 0 ? i == best : excess[i] <= 0); k++) {
                low[k] = fmin(low[k], points[i][k]);
                high[k] = fmax(high[k], points[i][k]);
            }
        }
        for (int k = 0; k < 2; k++) {
            const double step = 2 * half[k] / (SIDE - 1);
            middle[k] = (low[k] + high[k]) / 2;
            half[k] = (high[k] - low[k]) / 2 + (lit == 0 ? 1.5 : 0.5) * step;
        }
        /* nearing a place that passes it would be less by more than the square is smaller */
        is_dark = lit == 0 && !(excess[best] < least / 2);
        least = excess[best];
    }
    if (lit > 0) {
        const double right[2] = {middle[0] + half[0], middle[1]};
        const double up[2] = {middle[0], middle[1] + half[1]};
        const struct pupil_outline_point centre = outline_rays_from_disc(&sight, middle);
        const struct pupil_outline_point deep = outline_rays_from_disc(&sight, points[deepest]);
        const struct pupil_outline_point a = outline_rays_from_disc(&sight, right),
                                         b = outline_rays_from_disc(&sight, up);
        outline->centre = (struct pupil_outline_point){outline->is_half ? 0 : deep.x, deep.y};
        outline->size = (struct pupil_outline_point){hypot(a.x - centre.x, a.y - centre.y),
                                                     hypot(b.x - centre.x, b.y - centre.y)};
    }
    arena_reset(search->arena, mark);
    return lit > 0;
}

bool outline_discover(const struct pupil_outline_search *search, size_t wavelength,
                      struct pupil_outline *outline)
{
    const struct film_lens *lens = search->lens;
    const struct arena_mark mark = arena_mark(search->arena);
    struct pupil_boundary *boundary = ARENA_NEW(search->arena, struct pupil_boundary);
    struct outline_rays sight;
    outline->centre = (struct pupil_outline_point){0, 0};
    outline->size = (struct pupil_outline_point){0.1, 0.1};
    rays_open(search, wavelength, outline, 1, &sight);
    const struct clear_guess guess =
        clear_guess_of(lens->systems[wavelength], &sight.beam, lens->first);
    sight.disc.origin[0] = guess.centre[0];
    sight.disc.origin[1] = guess.centre[1];
    sight.disc.axes[0] = sight.disc.axes[3] = SIGHT_AROUND * guess.radius;
    const bool found = pupil_boundary_find(&sight.margins, search->arena, boundary);
    if (found) {
        double uv[2], low = INFINITY, high = 0;
        for (size_t i = 0; i < boundary->count; i++) {
            low = fmin(low, boundary->edges[i].radius);
            high = fmax(high, boundary->edges[i].radius);
        }
        outline->centre = outline_rays_from_disc(&sight, boundary->frame.centre);
        edge_point(&boundary->frame, 0, (low + high) / 2, uv);
        const struct pupil_outline_point top = outline_rays_from_disc(&sight, uv);
        const double size = hypot(top.x - outline->centre.x, top.y - outline->centre.y);
        outline->size = (struct pupil_outline_point){size, size};
        outline->centre.x = outline->is_half ? 0 : outline->centre.x;
    }
    arena_reset(search->arena, mark);
    return found;
}

/* -------- rays beside it -------- */

size_t outline_scatter(const struct pupil_outline_search *search, size_t wavelength,
                       const struct pupil_outline *outline, size_t turn,
                       struct pupil_outline_point *lit)
{
    enum { ROUNDS = OUTLINE_SCATTER / RAYS_BLOCK };
    /* powers of the plastic number: evenly spread however many there are */
    static const double steps[2] = {0.7548776662466927, 0.5698402909980532};
    const double more = 1.15;
    struct pupil_outline about = {.place = outline->place,
                                  .is_half = outline->is_half,
                                  .centre = outline->centre,
                                  .size = outline->size};
    size_t all = 0;
    bool grows = true;
    for (size_t round = 0; round < ROUNDS && grows; round++) {
        const struct arena_mark mark = arena_mark(search->arena);
        double points[RAYS_BLOCK][2], far = 0;
        struct outline_rays sight;
        rays_open(search, wavelength, &about, SIGHT_AROUND, &sight);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            for (int k = 0; k < 2; k++) {
                const double at = (double)((turn + round) * RAYS_BLOCK + i) * steps[k];
                points[i][k] = 1.6 * (at - floor(at)) - 0.8;
            }
        }
        clearances_look(&sight.margins, (const double(*)[2])points, RAYS_BLOCK);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            if (sight.margins.excess[i] <= 0) {
                struct pupil_outline_point way = outline_rays_from_disc(&sight, points[i]);
                way.x = outline->is_half ? fabs(way.x) : way.x;
                far = fmax(far, fmax(fabs(way.x - about.centre.x), fabs(way.y - about.centre.y)));
                lit[all++] = way;
            }
        }
        arena_reset(search->arena, mark);
        grows = far > more * fmax(about.size.x, about.size.y);
        about.size.x = about.size.y = fmax(far, fmax(about.size.x, about.size.y));
    }
    return all;
}

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
        clearances_depth(&sight->margins, (const double(*)[2])at, here, depth + done, parts);
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
            if (depth[k] > 0) {
                dark[k] = tried[k];
            } else {
                lit[k] = tried[k];
            }
        }
    }
    for (size_t k = 0; k < spokes->count && holds; k++) {
        shares[k] = dark[k];
    }
    return holds;
}

/* What is dark in the middle, if it is so in all directions. */
static void pupil_outline_find_hole(const struct outline_rays *sight, const double *angles,
                                    const struct edge *edges, struct pupil_outline *outline)
{
    struct spokes spokes = {.count = pupil_outline_sectors(outline) + 1};
    const size_t step = PUPIL_OUTLINE_STEPS / (spokes.count - 1) / outline->each;
    outline->has_hole = outline->asks_hole && sight->margins.full != NULL;
    if (!outline->has_hole) {
        return;
    }
    for (size_t k = 0; k < spokes.count; k++) {
        spokes.angles[k] = angles[step * k];
        spokes.ends[k] = edges[step * k];
    }
    if (!(outline->knows_hole && follow_hole(sight, &spokes, outline->share))) {
        /* where it ends on the way out, wherever that is */
        double *shares = outline->share;
        struct clear_intervals intervals[FILM_SECTORS + 1];
        pupil_boundary_intervals(&sight->margins, &sight->frame, spokes.angles, spokes.count,
                                 spokes.ends, intervals);
        for (size_t k = 0; k < spokes.count; k++) {
            shares[k] = intervals[k].count > 0 ? intervals[k].low[0] : 1;
        }
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
static void outline_measure(const struct pupil_outline *outline, struct pupil_outline_point *size,
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
    outline_measure(last, &here->size, &middle);
    here->centre = middle;
    if (before != NULL) {
        outline_measure(before, &ignored, &earlier);
        here->centre.x += share * (middle.x - earlier.x);
        here->centre.y += share * (middle.y - earlier.y);
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
    /* where to look first: each direction, a half width away or where a neighbour has its edge */
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
        const struct stop_beam *disc = &sight->disc;
        double shifted[2];
        to_beam(sight, at, shifted);
        for (int j = 0; j < 2; j++) {
            uv[j] = (shifted[j] - disc->origin[j]) / disc->axes[3 * j];
        }
        edge_polar(&sight->frame, uv, 0, &angles[k], &radii[k]);
    }
    edges_find(&sight->margins, &sight->frame, angles, near != NULL ? radii : NULL,
               PUPIL_OUTLINE_STEPS / outline->each + 1, 0, roughly, edges);
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
        rays_open(search, wavelength, outline, widths, &sight);
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
        outline_measure(&first, &outline->size, &outline->centre);
        if (!pupil_outline_look(search, wavelength, NULL, outline)) {
            *outline = first;
        }
    }
}
