/* design/fit/thick_pupil.c - pupils of rays whose place in the stop is known. */
/* SPDX-License-Identifier: MIT */
#include "base/linear.h"
#include "design/fit/thick.h"

#include <math.h>

enum { COLUMNS = 4, BLOCK = 128 };

/* One equation of a pupil: -p place + s_x radius + s_x s (radius a) = x. */
static void pupil_row(double x, double p, double stop, double s, double weight, size_t rows,
                      double *row)
{
    row[0] = -p * weight;
    row[rows] = stop * weight;
    row[2 * rows] = stop * s * weight;
    row[3 * rows] = x * weight;
}

void thick_pupil_add(const struct thick_rays *rays, bool exit, struct thick_pupil_sums *sums)
{
    const double *x = exit ? rays->x_out : rays->x, *p = exit ? rays->p_out : rays->p;
    const double *y = exit ? rays->y_out : rays->y, *q = exit ? rays->q_out : rays->q;
    double a[COLUMNS * 2 * BLOCK];
    for (size_t first = 0; first < rays->count; first += BLOCK) {
        size_t count = rays->count - first < BLOCK ? rays->count - first : BLOCK, rows = 2 * count;
        for (size_t i = first; i < first + count; i++) {
            double s = p[i] * p[i] + q[i] * q[i], weight = sqrt(thick_rays_weight(rays, i));
            double *row = a + 2 * (i - first);
            pupil_row(x[i], p[i], rays->stop_x[i], s, weight, rows, row);
            pupil_row(y[i], q[i], rays->stop_y[i], s, weight, rows, row + 1);
            sums->weight += weight * weight;
        }
        linear_fold(sums->r, COLUMNS, a, rows);
        sums->rows += rows;
    }
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

bool thick_fit_pupil(const struct thick_pupil_sums *sums, bool exit, bool spherical_aberration,
                     struct arena *arena, struct thick_pupil *pupil, struct error *error)
{
    size_t columns = spherical_aberration ? 3 : 2, rows = sums->rows;
    double a[COLUMNS * 3], b[COLUMNS], solution[3], covariance[9], squares = 0;
    for (size_t i = 0; i < COLUMNS; i++) {
        for (size_t j = 0; j < columns; j++) {
            a[i * columns + j] = sums->r[i * COLUMNS + j];
        }
        b[i] = sums->r[i * COLUMNS + 3];
    }
    const struct linear_factors factors = linear_factor(a, COLUMNS, columns, 1e-11, arena);
    if (factors.rank < columns) {
        return fail(error, ERROR_DOMAIN,
                    "the rays do not fix the %s pupil: add fields off the axis",
                    exit ? "exit" : "entrance");
    }
    linear_reflect(&factors, b);
    for (size_t i = columns; i < COLUMNS; i++) {
        squares += b[i] * b[i];
    }
    linear_substitute(&factors, b, solution);
    linear_normal_inverse(&factors, covariance, arena);
    set_pupil(solution, covariance, rows > columns ? squares / (double)(rows - columns) : NAN,
              columns, pupil);
    pupil->rms = sqrt(squares / sums->weight);
    return true;
}
