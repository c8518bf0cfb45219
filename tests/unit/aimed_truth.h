/* tests/unit/aimed_truth.h - one aimed ray in 113 bits, and its derivatives by differences. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_AIMED_TRUTH_H
#define LENSCALC_TESTS_UNIT_AIMED_TRUTH_H

#include "quad.h"

#include "trace/aim/beam.h"

/* The ray with coordinates in a beam, at its start. */
static struct precise_ray truth_start(const struct beam *beam, const real at[2])
{
    struct precise_ray ray = {.path = 0};
    const bool far = isinf(beam->distance);
    const real d = far ? 0 : (real)fabs(beam->distance), sign = beam->distance > 0 ? 1 : -1;
    const real square = at[0] * at[0] + at[1] * at[1], length = precise_root(d * d + square);
    for (int i = 0; i < 3; i++) {
        const real across = at[0] * (real)beam->across[0][i] + at[1] * (real)beam->across[1][i];
        ray.x[i] = across;
        ray.p[i] = (real)beam->n * (real)beam->axis[i];
        if (!far) {
            ray.p[i] = (real)beam->n * (d * (real)beam->axis[i] + sign * across) / length;
        }
    }
    ray.path = far ? 0 : sign * (real)beam->n * (square / (length + d));
    return ray;
}

/* Where it crosses the stop. */
static bool truth_stop(const struct system *system, const struct beam *beam, const real at[2],
                       real place[2])
{
    return quad_to_stop(system, truth_start(beam, at), place);
}

/* d(a, b)/d(x, y in the stop), by differences. */
static bool truth_inverse(const struct system *system, const struct beam *beam, const real at[2],
                          real inverse[4])
{
    const real h = (real)1e-13;
    real here[2], beside[2], m[4];
    if (!truth_stop(system, beam, at, here)) {
        return false;
    }
    for (int k = 0; k < 2; k++) {
        real moved[2] = {at[0], at[1]};
        moved[k] += h;
        if (!truth_stop(system, beam, moved, beside)) {
            return false;
        }
        m[k] = (beside[0] - here[0]) / h;
        m[2 + k] = (beside[1] - here[1]) / h;
    }
    const real det = m[0] * m[3] - m[1] * m[2];
    inverse[0] = m[3] / det;
    inverse[1] = -m[1] / det;
    inverse[2] = -m[2] / det;
    inverse[3] = m[0] / det;
    return true;
}

/* Aim at a place of the stop near by, the slopes kept: a step leaves 1e-11 of the miss. */
static bool truth_aim(const struct system *system, const struct beam *beam, const real inverse[4],
                      const real goal[2], real at[2])
{
    for (int turn = 0; turn < 3; turn++) {
        real here[2];
        if (!truth_stop(system, beam, at, here)) {
            return false;
        }
        const real x = goal[0] - here[0], y = goal[1] - here[1];
        at[0] += inverse[0] * x + inverse[1] * y;
        at[1] += inverse[2] * x + inverse[3] * y;
    }
    return true;
}

/* What becomes of it: x, y and path at the end. */
enum { TRUTHS = 3 };
static bool truth_end(const struct system *system, const struct beam *beam, const real at[2],
                      real ends[TRUTHS])
{
    struct precise_ray ray = truth_start(beam, at);
    if (!precise_trace(&ray, system)) {
        return false;
    }
    ends[0] = ray.x[0];
    ends[1] = ray.x[1];
    ends[2] = ray.path;
    return true;
}

#endif
