/* camera/film_region.c - edges of pupils followed over the film, and polygons about them. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_region.h"

#include "camera/film_ends.h"
#include "camera/film_fit.h"
#include "camera/film_search.h"
#include "optics/aperture.h"

#include <math.h>
#include <stdlib.h>

/* Holes change little from one row to the next: so many rows apart. */
enum { HOLE_ROWS = 4 };

/* -------- places of the film -------- */

/* Rows of the columns that are looked at, and of the first again. */
static size_t nodes_of(const struct film_building *building)
{
    const struct film_region *region = building->region;
    return (size_t)region->rows * (building->columns + (region->is_grid ? 1 : 0));
}

/* How far from the pole a row is, or what lies between two. */
static double height_of(const struct film_building *building, double column, double row)
{
    const size_t low = (size_t)column;
    const double *ends = building->ends, f = column - (double)low;
    const double end = f > 0 ? ends[low] + f * (ends[low + 1] - ends[low]) : ends[low];
    const double rest = 1 - row / (building->region->rows - 1);
    return end * (1 - rest * rest);
}

/* -------- the pole -------- */

/* A lit point of the film, the middle of it if it is one: the pole. */
static bool find_pole(const struct film_building *building)
{
    enum { SIDE = 7 };
    const double reach = building->search.lens->reach;
    double *pole = building->region->pole;
    struct outline outline = film_outline_at(building, 0, 0);
    bool is_lit = outline_discover(&building->search, 0, &outline);
    for (int ring = 1; ring <= SIDE / 2 && !is_lit && !building->is_round; ring++) {
        for (int i = 0; i < SIDE * SIDE && !is_lit; i++) {
            const int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2;
            if ((abs(x) > abs(y) ? abs(x) : abs(y)) == ring) {
                pole[0] = reach * 2 * x / SIDE;
                pole[1] = reach * 2 * y / SIDE;
                outline = film_outline_at(building, 0, 0);
                is_lit = outline_discover(&building->search, 0, &outline);
            }
        }
    }
    return is_lit;
}

/*
 * Cat's eyes turn with the place on the film, but a polygon in the stop does not: if there are
 * corners in the middle, they stay where they are.
 */
static void choose_turning(const struct film_building *building)
{
    struct outline pole = film_outline_at(building, 0, 0);
    outline_find(&building->search, 0, NULL, &pole);
    building->region->turns = building->is_round || film_fit_is_smooth(&pole);
}

/* -------- edges -------- */

/* The last lit node of a column up to one; null: none is. */
static const struct outline *lit_before(const struct film_building *building, size_t node)
{
    const size_t rows = (size_t)building->region->rows;
    const struct outline *all = building->nodes;
    size_t i = node;
    for (; all[i].is_empty && i % rows > 0; i--) {
    }
    return all[i].is_empty ? NULL : &all[i];
}

/* In a column the way on is known from the rows before; to another one the slope tells it. */
static void move_by_slope(const struct film_region *region, const struct outline *near,
                          struct outline *here)
{
    if (region->slope[0] == 0 && region->slope[1] == 0) {
        return;
    }
    const struct outline_point zero = {0, 0};
    outline_foresee(near, NULL, 0, here);
    const struct outline_point from = film_region_reduced(region, &near->place, here->centre);
    const struct outline_point to = film_region_reduced(region, &here->place, zero);
    here->centre = (struct outline_point){from.x - to.x, from.y - to.y};
}

/* An outline that goes on from a node, by a share of a row; the first goes towards the next. */
static void find_next(const struct film_building *building, size_t wavelength,
                      const struct outline *near, double share, struct outline *here)
{
    const size_t rows = (size_t)building->region->rows;
    if (near != NULL) {
        const bool is_first = (size_t)(near - building->nodes) % rows == 0;
        const struct outline *other = is_first ? near + 1 : near - 1;
        outline_foresee(near, other->is_empty ? NULL : other, is_first ? -share : share, here);
        move_by_slope(building->region, near, here);
    }
    outline_find(&building->search, wavelength, near, here);
}

/*
 * The outline of a column's second row, where the pupil may be far from where the pole sees it: in
 * shorter steps, if a long one finds nothing.
 */
static void leave_pole(const struct film_building *building, double column,
                       const struct outline *pole, struct outline *here)
{
    enum { HALVES = 10 };
    struct outline seen[2] = {*pole, *pole};
    const double height = height_of(building, column, 1);
    double from = 0, before = 0, stride = height;
    for (int halves = 0; from < height && halves < HALVES;) {
        const double to = fmin(from + stride, height);
        struct outline next = film_outline_at(building, column, to);
        next.asks_hole = here->asks_hole;
        next.each = here->each;
        outline_foresee(&seen[1], &seen[0], from > 0 ? (to - from) / (from - before) : 0, &next);
        outline_find(&building->search, 0, &seen[1], &next);
        if (next.is_empty) {
            stride /= 2;
            halves++;
        } else {
            seen[0] = seen[1];
            seen[1] = next;
            before = from;
            from = to;
            stride *= 2;
        }
    }
    *here = seen[1];
    here->is_empty = from < height;
}

