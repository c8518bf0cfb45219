/* design/optimize.c - a lens made better, from where it is. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize.h"

#include "design/merit/merit_beams.h"
#include "design/optimize_descend.h"

#include <math.h>
#include <string.h>

/* Iterations, where nobody says how many: on beyond the usual ones while the last of them gain. */
enum { USUAL_ITERATIONS = 200, MOST_ITERATIONS = 1000, LAST_ITERATIONS = 20 };
static const double last_gain = 0.01;

/* A run, as its progress is told. */
struct optimize_progress {
    const struct optimize_task *task;
    struct optimize_answer *answer;
    struct arena *arena;
    size_t room;
    bool is_at_limit; /* of iterations, whose last gain little */
};

/* Steps that gain a smaller share of the merit are the last ones: a lens is not known better. */
static const double least_gain = 1e-8;

static struct optimize_state new_state(const struct merit *merit, struct arena *arena)
{
    return (struct optimize_state){
        .numbers = ARENA_ARRAY(arena, merit->variable_count + 1, double),
        .residuals = ARENA_ARRAY(arena, merit->residual_count + 1, double),
        .values = ARENA_ARRAY(arena, merit_value_count(merit) + 1, double)};
}

/* Evaluate where `state` has its numbers; derivatives of all goals, of those too that are met. */
static bool optimize_look(struct merit *merit, struct optimize_state *state, double *jacobian)
{
    if (!merit_measure(merit, state->numbers, state->residuals, jacobian)) {
        return false;
    }
    merit_drop_met(merit, state->residuals, NULL);
    memcpy(state->values, merit->values, merit_value_count(merit) * sizeof(double));
    state->merit = 0;
    for (size_t i = 0; i < merit->residual_count - merit->exact_count; i++) {
        state->merit += state->residuals[i] * state->residuals[i];
    }
    return true;
}

/* The field of a residual of rays, counted from 1, in words. */
static const char *optimize_field_of(const struct merit *merit, const struct merit_slot *slot,
                                     size_t residual)
{
    const enum operand_kind kind = slot->operand->kind;
    size_t field = LENS_NONE;
    if (kind != OPERAND_SPOT && kind != OPERAND_POLY && kind != OPERAND_OPD) {
        return "";
    }
    const struct merit_bundle *bundle = &slot->beams->bundle;
    for (size_t i = 0; i < bundle->group_count; i++) {
        field = bundle->groups[i].row <= residual ? bundle->groups[i].field : field;
    }
    return arena_printf(merit->arena, " for a ray of field %zu", field + 1);
}

/* A solver begins with numbers whose squares are some: what is none, a goal or its derivative by a
   variable. */
static bool optimize_check_numbers(const struct merit *merit, const double *residuals,
                                   const double *jacobian, struct error *error)
{
    static const double most = 1e150;
    const size_t n = merit->variable_count;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        for (size_t k = 0; k < slot->count; k++) {
            const size_t row = slot->first + k;
            size_t j = 0;
            while (j < n && fabs(jacobian[row * n + j]) <= most) {
                j++;
            }
            if (!(fabs(residuals[row]) <= most)) {
                const char *off = isnan(residuals[row])
                                      ? "is not a number"
                                      : arena_printf(merit->arena, "is off by %.3g deviations",
                                                     fabs(residuals[row]));
                return fail(error, ERROR_DOMAIN, "the goal %s %s%s where the lens begins",
                            slot->operand->name, off, optimize_field_of(merit, slot, k));
            }
            if (j < n) {
                const char *name = merit->question.variables->list[j].name;
                fail(error, ERROR_DOMAIN,
                     "the goal %s has no derivative by %s%s where the lens begins",
                     slot->operand->name, name, optimize_field_of(merit, slot, k));
                return error_hint(error, "begin with another %s, or hold it", name);
            }
        }
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
    const struct optimize_answer *answer = running->answer;
    optimize_note(running, 2 * progress->cost);
    if (running->task->iterations == 0 && answer->history_count > USUAL_ITERATIONS) {
        const double *last = &answer->history[answer->history_count - 1];
        running->is_at_limit = !(last[-LAST_ITERATIONS] - *last > last_gain * *last);
        if (running->is_at_limit) {
            return false;
        }
    }
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
    running->is_at_limit = false;
    merit->limit->count = 0;
    *answer = (struct optimize_answer){.before = new_state(merit, arena),
                                       .after = new_state(merit, arena),
                                       .is_idle = ARENA_ARRAY(arena, merit->variable_count, bool)};
    struct optimize_state *before = &answer->before, *after = &answer->after;
    const struct variables *variables = merit->question.variables;
    const size_t row = merit->variable_count * sizeof(double);
    memcpy(before->numbers, variables->own, row);
    memcpy(after->numbers, task->start != NULL ? task->start : variables->start, row);
    /* a lens outside of its bounds, too, is not begun with its own numbers */
    const bool is_elsewhere = task->start != NULL || variables_moved(variables, arena) != NULL;
    if (is_elsewhere && !optimize_look(merit, before, NULL)) {
        judge_as_nothing(merit, before);
    }
    if (!optimize_begin(task, after->numbers, arena, &answer->begun, error)) {
        return false;
    }
    if (!optimize_look(merit, after, jacobian)) {
        *error = merit->why;
        return error_prefix(error, "the lens cannot be judged where it is begun: ");
    }
    if (!optimize_check_numbers(merit, after->residuals, jacobian, error)) {
        return false;
    }
    for (size_t j = 0; j < merit->variable_count; j++) {
        answer->is_idle[j] = true;
    }
    optimize_find_effects(merit, after->residuals, jacobian, answer->is_idle);
    if (!is_elsewhere && answer->begun != NULL) {
        judge_as_nothing(merit, before);
    } else if (!is_elsewhere) { /* the lens as it was, that is begun with its own numbers */
        before->merit = after->merit;
        memcpy(before->residuals, after->residuals, size);
        memcpy(before->values, after->values, size);
    }
    optimize_note(running, after->merit);
    const struct solver_problem problem = optimize_problem(merit);
    const struct optimize_descent descent = {
        .merit = merit,
        .problem = &problem,
        .options = {.engine = task->engine,
                    .iterations = task->iterations > 0 ? task->iterations : MOST_ITERATIONS,
                    .function = least_gain,
                    .lean = true,
                    .progress = progress,
                    .progress_context = running},
        .arena = arena};
    if (!optimize_descend(&descent, after->numbers, &answer->summary, &answer->limit, error)) {
        return false;
    }
    if (running->is_at_limit) {
        answer->summary.status = SOLVER_LIMIT;
    }
    if (!optimize_look(merit, after, jacobian)) {
        *error = merit->why;
        return error_prefix(error, "the lens that was found cannot be judged: ");
    }
    return true;
}

