/* commands/design/optimize_contrast.h - whether contrast was seen as it is, and is as wanted. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_CONTRAST_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_CONTRAST_H

#include "commands/design/optimize_job.h"

/*
 * Contrasts of the lens that was found, by analysis/image/mtf.h, which takes as many rays as it
 * needs.
 *
 * Result    what differs by more than 0.01, in words; null: nothing does
 */
const char *optimize_contrast_doubt(const struct optimize_job *job);

/*
 * Goals of contrast that are missed by more than 0.01, though not by a deviation; "= 1" asks for
 * as much as can be, and is not missed.
 *
 * Result    the one that is missed most, in words; null: none is
 */
const char *optimize_contrast_missed(const struct optimize_job *job);

#endif
