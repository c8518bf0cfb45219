/* design/merit/expression.h - a goal that is arithmetic of figures and numbers of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_EXPRESSION_H
#define LENSCALC_DESIGN_MERIT_EXPRESSION_H

#include "design/merit/merit_state.h"

enum expression_operation {
    EXPRESSION_NUMBER,
    EXPRESSION_TERM,
    EXPRESSION_ADD,
    EXPRESSION_SUBTRACT,
    EXPRESSION_MULTIPLY,
    EXPRESSION_DIVIDE,
    EXPRESSION_NEGATE
};

/* In postfix order: of numbers and terms that were put on a stack. */
struct expression_step {
    enum expression_operation operation;
    double number; /* in mm, rad, g */
    size_t term;
};

struct expression {
    const struct operand *terms; /* is_term is set */
    size_t term_count;
    const struct expression_step *steps;
    size_t step_count;
    size_t depth; /* of the stack, at most */
    struct operand_unit unit;
};

/* How deep a stack the steps need. */
size_t expression_depth(const struct expression_step *steps, size_t count);

/* Does it look at other positions alone than the one it is evaluated in? */
bool expression_is_fixed(const struct expression *expression);

/* The position that all its terms are of; LENS_NONE: they differ, or some are of each. */
size_t expression_position(const struct expression *expression);

/*
 * The value of an expression, and its gradient.
 *
 * Formula   by forward propagation: rows of derivatives by all variables are added, subtracted,
 *           scaled by the values of products and quotients. Terms with as many figures as there are
 *           surfaces or orientations give as many residuals; those with one go with each of them
 * Source    derived here: the rules of differentiation
 * Errors    of merit_prepare_expression: as the terms; terms with different numbers of figures
 */
merit_fill merit_fill_expression;
merit_prepare merit_prepare_expression;

/* Slots of the terms of a goal that is an expression, of another its own; count of them. */
const struct merit_slot *expression_slots(const struct merit_slot *slot, size_t *count);

/* After all slots are there: values of terms lie behind those of all residuals. */
void expression_slots_shift(struct merit_slot *slot, size_t by);

/* A number of the lens as it stands in its prescription, of a position. */
merit_fill merit_fill_number;

#endif
