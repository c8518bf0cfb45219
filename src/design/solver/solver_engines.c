/* design/solver/solver_engines.c - the minimisers that a program has: compiled once with Ceres. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_engine.h"

const struct engine solver_engines[] = {
    [SOLVER_DLS] = {dls_minimize, true},
#ifdef WITH_CERES
    [SOLVER_CERES] = {ceres_minimize, false},
#else
    [SOLVER_CERES] = {NULL, false},
#endif
};
