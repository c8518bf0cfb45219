/* report/explain.h - formulas with symbols, with numbers put in, and their sources. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_EXPLAIN_H
#define LENSCALC_REPORT_EXPLAIN_H

#include "report/report.h"

/*
 * The explanation of the columns that are shown and have a value.
 *
 * Given     report        its sheet, shown columns and digits
 *           explanations  ends with a null column
 *           row           the row whose numbers are put in
 * Result    lines of text in the report's arena, without a last line feed; null if there is none
 */
const char *explain_row(const struct report *report, const struct explanation *explanations,
                        const void *row);

#endif