/* The outlines of a column, each from those before it. */
static void follow(const struct film_building *building, size_t column)
{
    const size_t rows = (size_t)building->region->rows;
    const bool is_known = column > 0 && !building->region->turns;
    building->nodes[column * rows] = building->nodes[0]; /* the pole, in the same frame */
    for (size_t i = is_known ? 1 : 0; i < rows; i++) {
        const size_t node = column * rows + i;
        struct outline *here = &building->nodes[node];
        const struct outline *near = i > 0 ? lit_before(building, node - 1) : NULL;
        *here = film_outline_at(building, (double)column,
                                height_of(building, (double)column, (double)i));
        here->asks_hole = i % HOLE_ROWS == 0;
        here->each = building->is_round ? 2 : 1;
        if (i == 1 && near != NULL) {
            leave_pole(building, (double)column, near, here);
        } else {
            find_next(building, 0, near, 1, here);
        }
    }
}

/* Look from a place between nodes, and make them contain what is seen there. */
static void look_between(const struct film_building *building, double column, double row,
                         const struct film_nodes *nodes)
{
    const size_t node = nodes->of[0], wavelengths = building->search.lens->count;
    const struct outline *near = lit_before(building, node);
    const double height = height_of(building, column, row);
    const size_t turn = 4 * node + nodes->count + (column > floor(column));
    struct outline_point lit[OUTLINE_SCATTER];
    struct outline here = {.is_empty = true};
    for (size_t w = 0; w < wavelengths && here.is_empty && near != NULL; w++) {
        here = film_outline_at(building, column, height);
        here.each = 2;
        /* with columns the wavelengths take turns */
        find_next(building, building->is_round ? w : (turn + w) % wavelengths, near,
                  row - floor(row), &here);
    }
    if (near == NULL) {
        return;
    }
    if (here.is_empty) {
        outline_foresee(near, NULL, 0, &here);
    }
    film_fit(building->region, nodes, &here);
    const size_t rows = (size_t)building->region->rows;
    const bool is_near_end = 4 * (node % rows) >= 3 * rows;
    if (!is_near_end && (building->is_round ? node % 4 > 0 : nodes->count < 4)) {
        return;
    }
    const size_t count = outline_scatter(&building->search, turn % wavelengths, &here, turn, lit);
    film_fit_points(building->region, nodes, &here, lit, count);
}

/* Between all rows and columns that are neighbours. */
static void look_at_all(const struct film_building *building)
{
    const struct film_region *region = building->region;
    const size_t rows = (size_t)region->rows;
    for (size_t c = 0; c < building->columns; c++) {
        for (size_t i = 0; i < rows; i++) {
            const size_t here = c * rows + i, beside = here + rows;
            const double column = (double)c, row = (double)i;
            if (i + 1 < rows) {
                look_between(building, column, row + 0.5,
                             &(struct film_nodes){{here, here + 1}, 2});
            }
            if (region->is_grid && i > 0) {
                look_between(building, column + 0.5, row, &(struct film_nodes){{here, beside}, 2});
            }
            if (region->is_grid && i + 1 < rows) {
                look_between(building, column + 0.5, row + 0.5,
                             &(struct film_nodes){{here, here + 1, beside, beside + 1}, 4});
            }
        }
    }
}

/* What wavelengths add is smooth: of a round lens every other row tells it, but near the end. */
static bool is_asked(const struct film_building *building, size_t row)
{
    const size_t rows = (size_t)building->region->rows;
    return !building->is_round || row % 2 == 0 || 2 * row >= rows;
}

/* Another wavelength, at the rows themselves, each from its outline at the first. */
static void accompany(const struct film_building *building, size_t wavelength, bool *has_hole)
{
    const size_t nodes = nodes_of(building);
    for (size_t i = 0; i < nodes; i++) {
        if (!is_asked(building, i)) {
            continue;
        }
        const struct outline *first = &building->nodes[i], *near = lit_before(building, i);
        if (near == NULL) {
            continue;
        }
        struct outline here = {.place = first->place,
                               .is_half = first->is_half,
                               .centre = near->centre,
                               .size = near->size,
                               .asks_hole = first->asks_hole,
                               .each = first->is_half || !first->asks_hole ? 2 : 1};
        outline_find(&building->search, wavelength, near, &here);
        film_fit(building->region, &(struct film_nodes){{i}, 1}, &here);
        *has_hole = *has_hole && (here.has_hole || !here.asks_hole);
    }
}

