/* design/tolerance/tolerance_open.c - one lens made ready for trials of its tolerances. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_mtf.h"
#include "design/merit/merit_rays.h"
#include "design/tolerance/tolerance_trial.h"

#include <math.h>
#include <string.h>

/* -------- the image plane as a distance -------- */

/*
 * The image plane as a distance: of a lens with `focus paraxial` or `best` where that is in each
 * position, as the last thickness, a word where positions differ.
 */
static bool fix_image(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    const struct merit_question *view = &tolerance->question.view;
    const struct surface *as_read = &view->lens->surfaces[view->lens->surface_count - 1];
    tolerance->lens = view->lens;
    if (view->lens->focus == FOCUS_TABLE && as_read->has_thickness) {
        return true;
    }
    struct lens *lens = parameter_apply(view->lens, NULL, NULL, 0, arena);
    const size_t count = lens->position_count > 0 ? lens->position_count : 1;
    struct figure *values = ARENA_ARRAY(arena, count, struct figure);
    struct surface *last = &lens->surfaces[lens->surface_count - 1];
    tolerance->lens = lens;
    for (size_t p = 0; p < count; p++) {
        const struct setup_question asked = {.lens = view->lens,
                                             .position = p,
                                             .section = view->section,
                                             .wavelength = NAN,
                                             .wavelengths = WAVELENGTHS_ALL,
                                             .spectrum = view->wavelengths,
                                             .spectrum_count = view->wavelength_count,
                                             .fnumber = view->fnumber,
                                             .fields = view->fields,
                                             .field_count = view->field_count,
                                             .field_policy = FIELDS_ALL,
                                             .takes_telecentric = true};
        struct setup setup;
        if (!setup_open(&asked, arena, &setup, error) ||
            !setup_place_image(&setup, &(struct plane_value){.kind = PLANE_OF_LENS}, error)) {
            return false;
        }
        if (!isfinite(setup.image)) {
            return fail(error, ERROR_DOMAIN,
                        "the image is infinitely far away: nothing is in focus there");
        }
        values[p] = figure_number(pair_of(setup.image));
    }
    lens->focus = FOCUS_TABLE;
    last->has_thickness = true;
    last->thickness = values[0];
    if (count > 1) {
        struct lens_variable *words =
            ARENA_ARRAY(arena, lens->variable_count + 1, struct lens_variable);
        for (size_t i = 0; i < lens->variable_count; i++) {
            words[i] = lens->variables[i];
        }
        words[lens->variable_count] =
            (struct lens_variable){text_of("image_distance"), values, NULL};
        last->thickness.variable = lens->variable_count;
        lens->variables = words;
        lens->variable_count++;
    }
    return true;
}

/* -------- what is adjusted -------- */

static bool open_movers(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    struct tolerance_question *question = &tolerance->question;
    const struct lens *lens = tolerance->lens;
    const struct parameter last = {lens->surface_count - 1, PARAMETER_THICKNESS, 0};
    size_t parts = question->view.lens->position_count + 1, count = 0, at = 0;
    tolerance->movers = ARENA_ARRAY(arena, question->compensator_count + 1, struct compensator);
    /* the image plane and a gap `last` are one: the compensator counts, as it may have bounds */
    for (size_t i = 0; i < question->compensator_count; i++) {
        const struct compensator *one = &question->compensators[i];
        if (question->refocus == REFOCUS_BEST && one->part_count > 0 &&
            one->parts[0].what.surface == last.surface && one->parts[0].what.kind == last.kind) {
            question->refocus = REFOCUS_NONE;
        }
    }
    if (question->refocus == REFOCUS_BEST && !tolerance->closed) {
        /* the image plane, in every position */
        const bool is_word = lens->surfaces[last.surface].thickness.variable != LENS_NONE;
        const size_t cells = is_word ? lens->position_count : 1;
        struct compensator_part *images = ARENA_ARRAY(arena, cells, struct compensator_part);
        for (size_t p = 0; p < cells; p++) {
            images[p] = (struct compensator_part){last, is_word ? p : LENS_NONE, 1};
        }
        tolerance->movers[tolerance->mover_count++] =
            (struct compensator){images, cells, -INFINITY, INFINITY, "refocus"};
    }
    for (size_t i = 0; i < question->compensator_count; i++) {
        tolerance->movers[tolerance->mover_count++] = question->compensators[i];
        parts += question->compensators[i].part_count;
    }
    struct variable *list = ARENA_ARRAY(arena, parts, struct variable);
    tolerance->of_part = ARENA_ARRAY(arena, parts, size_t);
    for (size_t i = 0; i < tolerance->mover_count; i++) {
        const struct compensator *mover = &tolerance->movers[i];
        for (size_t k = 0; k < mover->part_count; k++) {
            const struct compensator_part *part = &mover->parts[k];
            size_t of = 0;
            while (of < count && (list[of].position != part->position ||
                                  !parameter_is_same(list[of].what, part->what))) {
                of++;
            }
            if (of == count) {
                list[count++] = (struct variable){.what = part->what,
                                                  .position = part->position,
                                                  .low = -INFINITY,
                                                  .high = INFINITY,
                                                  .name = mover->name};
            }
            tolerance->of_part[at++] = of;
        }
    }
    tolerance->numbers = ARENA_ARRAY(arena, count + 1, double);
    tolerance->base = ARENA_ARRAY(arena, count + 1, double);
    return variables_open(lens, list, count, arena, &tolerance->variables, error);
}

