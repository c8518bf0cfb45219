/* camera/film/bounds_builder.c - the edges of pupils by column and row, each from one beside it. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/bounds_builder.h"

#include "base/constants.h"
#include "camera/film/bounds_fit.h"
#include "camera/film/pupil_outline.h"

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

struct pupil_outline film_building_outline(const struct bounds_builder *building, double column,
                                           double height)
{
    struct pupil_outline outline = {.is_half = building->is_round, .each = 1};
    struct film_place *place = &outline.place;
    double way[2];
    /* outwards in a column; halves lie between two */
    static const double axes[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    const double turn = building->is_round ? 1 : 4 * column / FILM_COLUMNS;
    const int quarter = (int)fmin(turn, 3);
    const double f = turn - quarter;
    const double x = (1 - f) * axes[quarter][0] + f * axes[quarter + 1][0];
    const double y = (1 - f) * axes[quarter][1] + f * axes[quarter + 1][1];
    way[0] = x / hypot(x, y);
    way[1] = y / hypot(x, y);
    place->x = building->region->pole[0] + height * way[0];
    place->y = building->region->pole[1] + height * way[1];
    place->up[0] = building->region->turns ? way[0] : 0;
    place->up[1] = building->region->turns ? way[1] : 1;
    return outline;
}

/* -------- how far light arrives -------- */

enum { STRIDES = 8 };

/* Where light ends is found to a share of the film. */
static const double finest = 1e-4;

/* From 70 degrees on directions are tangents: the sine of it. */
static const double steep = 0.94;

/* What is looked at up to which angle from the film's normal, of round lenses and others. */
static const double farthest_round = 89, farthest_other = 86;

/* What is known of a lit place. */
struct bounds_extent_seen {
    double height;
    struct pupil_outline_point centre, size;
};

/* Is a place lit, by what two others before it are like? Then it is the last of them. */
static bool step_to(const struct bounds_builder *building, size_t wavelength, double column,
                    double height, struct bounds_extent_seen seen[2])
{
    struct pupil_outline here = film_building_outline(building, column, height);
    const double before = seen[1].height - seen[0].height;
    const double share = before > 0 ? (height - seen[1].height) / before : 0;
    here.centre.x = seen[1].centre.x + share * (seen[1].centre.x - seen[0].centre.x);
    here.centre.y = seen[1].centre.y + share * (seen[1].centre.y - seen[0].centre.y);
    here.size = seen[1].size;
    if (!outline_is_lit(&building->search, wavelength, &here)) {
        return false;
    }
    seen[0] = seen[1];
    seen[1] = (struct bounds_extent_seen){height, here.centre, here.size};
    return true;
}

/* The pole as a column has it, whose frame is turned. */
static struct bounds_extent_seen pole_in(const struct bounds_builder *building, double column)
{
    const struct pupil_outline *pole = &building->pole;
    const struct pupil_outline here = film_building_outline(building, column, 0);
    const double *from = pole->place.up, *to = here.place.up;
    const double x = pole->centre.x * from[1] + pole->centre.y * from[0];
    const double y = pole->centre.y * from[1] - pole->centre.x * from[0];
    return (struct bounds_extent_seen){
        0, {x * to[1] - y * to[0], x * to[0] + y * to[1]}, pole->size};
}

/* How far light arrives in a column, at most as far as is asked. */
static double extent_find_end(struct bounds_builder *building, double column, double farthest)
{
    const struct bounds_extent_seen pole = pole_in(building, column);
    struct bounds_extent_seen seen[2] = {pole, pole};
    double stride = farthest / STRIDES;
    /* what a long step does not find may be lit all the same */
    while (stride > finest * farthest && seen[1].height < farthest) {
        /* the same at any wavelength; one of them answers for long steps */
        const double height = fmin(seen[1].height + stride, farthest);
        const size_t all = stride * STRIDES < farthest ? building->search.lens->count : 1;
        bool is_lit = false;
        for (size_t w = 0; w < all && !is_lit; w++) {
            is_lit = step_to(building, w, column, height, seen);
        }
        stride *= is_lit ? 1.25 : 0.5;
    }
    const struct pupil_outline_point way = seen[1].centre;
    const double size2 = way.x * way.x + way.y * way.y;
    const double sine = sqrt(size2 / (1 + building->region->tangent * size2));
    building->steepest = fmax(building->steepest, sine);
    return fmin(seen[1].height + stride, farthest);
}

static void bounds_extent_find_ends(struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    building->pole = film_building_outline(building, 0, 0);
    if (!outline_discover(&building->search, 0, &building->pole)) {
        return;
    }
    double *ends = building->ends;
    const double pole = hypot(region->pole[0], region->pole[1]);
    const double farthest = building->search.lens->reach + pole;
    const size_t columns = building->columns;
    for (size_t c = 0; c < columns; c++) {
        ends[c] = extent_find_end(building, (double)c, farthest);
    }
    if (region->is_grid) {
        ends[columns] = ends[0];
        for (size_t c = 0; c < columns; c++) {
            const double middle = (ends[c] + ends[c + 1]) / 2;
            const double end =
                middle < farthest ? extent_find_end(building, (double)c + 0.5, farthest) : middle;
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

bool bounds_extent_find(struct bounds_builder *building, struct error *error)
{
    bounds_extent_find_ends(building);
    if (building->steepest > steep) {
        building->search.tangent = building->region->tangent = 1;
        bounds_extent_find_ends(building);
    }
    /* films so close behind a lens, or so wide, that pupils are slivers between the rows */
    const double angle = degrees_from_radians(asin(fmin(building->steepest, 1)));
    const double most = building->is_round ? farthest_round : farthest_other;
    if (!(angle <= most)) {
        return fail(error, ERROR_DOMAIN,
                    "light reaches the film %.4g degrees off its normal, looked at up to %g "
                    "degrees for a lens that is %sround",
                    angle, most, building->is_round ? "" : "not ");
    }
    return true;
}

/* -------- from place to place -------- */

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
        /*
         * in a column the way on is known from the rows before; to another one the slope tells it
         */
        const struct exit_pupil_bounds *region = building->region;
        if (region->slope[0] != 0 || region->slope[1] != 0) {
            const struct pupil_outline_point zero = {0, 0};
            pupil_outline_foresee(near, NULL, 0, here);
            const struct pupil_outline_point from =
                exit_pupil_bounds_reduced(region, &near->place, here->centre);
            const struct pupil_outline_point to =
                exit_pupil_bounds_reduced(region, &here->place, zero);
            here->centre = (struct pupil_outline_point){from.x - to.x, from.y - to.y};
        }
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

void bounds_follow_waves(const struct bounds_builder *building)
{
    struct exit_pupil_bounds *region = building->region;
    const size_t rows = (size_t)region->rows;
    const double *before =
        bounds_fit_radii(region, film_building_nodes(building), building->search.arena);
    bool has_hole = region->has_hole;
    for (size_t w = 1; w < building->search.lens->count; w++) {
        /* another wavelength, at the rows themselves, each from its outline at the first */
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
            pupil_outline_find(&building->search, w, near, &here);
            bounds_fit(building->region, &(struct film_nodes){{i}, 1}, &here);
            has_hole = has_hole && (here.has_hole || !here.asks_hole);
        }
    }
    region->has_hole = has_hole;
    for (size_t i = 0; i < rows; i++) {
        if (!is_asked(building, i)) {
            bounds_fit_follow(region, before, i);
        }
    }
}
