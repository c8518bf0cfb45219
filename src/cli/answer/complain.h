/* cli/answer/complain.h - errors on standard error. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_COMPLAIN_H
#define LENSCALC_CLI_ANSWER_COMPLAIN_H

#include "base/error.h"
#include "cli/batch/batch.h"
#include "cli/question/arguments.h"
#include "report/report.h"
#include "report/terminal.h"

#include <stdbool.h>
#include <stddef.h>

/* Print an error as people expect it: place, message, text with caret, hint; ERROR_PIPE not. */
void error_print(const struct error *error, const char *command, enum color_when color);

/*
 * Name the quantities of a command's error by the options or columns that they were given by; an
 * error that has these names already is left as it is.
 *
 * Given     batch  without columns where there is none
 *           input  of the row that failed: a cell that is empty there gave nothing; null: of none
 */
void complain_name(struct error *error, const struct arguments *arguments,
                   const struct batch *batch, const void *input);

/* Print an error of a command, named so. The error is left with these names. */
void complain(struct error *error, const struct arguments *arguments, const struct batch *batch);

/*
 * Formulas and doubts of a report for which its format has no place.
 *
 * Given     is_apart  doubts are not in it whatever its format: a cross-table, a picture, a file
 */
void print_beside(const struct report *report, bool is_apart, enum color_when color);

/* What is said beside an answer: nothing has no address. */
void print_remark(const char *start, size_t length);

#endif
