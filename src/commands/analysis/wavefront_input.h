/* commands/analysis/wavefront_input.h - what lenscalc wavefront is asked, and its maps. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_WAVEFRONT_INPUT_H
#define LENSCALC_COMMANDS_ANALYSIS_WAVEFRONT_INPUT_H

#include "analysis/waves/wavefront.h"
#include "commands/analysis/analysis_options.h"

struct wavefront_input {
    struct analysis_question question;
    int reference, zernike; /* enum wave_about; enum zernike_kind, NO_WORD: none */
    long terms, size;
};

extern const struct analysis_policy wavefront_policy;
extern const struct word wave_references[]; /* of one wavelength by itself */

/* One of the fields of a case made ready. Errors as wavefront_open. */
bool wavefront_of_case(const struct analysis_case *one, size_t field,
                       const struct wavefront_input *input, struct arena *arena,
                       struct wavefront_source *source, struct error *error);

/* "the chief ray at 587.6 nm" */
const char *wave_reference_words(const struct analysis_case *one, enum wave_about about,
                                 struct arena *arena);

/* The page of --plot: a map for each field of each case. */
bool wavefront_page(const struct artifact_job *job, struct output *sink, struct error *error);

/* The file of --map: the map of one field. */
bool wavefront_file(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
