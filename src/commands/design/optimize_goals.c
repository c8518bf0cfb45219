/* commands/design/optimize_goals.c - goals of --goals, of the lens, or usual ones. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_goals.h"

#include "base/constants.h"
#include "cli/options/tolerances.h"
#include "optics/first_order.h"

#include <math.h>

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
static double optimize_goals_least_of(struct optimize_job *job,
                                      const struct merit_question *question, const char *name)
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
        const double least = optimize_goals_least_of(job, question, limits[i].name),
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
static void optimize_goals_add_grazing(struct optimize_job *job, struct goals *goals)
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

static bool optimize_goals_read_goals(struct optimize_job *job,
                                      const struct merit_question *question, struct goals *goals,
                                      struct error *error)
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

bool optimize_goals(struct optimize_job *job, const struct merit_question *question,
                    struct goals *goals, struct error *error)
{
    if (!optimize_goals_read_goals(job, question, goals, error) ||
        !check_used(question, goals, error)) {
        return false;
    }
    optimize_goals_add_grazing(job, goals);
    return true;
}

bool optimize_errors(struct optimize_job *job, const struct goals *goals, struct error *error)
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
