/* commands/analysis/seidel_case.h - a lens in its light, and the aberrations of its surfaces. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_SEIDEL_CASE_H
#define LENSCALC_COMMANDS_ANALYSIS_SEIDEL_CASE_H

#include "commands/analysis/analysis_cursor.h"
#include "optics/fifth_order.h"
#include "optics/seidel.h"

/* --order */
enum { ORDER_THIRD, ORDER_FIFTH };

/* --form, of the third order */
enum { FORM_WELFORD, FORM_TRANSVERSE, FORM_WAVES };

/* --chromatic */
enum { CHROMATIC_LINES, CHROMATIC_LENS };

struct seidel_input {
    struct analysis_question question;
    int order, form, chromatic;
};

/* The sums of one lens in one position. */
struct seidel_case {
    const struct setup *setup;
    struct analysis_point point; /* what its rows say of their place */
    struct setup_light light;
    struct seidel seidel;
    struct fifth_order fifth; /* of --order 5 */
    struct field_point field; /* an angle, or the height of the object; FIELD_NONE */
    double blue, red;         /* um, of CI and CII; NaN where they are absent */
    const char *warning;      /* null = all is well */
};

extern const struct analysis_policy seidel_policy;

/* The sums of the case of a cursor. */
bool seidel_case_make(const struct analysis_cursor *at, struct seidel_case *one,
                      struct error *error);

/* Is the image infinitely far away, so that transverse aberrations are angles? */
bool seidel_case_is_angular(const struct seidel_case *one);

/* A part of the sums as --form wants it: mm, rad where the image is at infinity, or waves. */
void seidel_case_in_form(const struct seidel_case *one, const struct seidel_part *part, int form,
                         double values[SEIDEL_TERMS]);

/* The fifth order of a surface in the image: mm, or rad where that is at infinity. */
void seidel_case_fifth(const struct seidel_case *one, const double part[FIFTH_TERMS],
                       double values[FIFTH_TERMS]);

/* Bars of one position: see struct artifact. */
bool seidel_figure_check(const struct artifact_job *job, struct error *error);
bool seidel_figure_draw(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
