/* report/words.c - what reports say in words: values, assumptions, and why there is no value. */
/* SPDX-License-Identifier: MIT */
#include "report/readable.h"

const char *report_words(const struct report *report, const struct shown *shown, const void *row)
{
    enum { DIGITS = 4 };
    const struct column *column = shown->column;
    const struct unit *unit = shown->unit;
    if (column->type == COLUMN_NUMBER) {
        unit = readable_unit(shown, UNITS_METRIC, row_number(row, column));
    }
    return ARENA_JOIN(report->arena, column_label(column), " ",
                      readable_words(report->arena, row, shown, unit, DIGITS),
                      unit != NULL && unit->label[0] != '\0' ? " " : "",
                      unit != NULL ? unit->label : "");
}

const char *report_assumptions(const struct report *report, const void *row)
{
    const bool is_list = report->format->has_lists;
    const char *const first = is_list ? "assuming\n\n- " : "assuming ";
    const char *const next = is_list ? "\n- " : ", ";
    const char *line = NULL;
    for (size_t i = 0; i < report->assumed_count && row != NULL; i++) {
        const struct shown *shown = &report->assumed[i];
        if (!row_is_absent(row, shown->column)) {
            const char *words = report_words(report, shown, row);
            line = ARENA_JOIN(report->arena, line == NULL ? first : line, line == NULL ? "" : next,
                              words);
        }
    }
    if (report->nominal != NULL) {
        line = arena_printf(report->arena, "%s%sstops by their exact values (%s)",
                            line != NULL ? line : first, line != NULL ? next : "", report->nominal);
    }
    if (report->defaults != NULL) {
        line = ARENA_JOIN(report->arena, line != NULL ? line : first, line != NULL ? next : "",
                          "defaults of ", report->defaults);
    }
    return line;
}

/* -------- columns without a value -------- */

bool report_note_values(struct report *report, const void *row)
{
    bool all = true;
    report->has_good_row = true;
    for (size_t i = 0; i < report->shown_count; i++) {
        const struct column *column = report->shown[i].column;
        /* where nothing is doubtful a warning is rightly empty */
        report->has_value[i] = report->has_value[i] || (column->flags & COLUMN_NOTE) != 0 ||
                               !row_is_absent(row, column);
        all = all && report->has_value[i];
    }
    return all;
}

/* "--front or --lens": a list of options, separated by blanks, if none of them is given. */
static const char *options_in_words(const struct report *report, struct text options)
{
    const struct selection *selection = report->selection;
    const char *words = "";
    while (options.length > 0) {
        const struct text word = text_cut(&options, ' ');
        const char *name = arena_string(report->arena, word.start, word.length);
        if (name[0] == '+') {
            continue; /* it only follows from others */
        }
        if (selection->given(selection->asked, name)) {
            return "";
        }
        words = ARENA_JOIN(report->arena, words, *words != '\0' ? " or --" : "--", name);
    }
    return words;
}

const char *report_absence(const struct report *report, const struct column *column)
{
    const struct text options[] = {column_repeated(column),
                                   text_of(column->with != NULL ? column->with : ""),
                                   text_of(column->depends != NULL ? column->depends : "")};
    if (column->when != NULL) {
        return ARENA_JOIN(report->arena, "it has one ", column->when);
    }
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        const char *words = options_in_words(report, options[i]);
        if (*words != '\0') {
            return ARENA_JOIN(report->arena, "it has one with ", words);
        }
    }
    if ((column->flags & COLUMN_NOTE) != 0) {
        return "it has one where something is doubtful";
    }
    return column->help != NULL ? column->help : "no question of this kind has one";
}
