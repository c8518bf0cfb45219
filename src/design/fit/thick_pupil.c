/* design/fit/thick_pupil.c - pupils of rays whose place in the stop is known. */
/* SPDX-License-Identifier: MIT */
#include "base/linear.h"
#include "design/fit/thick.h"

#include <math.h>

/* One equation of a pupil: -p place + s_x radius + s_x s (radius a) = x. */
static void pupil_row(double x, double p, double stop, double s, double weight,
                      bool spherical_aberration, double *row, double *right)
{
    row[0] = -p * weight;
    row[1] = stop * weight;
    if (spherical_aberration) {
        row[2] = stop * s * weight;
    }
    *right = x * weight;
}

/* From the solution of the linear system to a pupil with its errors. */
static void set_pupil(const double *solution, const double *covariance, double variance,
                      size_t columns, struct thick_pupil *pupil)
{
    double r = solution[1], g = columns > 2 ? solution[2] / r : 0;
    pupil->place = solution[0];
    pupil->radius = r;
    pupil->spherical_aberration = g;
    pupil->place_error = sqrt(variance * covariance[0]);
    pupil->radius_error = sqrt(variance * covariance[columns + 1]);
    pupil->spherical_aberration_error = 0;
    if (columns > 2) {
        /* g = b/r: dg = (db - g dr)/r */
        double spread = covariance[8] - 2 * g * covariance[5] + g * g * covariance[4];
        pupil->spherical_aberration_error = sqrt(variance * spread) / fabs(r);
    }
}

bool thick_fit_pupil(const struct thick_rays *rays, bool exit, bool spherical_aberration,
                     struct arena *arena, struct thick_pupil *pupil, struct error *error)
{
    size_t columns = spherical_aberration ? 3 : 2, rows = 2 * rays->count;
    double *a = ARENA_ARRAY(arena, rows * columns + 1, double);
    double *b = ARENA_ARRAY(arena, rows + 1, double), solution[3], covariance[9];
    const double *x = exit ? rays->x_out : rays->x, *p = exit ? rays->p_out : rays->p;
    const double *y = exit ? rays->y_out : rays->y, *q = exit ? rays->q_out : rays->q;
    double weights = 0, squares = 0;
    for (size_t i = 0; i < rays->count; i++) {
        double s = p[i] * p[i] + q[i] * q[i],
               weight = sqrt(rays->weight != NULL ? rays->weight[i] : 1);
        double *row = a + 2 * i * columns;
        pupil_row(x[i], p[i], rays->stop_x[i], s, weight, spherical_aberration, row, &b[2 * i]);
        pupil_row(y[i], q[i], rays->stop_y[i], s, weight, spherical_aberration, row + columns,
                  &b[2 * i + 1]);
        weights += weight * weight;
    }
    const struct linear_factors factors = linear_factor(a, rows, columns, 1e-11, arena);
    if (factors.rank < columns) {
        return fail(error, ERROR_DOMAIN,
                    "the rays do not fix the %s pupil: add fields off the axis",
                    exit ? "exit" : "entrance");
    }
    linear_reflect(&factors, b);
    for (size_t i = columns; i < rows; i++) {
        squares += b[i] * b[i];
    }
    linear_substitute(&factors, b, solution);
    linear_normal_inverse(&factors, covariance, arena);
    set_pupil(solution, covariance, rows > columns ? squares / (double)(rows - columns) : NAN,
              columns, pupil);
    pupil->rms = sqrt(squares / weights);
    return true;
}
