/* commands/design/optimize_job.c - what is to be optimised, from the options; and doing it. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "base/constants.h"
#include "cli/options/goals.h"
#include "cli/options/vary.h"
#include "cli/progress.h"
#include "commands/analysis/analysis_options.h"
#include "commands/design/optimize_contrast.h"
#include "commands/design/optimize_glasses.h"
#include "commands/design/optimize_goals.h"
#include "design/glass_map.h"
#include "report/warnings.h"

#include <math.h>
#include <string.h>

/* What is seen of the lens while it changes. */
struct optimize_job_view {
    struct setup_field *fields;
    const size_t *positions;
    size_t position_count;
};

/* A position that is named twice would count twice. */
static bool optimize_job_check_once(const struct lens *lens, const struct optimize_job_view *view,
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
           optimize_job_check_once(question->lens.lens, view, error) &&
           lens_fields_asked(question, view->positions[0], view->fields, error);
}

/* The question of the merit, without goals. */
static struct merit_question optimize_job_question_of(struct optimize_job *job,
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

static const char *optimize_job_status_of(const struct optimize_job *job)
{
    static const char *const words[] = {
        [SOLVER_CONVERGED] = "converged",
        [SOLVER_LIMIT] = "as many iterations as allowed",
        [SOLVER_STOPPED] = "interrupted",
        [SOLVER_STUCK] = "no step makes it better",
    };
    const enum solver_status status = job->answer.summary.status;
    return status == SOLVER_STOPPED && job->is_late ? "the time is up" : words[status];
}

void optimize_warn(struct optimize_job *job, const char *words)
{
    job->warning = lens_warnings_join(job->warning, words, job->run->arena);
}

/* Variables that nothing depends on, in words. */
static void warn_of_idle(struct optimize_job *job)
{
    const char *names = NULL;
    struct arena *arena = job->run->arena;
    size_t count = 0;
    for (size_t i = 0; i < job->variables.count; i++) {
        if (job->answer.is_idle[i]) {
            names =
                names == NULL ? job->names[i] : arena_printf(arena, "%s, %s", names, job->names[i]);
            count++;
        }
    }
    if (count > 0) {
        optimize_warn(job, arena_printf(arena, "no goal depends on %s: %s stays as it is", names,
                                        count > 1 ? "each" : "it"));
    }
}

/* By how many deviations a goal of a figure is missed; those of rays have no target. */
static double optimize_job_missed_by(const struct optimize_job *job, const struct merit_slot *slot)
{
    const struct operand *operand = slot->operand;
    double most = 0;
    if ((operand_type(operand->kind)->is & OPERAND_OF_RAYS) != 0 ||
        operand->kind == OPERAND_GRAZING || operand->relation == OPERAND_EXACT) {
        return 0;
    }
    for (size_t i = slot->first; i < slot->first + slot->count; i++) {
        most = fmax(most, fabs(job->answer.after.residuals[i]));
    }
    return most;
}

/* A goal that is off by more than it may be is out of reach, of the variables or of other goals. */
static void warn_of_missed(struct optimize_job *job)
{
    struct arena *arena = job->run->arena;
    const struct merit *merit = &job->merit;
    const char *name = NULL;
    double most = 1;
    size_t count = 0;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const double by = optimize_job_missed_by(job, &merit->slots[i]);
        count += by > 1;
        if (by > most) {
            most = by;
            name = merit->slots[i].operand->name;
        }
    }
    if (count > 0) {
        optimize_warn(job,
                      arena_printf(arena, "the goal %s is missed by %.3g deviations%s", name, most,
                                   count > 2    ? arena_printf(arena,
                                                               ", and %zu others by "
                                                                  "more than one",
                                                               count - 1)
                                   : count == 2 ? ", and another by more than one"
                                                : ""));
    }
}

/* What keeps rays from loss is part of the merit that nobody has asked for: it is said. So is the
   angle where somebody has, as its residuals are none. */
