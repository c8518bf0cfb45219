/* design/tolerance/tolerance_trial.h - one lens as it may be made, adjusted and judged. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TOLERANCE_TOLERANCE_TRIAL_H
#define LENSCALC_DESIGN_TOLERANCE_TOLERANCE_TRIAL_H

#include "design/merit/merit.h"
#include "design/merit/merit_spots.h"
#include "design/tolerance/criterion.h"
#include "design/tolerance/perturbed.h"
#include "design/tolerance/second_order.h"

#include <stdbool.h>
#include <stddef.h>

/* What the image plane of a made lens does. */
enum tolerance_refocus {
    REFOCUS_NONE,     /* it stays where the nominal lens has it */
    REFOCUS_PARAXIAL, /* it goes to the paraxial image of the primary wavelength */
    REFOCUS_BEST      /* to where the spots, or the wave fronts, of all fields are best */
};

/* A number that a movement of a compensator changes. */
struct compensator_part {
    struct parameter what;
    size_t position; /* LENS_NONE: in all; else of a word of the positions */
    double weight;   /* per unit of the movement */
};

enum { TOLERANCE_COMPENSATORS = 16 }; /* at most */

/* Something of a made lens that is adjusted, mm or rad. */
struct compensator {
    struct compensator_part *parts;
    size_t part_count;
    double low, high; /* of its movement, 0 within; infinite: none */
    const char *name; /* as typed */
};

struct tolerance_question {
    struct merit_question view; /* lens as read, wavelengths .. seed, is the aim at the entrance;
                                   variables and operands are not read */
    const struct perturbation *perturbations;
    size_t perturbation_count;
    struct criterion criterion;
    enum tolerance_refocus refocus;
    const struct compensator *compensators;
    size_t compensator_count;
    bool aims; /* rays are aimed anew in every lens; else they are those that enter the nominal */
};

/* What a figure is of. */
struct tolerance_figure {
    size_t place;                         /* of merit.places */
    const struct setup_field *field;      /* null: of the position */
    size_t spot;                          /* of tolerance.spots */
    enum operand_orientation orientation; /* of contrast */
};

/* Ready for trials: of one thread. All of it lies in an arena. */
struct tolerance {
    struct tolerance_question question;
    const struct lens *lens;    /* with its image plane as the last thickness */
    struct variables variables; /* what compensators change */
    struct perturbed perturbed;
    struct compensator *movers; /* those of the question, and the refocus where it is one of them */
    size_t mover_count;
    struct merit quality;       /* what they make best: spots or wave fronts; no slots: nothing */
    struct merit judge;         /* criteria that are operands; no slots: none */
    struct merit_lines **lines; /* one a slot of `quality`, of spots */
    struct merit_spot *spots;   /* of all places and fields */
    struct tolerance_figure *figures;
    size_t figure_count;
    double *nominal;       /* figures of the lens without errors, compensated as all are */
    double *nominal_moves; /* and what that took */
    double (*rest)[2];     /* the image of the boresight there, mm: one a figure */
    struct irregularity *irregularities; /* of the perturbations that are one */
    size_t irregularity_count;
    size_t *irregular;         /* of each its perturbation, */
    double *irregular_amounts; /* and in a trial its height, mm */
    /* internal */
    bool closed;     /* the image plane alone moves, and spots are parabolas of it */
    size_t *of_part; /* of each part of the movers, one after the other: its variable */
    double *numbers, *base, *residuals, *jacobian, *judged;
    struct arena within;
};

/* What a trial gave. Arrays are the caller's. */
struct tolerance_trial {
    double *figures;  /* figure_count */
    double *moves;    /* the refocus first, mm; then one a compensator, mm or rad */
    struct error why; /* of a failed one */
};

/*
 * Make ready.
 *
 * Result    the lens keeps its image plane as a distance, wherever its file has it
 * Errors    as merit_open and perturbed_open; ERROR_DOMAIN: a compensator that moves no ray, one
 *           beside a paraxial refocus, no image plane, the nominal lens has no figures
 */
bool tolerance_open(const struct tolerance_question *question, struct arena *arena,
                    struct tolerance *tolerance, struct error *error);

/*
 * Make a lens, adjust it, and judge it.
 *
 * Given     errors  one a perturbation, in units of its half range
 * Result    false: it has no figures, and trial->why says it. What a trial gives does not depend on
 *           those before it
 * Formula   what is adjusted makes the sum of W RMS^2 over fields, wavelengths and positions
 *           smallest, of spots, or of wave fronts for the criteria wavefront and mtf. The image
 *           plane alone, of spots: rays are straight, so that RMS^2 = a + 2 b s + c s^2, and s =
 *           -sum W b/sum W c. Else by damped least squares with exact derivatives. Figures are RMS
 *           of the spot of a field as `spot` has it, RMS of the wave fronts of a field, of all its
 *           wavelengths by their weights, or those of the operand of that name; of the boresight
 *           the distance of the centroid from that of the nominal lens
 */
bool tolerance_trial(struct tolerance *tolerance, const double *errors,
                     struct tolerance_trial *trial);

/* The lens of the trial that was made last, as adjusted, to be written: perturbed_lens. */
struct lens *tolerance_lens(struct tolerance *tolerance, const struct tolerance_trial *trial,
                            struct arena *arena);

/*
 * Trials as plain functions of errors, of which the tolerance does one after the other: of figures,
 * and behind them what was adjusted, as many as tolerance_moves says.
 *
 * Given     watch    counts the trials, and may stop them; or null
 *           nominal  receives all of them without errors; or null
 * Result    RMS and distances are roots of squares; pointers into the tolerance and the arena
 */
struct second_order_problem tolerance_problem(struct tolerance *tolerance, struct watch *watch,
                                              struct arena *arena, double **nominal);

/* Does the criterion, or what is adjusted for it, look at the wave front? */
static inline bool tolerance_looks_at_waves(const struct tolerance_question *question)
{
    return question->criterion.kind == CRITERION_WAVEFRONT ||
           question->criterion.kind == CRITERION_MTF;
}

/* Where the positions are looked at. */
static inline const struct merit *tolerance_view(const struct tolerance *tolerance)
{
    return tolerance->quality.slot_count > 0 ? &tolerance->quality : &tolerance->judge;
}

static inline size_t tolerance_moves(const struct tolerance *tolerance)
{
    return 1 + tolerance->question.compensator_count;
}

/* Internal to tolerance_open: does the nominal lens depend on everything that is adjusted? */
bool tolerance_check_movers(struct tolerance *tolerance, struct arena *arena, struct error *error);

#endif
