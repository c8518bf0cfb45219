/* commands/design/tolerance_view.h - the drawings of lenscalc tolerance. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_VIEW_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_VIEW_H

#include "cli/question/artifact.h"

/*
 * --plot: of a summary or trials a histogram with the nominal figure marked, of yields the yield
 * against the limit, else who makes the figures spread.
 */
bool tolerance_view_check(const struct artifact_job *job, struct error *error);
bool tolerance_view_draw(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
