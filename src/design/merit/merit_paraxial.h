/* design/merit/merit_paraxial.h - operands of paraxial rays: focal lengths, Seidel sums. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_PARAXIAL_H
#define LENSCALC_DESIGN_MERIT_MERIT_PARAXIAL_H

#include "design/merit/merit_state.h"

/*
 * Lengths that are the inverse of a power: of the focal length, and of the Petzval radius; as
 * merit_put_inverse has them.
 *
 * Errors    of merit_prepare_power: a target of 0, or infinite
 */
merit_fill merit_fill_power;
merit_prepare merit_prepare_power;

/* bfl, ffl, length, magnification, fnumber: first_order_compute and first_order_aperture. */
merit_fill merit_fill_first;
merit_prepare merit_prepare_first;

/*
 * Axial colour: the paraxial image at the wavelength of the operand less that at the primary one;
 * or of the shortest less that of the longest.
 *
 * Errors    there is only one wavelength
 */
merit_fill merit_fill_axial;
merit_prepare merit_prepare_axial;

/*
 * What is measured to the image plane: track, from the first vertex; focus, from there to the
 * paraxial image of the wavelength.
 *
 * Formula   track: length + s', s' the distance of the plane behind the last vertex, which is the
 *           last thickness, or the paraxial image at the primary wavelength; focus: image - s'
 * Errors    as merit_image_check
 */
merit_fill merit_fill_plane;
merit_prepare merit_prepare_plane;

/* power: paraxial_dual_group of the surfaces of the operand, of all of them where it has none. */
merit_fill merit_fill_group;

/*
 * S1 .. S5 of the field, else of the one farthest from the axis, mm: paraxial_dual_seidel.
 *
 * Errors    no aperture, no stop, no field, a cone
 */
merit_fill merit_fill_seidel;
merit_prepare merit_prepare_seidel;

/*
 * How far out light comes at each surface, |y| + |ybar|, and its derivatives: paraxial_dual_reach
 * at the primary wavelength, into the reach of the slot's place.
 */
bool merit_reach_paraxial(struct merit *merit, const struct merit_slot *slot);

/*
 * Paraxial figures of a slot: those of its field, else of the edge.
 *
 * Given     wavelength  um; NaN: the primary one
 * Result    one a column, until they are asked for with another field; null: merit->why
 */
const struct merit_figures *merit_figures(struct merit *merit, const struct merit_slot *slot,
                                          double wavelength);

/*
 * Is there an image plane that a lens keeps?
 *
 * Errors    no last thickness, an afocal lens, the best focus, which is another with every lens
 */
bool merit_image_check(const struct merit_place *place, struct error *error);

/* Two wavelengths of colour: that of the operand and the primary one, or the shortest and the
   longest. The same: there is no colour. */
void merit_colours(const struct merit_place *place, const struct operand *operand,
                   double colours[2]);

#endif
