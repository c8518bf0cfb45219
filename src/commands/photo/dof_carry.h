/* commands/photo/dof_carry.h - depth of field to print and carry: a disc, a card. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_PHOTO_DOF_CARRY_H
#define LENSCALC_COMMANDS_PHOTO_DOF_CARRY_H

#include "cli/question/artifact.h"

/* What is drawn says what formulas say: checks of artifacts. Errors ERROR_USAGE */
bool dof_check_scale(const struct artifact_job *job, struct error *error);
bool dof_check_carry(const struct artifact_job *job, struct error *error);

/*
 * A calculator disc of one lens, with the f-numbers that are swept, else the usual ones.
 *
 * Errors    ERROR_USAGE: several lenses, sensors or circles of confusion; as dof_question_open and
 *           dof_disc_draw
 */
bool dof_draw_disc(const struct artifact_job *job, struct output *sink, struct error *error);

/*
 * A card of all lenses, f-numbers and distances that are swept.
 *
 * Result    a dash where a lens has no image of a distance
 * Errors    as dof_question_open and dof_card_draw
 */
bool dof_draw_card(const struct artifact_job *job, struct output *sink, struct error *error);

#endif
