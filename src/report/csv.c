/* report/csv.c - comma- and tab-separated values (RFC 4180). */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"
#include "report/report.h"

#include <string.h>

/* Does the cell need quotes? */
static bool is_special(const char *start, size_t length, char separator)
{
    if (length > 0 && start[0] == '#') {
        return true; /* a row that begins with it would be a comment */
    }
    for (size_t i = 0; i < length; i++) {
        char c = start[i];
        if (c == separator || c == '"' || c == '\n' || c == '\r') {
            return true;
        }
    }
    return false;
}

static void csv_write_text(struct report *report, const char *start, size_t length)
{
    if (!is_special(start, length, report->format->separator)) {
        output_text(report->output, start, length);
        return;
    }
    output_character(report->output, '"');
    for (size_t i = 0; i < length; i++) {
        if (start[i] == '"') {
            output_character(report->output, '"');
        }
        output_character(report->output, start[i]);
    }
    output_character(report->output, '"');
}

static void csv_write_value(struct report *report, const void *row, const struct shown *shown)
{
    switch (shown->column->type) {
    case COLUMN_NUMBER:
        output_advance(report->output,
                       shown_write_number(output_reserve(report->output, NUMBER_LENGTH), row, shown,
                                          report->digits));
        break;
    case COLUMN_INTEGER:
        if (!row_is_absent(row, shown->column)) {
            output_printf(report->output, "%ld", row_integer(row, shown->column));
        }
        break;
    case COLUMN_FLAG:
        output_string(report->output, row_flag(row, shown->column) ? "true" : "false");
        break;
    case COLUMN_TEXT: {
        const char *text = row_text(row, shown->column);
        csv_write_text(report, text != NULL ? text : "", text != NULL ? strlen(text) : 0);
        break;
    }
    }
}

/* Then the state is set: rows need no look at types, pass-through cells and errors. */
static bool has_only_numbers(const struct report *report)
{
    for (size_t i = 0; i < report->shown_count; i++) {
        if (report->shown[i].column->type != COLUMN_NUMBER) {
            return false;
        }
    }
    return report->shown_count > 0 && report->shown_count <= OUTPUT_RESERVE / (NUMBER_LENGTH + 1) &&
           report->passed_count == 0 && !report->has_error_column;
}

static void csv_write_names(struct report *report)
{
    char separator = report->format->separator;
    size_t cells = 0;
    for (size_t i = 0; i < report->passed_count; i++) {
        if (cells++ > 0) {
            output_character(report->output, separator);
        }
        csv_write_text(report, report->passed_names[i].start, report->passed_names[i].length);
    }
    for (size_t i = 0; i < report->shown_count; i++) {
        if (cells++ > 0) {
            output_character(report->output, separator);
        }
        output_string(report->output, report->shown[i].name);
    }
    if (report->has_error_column) {
        output_string(report->output, cells > 0 ? (char[]){separator, '\0'} : "");
        output_string(report->output, "error");
    }
    output_character(report->output, '\n');
}

static void csv_begin(struct report *report)
{
    if (!report->is_headless) {
        csv_write_names(report);
    }
    if (has_only_numbers(report)) {
        report->state = report->shown;
    }
}

static void row(struct report *report, const void *row, const struct passed_cell *passed,
                const struct error *failure)
{
    char separator = report->format->separator;
    size_t cells = 0;
    if (row != NULL && report->state != NULL) {
        /* all columns are numbers, as in most pipes: nothing else to write */
        const struct shown *shown = report->shown, *behind = shown + report->shown_count;
        char *to = output_reserve(report->output, report->shown_count * (NUMBER_LENGTH + 1));
        for (; shown < behind; shown++) {
            to = shown_write_number(to, row, shown, report->digits);
            *to++ = separator;
        }
        to[-1] = '\n';
        output_advance(report->output, to);
        return;
    }
    for (size_t i = 0; i < report->passed_count; i++) {
        if (cells++ > 0) {
            output_character(report->output, separator);
        }
        csv_write_text(report, passed[i].text.start, passed[i].text.length);
    }
    for (size_t i = 0; i < report->shown_count; i++) {
        if (cells++ > 0) {
            output_character(report->output, separator);
        }
        if (row != NULL) {
            csv_write_value(report, row, &report->shown[i]);
        }
    }
    if (row == NULL && cells == 1 && !report->has_error_column) {
        output_string(report->output, "\"\""); /* an empty line would be no row */
    }
    if (report->has_error_column) {
        output_string(report->output, cells > 0 ? (char[]){separator, '\0'} : "");
        if (failure != NULL) {
            csv_write_text(report, failure->message, strlen(failure->message));
        }
    }
    output_character(report->output, '\n');
}

static void csv_end(struct report *report)
{
    (void)report;
}

static void csv_grid(const struct grid *grid, struct output *output, bool with_head)
{
    grid_write_separated(grid, output, ',', with_head);
}

static void tsv_grid(const struct grid *grid, struct output *output, bool with_head)
{
    grid_write_separated(grid, output, '\t', with_head);
}

const struct format format_csv = {{"csv", "comma-separated values"},
                                  .separator = ',',
                                  .write_grid = csv_grid,
                                  .begin = csv_begin,
                                  .row = row,
                                  .end = csv_end};
const struct format format_tsv = {{"tsv", "tab-separated values"},
                                  .separator = '\t',
                                  .write_grid = tsv_grid,
                                  .begin = csv_begin,
                                  .row = row,
                                  .end = csv_end};

static void value_begin(struct report *report)
{
    (void)report;
}

/* A row that failed has an empty line: its place is kept. */
static void value_row(struct report *report, const void *row, const struct passed_cell *passed,
                      const struct error *failure)
{
    (void)passed;
    (void)failure;
    const struct shown *shown = &report->shown[0];
    if (row != NULL && shown->column->type == COLUMN_TEXT) {
        const char *text = row_text(row, shown->column);
        output_string(report->output, text != NULL ? text : "");
    } else if (row != NULL) {
        csv_write_value(report, row, shown);
    }
    output_character(report->output, '\n');
}

const struct format format_value = {
    {"value", "bare values"}, .begin = value_begin, .row = value_row, .end = csv_end};
