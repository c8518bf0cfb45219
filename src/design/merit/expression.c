/* design/merit/expression.c - a goal that is arithmetic of figures and numbers of a lens. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/expression.h"

#include "optics/parameter.h"

#include <string.h>

/* -------- what it is of -------- */

size_t expression_depth(const struct expression_step *steps, size_t count)
{
    size_t depth = 0, most = 0;
    for (size_t i = 0; i < count; i++) {
        const enum expression_operation operation = steps[i].operation;
        depth += operation <= EXPRESSION_TERM ? 1 : 0;
        depth -= operation >= EXPRESSION_ADD && operation <= EXPRESSION_DIVIDE ? 1 : 0;
        most = depth > most ? depth : most;
    }
    return most;
}

bool expression_is_fixed(const struct expression *expression)
{
    bool is_fixed = true;
    for (size_t i = 0; i < expression->term_count; i++) {
        is_fixed = is_fixed && expression->terms[i].position != LENS_NONE;
    }
    return is_fixed;
}

size_t expression_position(const struct expression *expression)
{
    const size_t position = expression->terms[0].position;
    bool is_one = true;
    for (size_t i = 1; i < expression->term_count; i++) {
        is_one = is_one && expression->terms[i].position == position;
    }
    return is_one ? position : LENS_NONE;
}

/* -------- numbers of the prescription -------- */

bool merit_fill_number(struct merit *merit, const struct merit_slot *slot, double *residuals,
                       double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct parameter what = slot->operand->parameter;
    const double value = parameter_get(place->lens, what);
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] =
            (struct dual){value, merit->derives ? variables_slope(merit->question.variables,
                                                                  place->position, j, what)
                                                : 0};
    }
    return merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- evaluating -------- */

/* A value and its row of derivatives. */
struct expression_value {
    double value, *row;
};

/* What an expression keeps. */
struct expression_terms {
    struct merit_slot *slots; /* one a term */
    double **residuals;       /* of each, as many as it has */
    double **jacobians;
    struct expression_value *stack;
};

/* The term's figure of a residual; with one it goes with each. */
static size_t figure_at(const struct merit_slot *term, size_t at)
{
    return term->count > 1 ? at : 0;
}

/* left OP right into left; of a negation right is not looked at. */
static void expression_combine(enum expression_operation operation, struct expression_value *left,
                               const struct expression_value *right, size_t columns)
{
    const double a = left->value, b = right->value;
    double by_left = 1, by_right = 0;
    switch (operation) {
    case EXPRESSION_ADD:
        left->value = a + b;
        by_right = 1;
        break;
    case EXPRESSION_SUBTRACT:
        left->value = a - b;
        by_right = -1;
        break;
    case EXPRESSION_MULTIPLY:
        left->value = a * b;
        by_left = b;
        by_right = a;
        break;
    case EXPRESSION_DIVIDE:
        left->value = a / b;
        by_left = 1 / b;
        by_right = -left->value / b;
        break;
    default:
        left->value = -a;
        by_left = -1;
        break;
    }
    for (size_t j = 0; j < columns; j++) {
        left->row[j] = by_left * left->row[j] + (by_right != 0 ? by_right * right->row[j] : 0);
    }
}

/* One residual, into merit->change. */
static void expression_evaluate(struct merit *merit, const struct merit_slot *slot, size_t at)
{
    const struct expression *expression = slot->operand->expression;
    const struct expression_terms *terms = slot->own;
    const size_t columns = merit->derives ? merit->variable_count : 0;
    struct expression_value *top = terms->stack - 1;
    for (size_t i = 0; i < expression->step_count; i++) {
        const struct expression_step *step = &expression->steps[i];
        if (step->operation == EXPRESSION_NUMBER) {
            (++top)->value = step->number;
            memset(top->row, 0, columns * sizeof(double));
        } else if (step->operation == EXPRESSION_TERM) {
            const size_t figure = figure_at(&terms->slots[step->term], at);
            (++top)->value = terms->residuals[step->term][figure];
            memcpy(top->row, terms->jacobians[step->term] + figure * columns,
                   columns * sizeof(double));
        } else if (step->operation == EXPRESSION_NEGATE) {
            expression_combine(step->operation, top, top, columns);
        } else {
            top--;
            expression_combine(step->operation, top, top + 1, columns);
        }
    }
    merit->change[0] = dual_of(top->value);
    for (size_t j = 0; j < columns; j++) {
        merit->change[j] = (struct dual){top->value, top->row[j]};
    }
}

