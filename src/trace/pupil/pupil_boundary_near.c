/* trace/pupil/pupil_boundary_near.c - the edge of a star between the directions that it was looked for in. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "trace/pupil/pupil_boundary.h"

#include <math.h>
#include <string.h>

/* Enter a corner in its place. */
static void star_enter_corner(struct pupil_boundary *star, double angle, double radius)
{
    size_t k = star->corner_count++;
    for (; k > 0 && star->corners[k - 1] > angle; k--) {
        star->corners[k] = star->corners[k - 1];
        star->radii[k] = star->radii[k - 1];
    }
    star->corners[k] = angle;
    star->radii[k] = radius;
}

void pupil_boundary_mirror_corners(struct pupil_boundary *star)
{
    double angles[PUPIL_BOUNDARY_CORNERS], radii[PUPIL_BOUNDARY_CORNERS];
    const size_t half = star->corner_count;
    memcpy(angles, star->corners, half * sizeof *angles);
    memcpy(radii, star->radii, half * sizeof *radii);
    star->corner_count = 0;
    for (size_t i = 0; i < half; i++) {
        const double angle = angles[i] - 2 * PI * floor(angles[i] / (2 * PI));
        star_enter_corner(star, angle, radii[i]);
        star_enter_corner(star, 2 * PI - angle, radii[i]);
    }
}

void pupil_boundary_join(struct pupil_boundary *star)
{
    size_t i = 0, k = 0, count = 0;
    while (i < star->count || k < star->corner_count) {
        const bool is_edge =
            k == star->corner_count || (i < star->count && star->angles[i] <= star->corners[k]);
        star->knots[count] = is_edge ? star->angles[i] : star->corners[k];
        star->knot_radii[count++] = is_edge ? star->edges[i++].radius : star->radii[k++];
    }
    star->knot_count = count;
}

double pupil_boundary_near(const struct pupil_boundary *star, double angle)
{
    const size_t count = star->knot_count;
    const double turns = (angle - star->knots[0]) * (1 / (2 * PI));
    const double whole = (double)(long)turns, part = turns - whole + (turns < whole ? 1 : 0);
    const double at = star->knots[0] + 2 * PI * part;
    /* they lie about as far from each other everywhere */
    size_t i = (size_t)(part * (double)count);
    i = i < count ? i : count - 1;
    while (i > 0 && star->knots[i] > at) {
        i--;
    }
    while (i + 1 < count && star->knots[i + 1] <= at) {
        i++;
    }
    const size_t next = i + 1 < count ? i + 1 : 0;
    const double above = star->knots[next] + (next == 0 ? 2 * PI : 0), below = star->knots[i];
    const double share = above > below ? (at - below) / (above - below) : 0;
    return star->knot_radii[i] + (star->knot_radii[next] - star->knot_radii[i]) * share;
}
