/* tests/unit/test_beam.c - how rays of a beam change with their coordinates, in closed form. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "trace/aim/beam.h"

/* Away from a point at -d along the axis, or towards one at +d: u = +-(X - P)/L changes by
   +-(e - u (u e))/L as X moves along e. */
static void test_slope(void)
{
    static const double distances[] = {80, 300, -80, -25, INFINITY};
    static const double places[][2] = {{0, 0}, {3, -4}, {-12, 7}};
    const double n = 1.5;
    for (size_t i = 0; i < 5; i++) {
        const double d = distances[i];
        const struct beam beam = {
            .axis = {0, 0.6, 0.8}, .across = {{1, 0, 0}, {0, 0.8, -0.6}}, .distance = d, .n = n};
        for (int j = 0; j < 6; j++) {
            const double *at = places[j / 2], *e = beam.across[j % 2];
            double point[3], direction[3], way[3], length = 0, along = 0;
            beam_slope(&beam, at, j % 2, point, direction);
            for (int k = 0; k < 3; k++) {
                way[k] = at[0] * beam.across[0][k] + at[1] * beam.across[1][k] + d * beam.axis[k];
                length += way[k] * way[k];
            }
            length = sqrt(length);
            for (int k = 0; k < 3; k++) {
                along += way[k] * e[k] / length;
            }
            for (int k = 0; k < 3; k++) {
                double turn = (e[k] - way[k] / length * along) / length;
                CHECK_NEAR(point[k], e[k], 1e-15, "of the point");
                CHECK_NEAR(direction[k], isinf(d) ? 0 : n * (d > 0 ? turn : -turn), 1e-15,
                           "of the direction");
            }
        }
    }
}

int main(void)
{
    test_slope();
    return check_report();
}
