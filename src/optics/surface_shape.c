/* optics/surface_shape.c - shapes of surfaces and of the glass between two. */
/* SPDX-License-Identifier: MIT */
#include "optics/surface_shape.h"

#include "base/constants.h"
#include "base/lagrange.h"

#include <math.h>

/* Of the semi-diameter, an edge may be negative where surfaces only touch, as a ball's. */
static const double rounding = 1e-12;

struct surface_shape surface_shape_at(const struct surface *surface, double height)
{
    const double r = fabs(height), c = surface_base_curvature(surface).hi;
    const double vertex =
        surface_curvature(surface, surface->curved == CURVED_X ? SECTION_X : SECTION_Y).hi;
    const double root = sqrt(1 - (1 + surface->conic.value.hi) * c * c * r * r);
    const double of_sphere = vertex * r * r / (1 + sqrt(1 - vertex * vertex * r * r));
    const double slope = c * r / root + 2 * r * surface_departure(surface, r * r).slope;
    const double sag = surface_sag(surface, r);
    const bool is_sphere = surface_profile(surface) <= PROFILE_SPHERE;
    return (struct surface_shape){.sag = sag + 0.0, /* no -0 */
                                  .slope = (height < 0 ? -slope : slope) + 0.0,
                                  .departure = (is_sphere ? 0 * sag : sag - of_sphere) + 0.0};
}

/* Between a surface and the plane at its vertex, out to a rim: flat from its own semi-diameter. */
static double surface_cap(const struct surface *surface, double semi_diameter, double rim)
{
    enum { PANELS = 32 };
    double sum = 0;
    for (int panel = 0; panel < PANELS; panel++) {
        for (int i = 0; i < LAGRANGE_NODES; i++) {
            const double angle = PI / 2 * (panel + lagrange_nodes[i]) / PANELS;
            const double r = semi_diameter * sin(angle);
            sum += PI / 2 / PANELS * lagrange_weights[i] * surface_sag(surface, r) * r *
                   semi_diameter * cos(angle);
        }
    }
    return 2 * PI * sum +
           PI * (rim - semi_diameter) * (rim + semi_diameter) * surface_sag(surface, semi_diameter);
}

static double surface_semi_diameter(const struct surface *surface)
{
    return surface->has_diameter ? surface->diameter.value.hi / 2 : (double)NAN;
}

struct glass_shape glass_shape_behind(const struct lens *lens, size_t surface)
{
    const struct surface *left = &lens->surfaces[surface], *right = left + 1;
    const double way = left->thickness.value.hi;
    const double side = way < 0 ? -1 : 1; /* light goes back behind a mirror */
    const double semi[2] = {surface_semi_diameter(left), surface_semi_diameter(right)};
    const double rim = isnan(semi[0]) || isnan(semi[1]) ? (double)NAN : fmax(semi[0], semi[1]);
    const bool is_round = surface_is_round(left) && surface_is_round(right);
    struct glass_shape shape = {.semi_diameter = rim, .edge_thickness = NAN, .volume = NAN};
    if (is_round) {
        shape.edge_thickness =
            side * (way + surface_sag(right, semi[1]) - surface_sag(left, semi[0]));
        const double volume = side * (PI * rim * rim * way + surface_cap(right, semi[1], rim) -
                                      surface_cap(left, semi[0], rim));
        shape.volume = shape.edge_thickness < -rounding * rim ? (double)NAN : volume;
    }
    return shape;
}
