/* cli/question/operands_telescope.h - which length of a telescope an operand is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_OPERANDS_TELESCOPE_H
#define LENSCALC_CLI_QUESTION_OPERANDS_TELESCOPE_H

#include "cli/question/arguments.h"

/*
 * Say of operands that are lengths of a telescope which are its focal length and which its
 * diameter. Of two the longer one is the focal length. One alone is what is not given already; else
 * inches up to 24 are a diameter, and more than 600 mm is a focal length; millimetres below that
 * are a diameter below 250 mm where no eyepiece is given or an f-number is, and a focal length from
 * there on where an eyepiece is given and no f-number.
 *
 * Given     operands  as typed;  options  theirs, of count: those of lengths are set
 * Errors    ERROR_USAGE: either may be meant; a second length that may be an eyepiece's
 */
bool operands_tell_telescope(const struct arguments *arguments, const struct text *operands,
                             size_t count, const struct option **options, struct error *error);

#endif