static void warn_of_grazing(struct optimize_job *job)
{
    const struct optimize_state *after = &job->answer.after;
    struct arena *arena = job->run->arena;
    const char *name = NULL;
    double sum = 0, angle = 0;
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        const struct merit_slot *slot = &job->merit.slots[i];
        const double residual = after->residuals[slot->first];
        if (slot->operand->kind == OPERAND_GRAZING && residual > 0) {
            sum += residual * residual;
            angle = fmax(angle, after->values[slot->first]);
            name = slot->operand->name;
        }
    }
    if (sum > 0) {
        const char *missed =
            job->guards ? "" : arena_printf(arena, "the goal %s is missed: ", name);
        const double percent = 100 * sum / after->merit;
        optimize_warn(job, arena_printf(arena,
                                        "%srays meet or leave a surface at up to %.1f deg from its "
                                        "normal: %.*g %% of the merit keeps them from loss",
                                        missed, angle * DEGREES_PER_RADIAN, percent < 99.5 ? 2 : 3,
                                        percent));
    }
}

/* Goals of positions that are not optimised. */
static void warn_of_elsewhere(struct optimize_job *job)
{
    const struct merit *merit = &job->merit;
    for (size_t i = 0; i < merit->question.operand_count; i++) {
        const struct operand *operand = &merit->question.operands[i];
        bool counts = false;
        for (size_t k = 0; k < merit->slot_count && !counts; k++) {
            counts = merit->slots[k].operand == operand;
        }
        if (!counts) {
            optimize_warn(
                job, arena_printf(job->run->arena,
                                  "the goal %s is of a position that is not optimised: it does "
                                  "not count",
                                  operand->name));
        }
    }
}

/* Goals of an f-number that is given. */
static void warn_of_fnumber(struct optimize_job *job)
{
    const struct operand *told = NULL;
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        const struct merit_slot *slot = &job->merit.slots[i];
        const bool is_given = job->merit.places[slot->place].aperture.kind == APERTURE_FNUMBER;
        if (slot->operand->kind == OPERAND_FNUMBER && is_given && slot->operand != told) {
            told = slot->operand;
            optimize_warn(
                job, arena_printf(job->run->arena,
                                  "the goal %s does nothing: the f-number is given, whatever the "
                                  "lens",
                                  told->name));
        }
    }
}

/* Model glasses that became such as there are none, by wide bounds or by pick-ups. */
static void warn_of_glasses(struct optimize_job *job)
{
    static const double slack = 1e-9; /* what lies on the border is within */
    struct arena *arena = job->run->arena;
    for (size_t i = 0; i < job->found->surface_count; i++) {
        const struct medium *was = &job->lens->surfaces[i].medium;
        const struct medium *is = &job->found->surfaces[i].medium;
        const bool changed = is->index.hi != was->index.hi || is->abbe.hi != was->abbe.hi;
        const double share = glass_map_share(is->index.hi, is->abbe.hi);
        if (is->kind == MEDIUM_MODEL && changed && !(share >= -slack && share <= 1 + slack)) {
            optimize_warn(job, arena_printf(arena,
                                            "surface %zu: %.6g/%.4g lies outside of the map of "
                                            "optical glasses",
                                            i + 1, is->index.hi, is->abbe.hi));
        }
    }
}

/* Does a goal that counts in a place hold the focal length there? */
static bool holds_power(const struct merit *merit, size_t place)
{
    bool holds = false;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const enum operand_kind kind = merit->slots[i].operand->kind;
        holds = holds ||
                (merit->slots[i].place == place &&
                 (kind == OPERAND_EFL || kind == OPERAND_MAGNIFICATION || kind == OPERAND_HEIGHT));
    }
    return holds;
}

