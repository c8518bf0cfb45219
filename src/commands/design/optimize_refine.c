/* commands/design/optimize_refine.c - on with more rays and fields, where a merit saw too little. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include <math.h>
#include <string.h>

/* Beyond a wavelength wave fronts have minima by the dozen, and spots are made small first; where
   rays see so many times less than others the lens has gone astray, and the start is tried too. */
static const double most_path = 1, astray = 10;

enum { ROUNDS = 3 };

/* -------- what was seen -------- */

/* "0.92 wavelengths", "1.4 um". */
static const char *doubt_size(const struct closer_doubt *doubt, double size, struct arena *arena)
{
    return doubt->is_path ? arena_printf(arena, "%.3g wavelengths", size)
                          : arena_printf(arena, "%.3g um", 1e3 * size);
}

/* What more rays see of a goal, and what a field between others has. */
static void doubt_warn(struct optimize_job *job, const struct closer_look *look, bool is_of_fields,
                       const char *then)
{
    struct arena *arena = job->run->arena;
    const struct closer_doubt *doubt = is_of_fields ? &look->fields : &look->rays;
    const char *field = lens_field_words(&doubt->field, arena);
    const char *is = doubt_size(doubt, doubt->is, arena);
    const char *seen = doubt_size(doubt, doubt->seen, arena);
    if (isinf(doubt->is)) {
        optimize_warn(job, "between the %s that count rays are lost, at %s: %s",
                      is_of_fields ? "fields" : "rays", field, then);
    } else if (is_of_fields) {
        optimize_warn(job,
                      "between the fields that count it is worse: of goal %s %s has %s, those "
                      "beside it at most %s: %s",
                      doubt->operand->name, field, is, seen, then);
    } else {
        optimize_warn(job, "of goal %s at %s %zu rays see %s, where twice as many see %s: %s",
                      doubt->operand->name, field, job->merit.question.rays, seen, is, then);
    }
}

static bool may_have_rays(const struct optimize_job *job)
{
    return job->input->rays == 0;
}

static bool may_have_fields(const struct optimize_job *job)
{
    return job->input->question.fields.count == 0;
}

/* At the lens as it is now, once. */
static const struct closer_look *optimize_look_closer(struct optimize_job *job)
{
    if (job->look == NULL) {
        struct closer_look *look = ARENA_NEW(job->run->arena, struct closer_look);
        closer_look_at(&job->merit, &job->answer.after, job->run->arena, look);
        job->look = look;
    }
    return job->look;
}

void optimize_warn_of_look(struct optimize_job *job)
{
    const struct closer_look look = *optimize_look_closer(job);
    if (look.rays.operand != NULL) {
        doubt_warn(job, &look, false, "more --rays are wanted");
    }
    if (look.fields.operand != NULL) {
        doubt_warn(job, &look, true, "more fields are wanted, with --field or in the lens");
    }
}

/* -------- on -------- */

/* Goals of wave fronts as spots that weigh about as much. */
static void spots_of_paths(const struct merit *merit, struct arena *arena,
                           struct merit_question *question)
{
    const struct setup *setup = &merit->places[0].setup;
    const double aperture = fabs(setup->first.efl / setup->first.entrance_diameter);
    const double fnumber = isfinite(aperture) && aperture > 0 ? aperture : 1;
    const double wavelength = 1e-3 * lens_primary_wavelength(setup->lens);
    struct operand *list = ARENA_ARRAY(arena, question->operand_count + 1, struct operand);
    for (size_t i = 0; i < question->operand_count; i++) {
        list[i] = question->operands[i];
        if (list[i].kind == OPERAND_OPD) {
            list[i].kind = OPERAND_POLY;
            list[i].deviation *= 4 * fnumber * wavelength; /* of spots that defocus makes */
        }
    }
    question->operands = list;
}

