/* commands/analysis/mtf_figure.h - what lenscalc mtf is asked, and its drawing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_MTF_FIGURE_H
#define LENSCALC_COMMANDS_ANALYSIS_MTF_FIGURE_H

#include "analysis/image/mtf.h"
#include "commands/analysis/analysis_cursor.h"

enum { MTF_BY_WAVES, MTF_BY_RAYS };

struct mtf_input {
    struct analysis_question question;
    double frequency, pitch; /* 1/mm, mm; NaN = not given */
    int method;
    bool square; /* bars in place of sines */
};

extern const struct analysis_policy mtf_policy;

/* For the cursor: a field made ready, a struct mtf_source. Errors as mtf_open. */
bool mtf_field_open(const struct analysis_cursor *at, const struct analysis_case *one, size_t field,
                    void *source, struct error *error);

/* Contrasts with the pixels' own where there are some. Errors as mtf_find. */
bool mtf_with_pixels(const struct mtf_source *source, const struct mtf_input *input,
                     double frequency, struct arena *arena, struct mtf *mtf, struct error *error);

/* The drawing of --plot. */
bool mtf_figure(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
