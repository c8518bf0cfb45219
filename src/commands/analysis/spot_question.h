/* commands/analysis/spot_question.h - what lenscalc spot is asked. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SPOT_QUESTION_H
#define LENSCALC_COMMANDS_ANALYSIS_SPOT_QUESTION_H

#include "analysis/rays/spot.h"
#include "commands/analysis/analysis_options.h"

enum { SPOT_ABOUT_CENTROID, SPOT_ABOUT_CHIEF };

struct spot_input {
    struct analysis_question question;
    int reference;
    double energy;
    long to;
};

extern const struct analysis_policy spot_policy;

/*
 * What is asked of one field of a case.
 *
 * Errors    ERROR_USAGE: a surface that is not there
 */
bool spot_question_of(const struct analysis_case *one, size_t field, const struct spot_input *input,
                      struct spot_question *question, struct error *error);

#endif
