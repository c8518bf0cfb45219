/* commands/analysis/spot_diagram.h - the drawing of lenscalc spot. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SPOT_DIAGRAM_H
#define LENSCALC_COMMANDS_ANALYSIS_SPOT_DIAGRAM_H

#include "commands/analysis/spot_question.h"

/*
 * Draw spots: a row a field and a column a defocus, with the Airy disc; of more fields or defocuses
 * than make a page their RMS radius as curves.
 */
bool spot_diagram(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
