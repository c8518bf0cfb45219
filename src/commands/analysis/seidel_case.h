/* commands/analysis/seidel_case.h - the questions of lenscalc seidel, and their sums. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SEIDEL_CASE_H
#define LENSCALC_COMMANDS_ANALYSIS_SEIDEL_CASE_H

#include "commands/analysis/analysis_options.h"
#include "optics/seidel.h"

/* --form */
enum { FORM_WELFORD, FORM_TRANSVERSE, FORM_WAVES };

/* --chromatic */
enum { CHROMATIC_LINES, CHROMATIC_LENS };

struct seidel_input {
    struct analysis_question question;
    int form, chromatic;
};

/* The sums of one lens in one position. */
struct seidel_case {
    const struct setup *setup;
    struct analysis_point point; /* what its rows say of their place */
    struct setup_light light;
    struct seidel seidel;
    struct field_point field; /* an angle, or the height of the object; FIELD_NONE */
    double blue, red;         /* um, of CI and CII; NaN where they are absent */
    const char *warning;      /* null = all is well */
};

typedef bool seidel_visit(const struct seidel_case *one, void *context, struct error *error);

/*
 * Visit the sums of a question: positions.
 *
 * Errors    as analysis_each_field and seidel_compute; ERROR_DOMAIN: --chromatic lens of one
 *           wavelength
 */
bool seidel_each(const struct seidel_input *input, struct run *run, seidel_visit *visit,
                 void *context, struct error *error);

/* Is the image infinitely far away, so that transverse aberrations are angles? */
bool seidel_is_angular(const struct seidel_case *one);

/*
 * A part of the sums as --form wants it.
 *
 * Result    false: the sums themselves; else mm, rad where the image is at infinity, or waves
 */
bool seidel_in_form(const struct seidel_case *one, const struct seidel_part *part, int form,
                    double values[SEIDEL_TERMS]);

#endif
