/* camera/film_region.c - edges of pupils followed over the film, and polygons about them. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_region.h"

#include "base/constants.h"
#include "trace/star.h"

#include <math.h>

/*
 * A round lens has symmetric pupils: directions of one half, from upwards over +x to downwards; as
 * many distances as are looked at, every other is kept.
 */
enum { HALF = 128, EACH = 2 * HALF / FILM_SECTORS, LOOKS = 2 * FILM_RADII - 1, BISECTIONS = 16 };

/* Holes change little from one distance to the next: so many looks apart. */
enum { HOLE_LOOKS = 8, HOLE_ROWS = HOLE_LOOKS / 2 };

/* Edges are searched to a share of what the regions are grown by. */
static const double grown = 1.003, shrunk = 0.985, roughly = 1e-4, around = 2, farthest = 100;

struct point {
    double x, y;
};

/* The edge of a pupil, seen from one point of the film, in direction cosines. */
struct outline {
    bool is_empty, asks_hole, has_hole;
    size_t each;           /* which directions are looked in: all, or every other */
    double height, centre; /* of the point of the film, mm; y of the middle */
    struct point size;     /* half widths */
    struct point edge[HALF + 1];
    struct point hole[FILM_SECTORS / 2 + 1];
};

struct search {
    const struct film_lens *lens;
    struct arena *arena;
};

/* One point of the film at one wavelength, looked at from there. */
struct view {
    struct beam beam;
    struct stop_beam disc;
    struct margins margins;
    struct probe probe;
    struct edge_frame frame;
};

/* -------- between directions and the beam -------- */

static void to_beam(const struct view *view, const struct film_lens *lens, double height,
                    struct point way, double place[2])
{
    const double film = lens->film, over2 = way.x * way.x + way.y * way.y;
    /* a guess may lie beyond all directions */
    const double to_plane = fabs(film) / sqrt(fmax(1 - over2, 1e-12));
    beam_place(&view->beam, (double[3]){to_plane * way.x, height + to_plane * way.y, 0}, place);
}

/* In units of the disc. */
static void to_disc(const struct view *view, const struct film_lens *lens, double height,
                    struct point way, double uv[2])
{
    const struct stop_beam *disc = &view->disc;
    double place[2];
    to_beam(view, lens, height, way, place);
    for (int k = 0; k < 2; k++) {
        uv[k] = (place[k] - disc->origin[k]) / disc->axes[3 * k];
    }
}

static struct point from_disc(const struct view *view, const double uv[2])
{
    double at[2];
    stop_beam_place(&view->disc, uv[0], uv[1], at);
    const struct ray ray = beam_ray(&view->beam, at[0], at[1]);
    return (struct point){ray.cosine[0], ray.cosine[1]};
}

/* Look with a disc of so many half widths about a middle. */
static void open_view(const struct search *search, size_t wavelength, const struct outline *about,
                      double widths, struct view *view)
{
    const struct film_lens *lens = search->lens;
    const struct system *system = lens->systems[wavelength];
    const double height = about->height;
    double right[2], up[2];
    view->beam = beam_to_pupil((double[3]){0, height, lens->film}, lens->first->exit_pupil,
                               system->index_first);
    view->disc = (struct stop_beam){
        .system = system, .beam = &view->beam, .radius = NAN, .weight = WEIGHT_BEAM};
    const double *middle = view->disc.origin;
    to_beam(view, lens, height, (struct point){0, about->centre}, view->disc.origin);
    to_beam(view, lens, height, (struct point){about->size.x, about->centre}, right);
    to_beam(view, lens, height, (struct point){0, about->centre + about->size.y}, up);
    const double radius = widths * fmax(fabs(right[0] - middle[0]), fabs(up[1] - middle[1]));
    view->disc.axes[0] = view->disc.axes[3] = radius;
    view->frame = (struct edge_frame){.stretch = {1 / widths, 1 / widths}};
    view->margins = margins_open(&view->disc, search->arena);
    view->probe = probe_open(system, &view->beam, search->arena);
}

/* -------- one outline -------- */

