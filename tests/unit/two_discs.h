/* tests/unit/two_discs.h - what two holes in a row let through, in closed form. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_TWO_DISCS_H
#define LENSCALC_TESTS_UNIT_TWO_DISCS_H

#include "base/constants.h"

#include <math.h>
#include <stdbool.h>

/* Two holes in a row as one sees them: the part of disc A that lies in disc B. */
struct disc {
    double x, y, r;
};

struct region {
    double high[2], low[2], area, centre[2];
    bool by_first[4], by_second[4]; /* whose rim is the end; a corner: both */
};

/* How far the region reaches in the direction (dx, dy). */
static inline double reach_of(const struct disc *A, const struct disc *B, double dx, double dy,
                              bool *by_first, bool *by_second)
{
    double px = A->x + A->r * dx, py = A->y + A->r * dy;
    double qx = B->x + B->r * dx, qy = B->y + B->r * dy;
    *by_first = hypot(px - B->x, py - B->y) <= B->r;
    *by_second = hypot(qx - A->x, qy - A->y) <= A->r;
    if (*by_first || *by_second) {
        return *by_first ? px * dx + py * dy : qx * dx + qy * dy;
    }
    double d = hypot(B->x - A->x, B->y - A->y), along = (d * d + A->r * A->r - B->r * B->r) / 2 / d;
    double ux = (B->x - A->x) / d, uy = (B->y - A->y) / d,
           aside = sqrt(A->r * A->r - along * along);
    double middle = (A->x + along * ux) * dx + (A->y + along * uy) * dy;
    *by_first = *by_second = true;
    return middle + aside * fabs(dx * uy - dy * ux);
}

/* A segment of a disc on the side of the angle 0, beyond the chord at the distance `at`. */
static inline double segment(double r, double at, double *moment)
{
    double angle = acos(at / r), sine = sin(angle);
    *moment = 2 * r * r * r * sine * sine * sine / 3;
    return r * r * (angle - sine * cos(angle));
}

static inline struct region region_of(struct disc A, struct disc B)
{
    static const double ends[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    struct region region = {.area = PI * A.r * A.r, .centre = {A.x, A.y}};
    for (int i = 0; i < 4; i++) {
        double far =
            reach_of(&A, &B, ends[i][0], ends[i][1], &region.by_first[i], &region.by_second[i]);
        *(i < 2 ? &region.high[i] : &region.low[i - 2]) = i < 2 ? far : -far;
    }
    double d = hypot(B.x - A.x, B.y - A.y);
    if (d > B.r - A.r) {
        double along = (d * d + A.r * A.r - B.r * B.r) / 2 / d, first, second;
        double a = segment(A.r, along, &first), b = segment(B.r, d - along, &second);
        double off = (first + d * b - second) / (a + b);
        region.area = a + b;
        region.centre[0] = A.x + off * (B.x - A.x) / d;
        region.centre[1] = A.y + off * (B.y - A.y) / d;
    }
    return region;
}

#endif
