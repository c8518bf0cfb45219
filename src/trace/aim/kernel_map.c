/* trace/aim/kernel_map.c - a map of the stop at many points: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/aim_map.h"
#include "trace/kernel/lanes.h"

/* A wave around the stop, and r^2 less the nodes. */
struct stop_place {
    double wave[2][RAYS_BLOCK], less[MAP_RINGS][RAYS_BLOCK];
};

/* What they miss their goals by is added to what is asked for. */
INLINE void kernel_map_correct(const struct ray_block *restrict at, double over,
                               struct map_block *restrict block)
{
    for (int i = 0; i < LANES_OF(block->lanes); i++) {
        double x = block->goal_x[i] - at->x[i] * over, y = block->goal_y[i] - at->y[i] * over;
        double miss = fabs(x) + fabs(y);
        bool arrives = (at->lost[i] == 0) & (miss <= DBL_MAX);
        block->x[i] += x;
        block->y[i] += y;
        block->miss[i] = arrives ? miss : (double)INFINITY;
    }
}

/* What one part of a wave adds to a or b: by so many rings, the outermost ones. */
INLINE void kernel_map_add_part(const double *part, int rings, int lanes,
                                const struct stop_place *restrict at, const double *restrict wave,
                                double *restrict sum)
{
    double c[MAP_RINGS];
    memcpy(c, part, sizeof c);
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double value = c[rings - 1];
        for (int j = rings - 2; j >= 0; j--) {
            value = value * at->less[j][i] + c[j];
        }
        sum[i] += value * wave[i];
    }
}

/* Polynomials of inner rings matter less the higher the wave is. */
INLINE void kernel_map_add(const struct aim_map *map, int f, int m, int lanes,
                           const struct stop_place *at, double *sum)
{
    for (int k = 0; k < 2; k++) {
        const double *part = map->part[f][m][k], *wave = at->wave[k];
        if (!map->counts[f][m][k]) {
            continue;
        }
        if (m < 2) {
            kernel_map_add_part(part, MAP_RINGS, lanes, at, wave, sum);
        } else if (m < 4) {
            kernel_map_add_part(part, MAP_RINGS - 1, lanes, at, wave, sum);
        } else if (m < 6) {
            kernel_map_add_part(part, MAP_RINGS - 2, lanes, at, wave, sum);
        } else {
            kernel_map_add_part(part, MAP_RINGS - 3, lanes, at, wave, sum);
        }
    }
}

void NAME(kernel_map, KERNEL)(const struct aim_map *map, const struct ray_block *at_stop,
                              double over, struct map_block *block)
{
    const int lanes = block->lanes;
    struct stop_place at;
    if (at_stop != NULL) {
        kernel_map_correct(at_stop, over, block);
    }
    for (int i = 0; i < LANES_OF(lanes); i++) {
        double r2 = block->x[i] * block->x[i] + block->y[i] * block->y[i];
        for (int j = 0; j < MAP_RINGS; j++) {
            at.less[j][i] = r2 - map->nodes[j];
        }
        at.wave[0][i] = 1;
        at.wave[1][i] = 0;
        block->a[i] = 0;
        block->b[i] = 0;
    }
    for (int m = 0; m < MAP_WAVES; m++) {
        kernel_map_add(map, 0, m, lanes, &at, block->a);
        kernel_map_add(map, 1, m, lanes, &at, block->b);
        for (int i = 0; i < LANES_OF(lanes); i++) {
            double real = at.wave[0][i], imaginary = at.wave[1][i];
            at.wave[0][i] = real * block->y[i] - imaginary * block->x[i];
            at.wave[1][i] = real * block->x[i] + imaginary * block->y[i];
        }
    }
}
