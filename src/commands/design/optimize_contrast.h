/* commands/design/optimize_contrast.h - whether contrast was seen as it is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_CONTRAST_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_CONTRAST_H

#include "commands/design/optimize_job.h"

/*
 * Contrasts of the lens that was found, by four times the rays.
 *
 * Result    what differs by more than 0.01, in words; null: nothing does
 */
const char *optimize_contrast_doubt(struct optimize_job *job);

#endif
