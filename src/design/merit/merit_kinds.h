/* design/merit/merit_kinds.h - kinds of operands that nobody knows but who fills all of them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_KINDS_H
#define LENSCALC_DESIGN_MERIT_MERIT_KINDS_H

#include "design/merit/merit_state.h"

/* -------- design/merit/merit_chief.c -------- */

/*
 * height, distortion, lateral, telecentric: of the real chief ray of the field of the operand, else
 * of the field farthest from the axis.
 *
 * Formula   height      where it meets the image plane, along the field's direction in the object,
 *                       upwards or to the right, mm
 *           distortion  100 (h - ideal)/ideal, ideal the height of the rectilinear projection:
 *                       |n| f tan t with the focal length of the primary wavelength; of a near
 *                       object its height times the magnification
 *           lateral     height at the wavelength of the operand less that at the primary one; or
 *                       at the shortest less that at the longest
 *           telecentric atan of its slope behind the lens in that direction, rad
 * Source    analysis/rays/distortion.h, analysis/rays/chromatic.h
 * Errors    as merit_ray_check and merit_image_check; distortion on the axis; lateral colour of one
 *           wavelength
 */
merit_fill merit_fill_chief;
merit_prepare merit_prepare_chief;

/* -------- design/merit/merit_incidence.c -------- */

/*
 * incidence: the largest angle at a surface, rad, a residual for each of the operand that bends
 * light: of the chief rays and those through the upper and the lower edge of the stop, of all
 * fields or that of the operand. Rays that are lost do not count.
 *
 * Formula   sin i = |p x p'|/(n |p' - p|), p and p' before and behind: their difference is along
 *           the normal
 * Source    derived here from the law of refraction
 * Errors    as merit_ray_check; a coordinate break at the surface, no such surface. Of an
 *           evaluation: no ray arrives
 */
merit_fill merit_fill_incidence;
merit_prepare merit_prepare_incidence;

/* -------- design/merit/merit_shape.c -------- */

/*
 * edge and center of glass, air: a residual for each space behind the surfaces of the operand, of
 * air one on the axis and one at the edge.
 *
 * Formula   on the axis t; at the edge t + sag of the surface behind - sag of that before, along
 *           the light, as far out as the larger of the two semi-diameters of glass, the smaller of
 *           air; or between axis and edge, where it is less than on both. A semi-diameter is half
 *           the diameter of the surface, or where it has none as merit_reach finds it; beyond its
 *           own a surface goes on along its curve, or flat where that leaves less, as a bevel does.
 *           A conic goes on along its tangent from near where it ends. Air goes on through a plane
 *           that only is the stop
 * Source    derived here: the sag of optics/surface.h by its numbers
 * Errors    no such space there; no diameter and no aperture
 */
merit_fill merit_fill_shape;
merit_prepare merit_prepare_shape;

/* -------- design/merit/merit_surface.c -------- */

/*
 * sag, slope, ratio: of surfaces that may be curved, a residual each.
 *
 * Formula   sag    z at the semi-diameter a, as merit_shape.h has it, to the right, mm
 *           slope  largest angle of the surface within a, atan |dz/dr|, rad
 *           ratio  |R|/a, R without A2: by its inverse, as merit_put_inverse has it
 * Errors    no such surface; no diameter and no aperture; of ratio a target of 0
 */
merit_fill merit_fill_surface;
merit_prepare merit_prepare_surface;

/* -------- design/merit/merit_element.c -------- */

/*
 * aspect of each piece of glass behind the surfaces of the operand; weight and cost of all of them
 * together. What is behind a mirror is that before it.
 *
 * Formula   aspect  2 b/t, b the larger of the two semi-diameters, t on the axis: by its inverse,
 *                   as merit_put_inverse has it
 *           weight  sum of the density times the volume of a cylinder of radius b between the two
 *                   surfaces, each its curve up to its own semi-diameter and flat beyond, g
 *           cost    the same sum, each weight times the price of a mass beside that of the maker's
 *                   usual crown
 * Source    derived here
 * Errors    no glass there; a density or a price that is not known; no diameter and no aperture; of
 *           aspect a target of 0
 */
merit_fill merit_fill_element;
merit_prepare merit_prepare_element;

/* -------- design/merit/merit_asbuilt.c -------- */

/*
 * asbuilt: the residuals of `poly`, then one for each perturbation of question.errors.
 *
 * Formula   sqrt(sum_i (sigma_j J_ij)^2): J_ij the derivative of residual i of `poly` by
 *           perturbation j, exact, less its part along the derivative by the image plane, as each
 *           position is focused anew, for all of its fields at once; sigma_j the deviation of the
 *           perturbation, of its half range and distribution. So the squares add up to the nominal
 *           sum of W RMS^2, in the plane that the lens has, and the linear variances of all
 *           coordinates of rays about their centroids
 *           Rays go through their points of the stop in every lens. Half ranges in mm, 1/mm, 1 and
 *           rad are those of the lens at the start
 *           Derivatives of these residuals by the variables are central differences of exact first
 *           derivatives, by 1e-4 of natural scales: right to about 1e-5. Where one side has no
 *           value they are of the other side alone; of an error that does nothing they are 0
 * Source    derived here
 * Errors    of merit_prepare_asbuilt: as merit_prepare_rays and perturbed_open; ERROR_DOMAIN:
 *           nothing is perturbed; an index behind or before a mirror
 * Limits    first order: what errors do to the mean by second derivatives is not in it
 */
merit_fill merit_fill_asbuilt;
merit_prepare merit_prepare_asbuilt;

#endif
