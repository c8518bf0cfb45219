/* cli/answer/rows.h - the rows of a question: every combination of a sweep, every line of a batch. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_ROWS_H
#define LENSCALC_CLI_ANSWER_ROWS_H

#include "cli/answer/collect.h"
#include "cli/answer/rows_team.h"
#include "cli/batch/batch.h"
#include "cli/batch/gaps.h"
#include "cli/batch/photographs.h"
#include "cli/batch/queue.h"
#include "cli/progress.h"
#include "cli/question/configuration.h"
#include "cli/question/echo.h"

/* One command at work. */
struct driver {
    const struct command *command;
    const struct command *const *commands; /* all there are */
    struct arena arena;                    /* until the end */
    struct arena row_arena;                /* until the next input */
    struct lensdb db;
    struct reader reader;
    struct lens_cache lenses;
    struct arguments arguments;
    struct config_file defaults; /* of the user's */
    struct common common;
    struct sweep sweep;
    struct batch batch;
    struct run run;
    struct report report;
    struct selection selection;
    struct output output;
    struct collection collection;
    struct artifacts artifacts;
    struct paths photographs;   /* that are the rows of the batch; none: those of a table are */
    struct option_query asking; /* the columns of a batch count as given */
    struct arena kept;          /* of the command, until the end */
    struct warnings doubts;
    struct team *team;                /* who answers the sweep; null: the driver itself */
    struct queue queue;               /* rows of the batch that wait to be computed together */
    struct echo echo;                 /* what rows repeat beside the command's own columns */
    size_t known_columns;             /* of the batch; objects of JSON may bring more */
    const void *answered;             /* the input whose rows come */
    const struct passed_cell *passed; /* columns passed through, of the row being printed */
    void *input;
    void *constants; /* of a batch: the input as options set it */
    const char *database;
    bool is_batch, is_open, begun, collects;
    bool is_inside; /* another command: its answer stays in memory, nothing is said */
    bool is_again;  /* asked by another command: its words say all, as they did the first time */
    size_t index;   /* of the present combination of the sweep */
    size_t good, failed;
    struct error said;     /* the last failure that was printed, as it came */
    struct gaps gaps;      /* of the rows of a batch */
    bool has_answer;       /* to at least one input, if only in part */
    const void *explained; /* the row whose numbers --explain puts in */
    struct progress progress;
    const struct column *hidden_notes[2]; /* of rows whose format shows them nowhere */
    size_t hidden_count;
    bool only_prints;   /* nothing is left to do with further rows but that */
    bool has_ended;     /* all rows are written, and what follows them */
    bool is_broken_off; /* the failure that ends the work has its row */
};

/*
 * All rows have the columns of the first input.
 *
 * Errors    ERROR_USAGE: this input asks for others
 */
bool rows_check_sheet(const struct driver *driver, struct error *error);

/* The head of the output, before its first row. */
void rows_begin(struct driver *driver);

/* A row of the answer. */
bool rows_emit(struct run *run, const void *row);

/* What `run` hands its rows to, in the middle of work that can be broken off. */
bool rows_emit_amid(struct run *run, const void *row);

/*
 * Answer every combination of a sweep, or every row of a batch. One that fails keeps its place and
 * is complained about; one combination is an ordinary answer.
 *
 * Errors    what ends the work before its end
 */
bool rows_of_sweep(struct driver *driver, struct error *error);
bool rows_of_batch(struct driver *driver, struct error *error);

/* As struct collection has it: `answer` of the driver's command. */
const void *rows_answer(void *driver, void *input);

/* End an output that has begun, with the failure that ends the work in the place of its row. */
void rows_break_off(struct driver *driver, struct error *failure);

/* How far they are. */
struct progress_state rows_state(const void *driver);

/*
 * End the program in the middle of work that has not noticed an interrupt: the rows so far are the
 * answer, and files that are not complete do not appear. The work goes on meanwhile, in arenas of
 * its own.
 */
void rows_interrupted(void *context);

#endif
