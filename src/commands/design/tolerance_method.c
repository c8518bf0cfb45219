/* commands/design/tolerance_method.c - trials to second order, and how far they are right. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_method.h"

#include <math.h>
#include <string.h>

bool tolerance_method_open(struct tolerance_job *job, struct error *error)
{
    job->method_rms = job->method_most = NAN;
    if (job->input->method == TOLERANCE_EXACT) {
        return true;
    }
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        const struct compensator *one = &job->question.compensators[i];
        if (isfinite(one->low) || isfinite(one->high)) {
            return fail(error, ERROR_USAGE,
                        "{--method} differential: what is adjusted has no bounds there, as %s has",
                        one->name);
        }
    }
    tolerance_model_open(&job->tolerance, job->run->watch, job->run->arena, &job->model);
    if (!second_order_open(&job->model.problem, job->run->arena, &job->differential, error)) {
        return false;
    }
    job->trials.differential = &job->differential;
    return true;
}

/* Figures of one trial to second order. */
static void tolerance_method_try_about(const struct tolerance_job *job, const double *errors,
                                       double *figures, double *room)
{
    enum { LANES = SECOND_ORDER_LANES };
    const size_t n = job->differential.error_count, count = job->differential.figure_count;
    double *results = room + n * LANES;
    memset(room, 0, n * LANES * sizeof *room);
    for (size_t i = 0; i < n; i++) {
        room[i * LANES] = errors[i];
    }
    second_order_trials(&job->differential, room, results);
    for (size_t f = 0; f < count; f++) {
        figures[f] = results[f * LANES];
    }
}

bool tolerance_method_check(struct tolerance_job *job, struct error *error)
{
    enum { LOOKS = 100 };
    const struct second_order_problem *problem = &job->model.problem;
    if (job->trials.differential == NULL) {
        return true;
    }
    struct arena *arena = job->run->arena;
    double *errors = ARENA_ARRAY(arena, problem->error_count + 1, double);
    double *exact = ARENA_ARRAY(arena, problem->figure_count, double);
    double *about = ARENA_ARRAY(arena, problem->figure_count, double);
    double *room = ARENA_ARRAY(
        arena, SECOND_ORDER_LANES * (problem->error_count + problem->figure_count), double);
    double sum = 0;
    size_t count = 0;
    (void)error;
    job->method_most = 0;
    for (uint64_t k = 0; k < LOOKS && k < job->trials.total && !watch_is_ended(job->run->watch);
         k++) {
        struct error why;
        tolerance_errors(&job->question, job->trials.seed, k, errors);
        if (!problem->trial(problem->context, errors, exact, &why)) {
            warnings_add(job->run->doubts, "trial %llu fails where it is made exactly: %s",
                         (unsigned long long)k + 1, why.message);
            continue;
        }
        tolerance_method_try_about(job, errors, about, room);
        const double off = tolerance_judged(&job->tolerance, job->trials.of, about) -
                           tolerance_judged(&job->tolerance, job->trials.of, exact);
        sum += off * off;
        job->method_most = fmax(job->method_most, fabs(off));
        count++;
    }
    job->method_rms = count > 0 ? sqrt(sum / (double)count) : NAN;
    return true;
}

const char *tolerance_method_in_words(const struct tolerance_job *job)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    if (job->trials.differential == NULL) {
        return NULL;
    }
    return isnan(job->method_rms)
               ? "differential"
               : arena_printf(job->run->arena,
                              "differential (exact trials differ by %.2g %s rms, %.2g at most)",
                              type->scale * job->method_rms, type->unit,
                              type->scale * job->method_most);
}
