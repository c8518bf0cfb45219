/* commands/design/fit_rows.c - parameters of a fit, their errors and correlations, as rows. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"

#include "base/watch.h"

#define PLAIN(member_name) COLUMN(struct fit_row, member_name), .flags = COLUMN_BRIEF

static const struct column parameter_columns[] = {
    {COLUMN_NAMED(struct fit_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct fit_row, parameter, COLUMN_BRIEF), .help = "what was fitted"},
    {COLUMN_NAMED(struct fit_row, value, COLUMN_BRIEF), .digits = 9,
     .help = "its value; lengths in mm"},
    {PLAIN(error), .name = "stderr", .label = "standard error",
     .help = "standard error; absent at a bound and where the data leave it open"},
    {COLUMN_NAMED(struct fit_row, note, 0),
     .help = "at its bound, or not determined; absent if neither"},
};

static const struct column correlation_columns[] = {
    {COLUMN_NAMED(struct fit_row, position, COLUMN_BRIEF | COLUMN_SPARSE),
     .help = "zoom or focus position"},
    {COLUMN_NAMED(struct fit_row, parameter, COLUMN_BRIEF), .help = "one parameter"},
    {COLUMN_NAMED(struct fit_row, with, COLUMN_BRIEF), .help = "another"},
    {COLUMN_NAMED(struct fit_row, correlation, COLUMN_BRIEF),
     .help = "covariance over the product of the standard errors, -1 to 1"},
};

const struct sheet fit_parameter_sheet = SHEET(parameter_columns, struct fit_row);
const struct sheet fit_correlation_sheet = SHEET(correlation_columns, struct fit_row);

static void emit_parameters(const struct fit_found *found, struct run *run)
{
    const struct solver_summary *summary = found->summary;
    for (size_t i = 0; i < found->count; i++) {
        const struct fit_row row = {.position = found->position,
                                    .parameter = found->names[i],
                                    .value = found->values[i],
                                    .error = summary->standard_error[i],
                                    .note = summary->at_bound[i]       ? "at its bound"
                                            : summary->undetermined[i] ? "not determined"
                                                                       : NULL};
        if (!run_emit(run, &row)) {
            return;
        }
    }
}

static void emit_correlations(const struct fit_found *found, struct run *run)
{
    const double *errors = found->summary->standard_error;
    for (size_t i = 0; i < found->count; i++) {
        for (size_t j = i + 1; j < found->count; j++) {
            double covariance = found->summary->covariance[i * found->count + j];
            const struct fit_row row = {.position = found->position,
                                        .parameter = found->names[i],
                                        .with = found->names[j],
                                        .correlation = covariance / (errors[i] * errors[j])};
            if (!run_emit(run, &row)) {
                return;
            }
        }
    }
}

void fit_emit(const struct fit_found *found, enum fit_show show, struct run *run)
{
    if (show == FIT_CORRELATIONS) {
        emit_correlations(found, run);
    } else {
        emit_parameters(found, run);
    }
}

void fit_note(struct lens *lens, const char *note, struct arena *arena)
{
    if (note == NULL) {
        return;
    }
    const char **notes = ARENA_ARRAY(arena, lens->note_count + 1, const char *);
    for (size_t i = 0; i < lens->note_count; i++) {
        notes[i] = lens->notes[i];
    }
    notes[lens->note_count++] = note;
    lens->notes = notes;
}

const char *fit_status(const struct solver_summary *summary)
{
    static const char *const words[] = {
        [SOLVER_CONVERGED] = "converged",
        [SOLVER_LIMIT] = "not converged: as many iterations as allowed",
        [SOLVER_STOPPED] = "stopped",
        [SOLVER_STUCK] = "not converged: no step lowers the residual",
    };
    return words[summary->status];
}

bool fit_goes_on(void *watch, const struct solver_progress *progress)
{
    (void)progress;
    return watch_add(watch, 1);
}
