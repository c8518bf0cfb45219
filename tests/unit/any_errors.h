/* tests/unit/any_errors.h - an error of each kind that numbers of the double Gauss have. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_ANY_ERRORS_H
#define LENSCALC_TESTS_UNIT_ANY_ERRORS_H

#include "design/tolerance/perturbation.h"

/* The last is that of the image plane. Their distributions are to be set. */
static const struct perturbation any_errors[] = {
    {.kind = TOLERANCE_RADIUS, .what = {0, PARAMETER_RADIUS, 0}, .amount = 0.1, .name = "R1"},
    {.kind = TOLERANCE_RADIUS, .what = {5, PARAMETER_CURVATURE, 0}, .amount = 1e-5, .name = "R6"},
    {.kind = TOLERANCE_AIR, .what = {1, PARAMETER_THICKNESS, 0}, .amount = 0.05, .name = "t2"},
    {.kind = TOLERANCE_INDEX, .what = {2, PARAMETER_INDEX, 0}, .amount = 1e-3, .name = "n3"},
    {.kind = TOLERANCE_ABBE, .what = {2, PARAMETER_ABBE, 0}, .amount = 0.4, .name = "V3"},
    {.kind = TOLERANCE_CONIC, .what = {3, PARAMETER_CONIC, 0}, .amount = 0.01, .name = "k4"},
    {.kind = TOLERANCE_TILT,
     .what = {3, PARAMETER_TILT_X, 0},
     .axis = PERTURBATION_X,
     .amount = 1e-3,
     .name = "tilt"},
    {.kind = TOLERANCE_ELEMENT_TILT,
     .first = 6,
     .last = 8,
     .what.kind = PARAMETER_KINDS,
     .axis = PERTURBATION_Y,
     .amount = 1e-3,
     .pivot = 2,
     .name = "element tilt"},
    {.kind = TOLERANCE_ELEMENT_DECENTER,
     .first = 2,
     .last = 4,
     .what.kind = PARAMETER_KINDS,
     .axis = PERTURBATION_X,
     .amount = 0.05,
     .name = "element decenter"},
    {.kind = TOLERANCE_FOCUS, .what.kind = PARAMETER_KINDS, .amount = 0.1, .name = "focus"},
};

#endif
