/* design/optimize.c - a lens made better, from where it is. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize.h"

#include "design/optimize_start.h"

#include <math.h>
#include <string.h>

/* A run, as its progress is told. */
struct optimize_progress {
    const struct optimize_task *task;
    struct optimize_answer *answer;
    struct arena *arena;
    size_t room;
};

/* Steps that gain a smaller share of the merit are the last ones: a lens is not known better. */
static const double least_gain = 1e-8;

static struct optimize_state new_state(const struct merit *merit, struct arena *arena)
{
    return (struct optimize_state){.numbers = ARENA_ARRAY(arena, merit->variable_count + 1, double),
                                   .residuals =
                                       ARENA_ARRAY(arena, merit->residual_count + 1, double),
                                   .values = ARENA_ARRAY(arena, merit->residual_count + 1, double)};
}

/* Evaluate where `state` has its numbers; derivatives of all goals, of those too that are met. */
static bool optimize_look(struct merit *merit, struct optimize_state *state, double *jacobian)
{
    if (!merit_measure(merit, state->numbers, state->residuals, jacobian)) {
        return false;
    }
    merit_drop_met(merit, state->residuals, NULL);
    memcpy(state->values, merit->values, merit->residual_count * sizeof(double));
    state->merit = 0;
    for (size_t i = 0; i < merit->residual_count - merit->exact_count; i++) {
        state->merit += state->residuals[i] * state->residuals[i];
    }
    return true;
}

/* Where a variable moves by its natural scale, and no residual by more than this share of the
   largest of them, it is rounding that moves it. */
static const double rounding = 1e-10;

void optimize_find_effects(const struct merit *merit, const double *residuals,
                           const double *jacobian, bool *is_idle)
{
    double largest = 0;
    for (size_t i = 0; i < merit->residual_count; i++) {
        largest = fmax(largest, fabs(residuals[i]));
    }
    for (size_t j = 0; j < merit->variable_count; j++) {
        const double scale = merit->question.variables->scale[j];
        for (size_t i = 0; i < merit->residual_count && is_idle[j]; i++) {
            const double effect = fabs(jacobian[i * merit->variable_count + j]) * scale;
            is_idle[j] = !(effect > rounding * largest);
        }
    }
}

static void optimize_note(struct optimize_progress *running, double merit)
{
    struct optimize_answer *answer = running->answer;
    answer->history = arena_grow(running->arena, answer->history, answer->history_count,
                                 &running->room, sizeof *answer->history);
    answer->history[answer->history_count++] = merit;
}

static bool progress(void *context, const struct solver_progress *progress)
{
    struct optimize_progress *running = context;
    optimize_note(running, 2 * progress->cost);
    return running->task->goes_on == NULL || running->task->goes_on(running->task->context);
}

static void judge_as_nothing(const struct merit *merit, struct optimize_state *state)
{
    state->merit = NAN;
    for (size_t i = 0; i < merit->residual_count; i++) {
        state->residuals[i] = state->values[i] = NAN;
    }
}

/* From the start; ends where the lens has a value. */
static bool optimize_run_once(struct optimize_progress *running, double *jacobian,
                              struct error *error)
{
    const struct optimize_task *task = running->task;
    struct optimize_answer *answer = running->answer;
    struct arena *arena = running->arena;
    struct merit *merit = task->merit;
    const size_t size = merit->residual_count * sizeof(double);
    running->room = 0;
    *answer = (struct optimize_answer){.before = new_state(merit, arena),
                                       .after = new_state(merit, arena),
                                       .is_idle = ARENA_ARRAY(arena, merit->variable_count, bool)};
    struct optimize_state *before = &answer->before, *after = &answer->after;
    variables_get(merit->question.variables, before->numbers);
    memcpy(after->numbers, task->start != NULL ? task->start : before->numbers,
           merit->variable_count * sizeof(double));
    if (task->start != NULL && !optimize_look(merit, before, NULL)) {
        judge_as_nothing(merit, before);
    }
    if (!optimize_begin(task, after->numbers, arena, &answer->begun, error)) {
        return false;
    }
    if (!optimize_look(merit, after, jacobian)) {
        *error = merit->why;
        return error_prefix(error, "the lens cannot be judged where it is begun: ");
    }
    for (size_t j = 0; j < merit->variable_count; j++) {
        answer->is_idle[j] = true;
    }
    optimize_find_effects(merit, after->residuals, jacobian, answer->is_idle);
    if (task->start == NULL && answer->begun != NULL) {
        judge_as_nothing(merit, before);
    } else if (task->start == NULL) { /* the lens as it was, that is begun with its own numbers */
        before->merit = after->merit;
        memcpy(before->residuals, after->residuals, size);
        memcpy(before->values, after->values, size);
    }
    optimize_note(running, after->merit);
    const struct solver_problem problem = optimize_problem(merit);
    const struct solver_options options = {.engine = task->engine,
                                           .iterations = task->iterations,
                                           .function = least_gain,
                                           .lean = true,
                                           .progress = progress,
                                           .progress_context = running};
    if (!solver_run(&problem, &options, after->numbers, arena, &answer->summary, error)) {
        return false;
    }
    if (!optimize_look(merit, after, jacobian)) {
        *error = merit->why;
        return error_prefix(error, "the lens that was found cannot be judged: ");
    }
    return true;
}

bool optimize_run(const struct optimize_task *task, struct arena *arena,
                  struct optimize_answer *answer, struct error *error)
{
    struct merit *merit = task->merit;
    struct optimize_progress running = {.task = task, .answer = answer, .arena = arena};
    double *jacobian =
        ARENA_ARRAY(arena, merit->residual_count * merit->variable_count + 1, double);
    if (!optimize_run_once(&running, jacobian, error)) {
        /* where rays are just lost, some are found only from a lens that still has them */
        merit->forgets = true;
        if (!optimize_run_once(&running, jacobian, error)) {
            return false;
        }
    }
    optimize_find_effects(merit, answer->after.residuals, jacobian, answer->is_idle);
    optimize_note(&running, answer->after.merit);
    return true;
}
