/* design/merit/operand.h - what a lens is wanted to have: a table of kinds. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_OPERAND_H
#define LENSCALC_DESIGN_MERIT_OPERAND_H

#include "analysis/setup/setup_question.h"
#include "base/text.h"
#include "base/units.h"
#include "optics/parameter.h"
#include "optics/surface.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* In the order of the table; a new one is an enumerator, a row of operand.c and one of merit.c. */
enum operand_kind {
    OPERAND_EFL,
    OPERAND_BFL,
    OPERAND_FFL,
    OPERAND_LENGTH,
    OPERAND_TRACK,
    OPERAND_FOCUS,
    OPERAND_POWER,
    OPERAND_MAGNIFICATION,
    OPERAND_FNUMBER,
    OPERAND_PETZVAL,
    OPERAND_AXIAL,
    OPERAND_S1,
    OPERAND_S2,
    OPERAND_S3,
    OPERAND_S4,
    OPERAND_S5,
    OPERAND_HEIGHT,
    OPERAND_DISTORTION,
    OPERAND_LATERAL,
    OPERAND_TELECENTRIC,
    OPERAND_INCIDENCE,
    OPERAND_EDGE,
    OPERAND_CENTER,
    OPERAND_AIR,
    OPERAND_SAG,
    OPERAND_SLOPE,
    OPERAND_RATIO,
    OPERAND_ASPECT,
    OPERAND_WEIGHT,
    OPERAND_COST,
    OPERAND_SPOT,
    OPERAND_POLY,
    OPERAND_ASBUILT,
    OPERAND_OPD,
    OPERAND_GRAZING,
    OPERAND_MTF,
    OPERAND_GMTF,
    OPERAND_NUMBER,     /* a number of the prescription; without a name of its own */
    OPERAND_EXPRESSION, /* arithmetic of others */
    OPERAND_KINDS
};

enum operand_relation {
    OPERAND_NEAR,  /* '=': as near as can be */
    OPERAND_BELOW, /* '<': what is above counts */
    OPERAND_ABOVE, /* '>' */
    OPERAND_EXACT, /* '==': a constraint */
    OPERAND_RELATIONS
};

/* The signs of the command line, indexed by enum operand_relation. */
extern const char *const operand_relations[OPERAND_RELATIONS];

enum operand_orientation { ORIENTATION_BOTH, ORIENTATION_TANGENTIAL, ORIENTATION_SAGITTAL };

struct expression;

/* One thing that is wanted. */
struct operand {
    enum operand_kind kind;
    enum operand_relation relation;
    double target, deviation;        /* mm, rad, 1: the residual is (value - target)/deviation */
    double wavelength;               /* um; NaN: what the kind says */
    const struct setup_field *field; /* null: what the kind says */
    size_t position;                 /* LENS_NONE: each, with a residual each */
    size_t first, last;              /* surfaces, from 0; LENS_NONE: all that the kind knows */
    double frequency;                /* 1/mm; NaN: none */
    enum operand_orientation orientation;
    struct parameter parameter;          /* of OPERAND_NUMBER */
    const struct expression *expression; /* of OPERAND_EXPRESSION */
    bool is_term;                        /* of an expression, where its value alone counts */
    const char *name;                    /* as typed, in one form: "bfl@F > 38" */
    struct typed_place place;
};

/* A goal of this kind, as near to 0 as can be, wherever it is not said otherwise. */
static inline struct operand operand_of(enum operand_kind kind, const char *name)
{
    return (struct operand){.kind = kind,
                            .deviation = 1,
                            .wavelength = NAN,
                            .position = LENS_NONE,
                            .first = LENS_NONE,
                            .last = LENS_NONE,
                            .frequency = NAN,
                            .name = name};
}

/* What may stand behind the name of a kind. */
enum {
    OPERAND_AT_WAVELENGTH = 1,
    OPERAND_AT_FIELD = 2,
    OPERAND_AT_FREQUENCY = 4,
    OPERAND_AT_SURFACES = 8,
    OPERAND_HAS_ORIENTATION = 16,
    OPERAND_NEEDS_FIELD = 32,
    OPERAND_NEEDS_FREQUENCY = 64,
    OPERAND_NEEDS_TARGET = 128, /* others have the target 0, and may be written without one */
    OPERAND_OF_RAYS = 256, /* its residuals are those of rays, without a meaning of their own */
    OPERAND_TRACES = 512,  /* many rays, which OPERAND_GRAZING looks at */
    OPERAND_OF_WAVELENGTHS = 1024 /* all of the question, where it names none */
};

/* What values, targets and deviations are in. */
struct operand_unit {
    const struct dimension *dimension;
    const char *unit;  /* that a bare number is in */
    const char *label; /* for people: "mm", "mm^2"; "" of plain numbers */
};

/* A kind of operand, as goals are written and rows are printed. */
struct operand_type {
    const char *name;                  /* "efl"; null: there is none as yet */
    const char *words;                 /* for help and messages */
    const struct dimension *dimension; /* of value, target and deviation */
    const char *unit;                  /* that a bare number is in */
    unsigned is;                       /* OPERAND_AT_WAVELENGTH .. */
};
const struct operand_type *operand_type(enum operand_kind kind);

/* The unit of an operand, which expressions have of their own. */
struct operand_unit operand_unit(const struct operand *operand);

/*
 * What figures of the lens an operand is made of: of an expression its terms, else itself.
 *
 * Result    count of them
 */
const struct operand *operand_terms(const struct operand *operand, size_t *count);

/* Another name of a kind; null: none. */
const char *operand_alias(enum operand_kind kind);

/* The kind of this name; OPERAND_KINDS: there is none. */
enum operand_kind operand_find(struct text name);

#endif
