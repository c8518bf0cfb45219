/* camera/film/exit_pupil_bounds.c - the rows of a region, and the polygons that stand there. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/exit_pupil_bounds.h"

#include "camera/film/bounds_builder.h"
#include "camera/film/bounds_fit.h"
#include "optics/aperture.h"

#include <math.h>
#include <stdlib.h>

/* -------- the pole -------- */

/* A lit point of the film, the middle of it if it is one: the pole. */
static bool find_pole(const struct bounds_builder *building)
{
    enum { SIDE = 7 };
    const double reach = building->search.lens->reach;
    double *pole = building->region->pole;
    struct pupil_outline outline = film_building_outline(building, 0, 0);
    bool is_lit = outline_discover(&building->search, 0, &outline);
    for (int ring = 1; ring <= SIDE / 2 && !is_lit && !building->is_round; ring++) {
        for (int i = 0; i < SIDE * SIDE && !is_lit; i++) {
            const int x = i % SIDE - SIDE / 2, y = i / SIDE - SIDE / 2;
            if ((abs(x) > abs(y) ? abs(x) : abs(y)) == ring) {
                pole[0] = reach * 2 * x / SIDE;
                pole[1] = reach * 2 * y / SIDE;
                outline = film_building_outline(building, 0, 0);
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
static void choose_turning(const struct bounds_builder *building)
{
    struct pupil_outline pole = film_building_outline(building, 0, 0);
    pupil_outline_find(&building->search, 0, NULL, &pole);
    building->region->turns = building->is_round || bounds_fit_is_smooth(&pole);
}

/* -------- the region -------- */

static void allocate(const struct film_lens *lens, struct arena *arena,
                     struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t nodes = exit_pupil_bounds_nodes(region);
    for (int k = 0; k < 2; k++) {
        region->centre[k] = ARENA_ARRAY(arena, nodes, double);
        region->outer[k] = ARENA_ARRAY(arena, nodes * FILM_CORNERS, double);
        region->inner[k] = ARENA_ARRAY(arena, nodes * FILM_CORNERS, double);
    }
    building->ends = ARENA_ARRAY(arena, FILM_COLUMNS + 1, double);
    building->nodes = ARENA_ARRAY(arena, nodes, struct pupil_outline);
    region->ends = building->ends;
    building->search = (struct pupil_outline_search){lens, arena, region->tangent};
}

/* How far a node lies from one to another, as seen from the pole. */
static double bounds_share_of(const struct bounds_builder *building,
                              const struct pupil_outline *node, const struct pupil_outline *from,
                              const struct pupil_outline *to)
{
    const double *pole = building->region->pole;
    const double here = hypot(node->place.x - pole[0], node->place.y - pole[1]);
    const double low = hypot(from->place.x - pole[0], from->place.y - pole[1]);
    const double high = hypot(to->place.x - pole[0], to->place.y - pole[1]);
    return high > low ? (here - low) / (high - low) : 0;
}

/* Corners on the edges. */
static void exit_pupil_bounds_start_all(const struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t nodes = film_building_nodes(building), rows = (size_t)region->rows;
    for (size_t i = 0; i < nodes; i++) {
        const size_t row = i % rows, low = i - row % FOLLOW_HOLE_ROWS;
        const size_t high =
            row - row % FOLLOW_HOLE_ROWS + FOLLOW_HOLE_ROWS < rows ? low + FOLLOW_HOLE_ROWS : low;
        bounds_fit_start(region, &building->nodes[i], row, i);
        if (region->has_hole) {
            const struct pupil_outline *a = &building->nodes[low], *b = &building->nodes[high];
            bounds_fit_start_hole(region, a, b,
                                  bounds_share_of(building, &building->nodes[i], a, b), i);
        }
    }
}

/* By how much the middle of the pupil moves in a column, per mm: x, or y. */
static double bounds_slope_of(const struct bounds_builder *building, size_t column, bool of_x)
{
    const size_t rows = (size_t)building->region->rows;
    const struct pupil_outline *pole = &building->nodes[column * rows];
    const struct pupil_outline *far = film_building_lit(building, column * rows + rows / 2);
    struct pupil_outline a, b; /* only their centres are */
    if (far == NULL || far == pole) {
        return 0;
    }
    pupil_outline_foresee(pole, NULL, 0, &a);
    pupil_outline_foresee(far, NULL, 0, &b);
    const double way = of_x ? b.centre.x - a.centre.x : b.centre.y - a.centre.y;
    return way / film_building_height(building, (double)column, (double)((size_t)(far - pole)));
}

/* Both coordinates side by side. */
static const double *bounds_pack(double *const places[2], size_t count, struct arena *arena)
{
    double *packed = ARENA_ARRAY(arena, 2 * count, double);
    for (size_t i = 0; i < count; i++) {
        packed[2 * i] = places[0][i];
        packed[2 * i + 1] = places[1][i];
    }
    return packed;
}

static void exit_pupil_bounds_build(struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t columns = building->columns, rows = (size_t)region->rows;
    for (size_t c = 0; c < columns; c++) {
        bounds_follow_column(building, c);
    }
    const bool by_half = columns < FILM_COLUMNS && !region->turns;
    for (size_t i = 0; i < rows && region->is_grid; i++) {
        const struct pupil_outline *first = &building->nodes[i];
        building->nodes[columns * rows + i] = by_half ? pupil_outline_turned(first) : *first;
    }
    /* of all outlines that are asked each has one */
    const size_t nodes = film_building_nodes(building);
    bool has = true;
    for (size_t i = 0; i < nodes; i++) {
        has = has && (building->nodes[i].has_hole || !building->nodes[i].asks_hole);
    }
    region->has_hole = has;
    if (region->is_grid && region->turns) {
        for (size_t c = 0; c < building->columns; c++) {
            region->slope[1] += bounds_slope_of(building, c, false) / (double)building->columns;
        }
    } else if (region->is_grid) {
        region->slope[0] = bounds_slope_of(building, 0, true);
        region->slope[1] = bounds_slope_of(building, FILM_COLUMNS / 4, false);
    }
    exit_pupil_bounds_start_all(building);
    for (size_t i = 0; i < film_building_nodes(building); i++) {
        bounds_fit(region, &(struct film_nodes){{i}, 1}, &building->nodes[i]);
    }
    bounds_follow_between(building);
}

/* The columns that repeat others: the first of those, and the one after the last, hold both. */
static void exit_pupil_bounds_repeat(const struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t rows = (size_t)region->rows, looked = building->columns * rows;
    if (building->columns == FILM_COLUMNS || !region->is_grid) {
        return;
    }
    for (size_t i = 0; i < rows; i++) {
        bounds_fit_unite(region, i, looked + i);
    }
    for (size_t i = looked; i < exit_pupil_bounds_nodes(region); i++) {
        bounds_fit_copy(region, i - looked, i);
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

double exit_pupil_bounds_end(const struct exit_pupil_bounds *region, double x, double y)
{
    const double share = x / (fabs(x) + fabs(y));
    const double turn = (y >= 0 ? 1 - share : 3 + share) * FILM_COLUMNS / 4;
    const int column = (int)fmin(turn, FILM_COLUMNS - 1);
    const double *ends = &region->ends[column];
    return ends[0] + (turn - column) * (ends[1] - ends[0]);
}

bool exit_pupil_bounds_open(const struct film_lens *lens, struct arena *arena,
                            struct exit_pupil_bounds *region, struct error *error)
{
    const bool is_round = lens_is_round(lens->systems[0]->lens);
    struct bounds_builder building = {.region = region, .is_round = is_round};
    if (!(fabs(lens->film) > 0 && isfinite(lens->film))) {
        return fail(error, ERROR_DOMAIN, "the film lies %s",
                    lens->film == 0 ? "in the last vertex" : "at infinity");
    }
    *region = (struct exit_pupil_bounds){.film = lens->film,
                                         .index = lens->systems[0]->index_first,
                                         .is_grid = !is_round,
                                         .rows = is_round ? FILM_RADII : FILM_GRID_RADII};
    allocate(lens, arena, &building);
    if (!find_pole(&building)) {
        return true;
    }
    choose_turning(&building);
    /* is the lens the same when it is turned by half a turn? */
    bool is_same = true;
    for (size_t i = 0; i < lens->systems[0]->lens->surface_count; i++) {
        const struct surface *surface = &lens->systems[0]->lens->surfaces[i];
        is_same = is_same && surface->decentre == NULL && surface->coordinate_break == NULL;
        for (size_t k = 0; k < surface->aperture_count; k++) {
            is_same = is_same && is_even(&surface->apertures[k]);
        }
    }
    const bool repeats = region->pole[0] == 0 && region->pole[1] == 0 && is_same;
    if (is_round) {
        building.columns = 1;
    } else if (repeats) {
        building.columns = FILM_COLUMNS / 2;
    } else {
        building.columns = FILM_COLUMNS;
    }
    if (!bounds_extent_find(&building, error)) {
        return false;
    }
    exit_pupil_bounds_build(&building);
    bounds_follow_waves(&building);
    exit_pupil_bounds_repeat(&building);
    if (region->has_hole) {
        const struct pupil_outline *pole = &building.nodes[0];
        const size_t side = pupil_outline_sectors(pole) / (is_round ? 2 : 4);
        region->ratio =
            fabs((pole->hole[side].x - pole->centre.x) /
                 (pole->edge[PUPIL_OUTLINE_STEPS / (is_round ? 2 : 4)].x - pole->centre.x));
    }
    bounds_fit_finish(region, is_round);
    const size_t nodes = exit_pupil_bounds_nodes(region);
    region->centre_xy = bounds_pack(region->centre, nodes, arena);
    region->outer_xy = bounds_pack(region->outer, nodes * FILM_CORNERS, arena);
    region->inner_xy =
        region->has_hole ? bounds_pack(region->inner, nodes * FILM_CORNERS, arena) : NULL;
    region->per_mm = 1 / region->ends[0];
    return true;
}
