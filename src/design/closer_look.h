/* design/closer_look.h - a lens between the rays and fields that its merit sees. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_CLOSER_LOOK_H
#define LENSCALC_DESIGN_CLOSER_LOOK_H

#include "design/optimize.h"

/* A goal of rays that is not as the merit has it. */
struct closer_doubt {
    const struct operand *operand; /* null: there is none */
    struct field_point field;      /* of which this is */
    bool is_path;                  /* a wave front, wavelengths; else a spot, mm */
    double seen, is;               /* its root mean square; `is` infinite: rays are lost */
};

struct closer_look {
    struct closer_doubt rays;   /* of a field of the merit, by more rays */
    struct closer_doubt fields; /* of one between two, against the worse of these */
    double worst_path;          /* the largest of a wave front that is seen; 0: there is none */
};

/*
 * Look at the goals spot, poly, asbuilt (as poly) and opd with twice the rays, and at the fields in
 * the middle between neighbours.
 *
 * Given     merit  what it was optimized by; is not evaluated
 *           state  the lens as that has it
 * Result    doubts: a root mean square that is 1.5 times what the merit sees, or that of the
 *           neighbours, and matters beside the mean of all fields; 0.01 um and 0.001 wavelengths
 *           are nothing
 */
void closer_look_at(const struct merit *merit, const struct optimize_state *state,
                    struct arena *arena, struct closer_look *look);

/* A question with four times the rays, or with fields in the middle between all neighbours, whose
   weights are the means of theirs. */
void closer_question(const struct merit *merit, bool rays, bool fields, struct arena *arena,
                     struct merit_question *question);

#endif
