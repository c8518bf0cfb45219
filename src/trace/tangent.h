/* trace/tangent.h - derivatives of rays by a few things, forwards. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_TANGENT_H
#define LENSCALC_TRACE_TANGENT_H

#include "trace/derivative.h"
#include "trace/kernel/step.h"

/* The derivatives move with the rays: cheaper than sweeps back for up to about eight parameters. */
enum { TANGENTS_MOST = 8 };

/*
 * Derivatives of final rays by a few parameters, or along a few changes of the starting rays.
 *
 * Given     tape        as derivative_trace left it
 *           parameters  `count` of them, up to TANGENTS_MOST, as for derivative_row; null =
 *                       of the starting rays only
 *           tangents    one block a parameter: derivatives of the starting x, y, z, p, q, r, path
 *                       by it, usually 0; to derive by the entrance ray write 1 there. Receives
 *                       those of the final ones
 * Result    as derivative_sweep gives them by its rows; NaN for rays that are lost
 * Formula   the letters of derivative_sweep, a dot for derivatives: d. = (F. - N.X.)/D where F. is
 *           what the parameter does to F; N. from X.; E E. = D D. + (n'^2 - n^2) M./2 + ..;
 *           g. = (E. - D. - g M.)/M; p'. = p. + g. N + g N.
 * Source    derived in lenscalc.7; equal to derivative_sweep
 * Limits    as derivative_sweep; through a thick lens too, but not by what that lens itself is
 */
void tangent_trace(const struct system *system, const struct parameter *parameters, size_t count,
                   enum instruction_set set, const struct derivative_tape *tape,
                   struct ray_block *tangents);

/*
 * The same of the starting rays only, from before the first place to behind another.
 *
 * Given     places  how many places they pass
 * Result    where rays are lost, numbers that mean nothing
 */
void tangent_trace_start(const struct system *system, size_t places, size_t count,
                         enum instruction_set set, const struct derivative_tape *tape,
                         struct ray_block *tangents);

/*
 * The same for changes of the starting rays only, and no tape: rays and tangents go side by side,
 * in memory that a tape has for one step.
 *
 * Given     lanes  the first so many: as kernel_lanes says
 *           rays   two blocks. The first receives the rays behind the last surface, lost ones as
 *                  derivative_trace leaves them; the other is worked in
 */
void tangent_follow(const struct system *system, int lanes, size_t count, struct ray_block rays[2],
                    struct ray_block *tangents);

/* What one parameter changes of one step: derivatives of the members of that name. */
struct tangent_seed {
    double c, k, t, n11, dn, coefficient[STEP_TERMS], odd[STEP_TERMS];
    double t_behind; /* of z behind a STEP_MOVE */
    bool series;     /* are there coefficients? */
    bool is_odd;     /* of odd powers? */
};

/* Those of all parameters, and how many lanes are asked for: as kernel_lanes says. */
struct tangent_seeds {
    const struct tangent_seed *list;
    size_t count;
    int lanes;
};

/* Take tangents through one step. */
typedef void kernel_tangent(const struct step *step, const struct ray_block *before,
                            const struct ray_block *after, const struct tangent_seeds *seeds,
                            struct ray_block *tangents);
kernel_tangent kernel_tangent_sse2, kernel_tangent_avx2, kernel_tangent_avx512;

#endif
