/* design/solver/solver_engine.h - one run of a minimiser over some of the parameters. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_ENGINE_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_ENGINE_H

#include "design/solver/solver.h"

enum engine_end { ENGINE_CONVERGED, ENGINE_LIMIT, ENGINE_WATCHED, ENGINE_FAILED, ENGINE_NO_MEMORY };

/* Given, and what comes back. All has been checked: the run cannot abort on it. */
struct engine_run {
    const struct solver_problem *problem;
    struct solver_options options; /* complete; `iterations` are those left */
    const bool *is_free;           /* the others stay as they are */
    double *parameters;            /* all of them: the start; receives the best */
    /* once an iteration, with all parameters; false ends the run */
    bool (*watch)(void *context, int iteration, double cost, const double *parameters);
    void *watch_context;
    struct arena *arena;
    bool *at_bound;      /* receives who is pushed against a bound, from an engine that has them */
    double *multipliers; /* receives those of the exact residuals, from an engine that has them */
    enum engine_end end;
    int iterations, evaluations, derivatives;
    char message[200];
};

struct engine {
    void (*minimize)(struct engine_run *run); /* null: it is no part of this program */
    bool keeps_bounds;                        /* by itself, and exact residuals */
};

extern const struct engine solver_engines[];

void dls_minimize(struct engine_run *run);

#ifdef __cplusplus
extern "C"
#endif
    void
    ceres_minimize(struct engine_run *run);

#endif