/* With height and slopes of surfaces that perturbations are of. */
static bool open_perturbed(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    const struct tolerance_question *question = &tolerance->question;
    const struct lens *lens = tolerance->lens;
    struct perturbed *perturbed = &tolerance->perturbed;
    const struct perturbed_question asked = {.lens = lens,
                                             .list = question->perturbations,
                                             .count = question->perturbation_count,
                                             .lenses = tolerance->variables.lenses};
    struct perturbed_forms forms;
    if (!perturbed_open(&asked, arena, perturbed, error)) {
        return false;
    }
    perturbed_keep(perturbed, (struct parameter){lens->surface_count - 1, PARAMETER_THICKNESS, 0});
    for (size_t i = 0; i < tolerance->variables.count; i++) {
        perturbed_keep(perturbed, tolerance->variables.list[i].what);
    }
    if (!perturbed_forms_of(lens, question->perturbations, question->perturbation_count, arena,
                            &forms, error)) {
        return false;
    }
    tolerance->irregularities = forms.list;
    tolerance->irregularity_count = forms.count;
    tolerance->irregular = forms.from;
    tolerance->irregular_amounts = ARENA_ARRAY(arena, forms.count + 1, double);
    return true;
}

/* -------- what is looked at -------- */

/* Does something that the lens may have decentre, tilt or bend its surfaces? */
static bool is_skew(const struct tolerance_question *question)
{
    bool is = false;
    for (size_t i = 0; i < question->perturbation_count; i++) {
        const struct perturbation *one = &question->perturbations[i];
        is = is || one->kind == TOLERANCE_ELEMENT_TILT || one->kind == TOLERANCE_ELEMENT_DECENTER ||
             one->kind == TOLERANCE_IRREGULARITY ||
             (one->what.kind >= PARAMETER_DECENTER_X && one->what.kind < PARAMETER_KINDS);
    }
    return is;
}

/* The merit of some operands, of the lens while it is adjusted. */
static bool open_merit(struct tolerance *tolerance, const struct operand *operands, size_t count,
                       struct arena *arena, struct merit *merit, struct error *error)
{
    struct merit_question view = tolerance->question.view;
    view.lens = tolerance->lens;
    view.variables = &tolerance->variables;
    view.variable_count = tolerance->variables.count;
    view.is_skew = is_skew(&tolerance->question);
    view.irregularities = tolerance->irregularities;
    view.irregularity_count = tolerance->irregularity_count;
    view.irregularity_amounts =
        tolerance->irregularity_count > 0 ? tolerance->irregular_amounts : NULL;
    view.operands = operands;
    view.operand_count = count;
    return merit_open(&view, arena, merit, error);
}

