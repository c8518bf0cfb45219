/* camera/film_outline.c - edges of pupils in directions of the film's side. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_outline.h"

#include "base/constants.h"
#include "trace/star.h"

#include <math.h>
#include <string.h>

/* Edges are searched to a share of what regions are grown by. */
static const double roughly = 1e-4, around = 2, farthest = 100;

/* One point of the film at one wavelength, looked at from there. */
struct view {
    const struct film_lens *lens;
    double tangent;
    struct film_place place;
    struct beam beam;
    struct stop_beam disc;
    struct margins margins;
    struct probe probe;
    struct edge_frame frame;
};

/* -------- between directions and the beam -------- */

static void to_beam(const struct view *view, struct outline_point way, double at[2])
{
    const struct film_place *place = &view->place;
    const double film = view->lens->film, size2 = way.x * way.x + way.y * way.y;
    /* a guess may lie beyond all directions */
    const double left2 = 1 + view->tangent * size2 - size2;
    const double far = fabs(film) / sqrt(fmax(left2, 1e-12));
    const double x = way.x * place->up[1] + way.y * place->up[0];
    const double y = way.y * place->up[1] - way.x * place->up[0];
    beam_place(&view->beam, (double[3]){place->x + far * x, place->y + far * y, 0}, at);
}

/* In units of the disc. */
static void to_disc(const struct view *view, struct outline_point way, double uv[2])
{
    const struct stop_beam *disc = &view->disc;
    double at[2];
    to_beam(view, way, at);
    for (int k = 0; k < 2; k++) {
        uv[k] = (at[k] - disc->origin[k]) / disc->axes[3 * k];
    }
}

static struct outline_point from_disc(const struct view *view, const double uv[2])
{
    const double *up = view->place.up;
    double at[2];
    stop_beam_place(&view->disc, uv[0], uv[1], at);
    const struct ray ray = beam_ray(&view->beam, at[0], at[1]);
    const double x = ray.cosine[0] * up[1] - ray.cosine[1] * up[0];
    const double y = ray.cosine[0] * up[0] + ray.cosine[1] * up[1];
    const double left2 = fmax(1 - view->tangent * (x * x + y * y), 1e-12);
    return (struct outline_point){x / sqrt(left2), y / sqrt(left2)};
}

/* Look with a disc of so many half widths about a middle. */
static void open_view(const struct outline_search *search, size_t wavelength,
                      const struct outline *about, double widths, struct view *view)
{
    const struct film_lens *lens = search->lens;
    const struct system *system = lens->systems[wavelength];
    const struct outline_point centre = about->centre, size = about->size;
    double right[2], up[2];
    view->lens = lens;
    view->tangent = search->tangent;
    view->place = about->place;
    view->beam = beam_to_pupil((double[3]){about->place.x, about->place.y, lens->film},
                               lens->first->exit_pupil, system->index_first);
    view->disc = (struct stop_beam){
        .system = system, .beam = &view->beam, .radius = NAN, .weight = WEIGHT_BEAM};
    const double *middle = view->disc.origin;
    to_beam(view, centre, view->disc.origin);
    to_beam(view, (struct outline_point){centre.x + size.x, centre.y}, right);
    to_beam(view, (struct outline_point){centre.x, centre.y + size.y}, up);
    const double radius = widths * fmax(hypot(right[0] - middle[0], right[1] - middle[1]),
                                        hypot(up[0] - middle[0], up[1] - middle[1]));
    view->disc.axes[0] = view->disc.axes[3] = radius;
    view->frame = (struct edge_frame){.stretch = {1 / widths, 1 / widths}};
    view->margins = margins_open(&view->disc, search->arena);
    view->probe = probe_open(system, &view->beam, search->arena);
}

/* -------- one outline -------- */

/* Directions towards the corners of the ring, and how far the edge is. */
struct spokes {
    size_t count;
    double angles[FILM_SECTORS + 1];
    struct edge ends[FILM_SECTORS + 1];
};

