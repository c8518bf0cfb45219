/* camera/film/bounds_builder.c - places of the film by column and row. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/bounds_builder.h"

#include <math.h>

size_t film_building_nodes(const struct bounds_builder *building)
{
    const struct exit_pupil_bounds *region = building->region;
    return (size_t)region->rows * (building->columns + (region->is_grid ? 1 : 0));
}

double film_building_height(const struct bounds_builder *building, double column, double row)
{
    const size_t low = (size_t)column;
    const double *ends = building->ends, f = column - (double)low;
    const double end = f > 0 ? ends[low] + f * (ends[low + 1] - ends[low]) : ends[low];
    const double rest = 1 - row / (building->region->rows - 1);
    return end * (1 - rest * rest);
}

const struct pupil_outline *film_building_lit(const struct bounds_builder *building, size_t node)
{
    const size_t rows = (size_t)building->region->rows;
    const struct pupil_outline *all = building->nodes;
    size_t i = node;
    for (; all[i].is_empty && i % rows > 0; i--) {
    }
    return all[i].is_empty ? NULL : &all[i];
}

/* Outwards in a column; halves lie between two. */
static void direct(const struct bounds_builder *building, double column, double way[2])
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

struct pupil_outline film_building_outline(const struct bounds_builder *building, double column,
                                           double height)
{
    struct pupil_outline outline = {.is_half = building->is_round, .each = 1};
    struct film_place *place = &outline.place;
    double way[2];
    direct(building, column, way);
    place->x = building->region->pole[0] + height * way[0];
    place->y = building->region->pole[1] + height * way[1];
    place->up[0] = building->region->turns ? way[0] : 0;
    place->up[1] = building->region->turns ? way[1] : 1;
    return outline;
}