/* Spots or wave fronts, where they are the figures or what is adjusted for. */
static bool open_quality(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    const struct tolerance_question *asked = &tolerance->question;
    const enum criterion_kind kind = asked->criterion.kind;
    const bool is_focal = kind == CRITERION_EFL || kind == CRITERION_BFL;
    if (is_focal && asked->compensator_count == 0) {
        return true;
    }
    struct operand *operand = ARENA_NEW(arena, struct operand);
    *operand = tolerance_looks_at_waves(asked) ? operand_of(OPERAND_OPD, "wavefront")
                                               : operand_of(OPERAND_POLY, "spot");
    if (!open_merit(tolerance, operand, 1, arena, &tolerance->quality, error)) {
        return false;
    }
    const struct merit *merit = &tolerance->quality;
    size_t spots = 0;
    tolerance->residuals = ARENA_ARRAY(arena, merit->residual_count, double);
    tolerance->jacobian =
        ARENA_ARRAY(arena, merit->residual_count * merit->variable_count + 1, double);
    tolerance->lines = ARENA_ARRAY(arena, merit->slot_count, struct merit_lines *);
    for (size_t i = 0; i < merit->slot_count; i++) {
        spots += merit->slots[i].beams->bundle.wish.field_count;
        if (!tolerance_looks_at_waves(asked)) {
            tolerance->lines[i] = merit_lines_open(&merit->slots[i], arena);
        }
    }
    tolerance->spots = ARENA_ARRAY(arena, spots, struct merit_spot);
    return true;
}

static double field_distance(const struct setup_field *field)
{
    return field->point.kind == FIELD_NONE ? 0
                                           : hypot(field->point.value[0], field->point.value[1]);
}

/* What figures there are, once the positions are known; `merit` knows them. */
static bool list_figures(struct tolerance *tolerance, const struct merit *merit,
                         struct arena *arena, struct error *error)
{
    static const struct setup_field axis = {{.kind = FIELD_NONE}, 1};
    const enum criterion_kind kind = tolerance->question.criterion.kind;
    const struct criterion_type *type = criterion_type(kind);
    const bool has_axis = type->operand == OPERAND_KINDS || kind == CRITERION_MTF;
    size_t room = 0, spot = 0;
    for (size_t i = 0; i < merit->place_count; i++) {
        room += 2 * (merit->places[i].setup.field_count + 1);
    }
    struct tolerance_figure *figures = ARENA_ARRAY(arena, room, struct tolerance_figure);
    tolerance->figures = figures;
    for (size_t i = 0; i < merit->place_count; i++) {
        const struct setup *setup = &merit->places[i].setup;
        const size_t before = tolerance->figure_count;
        const size_t count = setup->field_count > 0 ? setup->field_count : 1;
        const struct setup_field *fields = setup->field_count > 0 ? setup->fields : &axis;
        size_t nearest = 0;
        for (size_t f = 0; f < count; f++) {
            const double distance = field_distance(&fields[f]);
            struct tolerance_figure figure = {i, &fields[f], spot + f, ORIENTATION_BOTH};
            nearest = distance < field_distance(&fields[nearest]) ? f : nearest;
            if (!type->of_fields || !(fields[f].weight > 0) || (!(distance > 0) && !has_axis)) {
                continue;
            }
            if (kind == CRITERION_MTF) {
                figure.orientation = ORIENTATION_TANGENTIAL;
                figures[tolerance->figure_count++] = figure;
                figure.orientation = ORIENTATION_SAGITTAL;
            }
            figures[tolerance->figure_count++] = figure;
        }
        if (!type->of_fields) {
            figures[tolerance->figure_count++] =
                (struct tolerance_figure){i, NULL, spot + nearest, ORIENTATION_BOTH};
        }
        if (tolerance->figure_count == before) {
            return fail(error, ERROR_DOMAIN, "%s is that of a field off the axis: there is none",
                        tolerance->question.criterion.name);
        }
        spot += count;
    }
    return true;
}

/* -------- operands that are the criterion -------- */

static bool open_judge(struct tolerance *tolerance, const struct merit *merit, struct arena *arena,
                       struct error *error)
{
    const struct criterion *criterion = &tolerance->question.criterion;
    const enum operand_kind kind = criterion_type(criterion->kind)->operand;
    const size_t count = tolerance->figure_count;
    const bool is_contrast = criterion->kind == CRITERION_MTF;
    if (kind == OPERAND_KINDS) {
        return true;
    }
    struct operand *operands = ARENA_ARRAY(arena, count, struct operand);
    for (size_t i = 0; i < count; i++) {
        const struct tolerance_figure *figure = &tolerance->figures[i];
        operands[i] = operand_of(kind, criterion->name);
        operands[i].target = criterion->kind == CRITERION_EFL || is_contrast;
        operands[i].field = figure->field;
        operands[i].position = merit->places[figure->place].position;
        operands[i].frequency = criterion->frequency;
    }
    if (is_contrast) { /* all of them in one look, in this order */
        operands[0].field = NULL;
        operands[0].position = LENS_NONE;
    }
    if (!open_merit(tolerance, operands, is_contrast ? 1 : count, arena, &tolerance->judge,
                    error)) {
        return false;
    }
    tolerance->judged = ARENA_ARRAY(arena, tolerance->judge.residual_count, double);
    return true;
}

