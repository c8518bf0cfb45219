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

/* mm; NaN: an afocal lens. */
static double focal_length(const struct optimize_job *job, size_t position)
{
    const struct lens *lens = job->lens;
    const enum lens_section section = (enum lens_section)job->input->question.section;
    struct arena *arena = job->run->arena;
    const double stated = lens_stated(lens, STATED_EFL, position);
    struct first_order first;
    struct error ignored;
    if (!isnan(stated)) {
        return stated;
    }
    const bool known =
        first_order_of_lens(lens_at_position(lens, position, arena), lens_primary_wavelength(lens),
                            section, arena, &first, &ignored);
    return known && isfinite(first.efl) ? first.efl : NAN;
}

static const char *add_focal_lengths(const struct optimize_job *job,
                                     const struct merit_question *question, const char *words,
                                     double *size)
{
    const struct lens *lens = job->lens;
    struct arena *arena = job->run->arena;
    const size_t all = lens->position_count > 0 ? lens->position_count : 1;
    const size_t count = question->position_count > 0 ? question->position_count : all;
    *size = INFINITY;
    for (size_t i = 0; i < count; i++) {
        const size_t at = question->position_count > 0 ? question->positions[i] : i;
        const double focal = focal_length(job, at);
        if (!isnan(focal)) {
            words = all > 1 ? arena_printf(arena, "%s, efl@%s = %.6g", words, lens->positions[at],
                                           focal)
                            : arena_printf(arena, "%s, efl = %.6g", words, focal);
            *size = fmin(*size, fabs(focal));
        }
    }
    return words;
}

/* The least of the lens's own centres, edges or gaps, mm; NaN: it cannot be told. */
static double least_of_goal(struct optimize_job *job, const struct merit_question *question,
                            const char *name)
{
    struct arena *arena = job->run->arena;
    const struct goals_reader reader = {job->run->db, job->lens, arena, "--goals", 1};
    const char *words = arena_printf(arena, "%s > 0", name);
    struct merit_question asked = *question;
    struct merit merit;
    struct goals goals;
    struct error ignored;
    if (!goals_read(&reader, text_of(words), &goals, &ignored)) {
        return NAN;
    }
    asked.operands = goals.list;
    asked.operand_count = goals.count;
    if (!merit_open(&asked, arena, &merit, &ignored)) {
        return NAN;
    }
    double *numbers = ARENA_ARRAY(arena, job->variables.count + 1, double), least = INFINITY;
    double *residuals = ARENA_ARRAY(arena, merit.residual_count + 1, double);
    variables_get(&job->variables, numbers);
    if (!merit_evaluate(&merit, numbers, residuals, NULL)) {
        return NAN;
    }
    for (size_t i = 0; i < merit.residual_count; i++) {
        least = fmin(least, merit.values[i]);
    }
    return least;
}

/* Two digits of it, not more than it is. */
static double round_down(double value)
{
    const double step = pow(10, floor(log10(value)) - 1);
    return floor(value / step * (1 + 1e-12)) * step;
}

/* No glass and no gap thinner than so much of the focal length, or than the thinnest that is there;
   what cannot be told, as of surfaces that end before their edges, is left out. */
static const char *usual_goals(struct optimize_job *job, const struct merit_question *question)
{
    static const struct {
        const char *name;
        double share;
    } limits[] = {{"center", 0.02}, {"edge", 0.01}, {"air", 0.001}};
    struct arena *arena = job->run->arena;
    double size;
    const char *words = add_focal_lengths(job, question, "poly", &size);
    for (size_t i = 0; i < sizeof limits / sizeof limits[0] && isfinite(size); i++) {
        const double least = least_of_goal(job, question, limits[i].name),
                     usual = limits[i].share * size;
        if (!isnan(least)) {
            words = arena_printf(arena, "%s, %s > %.2g", words, limits[i].name,
                                 round_down(least > 0 ? fmin(least, usual) : usual));
        }
    }
    return words;
}

static const char *join_goals(const struct lens *lens, struct arena *arena)
{
    const char *words = "";
    for (size_t i = 0; i < lens->goal_count; i++) {
        const struct text text = lens->goals[i].text;
        words =
            arena_printf(arena, "%s%s%.*s", words, i > 0 ? ", " : "", (int)text.length, text.start);
    }
    return words;
}

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
    if (has_rays && !has_grazing) {
        all[goals->count++] = grazing;
        goals->list = all;
        job->guards = true;
    }
}

/*
 * The goals of a job, whose variables are open; job->goals receives them in words that --goals
 * takes.
 *
 * Given     question  for its merit, but for the goals
 * Result    without any: `poly`, the focal length that is stated or else the lens's own in each
 *           position, and centres, edges and gaps not below 2 %, 1 % and 0.1 % of the shortest of
 *           them, or below the thinnest that the lens has
 * Errors    as goals_read
 */
static bool optimize_read_goals(struct optimize_job *job, const struct merit_question *question,
                                struct goals *goals, struct error *error)
{
    struct arena *arena = job->run->arena;
    const char *typed = job->input->goals;
    const bool own = typed == NULL && job->lens->goal_count > 0;
    const struct goals_reader reader = {
        .db = job->run->db, .lens = job->lens, .arena = arena, .where = "--goals", .deviation = 1};
    if (own) {
        job->goals = join_goals(job->lens, arena);
        return goals_of_lens(&reader, job->lens, goals, error);
    }
    job->goals = typed != NULL ? typed : usual_goals(job, question);
    return goals_read(&reader, text_of(job->goals), goals, error);
}

