/* cli/fit_job.h - a lens whose bundle is traced and fitted, for every view of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_FIT_JOB_H
#define LENSCALC_CLI_FIT_JOB_H

#include "commands/design/fit.h"
#include "design/bundle.h"
#include "design/thick.h"

enum { MOST_WAVELENGTHS = THICK_GROUPS };

/* A fit at work: what is given above, what comes of it below. */
struct fit_job {
    const struct fit_input *input;
    struct run *run;
    const struct lens *lens; /* in this position */
    const char *position, *warning;
    struct first_order first;
    const char *fields; /* in words */
    double wavelengths[MOST_WAVELENGTHS], weights[MOST_WAVELENGTHS];
    size_t wavelength_count;
    double field[BUNDLE_FIELDS], field_weights[BUNDLE_FIELDS];
    size_t field_count;
    struct bundle bundle;
    struct thick_task task;
    struct thick_fit fit;
    struct thick_lens *paraxial, *thin; /* one a wavelength */
    struct thick_pupil entrance, exit;  /* NaN where there is no stop */
};

/* Trace and fit. */
bool fit_job_run(struct fit_job *job, struct error *error);

/* The fields of which no ray came through, as a sentence; null = none. */
const char *fit_missing_fields(const struct fit_job *job);

/* -------- cli/fit_view.c: rows and files of what was found -------- */

void fit_show_rays(const struct fit_job *job);
void fit_show_models(const struct fit_job *job);
void fit_show_matrix(const struct fit_job *job);
bool fit_draw_map(const struct fit_job *job, struct error *error);
bool fit_save_lens(const struct fit_job *job, struct error *error);

#endif
