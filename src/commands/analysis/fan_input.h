/* commands/analysis/fan_input.h - what lenscalc fan is asked, its answers and their drawing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_FAN_INPUT_H
#define LENSCALC_COMMANDS_ANALYSIS_FAN_INPUT_H

#include "analysis/waves/fan.h"
#include "commands/analysis/analysis_options.h"

enum fan_show { FAN_TRANSVERSE, FAN_OPD };

struct fan_input {
    struct analysis_question question;
    int show, reference;
    long points;
};

extern const struct analysis_policy fan_policy;

/* The fans of one of the fields of a case. Errors as fan_trace. */
bool fan_of_case(const struct analysis_case *one, size_t field, const struct fan_input *input,
                 struct arena *arena, struct fan *fan, struct error *error);

/* The drawing of --plot: a row of panels for each field, the wavelengths overlaid. */
bool fan_figure(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
