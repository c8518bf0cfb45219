/* camera/film_region.c - edges of pupils followed over the film, and polygons about them. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_region.h"

#include "camera/film_fit.h"

#include <math.h>
#include <stdlib.h>

/* Holes change little from one row to the next: so many rows apart. */
enum { HOLE_ROWS = 4, STRIDES = 8 };

/* Where light ends is found to a share of the film. */
static const double finest = 1e-4;

/* One lens, its region as far as it is known, and the edges at its rows. */
struct building {
    struct outline_search search;
    struct film_region *region;
    double *ends;
    struct outline *nodes; /* of the wavelength that is followed, at every row of every column */
    bool is_round;
    size_t columns; /* that are looked at: the others repeat them */
};

/* -------- places of the film -------- */

/* Rows of the columns that are looked at, and of the first again. */
static size_t nodes_of(const struct building *building)
{
    const struct film_region *region = building->region;
    return (size_t)region->rows * (building->columns + (region->is_grid ? 1 : 0));
}

/* Outwards in a column; halves lie between two. */
static void direct(const struct building *building, double column, double way[2])
{
    static const double axes[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const double turn = building->is_round ? 1 : 4 * column / FILM_COLUMNS;
    const int quarter = (int)fmin(turn, 3);
    const double f = turn - quarter;
    const double x = (1 - f) * axes[quarter][0] + f * axes[quarter + 1][0];
    const double y = (1 - f) * axes[quarter][1] + f * axes[quarter + 1][1];
    way[0] = x / hypot(x, y);
    way[1] = y / hypot(x, y);
}

/* An outline of a place that is so far from the pole; nothing of it is known. */
static struct outline outline_at(const struct building *building, double column, double height)
{
    struct outline outline = {.is_half = building->is_round, .each = 1};
    struct film_place *place = &outline.place;
    double way[2];
    direct(building, column, way);
    place->x = building->region->pole[0] + height * way[0];
    place->y = building->region->pole[1] + height * way[1];
    place->up[0] = building->region->turns ? way[0] : 0;
    place->up[1] = building->region->turns ? way[1] : 1;
    return outline;
}

/* How far from the pole a row is, or what lies between two. */
static double height_of(const struct building *building, double column, double row)
{
    const size_t low = (size_t)column;
    const double *ends = building->ends, f = column - (double)low;
    const double end = f > 0 ? ends[low] + f * (ends[low + 1] - ends[low]) : ends[low];
    const double rest = 1 - row / (building->region->rows - 1);
    return end * (1 - rest * rest);
}

/* -------- where light ends -------- */

/* What is known of a lit place. */
struct seen {
    double height;
    struct outline_point centre, size;
};

/* Is a place lit, by what two others before it are like? Then it is the last of them. */
static bool step_to(const struct building *building, size_t wavelength, double column,
                    double height, struct seen seen[2])
{
    struct outline here = outline_at(building, column, height);
    const double before = seen[1].height - seen[0].height;
    const double share = before > 0 ? (height - seen[1].height) / before : 0;
    here.centre.x = seen[1].centre.x + share * (seen[1].centre.x - seen[0].centre.x);
    here.centre.y = seen[1].centre.y + share * (seen[1].centre.y - seen[0].centre.y);
    here.size = seen[1].size;
    if (!outline_is_lit(&building->search, wavelength, &here)) {
        return false;
    }
    seen[0] = seen[1];
    seen[1] = (struct seen){height, here.centre, here.size};
    return true;
}

/* The same at any wavelength; one of them answers for long steps. */
static bool step_at_any(const struct building *building, double column, double stride,
                        double farthest, struct seen seen[2])
{
    const double height = fmin(seen[1].height + stride, farthest);
    const size_t all = stride * STRIDES < farthest ? building->search.lens->count : 1;
    bool is_lit = false;
    for (size_t w = 0; w < all && !is_lit; w++) {
        is_lit = step_to(building, w, column, height, seen);
    }
    return is_lit;
}

/* How far light arrives in a column, at most as far as is asked. */
static double find_end(const struct building *building, double column, double farthest)
{
    struct outline pole = outline_at(building, column, 0);
    if (!outline_discover(&building->search, 0, &pole)) {
        return 0;
    }
    struct seen seen[2] = {{0, pole.centre, pole.size}, {0, pole.centre, pole.size}};
    double stride = farthest / STRIDES;
    /* what a long step does not find may be lit all the same */
    while (stride > finest * farthest && seen[1].height < farthest) {
        stride *= step_at_any(building, column, stride, farthest, seen) ? 1.25 : 0.5;
    }
    return fmin(seen[1].height + stride, farthest);
}

/* A lit point of the film, the middle of it if it is one: the pole. */
static bool find_pole(const struct building *building)
{
    enum { SIDE = 7 };
    const double reach = building->search.lens->reach;
    double *pole = building->region->pole;
    struct outline outline = outline_at(building, 0, 0);
    bool is_lit = outline_discover(&building->search, 0, &outline);
    for (int ring = 1; ring <= SIDE / 2 && !is_lit && !building->is_round; ring++) {
        for (int i = 0; i < SIDE * SIDE && !is_lit; i++) {
            const int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2;
            if ((abs(x) > abs(y) ? abs(x) : abs(y)) == ring) {
                pole[0] = reach * 2 * x / SIDE;
                pole[1] = reach * 2 * y / SIDE;
                outline = outline_at(building, 0, 0);
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
static void choose_turning(const struct building *building)
{
    struct outline pole = outline_at(building, 0, 0);
    outline_find(&building->search, 0, NULL, &pole);
    building->region->turns = building->is_round || film_fit_is_smooth(&pole);
}

/* Every column ends where, or beyond where, light does, and so does what lies between them. */
static void find_ends(const struct building *building)
{
    struct film_region *region = building->region;
    double *ends = building->ends;
    const double pole = hypot(region->pole[0], region->pole[1]);
    const double farthest = building->search.lens->reach + pole;
    const size_t columns = building->columns;
    for (size_t c = 0; c < columns; c++) {
        ends[c] = find_end(building, (double)c, farthest);
    }
    if (region->is_grid) {
        ends[columns] = ends[0];
        for (size_t c = 0; c < columns; c++) {
            const double middle = (ends[c] + ends[c + 1]) / 2;
            const double end =
                middle < farthest ? find_end(building, (double)c + 0.5, farthest) : middle;
            const double by = middle > 0 ? fmax(1, 1.001 * end / middle) : 1;
            ends[c] = fmin(farthest, ends[c] * by);
            ends[c + 1] = fmin(farthest, ends[c + 1] * by);
        }
        ends[0] = fmax(ends[0], ends[columns]);
        for (size_t c = columns; c <= FILM_COLUMNS; c++) {
            ends[c] = ends[c - columns];
        }
    }
    for (size_t c = 0; c < columns; c++) {
        region->largest = fmax(region->largest, fmin(ends[c] + pole, building->search.lens->reach));
    }
}

/* -------- edges -------- */

/* The last lit node of a column up to one; null: none is. */
static const struct outline *lit_before(const struct building *building, size_t node)
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

/* An outline that goes on from a node, by a share of a row. */
static void find_next(const struct building *building, size_t wavelength,
                      const struct outline *near, double share, struct outline *here)
{
    const size_t rows = (size_t)building->region->rows;
    if (near != NULL) {
        const bool is_first = (size_t)(near - building->nodes) % rows == 0;
        outline_foresee(near, is_first || near[-1].is_empty ? NULL : near - 1, share, here);
        move_by_slope(building->region, near, here);
    }
    outline_find(&building->search, wavelength, near, here);
}

/* The outlines of a column, each from those before it. */
static void follow(const struct building *building, size_t column)
{
    const size_t rows = (size_t)building->region->rows;
    for (size_t i = 0; i < rows; i++) {
        const size_t node = column * rows + i;
        struct outline *here = &building->nodes[node];
        const struct outline *near = i > 0 ? lit_before(building, node - 1) : NULL;
        *here =
            outline_at(building, (double)column, height_of(building, (double)column, (double)i));
        here->asks_hole = i % HOLE_ROWS == 0;
        here->each = building->is_round ? 2 : 1;
        find_next(building, 0, near, 1, here);
    }
}

/* Look from a place between nodes, and make them contain what is seen there. */
static void look_between(const struct building *building, double column, double row,
                         const struct film_nodes *nodes)
{
    const size_t node = nodes->of[0], wavelengths = building->search.lens->count;
    const struct outline *near = lit_before(building, node);
    const double height = height_of(building, column, row);
    const size_t turn = 4 * node + nodes->count + (column > floor(column));
    struct outline_point lit[OUTLINE_SCATTER];
    struct outline here = {.is_empty = true};
    for (size_t w = 0; w < wavelengths && here.is_empty && near != NULL; w++) {
        here = outline_at(building, column, height);
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
static void look_at_all(const struct building *building)
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
static bool is_asked(const struct building *building, size_t row)
{
    const size_t rows = (size_t)building->region->rows;
    return !building->is_round || row % 2 == 0 || 2 * row >= rows;
}

/* Another wavelength, at the rows themselves, each from its outline at the first. */
static void accompany(const struct building *building, size_t wavelength, bool *has_hole)
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
static void accompany_all(const struct building *building)
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

static void allocate(const struct film_lens *lens, struct arena *arena, struct building *building)
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
    building->search = (struct outline_search){lens, arena};
}

/* Of all outlines that are asked each has one. */
static bool have_holes(const struct building *building)
{
    const size_t nodes = nodes_of(building);
    bool has = true;
    for (size_t i = 0; i < nodes; i++) {
        has = has && (building->nodes[i].has_hole || !building->nodes[i].asks_hole);
    }
    return has;
}

/* Corners on the edges. */
static void start_all(const struct building *building)
{
    struct film_region *region = building->region;
    const size_t nodes = nodes_of(building), rows = (size_t)region->rows;
    for (size_t i = 0; i < nodes; i++) {
        const size_t row = i % rows, low = i - row % HOLE_ROWS;
        const size_t high = row - row % HOLE_ROWS + HOLE_ROWS < rows ? low + HOLE_ROWS : low;
        film_fit_start(region, &building->nodes[i], row, i);
        if (region->has_hole) {
            film_fit_start_hole(region, &building->nodes[low], &building->nodes[high],
                                (double)(row % HOLE_ROWS) / HOLE_ROWS, i);
        }
    }
}

/* By how much the middle of the pupil moves in a column, per mm: x, or y. */
static double slope_of(const struct building *building, size_t column, bool of_x)
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

static void find_slope(const struct building *building)
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

static void build(struct building *building)
{
    struct film_region *region = building->region;
    const size_t columns = building->columns, rows = (size_t)region->rows;
    for (size_t c = 0; c < columns; c++) {
        follow(building, c);
    }
    for (size_t i = 0; i < rows && region->is_grid; i++) {
        building->nodes[columns * rows + i] = building->nodes[i];
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
static void repeat(const struct building *building)
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

/* Is the lens the same when it is turned by half a turn? Told only of those of cylinders. */
static bool is_symmetric(const struct lens *lens)
{
    bool is_same = true;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is_same = is_same && surface->decentre == NULL && surface->coordinate_break == NULL &&
                  surface->aperture_count == 0;
    }
    return is_same;
}

bool film_region_open(const struct film_lens *lens, struct arena *arena, struct film_region *region,
                      struct error *error)
{
    const bool is_round = lens_is_round(lens->systems[0]->lens);
    struct building building = {.region = region, .is_round = is_round};
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
    const bool repeats = region->turns && region->pole[0] == 0 && region->pole[1] == 0 &&
                         is_symmetric(lens->systems[0]->lens);
    building.columns = is_round ? 1 : repeats ? FILM_COLUMNS / 2 : FILM_COLUMNS;
    find_ends(&building);
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
