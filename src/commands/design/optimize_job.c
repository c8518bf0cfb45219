/* commands/design/optimize_job.c - what is to be optimised, from the options; and doing it. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "base/constants.h"
#include "cli/options/goals.h"
#include "cli/options/tolerances.h"
#include "cli/options/vary.h"
#include "cli/progress.h"
#include "commands/analysis/analysis_options.h"
#include "design/glass_map.h"
#include "optics/first_order.h"
#include "report/warnings.h"

#include <math.h>
#include <string.h>

/* Rays near loss count, wherever rays do and nothing else is said. */
static void goals_add_grazing(struct optimize_job *job, struct goals *goals)
{
    struct operand grazing = operand_of(OPERAND_GRAZING, "grazing < 85");
    grazing.relation = OPERAND_BELOW;
    grazing.target = 85 * RADIANS_PER_DEGREE;
    struct operand *all = ARENA_ARRAY(job->run->arena, goals->count + 1, struct operand);
    bool has_rays = false, has_grazing = false;
    for (size_t i = 0; i < goals->count; i++) {
        all[i] = goals->list[i];
        has_rays = has_rays || (operand_type(all[i].kind)->is & OPERAND_TRACES) != 0;
        has_grazing = has_grazing || all[i].kind == OPERAND_GRAZING;
    }
    if (has_rays && !has_grazing && !optimize_usual_is_off(job->input, "grazing")) {
        all[goals->count++] = grazing;
        goals->list = all;
        job->guards = true;
    }
}

/* Wavelengths and fields that are asked for count for goals alone that name none. */
static bool check_used(const struct merit_question *question, const struct goals *goals,
                       struct error *error)
{
    bool of_wavelengths = false, of_fields = false;
    for (size_t i = 0; i < goals->count; i++) {
        size_t count;
        const struct operand *terms = operand_terms(&goals->list[i], &count);
        for (size_t k = 0; k < count; k++) {
            const unsigned is = operand_type(terms[k].kind)->is;
            of_wavelengths |= (is & OPERAND_OF_WAVELENGTHS) != 0 && isnan(terms[k].wavelength);
            of_fields |= (is & OPERAND_AT_FIELD) != 0 && terms[k].field == NULL;
        }
    }
    if (question->wavelength_count > 0 && !of_wavelengths) {
        fail(error, ERROR_USAGE, "{--wavelength} does nothing here: no goal is of all wavelengths");
        return error_hint(error, "a goal may name its own: efl@550nm = 100");
    }
    return question->field_count == 0 || of_fields ||
           fail(error, ERROR_USAGE, "{--field} does nothing here: no goal is of these fields");
}

/*
 * What may be wrong with the lens, for goals of how it is made: job->errors.
 *
 * Errors    as tolerances_of; ERROR_USAGE: it is told, and no goal asks for it
 */
static bool optimize_errors(struct optimize_job *job, const struct goals *goals,
                            struct error *error)
{
    const struct optimize_input *input = job->input;
    const struct tolerances_reader reader = {job->lens, job->run->db, job->run->arena};
    const char *grade = tolerances_grade(job->lens, input->grade, input->tolerances), *words;
    bool counts = false;
    for (size_t i = 0; i < goals->count; i++) {
        counts = counts || goals->list[i].kind == OPERAND_ASBUILT;
    }
    if (!counts) {
        return (input->grade == NULL && input->tolerances == NULL) ||
               fail(error, ERROR_USAGE, "{--%s} is of the goal asbuilt, and there is no such goal",
                    input->grade != NULL ? "grade" : "tolerances");
    }
    if (!tolerances_of(&reader, grade, input->tolerances, &job->errors, &words, error)) {
        return false;
    }
    job->made = arena_printf(job->run->arena, "%zu error%s, %s", job->errors.count,
                             job->errors.count == 1 ? "" : "s", words);
    return true;
}

/* -------- the job -------- */

enum { USUAL_RAYS = 36 };

static bool open_variables(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct vary_reader reader = {.lens = job->lens, .arena = arena};
    struct variable *list;
    size_t count;
    if (!vary_list(&reader, job->input->vary, job->input->hold, &list, &count, error)) {
        return false;
    }
    /*
     * A stop is no glass, so that goals of air pass over it; but it cannot lie within a lens. Gaps
     * beside it that no bounds are given for stay on their side of 0; those of a search all do, as
     * it would meet many lenses that are none.
     */
    for (size_t i = 0; i < count; i++) {
        struct variable *one = &list[i];
        const size_t at = one->what.surface;
        const size_t position = one->position != LENS_NONE ? one->position : 0;
        const struct lens *lens = lens_at_position(job->lens, position, arena);
        const bool is_bounded = !isinf(one->low) || !isinf(one->high);
        if (one->what.kind == PARAMETER_THICKNESS && at < lens->surface_count && !is_bounded &&
            (optimize_start_count(job->input) > 0 || lens->surfaces[at].kind == SURFACE_STOP ||
             (at + 1 < lens->surface_count && lens->surfaces[at + 1].kind == SURFACE_STOP))) {
            if (parameter_get(lens, one->what) >= 0) {
                one->low = 0;
            } else {
                one->high = 0;
            }
        }
    }
    return variables_open(job->lens, list, count, arena, &job->variables, error);
}

