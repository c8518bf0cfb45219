/* cli/complain.h - errors and progress on standard error. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_COMPLAIN_H
#define LENSCALC_CLI_COMPLAIN_H

#include "base/error.h"
#include "report/report.h"

#include <stdbool.h>
#include <stddef.h>

/* Print an error as people expect it: place, message, text with caret, hint. */
void error_print(const struct error *error, const char *command);

/* Formulas and doubts of a report for which its format, or a cross-table, has no place. */
void print_beside(const struct report *report, bool is_table);

/* Seconds of a clock that only runs forward. */
double progress_now(void);

/* Rows so far, now and then, where somebody is looking and it takes long. */
void progress_show(double started, size_t rows, bool last);

#endif