/* What is dark in the middle, if it is so in all directions. */
static void find_hole(const struct view *view, const double *angles, const struct edge *edges,
                      struct outline *outline)
{
    enum { CORNERS = FILM_SECTORS / 2 + 1 };
    double some[CORNERS];
    struct edge ends[CORNERS];
    struct spans spans[CORNERS];
    outline->has_hole = outline->asks_hole && view->probe.full != NULL;
    if (!outline->has_hole) {
        return;
    }
    for (size_t k = 0; k < CORNERS; k++) {
        some[k] = angles[EACH / outline->each * k];
        ends[k] = edges[EACH / outline->each * k];
    }
    const struct edge_directions directions = {view->frame, some, NULL, CORNERS, 0};
    star_spans(&view->margins, &view->probe, &directions, ends, spans);
    for (size_t k = 0; k < CORNERS; k++) {
        double at[2];
        const double share = spans[k].count > 0 ? spans[k].low[0] : 1;
        edge_point(&view->frame, some[k], share * ends[k].radius, at);
        outline->hole[k] = from_disc(view, at);
        outline->has_hole = outline->has_hole && share > 0;
    }
}

/* Half widths of what was found, and its centroid. */
static void measure(const struct outline *outline, struct point *size, double *centroid)
{
    double low = INFINITY, high = -INFINITY, wide = 0, area = 0, moment = 0;
    for (size_t i = 0; i <= HALF; i++) {
        const struct point *at = &outline->edge[i], *next = &outline->edge[i < HALF ? i + 1 : i];
        const double y = at->y - outline->centre, next_y = next->y - outline->centre;
        const double part = at->x * next_y - next->x * y;
        low = fmin(low, at->y);
        high = fmax(high, at->y);
        wide = fmax(wide, at->x);
        area += part;
        moment += part * (y + next_y) / 3;
    }
    *size = (struct point){wide, (high - low) / 2};
    *centroid = outline->centre + (area != 0 ? moment / area : 0);
}

/* Where to look first: each direction, a half width away or where a neighbour has its edge. */
static void guess_edge(const struct view *view, const struct film_lens *lens,
                       const struct outline *outline, const struct outline *near, double *angles,
                       double *radii)
{
    for (size_t k = 0; k <= HALF / outline->each; k++) {
        const size_t i = k * outline->each;
        const double angle = PI * (double)i / HALF;
        struct point at = {outline->size.x * sin(angle), outline->size.y * cos(angle)};
        double uv[2];
        if (near != NULL) {
            at = (struct point){near->edge[i].x, near->edge[i].y - near->centre};
        }
        to_disc(view, lens, outline->height, (struct point){at.x, outline->centre + at.y}, uv);
        edge_polar(&view->frame, uv, 0, &angles[k], &radii[k]);
    }
}

