/* analysis/pupil/pupil_area.c - integrals along the edge of a pupil, and over its clear parts. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/pupil_area.h"

#include "base/constants.h"
#include "trace/aim/sample.h"
#include "trace/dispatch.h"
#include "trace/pupil/clear_intervals.h"

#include <math.h>

/* -------- by the edge: Green's theorem -------- */

/*
 * Gauss's points on 0..1 with their barycentric weights, and what values there count in slopes:
 * slope[i][k] at the i-th of them.
 */
struct nodes {
    const double *x, *gauss;
    double weight[CLEAR_ARC], slope[CLEAR_ARC][CLEAR_ARC];
};

static void set_nodes(const struct clear_pupil *clear, struct nodes *nodes)
{
    nodes->x = clear->nodes;
    nodes->gauss = clear->gauss;
    for (size_t i = 0; i < CLEAR_ARC; i++) {
        double x = nodes->x[i];
        nodes->weight[i] = (i % 2 == 0 ? 1 : -1) * sqrt(x * (1 - x) * nodes->gauss[i]);
    }
    for (size_t i = 0; i < CLEAR_ARC; i++) {
        nodes->slope[i][i] = 0;
        for (size_t k = 0; k < i; k++) {
            const double a = nodes->weight[i], b = nodes->weight[k];
            const double over = 1 / (a * b * (nodes->x[i] - nodes->x[k]));
            nodes->slope[i][k] = b * b * over;
            nodes->slope[k][i] = -a * a * over;
        }
    }
}

/* The polynomial through one piece at its beginning (0) or its end (1). */
static void end_of_arc(const struct nodes *nodes, const double (*points)[2], double end,
                       double at[2])
{
    double denominator = 0, numerator[2] = {0, 0};
    for (size_t k = 0; k < CLEAR_ARC; k++) {
        double share = nodes->weight[k] / (end - nodes->x[k]);
        denominator += share;
        for (int axis = 0; axis < 2; axis++) {
            numerator[axis] += share * points[k][axis];
        }
    }
    at[0] = numerator[0] / denominator;
    at[1] = numerator[1] / denominator;
}

/* Twice the area, and three halves of its first moments, about one point of the curve. */
struct contour_sums {
    const double *about;
    double twice, moment[2];
};

/* A bit of the curve at a point, in a direction. */
static void contour_add(struct contour_sums *sums, const double at[2], const double along[2])
{
    double x = at[0] - sums->about[0], y = at[1] - sums->about[1];
    double cross = x * along[1] - y * along[0];
    sums->twice += cross;
    sums->moment[0] += x * cross;
    sums->moment[1] += y * cross;
}

/* Corners are known to some 1e-8: straight to the next piece, so that the curve is closed. */
static void add_arcs(const struct clear_pupil *clear, const double (*points)[2],
                     struct contour_sums *sums)
{
    struct nodes nodes;
    set_nodes(clear, &nodes);
    for (size_t arc = 0; arc < clear->arcs; arc++) {
        const double(*here)[2] = points + arc * CLEAR_ARC;
        const double(*next)[2] = points + (arc + 1) % clear->arcs * CLEAR_ARC;
        double slope[2], from[2], to[2], width = clear->arc_angles[arc];
        for (size_t k = 0; k < CLEAR_ARC; k++) {
            double dt = nodes.gauss[k] * width;
            /* d/dt of the polynomial through one piece at its k-th point */
            const double *counts = nodes.slope[k], x = here[k][0], y = here[k][1];
            double along[2] = {0, 0};
            for (size_t j = 0; j < CLEAR_ARC; j++) {
                along[0] += counts[j] * (here[j][0] - x);
                along[1] += counts[j] * (here[j][1] - y);
            }
            slope[0] = along[0] / width;
            slope[1] = along[1] / width;
            contour_add(sums, here[k], (double[2]){slope[0] * dt, slope[1] * dt});
        }
        end_of_arc(&nodes, here, 1, from);
        end_of_arc(&nodes, next, 0, to);
        contour_add(sums, (double[2]){(from[0] + to[0]) / 2, (from[1] + to[1]) / 2},
                    (double[2]){to[0] - from[0], to[1] - from[1]});
    }
}

/* d/dt on a circle: central differences of eighth order. */
static void slope_on_circle(const double (*points)[2], size_t count, size_t i, double slope[2])
{
    static const double weights[] = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    const double step = 2 * PI / (double)count;
    slope[0] = slope[1] = 0;
    for (size_t k = 1; k <= 4; k++) {
        const double *after = points[(i + k) % count], *before = points[(i + count - k) % count];
        for (int axis = 0; axis < 2; axis++) {
            slope[axis] += weights[k - 1] * (after[axis] - before[axis]) / step;
        }
    }
}

