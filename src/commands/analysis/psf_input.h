/* commands/analysis/psf_input.h - what lenscalc psf is asked, and its maps. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_PSF_INPUT_H
#define LENSCALC_COMMANDS_ANALYSIS_PSF_INPUT_H

#include "analysis/image/psf.h"
#include "commands/analysis/analysis_options.h"

struct psf_input {
    struct analysis_question question;
    int method; /* enum psf_method */
    long size;
    double pitch, pitch_angle; /* mm, rad; NaN = not given */
    bool log;
};

extern const struct analysis_policy psf_policy;

/* Errors: ERROR_DOMAIN: a pitch as a length of an image infinitely far away, an angle of another */
bool psf_check(const struct analysis_case *one, const struct psf_input *input, struct error *error);

/* The image of one of the fields of a case. Errors as psf_find. */
bool psf_of_case(const struct analysis_case *one, size_t field, const struct psf_input *input,
                 struct arena *arena, struct psf *psf, struct error *error);

/* The page of --plot, and the file of --map. */
bool psf_page(const struct artifact_job *job, struct output *sink, struct error *error);
bool psf_file(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
