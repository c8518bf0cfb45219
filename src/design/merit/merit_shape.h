/* design/merit/merit_shape.h - sags, semi-diameters and spaces, for operands of shapes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_SHAPE_H
#define LENSCALC_DESIGN_MERIT_MERIT_SHAPE_H

#include "design/merit/merit_state.h"

/*
 * Make ready: how far out light comes at each surface of the slot's place that states no diameter.
 *
 * Errors    no aperture
 */
bool merit_reach_open(struct merit *merit, const struct merit_slot *slot, struct arena *arena,
                      struct error *error);

/*
 * Those distances and their derivatives, into place->reach.
 *
 * Formula   the largest of real rays of the primary wavelength through the edge of the stop: of the
 *           axis, and of the field farthest from it the two in its plane. Where the lens has no
 *           such rays (no stop, an ideal lens, heights of the real image) |y| + |ybar| of the
 *           paraxial marginal and chief ray
 * Errors    merit->why: a ray is lost
 */
bool merit_reach(struct merit *merit, const struct merit_slot *slot);

/* The semi-diameter of a surface by a variable: half its diameter, or where light comes. */
struct dual merit_reach_of(const struct merit_place *place, size_t surface, size_t column);

/* Between two surfaces; what only is the stop does not end it. */
struct space {
    size_t left, right;
    double direction; /* of the light */
    bool is_air;
};

/* The space behind a surface; false: there is none that counts. */
bool merit_space_behind(const struct lens *lens, size_t surface, struct space *space);

/* z of a surface at r, and its derivatives by c, k and r. */
struct sag {
    double value, by_curvature, by_conic, by_radius;
};
struct sag merit_sag_at(const struct surface *surface, double r);

/* How a sag at r changes by a number of its surface. */
double merit_sag_slope(const struct sag *sag, double r, struct parameter basis);

#endif
