/* trace/rigid.h - surfaces and axes that shift and turn a little. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_RIGID_H
#define LENSCALC_TRACE_RIGID_H

#include "trace/derivative.h"

/* Points move by sign (shift + axis x (X - at)), directions by sign (axis x p). */
struct rigid {
    double sign, shift[3], axis[3], at[3];
};

/*
 * What decentre or tilt of a surface, or a coordinate break before it, does to the rays in front of
 * a step, and behind it.
 *
 * Given     step  counted in system.steps
 * Result    false: nothing there
 * Formula   rays see the contrary of what the surface does in front of it, and the same behind it;
 *           a coordinate break turns the frame, so that rays see the contrary, once
 */
bool rigid_before(const struct system *system, enum parameter_kind kind, size_t surface,
                  size_t step, struct rigid *motion);
bool rigid_behind(const struct system *system, enum parameter_kind kind, size_t surface,
                  size_t step, struct rigid *motion);

#endif
