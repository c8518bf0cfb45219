/* commands/analysis/spot_figure.h - what spot is asked, and spots drawn. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SPOT_FIGURE_H
#define LENSCALC_COMMANDS_ANALYSIS_SPOT_FIGURE_H

#include "analysis/rays/spot.h"
#include "commands/analysis/analysis_cursor.h"

enum { SPOT_ABOUT_CENTROID, SPOT_ABOUT_CHIEF };

struct spot_input {
    struct analysis_question question;
    int reference;
    double energy;
    long to;
};

extern const struct analysis_policy spot_policy;

/* What is asked of one field of a case. */
bool spot_question_of(const struct analysis_case *one, size_t field, const struct spot_input *input,
                      struct spot_question *question, struct error *error);

/* Draw the spots of all inputs of a job: by field, through focus, or of many their RMS radius. */
bool spot_figure(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
