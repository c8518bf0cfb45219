/* trace/pupil/focus.c - where the exact rays of a beam meet best. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/focus.h"

#include "trace/dispatch.h"

#include <float.h>
#include <math.h>

enum { FOCUS_RAYS = 72 };

/* Where a ray crosses z = 0, and its slopes. */
struct ray_line {
    double at[2], slope[2];
};

static struct ray_line ray_line_of(const struct rays *rays, size_t i)
{
    const struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
    size_t lane = i % RAYS_BLOCK;
    double a = block->p[lane] / block->r[lane], b = block->q[lane] / block->r[lane];
    return (struct ray_line){
        {block->x[lane] - a * block->z[lane], block->y[lane] - b * block->z[lane]}, {a, b}};
}

static bool ray_counts(const struct rays *rays, const double *weights, size_t i)
{
    return ray_block_status(&rays->blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK &&
           weights[i] > 0;
}

double rays_best_focus(const struct rays *rays, const double *weights)
{
    double all = 0, up = 0, down = 0, largest = 0;
    struct ray_line mean = {{0, 0}, {0, 0}};
    for (size_t i = 0; i < rays->count; i++) {
        if (ray_counts(rays, weights, i)) {
            struct ray_line line = ray_line_of(rays, i);
            for (int k = 0; k < 2; k++) {
                mean.at[k] += weights[i] * line.at[k];
                mean.slope[k] += weights[i] * line.slope[k];
            }
            all += weights[i];
        }
    }
    for (size_t i = 0; i < rays->count; i++) {
        if (!ray_counts(rays, weights, i)) {
            continue;
        }
        struct ray_line line = ray_line_of(rays, i);
        for (int k = 0; k < 2; k++) {
            double at = line.at[k] - mean.at[k] / all;
            double slope = line.slope[k] - mean.slope[k] / all;
            up -= weights[i] * at * slope;
            down += weights[i] * slope * slope;
            largest = fmax(largest, fabs(line.slope[k]));
        }
    }
    /* slopes that differ by rounding only say nothing */
    double noise = 64 * DBL_EPSILON * fmax(largest, 1e-3);
    return down > all * noise * noise ? up / down : (double)NAN;
}

bool lens_best_focus(const struct system *system, const struct conjugate_object *object,
                     const struct first_order *first, struct arena *arena, double *focus,
                     struct error *error)
{
    const struct field_point axis = {.kind = FIELD_NONE};
    struct beam beam;
    struct aim aim;
    struct sample sample;
    if (!beam_of_field(&axis, object, first, &beam, error) ||
        !aim_open(system, &beam, arena, &aim, error) ||
        !sample_make(PATTERN_GAUSS, FOCUS_RAYS, 0, arena, &sample, error)) {
        return error_prefix(error, "no best focus: ");
    }
    struct rays rays = rays_new(arena, sample.count);
    double *weights = ARENA_ARRAY(arena, sample.count, double);
    for (size_t i = 0; i < sample.count; i++) {
        weights[i] = sample.points[i].weight;
    }
    aim_rays(&aim, sample.points, sample.count, &rays);
    rays_trace(system, &rays, NULL);
    *focus = rays_best_focus(&rays, weights);
    return !isnan(*focus) ||
           fail(error, ERROR_DOMAIN,
                "no best focus: the rays on the axis leave the lens parallel, or are lost");
}
