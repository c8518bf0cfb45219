/* design/solver/global.h - the best of many minima: starts, and ways out of each. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_GLOBAL_H
#define LENSCALC_DESIGN_SOLVER_GLOBAL_H

#include "design/solver/solver.h"

#include <stdint.h>

/* A search; what one start finds depends on nothing but this and its number. */
struct global_search {
    const struct solver_problem *problem; /* with scales, without losses */
    const double *low, *high;             /* finite: where starts lie */
    uint64_t seed;
    int escapes;                    /* that are tried from each start */
    int iterations;                 /* of a descent at most; 0: as solver_run has it */
    bool (*goes_on)(void *context); /* asked once an iteration; or null */
    void *context;
};

/* Where a descent ended. */
struct global_minimum {
    double *parameters;
    double cost;   /* half the sum of squares */
    double excess; /* the largest of the exact residuals */
};

/* What a start led to; arrays lie in the arena. */
struct global_chain {
    struct global_minimum *minima; /* escapes + 1 at most, all different */
    size_t count;                  /* 0: the start has no value */
    long evaluations;
    bool is_stopped; /* by goes_on: what it would have found is not known */
};

/*
 * Start `number`: a point of a scrambled Sobol' sequence, whose dimensions are the parameters.
 *
 * Source    [JoeKuo08]; [Burley20]. Beyond 256 parameters independent numbers
 */
void global_start(const struct global_search *search, uint32_t number, double *parameters);

/*
 * From a start to minima: the descent from it, then ways out of what was found.
 *
 * Given     number      of the start: a way out begins in a direction by chance, of it and the seed
 *           parameters  where it is
 *           arena       not one that the problem takes memory from: some of it is given back
 * Formula   a way out begins beside the best minimum, with hills (solver/escape.h) over all that
 *           are known; where those end the descent goes on without them. Descents end where a step
 *           gains a 1e-5th: what is worth it is brought to its minimum later
 */
void global_descend(const struct global_search *search, uint32_t number, const double *parameters,
                    struct arena *arena, struct global_chain *chain);

/* Do they lie so near each other that they are one minimum? Less than 0.1 apart, in scales. */
bool global_is_same(const struct solver_problem *problem, const double *a, const double *b);

/* Is it better? What meets the exact residuals is better than what does not. */
bool global_is_better(const struct global_minimum *one, const struct global_minimum *other);

#endif