/* How deep rays at shares of the spokes are within what blocks. */
static void look_at_spokes(const struct view *view, const struct spokes *spokes,
                           const double *shares, double *depth)
{
    for (size_t done = 0; done < spokes->count; done += RAYS_BLOCK) {
        const size_t left = spokes->count - done, here = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        double at[RAYS_BLOCK][2];
        size_t parts[RAYS_BLOCK];
        for (size_t i = 0; i < here; i++) {
            const size_t k = done + i;
            double uv[2];
            edge_point(&view->frame, spokes->angles[k], shares[k] * spokes->ends[k].radius, uv);
            stop_beam_place(&view->disc, uv[0], uv[1], at[i]);
        }
        probe_depth(&view->probe, (const double(*)[2])at, here, depth + done, parts);
    }
}

/* Where the dark ends, about as far out as it did; false: somewhere it is not so any more. */
static bool follow_hole(const struct view *view, const struct spokes *spokes, double *shares)
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
    look_at_spokes(view, spokes, dark, depth);
    look_at_spokes(view, spokes, lit, beyond);
    for (size_t k = 0; k < spokes->count; k++) {
        holds = holds && depth[k] > 0 && beyond[k] <= 0;
    }
    for (int turn = 0; turn < HALVES && holds; turn++) {
        for (size_t k = 0; k < spokes->count; k++) {
            tried[k] = (dark[k] + lit[k]) / 2;
        }
        look_at_spokes(view, spokes, tried, depth);
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
static void search_hole(const struct view *view, const struct spokes *spokes, double *shares)
{
    struct spans spans[FILM_SECTORS + 1];
    const struct edge_directions directions = {view->frame, spokes->angles, NULL, spokes->count, 0};
    star_spans(&view->margins, &view->probe, &directions, spokes->ends, spans);
    for (size_t k = 0; k < spokes->count; k++) {
        shares[k] = spans[k].count > 0 ? spans[k].low[0] : 1;
    }
}

/* What is dark in the middle, if it is so in all directions. */
static void find_hole(const struct view *view, const double *angles, const struct edge *edges,
                      struct outline *outline)
{
    struct spokes spokes = {.count = outline_sectors(outline) + 1};
    const size_t step = OUTLINE_STEPS / (spokes.count - 1) / outline->each;
    outline->has_hole = outline->asks_hole && view->probe.full != NULL;
    if (!outline->has_hole) {
        return;
    }
    for (size_t k = 0; k < spokes.count; k++) {
        spokes.angles[k] = angles[step * k];
        spokes.ends[k] = edges[step * k];
    }
    if (!(outline->knows_hole && follow_hole(view, &spokes, outline->share))) {
        search_hole(view, &spokes, outline->share);
    }
    for (size_t k = 0; k < spokes.count; k++) {
        double at[2];
        edge_point(&view->frame, spokes.angles[k], outline->share[k] * spokes.ends[k].radius, at);
        outline->hole[k] = from_disc(view, at);
        outline->has_hole = outline->has_hole && outline->share[k] > 0;
    }
    outline->knows_hole = outline->has_hole;
}

/* Half widths of what was found, and its centroid. */
static void measure(const struct outline *outline, struct outline_point *size,
                    struct outline_point *centroid)
{
    struct outline_point low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    struct outline_point moment = {0, 0};
    const size_t each = outline->each;
    double area = 0;
    for (size_t i = 0; i <= OUTLINE_STEPS; i += each) {
        const struct outline_point at = outline->edge[i];
        const struct outline_point next = outline->edge[i < OUTLINE_STEPS ? i + each : i];
        const double x = at.x - outline->centre.x, next_x = next.x - outline->centre.x;
        const double y = at.y - outline->centre.y, next_y = next.y - outline->centre.y;
        const double part = x * next_y - next_x * y;
        low = (struct outline_point){fmin(low.x, at.x), fmin(low.y, at.y)};
        high = (struct outline_point){fmax(high.x, at.x), fmax(high.y, at.y)};
        area += part;
        moment.x += part * (x + next_x) / 3;
        moment.y += part * (y + next_y) / 3;
    }
    const bool has_area = area != 0;
    *size = (struct outline_point){outline->is_half ? high.x : (high.x - low.x) / 2,
                                   (high.y - low.y) / 2};
    *centroid = outline->centre;
    centroid->x += has_area && !outline->is_half ? moment.x / area : 0;
    centroid->y += has_area ? moment.y / area : 0;
}

static struct outline_point opposite(struct outline_point at)
{
    return (struct outline_point){-at.x, -at.y};
}

struct outline outline_turned(const struct outline *outline)
{
    struct outline turned = *outline;
    turned.place.x = -outline->place.x;
    turned.place.y = -outline->place.y;
    turned.centre = opposite(outline->centre);
    for (size_t i = 0; i <= OUTLINE_STEPS; i++) {
        turned.edge[i] = opposite(outline->edge[(i + OUTLINE_STEPS / 2) % OUTLINE_STEPS]);
    }
    for (size_t k = 0; k <= FILM_SECTORS; k++) {
        const size_t other = (k + FILM_SECTORS / 2) % FILM_SECTORS;
        turned.hole[k] = opposite(outline->hole[other]);
        turned.share[k] = outline->share[other];
    }
    return turned;
}

void outline_foresee(const struct outline *last, const struct outline *before, double share,
                     struct outline *here)
{
    struct outline_point ignored, middle, earlier;
    measure(last, &here->size, &middle);
    here->centre = middle;
    if (before != NULL) {
        measure(before, &ignored, &earlier);
        here->centre.x += share * (middle.x - earlier.x);
        here->centre.y += share * (middle.y - earlier.y);
    }
}

/* Where to look first: each direction, a half width away or where a neighbour has its edge. */
static void guess_edge(const struct view *view, const struct outline *outline,
                       const struct outline *near, double *angles, double *radii)
{
    const double all = outline->is_half ? PI : 2 * PI;
    for (size_t k = 0; k <= OUTLINE_STEPS / outline->each; k++) {
        const size_t i = k * outline->each;
        const double angle = all * (double)i / OUTLINE_STEPS;
        struct outline_point at = {outline->size.x * sin(angle), outline->size.y * cos(angle)};
        double uv[2];
        if (near != NULL) {
            at = (struct outline_point){near->edge[i].x - near->centre.x,
                                        near->edge[i].y - near->centre.y};
        }
        at.x += outline->centre.x;
        at.y += outline->centre.y;
        to_disc(view, at, uv);
        edge_polar(&view->frame, uv, 0, &angles[k], &radii[k]);
    }
}

/* The edge as seen in a disc; does the disc itself end some of it? */
static bool look_within(const struct view *view, const struct outline *near,
                        struct outline *outline)
{
    double angles[OUTLINE_STEPS + 1], radii[OUTLINE_STEPS + 1];
    struct edge edges[OUTLINE_STEPS + 1];
    bool fills = false;
    if (near != NULL && near->knows_hole) {
        outline->knows_hole = true;
        memcpy(outline->share, near->share, sizeof near->share);
    }
    guess_edge(view, outline, near, angles, radii);
    const struct edge_directions directions = {view->frame, angles, near != NULL ? radii : NULL,
                                               OUTLINE_STEPS / outline->each + 1, 0};
    edges_find(&view->margins, &directions, roughly, edges);
    for (size_t k = 0; k <= OUTLINE_STEPS / outline->each; k++) {
        double at[2];
        edge_point(&view->frame, angles[k], edges[k].radius, at);
        outline->edge[k * outline->each] = from_disc(view, at);
        fills = fills || edges[k].limit == 0; /* the first margin is the disc */
    }
    find_hole(view, angles, edges, outline);
    return fills;
}

/*
 * The edge about the centre that the outline has, in a disc of some of its half widths.
 *
 * Given     near  the outline of a neighbour; null: none
 * Result    false: the centre is dark
 */
static bool look(const struct outline_search *search, size_t wavelength, const struct outline *near,
                 struct outline *outline)
{
    static const double middle[1][2] = {{0, 0}};
    bool fills = true;
    for (double widths = around; fills && widths < farthest; widths *= 2) {
        const struct arena_mark mark = arena_mark(search->arena);
        struct view view;
        open_view(search, wavelength, outline, widths, &view);
        margins_look(&view.margins, middle, 1);
        const bool is_dark = !(view.margins.excess[0] <= 0);
        fills = !is_dark && look_within(&view, near, outline);
        arena_reset(search->arena, mark);
        if (is_dark) {
            return false;
        }
    }
    return true;
}

/* -------- light without a neighbour -------- */

/* A square of u, v, and the rays at a grid over it. */
struct patch {
    double centre[2], half[2];
    double points[RAYS_BLOCK][2];
    double least;      /* by which one fails, so far */
    double deepest[2]; /* the ray that passes best, in the middle of a lens with two halves */
};

enum { SIDE = 11, ALL = SIDE * SIDE };

static void look_at_patch(const struct view *view, struct patch *patch)
{
    for (size_t i = 0; i < ALL; i++) {
        for (size_t k = 0; k < 2; k++) {
            const double place = (double)(k == 0 ? i % SIDE : i / SIDE) * 2 / (SIDE - 1) - 1;
            patch->points[i][k] = patch->centre[k] + place * patch->half[k];
        }
    }
    margins_look(&view->margins, (const double(*)[2])patch->points, ALL);
}

/*
 * A smaller one about the rays that pass, or about that which fails by least.
 *
 * Result    how many pass; SIZE_MAX: none does, nor will
 */
static size_t narrow(const struct view *view, bool is_half, struct patch *patch)
{
    const double *excess = view->margins.excess;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    size_t lit = 0, best = 0, deepest = ALL / 2;
    for (size_t i = 0; i < ALL; i++) {
        const bool counts = !is_half || i % SIDE == SIDE / 2;
        best = excess[i] < excess[best] ? i : best;
        deepest = counts && excess[i] < excess[deepest] ? i : deepest;
        lit += excess[i] <= 0;
    }
    patch->deepest[0] = patch->points[deepest][0];
    patch->deepest[1] = patch->points[deepest][1];
    for (size_t i = 0; i < ALL; i++) {
        for (int k = 0; k < 2 && (lit == 0 ? i == best : excess[i] <= 0); k++) {
            low[k] = fmin(low[k], patch->points[i][k]);
            high[k] = fmax(high[k], patch->points[i][k]);
        }
    }
    for (int k = 0; k < 2; k++) {
        const double step = 2 * patch->half[k] / (SIDE - 1);
        patch->centre[k] = (low[k] + high[k]) / 2;
        patch->half[k] = (high[k] - low[k]) / 2 + (lit == 0 ? 1.5 : 0.5) * step;
    }
    /* nearing a place that passes it would be less by more than the square is smaller */
    const bool is_dark = lit == 0 && !(excess[best] < patch->least / 2);
    patch->least = excess[best];
    return is_dark ? SIZE_MAX : lit;
}

bool outline_is_lit(const struct outline_search *search, size_t wavelength, struct outline *outline)
{
    enum { LEVELS = 9, ENOUGH = 5 };
    const struct arena_mark mark = arena_mark(search->arena);
    struct patch patch = {.half = {0.8, 0.8}, .least = INFINITY};
    struct view view;
    size_t lit = 0;
    open_view(search, wavelength, outline, around, &view);
    for (int level = 0; level < LEVELS && lit < ENOUGH; level++) {
        look_at_patch(&view, &patch);
        lit = narrow(&view, outline->is_half, &patch);
    }
    const bool is_lit = lit > 0 && lit != SIZE_MAX;
    if (is_lit) {
        const double right[2] = {patch.centre[0] + patch.half[0], patch.centre[1]};
        const double up[2] = {patch.centre[0], patch.centre[1] + patch.half[1]};
        const struct outline_point centre = from_disc(&view, patch.centre);
        const struct outline_point middle = from_disc(&view, patch.deepest);
        const struct outline_point a = from_disc(&view, right), b = from_disc(&view, up);
        const double size_a = hypot(a.x - centre.x, a.y - centre.y);
        const double size_b = hypot(b.x - centre.x, b.y - centre.y);
        outline->centre = (struct outline_point){outline->is_half ? 0 : middle.x, middle.y};
        outline->size = (struct outline_point){size_a, size_b};
    }
    arena_reset(search->arena, mark);
    return is_lit;
}

bool outline_discover(const struct outline_search *search, size_t wavelength,
                      struct outline *outline)
{
    const struct film_lens *lens = search->lens;
    const struct arena_mark mark = arena_mark(search->arena);
    struct star *star = ARENA_NEW(search->arena, struct star);
    struct view view;
    outline->centre = (struct outline_point){0, 0};
    outline->size = (struct outline_point){0.1, 0.1};
    open_view(search, wavelength, outline, 1, &view);
    const struct clear_guess guess =
        clear_guess_of(lens->systems[wavelength], &view.beam, lens->first);
    view.disc.origin[0] = guess.centre[0];
    view.disc.origin[1] = guess.centre[1];
    view.disc.axes[0] = view.disc.axes[3] = around * guess.radius;
    const bool found = star_find(&view.margins, &view.probe, search->arena, star);
    if (found) {
        double uv[2], low = INFINITY, high = 0;
        for (size_t i = 0; i < star->count; i++) {
            low = fmin(low, star->edges[i].radius);
            high = fmax(high, star->edges[i].radius);
        }
        outline->centre = from_disc(&view, star->frame.centre);
        edge_point(&star->frame, 0, (low + high) / 2, uv);
        const struct outline_point top = from_disc(&view, uv);
        const double size = hypot(top.x - outline->centre.x, top.y - outline->centre.y);
        outline->size = (struct outline_point){size, size};
        outline->centre.x = outline->is_half ? 0 : outline->centre.x;
    }
    arena_reset(search->arena, mark);
    return found;
}

void outline_find(const struct outline_search *search, size_t wavelength,
                  const struct outline *near, struct outline *outline)
{
    if (near != NULL && look(search, wavelength, near, outline)) {
        outline->is_empty = false;
        return;
    }
    const bool is_lit = near != NULL ? outline_is_lit(search, wavelength, outline)
                                     : outline_discover(search, wavelength, outline);
    outline->is_empty = !is_lit || !look(search, wavelength, NULL, outline);
    if (!outline->is_empty) {
        /* seen from its middle, if that is clear */
        const struct outline first = *outline;
        measure(&first, &outline->size, &outline->centre);
        if (!look(search, wavelength, NULL, outline)) {
            *outline = first;
        }
    }
}

/* Rays over 1.6 half widths; those that pass. */
static size_t scatter(const struct outline_search *search, size_t wavelength,
                      const struct outline *outline, size_t turn, struct outline_point *lit)
{
    /* powers of the plastic number: evenly spread however many there are */
    static const double steps[2] = {0.7548776662466927, 0.5698402909980532};
    const struct arena_mark mark = arena_mark(search->arena);
    double points[RAYS_BLOCK][2];
    struct view view;
    size_t count = 0;
    open_view(search, wavelength, outline, around, &view);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        for (int k = 0; k < 2; k++) {
            const double at = (double)(turn * RAYS_BLOCK + i) * steps[k];
            points[i][k] = 1.6 * (at - floor(at)) - 0.8;
        }
    }
    margins_look(&view.margins, (const double(*)[2])points, RAYS_BLOCK);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (view.margins.excess[i] <= 0) {
            struct outline_point way = from_disc(&view, points[i]);
            way.x = outline->is_half ? fabs(way.x) : way.x;
            lit[count++] = way;
        }
    }
    arena_reset(search->arena, mark);
    return count;
}

size_t outline_scatter(const struct outline_search *search, size_t wavelength,
                       const struct outline *outline, size_t turn, struct outline_point *lit)
{
    enum { ROUNDS = OUTLINE_SCATTER / RAYS_BLOCK };
    const double more = 1.15;
    struct outline about = {.place = outline->place,
                            .is_half = outline->is_half,
                            .centre = outline->centre,
                            .size = outline->size};
    size_t count = 0, all = 0;
    bool grows = true;
    for (int round = 0; round < ROUNDS && grows; round++) {
        count = scatter(search, wavelength, &about, turn + (size_t)round, lit + all);
        double far = 0;
        for (size_t i = 0; i < count; i++) {
            far = fmax(far, fmax(fabs(lit[all + i].x - about.centre.x),
                                 fabs(lit[all + i].y - about.centre.y)));
        }
        all += count;
        grows = far > more * fmax(about.size.x, about.size.y);
        about.size.x = about.size.y = fmax(far, fmax(about.size.x, about.size.y));
    }
    return all;
}
