/* commands/design/tolerance_job.c - trials of a lens, or of the parts of a divided run. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * Make trials ready that --method asks for.
 *
 * Errors    ERROR_USAGE: a compensator with a range, which has no derivatives; as second_order_open
 */
static bool tolerance_method_open(struct tolerance_job *job, struct error *error)
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

/* By what the first trials differ from exact ones; of exact trials nothing is done. */
static bool tolerance_method_check(struct tolerance_job *job, struct error *error)
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

/* "differential (exact trials differ by ..)"; null: they are exact */
static const char *tolerance_method_in_words(const struct tolerance_job *job)
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

/* -------- what rows say of it -------- */

/* "10deg", "3mm"; of a position "lens". */
const char *tolerance_name_of(const struct tolerance_job *job,
                              const struct tolerance_figure *figure)
{
    static const double degrees = 57.295779513082323;
    struct arena *arena = job->run->arena;
    if (figure == NULL) {
        return job->trials.of == TOLERANCE_OF_MEAN ? "mean" : "worst";
    }
    if (figure->field == NULL || figure->field->point.kind == FIELD_NONE) {
        return figure->field == NULL ? "lens" : "axis";
    }
    const struct field_point *point = &figure->field->point;
    const bool is_angle = point->kind == FIELD_ANGLE;
    const double unit = is_angle ? degrees : 1;
    const char *name = is_angle ? "deg" : "mm";
    static const char *const orientations[] = {"", " T", " S"};
    const char *direction = orientations[figure->orientation];
    return point->value[0] != 0
               ? arena_printf(arena, "%.6g:%.6g%s%s", point->value[0] * unit,
                              point->value[1] * unit, name, direction)
               : arena_printf(arena, "%.6g%s%s", point->value[1] * unit, name, direction);
}

static const char *limit_in_words(const struct tolerance_job *job)
{
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const bool is_plain = strcmp(type->unit, "1") == 0;
    return isnan(job->limit) ? NULL
                             : arena_printf(job->run->arena, "%.6g%s%s", job->limit * type->scale,
                                            is_plain ? "" : " ", is_plain ? "" : type->unit);
}

const char *tolerance_position_of(const struct tolerance_job *job,
                                  const struct tolerance_figure *figure)
{
    return figure != NULL ? tolerance_view(&job->tolerance)->places[figure->place].setup.position
                          : NULL;
}

static const char *adjusted_in_words(const struct tolerance_job *job)
{
    static const char *const planes[] = {"", "paraxial focus", "best focus"};
    const char *words = planes[job->tolerance.question.refocus];
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        words = arena_printf(job->run->arena, "%s%s%s", words, *words != '\0' ? ", " : "",
                             job->question.compensators[i].name);
    }
    return *words != '\0' ? words : "nothing";
}

/* With what rays that are not aimed anew are off by. */
static const char *tolerance_rays_in_words(const struct tolerance_job *job)
{
    const struct tolerance_input *input = job->input;
    struct arena *arena = job->run->arena;
    const struct criterion_type *type = criterion_type(job->question.criterion.kind);
    const double rounding = 1e-9; /* where the stop is the first surface */
    const char *aimed =
        job->question.aims      ? "aimed at the stop of every lens"
        : isnan(job->aim_error) ? "those of the nominal lens"
        : job->aim_error <= rounding * fabs(job->result.columns[0].tally.nominal)
            ? "those of the nominal lens (aimed anew: the same)"
            : arena_printf(arena, "those of the nominal lens (aimed anew: %.2g %s rms)",
                           type->scale * job->aim_error, type->unit);
    return arena_printf(arena, "%ld %s, %s, %s", input->rays, patterns[input->pattern].word,
                        job->question.view.clip ? "clipped" : "not clipped", aimed);
}

double tolerance_refocus_of(const struct tolerance_job *job, double refocus)
{
    const struct tolerance_question *question = &job->tolerance.question;
    return question->refocus == REFOCUS_NONE && question->compensator_count > 0 ? NAN : refocus;
}

