/* design/merit/merit_limit.h - where a lens loses rays that have to reach the image. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_LIMIT_H
#define LENSCALC_DESIGN_MERIT_MERIT_LIMIT_H

#include "trace/aim/beam.h"

#include <stdbool.h>
#include <stddef.h>

/* Why an evaluation gave nothing, where it was rays. */
struct merit_limit {
    bool is_known;  /* false: nothing was lost, or it was not for rays */
    bool is_of_aim; /* they could not be aimed at the stop; else they were lost behind it */
    long count;     /* of evaluations that ended so, as they could not be aimed */
    size_t place;   /* of the merit */
    const struct field_point *field;
    size_t surface; /* 1-based; 0: all surfaces are passed, but another point of the stop is met */
};

#endif
