/* report/report.h - rows of results on their way out, in the format the user asked for. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_REPORT_H
#define LENSCALC_REPORT_REPORT_H

#include "base/arena.h"
#include "base/error.h"
#include "report/output.h"
#include "report/row.h"
#include "report/warnings.h"

#include <stdbool.h>
#include <stddef.h>

enum unit_system { UNITS_METRIC, UNITS_IMPERIAL };

struct report;
struct selection;
struct grid;

/* A cell of a batch that is passed through. */
struct passed_cell {
    struct text text; /* start is null where only other rows have it, of formats that are keyed */
    bool is_bare;     /* JSON without quotes: a number, true, false; null where the text is empty */
};

/* A way to print. `row` gets a failed row as a null pointer with its failure. */
struct format {
    struct word word;   /* "csv", what it is */
    bool is_for_people; /* scaled for reading, units in the heads */
    bool is_keyed;      /* each row names its values: later rows may have more that is handed on */
    bool has_lists;     /* assumptions are items of a list */
    char separator;     /* between the cells of a line; 0 = the lines have no cells */
    /* A whole table, with its head or without; null: the format has none. */
    void (*write_grid)(const struct grid *grid, struct output *output, bool with_head);
    void (*begin)(struct report *report);
    void (*row)(struct report *report, const void *row, const struct passed_cell *passed,
                const struct error *failure);
    void (*end)(struct report *report);
};

extern const struct format format_text, format_csv, format_tsv, format_json, format_jsonl,
    format_markdown, format_latex, format_html;

/* The one column that is shown, a bare value a line: for --value, no choice of --format. */
extern const struct format format_value;

/* All formats; ends with null. */
extern const struct format *const formats[];

/* The word of format i; null behind the last. */
const struct word *format_word(size_t i);

struct report {
    const struct format *format;
    struct output *output;
    struct arena *arena;
    const char *command; /* its name */
    const char *title;   /* what the answer is, where options do not say so: before it, or beside */
    const struct sheet *sheet;
    struct shown *shown; /* columns of the rows */
    size_t shown_count;
    struct shown *assumed; /* columns of the assumptions, the same in every row */
    size_t assumed_count;
    const struct text *passed_names; /* columns of a batch that are passed through */
    size_t passed_count;
    bool has_error_column;
    bool is_headless;                  /* no line of names above the rows of csv and tsv */
    bool are_named;                    /* the columns, by --columns: their heads are these names */
    bool *has_value;                   /* has any row that was looked at one, of each of these */
    bool has_good_row;                 /* was a row looked at? */
    const struct selection *selection; /* that chose the columns */
    bool many;                         /* a sweep or a batch: rows lie, even if there is one */
    const char *nominal;  /* what had labels of stop series read as exact values; null = nothing */
    const char *defaults; /* which of the user's took part: "FILE: sensor ..."; null = none */
    int digits;           /* significant digits, 0 = as the format does */
    enum unit_system units;
    const char *remedy;      /* what shows columns for which a terminal has no room */
    const char *explain;     /* text to print after the rows, or null */
    struct warnings *doubts; /* what to say beside the answer; null = nothing, ever */
    size_t rows;             /* printed so far */
    void *state;             /* the format's own */
};

/* Is it among the columns of the rows? */
static inline bool report_shows(const struct report *report, const struct column *column)
{
    for (size_t i = 0; i < report->shown_count; i++) {
        if (report->shown[i].column == column) {
            return true;
        }
    }
    return false;
}

/* The columns to print, and which options shape them. */
struct selection {
    const char *columns; /* names of columns, or null for the usual ones */
    const char *naming;  /* the option that names them: "columns" */
    bool many;           /* rows of a sweep or a batch */
    enum { SELECT_ALL, SELECT_LIST, SELECT_TABLE } layout; /* machine; one answer; many rows */
    bool (*given)(const void *asked, const char *option);  /* was this option given? */
    bool (*varied)(const void *asked, const char *option); /* does it change from row to row? */
    /* the option that a column repeats under a name of its own; else that name. For subtitles */
    const char *(*option_of)(const void *asked, const char *column);
    const void *asked;
};

/*
 * Choose the columns of a report from its sheet; fills shown and assumed.
 *
 * Errors    ERROR_USAGE: --columns names an unknown or doubled column or a wrong unit
 */
bool report_select(struct report *report, const struct selection *selection, struct error *error);

/*
 * Find a column by output name ("near_m"), in another unit ("near_ft") or without one ("near");
 * else by the same in other spelling, by its label ("near limit") or by its symbol. Columns that
 * were added answer only to what none of the command's own is called.
 *
 * Errors    ERROR_USAGE: no such column, with what is near; a unit it cannot be printed in
 */
bool report_find_column(const struct sheet *sheet, struct text name, struct arena *arena,
                        struct shown *shown, struct error *error);

/* A sheet without the columns that were added, COLUMN_ADDED, which lie before its own. */
struct sheet report_own_columns(const struct sheet *sheet);

/*
 * Say first what the answer is: where the question has been taken for another one than its options
 * ask, as a value that is assumed without it gives way to a wish.
 *
 * Given     one   of an answer with one row
 *           many  of any number
 */
void report_lead(struct report *report, const char *one, const char *many);

/*
 * Look whether a row has values for the columns that --columns names.
 *
 * Result    all have had one by now: further rows need not be looked at
 */
bool report_note_values(struct report *report, const void *row);

/*
 * When a column that was asked for and has no value would have one: "it has one with --film", else
 * what it is; in the report's arena.
 */
const char *report_absence(const struct report *report, const struct column *column);

/* A value in words: "circle of confusion 0.02884 mm". */
const char *report_words(const struct report *report, const struct shown *shown, const void *row);

/*
 * "assuming ..., ...": the assumptions of a report in words, from a row; null if there are none. In
 * Markdown they are a list.
 */
const char *report_assumptions(const struct report *report, const void *row);

/*
 * What stays the same in all curves of a plot: options that were given, then what was assumed.
 *
 * Given     selection  of this report
 *           row        any one; null: none
 * Result    in the arena, cut at about 90 characters; null if there is nothing to say
 */
const char *report_subtitle(const struct report *report, const struct selection *selection,
                            const void *row);

#endif
