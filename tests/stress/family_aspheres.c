/* tests/stress/family_aspheres.c - no ray at a random asphere is lost for nothing. */
/* SPDX-License-Identifier: MIT */
#include "stress.h"

#include "../unit/random_aspheres.h"

/*
 * Of every asphere a block of rays, traced with every set of instructions; who arrives must be on
 * the surface in 113 bits, who is lost is searched for. Wild ones may be lost.
 */
enum { STEPS = 2000, SEARCHED = 4 };

static void try_strength(struct trial *trial, const struct strength *strength, bool may_be_lost)
{
    struct asphere_tally tally = {0};
    unsigned long long state = trial->state;
    const bool same = try_asphere(&state, strength, STEPS, SEARCHED, &tally);
    trial_verdict(trial, same, "sets of instructions differ");
    trial_verdict(trial, tally.wrong == 0, "%zu rays are not on the surface", tally.wrong);
    trial_verdict(trial, tally.unconverged == 0, "%zu rays not converged", tally.unconverged);
    trial_verdict(trial, may_be_lost || tally.lost == 0, "%zu rays lost for nothing", tally.lost);
}

void try_aspheres(struct trial *trial)
{
    try_strength(trial, &(const struct strength){0.8, 0.4, 4, 0.7}, false);
}

void try_wild_aspheres(struct trial *trial)
{
    try_strength(trial, &(const struct strength){3, 3, 30, 1.2}, true);
}
