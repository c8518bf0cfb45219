/* cli/question/sweep.h - lists and ranges of options, and their Cartesian product. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_SWEEP_H
#define LENSCALC_CLI_QUESTION_SWEEP_H

#include "cli/question/arguments.h"

/* An option that takes several values. */
struct axis {
    const struct option *option;
    const char *values; /* count members of option->kind->size bytes */
    size_t count;
    const struct unit *unit; /* in which the values were typed, for plots; null = none */
};

struct sweep {
    struct axis *axes; /* in the order of the command's options: the first is slowest */
    size_t axis_count;
    size_t total; /* combinations; 1 without axes */
    const struct reader *reader;
    struct focal_options focal; /* for sweep_recall */
};

/*
 * Read the options of a command into its input struct; lists and ranges become axes.
 *
 * Given     input  the command's struct; members not swept are set, absent ones cleared
 *           force  allow more than a million combinations
 *           reader  lives as long as the sweep
 * Errors    as option_read; a range that never ends or has no step; too many combinations
 */
bool sweep_build(struct sweep *sweep, const struct arguments *arguments,
                 const struct reader *reader, bool force, void *input, struct error *error);

/* -------- cli/question/sweep_set.c -------- */

/* Put combination `index` (0 .. total - 1) into the input, as the axes have it. */
void sweep_set(const struct sweep *sweep, size_t index, void *input);

/*
 * The same, and whole: where reader->recalls, an axis may have no more than the name of a value;
 * focal lengths are settled.
 *
 * Result    what was read again lives until so many have been read as are wanted at once
 * Errors    as option_read: what was good when the sweep was built may have changed; as
 *           focal_settle
 */
bool sweep_recall(const struct sweep *sweep, size_t index, void *input, struct error *error);

/* The axis of this option; null if it is not swept. */
const struct axis *sweep_axis(const struct sweep *sweep, const char *option);

/* Has the axis numbers: quantities, or wavelengths, some of which may be typed as lines? */
bool axis_is_number(const struct axis *axis);

/* Value of such an axis, in the program's own unit. */
double axis_number(const struct axis *axis, size_t index);

/* Put another number of such an axis into the input; false: its option takes none. */
bool axis_set_number(const struct sweep *sweep, const struct axis *axis, double number,
                     void *input);

/* A text or a drawing is that of one value of each option, but those that an artifact varies. */
bool sweep_check_single(const struct sweep *sweep, const struct command *command,
                        struct error *error);

#endif
