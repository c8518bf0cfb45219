/* commands/design/optimize_contrast.c - whether contrast was seen as it is, and is as wanted. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_contrast.h"

#include "analysis/image/mtf.h"

#include <math.h>

/* Contrasts that are off by so much are said. */
static const double doubtful = 0.01;

static bool is_contrast(const struct operand *operand)
{
    return operand->kind == OPERAND_MTF || operand->kind == OPERAND_GMTF;
}

/* -------- as it is -------- */

/* The lens that was found, in the position of a slot, at its wavelengths. */
static bool optimize_contrast_open_setup(const struct optimize_job *job,
                                         const struct merit_slot *slot, struct setup *setup,
                                         struct error *error)
{
    const struct merit_question *question = &job->merit.question;
    const struct merit_place *place = &job->merit.places[slot->place];
    const struct setup_wavelength own = {slot->operand->wavelength, 1};
    const bool has_own = !isnan(own.wavelength);
    const struct setup_question asked = {.lens = job->found,
                                         .position = place->position,
                                         .section = question->section,
                                         .wavelength = NAN,
                                         .wavelengths = WAVELENGTHS_ALL,
                                         .spectrum = has_own ? &own : question->wavelengths,
                                         .spectrum_count = has_own ? 1 : question->wavelength_count,
                                         .fnumber = question->fnumber,
                                         .fields = question->fields,
                                         .field_count = question->field_count,
                                         .field_policy = FIELDS_ALL,
                                         .takes_telecentric = true};
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
struct optimize_contrast_doubt {
    const struct operand *operand;
    double off, seen, is; /* is NaN: it is not known */
};

static void optimize_contrast_compare(const struct optimize_job *job, const struct merit_slot *slot,
                                      size_t row, double is, struct optimize_contrast_doubt *doubt)
{
    const double seen = job->answer.after.values[slot->first + row];
    const double off = isnan(is) ? 1 : fabs(is - seen);
    if (off > doubt->off) {
        *doubt = (struct optimize_contrast_doubt){slot->operand, off, seen, is};
    }
}

/* All residuals of a slot: of fields that count, tangential before sagittal. */
static void look_at_slot(const struct optimize_job *job, const struct merit_slot *slot,
                         struct optimize_contrast_doubt *doubt)
{
    const struct operand *operand = slot->operand;
    const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    struct setup setup;
    struct error ignored;
    size_t row = 0;
    const bool is_open = optimize_contrast_open_setup(job, slot, &setup, &ignored);
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
            optimize_contrast_compare(job, slot, row++, mtf.contrast[MTF_TANGENTIAL], doubt);
        }
        if (operand->orientation != ORIENTATION_TANGENTIAL) {
            optimize_contrast_compare(job, slot, row++, mtf.contrast[MTF_SAGITTAL], doubt);
        }
    }
}

const char *optimize_contrast_doubt(const struct optimize_job *job)
{
    struct arena *arena = job->run->arena;
    const size_t rays = job->merit.question.rays;
    struct optimize_contrast_doubt doubt = {.off = doubtful};
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        if (is_contrast(job->merit.slots[i].operand)) {
            look_at_slot(job, &job->merit.slots[i], &doubt);
        }
    }
    if (doubt.operand == NULL) {
        return NULL;
    }
    return isnan(doubt.is)
               ? arena_printf(
                     arena,
                     "contrast is in doubt: of goal %s %zu rays see %.3f, and lenscalc mtf "
                     "has none",
                     doubt.operand->name, rays, doubt.seen)
               : arena_printf(arena,
                              "contrast wants more than %zu rays: of goal %s they see %.3f, where "
                              "lenscalc mtf has %.3f",
                              rays, doubt.operand->name, doubt.seen, doubt.is);
}

/* -------- as wanted -------- */

/* By how much a contrast is missed; "= 1" is how one asks for as much as can be. */
static double optimize_contrast_missed_by(const struct operand *operand, double value)
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

const char *optimize_contrast_missed(const struct optimize_job *job)
{
    const struct operand *worst = NULL;
    double most = doubtful;
    for (size_t i = 0; i < job->merit.slot_count; i++) {
        const struct merit_slot *slot = &job->merit.slots[i];
        for (size_t k = 0; k < slot->count && is_contrast(slot->operand); k++) {
            const double by = optimize_contrast_missed_by(
                slot->operand, job->answer.after.values[slot->first + k]);
            /* more than a deviation is said of all goals alike */
            if (by > most && by <= slot->operand->deviation) {
                most = by;
                worst = slot->operand;
            }
        }
    }
    return worst == NULL
               ? NULL
               : arena_printf(job->run->arena, "the goal %s is missed by %.2g", worst->name, most);
}
