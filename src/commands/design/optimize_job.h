/* commands/design/optimize_job.h - what optimize is asked, and what it found. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_JOB_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_JOB_H

#include "commands/lens/lens_options.h"
#include "design/glass_choice.h"
#include "design/optimize.h"

enum optimize_show {
    OPTIMIZE_ANSWER,
    OPTIMIZE_MERIT,
    OPTIMIZE_VARIABLES,
    OPTIMIZE_SPOTS,
    OPTIMIZE_GLASSES,
    OPTIMIZE_SHOWS
};

struct optimize_input {
    struct lens_question question;
    struct spectrum_value waves;
    const char *vary, *hold, *goals, *glasses, *grade, *tolerances;
    int show, solver, aim, pattern;
    long rays, seed, iterations; /* iterations: 0 = as many as it takes */
    long threads;                /* 0: one a core */
    long global, keep, escapes;  /* global: 0 = from the lens alone */
    double spread;
    struct part part; /* count 0: all of it */
    double seconds;   /* NaN = as long as it takes */
    bool clip, no_clip;
};

/* One lens being optimised. */
struct optimize_job {
    const struct optimize_job *earlier; /* of a sweep, while its jobs are kept; null: the first */
    const struct optimize_input *input;
    struct run *run;
    const struct lens *lens; /* as read */
    struct variables variables;
    const char *const *names; /* of the variables */
    const char *goals;        /* in words that --goals takes */
    bool guards;              /* the last goal keeps rays from loss, and is none of these words */
    struct perturbations errors; /* of the goal asbuilt */
    const char *made;            /* what they are, in words; null: there is no such goal */
    struct merit merit;
    struct optimize_task task;
    const struct glass_candidate *glasses; /* of --glasses */
    size_t glass_count;
    const struct glass_choice *choice; /* what they were used for; null: there are none */
    struct optimize_answer answer;
    const struct lens *found;
    const char *status, *warning; /* null: nothing is doubtful */
    const char *incomplete;       /* why it is not the best, in words; null: it is */
    double until;                 /* of progress_clock; infinite: no limit */
    bool is_late;
    /* of --global */
    const char *search;         /* in words; null: there is none */
    struct optimize_part *part; /* what of it goes into files */
    struct optimize_job *kept;  /* the best first, each a job with an answer */
    size_t kept_count;
    long rank, hits;  /* of one of them; starts that led to it */
    long evaluations; /* of the search */
    double *ends;     /* the best merit of each start that has one, the best first */
    size_t end_count;
};

/* Read what is asked; the merit is that of the question. */
bool optimize_open(struct optimize_job *job, struct merit_question *question, struct error *error);

/* Optimise from the lens itself, and look at what was found. */
bool optimize_near(struct optimize_job *job, struct error *error);

/* What a sweep varies: in every sheet, so that its rows can be told apart. */
#define OPTIMIZE_SWEPT_COLUMNS(row)                                                                \
    {COLUMN(row, fnumber),                                                                         \
     .flags = COLUMN_ECHO | COLUMN_EXTRA,                                                          \
     .name = "fnumber",                                                                            \
     .dimension = &dimension_fnumber,                                                              \
     .with = "aperture",                                                                           \
     .label = "f-number",                                                                          \
     .help = "f-number in place of the lens's own aperture"},                                      \
        {COLUMN(row, seed), .flags = COLUMN_ECHO | COLUMN_EXTRA,                                   \
         .name = "seed",    .with = "seed",                                                        \
         .label = "seed",   .help = "of the starts of --global, of the pattern sobol"},            \
    {                                                                                              \
        COLUMN(row, rank), .flags = COLUMN_EXTRA, .name = "rank", .with = "global",                \
                           .label = "rank", .help = "of the lenses that are kept, 1 the best"      \
    }

/* After an answer: the lens that was found, how it ended, and what is doubtful about it. */
bool optimize_judge(struct optimize_job *job, struct error *error);

/* One doubt more. */
void optimize_warn(struct optimize_job *job, const char *words);

/* The rows of --show. */
extern const struct sheet *const optimize_sheets[];
bool optimize_emit(struct optimize_job *job, struct error *error);

/* --output, after `run`. */
bool optimize_save(const struct artifact_job *job, struct output *sink, struct error *error);

/* A part goes into a file that is called so. */
bool optimize_check_saved(const struct artifact_job *job, struct error *error);

/* --state, after `run`. */
bool optimize_save_state(const struct artifact_job *job, struct output *sink, struct error *error);

/* --plot: the merit against the iteration. */
bool optimize_plot(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
