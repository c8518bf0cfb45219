/* design/merit/merit.c - operands of a lens with variables, as residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit.h"

#include "design/merit/expression.h"
#include "design/merit/merit_graze.h"
#include "design/merit/merit_kinds.h"
#include "design/merit/merit_mtf.h"
#include "design/merit/merit_paraxial.h"
#include "design/merit/merit_rays.h"
#include "design/merit/merit_rim.h"
#include "design/solver/solver_loss.h"

#include <math.h>
#include <string.h>

static const struct merit_kind kinds[OPERAND_KINDS] = {
    [OPERAND_EFL] = {merit_fill_power, merit_prepare_power},
    [OPERAND_PETZVAL] = {merit_fill_power, merit_prepare_power},
    [OPERAND_BFL] = {merit_fill_first, merit_prepare_first},
    [OPERAND_FFL] = {merit_fill_first, merit_prepare_first},
    [OPERAND_LENGTH] = {merit_fill_first, merit_prepare_first},
    [OPERAND_TRACK] = {merit_fill_plane, merit_prepare_plane},
    [OPERAND_FOCUS] = {merit_fill_plane, merit_prepare_plane},
    [OPERAND_POWER] = {merit_fill_group, NULL},
    [OPERAND_MAGNIFICATION] = {merit_fill_first, merit_prepare_first},
    [OPERAND_FNUMBER] = {merit_fill_first, merit_prepare_first},
    [OPERAND_AXIAL] = {merit_fill_axial, merit_prepare_axial},
    [OPERAND_S1] = {merit_fill_seidel, merit_prepare_seidel},
    [OPERAND_S2] = {merit_fill_seidel, merit_prepare_seidel},
    [OPERAND_S3] = {merit_fill_seidel, merit_prepare_seidel},
    [OPERAND_S4] = {merit_fill_seidel, merit_prepare_seidel},
    [OPERAND_S5] = {merit_fill_seidel, merit_prepare_seidel},
    [OPERAND_HEIGHT] = {merit_fill_chief, merit_prepare_chief},
    [OPERAND_DISTORTION] = {merit_fill_chief, merit_prepare_chief},
    [OPERAND_LATERAL] = {merit_fill_chief, merit_prepare_chief},
    [OPERAND_TELECENTRIC] = {merit_fill_chief, merit_prepare_chief},
    [OPERAND_INCIDENCE] = {merit_fill_incidence, merit_prepare_incidence},
    [OPERAND_EDGE] = {merit_fill_shape, merit_prepare_shape},
    [OPERAND_CENTER] = {merit_fill_shape, merit_prepare_shape},
    [OPERAND_AIR] = {merit_fill_shape, merit_prepare_shape},
    [OPERAND_SAG] = {merit_fill_surface, merit_prepare_surface},
    [OPERAND_SLOPE] = {merit_fill_surface, merit_prepare_surface},
    [OPERAND_RATIO] = {merit_fill_surface, merit_prepare_surface},
    [OPERAND_ASPECT] = {merit_fill_element, merit_prepare_element},
    [OPERAND_WEIGHT] = {merit_fill_element, merit_prepare_element},
    [OPERAND_COST] = {merit_fill_element, merit_prepare_element},
    [OPERAND_SPOT] = {merit_fill_rays, merit_prepare_rays},
    [OPERAND_POLY] = {merit_fill_rays, merit_prepare_rays},
    [OPERAND_ASBUILT] = {merit_fill_asbuilt, merit_prepare_asbuilt},
    [OPERAND_OPD] = {merit_fill_rays, merit_prepare_rays},
    [OPERAND_GRAZING] = {merit_fill_graze, merit_prepare_graze},
    [OPERAND_MTF] = {merit_fill_mtf, merit_prepare_mtf},
    [OPERAND_GMTF] = {merit_fill_mtf, merit_prepare_mtf},
    [OPERAND_NUMBER] = {merit_fill_number, NULL},
    [OPERAND_EXPRESSION] = {merit_fill_expression, merit_prepare_expression},
};

/* -------- opening -------- */

static bool has_position(const struct merit *merit, size_t position)
{
    bool found = position == LENS_NONE;
    for (size_t i = 0; i < merit->place_count; i++) {
        found = found || merit->places[i].position == position;
    }
    return found;
}

/* Is an operand evaluated there? Of an expression of named positions alone that is one of them. */
static bool operand_is_at(const struct merit *merit, const struct operand *operand, size_t place)
{
    size_t count;
    const struct operand *terms = operand_terms(operand, &count);
    bool is_there = true;
    for (size_t i = 0; i < count; i++) {
        is_there = is_there && has_position(merit, terms[i].position);
    }
    const size_t position =
        operand->kind == OPERAND_EXPRESSION && expression_is_fixed(operand->expression)
            ? terms[0].position
            : operand->position;
    return is_there && (position == LENS_NONE || position == merit->places[place].position);
}

