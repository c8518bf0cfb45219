/* trace/dispatch.h - trace rays with the best instructions of this processor. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_DISPATCH_H
#define LENSCALC_TRACE_DISPATCH_H

#include "base/instruction_set.h"
#include "trace/kernel/rays.h"
#include "trace/kernel/step.h"
#include "trace/system.h"

#include <stdbool.h>

struct trace_way {
    enum instruction_set set;
    int threads; /* 0 and 1: this one only */
};

/*
 * Take rays through the whole system.
 *
 * Given     rays  in the frame and medium before the first surface; receives where they end
 *           way   null: best instructions, one thread; for RAYS_FEW and less, those of the first
                 block's lanes only
 * Result    in place; see trace/kernel/rays.h for what lost rays hold. No number depends on the
 * threads,
 *           on the instructions or on the other rays
 */
void rays_trace(const struct system *system, const struct rays *rays, const struct trace_way *way);

/*
 * The same from one place to before another, in the order of light: 0 .. system.places.
 *
 * Given     rays  as a trace to `from` left them
 */
void rays_trace_part(const struct system *system, size_t from, size_t to, const struct rays *rays,
                     const struct trace_way *way);

/* Take up to RAYS_BLOCK rays through the whole system, and look at them on the way. */
void rays_watch(const struct system *system, const struct rays *rays,
                const struct rim_watch_request *watching);

#endif
