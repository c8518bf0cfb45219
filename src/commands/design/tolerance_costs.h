/* commands/design/tolerance_costs.h - what each error costs, and what errors may be. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_COSTS_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_COSTS_H

#include "commands/design/tolerance_job.h"
#include "design/tolerance/second_order.h"

extern const struct sheet tolerance_sensitivity_sheet, tolerance_inverse_sheet,
    tolerance_offenders_sheet;

/* Rows of each: --show sensitivity, inverse, offenders. */
bool tolerance_emit_sensitivity(struct tolerance_job *job, struct error *error);
bool tolerance_emit_inverse(struct tolerance_job *job, struct error *error);
bool tolerance_emit_offenders(struct tolerance_job *job, struct error *error);

/* Who makes the figures spread, the largest first. */
struct tolerance_offender {
    size_t perturbation;
    struct second_order_share share;
};
bool tolerance_offenders(struct tolerance_job *job, struct tolerance_offender **offenders,
                         double *deviation, struct error *error);

#endif
