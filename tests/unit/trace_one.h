/* tests/unit/trace_one.h - one ray through a system. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_TRACE_ONE_H
#define LENSCALC_TESTS_UNIT_TRACE_ONE_H

#include "trace/dispatch.h"

static inline struct ray trace_one(const struct system *system, const struct ray *start)
{
    struct arena arena = {0};
    struct rays rays = rays_new(&arena, 1);
    rays_set(&rays, 0, system->index_first, start);
    rays_trace(system, &rays, NULL);
    struct ray ray = rays_get(&rays, 0, system->index_last);
    arena_free(&arena);
    return ray;
}

#endif
