/* commands/design/optimize_judge.c - how it ended, and what is doubtful about a lens that was found. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "analysis/image/mtf.h"
#include "base/constants.h"
#include "cli/options/goals.h"
#include "cli/options/vary.h"
#include "cli/progress.h"
#include "commands/analysis/analysis_options.h"
#include "design/glass_map.h"
#include "report/warnings.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void optimize_warn(struct optimize_job *job, const char *format, ...)
{
    enum { LONGEST = 4000 };
    char words[LONGEST];
    va_list values;
    va_start(values, format);
    vsnprintf(words, sizeof words, format, values);
    va_end(values);
    job->warning =
        lens_warnings_join(job->warning, ARENA_JOIN(job->run->arena, words), job->run->arena);
}

/* Contrasts that are off by so much are said. */
static const double doubtful = 0.01;

static bool is_contrast(const struct operand *operand)
{
    return operand->kind == OPERAND_MTF || operand->kind == OPERAND_GMTF;
}

/* -------- as it is -------- */

bool optimize_open_setup(const struct optimize_job *job, const struct lens *lens, size_t place,
                         const struct setup_wavelength *lights, size_t light_count,
                         bool takes_telecentric, struct setup *setup, struct error *error)
{
    const struct merit_question *question = &job->merit.question;
    const struct setup_question asked = {.lens = lens,
                                         .position = job->merit.places[place].position,
                                         .section = question->section,
                                         .wavelength = NAN,
                                         .wavelengths = WAVELENGTHS_ALL,
                                         .spectrum = lights,
                                         .spectrum_count = light_count,
                                         .fnumber = question->fnumber,
                                         .fields = question->fields,
                                         .field_count = question->field_count,
                                         .field_policy = FIELDS_ALL,
                                         .takes_telecentric = takes_telecentric};
    return setup_open(&asked, job->run->arena, setup, error) &&
           setup_place_image(setup, &(struct plane_value){.kind = PLANE_OF_LENS}, error);
}

/* One field by the analysis, which takes as many rays as it needs. */
static bool look_again(const struct optimize_job *job, const struct merit_slot *slot,
                       const struct setup *setup, const struct field_point *field, struct mtf *mtf,
                       struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct mtf_question question = {
        .bundle = {.setup = setup,
                   .field = field,
                   .from_entrance = job->merit.question.from_entrance,
                   .pattern = PATTERN_GAUSS},
        .by_rays = slot->operand->kind == OPERAND_GMTF,
        .error = doubtful / 10};
    struct mtf_source source;
    return mtf_open(&question, arena, &source, error) &&
           mtf_find(&source, slot->operand->frequency, arena, mtf, error);
}

/* The contrast that is off most. */
struct contrast_doubt {
    const struct operand *operand;
    double off, seen, is; /* is NaN: it is not known */
};

static void contrast_compare(const struct optimize_job *job, const struct merit_slot *slot,
                             size_t row, double is, struct contrast_doubt *doubt)
{
    const double seen = job->answer.after.values[slot->first + row];
    const double off = isnan(is) ? 1 : fabs(is - seen);
    if (off > doubt->off) {
        *doubt = (struct contrast_doubt){slot->operand, off, seen, is};
    }
}

/* All residuals of a slot: of fields that count, tangential before sagittal. */
static void look_at_slot(const struct optimize_job *job, const struct merit_slot *slot,
                         struct contrast_doubt *doubt)
{
    const struct operand *operand = slot->operand;
    const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    struct setup setup;
    struct error ignored;
    size_t row = 0;
    const struct setup_wavelength own = {operand->wavelength, 1};
    const struct merit_question *question = &job->merit.question;
    const bool has_own = !isnan(own.wavelength);
    const bool is_open =
        optimize_open_setup(job, job->found, slot->place, has_own ? &own : question->wavelengths,
                            has_own ? 1 : question->wavelength_count, true, &setup, &ignored);
    const struct setup *start = &job->merit.places[slot->place].setup;
    const struct setup_field *fields = operand->field != NULL   ? operand->field
                                       : start->field_count > 0 ? start->fields
                                                                : &axis;
    const size_t count = operand->field == NULL && start->field_count > 0 ? start->field_count : 1;
    for (size_t i = 0; i < count; i++) {
        struct mtf mtf = {.contrast = {NAN, NAN}};
        if (!(fields[i].weight > 0)) {
            continue;
        }
        if (!is_open || !look_again(job, slot, &setup, &fields[i].point, &mtf, &ignored)) {
            mtf.contrast[0] = mtf.contrast[1] = NAN;
        }
        if (operand->orientation != ORIENTATION_SAGITTAL) {
            contrast_compare(job, slot, row++, mtf.contrast[MTF_TANGENTIAL], doubt);
        }
        if (operand->orientation != ORIENTATION_TANGENTIAL) {
            contrast_compare(job, slot, row++, mtf.contrast[MTF_SAGITTAL], doubt);
        }
    }
}

/*
 * Contrasts of the lens that was found, by analysis/image/mtf.h, which takes as many rays as it
 * needs: what differs by more than 0.01 is said.
 */
