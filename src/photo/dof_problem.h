/* photo/dof_problem.h - what is known, unknown and asked for when a depth of field is solved. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DOF_PROBLEM_H
#define LENSCALC_PHOTO_DOF_PROBLEM_H

#include <stdbool.h>

#include "base/error.h"
#include "photo/dof.h"
#include "photo/dof_solve.h"

enum unknown { FOCAL = 1, FNUMBER = 2, DISTANCE = 4, COC = 8, PRODUCT = FNUMBER | COC };
enum target { NEAR = 1, FAR = 2, TOTAL = 4, HYPERFOCAL = 8, MAGNIFICATION = 16 };

/* What is still unknown and what is still unused. */
struct problem {
    struct dof_setting a;
    struct dof_targets t;
    unsigned unknown;
    unsigned open;
};

/* How many unknowns or targets a set has. */
unsigned problem_count(unsigned set);

/* Are all of these targets still unused? */
bool problem_has(const struct problem *p, unsigned targets);

/* Find out what is unknown and what is asked for. */
void problem_collect(struct problem *p);

/* Refuse too many or too few targets for the unknowns. */
bool problem_check_count(const struct problem *p, struct error *error);

/* Refuse targets that do not fix the unknowns. Returns false. */
bool problem_undetermined(const struct problem *p, struct error *error);

/* Refuse targets outside their range. */
bool problem_check_targets(const struct dof_targets *t, struct error *error);

/* Refuse known settings outside their range. */
bool problem_check_known(const struct problem *p, struct error *error);

/* Refuse limits that no focus between them can have. */
bool problem_check_limits(const struct problem *p, struct error *error);

#endif
