/* commands/analysis/analysis_fields.h - analyses answered field by field, by several threads. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_FIELDS_H
#define LENSCALC_COMMANDS_ANALYSIS_ANALYSIS_FIELDS_H

#include "commands/analysis/analysis_options.h"

/* -------- several threads -------- */

/* Item `item` of some work on a case; what it takes of one->setup->arena stays. */
typedef void analysis_work(const struct analysis_case *one, size_t item, void *context);

/*
 * Do items 0 .. count - 1 with the threads of a case. Each has a case, a setup and an arena of its
 * own; an item leaves its results in a place of its own, and they may not depend on which items the
 * same thread did before.
 */
void analysis_divide(const struct analysis_case *one, size_t count, analysis_work *work,
                     void *context);

/* -------- fields -------- */

/*
 * Who answers field by field: either `answer`, or `find` and then `take`. All of them but `find`
 * are called in the order of the fields, `check` before them.
 */
struct analysis_answers {
    /* May all of a case be asked that? What is wrong is said once, of no field. Null: it may. */
    bool (*check)(const struct analysis_case *one, const void *context, struct error *error);
    /* All of one field; false to fail, or without an error when no more are wanted. */
    bool (*answer)(const struct analysis_case *one, size_t field, void *context,
                   struct error *error);
    /*
     * What takes time, into room for found_size bytes, zeroed. Threads find several fields at once:
     * `context` is only read, and memory is that of one->setup->arena.
     */
    bool (*find)(const struct analysis_case *one, size_t field, const void *context, void *found,
                 struct error *error);
    size_t found_size;
    /* What was found becomes rows, or part of a drawing; else as `answer`. */
    bool (*take)(const struct analysis_case *one, size_t field, const void *found, void *context,
                 struct error *error);
    /* A field that has failed: all but its place is absent. Null: such a field ends all. */
    bool (*lost)(const struct analysis_point *point, void *context);
};

/* For `lost`: a drawing does without the field. */
bool analysis_skip(const struct analysis_point *point, void *context);

/*
 * Answer field by field. Where one fails and there is `lost`, that is told its place, with the
 * reason as its warning, and the question counts as failed (run->shortfall).
 *
 * Errors    as analysis_each and `answer`, the field named where there may be several
 */
bool analysis_each_field(const struct analysis_question *question,
                         const struct analysis_policy *policy, struct run *run,
                         const struct analysis_answers *answers, void *context,
                         struct error *error);

/* -------- rows -------- */

/* How a command makes rows of fields. They begin with their struct analysis_point. */
struct analysis_rows {
    const struct analysis_policy *policy;
    const struct sheet *sheet;
    /* What every row, also that of a field that has failed, repeats of the input. Null: nothing. */
    void (*repeat)(const void *input, void *row);
    struct analysis_answers answers; /* their context is a struct analysis_asked; without `lost` */
};

/* What is asked, and where the rows go. */
struct analysis_asked {
    const void *input; /* of the command, which begins with its struct analysis_question */
    struct run *run;
    const struct analysis_rows *rows;
};

/*
 * The rows of an input. Where one of several fields fails its row keeps its place.
 *
 * Errors    as analysis_each_field
 */
bool analysis_answer_rows(const void *input, const struct analysis_rows *rows, struct run *run,
                          struct error *error);

/* A row of a field that has all that is known without an answer; the rest is absent. */
void analysis_begin_row(const struct analysis_asked *asked, const struct analysis_case *one,
                        size_t field, void *row);

/* Add to what is doubtful about a row; null: nothing is. */
void analysis_warn(const struct analysis_asked *asked, struct analysis_point *point,
                   const char *words);

#endif