/* The same; where rays are just lost, some are found only from a lens that still has them. */
static bool optimize_run_any(const struct optimize_task *task, struct arena *arena,
                             double *jacobian, struct optimize_answer *answer, struct error *error)
{
    struct optimize_progress running = {.task = task, .answer = answer, .arena = arena};
    bool found = optimize_run_once(&running, jacobian, error);
    if (!found && !task->merit->forgets) {
        task->merit->forgets = true;
        found = optimize_run_once(&running, jacobian, error);
    }
    if (found) {
        optimize_find_effects(task->merit, answer->after.residuals, jacobian, answer->is_idle);
        optimize_note(&running, answer->after.merit);
    }
    return found;
}

/* -------- around where rays cannot be aimed -------- */

/* Did that keep it from a minimum? So many of a descent's steps come to nothing by it. A descent
   that was asked to end after so many iterations has done what it was asked. */
static bool is_hindered(const struct optimize_task *task, const struct optimize_answer *answer,
                        bool found)
{
    static const double many = 0.08;
    const struct merit *merit = task->merit;
    const double count = (double)merit->limit->count;
    const bool is_kept =
        found ? answer->limit.is_of_aim ||
                    (answer->summary.status == SOLVER_LIMIT && task->iterations == 0 &&
                     count > many * (double)answer->summary.evaluations)
              : count > 0;
    return is_kept && !merit->question.from_entrance &&
           (task->goes_on == NULL || task->goes_on(task->context));
}

/* By points of the paraxial entrance pupil, which need no aim, and on from there by the stop. */
static bool optimize_detour(const struct optimize_task *task, const double *from,
                            struct arena *arena, double *jacobian, struct optimize_answer *answer)
{
    struct merit_question question = task->merit->question;
    struct optimize_task way = *task, back = *task;
    struct optimize_answer there;
    struct error ignored;
    question.from_entrance = true;
    way.merit = ARENA_NEW(arena, struct merit);
    way.start = from;
    if (!merit_open(&question, arena, way.merit, &ignored)) {
        return false;
    }
    double *other =
        ARENA_ARRAY(arena, way.merit->residual_count * way.merit->variable_count + 1, double);
    if (!optimize_run_any(&way, arena, other, &there, &ignored)) {
        return false;
    }
    back.start = there.after.numbers;
    if (!optimize_run_any(&back, arena, jacobian, answer, &ignored)) {
        return false;
    }
    answer->summary.iterations += there.summary.iterations;
    answer->summary.evaluations += there.summary.evaluations;
    answer->summary.derivatives += there.summary.derivatives;
    return true;
}

bool optimize_run(const struct optimize_task *task, struct arena *arena,
                  struct optimize_answer *answer, struct error *error)
{
    struct merit *merit = task->merit;
    double *jacobian =
        ARENA_ARRAY(arena, merit->residual_count * merit->variable_count + 1, double);
    double *own = ARENA_ARRAY(arena, merit->variable_count + 1, double);
    bool found = optimize_run_any(task, arena, jacobian, answer, error);
    bool is_hindered_still = is_hindered(task, answer, found);
    variables_get(merit->question.variables, own);
    /* from where it ended, then from where it began */
    for (int i = found ? 0 : 1; i < 2 && is_hindered_still; i++) {
        const double *begun = task->start != NULL ? task->start : own;
        struct optimize_answer other;
        if (!optimize_detour(task, i == 0 ? answer->after.numbers : begun, arena, jacobian,
                             &other) ||
            (found && !(other.after.merit < answer->after.merit))) {
            continue;
        }
        if (found) {
            other.before = answer->before;
            other.begun = answer->begun;
            other.summary.iterations += answer->summary.iterations;
            other.summary.evaluations += answer->summary.evaluations;
            other.summary.derivatives += answer->summary.derivatives;
        }
        other.is_detour = true;
        *answer = other;
        found = true;
        is_hindered_still = is_hindered(task, answer, found);
    }
    return found;
}
