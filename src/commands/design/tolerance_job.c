/* commands/design/tolerance_job.c - trials of a lens, or of the parts of a divided run. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/tolerance_job.h"

#include "base/constants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * What the first trials have otherwise than exact ones of the nominal lens's rays: by lenses whose
 * rays are aimed anew, or null: to second order.
 *
 * Result    rms of the judged figure, NaN: there is none to compare; `most`: the largest
 */
static double compare_trials(struct tolerance_job *job, struct tolerance *aimed, uint64_t looks,
                             double *most)
{
    enum { LANES = SECOND_ORDER_LANES };
    struct arena *arena = job->run->arena;
    struct tolerance *held = &job->tolerance;
    const enum tolerance_of of = job->trials.of;
    const size_t n = job->question.perturbation_count, figures = held->figure_count;
    double *errors = ARENA_ARRAY(arena, n + 1, double);
    double *lanes = ARENA_ARRAY(arena, LANES * n + 1, double);
    double *about = ARENA_ARRAY(arena, LANES * (figures + tolerance_moves(held)), double);
    struct tolerance_trial trial = {.figures = ARENA_ARRAY(arena, figures, double),
                                    .moves = ARENA_ARRAY(arena, tolerance_moves(held), double)};
    double sum = 0;
    size_t count = 0;
    *most = 0;
    for (uint64_t k = 0; k < looks && k < job->trials.total && !watch_is_ended(job->run->watch);
         k++) {
        tolerance_errors(&job->question, job->trials.seed, k, errors);
        if (!tolerance_trial(held, errors, &trial)) {
            if (aimed == NULL) {
                warnings_add(job->run->doubts, "trial %llu fails where it is made exactly: %s",
                             (unsigned long long)k + 1, trial.why.message);
            }
            continue;
        }
        const double exact = tolerance_judged(held, of, trial.figures);
        if (aimed != NULL && !tolerance_trial(aimed, errors, &trial)) {
            continue;
        }
        if (aimed == NULL) {
            for (size_t i = 0; i < n; i++) {
                lanes[i * LANES] = errors[i];
            }
            second_order_trials(&job->differential, lanes, about);
            for (size_t f = 0; f < figures; f++) {
                trial.figures[f] = about[f * LANES];
            }
        }
        const double off =
            tolerance_judged(aimed != NULL ? aimed : held, of, trial.figures) - exact;
        sum += off * off;
        *most = fmax(*most, fabs(off));
        count++;
    }
    return count > 0 ? sqrt(sum / (double)count) : NAN;
}

/* "10deg", "3mm"; of a position "lens". */
const char *tolerance_name_of(const struct tolerance_job *job,
                              const struct tolerance_figure *figure)
{
    struct arena *arena = job->run->arena;
    if (figure == NULL) {
        return job->trials.of == TOLERANCE_OF_MEAN ? "mean" : "worst";
    }
    if (figure->field == NULL || figure->field->point.kind == FIELD_NONE) {
        return figure->field == NULL ? "lens" : "axis";
    }
    const struct field_point *point = &figure->field->point;
    const bool is_angle = point->kind == FIELD_ANGLE;
    const double unit = is_angle ? DEGREES_PER_RADIAN : 1;
    const char *name = is_angle ? "deg" : "mm";
    static const char *const orientations[] = {"", " T", " S"};
    const char *direction = orientations[figure->orientation];
    return point->value[0] != 0
               ? arena_printf(arena, "%.6g:%.6g%s%s", point->value[0] * unit,
                              point->value[1] * unit, name, direction)
               : arena_printf(arena, "%.6g%s%s", point->value[1] * unit, name, direction);
}

const char *tolerance_position_of(const struct tolerance_job *job,
                                  const struct tolerance_figure *figure)
{
    return figure != NULL ? tolerance_view(&job->tolerance)->places[figure->place].setup.position
                          : NULL;
}

double tolerance_refocus_of(const struct tolerance_job *job, double refocus)
{
    const struct tolerance_question *question = &job->tolerance.question;
    return question->refocus == REFOCUS_NONE && question->compensator_count > 0 ? NAN : refocus;
}

const char *tolerance_moves_in_words(const struct tolerance_job *job, const double *moves)
{
    struct arena *arena = job->run->arena;
    const char *words = NULL;
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        const struct compensator *one = &job->question.compensators[i];
        const bool is_angle =
            (parameter_type(one->parts[0].what.kind)->is & PARAMETER_IS_ANGLE) != 0;
        const double scale = is_angle ? DEGREES_PER_RADIAN : 1;
        words = arena_printf(arena, "%s%s%s ", words != NULL ? words : "",
                             words != NULL ? ", " : "", one->name);
        if (moves != NULL) {
            words = arena_printf(arena, "%s%.6g", words, moves[i + 1] * scale);
        } else {
            const struct trial_statistics_moments all =
                trial_statistics_moments(&job->result.moves[i + 1]);
            words = arena_printf(arena, "%s%.4g +- %.4g", words, all.mean * scale, all.sd * scale);
        }
        words = arena_printf(arena, "%s %s", words, is_angle ? "deg" : "mm");
    }
    return words;
}