double tolerance_move_scale(const struct compensator *one, const char **unit)
{
    static const double degrees = 57.295779513082323;
    const bool is_angle = (parameter_type(one->parts[0].what.kind)->is & PARAMETER_IS_ANGLE) != 0;
    *unit = is_angle ? "deg" : "mm";
    return is_angle ? degrees : 1;
}

const char *tolerance_moves_in_words(const struct tolerance_job *job, const double *moves)
{
    const char *words = NULL;
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        const char *unit;
        const double scale = tolerance_move_scale(&job->question.compensators[i], &unit);
        words = arena_printf(job->run->arena, "%s%s%s %.6g %s", words != NULL ? words : "",
                             words != NULL ? ", " : "", job->question.compensators[i].name,
                             moves[i + 1] * scale, unit);
    }
    return words;
}

struct tolerance_about tolerance_about_of(const struct tolerance_job *job)
{
    const struct tolerance_input *input = job->input;
    return (struct tolerance_about){
        .fnumber = input->question.fnumber,
        .seed = input->seed,
        .made = arena_printf(job->run->arena, "%zu error%s, %s", job->perturbations.count,
                             job->perturbations.count == 1 ? "" : "s", job->made),
        .lens = job->lens->title,
        .method = tolerance_method_in_words(job),
        .rays = tolerance_rays_in_words(job),
        .adjusted = adjusted_in_words(job),
        .limit = limit_in_words(job),
        .warning = job->warning};
}

/* -------- divided runs -------- */

/* What trials depend on besides words and files: glasses, by what the nominal lens has. */
static struct text tolerance_facts_of(const struct tolerance_job *job)
{
    struct arena *arena = job->run->arena;
    const size_t count = job->tolerance.figure_count;
    const char **facts = ARENA_ARRAY(arena, count + 1, const char *);
    facts[0] = arena_printf(arena, "%zu", job->perturbations.count);
    for (size_t i = 0; i < count; i++) {
        facts[i + 1] = arena_printf(arena, " %a", job->tolerance.nominal[i]);
    }
    return text_of(arena_join(arena, facts, count + 1));
}

static bool tolerance_job_divide(struct tolerance_job *job, struct error *error)
{
    const struct run *run = job->run;
    struct division division = {.part = {1, 1},
                                .seed = job->trials.seed,
                                .total = job->trials.total,
                                .facts = tolerance_facts_of(job)};
    if (run->parts != NULL) {
        division.part.count = run->parts[0].head.part.count;
    } else if (job->input->part.count > 0) {
        division.part = job->input->part;
    } else {
        return true;
    }
    const struct part_range range = part_range(division.part, division.total);
    job->trials.begin = range.begin;
    job->trials.end = range.end;
    return division_head(run, &division, &job->head, error);
}

static bool merge(struct tolerance_job *job, struct error *error)
{
    const struct run *run = job->run;
    for (size_t i = 0; i < run->part_count; i++) {
        const struct part_file *file = &run->parts[i];
        const uint64_t before = job->result.done;
        if (!part_is_of_run(file, &job->head, "a run of these words and files", run->arena,
                            error)) {
            return false;
        }
        if (!tolerance_result_read(file->body, &job->result) ||
            job->result.done - before != file->head.done) {
            return fail(error, ERROR_DATA, "%s: its trials are not those that its head says",
                        file->path);
        }
    }
    return true;
}

/* -------- how far nominal rays are right -------- */

