/* commands/analysis/color_view.h - what lenscalc color is asked, and its drawing. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_COLOR_VIEW_H
#define LENSCALC_COMMANDS_ANALYSIS_COLOR_VIEW_H

#include "analysis/rays/chromatic.h"
#include "commands/analysis/analysis_cursor.h"

/* --show */
enum { COLOR_BY_WAVELENGTH, COLOR_BY_ZONE, COLOR_BY_FIELD };

struct color_input {
    struct analysis_question question;
    int show;
    long steps;
};

extern const struct analysis_policy color_policy;

/* Step i of the field from the axis (0) to the edge (steps). */
struct field_point color_field(const struct field_point *edge, long i, long steps);

/* The direction of a field, upwards: that in which heights count. Unit. */
void color_direction(const struct setup *setup, const struct field_point *field, double along[2]);

/* Axial colour of the extreme wavelengths, and the secondary spectrum. */
struct color_summary {
    double shortest, longest;     /* um; NaN: there is no range of wavelengths */
    struct chromatic_axial axial; /* mm */
    double vergence;              /* of an afocal lens: the shortest less the longest, 1/mm */
    const char *words;            /* null = nothing to say */
};

bool color_summarize(const struct analysis_case *one, struct color_summary *summary,
                     struct error *error);

/* The drawing of --plot: one position, as struct artifact has it. */
bool color_view_check(const struct artifact_job *job, struct error *error);
bool color_view_draw(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
