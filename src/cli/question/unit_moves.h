/* cli/question/unit_moves.h - values whose unit says that they are another option's. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_UNIT_MOVES_H
#define LENSCALC_CLI_QUESTION_UNIT_MOVES_H

#include "cli/question/arguments.h"

/*
 * Give them to that option where the command has it and it is not given: --aperture 200mm of a
 * telescope is its diameter, -f 638px a focal length in pixels, --sensor 1280x720px their number.
 */
void unit_moves_apply(struct arguments *arguments, struct arena *arena);

#endif