/* The root mean square of what aiming anew changes of the judged figure. */
static bool find_aim_error(struct tolerance_job *job, struct error *error)
{
    enum { LOOKS = 32 };
    struct arena *arena = job->run->arena;
    struct tolerance_question question = job->question;
    struct tolerance *aimed = ARENA_NEW(arena, struct tolerance);
    struct tolerance *held = &job->tolerance;
    question.aims = true;
    if (watch_is_ended(job->run->watch)) {
        return true;
    }
    watch_begin(job->run->watch, "rays", 0);
    if (!tolerance_open(&question, arena, aimed, error)) {
        return watch_is_ended(job->run->watch); /* without it */
    }
    double *errors = ARENA_ARRAY(arena, question.perturbation_count + 1, double);
    struct tolerance_trial trial = {.figures = ARENA_ARRAY(arena, held->figure_count, double),
                                    .moves = ARENA_ARRAY(arena, tolerance_moves(held), double)};
    double sum = 0;
    size_t count = 0;
    for (uint64_t k = 0; k < LOOKS && k < job->trials.total && !watch_is_ended(job->run->watch);
         k++) {
        tolerance_errors(&question, job->trials.seed, k, errors);
        if (!tolerance_trial(held, errors, &trial)) {
            continue;
        }
        const double before = tolerance_judged(held, job->trials.of, trial.figures);
        if (tolerance_trial(aimed, errors, &trial)) {
            const double off = tolerance_judged(aimed, job->trials.of, trial.figures) - before;
            sum += off * off;
            count++;
        }
    }
    job->aim_error = count > 0 ? sqrt(sum / (double)count) : NAN;
    return true;
}

/* -------- the job -------- */

static void say_incomplete(struct tolerance_job *job)
{
    const struct tolerance_result *result = &job->result;
    struct run *run = job->run;
    struct arena *arena = run->arena;
    const uint64_t wanted = job->trials.end - job->trials.begin;
    const uint64_t whole = run->parts != NULL ? job->trials.total : wanted;
    if (result->done < whole) {
        job->incomplete =
            arena_printf(arena, "%s after %llu of %llu trials: what they say so far, incomplete",
                         run->parts != NULL ? "parts are missing: ends" : "interrupted",
                         (unsigned long long)result->done, (unsigned long long)whole);
        fail(&run->shortfall, ERROR_DOMAIN, "%s", job->incomplete);
    }
}

static int tolerance_job_by_first(const void *a, const void *b)
{
    const struct tolerance_reason *left = a, *right = b;
    return left->first < right->first ? -1 : 1;
}

/* Why lenses failed, in the order that trials met it. */
static void add_doubts(const struct tolerance_job *job)
{
    const struct tolerance_result *result = &job->result;
    const size_t kept = result->reason_count, all = kept + (result->others.count > 0 ? 1 : 0);
    struct tolerance_reason *reasons =
        ARENA_ARRAY(job->run->arena, TOLERANCE_REASONS + 1, struct tolerance_reason);
    memcpy(reasons, result->reasons, kept * sizeof reasons[0]);
    reasons[kept] = result->others;
    reasons[kept].why = "other reasons";
    qsort(reasons, all, sizeof reasons[0], tolerance_job_by_first);
    for (size_t i = 0; i < all; i++) {
        warnings_add(job->run->doubts, "%llu of %llu lenses failed, trial %llu first: %s",
                     (unsigned long long)reasons[i].count, (unsigned long long)result->done,
                     (unsigned long long)reasons[i].first + 1, reasons[i].why);
    }
}

bool tolerance_job_run(struct tolerance_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    job->aim_error = NAN;
    watch_begin(job->run->watch, "rays", 0);
    if (!tolerance_ask(job, error) ||
        !tolerance_open(&job->question, arena, &job->tolerance, error) ||
        !tolerance_job_divide(job, error) || !tolerance_method_open(job, error)) {
        return false;
    }
    job->trials.ready = &job->tolerance;
    tolerance_result_open(&job->trials, &job->tolerance, (size_t)job->save_count, arena,
                          &job->result);
    if (job->input->show == TOLERANCE_TRIALS || job->input->show >= TOLERANCE_SENSITIVITY) {
        return true; /* one by one, as they are printed; or none */
    }
    if (job->run->parts != NULL) {
        if (!merge(job, error)) {
            return false;
        }
    } else {
        watch_begin(job->run->watch, "trials", (size_t)(job->trials.end - job->trials.begin));
        if (!tolerance_run(&job->trials, &job->result, error)) {
            return false;
        }
    }
    say_incomplete(job);
    add_doubts(job);
    if (!tolerance_method_check(job, error)) {
        return false;
    }
    const bool has_rays = criterion_type(job->question.criterion.kind)->operand == OPERAND_KINDS;
    return job->question.aims || !has_rays || find_aim_error(job, error);
}