struct tolerance_about tolerance_about_of(const struct tolerance_job *job)
{
    static const char *const planes[] = {"", "paraxial focus", "best focus"};
    const struct tolerance_input *input = job->input;
    const struct tolerance_question *question = &job->question;
    const struct criterion_type *type = criterion_type(question->criterion.kind);
    struct arena *arena = job->run->arena;
    struct tolerance_about about = {
        .fnumber = input->question.fnumber,
        .seed = input->seed,
        .tolerances = arena_printf(arena, "%zu error%s, %s", job->perturbations.count,
                                   job->perturbations.count == 1 ? "" : "s", job->made),
        .lens = job->lens->title,
        .adjusted = planes[job->tolerance.question.refocus],
        .warning = job->warning};
    for (size_t i = 0; i < question->compensator_count; i++) {
        about.adjusted =
            arena_printf(arena, "%s%s%s", about.adjusted, *about.adjusted != '\0' ? ", " : "",
                         question->compensators[i].name);
    }
    if (*about.adjusted == '\0') {
        about.adjusted = "nothing";
    }
    if (!isnan(job->limit)) {
        const bool is_plain = strcmp(type->unit, "1") == 0;
        about.limit = arena_printf(arena, "%.6g%s%s", job->limit * type->scale, is_plain ? "" : " ",
                                   is_plain ? "" : type->unit);
    }
    if (job->trials.differential != NULL) {
        about.method =
            isnan(job->method_rms)
                ? "differential"
                : arena_printf(
                      arena, "differential (exact trials differ by %.2g %s rms, %.2g at most)",
                      type->scale * job->method_rms, type->unit, type->scale * job->method_most);
    }
    /* with what rays that are not aimed anew are off by */
    const double rounding = 1e-9; /* where the stop is the first surface */
    const char *aimed = "those of the nominal lens";
    if (question->aims) {
        aimed = "aimed at the stop of every lens";
    } else if (job->aim_error <= rounding * fabs(job->result.columns[0].tally.nominal)) {
        aimed = "those of the nominal lens (aimed anew: the same)";
    } else if (!isnan(job->aim_error)) {
        aimed = arena_printf(arena, "those of the nominal lens (aimed anew: %.2g %s rms)",
                             type->scale * job->aim_error, type->unit);
    }
    about.rays = arena_printf(arena, "%ld %s, %s, %s", input->rays, patterns[input->pattern].word,
                              question->view.clip ? "clipped" : "not clipped", aimed);
    return about;
}

/* -------- divided runs -------- */

static bool divide_trials(struct tolerance_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    const size_t count = job->tolerance.figure_count;
    const char **facts = ARENA_ARRAY(arena, count + 1, const char *);
    struct division division = {.part = design_part(job->run, job->input->part),
                                .seed = job->trials.seed,
                                .total = job->trials.total};
    if (division.part.count == 0) {
        return true;
    }
    /* what trials depend on besides words and files: glasses, by what the nominal lens has */
    facts[0] = arena_printf(arena, "%zu", job->perturbations.count);
    for (size_t i = 0; i < count; i++) {
        facts[i + 1] = arena_printf(arena, " %a", job->tolerance.nominal[i]);
    }
    division.facts = text_of(arena_join(arena, facts, count + 1));
    const struct part_range range = part_range(division.part, division.total);
    job->trials.begin = range.begin;
    job->trials.end = range.end;
    return division_head(job->run, &division, &job->head, error);
}

/* -------- the job -------- */

static int by_first_trial(const void *a, const void *b)
{
    const struct tolerance_reason *left = a, *right = b;
    return left->first < right->first ? -1 : 1;
}

