/* commands/design/optimize_glasses.h - optimize --glasses: model glasses end as real ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_GLASSES_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_GLASSES_H

#include "commands/design/optimize_job.h"

/*
 * Read --glasses, where it is given: before anything is optimised, with the merit open.
 *
 * Errors    ERROR_USAGE: what is neither a catalogue nor a glass, with a suggestion. ERROR_DOMAIN:
 *           no model glass varies; a glass that does not reach to all wavelengths, or whose nd and
 *           Vd are not known; nothing left
 */
bool optimize_glasses_open(struct optimize_job *job, struct error *error);

/* Replace the model glasses of what was optimised; errors as glass_choose. */
bool optimize_glasses_choose(struct optimize_job *job, struct error *error);

/* Rows of --show glasses. */
extern const struct sheet optimize_glass_sheet;
bool optimize_emit_glasses(struct optimize_job *job);

#endif