/* Wavelengths and fields that are asked for count for goals alone that name none. */
static bool check_used(const struct merit_question *question, const struct goals *goals,
                       struct error *error)
{
    bool of_wavelengths = false, of_fields = false;
    for (size_t i = 0; i < goals->count; i++) {
        const struct operand *goal = &goals->list[i];
        const unsigned is = operand_type(goal->kind)->is;
        of_wavelengths |= (is & OPERAND_OF_WAVELENGTHS) != 0 && isnan(goal->wavelength);
        of_fields |= (is & OPERAND_AT_FIELD) != 0 && goal->field == NULL;
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

/* What is seen of the lens while it changes. */
struct optimize_job_view {
    struct setup_field *fields;
    const size_t *positions;
    size_t position_count;
};

/* A position that is named twice would count twice. */
static bool check_positions_once(const struct lens *lens, const struct optimize_job_view *view,
                                 struct error *error)
{
    for (size_t i = 0; i < view->position_count; i++) {
        for (size_t k = 0; k < i; k++) {
            if (view->positions[i] == view->positions[k]) {
                return fail(error, ERROR_USAGE, "{--position} has '%s' twice",
                            lens->positions[view->positions[i]]);
            }
        }
    }
    return true;
}

static bool set_view(const struct optimize_job *job, struct optimize_job_view *view,
                     struct error *error)
{
    const struct lens_question *question = &job->input->question;
    struct arena *arena = job->run->arena;
    const char *names = question->position != NULL ? question->position : "all";
    view->fields = ARENA_ARRAY(arena, question->fields.count + 1, struct setup_field);
    return lens_positions(question->lens.lens, names, arena, &view->positions,
                          &view->position_count, error) &&
           check_positions_once(question->lens.lens, view, error) &&
           lens_fields_asked(question, view->positions[0], view->fields, error);
}

/* The question of the merit, without goals. */
static struct merit_question optimize_question_of(struct optimize_job *job,
                                                  const struct optimize_job_view *view)
{
    const struct optimize_input *input = job->input;
    return (struct merit_question){.lens = job->lens,
                                   .variables = &job->variables,
                                   .variable_count = job->variables.count,
                                   .wavelengths = input->waves.items,
                                   .wavelength_count = input->waves.count,
                                   .fields = view->fields,
                                   .field_count = input->question.fields.count,
                                   .positions = view->positions,
                                   .position_count = view->position_count,
                                   .section = (enum lens_section)input->question.section,
                                   .fnumber = input->question.fnumber,
                                   .from_entrance = input->aim == ANALYSIS_AIM_ENTRANCE,
                                   .clip = input->clip,
                                   .pattern = (enum pattern)input->pattern,
                                   .rays = (size_t)input->rays,
                                   .seed = (uint64_t)input->seed};
}

/*
 * A stop is no glass, so that goals of air pass over it; but it cannot lie within a lens. Gaps
 * beside it that no bounds are given for stay on their side of 0; those of a search all do, as it
 * would meet many lenses that are none.
 */
static void bound_gap(const struct lens *lens, bool is_search, struct variable *variable)
{
    const size_t at = variable->what.surface;
    if (variable->what.kind != PARAMETER_THICKNESS || !isinf(variable->low) ||
        !isinf(variable->high) ||
        (!is_search && lens->surfaces[at].kind != SURFACE_STOP &&
         !(at + 1 < lens->surface_count && lens->surfaces[at + 1].kind == SURFACE_STOP))) {
        return;
    }
    const double now = parameter_get(lens, variable->what);
    if (now >= 0) {
        variable->low = 0;
    } else {
        variable->high = 0;
    }
}

static bool open_variables(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct vary_reader reader = {.lens = job->lens, .arena = arena};
    struct variable *list;
    size_t count;
    if (!vary_list(&reader, job->input->vary, job->input->hold, &list, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t position = list[i].position != LENS_NONE ? list[i].position : 0;
        bound_gap(lens_at_position(job->lens, position, arena), job->input->global > 0, &list[i]);
    }
    if (!variables_open(job->lens, list, count, arena, &job->variables, error)) {
        return false;
    }
    const char **names = ARENA_ARRAY(arena, count + 1, const char *);
    for (size_t i = 0; i < count; i++) {
        names[i] = list[i].name;
    }
    job->names = names;
    return true;
}

/* Once an iteration, from any thread. */
static bool optimize_job_goes_on(void *context)
{
    const struct optimize_job *job = context;
    return watch_add(job->run->watch, 1) && progress_clock() < job->until;
}

bool optimize_open(struct optimize_job *job, struct merit_question *question, struct error *error)
{
    struct optimize_job_view view;
    struct goals goals;
    job->lens = job->input->question.lens.lens;
    if (!set_view(job, &view, error) || !open_variables(job, error)) {
        return false;
    }
    *question = optimize_question_of(job, &view);
    if (!optimize_read_goals(job, question, &goals, error) ||
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
    return merit_open(question, job->run->arena, &job->merit, error) &&
           optimize_glasses_open(job, error);
}

bool optimize_near(struct optimize_job *job, struct error *error)
{
    const struct optimize_input *input = job->input;
    job->task = (struct optimize_task){.merit = &job->merit,
                                       .engine = (enum solver_engine)input->solver,
                                       .iterations = (int)input->iterations,
                                       .goes_on = optimize_job_goes_on,
                                       .context = job};
    job->until = isnan(input->seconds) ? INFINITY : progress_clock() + input->seconds;
    watch_begin(job->run->watch, "iterations", 0);
    if (!optimize_run(&job->task, job->run->arena, &job->answer, error)) {
        return false;
    }
    job->found = variables_lens(&job->variables, job->answer.after.numbers, job->run->arena);
    if (!optimize_glasses_choose(job, error)) {
        return false;
    }
    job->is_late = !watch_is_ended(job->run->watch) && progress_clock() >= job->until;
    return optimize_judge(job, error);
}