/* That some trials are missing; and why lenses failed, in the order that trials met it. */
static void add_doubts(struct tolerance_job *job)
{
    const struct tolerance_result *result = &job->result;
    struct run *run = job->run;
    const bool is_merged = run->parts != NULL;
    const uint64_t whole = is_merged ? job->trials.total : job->trials.end - job->trials.begin;
    if (result->done < whole) {
        job->incomplete = arena_printf(
            run->arena, "%s after %llu of %llu trials: what they say so far, incomplete",
            is_merged ? "parts are missing: ends" : "interrupted", (unsigned long long)result->done,
            (unsigned long long)whole);
        fail(&run->shortfall, ERROR_DOMAIN, "%s", job->incomplete);
    }
    const struct merit *view = tolerance_view(&job->tolerance);
    const char *stop = NULL;
    for (size_t i = 0; i < view->place_count && stop == NULL; i++) {
        stop = setup_stop_warning(&view->places[i].setup, run->arena);
    }
    if (stop != NULL) {
        warnings_add(run->doubts, "%s", stop);
    }
    const size_t kept = result->reason_count, all = kept + (result->others.count > 0 ? 1 : 0);
    struct tolerance_reason *reasons =
        ARENA_ARRAY(run->arena, TOLERANCE_REASONS + 1, struct tolerance_reason);
    memcpy(reasons, result->reasons, kept * sizeof reasons[0]);
    reasons[kept] = result->others;
    reasons[kept].why = "other reasons";
    qsort(reasons, all, sizeof reasons[0], by_first_trial);
    for (size_t i = 0; i < all; i++) {
        warnings_add(run->doubts, "%llu of %llu lenses failed, trial %llu first: %s",
                     (unsigned long long)reasons[i].count, (unsigned long long)result->done,
                     (unsigned long long)reasons[i].first + 1, reasons[i].why);
    }
}

/* Trials to second order, of what has derivatives: no compensator with a range. */
static bool open_differential(struct tolerance_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    for (size_t i = 0; i < job->question.compensator_count; i++) {
        const struct compensator *one = &job->question.compensators[i];
        if (isfinite(one->low) || isfinite(one->high)) {
            return fail(error, ERROR_USAGE,
                        "{--method} differential: what is adjusted has no bounds there, as %s has",
                        one->name);
        }
    }
    const struct second_order_problem problem =
        tolerance_problem(&job->tolerance, job->run->watch, arena, NULL);
    job->trials.differential = &job->differential;
    return second_order_open(&problem, arena, &job->differential, error);
}

/* Trials are made, or those of the parts that are merged counted. */
static bool count_trials(struct tolerance_job *job, struct error *error)
{
    const struct run *run = job->run;
    struct tolerance_result *result = &job->result;
    if (run->parts == NULL) {
        watch_begin(run->watch, "trials", (size_t)(job->trials.end - job->trials.begin));
        return tolerance_run(&job->trials, result, error);
    }
    for (size_t i = 0; i < run->part_count; i++) {
        const struct part_file *file = &run->parts[i];
        const uint64_t before = result->done;
        if (!part_is_of_run(file, &job->head, "a run of these words and files", run->arena,
                            error)) {
            return false;
        }
        if (!tolerance_result_read(file->body, result) ||
            result->done - before != file->head.done) {
            return fail(error, ERROR_DATA, "%s: its trials are not those that its head says",
                        file->path);
        }
    }
    return true;
}

bool tolerance_job_run(struct tolerance_job *job, struct error *error)
{
    enum { METHOD_LOOKS = 100, AIM_LOOKS = 32 };
    struct arena *arena = job->run->arena;
    struct watch *watch = job->run->watch;
    double ignored;
    job->aim_error = job->method_rms = job->method_most = NAN;
    watch_begin(watch, "rays", 0);
    if (!tolerance_ask(job, error) ||
        !tolerance_open(&job->question, arena, &job->tolerance, error) ||
        !divide_trials(job, error) ||
        (job->input->method != TOLERANCE_EXACT && !open_differential(job, error))) {
        return false;
    }
    job->trials.ready = &job->tolerance;
    tolerance_result_open(&job->trials, &job->tolerance, (size_t)job->save_count, arena,
                          &job->result);
    if (job->input->show == TOLERANCE_TRIALS || job->input->show >= TOLERANCE_SENSITIVITY) {
        return true; /* one by one, as they are printed; or none */
    }
    if (!count_trials(job, error)) {
        return false;
    }
    add_doubts(job);
    if (job->trials.differential != NULL) {
        job->method_rms = compare_trials(job, NULL, METHOD_LOOKS, &job->method_most);
    }
    const bool has_rays = criterion_type(job->question.criterion.kind)->operand == OPERAND_KINDS;
    if (job->question.aims || !has_rays || watch_is_ended(watch)) {
        return true;
    }
    /* how far nominal rays are right */
    struct tolerance_question question = job->question;
    struct tolerance *aimed = ARENA_NEW(arena, struct tolerance);
    question.aims = true;
    watch_begin(watch, "rays", 0);
    if (!tolerance_open(&question, arena, aimed, error)) {
        return watch_is_ended(watch); /* without it */
    }
    job->aim_error = compare_trials(job, aimed, AIM_LOOKS, &ignored);
    return true;
}
