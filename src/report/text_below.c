/* report/text_below.c - what stands below a table: assumptions, notes, warnings. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"
#include "report/readable.h"
#include "report/row.h"
#include "report/text_state.h"

#include <string.h>

enum { LINE_WIDTH = 79, DIGITS = 4, CELL = 256 };

static bool is_written_by(const struct report *report,
                          void (*writer)(const struct grid *, struct output *, bool))
{
    return report->format->write_grid == writer;
}

const char *report_words(const struct report *report, const struct shown *shown, const void *row)
{
    char value[CELL];
    const struct column *column = shown->column;
    const struct unit *unit = shown->unit;
    if (column->type == COLUMN_NUMBER) {
        unit = readable_unit(shown, UNITS_METRIC, row_number(row, column));
    }
    readable_value(value, sizeof value, row, shown, unit, DIGITS);
    return ARENA_JOIN(report->arena, column_label(column), " ", value,
                      unit != NULL && unit->label[0] != '\0' ? " " : "",
                      unit != NULL ? unit->label : "");
}

const char *report_assumptions(const struct report *report, const void *row)
{
    const char *line = NULL;
    for (size_t i = 0; i < report->assumed_count && row != NULL; i++) {
        const struct shown *shown = &report->assumed[i];
        if (!row_is_absent(row, shown->column)) {
            const char *words = report_words(report, shown, row);
            line = ARENA_JOIN(report->arena, line == NULL ? "assuming " : line,
                              line == NULL ? "" : ", ", words);
        }
    }
    if (report->nominal != NULL) {
        line = arena_printf(report->arena, "%s%sstops by their exact values (%s)",
                            line != NULL ? line : "assuming ", line != NULL ? ", " : "",
                            report->nominal);
    }
    return line;
}

bool text_is_list(const struct report *report)
{
    const struct text_state *state = report->state;
    return !report->many && state->kept_count == 1;
}

bool text_has_head(const struct report *report, const struct column *column)
{
    return column->head != NULL && !report->are_named;
}

static const void *first_good_row(const struct text_state *state)
{
    for (size_t i = 0; i < state->kept_count; i++) {
        if (state->kept[i].row != NULL) {
            return state->kept[i].row;
        }
    }
    return NULL;
}

/* A line below the table, behind a word that stands out; both may be null. */
static void write_remark(struct report *report, enum style style, const char *word,
                         const char *line)
{
    struct output *output = report->output;
    line = grid_printable(report->arena, line);
    if (line == NULL) {
        return;
    }
    if (!is_written_by(report, grid_write_text) && word != NULL) {
        line = ARENA_JOIN(report->arena, word, line);
        word = NULL;
    }
    if (is_written_by(report, grid_write_html)) {
        grid_html_paragraph(output, line);
        return;
    }
    if (is_written_by(report, grid_write_markdown)) {
        line = grid_markdown_text(report->arena, line);
    }
    output_character(output, '\n');
    if (word != NULL) {
        output_styled(output, style, word);
    }
    output_paragraph(output, line, word != NULL ? strlen(word) : 0, 0,
                     output->width > 0 ? output->width : LINE_WIDTH);
}

void text_write_line(struct report *report, const char *line)
{
    write_remark(report, STYLE_PLAIN, NULL, line);
}

/* Which columns had no room, and what shows them. */
static void write_left_out(struct report *report)
{
    const struct text_state *state = report->state;
    const char *names = NULL;
    for (size_t j = 0; state->hidden != NULL && j < report->passed_count + report->shown_count;
         j++) {
        if (state->hidden[j]) {
            struct text name = j < report->passed_count
                                   ? report->passed_names[j]
                                   : text_of(report->shown[j - report->passed_count].name);
            names = arena_printf(report->arena, "%s%s%.*s", names != NULL ? names : "",
                                 names != NULL ? ", " : "", (int)name.length, name.start);
        }
    }
    if (names != NULL) {
        text_write_line(report, arena_printf(report->arena,
                                             "not shown, for want of room in %zu columns: %s; %s",
                                             report->output->width, names, report->remedy));
    }
}

/* What the symbols mean that stand in the head. */
static void write_legend(struct report *report)
{
    const struct text_state *state = report->state;
    const char *line = NULL;
    for (size_t i = 0; i < report->shown_count && !text_is_list(report); i++) {
        const struct column *column = report->shown[i].column;
        bool is_shown = state->hidden == NULL || !state->hidden[report->passed_count + i];
        if (is_shown && text_has_head(report, column) && column->symbol != NULL &&
            strcmp(column->head, column->symbol) == 0) {
            line = arena_printf(report->arena, "%s%s%s: %s", line != NULL ? line : "",
                                line != NULL ? "; " : "", column->head, column_label(column));
        }
    }
    text_write_line(report, line);
}

/* When columns that were asked for, and have no value in any row, would have one. */
static void text_below_write_absent(struct report *report)
{
    const struct text_state *state = report->state;
    const bool is_table = report->are_named && state->has_layout && !text_is_list(report);
    for (size_t i = 0; is_table && first_good_row(state) != NULL && i < report->shown_count; i++) {
        if (state->is_empty[i]) {
            text_write_line(report, arena_printf(report->arena, "%s: no value here: %s",
                                                 report->shown[i].name,
                                                 report_absence(report, report->shown[i].column)));
        }
    }
}

/* Each text of a column once, in the order of the rows. */
static void write_notes(struct report *report, const struct column *column)
{
    const struct text_state *state = report->state;
    for (size_t i = 0; i < state->kept_count; i++) {
        const char *note = state->kept[i].row != NULL ? row_text(state->kept[i].row, column) : NULL;
        bool is_new = note != NULL;
        for (size_t k = 0; k < i && is_new; k++) {
            const void *row = state->kept[k].row;
            is_new = row == NULL || row_text(row, column) == NULL ||
                     strcmp(row_text(row, column), note) != 0;
        }
        if (is_new) {
            text_write_line(report,
                            arena_printf(report->arena, "%s: %s", column_label(column), note));
        }
    }
}

static void write_all_notes(struct report *report)
{
    for (size_t i = 0; i < report->sheet->column_count; i++) {
        const struct column *column = &report->sheet->columns[i];
        if ((column->flags & COLUMN_NOTE) != 0 && !report_shows(report, column)) {
            write_notes(report, column);
        }
    }
}

static void text_below_write_doubts(struct report *report)
{
    struct warnings *doubts = report->doubts;
    for (size_t i = 0; doubts != NULL && i < doubts->count; i++) {
        write_remark(report, STYLE_WARNING,
                     "warning:", arena_printf(&doubts->arena, " %s", doubts->texts[i]));
    }
    text_write_line(report, doubts != NULL ? warnings_left_out(doubts) : NULL);
}

void text_write_below(struct report *report)
{
    write_left_out(report);
    write_legend(report);
    text_below_write_absent(report);
    text_write_line(report, report_assumptions(report, first_good_row(report->state)));
    write_all_notes(report);
    text_below_write_doubts(report);
}
