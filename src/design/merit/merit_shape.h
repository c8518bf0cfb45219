/* design/merit/merit_shape.h - operands of what can be made: thicknesses of glass and air. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_SHAPE_H
#define LENSCALC_DESIGN_MERIT_MERIT_SHAPE_H

#include "design/merit/merit_state.h"

/*
 * edge and center of glass, air: a residual for each space behind the surfaces of the operand, of
 * air one on the axis and one at the edge.
 *
 * Formula   on the axis t; at the edge t + sag of the surface behind - sag of that before, along
 *           the light, as far out as the larger of the two semi-diameters of glass, the smaller of
 *           air. A semi-diameter is half the diameter of the surface, or where it has none as
 *           merit_reach finds it. Air goes on through a plane that only is the stop
 * Source    derived here: the sag of optics/surface.h by its numbers
 * Errors    no such space there; no diameter and no aperture. Of an evaluation: a surface that
 *           does not reach as far out as the edge
 */
merit_fill merit_fill_shape;
merit_prepare merit_prepare_shape;

#endif
