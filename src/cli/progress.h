/* cli/progress.h - how far long work is, on a terminal, and whether it shall go on. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_PROGRESS_H
#define LENSCALC_CLI_PROGRESS_H

#include "base/watch.h"

#include <stdbool.h>
#include <stddef.h>

/* How far the rows are. */
struct progress_state {
    size_t rows;
    double share; /* of all the work, 0 to 1; NaN = nobody knows */
};

/*
 * A line on a standard error that is a terminal, from half a second on, gone when the work ends or
 * anything else is written. Nobody pays for it: rows are counted down to the next look at the
 * clock, and how many those are follows from how fast they go.
 */
struct progress {
    size_t until, every; /* rows to the next look, and between looks */
    double started, looked, shown;
    size_t watched; /* items of the watch between looks */
    enum { PROGRESS_UNKNOWN, PROGRESS_SEEN, PROGRESS_UNSEEN } terminal;
    bool is_shared; /* standard output is a terminal too */
    size_t width;   /* of what is visible */
    const char *command;
    struct progress_state (*state)(const void *context);
    const void *context;
    struct watch watch; /* for what one row computes for long */
};

/* Seconds of a clock that only runs forward. */
double progress_clock(void);

/*
 * Begin.
 *
 * Given     command  its name
 *           state    asked at each look that shows something
 */
void progress_begin(struct progress *progress, const char *command,
                    struct progress_state (*state)(const void *context), const void *context);

/* Look at the clock, and show how far it is where somebody sees it. */
void progress_look(struct progress *progress);

/* One more row. */
static inline void progress_row(struct progress *progress)
{
    if (--progress->until == 0) {
        progress_look(progress);
    }
}

/* Take the line away, before anything else is written to standard error, and at the end. */
void progress_erase(struct progress *progress);

/* The same before something is written to standard output, if that is the same terminal. */
void progress_make_way(void *progress);

#endif
