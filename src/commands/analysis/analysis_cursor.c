/* commands/analysis/analysis_fields.c - analyses answered field by field, by several threads. */
/* SPDX-License-Identifier: MIT */
#include "commands/analysis/analysis_fields.h"

#include "report/row.h"

#include <string.h>

/* -------- several threads -------- */

/* Work on a case, and what each thread has of it. */
struct case_division {
    struct analysis_case *cases;
    analysis_work *work;
    void *context;
};

static void do_items(void *context, const struct parallel_piece *piece)
{
    const struct case_division *dividing = context;
    for (size_t i = piece->begin; i < piece->end; i++) {
        dividing->work(&dividing->cases[piece->thread], i, dividing->context);
    }
}

void analysis_divide(const struct analysis_case *one, size_t count, analysis_work *work,
                     void *context)
{
    struct arena *arena = one->setup->arena;
    const size_t all = one->threads > 1 ? (size_t)one->threads : 1;
    const size_t threads = all < count ? all : count;
    if (threads <= 1) {
        for (size_t i = 0; i < count; i++) {
            work(one, i, context);
        }
        return;
    }
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    struct case_division dividing = {ARENA_ARRAY(arena, threads, struct analysis_case), work,
                                     context};
    parallel->threads = (int)threads;
    for (size_t i = 0; i < threads; i++) {
        struct setup *apart = ARENA_NEW(arena, struct setup);
        *apart = setup_apart(one->setup, &parallel->arenas[i]);
        dividing.cases[i] = *one;
        dividing.cases[i].setup = apart;
        dividing.cases[i].threads = (int)(all / threads);
    }
    parallel_pieces(parallel, count, 1, do_items, &dividing);
    for (size_t i = 0; i < threads; i++) {
        arena_adopt(arena, &parallel->arenas[i]);
    }
}

/* -------- fields -------- */

/* What answers a case. */
struct case_answers {
    struct run *run;
    const struct analysis_answers *answers;
    void *context;
    bool names; /* the field, where it fails: there may be others */
};

/* What was found of the fields of a case. */
struct findings {
    const struct case_answers *answering;
    char *found; /* found_size bytes each */
    struct error *errors;
};

static void find_one(const struct analysis_case *one, size_t field, void *context)
{
    const struct findings *findings = context;
    const struct analysis_answers *answers = findings->answering->answers;
    struct error *error = &findings->errors[field];
    error->code = ERROR_NONE;
    answers->find(one, field, findings->answering->context,
                  findings->found + field * answers->found_size, error);
}

/* Of all fields at once where there are threads, else when it is wanted. */
static struct findings open_findings(const struct analysis_case *one,
                                     const struct case_answers *answering)
{
    struct arena *arena = one->setup->arena;
    const size_t count = one->setup->field_count, size = answering->answers->found_size;
    struct findings findings = {answering, NULL, NULL};
    if (answering->answers->find != NULL) {
        findings.found = arena_array(arena, count, size);
        findings.errors = ARENA_ARRAY(arena, count, struct error);
        if (one->threads > 1) {
            analysis_divide(one, count, find_one, &findings);
        }
    }
    return findings;
}

static bool answer_one(const struct analysis_case *one, size_t field, struct findings *findings,
                       struct error *error)
{
    const struct analysis_answers *answers = findings->answering->answers;
    void *context = findings->answering->context;
    if (answers->find == NULL) {
        return answers->answer(one, field, context, error);
    }
    if (one->threads <= 1) {
        find_one(one, field, findings);
    }
    if (findings->errors[field].code != ERROR_NONE) {
        *error = findings->errors[field];
        return false;
    }
    return answers->take(one, field, findings->found + field * answers->found_size, context, error);
}

/* A field that failed: its row says why. False: no more rows are wanted. */
static bool analysis_fields_keep_place(const struct analysis_case *one, size_t field,
                                       const struct case_answers *answering,
                                       const struct error *error)
{
    struct run *run = answering->run;
    struct analysis_point point = analysis_point_of(one, field);
    run->shortfall = *error;
    error_prefix(&run->shortfall,
                 "%s: ", lens_field_words(&one->setup->fields[field].point, run->arena));
    point.warning = arena_printf(run->arena, "%s", run->shortfall.message);
    return answering->answers->lost(&point, answering->context);
}

static bool answer_fields(const struct analysis_case *of, void *context, struct error *error)
{
    const struct case_answers *answering = context;
    const struct analysis_answers *answers = answering->answers;
    const bool keeps = answers->lost != NULL;
    struct analysis_case *one = ARENA_NEW(of->setup->arena, struct analysis_case);
    *one = *of;
    one->threads = answering->run->threads;
    if (answers->check != NULL && !answers->check(one, answering->context, error)) {
        return false;
    }
    struct findings findings = open_findings(one, answering);
    for (size_t i = 0; i < one->setup->field_count; i++) {
        error->code = ERROR_NONE;
        if (answer_one(one, i, &findings, error)) {
            continue;
        }
        if (error->code == ERROR_NONE || error->code == ERROR_USAGE ||
            (!keeps && !answering->names)) {
            return false;
        }
        if (!keeps) {
            return error_prefix(
                error,
                "%s: ", lens_field_words(&one->setup->fields[i].point, answering->run->arena));
        }
        if (!analysis_fields_keep_place(one, i, answering, error)) {
            error->code = ERROR_NONE;
            return false;
        }
    }
    return true;
}

bool analysis_each_field(const struct analysis_question *question,
                         const struct analysis_policy *policy, struct run *run,
                         const struct analysis_answers *answers, void *context, struct error *error)
{
    struct case_answers answering = {run, answers, context, policy->fields == FIELDS_ALL};
    error->code = ERROR_NONE;
    return analysis_each(question, policy, run->arena, answer_fields, &answering, error) ||
           error->code == ERROR_NONE;
}

bool analysis_skip(const struct analysis_point *point, void *context)
{
    (void)point;
    (void)context;
    return true;
}

/* -------- rows -------- */

static void analysis_fields_begin_row(const struct analysis_asked *asked,
                                      const struct analysis_point *point, void *row)
{
    row_clear(asked->rows->sheet, row);
    memcpy(row, point, sizeof *point);
    if (asked->rows->repeat != NULL) {
        asked->rows->repeat(asked->input, row);
    }
}

void analysis_begin_row(const struct analysis_asked *asked, const struct analysis_case *one,
                        size_t field, void *row)
{
    const struct analysis_point point = analysis_point_of(one, field);
    analysis_fields_begin_row(asked, &point, row);
}

static bool lost(const struct analysis_point *point, void *context)
{
    const struct analysis_asked *asked = context;
    void *row = arena_array(asked->run->arena, 1, asked->rows->sheet->row_size);
    analysis_fields_begin_row(asked, point, row);
    return run_emit(asked->run, row);
}

bool analysis_answer_rows(const void *input, const struct analysis_rows *rows, struct run *run,
                          struct error *error)
{
    struct analysis_answers answers = rows->answers;
    struct analysis_asked asked = {input, run, rows};
    answers.lost = analysis_makes_many(input, rows->policy) ? lost : NULL;
    return analysis_each_field(input, rows->policy, run, &answers, &asked, error);
}

void analysis_warn(const struct analysis_asked *asked, struct analysis_point *point,
                   const char *words)
{
    point->warning = lens_warnings_join(point->warning, words, asked->run->arena);
}
