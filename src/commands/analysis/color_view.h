/* commands/analysis/color_view.h - the three curves of lenscalc color. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_COLOR_VIEW_H
#define LENSCALC_COMMANDS_ANALYSIS_COLOR_VIEW_H

#include "cli/question/artifact.h"

/* As struct artifact: inputs struct color_input that differ in their wavelengths only. */
bool color_view_check(const struct artifact_job *job, struct error *error);
bool color_view_draw(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
