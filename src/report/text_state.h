/* report/text_state.h - a table for people while its rows come. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_TEXT_STATE_H
#define LENSCALC_REPORT_TEXT_STATE_H

#include "report/report.h"

struct kept {
    void *row; /* null: failed */
    const struct passed_cell *passed;
    const char *failure;
};

struct text_state {
    struct kept *kept;
    size_t kept_count;
    bool has_layout;
    const struct unit **units; /* one a shown column */
    size_t *widths;
    bool *hidden;      /* one a column of the grid: no room for it on this terminal */
    bool *is_empty;    /* columns without a value in the rows looked at */
    bool has_failures; /* among the rows looked at: then there is a column for the reasons */
    struct arena scratch;
};

/* One answer: it is printed as a list, not as a table. */
bool text_is_list(const struct report *report);

/* Does the column stand under its short head, not under its name? */
bool text_has_head(const struct report *report, const struct column *column);

/* What stands below the table: what was left out, symbols, assumptions, notes, warnings. */
void text_write_below(struct report *report);

/* A line of its own below the table; null writes nothing. */
void text_write_line(struct report *report, const char *line);

#endif
