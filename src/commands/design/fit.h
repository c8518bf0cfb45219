/* commands/design/fit.h - what the three kinds of fit share: input, rows of parameters. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_FIT_H
#define LENSCALC_COMMANDS_DESIGN_FIT_H

#include "commands/design/design.h"
#include "design/fit/ray_data.h"
#include "design/fit/thick.h"
#include "design/solver/solver.h"

enum fit_show {
    FIT_ANSWER,
    FIT_PARAMETERS,
    FIT_CORRELATIONS,
    FIT_RESIDUALS,
    FIT_MODELS,
    FIT_MATRIX,
    FIT_SHOWS
};

/* What rays are compared by: their place in the image, or place and direction. */
enum fit_match { FIT_IMAGE, FIT_RAYS };

struct fit_input {
    struct lens_question question;
    const char *glass, *name, *goals, *vary;
    double object;     /* mm; NaN = the lens's own */
    double distortion; /* terms, a whole number; NaN = as many as the fields bear */
    int show, formula, match, pattern;
    long terms, rays, seed;
    bool chromatic, clip, no_clip;
};

extern const struct sheet fit_parameter_sheet, fit_correlation_sheet;

/* Hand out the rows of FIT_PARAMETERS or FIT_CORRELATIONS, of `count` parameters. */
void fit_emit(const char *position, size_t count, const char *const *names, const double *values,
              const struct solver_summary *summary, enum fit_show show, struct run *run);

/* "converged", or in words why the fit ended otherwise. */
const char *fit_status(const struct solver_summary *summary);

/* Progress of a solver, whose context is a watch: once an iteration. */
bool fit_goes_on(void *watch, const struct solver_progress *progress);

/* -------- fit_lens.c, fit_prescription.c: run->state is what was found -------- */

extern const struct sheet fit_lens_sheet, fit_ray_sheet, fit_model_sheet, fit_matrix_sheet;
bool fit_lens(const struct fit_input *input, struct run *run, struct error *error);
bool fit_save_lens(const struct artifact_job *job, struct output *sink, struct error *error);
bool fit_draw_map(const struct artifact_job *job, struct output *sink, struct error *error);

extern const struct sheet fit_goal_sheet;
bool fit_prescription(const struct fit_input *input, struct run *run, struct error *error);
bool fit_save_prescription(const struct artifact_job *job, struct output *sink,
                           struct error *error);

/* -------- a lens whose rays are traced and fitted, for every view of it -------- */

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

/* Trace and fit. */
bool fit_job_run(struct fit_job *job, struct error *error);

/* The thick lens that was found, in place of the lens: optics/thick_lens.h. */
struct lens fit_equal_lens(const struct fit_job *job);

/* A field: rad of a distant object, else its height in mm. */
static inline double fit_field(const struct fit_job *job, size_t i)
{
    return job->setup->fields[i].point.value[setup_axis(job->setup)];
}

/* -------- commands/design/fit_view.c: rows of what was found -------- */

/* Thick lenses, one a wavelength, as models whose plane is the image. */
struct ray_model *fit_models(const struct fit_job *job, enum lens_model kind,
                             const struct thick_lens *lenses);

void fit_show_rays(struct fit_job *job);
bool fit_show_models(struct fit_job *job, struct error *error);
void fit_show_matrix(struct fit_job *job);

#endif
