/* camera/film/bounds_follow.c - edges of pupils, each found from that of a place beside it. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/bounds_follow.h"

#include "camera/film/bounds_fit.h"
#include "camera/film/pupil_outline.h"

#include <math.h>

/* In a column the way on is known from the rows before; to another one the slope tells it. */
static void move_by_slope(const struct exit_pupil_bounds *region, const struct pupil_outline *near,
                          struct pupil_outline *here)
{
    if (region->slope[0] == 0 && region->slope[1] == 0) {
        return;
    }
    const struct pupil_outline_point zero = {0, 0};
    pupil_outline_foresee(near, NULL, 0, here);
    const struct pupil_outline_point from =
        exit_pupil_bounds_reduced(region, &near->place, here->centre);
    const struct pupil_outline_point to = exit_pupil_bounds_reduced(region, &here->place, zero);
    here->centre = (struct pupil_outline_point){from.x - to.x, from.y - to.y};
}

/* An outline that goes on from a node, by a share of a row; the first goes towards the next. */
static void find_next(const struct bounds_builder *building, size_t wavelength,
                      const struct pupil_outline *near, double share, struct pupil_outline *here)
{
    const size_t rows = (size_t)building->region->rows;
    if (near != NULL) {
        const bool is_first = (size_t)(near - building->nodes) % rows == 0;
        const struct pupil_outline *other = is_first ? near + 1 : near - 1;
        pupil_outline_foresee(near, other->is_empty ? NULL : other, is_first ? -share : share,
                              here);
        move_by_slope(building->region, near, here);
    }
    pupil_outline_find(&building->search, wavelength, near, here);
}

/*
 * The outline of a column's second row, where the pupil may be far from where the pole sees it: in
 * shorter steps, if a long one finds nothing.
 */
static void leave_pole(const struct bounds_builder *building, double column,
                       const struct pupil_outline *pole, struct pupil_outline *here)
{
    enum { HALVES = 10 };
    struct pupil_outline seen[2] = {*pole, *pole};
    const double height = film_building_height(building, column, 1);
    double from = 0, before = 0, stride = height;
    for (int halves = 0; from < height && halves < HALVES;) {
        const double to = fmin(from + stride, height);
        struct pupil_outline next = film_building_outline(building, column, to);
        next.asks_hole = here->asks_hole;
        next.each = here->each;
        pupil_outline_foresee(&seen[1], &seen[0], from > 0 ? (to - from) / (from - before) : 0,
                              &next);
        pupil_outline_find(&building->search, 0, &seen[1], &next);
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

void bounds_follow_column(const struct bounds_builder *building, size_t column)
{
    const size_t rows = (size_t)building->region->rows;
    const bool is_known = column > 0 && !building->region->turns;
    building->nodes[column * rows] = building->nodes[0]; /* the pole, in the same frame */
    for (size_t i = is_known ? 1 : 0; i < rows; i++) {
        const size_t node = column * rows + i;
        struct pupil_outline *here = &building->nodes[node];
        const struct pupil_outline *near = i > 0 ? film_building_lit(building, node - 1) : NULL;
        *here = film_building_outline(building, (double)column,
                                      film_building_height(building, (double)column, (double)i));
        here->asks_hole = i % FOLLOW_HOLE_ROWS == 0;
        here->each = building->is_round ? 2 : 1;
        if (i == 1 && near != NULL) {
            leave_pole(building, (double)column, near, here);
        } else {
            find_next(building, 0, near, 1, here);
        }
    }
}

/* Look from a place between nodes, and make them contain what is seen there. */
static void look_between(const struct bounds_builder *building, double column, double row,
                         const struct film_nodes *nodes)
{
    const size_t node = nodes->of[0], wavelengths = building->search.lens->count;
    const struct pupil_outline *near = film_building_lit(building, node);
    const double height = film_building_height(building, column, row);
    const size_t turn = 4 * node + nodes->count + (column > floor(column));
    struct pupil_outline_point lit[OUTLINE_SCATTER];
    struct pupil_outline here = {.is_empty = true};
    for (size_t w = 0; w < wavelengths && here.is_empty && near != NULL; w++) {
        here = film_building_outline(building, column, height);
        here.each = 2;
        /* with columns the wavelengths take turns */
        find_next(building, building->is_round ? w : (turn + w) % wavelengths, near,
                  row - floor(row), &here);
    }
    if (near == NULL) {
        return;
    }
    if (here.is_empty) {
        pupil_outline_foresee(near, NULL, 0, &here);
    }
    bounds_fit(building->region, nodes, &here);
    const size_t rows = (size_t)building->region->rows;
    const bool is_near_end = 4 * (node % rows) >= 3 * rows;
    if (!is_near_end && (building->is_round ? node % 4 > 0 : nodes->count < 4)) {
        return;
    }
    const size_t count = outline_scatter(&building->search, turn % wavelengths, &here, turn, lit);
    bounds_fit_points(building->region, nodes, &here, lit, count);
}

void bounds_follow_between(const struct bounds_builder *building)
{
    const struct exit_pupil_bounds *region = building->region;
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
static bool is_asked(const struct bounds_builder *building, size_t row)
{
    const size_t rows = (size_t)building->region->rows;
    return !building->is_round || row % 2 == 0 || 2 * row >= rows;
}

/* Another wavelength, at the rows themselves, each from its outline at the first. */
static void accompany(const struct bounds_builder *building, size_t wavelength, bool *has_hole)
{
    const size_t nodes = film_building_nodes(building);
    for (size_t i = 0; i < nodes; i++) {
        if (!is_asked(building, i)) {
            continue;
        }
        const struct pupil_outline *first = &building->nodes[i],
                                   *near = film_building_lit(building, i);
        if (near == NULL) {
            continue;
        }
        struct pupil_outline here = {.place = first->place,
                                     .is_half = first->is_half,
                                     .centre = near->centre,
                                     .size = near->size,
                                     .asks_hole = first->asks_hole,
                                     .each = first->is_half || !first->asks_hole ? 2 : 1};
        pupil_outline_find(&building->search, wavelength, near, &here);
        bounds_fit(building->region, &(struct film_nodes){{i}, 1}, &here);
        *has_hole = *has_hole && (here.has_hole || !here.asks_hole);
    }
}

void bounds_follow_waves(const struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t rows = (size_t)region->rows;
    const struct film_radii before =
        bounds_fit_radii(region, film_building_nodes(building), building->search.arena);
    bool has_hole = region->has_hole;
    for (size_t w = 1; w < building->search.lens->count; w++) {
        accompany(building, w, &has_hole);
    }
    region->has_hole = has_hole;
    for (size_t i = 0; i < rows; i++) {
        if (!is_asked(building, i)) {
            bounds_fit_follow(region, &before, i);
        }
    }
}
