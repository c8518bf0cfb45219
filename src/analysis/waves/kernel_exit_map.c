/* analysis/waves/kernel_exit_map.c - polynomials of two variables and their slopes. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_map.h"

#include <math.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = EXIT_MAP_LANES, ROOM = EXIT_MAP_ORDER + 1 };

/* T_0 .. T_order and their slopes. */
static void kernel_exit_map_chebyshev(const double *x, size_t order, double (*values)[LANES],
                                      double (*slopes)[LANES])
{
    for (size_t l = 0; l < LANES; l++) {
        values[0][l] = 1, slopes[0][l] = 0;
        values[1][l] = x[l], slopes[1][l] = 1;
    }
    for (size_t k = 2; k <= order; k++) {
        for (size_t l = 0; l < LANES; l++) {
            values[k][l] = 2 * x[l] * values[k - 1][l] - values[k - 2][l];
            slopes[k][l] = 2 * values[k - 1][l] + 2 * x[l] * slopes[k - 1][l] - slopes[k - 2][l];
        }
    }
}

void NAMED(kernel_exit_map, KERNEL)(const struct exit_map *map, struct exit_map_lanes *lanes)
{
    double x[ROOM][LANES], dx[ROOM][LANES], y[ROOM][LANES], dy[ROOM][LANES];
    double u[LANES] = {0}, v[LANES] = {0}, ux[LANES] = {0}, vx[LANES] = {0};
    double uy[LANES] = {0}, vy[LANES] = {0};
    const size_t order = map->order;
    kernel_exit_map_chebyshev(lanes->x, order, x, dx);
    kernel_exit_map_chebyshev(lanes->y, order, y, dy);
    for (size_t i = 0, term = 0; i <= order; i++) {
        double a[LANES] = {0}, b[LANES] = {0}, da[LANES] = {0}, db[LANES] = {0};
        for (size_t j = 0; i + j <= order; j++, term++) {
            const double c = map->first[term], d = map->second[term];
            for (size_t l = 0; l < LANES; l++) {
                a[l] += c * y[j][l];
                da[l] += c * dy[j][l];
                b[l] += d * y[j][l];
                db[l] += d * dy[j][l];
            }
        }
        for (size_t l = 0; l < LANES; l++) {
            u[l] += x[i][l] * a[l];
            v[l] += x[i][l] * b[l];
            ux[l] += dx[i][l] * a[l];
            vx[l] += dx[i][l] * b[l];
            uy[l] += x[i][l] * da[l];
            vy[l] += x[i][l] * db[l];
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        lanes->first[l] = u[l];
        lanes->second[l] = v[l];
        lanes->area[l] = fabs(ux[l] * vy[l] - vx[l] * uy[l]);
    }
}

void NAMED(kernel_exit_form, KERNEL)(const struct exit_map *map, struct exit_map_lanes *lanes)
{
    double x[ROOM][LANES], y[ROOM][LANES], u[LANES] = {0}, v[LANES] = {0};
    const size_t order = map->order;
    for (size_t l = 0; l < LANES; l++) {
        x[0][l] = 1, x[1][l] = lanes->x[l];
        y[0][l] = 1, y[1][l] = lanes->y[l];
    }
    for (size_t k = 2; k <= order; k++) {
        for (size_t l = 0; l < LANES; l++) {
            x[k][l] = 2 * x[1][l] * x[k - 1][l] - x[k - 2][l];
            y[k][l] = 2 * y[1][l] * y[k - 1][l] - y[k - 2][l];
        }
    }
    for (size_t i = 0, term = 0; i <= order; i++) {
        double a[LANES] = {0}, b[LANES] = {0};
        for (size_t j = 0; i + j <= order; j++, term++) {
            const double c = map->first[term], d = map->second[term];
            for (size_t l = 0; l < LANES; l++) {
                a[l] += c * y[j][l];
                b[l] += d * y[j][l];
            }
        }
        for (size_t l = 0; l < LANES; l++) {
            u[l] += x[i][l] * a[l];
            v[l] += x[i][l] * b[l];
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        lanes->first[l] = u[l];
        lanes->second[l] = v[l];
    }
}
