/* trace/aim/aim_map.c - the map through rings and arms of rays. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aim_map.h"

#include "base/constants.h"
#include "trace/aim/aim_block.h"
#include "trace/aim/chief.h"
#include "trace/aim/sample.h"

#include <math.h>

static void place_rings(double nodes[MAP_RINGS])
{
    double x[MAP_RINGS], w[MAP_RINGS];
    gauss_rule(MAP_RINGS, x, w);
    for (size_t i = 0; i < MAP_RINGS; i++) {
        nodes[i] = x[MAP_RINGS - 1 - i];
    }
}

void aim_map_nodes(double (*points)[2])
{
    double nodes[MAP_RINGS];
    place_rings(nodes);
    for (size_t i = 0; i < MAP_NODES; i++) {
        const double r = sqrt(nodes[i / MAP_ARMS]);
        const double angle = 2 * PI * (double)(i % MAP_ARMS) / MAP_ARMS;
        points[i][0] = r * sin(angle);
        points[i][1] = r * cos(angle);
    }
}

/* One wave on all rings, over r^m, as divided differences. */
static void fit_wave(const double *values, const double *nodes, size_t m, const double *wave,
                     double differences[MAP_RINGS])
{
    for (size_t ring = 0; ring < MAP_RINGS; ring++) {
        double sum = 0, power = m % 2 == 0 ? 1 : sqrt(nodes[ring]);
        for (size_t k = 0; k < MAP_ARMS; k++) {
            sum += values[ring * MAP_ARMS + k] * wave[m * k % MAP_ARMS];
        }
        for (size_t k = 0; k < m / 2; k++) {
            power *= nodes[ring];
        }
        differences[ring] = (m == 0 ? 1.0 : 2.0) / MAP_ARMS * sum / power;
    }
    for (size_t order = 1; order < MAP_RINGS; order++) {
        for (size_t i = MAP_RINGS - 1; i >= order; i--) {
            differences[i] = (differences[i] - differences[i - 1]) / (nodes[i] - nodes[i - order]);
        }
    }
}

void aim_map_fit(const double *a, const double *b, struct aim_map *map)
{
    double waves[2][MAP_ARMS]; /* cosines and sines of the arms' angles: of their multiples too */
    for (size_t k = 0; k < MAP_ARMS; k++) {
        const double angle = 2 * PI * (double)k / MAP_ARMS;
        waves[0][k] = cos(angle);
        waves[1][k] = sin(angle);
    }
    place_rings(map->nodes);
    for (size_t f = 0; f < 2; f++) {
        const double *values = f == 0 ? a : b;
        double size = 0;
        for (size_t i = 0; i < MAP_NODES; i++) {
            size = fmax(size, fabs(values[i]));
        }
        for (size_t m = 0; m < MAP_WAVES; m++) {
            for (size_t k = 0; k < 2; k++) {
                fit_wave(values, map->nodes, m, waves[k], map->part[f][m][k]);
                /*
                 * is a wave of any weight in a map that is corrected, of a function of this size?
                 */
                bool some = false;
                for (size_t i = 0; i < MAP_RINGS; i++) {
                    some = some || fabs(map->part[f][m][k][i]) > 1e-7 * size;
                }
                map->counts[f][m][k] = some;
            }
        }
    }
}

/* -------- rays by it -------- */

/* The points of a block. False: some lie outside of what the map knows. */
static bool map_block_start(const struct aim *aim, const struct pupil_point *points, size_t count,
                            struct map_block *block)
{
    const double over = 1 / aim->stop_radius, wide = 1 + 1e-9;
    bool within = true;
    block->lanes = kernel_lanes(count);
    for (size_t i = 0; i < (size_t)block->lanes; i++) {
        const struct pupil_point *point = &points[i < count ? i : 0];
        double goal[2];
        aim_goal(aim, point, goal);
        block->goal_x[i] = goal[0] * over;
        block->goal_y[i] = goal[1] * over;
        block->x[i] = point->x;
        block->y[i] = point->y;
        within = within && point->x * point->x + point->y * point->y <= wide;
    }
    return within;
}

bool aim_map_follow(const struct aim_map *map, const struct aim *aim,
                    const struct pupil_point *points, const struct rays *rays)
{
    enum { LOOKS = 4 };
    const double enough = 1e-15, over = 1 / aim->stop_radius;
    const size_t count = rays->count;
    struct map_block block;
    kernel_map *kernel = KERNEL_FOR(SET_BEST, kernel_map);
    double before = 1e-2;
    if (!map_block_start(aim, points, count, &block)) {
        return false;
    }
    kernel(map, NULL, over, &block);
    for (int look = 0; look < LOOKS; look++) {
        double here = 0;
        beam_start(&aim->beam, block.a, block.b, count, aim->work.blocks);
        chief_to_stop(aim, count);
        kernel(map, aim->work.blocks, over, &block);
        for (size_t i = 0; i < count; i++) {
            here = block.miss[i] > here ? block.miss[i] : here;
        }
        if (!(here < 0.1 * before)) {
            return false;
        }
        if (look > 0 && here * (here / before) <= enough) {
            /* what this step leaves, if it brings as much as the one before */
            beam_start(&aim->beam, block.a, block.b, count, rays->blocks);
            return true;
        }
        before = here;
    }
    return false;
}