/* Once an iteration, from any thread. */
static bool optimize_job_goes_on(void *context)
{
    const struct optimize_job *job = context;
    return watch_add(job->run->watch, 1) && progress_clock() < job->until;
}

/* Read what is asked; the merit is that of the question, its goals those that --goals takes. */
static bool optimize_open(struct optimize_job *job, struct merit_question *question,
                          struct error *error)
{
    const struct optimize_input *input = job->input;
    const struct lens *lens = input->question.lens.lens;
    struct arena *arena = job->run->arena;
    const struct goals_reader reader = {
        .db = job->run->db, .lens = lens, .arena = arena, .where = "--goals", .deviation = 1};
    struct goals goals;
    job->lens = lens;
    if (!design_view(&input->question, &input->waves, arena, question, error)) {
        return false;
    }
    for (size_t i = 0; i < question->position_count; i++) {
        for (size_t k = 0; k < i; k++) { /* it would count twice */
            if (question->positions[i] == question->positions[k]) {
                return fail(error, ERROR_USAGE, "{--position} has '%s' twice",
                            lens->positions[question->positions[i]]);
            }
        }
    }
    if (!open_variables(job, error)) {
        return false;
    }
    question->variables = &job->variables;
    question->variable_count = job->variables.count;
    question->from_entrance = input->aim == ANALYSIS_AIM_ENTRANCE;
    question->clip = input->clip;
    question->pattern = (enum pattern)input->pattern;
    question->rays = input->rays > 0 ? (size_t)input->rays : USUAL_RAYS;
    question->seed = (uint64_t)input->seed;
    const bool is_own = input->goals == NULL && lens->goal_count > 0;
    job->goals = input->goals;
    for (size_t i = 0; is_own && i < lens->goal_count; i++) {
        const struct text text = lens->goals[i].text;
        job->goals = arena_printf(arena, "%s%s%.*s", i > 0 ? job->goals : "", i > 0 ? ", " : "",
                                  (int)text.length, text.start);
    }
    if (!optimize_usual_open(job, question, error) ||
        !(is_own ? goals_of_lens(&reader, lens, &goals, error)
                 : goals_read(&reader, text_of(job->goals), &goals, error)) ||
        !check_used(question, &goals, error)) {
        return false;
    }
    goals_add_grazing(job, &goals);
    if (!optimize_errors(job, &goals, error)) {
        return false;
    }
    question->errors = &job->errors;
    question->operands = goals.list;
    question->operand_count = goals.count;
    return merit_open(question, arena, &job->merit, error) && optimize_glasses_open(job, error) &&
           optimize_plates_open(job, error);
}

/* The layouts of --start, of which the first speaks for all. */
static bool optimize_open_layouts(struct optimize_job *job, struct merit_question *question,
                                  struct error *error)
{
    if (!optimize_start_open(job, error)) {
        return false;
    }
    for (size_t i = job->layout_count; i-- > 0;) {
        if (!optimize_open(&job->layouts[i], question, error)) {
            return false;
        }
    }
    struct optimize_job first = job->layouts[0];
    first.layouts = job->layouts;
    first.layout_count = job->layout_count;
    *job = first;
    return true;
}

bool optimize_job_run(struct optimize_job *job, struct error *error)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    struct merit_question question;
    if (input->start != NULL) {
        return optimize_open_layouts(job, &question, error) &&
               optimize_search(job, &question, error);
    }
    if (!optimize_open(job, &question, error)) {
        return false;
    }
    if (input->global > 0) {
        return optimize_search(job, &question, error);
    }
    job->task = (struct optimize_task){.merit = &job->merit,
                                       .engine = (enum solver_engine)input->solver,
                                       .iterations = (int)input->iterations,
                                       .goes_on = optimize_job_goes_on,
                                       .context = job};
    job->until = isnan(input->seconds) ? INFINITY : progress_clock() + input->seconds;
    watch_begin(job->run->watch, "iterations", 0);
    if (!optimize_run(&job->task, arena, &job->answer, error)) {
        return false;
    }
    job->found = variables_lens(&job->variables, job->answer.after.numbers, arena);
    optimize_refine(job);
    if (!optimize_glasses_choose(job, error) || !optimize_plates_fit(job, error)) {
        return false;
    }
    job->is_late = !watch_is_ended(job->run->watch) && progress_clock() >= job->until;
    optimize_warn_of_look(job);
    return optimize_judge(job, error);
}