/* Small spots, from these numbers; which receive the lens that has them. */
static void begin_by_spots(const struct optimize_job *job, const struct merit_question *asked,
                           double *numbers)
{
    struct arena *arena = job->run->arena;
    struct merit_question question = *asked;
    struct optimize_task task = job->task;
    struct optimize_answer answer;
    struct error ignored;
    spots_of_paths(&job->merit, arena, &question);
    task.merit = ARENA_NEW(arena, struct merit);
    task.start = numbers;
    if (merit_open(&question, arena, task.merit, &ignored) &&
        optimize_run(&task, arena, &answer, &ignored)) {
        memcpy(numbers, answer.after.numbers, task.merit->variable_count * sizeof *numbers);
    }
}

static bool answer_is_better(const struct optimize_answer *one, const struct optimize_answer *other)
{
    static const double exactly = 1e-10;
    const double a = fmax(one->summary.excess, exactly), b = fmax(other->summary.excess, exactly);
    return a < b || (a == b && one->after.merit < other->after.merit);
}

/* By that question, from where it is and, of a lens gone astray, from where it was. Result: false:
   it cannot be had */
static bool refine_once(struct optimize_job *job, const struct merit_question *question,
                        const struct closer_look *look)
{
    struct arena *arena = job->run->arena;
    struct merit *merit = ARENA_NEW(arena, struct merit);
    struct optimize_task task = job->task;
    const struct optimize_answer before = job->answer;
    const bool is_astray = look->rays.operand != NULL && look->rays.is > astray * look->rays.seen;
    double *starts[2];
    bool found = false;
    struct error ignored;
    if (!merit_open(question, arena, merit, &ignored)) {
        return false;
    }
    task.merit = merit;
    for (int i = 0; i < (is_astray ? 2 : 1); i++) {
        struct optimize_answer answer;
        starts[i] = ARENA_ARRAY(arena, merit->variable_count + 1, double);
        if (i == 0) {
            memcpy(starts[i], before.after.numbers, merit->variable_count * sizeof(double));
        } else {
            variables_get(&job->variables, starts[i]);
        }
        if (look->worst_path > most_path) {
            begin_by_spots(job, question, starts[i]);
        }
        task.start = starts[i];
        if (!optimize_run(&task, arena, &answer, &ignored)) {
            continue;
        }
        if (!found || answer_is_better(&answer, &job->answer)) {
            job->answer = answer;
        }
        found = true;
    }
    if (!found) {
        return false;
    }
    job->merit = *merit;
    job->look = NULL;
    job->answer.begun = before.begun;
    job->answer.is_detour = job->answer.is_detour || before.is_detour;
    job->answer.summary.iterations += before.summary.iterations;
    job->answer.summary.evaluations += before.summary.evaluations;
    job->answer.summary.derivatives += before.summary.derivatives;
    job->found = variables_lens(&job->variables, job->answer.after.numbers, arena);
    return true;
}

bool optimize_refine(struct optimize_job *job)
{
    const int most = job->is_late ? 1 : ROUNDS;
    int round = 0;
    for (; round < most; round++) {
        struct closer_look look;
        struct merit_question question;
        const struct optimize_job was = *job;
        const bool is_ended = /* by whom it was told how far it may go */
            job->input->iterations > 0 && job->answer.summary.status == SOLVER_LIMIT;
        if (is_ended || (job->task.goes_on != NULL && !job->task.goes_on(job->task.context))) {
            break;
        }
        look = *optimize_look_closer(job);
        /* rays that are lost whatever was done before are lost for good */
        const bool rays = look.rays.operand != NULL && may_have_rays(job) &&
                          (round == 0 || isfinite(look.rays.is));
        const bool fields = look.fields.operand != NULL && may_have_fields(job);
        if (!rays && !fields) {
            break;
        }
        closer_question(&job->merit, rays, fields, job->run->arena, &question);
        if (!refine_once(job, &question, &look)) {
            break;
        }
        struct optimize_job words = was; /* of the merit that it was seen by */
        words.warning = job->warning;
        if (rays) {
            doubt_warn(&words, &look, false,
                       arena_printf(job->run->arena, "it went on with %zu", question.rays));
        }
        if (fields) {
            doubt_warn(&words, &look, true, "it went on with fields between");
        }
        job->warning = words.warning;
    }
    return round > 0;
}
