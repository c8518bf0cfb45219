/* commands/analysis/distortion_models.h - what is asked of a lens's distortion. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_DISTORTION_MODELS_H
#define LENSCALC_COMMANDS_ANALYSIS_DISTORTION_MODELS_H

#include "analysis/rays/distortion.h"
#include "analysis/rays/distortion_fit.h"
#include "commands/analysis/analysis_cursor.h"

struct distortion_input {
    struct analysis_question question;
    int projection; /* 0: automatic; else 1 + enum projection */
    bool calibrated;
    int fit; /* 0: none; else 1 + enum distortion_model */
    struct sensor_value sensor;
    double pitch;  /* mm; NaN = not given */
    double aspect; /* width over height of a picture; NaN = not given */
};

/* Field by field, and one answer for the whole lens. */
extern const struct analysis_policy distortion_by_field, distortion_as_whole;

/* A lens ready to be asked. */
struct distortion_case {
    struct distortion_map map;   /* with the scale in use */
    double focal, magnification; /* paraxial, the one of the two that it has; else NaN */
    double calibrated;           /* the scale in use where it is a calibrated one; else NaN */
    const char *projection;      /* its word */
};

/* Calibrated scales that were found, for the inputs that ask again. */
struct distortion_memo;

struct distortion_memo *distortion_memo_new(struct arena *arena);

/*
 * Compare the lens with the projection that is asked for.
 *
 * Given     memo  null: nothing is kept
 * Errors    as distortion_open and distortion_calibrate, with the options' names
 */
bool distortion_ready(const struct distortion_input *input, const struct analysis_case *one,
                      struct distortion_memo *memo, struct distortion_case *ready,
                      struct error *error);

extern const struct sheet distortion_fit_sheet;

/* The rows of --fit, and the file of --output. */
bool distortion_fit_run(const struct distortion_input *input, struct run *run, struct error *error);
file_types distortion_file_types;
bool distortion_fit_check(const struct artifact_job *job, struct error *error);
bool distortion_fit_save(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
