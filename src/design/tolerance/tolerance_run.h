/* design/tolerance/tolerance_run.h - many lenses as they may be made: what is counted of them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_TOLERANCE_RUN_H
#define LENSCALC_DESIGN_TOLERANCE_TOLERANCE_RUN_H

#include "base/text.h"
#include "base/watch.h"
#include "design/tolerance/second_order.h"
#include "design/tolerance/tolerance_trial.h"
#include "design/tolerance/trial_statistics.h"

#include <stdint.h>

/* Which figure of a lens is judged. */
enum tolerance_of {
    TOLERANCE_OF_WORST, /* of all fields and positions the worst */
    TOLERANCE_OF_MEAN,  /* their mean by the weights of the fields */
    TOLERANCE_OF_EACH   /* each by itself */
};

/* Trials to be made. Trial k is the same whatever others are made. */
struct tolerance_run {
    const struct tolerance_question *question;
    enum tolerance_of of;
    double limit; /* of a figure; NaN: none */
    uint64_t seed;
    uint64_t begin, end; /* trials begin .. end - 1 of */
    uint64_t total;      /* those of the whole run: 0 .. total - 1 */
    int threads;
    struct tolerance
        *ready; /* opened with the question, for the first thread; null: it opens one */
    const struct second_order *differential; /* figures and movements to second order, of the
                                                trials' own problem; null: by rays */
    struct watch *watch;                     /* counts trials, may stop them; or null */
};

enum { TOLERANCE_WORST_MOST = 1000, TOLERANCE_REASONS = 32 };

/* A lens among the worst. */
struct tolerance_worst {
    uint64_t trial; /* from 0 */
    double badness; /* criterion_badness of the worst of its figures, or of their mean */
};

/* Why lenses had no figures. */
struct tolerance_reason {
    uint64_t count, first; /* the first such trial */
    const char *why;
};

/* One figure that is judged. */
struct tolerance_column {
    const struct tolerance_figure *of; /* null: the worst, or the mean */
    struct trial_statistics tally;     /* of the figure */
    struct trial_statistics badness;   /* criterion_badness of it: what a limit is held against */
    uint64_t passed;
};

/* What came of them. */
struct tolerance_result {
    const struct tolerance *tolerance; /* the nominal lens and its figures */
    struct tolerance_column *columns;
    size_t column_count;
    struct trial_statistics *moves; /* of what is adjusted: tolerance_moves of them */
    uint64_t done, failed;
    struct tolerance_worst *worst; /* from the worst on */
    size_t worst_count, worst_most;
    struct tolerance_reason *reasons; /* by their words: the first so many in the alphabet */
    size_t reason_count;
    struct tolerance_reason others; /* what there was no room for; of no words */
    struct arena *arena;
};

/*
 * The errors of a trial, in units of half ranges.
 *
 * Formula   number i of trial k is the quantile of its distribution of a number that depends on
 *           seed, k and i alone
 */
void tolerance_errors(const struct tolerance_question *question, uint64_t seed, uint64_t trial,
                      double *errors);

/*
 * Make ready to count.
 *
 * Given     worst  so many of the worst are kept
 *           tolerance  opened with the question of the run
 */
void tolerance_result_open(const struct tolerance_run *run, const struct tolerance *tolerance,
                           size_t worst, struct arena *arena, struct tolerance_result *result);

/* Threads that are ready, each with a lens of its own. The run and the result must outlive it. */
struct tolerance_team;
struct tolerance_team *tolerance_team_open(const struct tolerance_run *run,
                                           struct tolerance_result *result);

/*
 * Trials begin .. begin + count - 1; where the watch stops them, some of them.
 *
 * Given     trials  receive each trial, with its room for figures and moves; null: nobody asks
 *           made    of each: by then it was; found: it has figures
 * Errors    as tolerance_open, in a thread
 */
struct tolerance_round {
    uint64_t begin;
    size_t count;
    struct tolerance_trial *trials;
    bool *made, *found;
};
bool tolerance_team_round(struct tolerance_team *team, const struct tolerance_round *round,
                          struct error *error);

/* What its threads have counted joins the result. */
void tolerance_team_close(struct tolerance_team *team);

/*
 * Make trials, and count them.
 *
 * Result    the same bytes for any number of threads, and for any parts that are joined. Where the
 *           watch stops it, those that were made by then: with several threads not the first ones
 * Errors    as tolerance_team_round
 */
bool tolerance_run(const struct tolerance_run *run, struct tolerance_result *result,
                   struct error *error);

/* Does a lens keep the limit, by the figure of one column? */
bool tolerance_passes(const struct tolerance *tolerance, const struct tolerance_run *run,
                      size_t column, const double *figures);

/* The figure that is judged, of all those of a lens; of TOLERANCE_OF_EACH the worst. */
double tolerance_judged(const struct tolerance *tolerance, enum tolerance_of of,
                        const double *figures);

/* As lines of text, and back, joined to what is there; false: it is not that. */
struct text tolerance_result_write(const struct tolerance_result *result, struct arena *arena);
bool tolerance_result_read(struct text body, struct tolerance_result *result);

#endif