/* One operand in the positions that it is of. */
static bool add_slots(struct merit *merit, const struct operand *operand, struct arena *arena,
                      struct error *error)
{
    const struct merit_kind *kind = &kinds[operand->kind];
    for (size_t i = 0; i < merit->place_count; i++) {
        if (!operand_is_at(merit, operand, i)) {
            continue;
        }
        struct merit_slot *slot = &merit->slots[merit->slot_count];
        *slot = (struct merit_slot){operand, i, merit->residual_count, 1, NULL, NULL};
        if (kind->prepare != NULL) {
            slot->count = kind->prepare(merit, slot, arena, error);
        }
        if (slot->count == 0) {
            error_prefix(error, "goal %s: ", operand->name);
            return operand->place.source != NULL &&
                   error_locate(error, operand->place.source, operand->place.line,
                                operand->place.column);
        }
        merit->slot_count++;
        merit->residual_count += slot->count;
        merit->exact_count += operand->relation == OPERAND_EXACT ? slot->count : 0;
    }
    return true;
}

static bool open_slots(struct merit *merit, struct arena *arena, struct error *error)
{
    const struct merit_question *question = &merit->question;
    merit->slots =
        ARENA_ARRAY(arena, question->operand_count * merit->place_count, struct merit_slot);
    for (int exact = 0; exact < 2; exact++) {
        for (size_t i = 0; i < question->operand_count; i++) {
            const struct operand *operand = &question->operands[i];
            if ((operand->relation == OPERAND_EXACT) == (exact == 1) &&
                !add_slots(merit, operand, arena, error)) {
                return false;
            }
        }
    }
    return merit->slot_count > 0 || fail(error, ERROR_DOMAIN, "nothing is wanted: no goals");
}

bool merit_open(const struct merit_question *question, struct arena *arena, struct merit *merit,
                struct error *error)
{
    merit_begin(merit, question, arena);
    merit->kinds = kinds;
    if (!merit_places_open(merit, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < merit->place_count; i++) {
        if (!merit_rim_open(merit, i, arena, error)) {
            return false;
        }
    }
    if (!open_slots(merit, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < merit->slot_count; i++) {
        if (merit->slots[i].operand->kind == OPERAND_EXPRESSION) {
            expression_slots_shift(&merit->slots[i], merit->residual_count);
        }
    }
    merit->values = ARENA_ARRAY(arena, merit_value_count(merit), double);
    /* which residuals are those of '<' and '>' */
    static const enum solver_side sides[OPERAND_RELATIONS] = {
        [OPERAND_BELOW] = SIDE_ABOVE, [OPERAND_ABOVE] = SIDE_BELOW};
    merit->sides = ARENA_ARRAY(arena, merit->residual_count, enum solver_side);
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        for (size_t k = 0; k < slot->count; k++) {
            merit->sides[slot->first + k] = sides[slot->operand->relation];
        }
    }
    merit->change = ARENA_ARRAY(arena, merit->variable_count + 1, struct dual);
    return true;
}

/* -------- evaluating -------- */

/* Those that look at the rays of all others come last. */
static bool fill_slots(struct merit *merit, bool last, double *residuals, double *jacobian)
{
    for (size_t i = 0; i < merit->slot_count; i++) {
        const struct merit_slot *slot = &merit->slots[i];
        double *rows =
            jacobian != NULL ? jacobian + slot->first * merit->variable_count : (double *)NULL;
        if ((slot->operand->kind == OPERAND_GRAZING) == last &&
            !kinds[slot->operand->kind].fill(merit, slot, residuals + slot->first, rows)) {
            return false;
        }
    }
    return true;
}

bool merit_measure(void *context, const double *parameters, double *residuals, double *jacobian)
{
    struct merit *merit = context;
    merit_put_lens(merit, parameters, jacobian != NULL);
    for (size_t i = 0; i < merit->place_count; i++) {
        if (merit->places[i].rim != NULL) {
            merit_rim_find(merit, i);
        }
    }
    if (jacobian != NULL) {
        memset(jacobian, 0, merit->residual_count * merit->variable_count * sizeof(double));
    }
    return fill_slots(merit, false, residuals, jacobian) &&
           fill_slots(merit, true, residuals, jacobian);
}

void merit_drop_met(const struct merit *merit, double *residuals, double *jacobian)
{
    const size_t n = merit->variable_count;
    for (size_t i = 0; i < merit->residual_count; i++) {
        if (merit->sides[i] != SIDE_BOTH && solver_counted(merit->sides, i, residuals[i]) == 0) {
            residuals[i] = 0;
            if (jacobian != NULL) {
                memset(jacobian + i * n, 0, n * sizeof *jacobian);
            }
        }
    }
}

bool merit_evaluate(void *context, const double *parameters, double *residuals, double *jacobian)
{
    const bool has_value = merit_measure(context, parameters, residuals, jacobian);
    if (has_value) {
        merit_drop_met(context, residuals, jacobian);
    }
    return has_value;
}
