/* cli/question/distance_word.h - a distance in a word: hyperfocal. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_DISTANCE_WORD_H
#define LENSCALC_CLI_QUESTION_DISTANCE_WORD_H

#include "cli/question/arguments.h"

/*
 * "--distance hyperfocal", where a far limit may be wanted: the nearest distance with which all
 * behind is sharp, --far inf.
 *
 * Errors    ERROR_USAGE: --far is given as well
 */
bool distance_word_settle(struct arguments *arguments, struct error *error);

#endif
