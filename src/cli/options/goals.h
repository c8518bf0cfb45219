/* cli/options/goals.h - goals as people write them: of optimize, of fit, in lens files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_OPTIONS_GOALS_H
#define LENSCALC_CLI_OPTIONS_GOALS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"
#include "data/lensdb.h"
#include "design/merit/operand.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* What goals are read with. */
struct goals_reader {
    struct lensdb *db;       /* for spectral lines */
    const struct lens *lens; /* its positions may be named; null: none may */
    struct arena *arena;
    const char *where; /* what the text stands in, for messages: "--goals" */
    double deviation;  /* of goals that state none, in the unit of each kind */
};

struct goals {
    const struct operand *list;
    size_t count;
};

/*
 * Read goals: "efl=100, bfl@F > 38 : 0.02, spot@14deg, edge 1..11 > 1".
 *
 * Given     text  goals, separated by commas. Each is the name of a kind; then where it is: behind
 *                 each '@' a wavelength (F, 550nm), a field (10deg, 5mm), a frequency (40/mm) or a
 *                 position, told by its form; surfaces (3, 1..11), tangential or sagittal; then
 *                 = < > or ==, and the target with its unit; and behind ':' the deviation.
 *                 A bare number behind '@' is a field in deg of what is of fields alone, a
 *                 wavelength in nm of what has no field
 * Result    operands in the arena
 * Errors    ERROR_USAGE with a caret: what is unknown, twice there, does not belong to the kind, or
 *           is missing; a target that is not finite; a deviation that is not above 0
 */
bool goals_read(const struct goals_reader *reader, struct text text, struct goals *goals,
                struct error *error);

/*
 * Read the goals that a lens states.
 *
 * Given     reader  `where` is not used
 * Result    in their order; none where it states none
 * Errors    ERROR_DATA with the line and column of its file, else as goals_read
 */
bool goals_of_lens(const struct goals_reader *reader, const struct lens *lens, struct goals *goals,
                   struct error *error);

#endif
