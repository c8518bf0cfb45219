/* cli/question/showing.h - drawings and pictures on the terminal; drawings as PNG and PDF. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_SHOWING_H
#define LENSCALC_CLI_QUESTION_SHOWING_H

#include "cli/question/artifact.h"

/* Is there a drawing or a picture among these, which a terminal can show? */
bool showing_is_possible(file_types *types);

/*
 * Is the program there that makes PNG and PDF of drawings?
 *
 * Errors    ERROR_IO: rsvg-convert is missing, or does not work
 */
bool showing_check_converter(const struct artifact_job *job, struct arena *arena,
                             struct error *error);

/*
 * Make of what a job has made what was asked for.
 *
 * Given     made  a drawing as SVG, or a picture as PNG
 *           sink  receives the bytes of a PNG or PDF file; of what is shown nothing yet: that is
 *                 kept in the job's sink in memory, in place of what was made
 * Errors    ERROR_IO: as above; it does not end in time
 */
bool showing_convert(const struct artifacts *artifacts, const struct artifact_job *job,
                     struct text made, struct output *sink, struct error *error);

#endif
