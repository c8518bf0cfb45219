/* design/merit/merit_state.h - what an evaluation knows, and how kinds of operands fill it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_STATE_H
#define LENSCALC_DESIGN_MERIT_MERIT_STATE_H

#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "base/dual.h"
#include "base/error.h"
#include "base/watch.h"
#include "design/merit/merit_limit.h"
#include "design/merit/operand.h"
#include "design/solver/solver.h"
#include "design/tolerance/irregularity.h"
#include "design/tolerance/perturbation.h"
#include "design/variable.h"
#include "optics/paraxial_dual.h"
#include "trace/aim/sample.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What columns are derivatives by, in place of variables; the first is the image plane alone. */
struct merit_by {
    size_t most; /* links at a wavelength */
    size_t (*links)(void *context, size_t position, double wavelength, struct variable_link *links);
    void *context;
};

/* What is optimised, and how it is looked at. All of it must outlive the merit. */
struct merit_question {
    const struct lens *lens; /* with all its positions */
    struct variables *variables;
    size_t variable_count;
    const struct merit_by *by;          /* variable_count is of these; null: of the variables */
    const struct perturbations *errors; /* of OPERAND_ASBUILT; null: there are none */
    const struct irregularity *irregularities; /* columns behind those of the variables; or */
    size_t irregularity_count;
    const double *irregularity_amounts; /* mm, one each, read at every look: what rays are moved by,
                                           from merit_deform on; null: columns */
    const struct operand *operands;
    size_t operand_count;
    const struct setup_wavelength *wavelengths; /* count 0: those of each position */
    size_t wavelength_count;
    const struct setup_field *fields; /* the same; of a lens without any the axis */
    size_t field_count;
    const size_t *positions; /* count 0: all */
    size_t position_count;
    enum lens_section section; /* of paraxial figures */
    double fnumber;            /* NaN: the lens's own aperture */
    bool from_entrance, clip;
    double vignetting; /* of the radius of the pupil, at the edge of the field; less within */
    bool is_skew;      /* something else than the variables may decentre or tilt surfaces */
    enum pattern pattern;
    size_t rays;
    uint64_t seed;
    struct watch *watch; /* counts rays while they are chosen and aimed first, may end that with an
                            error; or null */
};

/* Paraxial figures and their derivatives by one variable. */
struct merit_figures {
    struct dual_first first;
    struct dual sums[DUAL_SUMS]; /* by merit_sums */
};

/* A wavelength of a position. What an evaluation has found of it is kept until the next. */
struct merit_light {
    double wavelength; /* um */
    struct variable_link *links;
    size_t link_count;
    struct paraxial_dual paraxial;
    struct merit_figures *figures; /* one a variable; of a merit without variables one */
    enum field_kind field_kind;    /* of their chief ray */
    double field;
    unsigned long linked, figured, summed; /* the evaluation that these are of */
};

/* A position. */
struct merit_place {
    size_t position;
    struct setup setup;      /* of the lens at the start: wavelengths, fields, edge, object */
    const struct lens *lens; /* as the variables have it now */
    struct aperture_setting aperture;
    struct merit_light *lights; /* every wavelength that is asked for: the primary one first */
    size_t light_count;
    struct dual *reach;        /* by merit_reach: of each column one a surface; null: not wanted */
    unsigned long reached;     /* the evaluation that it is of */
    struct merit_beams *edges; /* the rays of merit_reach; null: it is paraxial */
    struct merit_graze *graze; /* rays near loss; null: they do not count */
    struct merit_beams *rim;   /* the ray that sizes the stop; null: the paraxial one does */
    struct dual *rim_radius;   /* room for its height there, one a column; and that, by */
    const struct dual *stop;   /* merit_rim_find; null: the radius is the paraxial one */
};

/* One operand in one position: consecutive residuals. */
struct merit_slot {
    const struct operand *operand;
    size_t place;
    size_t first, count;
    void *own; /* what the kind keeps from one evaluation to the next, by its merit_prepare */
    struct merit_beams *beams; /* its rays, of kinds that have many; else null */
};

struct merit_kind;

/*
 * All operands, ready to be evaluated again and again. Residuals lie in the order of the slots:
 * constraints (OPERAND_EXACT) last, else as the operands and for each the positions.
 */
