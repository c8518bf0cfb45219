/* design/tolerance/tolerance_model.h - trials of tolerances as plain functions of errors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_TOLERANCE_MODEL_H
#define LENSCALC_DESIGN_TOLERANCE_TOLERANCE_MODEL_H

#include "design/tolerance/second_order.h"
#include "design/tolerance/tolerance_trial.h"

/* Figures, and behind them what was adjusted: as many as tolerance_moves says. */
struct tolerance_model {
    struct tolerance *tolerance;
    struct second_order_problem problem;
    double *nominal; /* without errors */
};

/*
 * Make a problem of trials, of which the tolerance does one after the other.
 *
 * Given     watch  counts the trials, and may stop them; or null
 * Result    model->problem: RMS and distances are roots of squares; pointers into the tolerance and
 *           the arena
 */
void tolerance_model_open(struct tolerance *tolerance, struct watch *watch, struct arena *arena,
                          struct tolerance_model *model);

#endif
