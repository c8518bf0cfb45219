/* cli/options/goal_parser.h - a goal while it is read: figures, and arithmetic of them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_GOAL_PARSER_H
#define LENSCALC_CLI_OPTIONS_GOAL_PARSER_H

#include "cli/options/goals.h"

/* One goal in the making, or a term of one. */
struct goal_parser {
    const struct goals_reader *reader;
    struct text item; /* all of it */
    const struct operand_type *type;
    struct operand *operand;
    bool has_target;
};

/* Point at a part of the goal. */
#define WRONG_AT(reading, part, error, ...)                                                        \
    fail_at((error), ERROR_USAGE, (reading)->item,                                                 \
            (size_t)((part).start - (reading)->item.start) + 1, __VA_ARGS__)

/* -------- cli/options/goal_figure.c -------- */

/* Name, places and words of a figure, and whether the kind has all that it needs but a target. */
bool goal_read_figure(struct goal_parser *reading, struct text text, struct error *error);

/* -------- cli/options/goal_expression.c -------- */

/* Does it begin with the name of a figure? */
bool goal_names_figure(struct text text);

/*
 * Is it more than the name of one figure with its places, or of one number: arithmetic, or a number
 * of the lens (t2)?
 */
bool goal_is_arithmetic(const struct goals_reader *reader, struct text text);

/* What an arithmetic came to. */
struct goal_sum {
    bool is_constant;
    bool is_bare;  /* a constant without a unit, which takes that of what it stands beside */
    double number; /* of a constant, in its own unit; in mm, rad, g where it has one */
    struct expression *expression; /* of others */
    struct operand_unit unit;
};

/*
 * Read left - right, or left alone: sums, products and quotients of figures (bfl@F, edge 3), of
 * numbers of the lens (t2, gap, c1@tele) and of numbers with or without a unit, in parentheses.
 *
 * Given     right  its start null: there is none
 * Result    a constant, or an expression in the arena. A number without a unit in a sum is in the
 *           unit of what it is added to; in a product it is a plain number
 * Errors    ERROR_USAGE with a caret: what is unknown, sums of different quantities, parentheses
 *           that do not match, a figure of rays, which has no value
 */
bool goal_read_arithmetic(struct goal_parser *reading, struct text left, struct text right,
                          struct goal_sum *sum, struct error *error);

#endif
