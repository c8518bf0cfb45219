/* trace/verify.c - the trace in 80-bit numbers. */
/* SPDX-License-Identifier: MIT */
#define REAL long double
#include "trace/verify.h"

#include "trace/precise.h"

#include <math.h>

/* The largest of three differences. */
static double largest_difference(const long double *exact, long double scale, const double *tested)
{
    long double worst = 0;
    for (int i = 0; i < 3; i++) {
        long double difference = fabsl(exact[i] / scale - (long double)tested[i]);
        worst = difference <= worst ? worst : difference;
    }
    return (double)worst;
}

struct verification verify_ray(const struct system *system, const struct ray *start,
                               const struct ray *tested)
{
    struct precise_ray ray = {.path = start->path};
    size_t count = system->lens->surface_count;
    bool reverse = system->options.reverse;
    long double n = precise_of(system->n[reverse ? count : 0]);
    long double last = precise_of(system->n[reverse ? 0 : count]);
    for (int i = 0; i < 3; i++) {
        ray.x[i] = start->point[i];
        ray.p[i] = n * start->cosine[i];
    }
    bool arrived = precise_trace(&ray, system);
    struct verification result = {.ray = {.status = ray.status, .surface = ray.surface}};
    for (int i = 0; i < 3; i++) {
        result.ray.point[i] = arrived ? (double)ray.x[i] : (double)NAN;
        result.ray.cosine[i] = arrived ? (double)(ray.p[i] / last) : (double)NAN;
    }
    result.ray.path = arrived ? (double)ray.path : (double)NAN;
    bool both = arrived && (tested->status == RAY_OK || tested->status == RAY_CLIPPED);
    result.point_error = both ? largest_difference(ray.x, 1, tested->point) : (double)NAN;
    result.cosine_error = both ? largest_difference(ray.p, last, tested->cosine) : (double)NAN;
    long double path = system->options.path ? fabsl(ray.path - (long double)tested->path) : 0;
    result.path_error = both ? (double)path : (double)NAN;
    return result;
}

struct precise_end ray_of_64_bits(const struct system *system, const double point[3],
                                  const double direction[3])
{
    return precise_end_of(system, point, direction);
}
