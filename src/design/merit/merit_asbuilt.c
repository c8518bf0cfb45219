/* design/merit/merit_asbuilt.c - spots of lenses as they are made: the nominal one, and errors. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"

#include "design/merit/merit_rays.h"
#include "design/merit/merit_state.h"
#include "design/tolerance/perturbed.h"

#include <math.h>
#include <string.h>

/* What a slot keeps. */
struct merit_asbuilt {
    void *rays; /* of merit_fill_rays */
    size_t ray_count;
    const struct perturbations *errors;
    struct perturbed perturbed;   /* of this position alone */
    struct perturbed_link *links; /* of one perturbation */
    struct merit_by by;           /* the image plane, then the perturbations */
    struct merit inner;           /* `poly` by them: columns of irregularities last */
    struct merit_slot slot;       /* its only one */
    struct operand operand;
    size_t position;
    size_t *columns; /* of each perturbation */
    double *sigmas;  /* in units of its column */
    double *residuals, *jacobian;
    double *numbers;          /* a little beside those of the variables */
    double *here, *up, *down; /* one a perturbation */
};

/* -------- what rays are derived by -------- */

/* dn/dnd, or dn/dVd, of a melt (optics/medium.h). */
static double medium_slope(const struct lens *lens, struct parameter what, double wavelength)
{
    const struct medium *medium =
        what.surface == LENS_NONE ? &lens->object_medium : &lens->surfaces[what.surface].medium;
    struct melt melt;
    struct pair n;
    struct error ignored;
    melt_open(medium, &melt);
    if (!melt.has_abbe) {
        return what.kind == PARAMETER_INDEX ? 1 : 0;
    }
    if (!medium_index(medium, wavelength, &n, &ignored)) {
        return NAN;
    }
    const double dispersed = n.hi - melt.nd;
    return what.kind == PARAMETER_INDEX ? 1 + dispersed / (melt.nd - 1) : -dispersed / melt.Vd;
}

static size_t find_links(void *context, size_t position, double wavelength,
                         struct variable_link *links)
{
    struct merit_asbuilt *asbuilt = context;
    const struct lens *lens = &asbuilt->perturbed.lenses[0].lens;
    const struct parameter image = {.surface = lens->surface_count - 1,
                                    .kind = PARAMETER_THICKNESS};
    size_t count = 0;
    (void)position; /* there is one only */
    links[count++] = (struct variable_link){0, image, 1};
    for (size_t i = 0; i < asbuilt->errors->count; i++) {
        const size_t parts = perturbed_links(&asbuilt->perturbed, i, asbuilt->links);
        for (size_t k = 0; k < parts; k++) {
            const size_t column = i + 1;
            const struct perturbed_link *from = &asbuilt->links[k];
            const enum parameter_kind kind = from->what.kind;
            struct variable_link link = {column, from->what, from->slope};
            if (kind == PARAMETER_INDEX || kind == PARAMETER_ABBE) {
                link.slope *= medium_slope(lens, from->what, wavelength);
                link.basis.kind = PARAMETER_INDEX;
            } else {
                link.slope *= parameter_slope(lens, from->what, wavelength);
                link.basis.kind = parameter_type(kind)->basis;
            }
            if (link.basis.kind == PARAMETER_INDEX) {
                count = variable_index_links(lens, link, count, count, links);
            } else {
                links[count++] = link;
            }
        }
    }
    return count;
}

/* -------- opening -------- */

static bool open_errors(const struct merit *merit, struct merit_asbuilt *asbuilt,
                        struct arena *arena, struct error *error)
{
    const struct merit_question *question = &merit->question;
    const struct perturbations *errors = asbuilt->errors = question->errors;
    if (errors == NULL || errors->count == 0) {
        return fail(error, ERROR_DOMAIN, "nothing is known of how well the lens is made");
    }
    const size_t surfaces = question->lens->surface_count;
    const struct perturbed_question asked = {.lens = question->lens,
                                             .list = errors->list,
                                             .count = errors->count,
                                             .lenses =
                                                 question->variables->lenses + asbuilt->position};
    asbuilt->links = ARENA_ARRAY(arena, 2 * surfaces + 1, struct perturbed_link);
    asbuilt->by = (struct merit_by){1 + 2 * surfaces * errors->count, find_links, asbuilt};
    return perturbed_open(&asked, arena, &asbuilt->perturbed, error);
}