double contour_area(const struct clear_pupil *clear, const double (*points)[2], double centre[2])
{
    struct contour_sums sums = {.about = points[0]};
    if (clear->arcs == 0) {
        const double dt = 2 * PI / (double)clear->arm_count;
        for (size_t i = 0; i < clear->arm_count; i++) {
            double slope[2];
            slope_on_circle(points, clear->arm_count, i, slope);
            contour_add(&sums, points[i], (double[2]){slope[0] * dt, slope[1] * dt});
        }
    } else {
        add_arcs(clear, points, &sums);
    }
    for (int k = 0; k < 2; k++) {
        /* the centroid of a triangle lies two thirds of the way from its tip */
        centre[k] = sums.about[k] + 2 * sums.moment[k] / (3 * sums.twice);
    }
    return fabs(sums.twice) / 2;
}

/* -------- by the clear parts of arms -------- */

enum { POINTS = 8, EACH = 5, AT_ONCE = RAYS_BLOCK / EACH };

/* Points of the beam that wait to be traced, and the sums. */
struct cut_sums {
    const struct cut_plane *plane;
    struct rays work;
    double step; /* of differences, mm */
    double at[RAYS_BLOCK][2], weights[AT_ONCE];
    size_t count;
    double area, along[2];
};

/* Trace what waits. */
static void pupil_cut_flush(struct cut_sums *summing)
{
    const struct cut_plane *plane = summing->plane;
    const struct ray_block *block = summing->work.blocks;
    beam_fill(plane->beam, (const double(*)[2])summing->at, summing->count * EACH,
              summing->work.blocks);
    if (plane->to > 0) {
        rays_trace_part(plane->system, 0, plane->to, &summing->work, NULL);
    }
    for (size_t i = 0; i < summing->count; i++) {
        double points[EACH][2], slope = 1 / (2 * summing->step);
        for (size_t k = 0; k < EACH; k++) {
            /* where the ray crosses the plane; NaN where it does not */
            const size_t ray = i * EACH + k;
            const double t = (plane->z - block->z[ray]) / block->r[ray];
            const bool meets = block->r[ray] * plane->light_direction > 0;
            points[k][0] = meets ? block->x[ray] + t * block->p[ray] : (double)NAN;
            points[k][1] = meets ? block->y[ray] + t * block->q[ray] : (double)NAN;
        }
        double xa = points[1][0] - points[2][0], ya = points[1][1] - points[2][1];
        double xb = points[3][0] - points[4][0], yb = points[3][1] - points[4][1];
        double area = summing->weights[i] * fabs(xa * yb - xb * ya) * slope * slope;
        summing->area += area;
        summing->along[0] += area * points[0][0];
        summing->along[1] += area * points[0][1];
    }
    summing->count = 0;
}

struct cut_extent pupil_cut(const struct cut_plane *plane, const struct clear_pupil *clear,
                            struct arena *arena)
{
    /* a point, and four beside it that say how areas change */
    static const double steps[EACH][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    double x[POINTS], w[POINTS];
    struct cut_sums *summing = ARENA_NEW(arena, struct cut_sums);
    double size = fmax(clear->high[0] - clear->low[0], clear->high[1] - clear->low[1]);
    *summing =
        (struct cut_sums){.plane = plane, .work = rays_new(arena, RAYS_BLOCK), .step = 1e-5 * size};
    gauss_rule(POINTS, x, w);
    for (size_t i = 0; i < clear->arm_count; i++) {
        const struct clear_arm *arm = &clear->arms[i];
        const struct clear_intervals *intervals = arm->intervals;
        for (size_t k = 0; k < POINTS * intervals->count; k++) {
            double low = intervals->low[k / POINTS], width = intervals->high[k / POINTS] - low;
            double t = low + width * x[k % POINTS];
            const double a = clear->centre[0] + t * (arm->edge.at[0] - clear->centre[0]);
            const double b = clear->centre[1] + t * (arm->edge.at[1] - clear->centre[1]);
            for (size_t j = 0; j < EACH; j++) {
                double *at = summing->at[summing->count * EACH + j];
                at[0] = a + summing->step * steps[j][0];
                at[1] = b + summing->step * steps[j][1];
            }
            summing->weights[summing->count++] = 2 * arm->area * t * width * w[k % POINTS];
            if (summing->count == AT_ONCE) {
                pupil_cut_flush(summing);
            }
        }
    }
    pupil_cut_flush(summing);
    return (struct cut_extent){
        summing->area, {summing->along[0] / summing->area, summing->along[1] / summing->area}};
}
