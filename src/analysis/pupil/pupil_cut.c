/* analysis/pupil/pupil_cut.c - integrals over the clear parts of a beam, in a plane of either side. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/pupil_cut.h"

#include "trace/aim/sample.h"
#include "trace/dispatch.h"
#include "trace/pupil/clear_intervals.h"

#include <math.h>

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

/* Where ray i crosses the plane; NaN where it does not. */
static void pupil_cut_cross(const struct cut_sums *summing, size_t i, double point[2])
{
    const struct cut_plane *plane = summing->plane;
    const struct ray_block *block = summing->work.blocks;
    double t = (plane->z - block->z[i]) / block->r[i];
    bool meets = block->r[i] * plane->light_direction > 0;
    point[0] = meets ? block->x[i] + t * block->p[i] : (double)NAN;
    point[1] = meets ? block->y[i] + t * block->q[i] : (double)NAN;
}

/* Trace what waits. */
static void pupil_cut_flush(struct cut_sums *summing)
{
    const struct cut_plane *plane = summing->plane;
    beam_fill(plane->beam, (const double(*)[2])summing->at, summing->count * EACH,
              summing->work.blocks);
    if (plane->to > 0) {
        rays_trace_part(plane->system, 0, plane->to, &summing->work, NULL);
    }
    for (size_t i = 0; i < summing->count; i++) {
        double points[EACH][2], slope = 1 / (2 * summing->step);
        for (size_t k = 0; k < EACH; k++) {
            pupil_cut_cross(summing, i * EACH + k, points[k]);
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

static void pupil_cut_add(struct cut_sums *summing, double a, double b, double weight)
{
    static const double steps[EACH][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    for (size_t k = 0; k < EACH; k++) {
        double *at = summing->at[summing->count * EACH + k];
        at[0] = a + summing->step * steps[k][0];
        at[1] = b + summing->step * steps[k][1];
    }
    summing->weights[summing->count++] = weight;
    if (summing->count == AT_ONCE) {
        pupil_cut_flush(summing);
    }
}

struct cut_extent pupil_cut(const struct cut_plane *plane, const struct clear_pupil *clear,
                            struct arena *arena)
{
    double x[POINTS], w[POINTS];
    struct cut_sums *summing = ARENA_NEW(arena, struct cut_sums);
    double size = fmax(clear->high[0] - clear->low[0], clear->high[1] - clear->low[1]);
    *summing =
        (struct cut_sums){.plane = plane, .work = rays_new(arena, RAYS_BLOCK), .step = 1e-5 * size};
    gauss_rule(POINTS, x, w);
    for (size_t i = 0; i < clear->arm_count; i++) {
        const struct clear_arm *arm = &clear->arms[i];
        const struct clear_intervals *spans = arm->spans;
        for (size_t k = 0; k < POINTS * spans->count; k++) {
            double low = spans->low[k / POINTS], width = spans->high[k / POINTS] - low;
            double t = low + width * x[k % POINTS];
            pupil_cut_add(summing, clear->centre[0] + t * (arm->edge.at[0] - clear->centre[0]),
                          clear->centre[1] + t * (arm->edge.at[1] - clear->centre[1]),
                          2 * arm->area * t * width * w[k % POINTS]);
        }
    }
    pupil_cut_flush(summing);
    return (struct cut_extent){
        summing->area, {summing->along[0] / summing->area, summing->along[1] / summing->area}};
}
