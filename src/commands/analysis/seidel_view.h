/* commands/analysis/seidel_view.h - the bar diagram of lenscalc seidel. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SEIDEL_VIEW_H
#define LENSCALC_COMMANDS_ANALYSIS_SEIDEL_VIEW_H

#include "cli/question/artifact.h"

/* As struct artifact: one position at a time; input struct seidel_input. */
bool seidel_view_check(const struct artifact_job *job, struct error *error);
bool seidel_view_draw(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
