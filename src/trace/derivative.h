/* trace/derivative.h - exact first derivatives of rays by everything. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_DERIVATIVE_H
#define LENSCALC_TRACE_DERIVATIVE_H

#include "optics/parameter.h"
#include "trace/dispatch.h"

/* By what. Curvature, thickness and index are always there; the others cost more. */
enum {
    DERIVE_CONIC = 1,
    DERIVE_SERIES = 2,
    DERIVE_DISPLACEMENT = 4,
    DERIVE_BREAK = 8,
    DERIVE_ODD = 16 /* and what DERIVE_SERIES says */
};

/* Where the derivatives of a system lie: one row of RAYS_BLOCK numbers a parameter. */
struct derivative_layout {
    unsigned what;
    size_t rows;
    size_t surfaces;   /* of the lens */
    const size_t *row; /* of every surface, from object space on; ask derivative_row */
};

/*
 * Number the parameters that derivatives are taken by.
 *
 * Given     what  DERIVE_ bits: also k of every surface; also A2 .. A20 of every surface; also
 *                 decentre and tilt of every surface by itself; also of the axis in front of
 *                 every surface, with all behind it; also A1 .. A19. Of conics and aspheres k, and
 *                 of aspheres the coefficients, are derived in any case
 */
void derivative_layout(const struct system *system, unsigned what, struct arena *arena,
                       struct derivative_layout *layout);

/*
 * Number those of some parameters only: what is not asked for costs little.
 *
 * Given     parameters  each its own basis (optics/parameter.h); some bring their neighbours with
 *                       them, all orders of a surface or all ways to move it
 */
void derivative_layout_of(const struct system *system, const struct parameter *parameters,
                          size_t count, struct arena *arena, struct derivative_layout *layout);

/*
 * The row of a parameter.
 *
 * Given     parameter  one that is its own basis (optics/parameter.h): of R ask for c and multiply
 *                      with parameter_slope; an index is that at the wavelength of the system
 * Result    LENS_NONE if it has none
 */
size_t derivative_row(const struct derivative_layout *layout, struct parameter parameter);

/*
 * Beside decentre and tilt of a surface by itself, which lie in five rows from that of
 * PARAMETER_DECENTER_X on, there is a sixth behind them: by its shift along z, everything else at
 * rest. The axes that the tilts are about, one a row, in the frame of the axis.
 *
 * Given     decentre  of the surface; null: it has none
 */
enum { DERIVE_SHIFT_Z = 5 };
void displacement_axes(const struct displacement *decentre, double axes[9]);

/* A block of rays with its state behind every step. */
struct derivative_tape {
    struct ray_block *blocks; /* one a step and one in front; aligned */
    double *scratch;
    int lanes; /* the first so many are traced and swept: kernel_lanes of the rays, or all */
};
struct derivative_tape derivative_tape_new(const struct system *system, struct arena *arena);

/*
 * Trace one block and keep every state.
 *
 * Given     start  the rays, as for rays_trace
 * Result    the block behind the last surface; lost rays as there
 */
const struct ray_block *derivative_trace(const struct system *system, const struct ray_block *start,
                                         enum instruction_set set,
                                         const struct derivative_tape *tape);

/*
 * Derivatives of one function of the final rays by all parameters, backwards through the tape.
 *
 * Given     adjoint   derivatives of the function by the final x, y, z, p, q, r and path, each in
 *                     the member of that name, for each ray: x = 1 and the rest 0 asks for dx;
 *                     receives the derivatives by the starting x, y, z, p, q, r and path
 *           gradient  layout.rows rows of RAYS_BLOCK; receives the derivatives
 * Result    NaN in every row for rays that are lost, but for clipped ones that arrive; and in all
 *           that lies before a thick lens, which has no derivatives
 * Formula   for a surface with normal N, M = N^2, D = N.p, E = N.p', p' = p + g N,
 *           g = (E - D)/M, a and b the adjoints of point and direction:
 *           g~ = N.b, D~ = -(g/E) g~, N~ = g b + D~ p + 2 M~ N, b += D~ N; a and the shape gain
 *           from N~ what N depends on; s = (a.p + n^2 path~)/D, shape += s dF, a -= s N,
 *           b += d a
 * Source    derived in lenscalc.7 from F(X) = 0 and the law of refraction; pinned by differences of
 *           113 bits
 * Limits    1e-14 of the scale of each derivative, not at grazing incidence
 */
void derivative_sweep(const struct system *system, const struct derivative_layout *layout,
                      enum instruction_set set, const struct derivative_tape *tape,
                      struct ray_block *adjoint, double *gradient);

/*
 * What a function gains from the directions at a surface, beside what it gains from final rays: by
 * n times the direction cosines before and behind it. It is to be the same however both are turned.
 */
struct derivative_seed {
    size_t place;
    double before[3][RAYS_BLOCK], behind[3][RAYS_BLOCK];
};
struct derivative_seeds {
    struct derivative_seed *list;
    size_t count;
};

/* A sweep that stops on its way. */
struct derivative_pass {
    const struct system *system;
    const struct derivative_layout *layout;
    enum instruction_set set;
    const struct derivative_tape *tape;
    struct ray_block *adjoint;
    double *gradient;
    size_t at;                   /* a place, where */
    const double *add_x, *add_y; /* these are added to the adjoints of x and y, as the surface by
                                    itself has them behind it; null: nothing is */
    struct derivative_seeds seeds;
};

/* Begin before a place, behind all others, and sweep from there, behind `from` - 1, to another. */
void derivative_pass_begin(const struct derivative_pass *pass, size_t from);
void derivative_pass_part(const struct derivative_pass *pass, size_t from, size_t to);

#endif