struct merit {
    struct merit_question question;
    struct merit_place *places;
    size_t place_count;
    struct merit_slot *slots;
    size_t slot_count;
    size_t residual_count, exact_count;
    size_t term_count;     /* values of terms of expressions, which lie behind those of residuals */
    size_t variable_count; /* columns: those of irregularities too */
    enum solver_side *sides; /* one a residual: on which side of its target a figure counts */
    double *values;          /* one a residual, of the last evaluation: a figure in its own unit, of
                            rays the residual itself */
    struct error why;        /* why the last evaluation gave nothing */
    struct merit_limit *limit; /* the same, of rays */
    struct dual *change;       /* one figure, by every variable */
    struct arena *arena;       /* for what is given up before an evaluation ends */
    /* internal */
    const struct merit_kind *kinds; /* of all kinds */
    bool derives;                   /* derivatives are wanted */
    bool forgets; /* rays are aimed without those of the lens before: slower, but a lens has a
                     value or none whichever came before it */
    unsigned long evaluation;
    const double *parameters; /* of merit_put_lens */
};

/*
 * Fill the residuals of a slot.
 *
 * Given     residuals  slot->count of them
 *           jacobian   their rows, merit->variable_count columns each, zeroed; null: not wanted
 * Result    false: as merit_evaluate; merit->why is set
 */
typedef bool merit_fill(struct merit *merit, const struct merit_slot *slot, double *residuals,
                        double *jacobian);

/*
 * How many residuals an operand has in a position, and what else must be ready: once, at the start.
 *
 * Result    0 with `error` set: it cannot be had
 */
typedef size_t merit_prepare(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                             struct error *error);

/* How a kind is filled; without `prepare` it has one residual. */
struct merit_kind {
    merit_fill *fill;
    merit_prepare *prepare;
};

/* As many as merit->values has. */
static inline size_t merit_value_count(const struct merit *merit)
{
    return merit->residual_count + merit->term_count;
}

/* The light of a wavelength (um; NaN: the primary one) in the position of a slot; its links. */
struct merit_light *merit_light(struct merit *merit, const struct merit_slot *slot,
                                double wavelength);

/* The surfaces that an operand is of, or behind which its spaces lie. */
void merit_surfaces(const struct operand *operand, const struct lens *lens, size_t *first,
                    size_t *end);

/* Irregularities that have columns. */
static inline size_t merit_irregular_columns(const struct merit_question *question)
{
    return question->irregularity_amounts == NULL ? question->irregularity_count : 0;
}

/* How many figures there are: of each variable one, or one. */
size_t merit_columns(const struct merit *merit);

/*
 * Put a figure there: value, residual and its row.
 *
 * Given     merit->change  the figure, one a column
 *           at             the number of the residual within the slot
 *           residuals, jacobian  of the slot
 * Result    false: it is not finite
 */
bool merit_put(struct merit *merit, const struct merit_slot *slot, size_t at, double *residuals,
               double *jacobian);

/*
 * Put a figure there that is the inverse of merit->change.
 *
 * Given     merit->change  its inverse 1/value, one a column; lost
 * Result    as merit_put; the value may be infinite
 * Formula   x = P T, T the target, P the inverse: (value - T)/deviation = T (1/x - 1)/deviation for
 *           x of 0.5 to 2, beyond by the tangents there: T (1 - 4 (x - 0.5)), T (-0.5 - 0.25
 *           (x - 2))
 * Source    derived here; in the inverse it is smooth and falls all the way
 */
bool merit_put_inverse(struct merit *merit, const struct merit_slot *slot, size_t at,
                       double *residuals, double *jacobian);

/* Errors    ERROR_DOMAIN: its target is 0, or infinite */
bool merit_inverse_check(const struct operand *operand, struct error *error);

/* Errors    ERROR_DOMAIN: the lens has no aperture */
bool merit_needs_aperture(const struct merit_place *place, struct error *error);

/* A merit of this question, with nothing ready. */
void merit_begin(struct merit *merit, const struct merit_question *question, struct arena *arena);

/*
 * Its places, with the wavelengths that are asked for.
 *
 * Errors    as setup_open
 */
bool merit_places_open(struct merit *merit, struct arena *arena, struct error *error);

/*
 * Of a lens that begins without power, the beam that its f-number stands for is that of the focal
 * length which is wanted: of a goal, or stated. Places whose lens has power, or of which none is
 * known, stay as they are.
 *
 * Result    some are changed
 */
bool merit_aperture_of_wanted(struct merit *merit);

/* Has the lens no power where it begins, and does nothing say what it is to be? */
bool merit_lacks_power(const struct merit *merit);

/* The lens with these numbers, in all places, for who looks at slots by himself; derives: with
   derivatives. */
void merit_put_lens(struct merit *merit, const double *parameters, bool derives);

#endif
