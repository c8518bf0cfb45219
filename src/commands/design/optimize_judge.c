/* commands/design/optimize_judge.c - how it ended, and what is doubtful about a lens that was found. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "analysis/image/mtf.h"
#include "base/constants.h"
#include "cli/options/goals.h"
#include "cli/options/vary.h"
#include "cli/progress.h"
#include "commands/analysis/analysis_options.h"
#include "design/degenerate.h"
#include "design/glass_map.h"
#include "design/merit/expression.h"
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

double optimize_wrong_by(const struct operand *operand, double value)
{
    const double off = value - operand->target;
    if (operand->relation == OPERAND_BELOW) {
        return off;
    }
    if (operand->relation == OPERAND_ABOVE) {
        return -off;
    }
    return fabs(off);
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

/* The contrast that is off most. */
struct contrast_doubt {
    const struct operand *operand;
    double off, seen, is; /* is NaN: it is not known */
};

/* All residuals of a slot, of fields that count, tangential before sagittal, by the analysis, which
   takes as many rays as it needs. */
static void look_at_slot(const struct optimize_job *job, const struct merit_slot *slot,
                         struct contrast_doubt *doubt)
{
    const struct operand *operand = slot->operand;
    const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    struct arena *arena = job->run->arena;
    struct setup setup;
    struct error ignored;
    const double *seen = &job->answer.after.values[slot->first];
    const struct setup_wavelength own = {operand->wavelength, 1};
    const struct merit_question *question = &job->merit.question;
    const bool has_own = !isnan(own.wavelength);
    const bool is_open =
        optimize_open_setup(job, job->found, slot->place, has_own ? &own : question->wavelengths,
                            has_own ? 1 : question->wavelength_count, true, &setup, &ignored);
    const struct setup *start = &job->merit.places[slot->place].setup;
    const struct setup_field *fields = &axis;
    size_t count = 1;
    if (operand->field != NULL) {
        fields = operand->field;
    } else if (start->field_count > 0) {
        fields = start->fields;
        count = start->field_count;
    }
    for (size_t i = 0; i < count; i++) {
        const struct mtf_question asked = {.bundle = {.setup = &setup,
                                                      .field = &fields[i].point,
                                                      .from_entrance = question->from_entrance,
                                                      .pattern = PATTERN_GAUSS},
                                           .by_rays = operand->kind == OPERAND_GMTF,
                                           .error = doubtful / 10};
        struct mtf mtf;
        struct mtf_source source;
        if (!(fields[i].weight > 0)) {
            continue;
        }
        const bool found = is_open && mtf_open(&asked, arena, &source, &ignored) &&
                           mtf_find(&source, operand->frequency, arena, &mtf, &ignored);
        for (int k = MTF_TANGENTIAL; k <= MTF_SAGITTAL; k++) {
            if (operand->orientation ==
                (k == MTF_TANGENTIAL ? ORIENTATION_SAGITTAL : ORIENTATION_TANGENTIAL)) {
                continue;
            }
            const double is = found ? mtf.contrast[k] : NAN;
            const double off = isnan(is) ? 1 : fabs(is - *seen);
            if (off > doubt->off) {
                *doubt = (struct contrast_doubt){operand, off, *seen, is};
            }
            seen++;
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
        size_t count;
        const struct merit_slot *slots = expression_slots(&job->merit.slots[i], &count);
        for (size_t k = 0; k < count; k++) {
            if (is_contrast(slots[k].operand)) {
                look_at_slot(job, &slots[k], &doubt);
            }
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

/* Goals of contrast that are missed by more than 0.01, though not by a deviation: the worst; "= 1"
   is how one asks for as much as can be. */
static void warn_of_missed_contrast(struct optimize_job *job)
{
    const struct operand *worst = NULL;
    double most = doubtful;
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        const struct merit_slot *slot = &job->merit.slots[i];
        const struct operand *operand = slot->operand;
        const bool counts = is_contrast(operand) && operand->relation != OPERAND_EXACT &&
                            (operand->relation != OPERAND_NEAR || operand->target < 1);
        for (size_t k = 0; k < slot->count && counts; k++) {
            const double by = optimize_wrong_by(operand, job->answer.after.values[slot->first + k]);
            /* more than a deviation is said of all goals alike */
            if (by > most && by <= operand->deviation) {
                most = by;
                worst = operand;
            }
        }
    }
    if (worst != NULL) {
        optimize_warn(job, "the goal %s is missed by %.2g", worst->name, most);
    }
}

/* -------- what is doubtful -------- */

/* Variables that nothing depends on, in words. */
static void warn_of_idle(struct optimize_job *job)
{
    const char *names = NULL;
    struct arena *arena = job->run->arena;
    size_t count = 0;
    for (size_t i = 0; i < job->variables.count; i++) {
        if (job->answer.is_idle[i]) {
            const char *name = job->variables.list[i].name;
            names = names == NULL ? name : arena_printf(arena, "%s, %s", names, name);
            count++;
        }
    }
    if (count > 0) {
        optimize_warn(job, "no goal depends on %s: %s stays as it is", names,
                      count > 1 ? "each" : "it");
    }
}

/* A goal that is off by more than it may be is out of reach, of the variables or of other goals;
   those of rays have no target. */
static void warn_of_missed(struct optimize_job *job)
{
    const struct merit *merit = &job->merit;
    const char *name = NULL;
    double most = 1;
    size_t count = 0;
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        const struct operand *operand = slot->operand;
        const bool counts = (operand_type(operand->kind)->is & OPERAND_OF_RAYS) == 0 &&
                            operand->kind != OPERAND_GRAZING && operand->relation != OPERAND_EXACT;
        double by = 0; /* deviations */
        for (size_t k = slot->first; counts && k < slot->first + slot->count; k++) {
            by = fmax(by, fabs(job->answer.after.residuals[k]));
        }
        count += by > 1;
        if (by > most) {
            most = by;
            name = operand->name;
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

/* Small spots are easiest to have of a lens that is another: one that has become so is told, where
   no goal that counts holds the focal length. */
static bool warn_of_power(struct optimize_job *job, struct error *error)
{
    static const double most = 0.05; /* of a change that goes without saying */
    const struct merit *merit = &job->merit;
    struct arena *arena = job->run->arena;
    for (size_t i = 0; i < merit->place_count; i++) {
        const struct merit_place *place = &merit->places[i];
        const struct lens *found = lens_at_position(job->found, place->position, arena);
        const char *position = place->setup.position;
        const double before = place->setup.first.efl;
        struct first_order first;
        bool is_held = false;
        if (!first_order_of_lens(found, lens_primary_wavelength(found), place->setup.section, arena,
                                 &first, error)) {
            return error_prefix(error, "the lens that was found: ");
        }
        for (size_t k = 0; k < merit->slot_count; k++) {
            size_t count;
            const struct merit_slot *slots = expression_slots(&merit->slots[k], &count);
            for (size_t t = 0; t < count; t++) {
                const enum operand_kind kind = slots[t].operand->kind;
                is_held |=
                    slots[t].place == i && (kind == OPERAND_EFL || kind == OPERAND_MAGNIFICATION ||
                                            kind == OPERAND_HEIGHT);
            }
        }
        if (isfinite(before) && !(fabs(first.efl / before - 1) <= most) && !is_held) {
            optimize_warn(job, "%s%sno goal holds the focal length: it was %.4g mm and is %.4g",
                          position != NULL ? position : "", position != NULL ? ": " : "", before,
                          first.efl);
        }
    }
    return true;
}

/* Why it is not what was asked for: it came to no end, or a goal with == is missed, the worst. */
static void judge_end(struct optimize_job *job)
{
    static const double exactly = 1e-10; /* conditions are met to this, in their deviations */
    const struct solver_summary *summary = &job->answer.summary;
    const struct merit *merit = &job->merit;
    struct arena *arena = job->run->arena;
    const size_t missing = job->choice != NULL ? job->choice->missing : 0;
    const char *left = "";
    if (missing > 0) {
        left = arena_printf(arena, ", %zu model glass%s left", missing, missing > 1 ? "es" : "");
    }
    job->incomplete = NULL;
    if (summary->status == SOLVER_STOPPED && !job->is_late) {
        job->incomplete =
            arena_printf(arena, "interrupted after %ld iterations: the best so far, incomplete%s",
                         summary->iterations, left);
    } else if (missing > 0) {
        job->incomplete =
            arena_printf(arena, "the time was up: the best so far, incomplete%s", left);
    } else if (!(summary->excess <= exactly)) {
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
        job->incomplete =
            arena_printf(arena,
                         "the goal %s is missed by %.3g deviations: it contradicts another goal "
                         "or the bounds, or wants more iterations",
                         name, summary->excess);
        job->status = "a goal with == is missed";
    }
    if (job->incomplete != NULL) {
        fail(&job->run->shortfall, ERROR_DOMAIN, "%s", job->incomplete);
    }
}

/* A stop of the size of the paraxial marginal ray, where that is not the beam's. */
static void warn_of_stop(struct optimize_job *job)
{
    const char *said = NULL;
    for (size_t i = 0; i < job->merit.place_count && !job->merit.question.from_entrance; i++) {
        const struct merit_place *place = &job->merit.places[i];
        struct setup setup;
        struct error ignored;
        const char *warning = optimize_open_setup(job, job->found, i, place->setup.wavelengths, 1,
                                                  true, &setup, &ignored)
                                  ? setup_stop_warning(&setup, job->run->arena)
                                  : NULL;
        if (warning != NULL && said == NULL) {
            said = warning;
            optimize_warn(job, "%s", warning);
        }
    }
}

/* Radii that no plate was found for. */
static void judge_plates(struct optimize_job *job)
{
    if (job->unfitted != NULL && job->incomplete == NULL) {
        job->incomplete = job->unfitted;
        fail(&job->run->shortfall, ERROR_DOMAIN, "%s", job->unfitted);
    }
}

struct clear_diameters_question optimize_beams(const struct optimize_job *job, double margin)
{
    const struct merit_question *question = &job->merit.question;
    return (struct clear_diameters_question){.lens = job->found,
                                             .fnumber = question->fnumber,
                                             .fields = question->fields,
                                             .field_count = question->field_count,
                                             .wavelengths = question->wavelengths,
                                             .wavelength_count = question->wavelength_count,
                                             .margin = margin};
}

/* Diameters of the lens that was found, where they are wanted; one that cannot have them is kept as
   it is, but is not what was asked for. */
static void set_diameters(struct optimize_job *job)
{
    const struct clear_diameters_question asked = optimize_beams(job, job->input->margin);
    const char *notes;
    struct error why;
    if (isnan(job->input->margin)) {
        return;
    }
    if (!clear_diameters_find(&asked, job->run->arena, &job->found, &notes, &why)) {
        job->incomplete =
            arena_printf(job->run->arena, "its diameters are not set: %s", why.message);
        fail(&job->run->shortfall, ERROR_DOMAIN, "%s", job->incomplete);
    } else if (notes != NULL) {
        optimize_warn(job, "%s", notes);
    }
}

/* A descent that ended while it still gained, and how it goes on. */
static void warn_of_iterations(struct optimize_job *job)
{
    enum { LAST = 10, FURTHER = 5 };
    static const double least = 1e-5; /* of the merit, an iteration */
    const struct optimize_answer *answer = &job->answer;
    if (answer->summary.status != SOLVER_LIMIT || answer->history_count <= LAST + 1) {
        return;
    }
    /* the last one is that of the lens that was found, which an iteration has told before */
    const double *end = &answer->history[answer->history_count - 2];
    const double gain = (end[-LAST] - *end) / LAST / *end;
    if (gain > least) {
        optimize_warn(job,
                      "it still gained %.2g %% of the merit an iteration when it was ended: "
                      "--iterations %ld goes on",
                      100 * gain,
                      FURTHER * (job->input->iterations > 0 ? job->input->iterations : 200));
    }
}

/* Where it ended though the merit falls beyond. */
static const char *limit_in_words(const struct optimize_job *job)
{
    const struct merit_limit *limit = &job->answer.limit;
    struct arena *arena = job->run->arena;
    const char *position = job->merit.places[limit->place].setup.position;
    return arena_printf(
        arena, "%s: %s, %s%s%s",
        limit->is_of_aim ? "stopped at a limit of aiming" : "stopped where rays are lost",
        lens_field_words(limit->field, arena),
        limit->surface > 0 ? arena_printf(arena, "surface %zu", limit->surface) : "the stop",
        position != NULL ? ", position " : "", position != NULL ? position : "");
}

bool optimize_judge(struct optimize_job *job, struct error *error)
{
    static const char *const words[] = {
        [SOLVER_CONVERGED] = "converged",
        [SOLVER_LIMIT] = "as many iterations as allowed",
        [SOLVER_STOPPED] = "interrupted",
        [SOLVER_STUCK] = "no step makes it better",
    };
    const enum solver_status status = job->answer.summary.status;
    struct lens_warnings warnings;
    job->status = status == SOLVER_STOPPED && job->is_late ? "the time is up" : words[status];
    const char *moved = variables_moved(&job->variables, job->run->arena);
    if (moved != NULL) {
        optimize_warn(job, "%s", moved);
    }
    if (job->answer.limit.is_known) {
        job->status = limit_in_words(job);
    }
    if (job->answer.begun != NULL) {
        optimize_warn(job, "%s", job->answer.begun);
    }
    if (job->answer.is_detour) {
        optimize_warn(job, "rays could not be aimed at the stop on the way: it went on by points "
                           "of the entrance pupil, and came back");
    }
    warn_of_elsewhere(job);
    warn_of_fnumber(job);
    warn_of_idle(job);
    warn_of_grazing(job);
    warn_of_missed(job);
    warn_of_glasses(job);
    warn_of_missed_contrast(job);
    warn_of_contrast(job);
    warn_of_stop(job);
    warn_of_iterations(job);
    judge_end(job);
    judge_plates(job);
    set_diameters(job);
    if (!warn_of_power(job, error)) {
        return false;
    }
    const char *wrong = degenerate_words(&job->merit, job->found, job->run->arena);
    if (wrong != NULL) {
        optimize_warn(job, "what was found is no lens: %s", wrong);
    }
    if (!lens_check(job->found, job->run->arena, &warnings, error)) {
        return error_prefix(error, "the lens that was found: ");
    }
    for (size_t i = 0; i < warnings.count; i++) {
        optimize_warn(job, "%s", warnings.texts[i]);
    }
    return true;
}
