/* commands/design/fit_job.h - a lens whose rays are traced and fitted, for every view of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_FIT_JOB_H
#define LENSCALC_COMMANDS_DESIGN_FIT_JOB_H

#include "commands/design/fit.h"
#include "design/fit/ray_data.h"
#include "design/fit/thick.h"

enum { MOST_WAVELENGTHS = THICK_GROUPS };

/* By how much twice as many rays change what was found; NaN = they found nothing. mm. */
struct fit_sampling_change {
    double efl, front, rear, rms;
};

/* A fit at work: what is given above, what comes of it below. */
struct fit_job {
    const struct fit_input *input;
    struct run *run;
    const struct setup *setup;
    struct setup_light light; /* at its first wavelength */
    const char *warning;
    struct ray_data ray_data;
    struct thick_sums sums;
    struct thick_pupil_sums pupils[2]; /* before and behind the lens */
    struct thick_task task;
    struct thick_fit fit;
    struct fit_sampling_change *sampling; /* one a lens that was fitted */
    struct thick_lens *paraxial, *thin;   /* one a wavelength */
    struct thick_pupil entrance, exit;    /* NaN where there is no stop */
};

/* A field: rad of a distant object, else its height in mm. */
static inline double fit_field(const struct fit_job *job, size_t i)
{
    return job->setup->fields[i].point.value[setup_axis(job->setup)];
}

/* Trace and fit. */
bool fit_job_run(struct fit_job *job, struct error *error);

/* The thick lens that was found, in place of the lens: optics/thick_element.h. */
struct lens fit_equal_lens(const struct fit_job *job);

/* The fields of which no ray came through, as a sentence; null = none. */
const char *fit_missing_fields(const struct fit_job *job);

/* -------- commands/design/fit_view.c: rows and files of what was found -------- */

void fit_show_rays(struct fit_job *job);
void fit_show_models(struct fit_job *job);
void fit_show_matrix(struct fit_job *job);

#endif