/* The edge as seen in a disc; does the disc itself end some of it? */
static bool look_within(const struct view *view, const struct film_lens *lens,
                        const struct outline *near, struct outline *outline)
{
    double angles[HALF + 1], radii[HALF + 1];
    struct edge edges[HALF + 1];
    bool fills = false;
    guess_edge(view, lens, outline, near, angles, radii);
    const struct edge_directions directions = {view->frame, angles, near != NULL ? radii : NULL,
                                               HALF / outline->each + 1, 0};
    edges_find(&view->margins, &directions, roughly, edges);
    for (size_t k = 0; k <= HALF / outline->each; k++) {
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
static bool look(const struct search *search, size_t wavelength, const struct outline *near,
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
        fills = !is_dark && look_within(&view, search->lens, near, outline);
        arena_reset(search->arena, mark);
        if (is_dark) {
            return false;
        }
    }
    return true;
}

/* A centre and a size from nothing; false: all is dark. */
static bool find_middle(const struct search *search, size_t wavelength, struct outline *outline)
{
    const struct film_lens *lens = search->lens;
    const struct arena_mark mark = arena_mark(search->arena);
    struct star *star = ARENA_NEW(search->arena, struct star);
    struct view view;
    outline->centre = 0;
    outline->size = (struct point){0.1, 0.1};
    open_view(search, wavelength, outline, 1, &view);
    const struct clear_guess guess =
        clear_guess_of(lens->systems[wavelength], &view.beam, lens->first);
    view.disc.origin[0] = guess.centre[0];
    view.disc.origin[1] = guess.centre[1];
    view.disc.axes[0] = view.disc.axes[3] = around * guess.radius;
    const bool found = star_find(&view.margins, &view.probe, search->arena, star);
    if (found) {
        const double *centre = star->frame.centre;
        double uv[2], low = INFINITY, high = 0;
        for (size_t i = 0; i < star->count; i++) {
            low = fmin(low, star->edges[i].radius);
            high = fmax(high, star->edges[i].radius);
        }
        outline->centre = from_disc(&view, centre).y;
        edge_point(&star->frame, 0, (low + high) / 2, uv);
        const double size = fabs(from_disc(&view, uv).y - outline->centre);
        outline->size = (struct point){size, size};
    }
    arena_reset(search->arena, mark);
    return found;
}

/* The outline at its height: about the centre it has, if that is clear. */
static void find_outline(const struct search *search, size_t wavelength, const struct outline *near,
                         struct outline *outline)
{
    outline->is_empty =
        !(near != NULL && look(search, wavelength, near, outline)) &&
        !(find_middle(search, wavelength, outline) && look(search, wavelength, NULL, outline));
}

/* -------- over the film -------- */

static bool is_lit(const struct search *search, double height)
{
    struct outline outline = {.height = height, .each = 1};
    return find_middle(search, 0, &outline);
}

/* How far from the axis light arrives. */
static double find_largest(const struct search *search)
{
    double lit = 0, dark = search->lens->reach;
    if (is_lit(search, dark)) {
        return dark;
    }
    if (!is_lit(search, 0)) {
        return 0;
    }
    for (int turn = 0; turn < BISECTIONS; turn++) {
        const double middle = (lit + dark) / 2;
        *(is_lit(search, middle) ? &lit : &dark) = middle;
    }
    return dark;
}

/* Centre and size of what comes a share of a step after two outlines. */
static void foresee(const struct outline *last, const struct outline *before, double share,
                    struct outline *here)
{
    struct point ignored;
    double middle, earlier;
    measure(last, &here->size, &middle);
    here->centre = middle;
    if (before != NULL) {
        measure(before, &ignored, &earlier);
        here->centre += share * (middle - earlier);
    }
}

/* All outlines of the wavelength that is followed, each from those before it that are kept. */
static struct outline *follow(const struct search *search, double largest)
{
    struct outline *all = ARENA_ARRAY(search->arena, LOOKS, struct outline);
    for (size_t i = 0; i < LOOKS; i++) {
        const size_t kept = i > 0 ? (i - 1) / 2 * 2 : 0;
        const struct outline *near = i > 0 && !all[kept].is_empty ? &all[kept] : NULL;
        const struct outline *before = kept > 1 && near != NULL ? near - 2 : NULL;
        const double rest = 1 - (double)i / (LOOKS - 1);
        all[i] = (struct outline){.height = largest * (1 - rest * rest),
                                  .asks_hole = i % HOLE_LOOKS == 0,
                                  .each = i % 2 == 0 ? 1 : 2};
        if (near != NULL) {
            before = before != NULL && before->is_empty ? NULL : before;
            foresee(near, before, i % 2 == 0 ? 1 : 0.5, &all[i]);
        }
        find_outline(search, 0, near, &all[i]);
    }
    return all;
}

/* Another wavelength, at the distances that are kept, each from its outline at the first. */
static struct outline *accompany(const struct search *search, size_t wavelength,
                                 const struct outline *first)
{
    struct outline *all = ARENA_ARRAY(search->arena, LOOKS, struct outline);
    for (size_t i = 0; i < LOOKS; i++) {
        all[i].is_empty = true;
        if (i % 2 == 0) {
            const struct outline *near = first[i].is_empty ? NULL : &first[i];
            all[i] = (struct outline){.height = first[i].height,
                                      .centre = first[i].centre,
                                      .size = first[i].size,
                                      .asks_hole = first[i].asks_hole,
                                      .each = 2};
            find_outline(search, wavelength, near, &all[i]);
        }
    }
    return all;
}

/* -------- polygons -------- */

static struct point corner_of(const double *const corners[2], size_t row, size_t k)
{
    const size_t i = row * FILM_CORNERS + k;
    return (struct point){corners[0][i], corners[1][i]};
}

/* Half way between the corners of two rows, or those of one. */
static struct point middle_of(const double *const corners[2], size_t row, size_t next, size_t k)
{
    const struct point a = corner_of(corners, row, k), b = corner_of(corners, next, k);
    return (struct point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/*
 * How far out a point is, in a sector from a centre whose other corners are a and b: 1 on the line
 * through them; NaN outside of the sector.
 */
static double depth_in(struct point at, struct point a, struct point b)
{
    const double whole = a.x * b.y - a.y * b.x;
    const double of_a = (at.x * b.y - at.y * b.x) / whole;
    const double of_b = (a.x * at.y - a.y * at.x) / whole;
    return of_a > -1e-9 && of_b > -1e-9 ? of_a + of_b : (double)NAN;
}

static void stretch(double *const corners[2], double centre, size_t row, size_t k, double by)
{
    const size_t i = row * FILM_CORNERS + k;
    corners[0][i] *= by;
    corners[1][i] = centre + (corners[1][i] - centre) * by;
}

/* A polygon, and what it has to lie outside of, or inside. */
struct fit {
    const struct film_region *region;
    double *const *corners;
    size_t row, next; /* the same, or neighbours */
    bool is_hole;
};

/* Stretch the sector that a point lies in, if it lies there wrongly. */
static void fit_point(const struct fit *fit, struct point at, size_t about)
{
    const double *const corners[2] = {fit->corners[0], fit->corners[1]};
    const double *centres = fit->region->centre;
    const double centre = (centres[fit->row] + centres[fit->next]) / 2;
    enum { NEIGHBOURS = 3 };
    const size_t from = about > NEIGHBOURS ? about - NEIGHBOURS : 0;
    at.y -= centre;
    for (size_t k = from; k < FILM_SECTORS / 2 && k <= about + NEIGHBOURS; k++) {
        struct point a = middle_of(corners, fit->row, fit->next, k);
        struct point b = middle_of(corners, fit->row, fit->next, k + 1);
        a.y -= centre;
        b.y -= centre;
        const double depth = depth_in(at, a, b);
        if (fit->is_hole ? depth < 1 : depth > 1) {
            for (size_t j = k; j <= k + 1; j++) {
                stretch(fit->corners, centres[fit->row], fit->row, j, depth);
                if (fit->next != fit->row) {
                    stretch(fit->corners, centres[fit->next], fit->next, j, depth);
                }
            }
        }
    }
}

static void fit_outline(const struct fit *fit, const struct outline *outline)
{
    if (outline->is_empty || (fit->is_hole && !outline->has_hole)) {
        return;
    }
    for (size_t i = 0; i <= HALF && !fit->is_hole; i += outline->each) {
        fit_point(fit, outline->edge[i], i / EACH);
    }
    for (size_t k = 0; k <= FILM_SECTORS / 2 && fit->is_hole; k++) {
        fit_point(fit, outline->hole[k], k);
    }
}

/* Corners on the edge; those of a row that is dark from the row before it. */
static void start_row(const struct outline *all, size_t row, struct film_region *region)
{
    const struct outline *outline = &all[2 * row];
    double *centre = &region->centre[row];
    const bool goes_on = outline->is_empty && row > 1;
    *centre = goes_on ? 2 * centre[-1] - centre[-2] : outline->centre;
    for (size_t k = 0; k <= FILM_SECTORS / 2; k++) {
        double *x = &region->outer[0][row * FILM_CORNERS + k];
        double *y = &region->outer[1][row * FILM_CORNERS + k];
        *x = goes_on ? x[-FILM_CORNERS] : outline->edge[EACH * k].x;
        *y = goes_on ? *centre + y[-FILM_CORNERS] - centre[-1] : outline->edge[EACH * k].y;
    }
}

/* Corners on the edge of a hole, between the two outlines that tell of it. */
static void start_hole(const struct outline *all, size_t row, struct film_region *region)
{
    const size_t low = row / HOLE_ROWS * HOLE_LOOKS;
    const size_t high =
        low + HOLE_LOOKS < LOOKS && all[low + HOLE_LOOKS].has_hole ? low + HOLE_LOOKS : low;
    const double share = (double)(row % HOLE_ROWS) / HOLE_ROWS;
    for (size_t k = 0; k <= FILM_SECTORS / 2; k++) {
        const struct point a = all[low].hole[k], b = all[high].hole[k];
        region->inner[0][row * FILM_CORNERS + k] = a.x + share * (b.x - a.x);
        region->inner[1][row * FILM_CORNERS + k] = a.y + share * (b.y - a.y);
    }
}

/* Until they hold the outlines of all wavelengths. */
static void fit_rows(struct outline *const *all, size_t wavelengths, bool is_hole,
                     const struct film_region *region)
{
    double *const *corners = is_hole ? region->inner : region->outer;
    for (size_t i = 0; i < LOOKS; i++) {
        const struct fit fit = {region, corners, i / 2, (i + 1) / 2, is_hole};
        for (size_t w = 0; w < wavelengths; w++) {
            fit_outline(&fit, &all[w][i]);
        }
    }
    for (size_t row = 0; row < FILM_RADII; row++) {
        for (size_t k = 0; k <= FILM_SECTORS / 2; k++) {
            stretch(corners, region->centre[row], row, k, is_hole ? shrunk : grown);
        }
        for (size_t k = FILM_SECTORS / 2 + 1; k <= FILM_SECTORS; k++) {
            const size_t i = row * FILM_CORNERS, other = FILM_SECTORS - k;
            corners[0][i + k] = -corners[0][i + other];
            corners[1][i + k] = corners[1][i + other];
        }
    }
}

/* Of all outlines that are asked and not dark, each has one. */
static bool have_holes(struct outline *const *all, size_t wavelengths)
{
    bool has = true;
    for (size_t w = 0; w < wavelengths; w++) {
        for (size_t i = 0; i < LOOKS; i += HOLE_LOOKS) {
            has = has && all[w][i].has_hole;
        }
    }
    return has;
}

bool film_region_open(const struct film_lens *lens, struct arena *arena, struct film_region *region,
                      struct error *error)
{
    const struct search search = {lens, arena};
    if (!lens_is_round(lens->systems[0]->lens)) {
        return fail(error, ERROR_DOMAIN,
                    "the lens is not the same all around its axis, which photographs need so far");
    }
    if (!(fabs(lens->film) > 0 && isfinite(lens->film))) {
        return fail(error, ERROR_DOMAIN, "the film lies %s",
                    lens->film == 0 ? "in the last vertex" : "at infinity");
    }
    *region = (struct film_region){.film = lens->film,
                                   .index = lens->systems[0]->index_first,
                                   .largest = find_largest(&search)};
    if (region->largest == 0) {
        return true;
    }
    region->per_mm = 1 / region->largest;
    struct outline **all = ARENA_ARRAY(arena, lens->count, struct outline *);
    for (size_t w = 0; w < lens->count; w++) {
        all[w] = w == 0 ? follow(&search, region->largest) : accompany(&search, w, all[0]);
    }
    region->has_hole = have_holes(all, lens->count);
    region->centre = ARENA_ARRAY(arena, FILM_RADII, double);
    for (int k = 0; k < 2; k++) {
        region->outer[k] = ARENA_ARRAY(arena, FILM_RADII * FILM_CORNERS, double);
        region->inner[k] = ARENA_ARRAY(arena, FILM_RADII * FILM_CORNERS, double);
    }
    for (size_t row = 0; row < FILM_RADII; row++) {
        start_row(all[0], row, region);
        if (region->has_hole) {
            start_hole(all[0], row, region);
        }
    }
    fit_rows(all, lens->count, false, region);
    if (region->has_hole) {
        const struct outline *axis = &all[0][0];
        region->ratio = axis->hole[FILM_SECTORS / 4].x / axis->edge[HALF / 2].x;
        fit_rows(all, lens->count, true, region);
    }
    return true;
}
