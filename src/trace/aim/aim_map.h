/* trace/aim/aim_map.h - from points of the stop to rays of a beam, by a polynomial. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_AIM_MAP_H
#define LENSCALC_TRACE_AIM_AIM_MAP_H

#include "trace/aim/aim.h"
#include "trace/dispatch.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>

/* Rings and arms of the rays that it goes through, and waves around the stop that those show. */
enum { MAP_RINGS = 7, MAP_ARMS = 15, MAP_NODES = MAP_RINGS * MAP_ARMS, MAP_WAVES = 8 };

/*
 * a and b of the beam by x and y of the stop, in its radii: for each wave m the real and imaginary
 * part of (y + i x)^m, times a polynomial in r^2 in Newton's form.
 */
struct aim_map {
    double nodes[MAP_RINGS]; /* r^2, descending */
    double part[2][MAP_WAVES][2][MAP_RINGS];
    bool counts[2][MAP_WAVES][2]; /* false: too little to matter */
};

/* The points of the stop that rays are wanted of: Gauss's in r^2, the outermost ring first. */
void aim_map_nodes(double (*points)[2]);

/* The map through a and b of these. */
void aim_map_fit(const double *a, const double *b, struct aim_map *map);

/*
 * Rays of up to a block aimed at points of the stop.
 *
 * Given     rays  receives where they start
 * Result    false: the map leads not all of them there, or points lie beyond the edge
 * Formula   what rays miss their goals by is added to what the map is asked for, which is the
 *           better the more it is a map, until the next such step leaves 1e-15 of the radius
 */
bool aim_map_follow(const struct aim_map *map, const struct aim *aim,
                    const struct pupil_point *points, const struct rays *rays);

/* Rays on their way to points of the stop. */
struct map_block {
    _Alignas(64) double goal_x[RAYS_BLOCK]; /* in the stop's radii */
    double goal_y[RAYS_BLOCK];
    double x[RAYS_BLOCK], y[RAYS_BLOCK]; /* what the map is asked for */
    double a[RAYS_BLOCK], b[RAYS_BLOCK]; /* what it says */
    double miss[RAYS_BLOCK];             /* of the last look, in radii; infinite: lost */
    int lanes;                           /* as kernel_lanes says */
};

/*
 * Ask the map.
 *
 * Given     at_stop  where rays from a and b cross the stop, mm: what they miss their goals by is
 *                    added to what is asked for before; null: nothing is
 *           over     one by the stop's radius, 1/mm
 */
typedef void kernel_map(const struct aim_map *map, const struct ray_block *at_stop, double over,
                        struct map_block *block);
kernel_map kernel_map_sse2, kernel_map_avx2, kernel_map_avx512;

#endif