bool merit_fill_expression(struct merit *merit, const struct merit_slot *slot, double *residuals,
                           double *jacobian)
{
    const struct expression *expression = slot->operand->expression;
    const struct expression_terms *terms = slot->own;
    for (size_t i = 0; i < expression->term_count; i++) {
        const struct merit_slot *term = &terms->slots[i];
        double *rows = jacobian != NULL ? terms->jacobians[i] : (double *)NULL;
        if (rows != NULL) {
            memset(rows, 0, term->count * merit->variable_count * sizeof(double));
        }
        if (!merit->kinds[term->operand->kind].fill(merit, term, terms->residuals[i], rows)) {
            return false;
        }
    }
    for (size_t at = 0; at < slot->count; at++) {
        expression_evaluate(merit, slot, at);
        if (!merit_put(merit, slot, at, residuals, jacobian)) {
            return false;
        }
    }
    return true;
}

/* -------- making ready -------- */

/* The place of a term: its own, or that of the expression. */
static size_t place_of_term(const struct merit *merit, const struct operand *term, size_t usual)
{
    size_t at = 0;
    while (at < merit->place_count && merit->places[at].position != term->position) {
        at++;
    }
    return term->position == LENS_NONE ? usual : at;
}

size_t merit_prepare_expression(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                                struct error *error)
{
    const struct expression *expression = slot->operand->expression;
    struct expression_terms *terms = ARENA_NEW(arena, struct expression_terms);
    const size_t count = expression->term_count, columns = merit->variable_count + 1;
    size_t most = 1;
    terms->slots = ARENA_ARRAY(arena, count, struct merit_slot);
    terms->residuals = ARENA_ARRAY(arena, count, double *);
    terms->jacobians = ARENA_ARRAY(arena, count, double *);
    terms->stack = ARENA_ARRAY(arena, expression->depth, struct expression_value);
    for (size_t i = 0; i < expression->depth; i++) {
        terms->stack[i].row = ARENA_ARRAY(arena, columns, double);
    }
    for (size_t i = 0; i < count; i++) {
        const struct operand *operand = &expression->terms[i];
        const struct merit_kind *kind = &merit->kinds[operand->kind];
        struct merit_slot *term = &terms->slots[i];
        *term = (struct merit_slot){
            operand, place_of_term(merit, operand, slot->place), merit->term_count, 1, NULL, NULL};
        if (kind->prepare != NULL) {
            term->count = kind->prepare(merit, term, arena, error);
        }
        if (term->count == 0) {
            error_prefix(error, "%s: ", operand->name);
            return 0;
        }
        if (term->count > 1 && most > 1 && term->count != most) {
            fail(error, ERROR_DOMAIN, "%s has %zu values, what stands before it %zu: name surfaces",
                 operand->name, term->count, most);
            return 0;
        }
        most = term->count > most ? term->count : most;
        terms->residuals[i] = ARENA_ARRAY(arena, term->count, double);
        terms->jacobians[i] = ARENA_ARRAY(arena, term->count * columns, double);
        merit->term_count += term->count;
    }
    slot->own = terms;
    return most;
}

const struct merit_slot *expression_slots(const struct merit_slot *slot, size_t *count)
{
    const bool is_expression = slot->operand->kind == OPERAND_EXPRESSION;
    const struct expression_terms *terms = is_expression ? slot->own : NULL;
    *count = is_expression ? slot->operand->expression->term_count : 1;
    return is_expression ? terms->slots : slot;
}

void expression_slots_shift(struct merit_slot *slot, size_t by)
{
    struct expression_terms *terms = slot->own;
    for (size_t i = 0; i < slot->operand->expression->term_count; i++) {
        terms->slots[i].first += by;
    }
}