/* `poly` of this position, by the errors. */
static bool open_inner(const struct merit *merit, const struct merit_slot *slot,
                       struct merit_asbuilt *asbuilt, struct arena *arena, struct error *error)
{
    struct merit_question question = merit->question;
    const struct perturbations *errors = asbuilt->errors;
    struct perturbed_forms forms;
    if (!perturbed_forms_of(question.lens, errors->list, errors->count, arena, &forms, error)) {
        return false;
    }
    asbuilt->operand = *slot->operand;
    asbuilt->operand.kind = OPERAND_POLY;
    question.by = &asbuilt->by;
    question.variable_count = 1 + errors->count;
    question.irregularities = forms.list;
    question.irregularity_count = forms.count;
    question.operands = &asbuilt->operand;
    question.operand_count = 1;
    question.positions = &asbuilt->position;
    question.position_count = 1;
    question.errors = NULL;
    struct merit *inner = &asbuilt->inner;
    merit_begin(inner, &question, arena);
    asbuilt->slot = (struct merit_slot){.operand = &asbuilt->operand};
    if (!merit_places_open(inner, arena, error)) {
        return false;
    }
    asbuilt->slot.count = merit_prepare_rays(inner, &asbuilt->slot, arena, error);
    if (asbuilt->slot.count == 0) {
        return false;
    }
    inner->residual_count = asbuilt->slot.count;
    inner->values = ARENA_ARRAY(arena, inner->residual_count, double);
    asbuilt->columns = ARENA_ARRAY(arena, errors->count, size_t);
    asbuilt->sigmas = ARENA_ARRAY(arena, errors->count, double);
    for (size_t i = 0; i < errors->count; i++) {
        asbuilt->columns[i] = 1 + i;
        asbuilt->sigmas[i] = sqrt(perturbation_moments(&errors->list[i]).second);
    }
    for (size_t k = 0; k < forms.count; k++) {
        const size_t i = forms.from[k];
        asbuilt->columns[i] = question.variable_count + k;
        asbuilt->sigmas[i] *= errors->list[i].amount * TOLERANCE_WAVE_MM;
    }
    return true;
}

size_t merit_prepare_asbuilt(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                             struct error *error)
{
    struct merit_asbuilt *asbuilt = ARENA_NEW(arena, struct merit_asbuilt);
    asbuilt->ray_count = merit_prepare_rays(merit, slot, arena, error);
    asbuilt->rays = slot->own;
    asbuilt->position = merit->places[slot->place].position;
    slot->own = asbuilt;
    if (asbuilt->ray_count == 0 || !open_errors(merit, asbuilt, arena, error) ||
        !open_inner(merit, slot, asbuilt, arena, error)) {
        return 0;
    }
    const struct merit *inner = &asbuilt->inner;
    const size_t errors = asbuilt->errors->count;
    asbuilt->residuals = ARENA_ARRAY(arena, inner->residual_count, double);
    asbuilt->jacobian = ARENA_ARRAY(arena, inner->residual_count * inner->variable_count, double);
    asbuilt->numbers = ARENA_ARRAY(arena, merit->question.variable_count + 1, double);
    asbuilt->here = ARENA_ARRAY(arena, errors, double);
    asbuilt->up = ARENA_ARRAY(arena, errors, double);
    asbuilt->down = ARENA_ARRAY(arena, errors, double);
    return asbuilt->ray_count + asbuilt->errors->count;
}

/* -------- filling -------- */

static double merit_asbuilt_product(const struct merit_asbuilt *asbuilt, size_t one, size_t other)
{
    const size_t n = asbuilt->inner.variable_count;
    double sum = 0;
    for (size_t i = 0; i < asbuilt->inner.residual_count; i++) {
        sum += asbuilt->jacobian[i * n + one] * asbuilt->jacobian[i * n + other];
    }
    return sum;
}

