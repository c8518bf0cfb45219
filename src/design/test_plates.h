/* design/test_plates.h - radii of a lens replaced by those of a maker's test plates. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_TEST_PLATES_H
#define LENSCALC_DESIGN_TEST_PLATES_H

#include "design/optimize.h"

/* A pair of test plates, convex and concave: both signs of its radius can be made by it. */
struct test_plate {
    double radius, diameter; /* mm, above 0; a flat has an infinite radius */
};

struct plate_task {
    const struct merit_question *question; /* of the lens with the radii that vary */
    const struct optimize_task *how;       /* but for the merit */
    const struct test_plate *plates;
    size_t plate_count;
    /* The lens, optimised already, its merit, and how far a condition was missed. */
    const struct lens *lens;
    double merit, missed;
    const double *diameters; /* of its surfaces, mm: no plate is smaller; NaN: not known */
};

/* A radius that a plate took the place of. */
struct plate_fit {
    size_t surface;
    double radius, fitted; /* before, and of the plate with its sign, mm */
    const struct test_plate *plate;
    double diameter;      /* of the surface, mm */
    double before, after; /* the merit, everything else optimised again */
    bool is_joined;       /* the next one was made at the same time: both merits are of the two */
};

/* What was found. It must stay where it is. */
struct plate_choice {
    struct plate_fit *fits; /* one after the other */
    size_t count;
    size_t fitted;  /* surfaces that have a plate */
    size_t *left;   /* that have none: too large for all, or out of the bounds of their radius */
    size_t missing; /* their number */
    bool is_stopped;
    long evaluations, iterations;
    /* The lens, of `fitted` above 0 only, with the variables and the merit of its last step */
    const struct lens *lens;
    struct variables variables;
    size_t *origin; /* of these variables in the question's list */
    struct merit merit;
    struct optimize_answer answer;
};

/* Spheres and planes whose radius or curvature varies, alike in all positions; their number. */
size_t plate_surfaces(const struct variables *variables, size_t *surfaces);

/*
 * Replace every radius that varies by that of a plate, so that the merit stays as small as can be.
 *
 * Result    marks of the radii are gone, numbers that follow by pick-ups have followed
 * Formula   the surface whose sag over its diameter d has to change most, |c - c'| d^2/8 to the
 *           nearest plate, goes first, as the others can make up for it while they are free. The 6
 *           plates nearest to it in curvature are tried, everything else optimised anew from where
 *           it is, and the best is taken. In the end one plate is exchanged for one of the 6
 *           nearest, or two at once, each for one of the 3 nearest, as long as that gains 1e-4 of
 *           the merit, and 200 lenses at most
 * Errors    ERROR_DOMAIN: no spherical radius varies; the lens has no merit with any plate
 * Limits    a minimum is a local one
 */
bool plates_fit(const struct plate_task *task, struct arena *arena, struct plate_choice *choice,
                struct error *error);

#endif
