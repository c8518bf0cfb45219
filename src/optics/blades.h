/* optics/blades.h - the opening that the blades of an iris leave. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_BLADES_H
#define LENSCALC_OPTICS_BLADES_H

#include "optics/aperture.h"
#include "optics/lens.h"

enum { BLADES_LEAST = 3, BLADES_MOST = 64 };

struct blades {
    unsigned count;  /* BLADES_LEAST to BLADES_MOST: as many edges and corners */
    double turn;     /* of the first corner from x towards y, rad */
    double rounding; /* curvature of the edges times the radius: 0 straight, 1 a circle */
};

/*
 * The opening, its corners on the circle of the stop.
 *
 * Given     radius    of that circle, mm, > 0
 *           aperture  receives a polygon that passes, about the vertex
 * Formula   straight edges: the regular polygon. Arcs: a polygon of the same area whose sides are
 *           nowhere farther than 1e-4 radius from them
 * Errors    ERROR_DOMAIN naming the number and its range
 */
bool blades_aperture(const struct blades *blades, double radius, struct arena *arena,
                     struct aperture *aperture, struct error *error);

/*
 * The area of the opening with its arcs, mm^2.
 *
 * Formula   (n/2) r^2 sin(2 pi/n) + n R^2 (a - sin a cos a), R = r/rounding the radius of an edge,
 *           sin a = rounding sin(pi/n)
 */
double blades_area(const struct blades *blades, double radius);

/*
 * A lens with such an iris for its stop, beside what limits the stop already.
 *
 * Given     lens    in one of its positions; it keeps its own surfaces
 *           radius  of the stop, mm
 *           bladed  receives the lens; it is not the same in all directions any more
 * Errors    as blades_aperture; ERROR_DOMAIN: the lens has no stop
 */
bool blades_stop(const struct lens *lens, const struct blades *blades, double radius,
                 struct arena *arena, struct lens *bladed, struct error *error);

#endif
