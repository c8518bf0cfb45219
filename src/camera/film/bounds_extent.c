/* camera/film/bounds_extent.c - steps from what is lit, to where nothing is. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/bounds_extent.h"

#include "base/constants.h"
#include "camera/film/pupil_outline.h"

#include <math.h>

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

/* The same at any wavelength; one of them answers for long steps. */
static bool step_at_any(const struct bounds_builder *building, double column, double stride,
                        double farthest, struct bounds_extent_seen seen[2])
{
    const double height = fmin(seen[1].height + stride, farthest);
    const size_t all = stride * STRIDES < farthest ? building->search.lens->count : 1;
    bool is_lit = false;
    for (size_t w = 0; w < all && !is_lit; w++) {
        is_lit = step_to(building, w, column, height, seen);
    }
    return is_lit;
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
static double bounds_extent_find_end(struct bounds_builder *building, double column,
                                     double farthest)
{
    const struct bounds_extent_seen pole = pole_in(building, column);
    struct bounds_extent_seen seen[2] = {pole, pole};
    double stride = farthest / STRIDES;
    /* what a long step does not find may be lit all the same */
    while (stride > finest * farthest && seen[1].height < farthest) {
        stride *= step_at_any(building, column, stride, farthest, seen) ? 1.25 : 0.5;
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
        ends[c] = bounds_extent_find_end(building, (double)c, farthest);
    }
    if (region->is_grid) {
        ends[columns] = ends[0];
        for (size_t c = 0; c < columns; c++) {
            const double middle = (ends[c] + ends[c + 1]) / 2;
            const double end = middle < farthest
                                   ? bounds_extent_find_end(building, (double)c + 0.5, farthest)
                                   : middle;
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

/* Films so close behind a lens, or so wide, that pupils are slivers between the rows. */
static bool check_steepness(const struct bounds_builder *building, struct error *error)
{
    const double angle = degrees_from_radians(asin(fmin(building->steepest, 1)));
    const double most = building->is_round ? farthest_round : farthest_other;
    return angle <= most ? true
                         : fail(error, ERROR_DOMAIN,
                                "light reaches the film %.4g degrees off its normal, looked at up "
                                "to %g degrees for a lens that is %sround",
                                angle, most, building->is_round ? "" : "not ");
}

bool bounds_extent_find(struct bounds_builder *building, struct error *error)
{
    bounds_extent_find_ends(building);
    if (building->steepest > steep) {
        building->search.tangent = building->region->tangent = 1;
        bounds_extent_find_ends(building);
    }
    return check_steepness(building, error);
}
