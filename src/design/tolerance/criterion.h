/* design/tolerance/criterion.h - what a lens that was made is judged by: a table of kinds. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_CRITERION_H
#define LENSCALC_DESIGN_TOLERANCE_CRITERION_H

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "design/merit/operand.h"

#include <stdbool.h>

/* In the order of the table. */
enum criterion_kind {
    CRITERION_SPOT,
    CRITERION_WAVEFRONT,
    CRITERION_MTF,
    CRITERION_EFL,
    CRITERION_BFL,
    CRITERION_DISTORTION,
    CRITERION_BORESIGHT,
    CRITERION_COLOR,
    CRITERION_KINDS
};

/* What is bad about a figure: that it is large, small, off the nominal one, or off 0. */
enum criterion_sense { SENSE_LEAST, SENSE_MOST, SENSE_NEAR, SENSE_SIZE };

/* A kind: its name in options, and its figures, one a field or one a position. */
struct criterion_type {
    const char *name, *words;
    const char *unit;                  /* of rows: "um" */
    double scale;                      /* rows have the figure times this */
    const struct dimension *dimension; /* of a limit */
    enum criterion_sense sense;
    enum operand_kind operand; /* that has the figure; OPERAND_KINDS: rays have */
    bool of_fields;            /* else of positions */
};
const struct criterion_type *criterion_type(enum criterion_kind kind);

struct criterion {
    enum criterion_kind kind;
    double frequency; /* of the contrast, 1/mm; NaN: none */
    const char *name; /* "mtf@40/mm" */
};

/*
 * Read a criterion: spot, wavefront, mtf@40/mm, efl, bfl, distortion, boresight, color.
 *
 * Errors    ERROR_USAGE: an unknown word, with what may have been meant; a frequency that is none,
 *           or is missing
 */
bool criterion_read(struct text text, struct arena *arena, struct criterion *criterion,
                    struct error *error);

/* How bad a figure is: the more, the worse; 0 or less of none that is bad. */
double criterion_badness(enum criterion_kind kind, double figure, double nominal);

/* Does something so bad pass? `limit` has the unit of figures; of SENSE_NEAR it is the largest
   departure. */
bool criterion_passes(enum criterion_kind kind, double badness, double limit);

#endif
