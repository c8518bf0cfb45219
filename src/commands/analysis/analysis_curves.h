/* commands/analysis/analysis_curves.h - columns drawn against field, focus or wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_CURVES_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_CURVES_H

#include "commands/analysis/analysis_cursor.h"

/* What a figure of one column is called: "rms_waves", "RMS wave front". */
struct curve_title {
    const char *column, *title;
};

/* How a command's rows are made, of which the curves are. */
struct analysis_curves {
    const struct analysis_policy *policy;
    analysis_find *find;
    size_t found_size;
    const struct sheet *sheet;
    /* The row of the field of a cursor, once that is found. */
    void (*fill_row)(const struct analysis_cursor *at, void *row);
    /* Is the column drawn where --columns names none? */
    bool (*is_usual)(const struct column *column);
    /* What else tells curves apart: CAPTION_KIND; null: nothing. */
    const char *(*kind)(const struct analysis_cursor *at);
    const struct curve_title *titles; /* ends with null; of other columns it is their label */
    const char *title;                /* of several columns */
};

/*
 * The curves of --curve: the columns that --columns names, or the usual ones, against what has the
 * most values of field, defocus and wavelength, a curve for each of the rest.
 *
 * Errors    ERROR_USAGE: fields beside the section, columns of different units, nothing swept, too
 *           many curves, several values at one place; ERROR_DOMAIN: no value at all; as plot_draw
 */
bool analysis_curves_draw(const struct analysis_curves *curves, const struct artifact_job *job,
                          struct output *sink, struct error *error);

#endif
