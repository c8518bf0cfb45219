/* design/tolerance/irregularity.c - what small deformations do to rays, to first order. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/irregularity.h"

#include "trace/frames.h"

#include <string.h>

struct irregularity_height irregularity_height(const struct irregularity *irregularity, double x,
                                               double y)
{
    const double over = 1 / irregularity->radius, u = x * over, v = y * over;
    const double square = u * u + v * v;
    switch (irregularity->form) {
    case IRREGULARITY_COS:
        return (struct irregularity_height){(u * u - v * v) / 2, {u * over, -v * over}};
    case IRREGULARITY_SIN:
        return (struct irregularity_height){u * v, {v * over, u * over}};
    default: {
        const double slope = (16 * square - 8) * over; /* over rho: d/d(rho^2) times 2 */
        return (struct irregularity_height){4 * square * square - 4 * square + 2.0 / 3,
                                            {slope * u, slope * v}};
    }
    }
}

static void invert(const double m[9], double inverse[9])
{
    double determinant = 0;
    for (int i = 0; i < 3; i++) {
        const double *u = m + 3 * ((i + 1) % 3), *v = m + 3 * ((i + 2) % 3);
        for (int k = 0; k < 3; k++) {
            inverse[3 * k + i] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
        }
    }
    for (int k = 0; k < 3; k++) {
        determinant += m[k] * inverse[3 * k];
    }
    for (int i = 0; i < 9; i++) {
        inverse[i] /= determinant;
    }
}

static void irregularity_apply(const double m[9], const double v[3], double result[3])
{
    for (int i = 0; i < 3; i++) {
        result[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
    }
}

static void apply_back(const double m[9], const double v[3], double result[3])
{
    for (int i = 0; i < 3; i++) {
        result[i] = m[i] * v[0] + m[3 + i] * v[1] + m[6 + i] * v[2];
    }
}

/*
 * What a ray gains by each row that meets the surface at X, in the frame of the axis.
 *
 * Given     frame    of the surface: own = turn (X - shift)
 *           inverse  of the axes that its tilts are about: turns from those by tilts
 */
static void irregularity_weights(const struct irregularity *irregularity,
                                 const struct system *system, const struct surface_frame *frame,
                                 const double inverse[9], const double X[3],
                                 double weights[IRREGULARITY_ROWS])
{
    const double *shift = frame->shift, *turn = frame->turn;
    const double from[3] = {X[0] - shift[0], X[1] - shift[1], X[2] - shift[2]};
    double at[3], seen[3], normal[3], w[3], along[3];
    irregularity_apply(turn, from, at);
    system_normal(system, irregularity->surface, X, seen);
    irregularity_apply(turn, seen, normal);
    const struct irregularity_height height = irregularity_height(irregularity, at[0], at[1]);
    /* the turn about the point that gives the surface there these slopes more, in its own frame */
    const double sx = -normal[0] / normal[2], sy = -normal[1] / normal[2];
    const double over = 1 / (1 + sx * sx + sy * sy);
    const double own[3] = {((1 + sx * sx) * height.slope[1] - sx * sy * height.slope[0]) * over,
                           (sx * sy * height.slope[1] - (1 + sy * sy) * height.slope[0]) * over, 0};
    apply_back(turn, own, w);
    apply_back(turn, (double[3]){0, 0, height.z}, along);
    weights[0] = along[0] - (w[1] * from[2] - w[2] * from[1]);
    weights[1] = along[1] - (w[2] * from[0] - w[0] * from[2]);
    weights[DERIVE_SHIFT_Z] = along[2] - (w[0] * from[1] - w[1] * from[0]);
    apply_back(inverse, w, weights + 2); /* tilts */
}

void irregularity_weigh(const struct irregularity *irregularity,
                        const struct irregularity_sweep *sweep, struct irregularity_weights *all)
{
    const struct system *system = sweep->system;
    const size_t step = system->begin[system_place(system, irregularity->surface) + 1];
    const struct ray_block *behind = &sweep->tape->blocks[step];
    const struct displacement *decentre = system->lens->surfaces[irregularity->surface].decentre;
    const struct surface_frame frame =
        frame_of(decentre != NULL ? decentre : &displacement_none, 0);
    double axes[9], inverse[9];
    displacement_axes(decentre, axes);
    invert(axes, inverse);
    for (int i = 0; i < sweep->tape->lanes; i++) {
        const double X[3] = {behind->x[i], behind->y[i], behind->z[i]};
        double weights[IRREGULARITY_ROWS];
        irregularity_weights(irregularity, system, &frame, inverse, X, weights);
        for (size_t k = 0; k < IRREGULARITY_ROWS; k++) {
            all->rows[k][i] = weights[k];
        }
    }
}

void irregularity_gain(const struct irregularity *irregularity,
                       const struct irregularity_sweep *sweep,
                       const struct irregularity_weights *all, double *column)
{
    const size_t row = derivative_row(sweep->layout, irregularity_basis(irregularity));
    const int lanes = sweep->tape->lanes;
    memset(column, 0, (size_t)lanes * sizeof *column);
    for (size_t k = 0; k < IRREGULARITY_ROWS; k++) {
        const double *gradient = sweep->gradient + (row + k) * RAYS_BLOCK;
        for (int i = 0; i < lanes; i++) {
            column[i] += all->rows[k][i] * gradient[i];
        }
    }
}

void irregularity_column(const struct irregularity *irregularity,
                         const struct irregularity_sweep *sweep, double *column)
{
    struct irregularity_weights weights;
    irregularity_weigh(irregularity, sweep, &weights);
    irregularity_gain(irregularity, sweep, &weights, column);
}
