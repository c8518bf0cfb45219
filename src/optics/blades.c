/* optics/blades.c - polygons with straight and rounded sides. */
/* SPDX-License-Identifier: MIT */
#include "optics/blades.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* As a share of the radius: how far sides may lie from an arc; curvature that counts as none. */
static const double near_arc = 1e-4, straight = 1e-6;

/* Half the angle by which an edge turns. */
static double blades_bend_of(const struct blades *blades)
{
    return asin(fmin(1, blades->rounding * sin(PI / blades->count)));
}

double blades_area(const struct blades *blades, double radius)
{
    const double n = blades->count, q = blades->rounding, a = blades_bend_of(blades);
    double area = n / 2 * sin(2 * PI / n);
    if (q > straight) {
        /* a - sin a cos a; by its series where the two cancel */
        const double a2 = a * a;
        const double segment =
            a < 0.02 ? a * a2 * (2.0 / 3 - a2 * (2.0 / 15 - a2 * 4.0 / 315)) : a - sin(2 * a) / 2;
        area += n * segment / (q * q);
    }
    return area * radius * radius;
}

/* Into how many sides an edge is divided. */
static size_t sides_of(const struct blades *blades)
{
    const double q = blades->rounding;
    if (!(q > straight)) {
        return 1;
    }
    /* the largest distance is angle^2 R/6, where there are two */
    const double sides = ceil(2 * blades_bend_of(blades) / sqrt(6 * q * near_arc));
    return sides > 2 ? (size_t)sides : 2;
}

/*
 * How much farther than the arc, from its centre, the corners between the blade's ends lie, so that
 * s triangles of angle x are as large as the sector: sin(x)/2 (2 p + (s - 2) p^2) = s x/2.
 */
static double push_of(double x, size_t sides)
{
    const double s = (double)sides, area = s * x / sin(x);
    return area / (1 + sqrt(1 + (s - 2) * area));
}

/* The corners of one blade, its first end and those between. */
static void put_blade(const struct blades *blades, double radius, unsigned blade, size_t sides,
                      struct figure (*points)[2])
{
    const double half = PI / blades->count, first = 2 * half * blade;
    points[0][0] = figure_number(pair_of(radius * cos(first)));
    points[0][1] = figure_number(pair_of(radius * sin(first)));
    if (sides < 2) {
        return;
    }
    const double bend = blades_bend_of(blades), x = 2 * bend / (double)sides;
    const double arc = radius / blades->rounding, from = radius * cos(half) - arc * cos(bend);
    const double pushed = arc * push_of(x, sides), c = cos(first + half), s = sin(first + half);
    for (size_t i = 1; i < sides; i++) {
        const double angle = (double)i * x - bend;
        const double along = from + pushed * cos(angle), across = pushed * sin(angle);
        points[i][0] = figure_number(pair_of(along * c - across * s));
        points[i][1] = figure_number(pair_of(along * s + across * c));
    }
}

bool blades_aperture(const struct blades *blades, double radius, struct arena *arena,
                     struct aperture *aperture, struct error *error)
{
    if (!(blades->count >= BLADES_LEAST && blades->count <= BLADES_MOST)) {
        return fail(error, ERROR_DOMAIN, "an iris of %u blades: it has %d to %d", blades->count,
                    BLADES_LEAST, BLADES_MOST);
    }
    if (!(blades->rounding >= 0 && blades->rounding <= 1)) {
        return fail(error, ERROR_DOMAIN,
                    "a rounding of %.6g of the blades is not from 0, straight, to 1, a circle",
                    blades->rounding);
    }
    if (!(fabs(blades->turn) < 1e6)) {
        return fail(error, ERROR_DOMAIN, "a turn of the blades of %.6g rad", blades->turn);
    }
    if (!(radius > 0 && radius < 1e90)) {
        return fail(error, ERROR_DOMAIN, "a stop radius of %.6g mm is not above 0 and below 1e90",
                    radius);
    }
    const size_t sides = sides_of(blades), count = sides * blades->count;
    struct figure(*points)[2] = arena_array(arena, count, sizeof *points);
    for (unsigned blade = 0; blade < blades->count; blade++) {
        put_blade(blades, radius, blade, sides, points + blade * sides);
    }
    *aperture = aperture_of(SHAPE_POLYGON, false);
    aperture->points = (const struct figure(*)[2])points;
    aperture->point_count = count;
    aperture->turn = figure_number(pair_of(blades->turn));
    return true;
}

bool blades_stop(const struct lens *lens, const struct blades *blades, double radius,
                 struct arena *arena, struct lens *bladed, struct error *error)
{
    *bladed = *lens;
    if (lens->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop where blades could be");
    }
    bladed->surfaces = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    memcpy(bladed->surfaces, lens->surfaces, lens->surface_count * sizeof *lens->surfaces);
    struct surface *stop = &bladed->surfaces[lens->stop];
    struct aperture *apertures = ARENA_ARRAY(arena, stop->aperture_count + 1, struct aperture);
    for (size_t i = 0; i < stop->aperture_count; i++) {
        apertures[i] = stop->apertures[i];
    }
    stop->apertures = apertures;
    return blades_aperture(blades, radius, arena, &apertures[stop->aperture_count++], error);
}
