/* analysis/waves/working_fnumber.c - f-numbers of the cone that a field's image gets its light by. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/working_fnumber.h"

#include <math.h>

/* Squared sine of the angle between two directions. */
static double sine_squared(const double a[3], const double b[3])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double part = a[j] * b[k] - a[k] * b[j];
        sum += part * part;
    }
    return sum;
}

/* The sum of NA^2 of the two marginal rays of a section, n' = 1. */
static double section_marginal_sum(const struct fan *fan, enum fan_section section,
                                   struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct fan_ray *rays = ARENA_ARRAY(arena, fan->points + FAN_ENDS, struct fan_ray);
    const size_t count = fan_line(fan, 0, section, rays);
    size_t first = 0, last = count;
    while (first < count && rays[first].status != RAY_OK) {
        first++;
    }
    while (last > first && rays[last - 1].status != RAY_OK) {
        last--;
    }
    const double sum = first < last ? sine_squared(rays[first].cosine, fan->chief) +
                                          sine_squared(rays[last - 1].cosine, fan->chief)
                                    : 0;
    arena_reset(arena, mark);
    return sum;
}

bool working_fnumber_find(const struct bundle_question *bundle, struct arena *arena,
                          struct working_fnumber *found, struct error *error)
{
    enum { POINTS = 41 };
    const struct fan_question question = {*bundle, WAVE_CHIEF, POINTS};
    struct fan fan;
    *found = (struct working_fnumber){NAN, NAN, NAN, {NAN, NAN}, {0}};
    if (!fan_trace(&question, arena, &fan, error)) {
        return false;
    }
    found->islands = fan.islands;
    const struct system *system = setup_system(bundle->setup, 0, SETUP_OPEN, error);
    if (system == NULL) {
        return false;
    }
    if (!fan.is_angular) {
        found->height[0] = fan.reference[0];
        found->height[1] = fan.reference[1];
        const double n = fabs(system->index_last);
        const double t = section_marginal_sum(&fan, FAN_TANGENTIAL, arena);
        const double s = section_marginal_sum(&fan, FAN_SAGITTAL, arena);
        found->tangential = 1 / (2 * n * sqrt(t / 2));
        found->sagittal = 1 / (2 * n * sqrt(s / 2));
        found->both = 1 / (2 * n * sqrt((t + s) / 4));
    }
    return true;
}
