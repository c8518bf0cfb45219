/* design/glass_choice.h - model glasses of a lens replaced by real ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_GLASS_CHOICE_H
#define LENSCALC_DESIGN_GLASS_CHOICE_H

#include "design/optimize.h"

/* A real glass that a lens may be made of. */
struct glass_candidate {
    struct medium medium;     /* as a lens file names it */
    double nd, Vd, deviation; /* of PgF from the normal line of [Schott16]; NaN: not known */
};

struct glass_choice_task {
    const struct merit_question *question; /* of the lens with its model glasses */
    const struct optimize_task *how; /* but for the merit; `goes_on` is asked by all threads */
    const struct glass_candidate *candidates;
    size_t candidate_count;
    /* The lens, optimised already, its merit, and how far a condition was missed. */
    const struct lens *lens;
    double merit, missed;
    int threads;
};

/* A glass and what took its place. */
struct glass_exchange {
    size_t surface;
    double nd, Vd;        /* of a model, where it had got to; NaN: it was a real glass */
    const char *replaced; /* that glass; null: it was a model */
    const struct glass_candidate *glass;
    double distance;      /* between them */
    double before, after; /* the merit, everything else optimised again */
    bool is_joined;       /* the next one was made at the same time: both merits are of the two */
};

/* What was found. It must stay where it is. */
struct glass_choice {
    struct glass_exchange *exchanges; /* one after the other */
    size_t count, missing;            /* done; left, as there was no time */
    bool is_stopped;                  /* there may be better ones */
    long evaluations, iterations;     /* of all trials */
    /* The lens, of `count` above 0 only, with the variables and the merit of its last step */
    const struct lens *lens;
    struct variables variables;
    size_t *origin; /* of these variables in the question's list */
    struct merit merit;
    struct optimize_answer answer;
};

/* Surfaces behind which a model glass nd/Vd varies; their number. */
size_t glass_choice_models(const struct variables *variables, size_t *surfaces);

/*
 * Replace every model glass that varies, so that the merit stays as small as can be.
 *
 * Result    the same whatever the number of threads. Marks of the glasses are gone, glasses that
 *           follow by pick-ups have followed
 * Formula   the model glass that is farthest from all candidates goes first, as the others can make
 *           up for it while they are free. The 8 candidates nearest to it are tried, everything
 *           else optimised anew from where it is (of up to three glasses, and where that leads
 *           nowhere, also from the question's lens), and the one that loses least is taken. For the
 *           last three glasses, and so many candidates of each, all combinations are searched,
 *           least loss first, but for those that cannot be better than the best so far: the merit
 *           with the remaining glasses free is a bound (branch and bound). Two glasses in all are
 *           tried without it. Then real glasses are exchanged: one for each of the 8 nearest to it,
 *           and where none of these gains two at once, each for the 5 nearest, of all pairs; the
 *           best is taken, and it begins anew, until none gains 1e-4 of the merit or 400 lenses
 *           have been tried
 *           distance: ((dn/0.1)^2 + (dV/10)^2 + (dP/0.02)^2)^(1/2) of nd, Vd and the deviation of
 *           PgF from the normal line, on which a model glass is taken to lie; the last term of
 *           glasses whose PgF is known
 * Errors    ERROR_DOMAIN: no candidate within the bounds of a glass, none with which the lens has a
 *           merit; another number follows one of its by a pick-up
 * Limits    a minimum is a local one, and so is the bound: as good as the optimisation
 */
bool glass_choose(const struct glass_choice_task *task, struct arena *arena,
                  struct glass_choice *choice, struct error *error);

#endif
