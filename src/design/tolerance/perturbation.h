/* design/tolerance/perturbation.h - what may be wrong with a lens: independent numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_PERTURBATION_H
#define LENSCALC_DESIGN_TOLERANCE_PERTURBATION_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/lens.h"
#include "optics/tolerance.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * Of what is two numbers: a decentre along x or y, a tilt about x or y; astigmatism rho^2 cos 2t
 * and rho^2 sin 2t of an irregularity, whose spherical form is round (tolerance/irregularity.h).
 */
enum perturbation_axis { PERTURBATION_ROUND, PERTURBATION_X, PERTURBATION_Y };

/*
 * One independent random number of the lens: it adds amount times a number of `spread`
 * (base/distribution.h).
 */
struct perturbation {
    enum tolerance_kind kind; /* THICKNESS is of glass, AIR of air; never ELEMENT_ROLL: that is
                                 an ELEMENT_TILT about its centre of curvature */
    size_t first, last;       /* surfaces, from 0; the same but of an element */
    struct parameter what;    /* the number it is added to, of RADIUS to DECENTER, WEDGE, CONIC,
                                 COEFFICIENT; a radius in fringes, and that of a plane, is a
                                 curvature. Kind PARAMETER_KINDS: it is of elements, irregularity
                                 or the focus. Not parameter_check'ed: an index may be that of a
                                 catalogue's glass, a thickness a word of the positions */
    enum perturbation_axis axis;
    double amount; /* half range, above 0: mm, 1/mm, 1 or rad; of irregularity waves of
                      546.07 nm from peak to valley of the surface */
    struct spread spread;
    double pivot;     /* of an element's tilt: mm from the vertex of `first`, along the axis */
    const char *name; /* "R1", "t3", "element 3..5 tilt x", for rows and messages */
    size_t thing;     /* numbers of one tolerance of one thing have the same, side by side */
    const struct lens_tolerance *line; /* that tolerance, as a line of this thing alone has it */
};

/*
 * The errors of one lens.
 *
 * Given     even    one number a perturbation, between 0 and 1, evenly spread and independent
 *           errors  receives them, in units of half ranges; may be `even`
 * Formula   quantiles of each; of an astigmatism the first number is for its size and the second
 *           for its azimuth: size times cos and sin of two of it, any angle alike. The same bits
 *           on every processor
 */
void perturbation_errors(const struct perturbation *list, size_t count, const double *even,
                         double *errors);

/* Means of powers of such an error, in units of the half range: those of odd powers are 0. */
struct perturbation_moments {
    double second, fourth;
};
struct perturbation_moments perturbation_moments(const struct perturbation *one);

/* What is known of how well a lens will be made. */
struct perturbation_wish {
    const char *grade; /* its name, for messages; null: none */
    struct tolerances of_grade, marks;
};

struct perturbations {
    struct perturbation *list; /* by kind, then surface */
    size_t count;
    const char *won;      /* marks that took the place of the grade's, "R1, t3"; null: none */
    const char *left_out; /* glasses whose Abbe number the grade cannot change, "V1, V3"; or null */
};

/*
 * The independent errors of a lens.
 *
 * Given     lens  in all its positions; what is in shares of a number, or fringes, is of the first
 *           wish  ranges are of those surfaces and elements that have such a thing: planes have no
 *                 radius but in fringes, spaces of 0 no thickness. What is named by itself goes
 *                 before a range, `air` before `t`, and marks before the grade, of which a row in
 *                 fringes is for planes where there is another one
 * Result    in the arena
 * Formula   N fringes of a radius, r the semi-diameter: z(c') = z(c) +- N lambda/2 of the conic,
 *           c(z) = 2 z/(r^2 + (1+k) z^2); the amount is half of the difference of the two. The
 *           tilt of a wedge is its runout over the largest diameter of the element
 * Source    derived here
 * Errors    ERROR_DATA with the line of the mark, of a grade ERROR_DOMAIN: a tolerance as wide as
 *           the number, a diameter that fringes or a runout need, two tolerances of one thing, an
 *           element that begins or ends within glass, a single thing that the lens has not; nothing
 *           is perturbed
 * Limits    light that passes a surface twice, before and behind a mirror, meets two errors there
 */
bool perturbations_of(const struct lens *lens, const struct perturbation_wish *wish,
                      struct arena *arena, struct perturbations *perturbations,
                      struct error *error);

#endif