/* -------- the nominal lens -------- */

static bool settle_rays(struct tolerance *tolerance, struct merit *merit, double *residuals,
                        struct error *error)
{
    if (!merit_evaluate(merit, tolerance->numbers, residuals, NULL)) {
        *error = merit->why;
        return false;
    }
    for (size_t i = 0; i < merit->slot_count; i++) {
        merit_beams_settle(merit->slots[i].beams, !tolerance->question.aims);
        if (tolerance->irregularity_count > 0 &&
            !merit_beams_deform(merit->slots[i].beams, error)) {
            return false;
        }
    }
    return true;
}

/* Rays are aimed at the stop of the nominal lens, whatever is adjusted in it; contrasts are those
   of rays that stay, as spots are. */
static bool aim_nominal(struct tolerance *tolerance, struct arena *arena, struct error *error)
{
    variables_get(&tolerance->variables, tolerance->numbers);
    return tolerance->quality.slot_count == 0 ||
           (settle_rays(tolerance, &tolerance->quality, tolerance->residuals, error) &&
            (tolerance->question.criterion.kind != CRITERION_MTF ||
             settle_rays(tolerance, &tolerance->judge, tolerance->judged, error)) &&
            tolerance_check_movers(tolerance, arena, error));
}

bool tolerance_open(const struct tolerance_question *question, struct arena *arena,
                    struct tolerance *tolerance, struct error *error)
{
    struct merit places;
    const struct merit *view = &tolerance->quality;
    *tolerance = (struct tolerance){.question = *question, .within = arena_within(arena)};
    tolerance->closed = question->compensator_count == 0 && !tolerance_looks_at_waves(question);
    if (question->refocus == REFOCUS_PARAXIAL && question->compensator_count > 0) {
        return fail(error, ERROR_DOMAIN,
                    "a paraxial refocus takes no notice of what is adjusted beside it");
    }
    if (!fix_image(tolerance, arena, error) || !open_movers(tolerance, arena, error) ||
        !open_perturbed(tolerance, arena, error) || !open_quality(tolerance, arena, error)) {
        return false;
    }
    if (tolerance->quality.slot_count == 0) {
        /* the positions alone, as nothing else has looked at them: by their focal length */
        struct operand *efl = ARENA_NEW(arena, struct operand);
        *efl = operand_of(OPERAND_EFL, "efl");
        efl->target = 1;
        if (!open_merit(tolerance, efl, 1, arena, &places, error)) {
            return false;
        }
        view = &places;
    }
    if (!list_figures(tolerance, view, arena, error) ||
        !open_judge(tolerance, view, arena, error) || !aim_nominal(tolerance, arena, error)) {
        return false;
    }
    const size_t count = tolerance->figure_count;
    double *none = ARENA_ARRAY(arena, tolerance->question.perturbation_count + 1, double);
    tolerance->rest = arena_array(arena, count, sizeof *tolerance->rest);
    tolerance->nominal = ARENA_ARRAY(arena, count, double);
    tolerance->nominal_moves = ARENA_ARRAY(arena, tolerance_moves(tolerance), double);
    struct tolerance_trial trial = {.figures = tolerance->nominal,
                                    .moves = tolerance->nominal_moves};
    if (!tolerance_trial(tolerance, none, &trial)) {
        *error = trial.why;
        return error_prefix(error, "the nominal lens: ");
    }
    for (size_t i = 0; i < count && tolerance->question.criterion.kind == CRITERION_BORESIGHT;
         i++) {
        const struct merit_spot *spot = &tolerance->spots[tolerance->figures[i].spot];
        const double s = tolerance->closed ? trial.moves[0] : 0;
        for (int k = 0; k < 2; k++) {
            tolerance->rest[i][k] = spot->centroid[k] + s * spot->drift[k];
        }
        tolerance->nominal[i] = 0;
    }
    return true;
}