static void warn_of_contrast(struct optimize_job *job)
{
    struct contrast_doubt doubt = {.off = doubtful};
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        if (is_contrast(job->merit.slots[i].operand)) {
            look_at_slot(job, &job->merit.slots[i], &doubt);
        }
    }
    if (doubt.operand != NULL && isnan(doubt.is)) {
        optimize_warn(
            job, "contrast is in doubt: of goal %s %zu rays see %.3f, and lenscalc mtf has none",
            doubt.operand->name, job->merit.question.rays, doubt.seen);
    } else if (doubt.operand != NULL) {
        optimize_warn(job,
                      "contrast wants more than %zu rays: of goal %s they see %.3f, where lenscalc "
                      "mtf has %.3f",
                      job->merit.question.rays, doubt.operand->name, doubt.seen, doubt.is);
    }
}

/* -------- as wanted -------- */

/* By how much a contrast is missed; "= 1" is how one asks for as much as can be. */
static double contrast_missed_by(const struct operand *operand, double value)
{
    switch (operand->relation) {
    case OPERAND_ABOVE:
        return operand->target - value;
    case OPERAND_BELOW:
        return value - operand->target;
    case OPERAND_NEAR:
        return operand->target < 1 ? fabs(value - operand->target) : 0;
    case OPERAND_EXACT:
    case OPERAND_RELATIONS:
        break;
    }
    return 0;
}

/* Goals of contrast that are missed by more than 0.01, though not by a deviation: the worst. */
static void warn_of_missed_contrast(struct optimize_job *job)
{
    const struct operand *worst = NULL;
    double most = doubtful;
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        const struct merit_slot *slot = &job->merit.slots[i];
        for (size_t k = 0; k < slot->count && is_contrast(slot->operand); k++) {
            const double by =
                contrast_missed_by(slot->operand, job->answer.after.values[slot->first + k]);
            /* more than a deviation is said of all goals alike */
            if (by > most && by <= slot->operand->deviation) {
                most = by;
                worst = slot->operand;
            }
        }
    }
    if (worst != NULL) {
        optimize_warn(job, "the goal %s is missed by %.2g", worst->name, most);
    }
}

/* -------- what is doubtful -------- */

static const char *optimize_status_of(const struct optimize_job *job)
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
        optimize_warn(job, "no goal depends on %s: %s stays as it is", names,
                      count > 1 ? "each" : "it");
    }
}

/* By how many deviations a goal of a figure is missed; those of rays have no target. */
static double goal_missed_by(const struct optimize_job *job, const struct merit_slot *slot)
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
    const struct merit *merit = &job->merit;
    const char *name = NULL;
    double most = 1;
    size_t count = 0;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const double by = goal_missed_by(job, &merit->slots[i]);
        count += by > 1;
        if (by > most) {
            most = by;
            name = merit->slots[i].operand->name;
        }
    }
    const char *others = count == 2 ? ", and another by more than one" : "";
    if (count > 2) {
        others = arena_printf(job->run->arena, ", and %zu others by more than one", count - 1);
    }
    if (count > 0) {
        optimize_warn(job, "the goal %s is missed by %.3g deviations%s", name, most, others);
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
        optimize_warn(job,
                      "%srays meet or leave a surface at up to %.1f deg from its "
                      "normal: %.*g %% of the merit keeps them from loss",
                      missed, angle * DEGREES_PER_RADIAN, percent < 99.5 ? 2 : 3, percent);
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
            optimize_warn(job,
                          "the goal %s is of a position that is not optimised: it does "
                          "not count",
                          operand->name);
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
            optimize_warn(job,
                          "the goal %s does nothing: the f-number is given, whatever the "
                          "lens",
                          told->name);
        }
    }
}

/* Model glasses that became such as there are none, by wide bounds or by pick-ups. */
static void warn_of_glasses(struct optimize_job *job)
{
    static const double slack = 1e-9; /* what lies on the border is within */
    for (size_t i = 0; i < job->found->surface_count; i++) {
        const struct medium *was = &job->lens->surfaces[i].medium;
        const struct medium *is = &job->found->surfaces[i].medium;
        const bool changed = is->index.hi != was->index.hi || is->abbe.hi != was->abbe.hi;
        const double share = glass_map_share(is->index.hi, is->abbe.hi);
        if (is->kind == MEDIUM_MODEL && changed && !(share >= -slack && share <= 1 + slack)) {
            optimize_warn(job,
                          "surface %zu: %.6g/%.4g lies outside of the map of "
                          "optical glasses",
                          i + 1, is->index.hi, is->abbe.hi);
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
            optimize_warn(job, "%s%sno goal holds the focal length: it was %.4g mm and is %.4g",
                          position != NULL ? position : "", position != NULL ? ": " : "", before,
                          first.efl);
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
        optimize_warn(job, "%s", warnings.texts[i]);
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

static void optimize_judge_end(struct optimize_job *job)
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

bool optimize_judge(struct optimize_job *job, struct error *error)
{
    job->status = optimize_status_of(job);
    if (job->answer.begun != NULL) {
        optimize_warn(job, "%s", job->answer.begun);
    }
    warn_of_elsewhere(job);
    warn_of_fnumber(job);
    warn_of_idle(job);
    warn_of_grazing(job);
    warn_of_missed(job);
    warn_of_glasses(job);
    warn_of_missed_contrast(job);
    warn_of_contrast(job);
    optimize_judge_end(job);
    return warn_of_power(job, error) && check_found(job, error);
}

struct optimize_about optimize_about_of(const struct optimize_job *job, bool is_first)
{
    return (struct optimize_about){.fnumber = job->input->question.fnumber,
                                   .seed = job->input->seed,
                                   .rank = job->rank,
                                   .lens = job->lens->title,
                                   .warning = is_first ? job->warning : NULL};
}
