/* commands/design/tolerance_job.h - what tolerance is asked, and what came of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_JOB_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_JOB_H

#include "cli/question/division.h"
#include "commands/lens/lens_options.h"
#include "design/tolerance/tolerance_model.h"
#include "design/tolerance/tolerance_run.h"

enum tolerance_show {
    TOLERANCE_SUMMARY,
    TOLERANCE_TRIALS,
    TOLERANCE_YIELD,
    TOLERANCE_SENSITIVITY, /* and what follows: not of trials */
    TOLERANCE_INVERSE,
    TOLERANCE_OFFENDERS,
    TOLERANCE_SHOWS
};

enum tolerance_method { TOLERANCE_EXACT, TOLERANCE_DIFFERENTIAL };

enum tolerance_aim { TOLERANCE_AIM_NOMINAL, TOLERANCE_AIM_STOP };

struct tolerance_input {
    struct lens_question question;
    struct spectrum_value waves;
    const char *grade, *tolerances, *criterion, *limit, *drop, *gap, *adjust, *save;
    int show, method, of, refocus, aim, pattern;
    long rays, seed, trials, threads;
    bool clip, no_clip;
    struct part part;
};

/* One lens being tried. */
struct tolerance_job {
    const struct tolerance_input *input;
    struct run *run;
    const struct lens *lens; /* as read */
    struct perturbations perturbations;
    const char *made; /* how well the lens is made, in words */
    struct tolerance_question question;
    struct tolerance tolerance; /* of the nominal lens */
    struct tolerance_run trials;
    struct tolerance_result result;
    struct part_head head; /* of a part, or of the run that is merged */
    double limit;          /* of figures; NaN: none */
    double drop;           /* what tolerances may cost together; NaN: not said */
    double aim_error;      /* of figures, by rays that are not aimed anew; NaN: they are */
    long save_count;       /* of --save worst:K; 0: none */
    long save_trial;       /* of --save trial:K, from 1; 0: none */
    struct second_order differential; /* of --method differential */
    struct tolerance_model model;     /* of its trials */
    double method_rms, method_most;   /* by what exact trials differ from it, of figures */
    const char *incomplete, *warning; /* null: all is well */
};

/* Read, try, count. */
bool tolerance_job_run(struct tolerance_job *job, struct error *error);

/* -------- commands/design/tolerance_ask.c -------- */

/* The question, from the options. */
bool tolerance_ask(struct tolerance_job *job, struct error *error);

/* -------- commands/design/tolerance_rows.c -------- */

extern const struct sheet *const tolerance_sheets[];
bool tolerance_emit(struct tolerance_job *job, struct error *error);

/* -------- commands/design/tolerance_files.c -------- */

/* --output: lenses of --save, or a part. */
bool tolerance_check_output(const struct artifact_job *job, struct error *error);
bool tolerance_write_output(const struct artifact_job *job, struct output *sink,
                            struct error *error);
const struct file_type *tolerance_types(size_t i);
size_t tolerance_count_output(const void *input);

#endif