/* All other wavelengths; rows that are not asked are stretched as their neighbours are. */
static void accompany_all(const struct film_building *building)
{
    struct film_region *region = building->region;
    const size_t rows = (size_t)region->rows;
    const struct film_radii before =
        film_fit_radii(region, nodes_of(building), building->search.arena);
    bool has_hole = region->has_hole;
    for (size_t w = 1; w < building->search.lens->count; w++) {
        accompany(building, w, &has_hole);
    }
    region->has_hole = has_hole;
    for (size_t i = 0; i < rows; i++) {
        if (!is_asked(building, i)) {
            film_fit_follow(region, &before, i);
        }
    }
}

/* -------- the region -------- */

static void allocate(const struct film_lens *lens, struct arena *arena,
                     struct film_building *building)
{
    struct film_region *region = building->region;
    const size_t nodes = film_region_nodes(region);
    for (int k = 0; k < 2; k++) {
        region->centre[k] = ARENA_ARRAY(arena, nodes, double);
        region->outer[k] = ARENA_ARRAY(arena, nodes * FILM_CORNERS, double);
        region->inner[k] = ARENA_ARRAY(arena, nodes * FILM_CORNERS, double);
    }
    building->ends = ARENA_ARRAY(arena, FILM_COLUMNS + 1, double);
    building->nodes = ARENA_ARRAY(arena, nodes, struct outline);
    region->ends = building->ends;
    building->search = (struct outline_search){lens, arena, region->tangent};
}

/* Of all outlines that are asked each has one. */
static bool have_holes(const struct film_building *building)
{
    const size_t nodes = nodes_of(building);
    bool has = true;
    for (size_t i = 0; i < nodes; i++) {
        has = has && (building->nodes[i].has_hole || !building->nodes[i].asks_hole);
    }
    return has;
}

/* How far a node lies from one to another, as seen from the pole. */
static double share_of(const struct film_building *building, const struct outline *node,
                       const struct outline *from, const struct outline *to)
{
    const double *pole = building->region->pole;
    const double here = hypot(node->place.x - pole[0], node->place.y - pole[1]);
    const double low = hypot(from->place.x - pole[0], from->place.y - pole[1]);
    const double high = hypot(to->place.x - pole[0], to->place.y - pole[1]);
    return high > low ? (here - low) / (high - low) : 0;
}

/* Corners on the edges. */
static void start_all(const struct film_building *building)
{
    struct film_region *region = building->region;
    const size_t nodes = nodes_of(building), rows = (size_t)region->rows;
    for (size_t i = 0; i < nodes; i++) {
        const size_t row = i % rows, low = i - row % HOLE_ROWS;
        const size_t high = row - row % HOLE_ROWS + HOLE_ROWS < rows ? low + HOLE_ROWS : low;
        film_fit_start(region, &building->nodes[i], row, i);
        if (region->has_hole) {
            const struct outline *a = &building->nodes[low], *b = &building->nodes[high];
            film_fit_start_hole(region, a, b, share_of(building, &building->nodes[i], a, b), i);
        }
    }
}

/* By how much the middle of the pupil moves in a column, per mm: x, or y. */
static double slope_of(const struct film_building *building, size_t column, bool of_x)
{
    const size_t rows = (size_t)building->region->rows;
    const struct outline *pole = &building->nodes[column * rows];
    const struct outline *far = lit_before(building, column * rows + rows / 2);
    struct outline a, b; /* only their centres are */
    if (far == NULL || far == pole) {
        return 0;
    }
    outline_foresee(pole, NULL, 0, &a);
    outline_foresee(far, NULL, 0, &b);
    const double way = of_x ? b.centre.x - a.centre.x : b.centre.y - a.centre.y;
    return way / height_of(building, (double)column, (double)((size_t)(far - pole)));
}

static void find_slope(const struct film_building *building)
{
    struct film_region *region = building->region;
    if (region->is_grid && region->turns) {
        for (size_t c = 0; c < building->columns; c++) {
            region->slope[1] += slope_of(building, c, false) / (double)building->columns;
        }
    } else if (region->is_grid) {
        region->slope[0] = slope_of(building, 0, true);
        region->slope[1] = slope_of(building, FILM_COLUMNS / 4, false);
    }
}

/* Both coordinates side by side. */
static const double *pack(double *const places[2], size_t count, struct arena *arena)
{
    double *packed = ARENA_ARRAY(arena, 2 * count, double);
    for (size_t i = 0; i < count; i++) {
        packed[2 * i] = places[0][i];
        packed[2 * i + 1] = places[1][i];
    }
    return packed;
}

static void pack_all(struct arena *arena, struct film_region *region)
{
    const size_t nodes = film_region_nodes(region);
    region->centres = pack(region->centre, nodes, arena);
    region->outers = pack(region->outer, nodes * FILM_CORNERS, arena);
    region->inners = region->has_hole ? pack(region->inner, nodes * FILM_CORNERS, arena) : NULL;
    region->per_mm = 1 / region->ends[0];
}

