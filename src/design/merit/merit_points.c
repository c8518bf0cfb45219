/* design/merit/merit_points.c - points of the pupil, one for all that are alike by symmetry. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_points.h"

#include <math.h>
#include <string.h>

/* Points nearer than this are one, and weights that differ by less. */
static const double alike = 1e-9;

/* Each point is compared with each: in larger samples that would cost more than it saves. */
enum { MOST_COMPARED = 2000 };

static bool points_is_near(double a, double b)
{
    return fabs(a - b) <= alike;
}

/* The half with x >= 0; false: some point has no image. */
static bool fold(const struct sample *sample, struct merit_points *points)
{
    points->count = 0;
    for (size_t i = 0; i < sample->count; i++) {
        const struct pupil_point *point = &sample->points[i];
        bool has_image = false;
        for (size_t j = 0; j < sample->count && !has_image; j++) {
            const struct pupil_point *other = &sample->points[j];
            has_image = points_is_near(other->x, -point->x) && points_is_near(other->y, point->y) &&
                        fabs(other->weight - point->weight) <= alike * point->weight;
        }
        if (!has_image) {
            return false;
        }
        if (point->x >= -alike) {
            struct pupil_point *kept = &points->points[points->count++];
            *kept = *point;
            kept->weight *= point->x > alike ? 2 : 1;
            kept->x = point->x > alike ? point->x : 0;
        }
    }
    return true;
}

/* Rings, each as one point on the y axis; false: a ring is heavier on one side. */
static bool merit_points_gather(const struct sample *sample, struct arena *arena,
                                struct merit_points *points)
{
    double(*moment)[2] = arena_array(arena, sample->count, sizeof *moment);
    points->count = 0;
    for (size_t i = 0; i < sample->count; i++) {
        const struct pupil_point *point = &sample->points[i];
        const double radius = hypot(point->x, point->y);
        size_t ring = 0;
        while (ring < points->count && !points_is_near(points->points[ring].y, radius)) {
            ring++;
        }
        if (ring == points->count) {
            points->points[points->count++] = (struct pupil_point){0, radius, 0};
        }
        points->points[ring].weight += point->weight;
        moment[ring][0] += point->weight * point->x;
        moment[ring][1] += point->weight * point->y;
    }
    for (size_t ring = 0; ring < points->count; ring++) {
        const double most = alike * points->points[ring].weight;
        if (!(hypot(moment[ring][0], moment[ring][1]) <= most)) {
            return false;
        }
    }
    return true;
}

void merit_points_of(const struct sample *sample, enum merit_symmetry symmetry, struct arena *arena,
                     struct merit_points *points)
{
    *points = (struct merit_points){.points = ARENA_ARRAY(arena, sample->count, struct pupil_point),
                                    .symmetry = symmetry};
    if (points->symmetry == SYMMETRY_ROUND && !merit_points_gather(sample, arena, points)) {
        memset(points->points, 0, sample->count * sizeof *points->points);
        points->symmetry = SYMMETRY_MIRROR;
    }
    if (points->symmetry == SYMMETRY_MIRROR && !fold(sample, points)) {
        points->symmetry = SYMMETRY_NONE;
    }
    if (points->symmetry == SYMMETRY_NONE) {
        memcpy(points->points, sample->points, sample->count * sizeof *points->points);
        points->count = sample->count;
    }
    double sum = 0;
    for (size_t i = 0; i < points->count; i++) {
        sum += points->points[i].weight;
    }
    for (size_t i = 0; i < points->count; i++) {
        points->points[i].weight /= sum;
    }
    points->clear = sum;
}