/* Small spots are easiest to have of a lens that is another: one that has become so is told. */
static bool warn_of_power(struct optimize_job *job, struct error *error)
{
    static const double most = 0.05; /* of a change that goes without saying */
    struct arena *arena = job->run->arena;
    for (size_t i = 0; i < job->merit.place_count; i++) {
        const struct merit_place *place = &job->merit.places[i];
        const struct lens *found = lens_at_position(job->found, place->position, arena);
        const char *position = place->setup.position;
        const double before = place->setup.first.efl;
        struct first_order first;
        if (!first_order_of_lens(found, lens_primary_wavelength(found), place->setup.section, arena,
                                 &first, error)) {
            return error_prefix(error, "the lens that was found: ");
        }
        if (isfinite(before) && !(fabs(first.efl / before - 1) <= most) &&
            !holds_power(&job->merit, i)) {
            optimize_warn(
                job, arena_printf(arena,
                                  "%s%sno goal holds the focal length: it was %.4g mm and is %.4g",
                                  position != NULL ? position : "", position != NULL ? ": " : "",
                                  before, first.efl));
        }
    }
    return true;
}

/* What lenscalc would say of the lens that was found. */
static bool check_found(struct optimize_job *job, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct lens_warnings warnings;
    if (!lens_check(job->found, arena, &warnings, error)) {
        return error_prefix(error, "the lens that was found: ");
    }
    for (size_t i = 0; i < warnings.count; i++) {
        optimize_warn(job, warnings.texts[i]);
    }
    return true;
}

/* Conditions are met to this, in their deviations. */
static const double exactly = 1e-10;

/* The goal with == that is missed most. */
static const char *missed_goal(const struct optimize_job *job)
{
    const struct merit *merit = &job->merit;
    const char *name = "a goal with ==";
    double most = 0;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        for (size_t k = 0; k < slot->count && slot->operand->relation == OPERAND_EXACT; k++) {
            const double off = fabs(job->answer.after.residuals[slot->first + k]);
            name = off > most ? slot->operand->name : name;
            most = fmax(most, off);
        }
    }
    return name;
}

static void optimize_job_judge(struct optimize_job *job)
{
    const struct solver_summary *summary = &job->answer.summary;
    struct arena *arena = job->run->arena;
    const char *why = NULL;
    const size_t missing = job->choice != NULL ? job->choice->missing : 0;
    const char *left = missing == 0 ? ""
                                    : arena_printf(arena, ", %zu model glass%s left", missing,
                                                   missing > 1 ? "es" : "");
    if (summary->status == SOLVER_STOPPED && !job->is_late) {
        why = arena_printf(arena, "interrupted after %ld iterations: the best so far, incomplete%s",
                           summary->iterations, left);
    } else if (missing > 0) {
        why = arena_printf(arena, "the time was up: the best so far, incomplete%s", left);
    } else if (!(summary->excess <= exactly)) {
        why = arena_printf(arena,
                           "the goal %s is missed by %.3g deviations: it contradicts another goal "
                           "or the bounds, or wants more iterations",
                           missed_goal(job), summary->excess);
        job->status = "a goal with == is missed";
    }
    job->incomplete = why;
    if (why != NULL) {
        fail(&job->run->shortfall, ERROR_DOMAIN, "%s", why);
    }
}

static bool optimize_job_optimise(struct optimize_job *job, struct error *error)
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
    return true;
}

bool optimize_judge(struct optimize_job *job, struct error *error)
{
    job->status = optimize_job_status_of(job);
    optimize_warn(job, job->answer.begun);
    warn_of_elsewhere(job);
    warn_of_fnumber(job);
    warn_of_idle(job);
    warn_of_grazing(job);
    warn_of_missed(job);
    warn_of_glasses(job);
    optimize_warn(job, optimize_contrast_missed(job));
    optimize_warn(job, optimize_contrast_doubt(job));
    optimize_job_judge(job);
    return warn_of_power(job, error) && check_found(job, error);
}

bool optimize_open(struct optimize_job *job, struct merit_question *question, struct error *error)
{
    struct optimize_job_view view;
    struct goals goals;
    job->lens = job->input->question.lens.lens;
    if (!set_view(job, &view, error) || !open_variables(job, error)) {
        return false;
    }
    *question = optimize_job_question_of(job, &view);
    if (!optimize_goals(job, question, &goals, error) || !optimize_errors(job, &goals, error)) {
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
    return optimize_job_optimise(job, error) && optimize_judge(job, error);
}