static void build(struct film_building *building)
{
    struct film_region *region = building->region;
    const size_t columns = building->columns, rows = (size_t)region->rows;
    for (size_t c = 0; c < columns; c++) {
        follow(building, c);
    }
    const bool by_half = columns < FILM_COLUMNS && !region->turns;
    for (size_t i = 0; i < rows && region->is_grid; i++) {
        const struct outline *first = &building->nodes[i];
        building->nodes[columns * rows + i] = by_half ? outline_turned(first) : *first;
    }
    region->has_hole = have_holes(building);
    find_slope(building);
    start_all(building);
    for (size_t i = 0; i < nodes_of(building); i++) {
        film_fit(region, &(struct film_nodes){{i}, 1}, &building->nodes[i]);
    }
    look_at_all(building);
}

/* The columns that repeat others: the first of those, and the one after the last, hold both. */
static void repeat(const struct film_building *building)
{
    struct film_region *region = building->region;
    const size_t rows = (size_t)region->rows, looked = building->columns * rows;
    if (building->columns == FILM_COLUMNS || !region->is_grid) {
        return;
    }
    for (size_t i = 0; i < rows; i++) {
        film_fit_unite(region, i, looked + i);
    }
    for (size_t i = looked; i < film_region_nodes(region); i++) {
        film_fit_copy(region, i - looked, i);
    }
}

/* Is a shape seen to be the same when it is turned by half a turn about the vertex? */
static bool is_even(const struct aperture *aperture)
{
    const double tiny = 1e-12;
    const size_t count = aperture->point_count, half = count / 2;
    bool is = fabs(aperture->decenter[0].value.hi) + fabs(aperture->decenter[1].value.hi) <= 0 &&
              (aperture->shape != SHAPE_SPIDER || aperture->arms % 2 == 0) && count % 2 == 0;
    for (size_t i = 0; i < half && is; i++) {
        const struct figure *a = aperture->points[i], *b = aperture->points[i + half];
        const double size = fabs(a[0].value.hi) + fabs(a[1].value.hi);
        is = fabs(a[0].value.hi + b[0].value.hi) + fabs(a[1].value.hi + b[1].value.hi) <=
             tiny * size;
    }
    return is;
}

/* Is the lens the same when it is turned by half a turn? */
static bool is_symmetric(const struct lens *lens)
{
    bool is_same = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is_same = is_same && surface->decentre == NULL && surface->coordinate_break == NULL;
        for (size_t k = 0; k < surface->aperture_count; k++) {
            is_same = is_same && is_even(&surface->apertures[k]);
        }
    }
    return is_same;
}

double film_region_end(const struct film_region *region, double x, double y)
{
    const double share = x / (fabs(x) + fabs(y));
    const double turn = (y >= 0 ? 1 - share : 3 + share) * FILM_COLUMNS / 4;
    const int column = (int)fmin(turn, FILM_COLUMNS - 1);
    const double *ends = &region->ends[column];
    return ends[0] + (turn - column) * (ends[1] - ends[0]);
}

bool film_region_open(const struct film_lens *lens, struct arena *arena, struct film_region *region,
                      struct error *error)
{
    const bool is_round = lens_is_round(lens->systems[0]->lens);
    struct film_building building = {.region = region, .is_round = is_round};
    if (!(fabs(lens->film) > 0 && isfinite(lens->film))) {
        return fail(error, ERROR_DOMAIN, "the film lies %s",
                    lens->film == 0 ? "in the last vertex" : "at infinity");
    }
    *region = (struct film_region){.film = lens->film,
                                   .index = lens->systems[0]->index_first,
                                   .is_grid = !is_round,
                                   .rows = is_round ? FILM_RADII : FILM_GRID_RADII};
    allocate(lens, arena, &building);
    if (!find_pole(&building)) {
        return true;
    }
    choose_turning(&building);
    const bool repeats =
        region->pole[0] == 0 && region->pole[1] == 0 && is_symmetric(lens->systems[0]->lens);
    building.columns = is_round ? 1 : repeats ? FILM_COLUMNS / 2 : FILM_COLUMNS;
    if (!film_ends_find(&building, error)) {
        return false;
    }
    build(&building);
    accompany_all(&building);
    repeat(&building);
    if (region->has_hole) {
        const struct outline *pole = &building.nodes[0];
        const size_t side = outline_sectors(pole) / (is_round ? 2 : 4);
        region->ratio = fabs((pole->hole[side].x - pole->centre.x) /
                             (pole->edge[OUTLINE_STEPS / (is_round ? 2 : 4)].x - pole->centre.x));
    }
    film_fit_finish(region, is_round);
    pack_all(arena, region);
    return true;
}
