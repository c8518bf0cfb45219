/* design/tolerance/trial_statistics.h - figures of many trials, counted: their moments and percentiles. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_TRIAL_STATISTICS_H
#define LENSCALC_DESIGN_TOLERANCE_TRIAL_STATISTICS_H

#include "base/arena.h"
#include "base/exact_accumulator.h"
#include "base/text.h"
#include "optics/growing.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Up to so many figures are kept as they are; of more it is counted how many lie in each bin. */
enum { TRIAL_STATISTICS_KEPT = 1 << 16 };

/* Powers of the departure from the nominal figure that are summed. */
enum { TRIAL_STATISTICS_POWERS = 4 };

/*
 * Figures, by what they depart from a nominal one. What it says does not depend on the order they
 * came in, nor on how they were divided: sums are exact, counts are whole numbers. Its memory does
 * not grow with them.
 *
 * Bins are those of the floating-point numbers themselves: 4096 of each power of 2 and each sign,
 * so that a percentile is found to 1/8192 of the departure, less than its standard error even of
 * 1e7 trials. Pages of a power of 2 are made when the first figure falls there.
 */
struct trial_statistics {
    double nominal;
    uint64_t count;
    bool keeps; /* there will be TRIAL_STATISTICS_KEPT of them at most, of all that are joined */
    struct exact_accumulator powers[TRIAL_STATISTICS_POWERS];
    double *kept;     /* departures, */
    bool is_sorted;   /* in the order of their size */
    uint64_t **pages; /* TALLY_PAGES of them; null: nothing there */
    double lowest, highest;
    struct arena *arena;
};

/* Given     total  of the whole run, which tells what is kept */
void trial_statistics_open(double nominal, uint64_t total, struct arena *arena,
                           struct trial_statistics *tally);

/* Given     figure  finite */
void trial_statistics_add(struct trial_statistics *tally, double figure);

/* Given     more  of the same nominal figure and total */
void trial_statistics_join(struct trial_statistics *tally, const struct trial_statistics *more);

/* Mean and standard deviation, and their standard errors; NaN of fewer than one or two. */
struct trial_statistics_moments {
    double mean, sd, mean_error, sd_error;
};

/*
 * Formula   mean nominal + S1/n; variance (S2 - S1^2/n)/(n - 1); errors sd/sqrt(n), and
 *           sd sqrt((k - 1)/n)/2 with the fourth moment over the squared variance k
 * Source    [Kendall77] 10.5, 10.9
 */
struct trial_statistics_moments trial_statistics_moments(const struct trial_statistics *tally);

/*
 * Percentiles.
 *
 * Given     share   0 .. 1
 *           error   receives its standard error, half the way between the shares one standard
 *                   deviation of their count apart; null: not wanted
 * Result    the figure of rank share (n - 1), between two of them in proportion; NaN of none
 * Source    [Hyndman96] definition 7; of a bin evenly spread within
 */
double trial_statistics_quantile(struct trial_statistics *tally, double share, double *error);

/* Counts of `bins` equal parts of low .. high: for drawings. */
void trial_statistics_histogram(struct trial_statistics *tally, double low, double high,
                                size_t bins, double *counts);

/*
 * As lines of text, and back, joined to what is there.
 *
 * Result    of the second: false: it is not what trial_statistics_write writes
 */
void trial_statistics_write(const struct trial_statistics *tally, struct text_buffer *text);
bool trial_statistics_read(struct text *rest, struct trial_statistics *tally);

/* The next word of a line, as a whole number. */
bool trial_statistics_take(struct text *line, int64_t *number);

#endif
