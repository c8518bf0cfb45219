/* commands/design/tolerance_job.h - what tolerance is asked, and what came of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_JOB_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_JOB_H

#include "cli/question/artifact.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/design.h"
#include "design/tolerance/second_order.h"
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

/* -------- what all rows of tolerance say of their run -------- */

/* What every row says of the run. */
struct tolerance_about {
    double fnumber;
    long seed;
    const char *tolerances, *lens, *method, *rays, *adjusted, *limit, *warning;
};

/* Whatever trials depend on: some of them say how far rays and methods are right. */
#define TOLERANCE_TRIED_BY                                                                         \
    "lens grade tolerances criterion of refocus gap adjust trials seed method aim wavelength "     \
    "field position aperture section pattern rays clip no-clip"

#define TOLERANCE_ABOUT_COLUMN(S, member, on, words)                                               \
    ENTRY(COLUMN(S, about.member), .flags = COLUMN_EXTRA | COLUMN_ASSUMED, .name = #member,        \
          .depends = on, .label = #member, .help = words)

#define TOLERANCE_ABOUT_COLUMNS(S)                                                                 \
    LENS_FNUMBER_COLUMN(S, about.fnumber),                                                         \
        LENS_SEED_COLUMN(S, about.seed, "another one gives other trials"),                         \
        TOLERANCE_ABOUT_COLUMN(S, tolerances, "grade tolerances lens",                             \
                               "how many independent errors, and where they are from"),            \
        TOLERANCE_ABOUT_COLUMN(S, limit, "limit", "of the figures of a lens that passes"),         \
        TOLERANCE_ABOUT_COLUMN(                                                                    \
            S, adjusted, "refocus gap adjust",                                                     \
            "what is moved in every lens, to make its spots or wave fronts best"),                 \
        ENTRY(COLUMN(S, about.method), .flags = COLUMN_EXTRA | COLUMN_ASSUMED | COLUMN_SPARSE,     \
              .name = "method", .depends = TOLERANCE_TRIED_BY, .label = "method",                  \
              .help = "how trials were made"),                                                     \
        TOLERANCE_ABOUT_COLUMN(S, rays, TOLERANCE_TRIED_BY, "those of each field and wavelength"), \
        LENS_TITLE_COLUMN(S, about.lens), LENS_WARNING_COLUMN(S, about.warning)

/* What a row is of. */
#define TOLERANCE_CRITERION_COLUMNS(S)                                                             \
    LENS_POSITION_COLUMN(S, position, COLUMN_BRIEF),                                               \
        ENTRY(COLUMN_NAMED(S, criterion, COLUMN_BRIEF), .help = "what lenses are judged by"),      \
        ENTRY(COLUMN_NAMED(S, of, COLUMN_BRIEF),                                                   \
              .help = "worst or mean of all fields and positions, or the field"),                  \
        ENTRY(COLUMN_NAMED(S, unit, COLUMN_BRIEF), .help = "of its figures")

struct tolerance_about tolerance_about_of(const struct tolerance_job *job);

/* "10deg", "3mm"; of a position "lens"; of null "worst" or "mean". */
const char *tolerance_name_of(const struct tolerance_job *job,
                              const struct tolerance_figure *figure);
const char *tolerance_position_of(const struct tolerance_job *job,
                                  const struct tolerance_figure *figure);

/* How far the image plane went, mm; NaN where it stays but for what else is adjusted, which may be
   its gap. */
double tolerance_refocus_of(const struct tolerance_job *job, double refocus);

/* "5:-1 0.02 mm, ay9 0.1 deg" of the movements of a lens, the refocus first, which is left out;
   of null what they were in all trials, "5:-1 0.02 +- 0.01 mm". Null: nothing else is adjusted. */
const char *tolerance_moves_in_words(const struct tolerance_job *job, const double *moves);

/* -------- what each error costs, and what errors may be -------- */

extern const struct sheet tolerance_sensitivity_sheet, tolerance_inverse_sheet,
    tolerance_offenders_sheet;

/* Rows of each: --show sensitivity, inverse, offenders. */
bool tolerance_emit_sensitivity(struct tolerance_job *job, struct error *error);
bool tolerance_emit_inverse(struct tolerance_job *job, struct error *error);
bool tolerance_emit_offenders(struct tolerance_job *job, struct error *error);

/* Who makes the figures spread, the largest first. */
struct tolerance_offender {
    size_t perturbation;
    struct second_order_share share;
};
bool tolerance_offenders(struct tolerance_job *job, struct tolerance_offender **offenders,
                         struct error *error);

#endif
