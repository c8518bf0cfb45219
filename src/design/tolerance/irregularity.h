/* design/tolerance/irregularity.h - what small deformations do to rays, to first order. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_IRREGULARITY_H
#define LENSCALC_DESIGN_TOLERANCE_IRREGULARITY_H

#include "trace/derivative.h"

#include <stddef.h>

/* Zernike's astigmatism in two directions, and spherical aberration. */
enum irregularity_form {
    IRREGULARITY_COS, /* rho^2 cos 2t, t from +x towards +y */
    IRREGULARITY_SIN, /* rho^2 sin 2t */
    IRREGULARITY_SPHERICAL,
    IRREGULARITY_FORMS
};

/* One form on one surface: its amount is the height from valley to peak, mm. */
struct irregularity {
    size_t surface; /* from 0 */
    enum irregularity_form form;
    double radius; /* of the aperture that valley and peak are looked for in, mm */
};

/* Height along z and its slopes in x and y. */
struct irregularity_height {
    double z, slope[2];
};

/*
 * The deformation of a surface by the amount of 1 mm.
 *
 * Given     x, y  in the surface's own frame, mm; the form goes on beyond its radius
 * Result    mm, added to the sag
 * Formula   rho = r/radius: rho^2 cos 2t/2, rho^2 sin 2t/2, (6 rho^4 - 6 rho^2 + 1)/1.5: fringe
 *           Zernike polynomials 5, 6 and 9 over what they span in the disc, 2, 2 and 1.5
 */
struct irregularity_height irregularity_height(const struct irregularity *irregularity, double x,
                                               double y);

/* Rays that were traced and swept. */
struct irregularity_sweep {
    const struct system *system;
    const struct derivative_layout *layout; /* with the displacement of the surface */
    const struct derivative_tape *tape;
    const double *gradient; /* as derivative_sweep or aimed_sweep have left it */
};

/*
 * The derivative of what was swept for by the amount, one number a ray.
 *
 * Given     column  receives tape->lanes of them, 1/mm
 * Formula   at its own place X a ray sees a height and two slopes, and to first order nothing else.
 *           So the surface may as well be shifted along its z by the height dz, and turned about X
 *           until it has the slopes: with w that turn, the derivatives S by its shift and T by its
 *           turn about the vertex, S.(dz e_z - w x X) + T.w. The path of the ray gains
 *           (n cos I - n' cos I') dz cos(N, z), as it is where dz is added to the sag
 * Source    derived here; pinned by surfaces that are so deformed (tests/unit/test_irregularity.c)
 * Limits    first order: second differences are of the size of amount^2
 */
void irregularity_column(const struct irregularity *irregularity,
                         const struct irregularity_sweep *sweep, double *column);

/* The same in two steps, of which the first looks at the rays alone: for several sweeps of them. */
enum { IRREGULARITY_ROWS = DERIVE_SHIFT_Z + 1 };
struct irregularity_weights {
    double rows[IRREGULARITY_ROWS][RAYS_BLOCK];
};
void irregularity_weigh(const struct irregularity *irregularity,
                        const struct irregularity_sweep *sweep, struct irregularity_weights *all);
void irregularity_gain(const struct irregularity *irregularity,
                       const struct irregularity_sweep *sweep,
                       const struct irregularity_weights *all, double *column);

/* What derivative_layout_of must be asked for. */
static inline struct parameter irregularity_basis(const struct irregularity *irregularity)
{
    return (struct parameter){.surface = irregularity->surface, .kind = PARAMETER_DECENTER_X};
}

#endif