/* What each error does, of the lens with these numbers. */
static bool find_errors(struct merit_asbuilt *asbuilt, const double *numbers, double *found)
{
    struct merit *inner = &asbuilt->inner;
    merit_put_lens(inner, numbers, true);
    if (!merit_fill_rays(inner, &asbuilt->slot, asbuilt->residuals, asbuilt->jacobian)) {
        return false;
    }
    const double focus = merit_asbuilt_product(asbuilt, 0, 0);
    for (size_t j = 0; j < asbuilt->errors->count; j++) {
        const size_t column = asbuilt->columns[j];
        const double share = focus > 0 ? merit_asbuilt_product(asbuilt, column, 0) / focus : 0;
        /* what is left of a column when the image plane has been moved to where it is least */
        const size_t n = asbuilt->inner.variable_count;
        double sum = 0;
        for (size_t i = 0; i < asbuilt->inner.residual_count; i++) {
            const double *row = asbuilt->jacobian + i * n;
            const double left = row[column] - share * row[0];
            sum += left * left;
        }
        found[j] = asbuilt->sigmas[j] * sqrt(sum);
        if (!isfinite(found[j])) {
            return fail(&inner->why, ERROR_DOMAIN, "what %s does is not finite",
                        asbuilt->errors->list[j].name);
        }
    }
    return true;
}

/* Rows of the errors; the lens is left with other numbers. */
static bool fill_errors(struct merit *merit, struct merit_asbuilt *asbuilt, double *residuals,
                        double *jacobian)
{
    static const double little = 1e-4; /* of natural scales */
    const struct variables *variables = merit->question.variables;
    const size_t n = merit->variable_count, count = asbuilt->errors->count;
    memcpy(asbuilt->numbers, merit->parameters, variables->count * sizeof(double));
    asbuilt->inner.question.variables = merit->question.variables;
    asbuilt->perturbed.lenses = variables->lenses + asbuilt->position;
    asbuilt->inner.forgets = merit->forgets;
    if (!find_errors(asbuilt, merit->parameters, asbuilt->here)) {
        return false;
    }
    memcpy(residuals, asbuilt->here, count * sizeof *residuals);
    for (size_t k = 0; jacobian != NULL && k < variables->count; k++) {
        /* derivatives by one variable: differences of both sides, or of that which has a value */
        const double step = little * variables->scale[k];
        double *up = asbuilt->up, *down = asbuilt->down, *at = &asbuilt->numbers[k];
        const double now = merit->parameters[k], high = now + step, low = now - step;
        *at = high;
        const bool has_up = find_errors(asbuilt, asbuilt->numbers, up);
        *at = low;
        const bool has_down = find_errors(asbuilt, asbuilt->numbers, down);
        *at = now;
        const double *from = has_down ? down : asbuilt->here, *to = has_up ? up : asbuilt->here;
        const double between = (has_up ? high : now) - (has_down ? low : now);
        for (size_t j = 0; j < asbuilt->errors->count; j++) {
            up[j] = between > 0 ? (to[j] - from[j]) / between : 0;
        }
        if (!has_up && !has_down) {
            return false;
        }
        for (size_t j = 0; j < count; j++) {
            jacobian[j * n + k] = asbuilt->here[j] > 0 ? asbuilt->up[j] : 0;
        }
    }
    return true;
}

bool merit_fill_asbuilt(struct merit *merit, const struct merit_slot *slot, double *residuals,
                        double *jacobian)
{
    struct merit_asbuilt *asbuilt = slot->own;
    const size_t rays = asbuilt->ray_count, n = merit->variable_count;
    struct merit_slot nominal = *slot;
    nominal.own = asbuilt->rays;
    nominal.count = rays;
    if (!merit_fill_rays(merit, &nominal, residuals, jacobian)) {
        return false;
    }
    const bool found = fill_errors(merit, asbuilt, residuals + rays,
                                   jacobian != NULL ? jacobian + rays * n : NULL);
    variables_put(merit->question.variables, merit->parameters, asbuilt->position);
    if (!found) {
        merit->why = asbuilt->inner.why;
        return false;
    }
    memcpy(merit->values + slot->first + rays, residuals + rays,
           asbuilt->errors->count * sizeof *residuals);
    return true;
}
