/* cli/answer/collect.h - all rows of a sweep kept, for cross-tables and plots. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_COLLECT_H
#define LENSCALC_CLI_ANSWER_COLLECT_H

#include "cli/question/sweep.h"
#include "report/report.h"

/* The first row of every combination of a sweep. */
struct collection {
    const struct sweep *sweep;
    const struct command *command;
    const struct sheet *sheet;
    struct arena *arena;
    enum unit_system units;
    bool is_ambiguous; /* a combination made several rows: only the first is here */
    char *rows;        /* sweep->total rows of sheet->row_size */
    bool *is_there;    /* one a combination: false = failed or no row */
    /*
     * Answer an input that is none of the sweep's, for a curve between its samples: the first row,
     * which lasts until the next call; null: there is none.
     */
    const void *(*answer)(void *asked, void *input);
    void *asked;
    void *input; /* of its size, as options set it, to be changed for that */
};

/*
 * Make room for the rows of a sweep.
 *
 * Errors    ERROR_USAGE: more combinations than `most`
 */
bool collection_open(struct collection *collection, size_t most, const char *option,
                     struct error *error);

void collection_keep(struct collection *collection, size_t index, const void *row);

/* The first row there is; null if all failed. */
const void *collection_first_row(const struct collection *collection);

/* The row of a combination; null if it failed. */
const void *collection_row(const struct collection *collection, size_t index);

/* How an axis is called in words: the label of the column that repeats it. */
const char *axis_label(const struct collection *collection, const struct axis *axis);

/* Value i of an axis as people write it: "3 m", "2.8", "35mm". */
const char *axis_value(const struct collection *collection, const struct axis *axis, size_t i,
                       bool with_unit);

/* The same for machines: all digits, in the unit of the axis. */
const char *axis_machine_value(const struct collection *collection, const struct axis *axis,
                               size_t i);

/*
 * The columns of these names, as typed; "error" is passed over where no column is called so.
 *
 * Given     convert  distances become feet where the user reads feet; a typed unit stays
 */
bool collection_columns(const struct collection *collection, const char *names, char separator,
                        bool convert, struct shown **shown, size_t *count, struct error *error);

/* Refuse columns of different units in one cell or on one axis, and, for an axis, words. */
bool collection_check_units(const struct shown *shown, size_t count, const char *option,
                            bool numbers, struct error *error);

/*
 * Print the cross-table that --table asks for.
 *
 * Given     specification  "ROW,COL" or "ROW,COL:VALUE", VALUE one column or several joined by '+'
 *           columns        what --columns says that a table does not obey; null: nothing
 *           report         format and output
 * Errors    ERROR_USAGE: it names no swept option or no column, or one twice; a third option is
 *           swept; the format has no tables; two columns of a csv would have one name
 */
bool cross_table_check(const struct collection *collection, const char *specification,
                       const char *columns, const struct report *report, struct error *error);
bool cross_table_write(const struct collection *collection, const char *specification,
                       struct report *report, struct error *error);

/*
 * Draw columns against the swept option that has the most values, one set of curves for each
 * combination of the others. Between the values of the sweep more are answered, as the curves
 * want them; the area of the command's `zone` is filled.
 *
 * Errors    ERROR_USAGE: nothing is swept, or columns of different dimensions; as plot_draw
 */
bool collection_plot_check(const struct collection *collection, const char *columns, bool typed,
                           struct error *error);
bool collection_plot(const struct collection *collection, const char *columns, bool typed,
                     const char *subtitle, struct svg *svg, struct error *error);

#endif
