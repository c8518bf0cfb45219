/* report/text_format.c - aligned tables for people: plain text, markdown, LaTeX and HTML. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"
#include "report/readable.h"
#include "report/row.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * The units and widths of a table are chosen from its first rows, so these wait until so many have
 * come; later ones are printed as they come, in the same layout, and memory does not grow.
 */
enum { ROWS_LOOKED_AT = 512, DIGITS = 4, LINE_WIDTH = 79 };

/* A table while its rows come. */
struct kept {
    void *row; /* null: failed */
    const struct passed_cell *passed;
    const char *failure;
};

struct text_state {
    struct kept *kept;
    size_t kept_count;
    bool has_layout;
    size_t laid_out;           /* rows of the grid that was written with its head */
    const struct unit **units; /* one a shown column */
    size_t *widths;
    bool *hidden;      /* one a column of the grid: no room for it on this terminal */
    bool *is_empty;    /* columns without a value in the rows looked at */
    bool has_failures; /* among the rows looked at: then there is a column for the reasons */
    struct arena scratch;
};

/* -------- below the table -------- */

static bool is_written_by(const struct report *report,
                          void (*writer)(const struct grid *, struct output *, bool))
{
    return report->format->write_grid == writer;
}

/* One answer: it is printed as a list, not as a table. */
static bool text_is_list(const struct report *report)
{
    const struct text_state *state = report->state;
    return !report->many && state->kept_count == 1;
}

/* Does the column stand under its short head, not under its name? */
static bool text_has_head(const struct report *report, const struct column *column)
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
    if (is_written_by(report, grid_write_latex)) {
        grid_latex_paragraph(report->arena, output, line);
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

/* A line of its own below the table; null writes nothing. */
static void text_write_line(struct report *report, const char *line)
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

/* What stands below the table: what was left out, symbols, assumptions, notes, warnings. */
static void text_write_below(struct report *report)
{
    write_left_out(report);
    write_legend(report);
    /* When columns that were asked for, and have no value in any row, would have one. */
    const struct text_state *state = report->state;
    const bool is_table = report->are_named && state->has_layout && !text_is_list(report);
    for (size_t i = 0; is_table && first_good_row(state) != NULL && i < report->shown_count; i++) {
        if (state->is_empty[i]) {
            text_write_line(report, arena_printf(report->arena, "%s: no value here: %s",
                                                 report->shown[i].name,
                                                 report_absence(report, report->shown[i].column)));
        }
    }
    text_write_line(report, report_assumptions(report, first_good_row(report->state)));
    for (size_t i = 0; i < report->sheet->column_count; i++) {
        const struct column *column = &report->sheet->columns[i];
        if ((column->flags & COLUMN_NOTE) != 0 && !report_shows(report, column)) {
            /* Each text of a column once, in the order of the rows. */
            for (size_t j = 0; j < state->kept_count; j++) {
                const char *note =
                    state->kept[j].row != NULL ? row_text(state->kept[j].row, column) : NULL;
                bool is_new = note != NULL;
                for (size_t k = 0; k < j && is_new; k++) {
                    const void *row = state->kept[k].row;
                    is_new = row == NULL || row_text(row, column) == NULL ||
                             strcmp(row_text(row, column), note) != 0;
                }
                if (is_new) {
                    text_write_line(
                        report, arena_printf(report->arena, "%s: %s", column_label(column), note));
                }
            }
        }
    }
    struct warnings *doubts = report->doubts;
    for (size_t i = 0; doubts != NULL && i < doubts->count; i++) {
        write_remark(report, STYLE_WARNING,
                     "warning:", arena_printf(&doubts->arena, " %s", doubts->texts[i]));
    }
    text_write_line(report, doubts != NULL ? warnings_left_out(doubts) : NULL);
}

/* -------- the table -------- */

static int text_format_digits_of(const struct report *report, const struct column *column)
{
    int usual = column->digits != 0 ? column->digits : DIGITS;
    return report->digits != 0 ? report->digits : usual;
}

/* Rows are kept whole, with copies of their texts. */
static void text_format_keep(struct report *report, const void *row,
                             const struct passed_cell *passed, const struct error *failure)
{
    struct text_state *state = report->state;
    struct kept *kept = &state->kept[state->kept_count++];
    struct passed_cell *copies =
        ARENA_ARRAY(report->arena, report->passed_count, struct passed_cell);
    for (size_t i = 0; i < report->passed_count; i++) {
        const struct text text = passed[i].text;
        copies[i].text.start = arena_string(report->arena, text.start, text.length);
        copies[i].text.length = text.length;
    }
    *kept = (struct kept){.passed = copies};
    if (failure != NULL) {
        state->has_failures = true;
        kept->failure = arena_string(report->arena, failure->message, strlen(failure->message));
    }
    if (row == NULL) {
        return;
    }
    const void *before = state->kept_count > 1 ? kept[-1].row : NULL;
    kept->row = arena_buffer(report->arena, report->sheet->row_size);
    memcpy(kept->row, row, report->sheet->row_size);
    for (size_t i = 0; i < report->sheet->column_count; i++) {
        const struct column *column = &report->sheet->columns[i];
        if (column->type == COLUMN_TEXT && row_text(row, column) != NULL) {
            const char *string = row_text(row, column);
            const char *above = before != NULL ? row_text(before, column) : NULL;
            *(const char **)((char *)kept->row + column->offset) =
                above != NULL && strcmp(above, string) == 0
                    ? above
                    : arena_string(report->arena, string, strlen(string));
        }
    }
}

/* The median magnitude of a column's finite values; NaN if there are none. */
static double text_format_typical(struct text_state *state, const struct column *column)
{
    double values[ROWS_LOOKED_AT];
    size_t count = 0;
    for (size_t i = 0; i < state->kept_count; i++) {
        if (state->kept[i].row != NULL) {
            double value = fabs(row_number(state->kept[i].row, column));
            if (isfinite(value) && value > 0) {
                values[count++] = value;
            }
        }
    }
    return readable_median(values, count);
}

static void text_format_choose_units(struct report *report)
{
    struct text_state *state = report->state;
    int places = -1;
    for (size_t i = 0; i < report->shown_count; i++) {
        const struct shown *shown = &report->shown[i];
        /* only lengths have units that follow their sizes */
        const bool follows =
            shown->column->type == COLUMN_NUMBER && shown->column->dimension == &dimension_length;
        double size = follows ? text_format_typical(state, shown->column) : (double)NAN;
        state->units[i] = readable_unit(shown, report->units, size);
        int own = readable_inch_places(shown, state->units[i], size,
                                       text_format_digits_of(report, shown->column));
        places = own > places ? own : places;
        state->is_empty[i] = true;
        for (size_t k = 0; k < state->kept_count && state->is_empty[i]; k++) {
            const void *row = state->kept[k].row;
            state->is_empty[i] = row == NULL || row_is_absent(row, shown->column);
        }
    }
    for (size_t i = 0; i < report->shown_count; i++) {
        report->shown[i].inch_places = places + 1; /* one form of feet and inches */
    }
}

/* Given     rows  so many are to follow the head */
static struct grid new_grid(struct report *report, size_t rows, struct arena *arena)
{
    struct text_state *state = report->state;
    const size_t columns = report->passed_count + report->shown_count + state->has_failures;
    bool has_units = false;
    for (size_t i = 0; i < report->shown_count; i++) {
        const char *unit = readable_unit_label(&report->shown[i], state->units[i]);
        has_units = has_units || unit[0] != '\0';
    }
    struct grid grid = grid_new(arena, columns, has_units ? 2 : 1);
    grid.capacity = grid.head_rows + rows;
    grid.cells = ARENA_ARRAY(arena, grid.capacity * columns, char *);
    grid_add_row(&grid);
    for (size_t i = 0; i < report->passed_count; i++) {
        grid_set(
            &grid, i,
            arena_string(arena, report->passed_names[i].start, report->passed_names[i].length));
    }
    for (size_t i = 0; i < report->shown_count; i++) {
        const struct column *column = report->shown[i].column;
        char *name = arena_string(arena, column->name, strlen(column->name));
        for (char *at = name; *at != '\0'; at++) {
            *at = *at == '_' ? ' ' : *at;
        }
        grid_set(&grid, report->passed_count + i,
                 text_has_head(report, column) ? column->head : name);
        grid.left[report->passed_count + i] = column->type == COLUMN_TEXT;
    }
    if (state->has_failures) {
        grid_set(&grid, grid.columns - 1, "error");
        grid.left[grid.columns - 1] = true;
    }
    if (grid.head_rows == 2) {
        grid_add_row(&grid);
    }
    for (size_t i = 0; i < report->shown_count && grid.head_rows == 2; i++) {
        grid_set(&grid, report->passed_count + i,
                 readable_unit_label(&report->shown[i], state->units[i]));
    }
    return grid;
}

static void text_format_add_row(struct report *report, struct grid *grid, const void *row,
                                const struct passed_cell *passed, const char *failure)
{
    const struct text_state *state = report->state;
    grid_add_row(grid);
    for (size_t i = 0; i < report->passed_count; i++) {
        grid_set(grid, i, arena_string(grid->arena, passed[i].text.start, passed[i].text.length));
    }
    for (size_t i = 0; i < report->shown_count && row != NULL; i++) {
        const struct column *column = report->shown[i].column;
        const bool is_dash = report->are_named && state->is_empty[i] && row_is_absent(row, column);
        const char *cell = readable_words(grid->arena, row, &report->shown[i], state->units[i],
                                          text_format_digits_of(report, column));
        grid_set(grid, report->passed_count + i, is_dash ? "-" : cell);
    }
    if (failure != NULL && state->has_failures) {
        grid_set(grid, grid->columns - 1, failure);
    }
}

/* Does the format keep within the width of a terminal, and is there one? */
static bool has_width(const struct report *report)
{
    return report->format == &format_text && report->output->width > 0;
}

/* Several rows: a table with names and units in its head. */
static void write_table(struct report *report)
{
    struct text_state *state = report->state;
    struct grid grid = new_grid(report, state->kept_count, report->arena);
    for (size_t i = 0; i < state->kept_count; i++) {
        const struct kept *kept = &state->kept[i];
        text_format_add_row(report, &grid, kept->row, kept->passed, kept->failure);
    }
    if (has_width(report)) {
        /*
         * What stays of a table that is wider than the terminal: its first column, what was asked
         * for by name, and why rows failed; then what stands further left. Columns that are only
         * passed through go first.
         */
        size_t *least = ARENA_ARRAY(report->arena, grid.columns, size_t);
        size_t *rank = ARENA_ARRAY(report->arena, grid.columns, size_t);
        for (size_t j = 1; j < grid.columns; j++) {
            bool passed = j < report->passed_count;
            bool is_error = state->has_failures && j + 1 == grid.columns;
            bool stays = is_error || (!passed && report->are_named);
            const size_t after = passed ? grid.columns + j : j;
            rank[j] = stays ? 0 : after;
        }
        grid_fit(&grid, report->output->width, least, rank);
        state->widths = grid.widths;
        state->hidden = grid.hidden;
    } else {
        state->widths = ARENA_ARRAY(report->arena, grid.columns, size_t);
        grid_make_printable(&grid);
        grid.is_printable = true;
        grid_measure(&grid, state->widths);
        grid.measured = state->widths;
    }
    grid.title = report->title;
    state->laid_out = grid.rows - grid.head_rows;
    report->format->write_grid(&grid, report->output, true);
}

/* One answer: a line for each quantity, in words. */
static void write_list(struct report *report)
{
    struct text_state *state = report->state;
    const bool with_head = report->format == &format_markdown; /* it has no tables without */
    size_t least[3] = {0}, rank[3] = {0};
    struct grid grid = grid_new(report->arena, 3, with_head);
    grid.left[0] = grid.left[2] = true;
    if (with_head) {
        grid_add_row(&grid);
        grid_set(&grid, 0, "quantity");
        grid_set(&grid, 1, "value");
        grid_set(&grid, 2, "unit");
    }
    for (size_t i = 0; i < report->shown_count; i++) {
        const struct shown *shown = &report->shown[i];
        const struct column *column = shown->column;
        if (state->is_empty[i] && !report->are_named) {
            continue;
        }
        /* a quantity in words, its value and unit; of an absent one, when it would have a value */
        grid_add_row(&grid);
        grid_set(&grid, 0, column_label(column));
        if (state->is_empty[i]) {
            grid_set(&grid, 1, "-");
            grid_set(&grid, 2, report_absence(report, column));
            continue;
        }
        const char *cell = readable_words(grid.arena, state->kept[0].row, shown, state->units[i],
                                          text_format_digits_of(report, column));
        if (column->type == COLUMN_NUMBER && strlen(cell) > least[1]) {
            least[1] = strlen(cell); /* words may go on in another line */
        }
        const char *unit = readable_unit_label(shown, state->units[i]);
        /* "1/125 s" has its unit where the others have theirs; "2 min 30 s" stays in one piece */
        const char *blank = strchr(cell, ' ');
        if (column->dimension == &dimension_time && blank != NULL && strcmp(blank, " s") == 0) {
            cell = arena_string(grid.arena, cell, (size_t)(blank - cell));
            unit = "s";
        }
        grid_set(&grid, 1, cell);
        grid_set(&grid, 2, strcmp(unit, "ft in") == 0 ? "" : unit);
    }
    if (has_width(report)) {
        grid_fit(&grid, report->output->width, least, rank);
    }
    grid.title = report->title;
    state->laid_out = grid.rows - grid.head_rows;
    report->format->write_grid(&grid, report->output, true);
}

static void write_kept(struct report *report)
{
    struct text_state *state = report->state;
    text_format_choose_units(report);
    /* Extras and sparse columns that no row has are shown where they are named only. */
    size_t kept = 0;
    for (size_t i = 0; i < report->shown_count; i++) {
        const unsigned flags = report->shown[i].column->flags;
        if (state->is_empty[i] && !report->are_named &&
            (flags & (COLUMN_EXTRA | COLUMN_SPARSE)) != 0) {
            continue;
        }
        report->shown[kept] = report->shown[i];
        state->units[kept] = state->units[i];
        state->is_empty[kept++] = state->is_empty[i];
    }
    report->shown_count = kept;
    if (text_is_list(report)) {
        write_list(report);
    } else {
        write_table(report);
    }
    state->has_layout = true;
}

static void text_begin(struct report *report)
{
    struct text_state *state = ARENA_NEW(report->arena, struct text_state);
    state->kept = arena_buffer_array(report->arena, ROWS_LOOKED_AT, sizeof *state->kept);
    state->units = ARENA_ARRAY(report->arena, report->shown_count + 1, const struct unit *);
    state->is_empty = ARENA_ARRAY(report->arena, report->shown_count + 1, bool);
    report->state = state;
    if (report->format == &format_html) {
        grid_html_begin(report->output, report->command);
    }
}

/* Why a row failed: in plain text below it, else below the table, which has only rows. */
static void text_write_failure(struct report *report, const char *message)
{
    if (report->format != &format_text) {
        warnings_add(report->doubts, "a row failed: %s", message);
        return;
    }
    output_styled(report->output, STYLE_ERROR, "error:");
    output_printf(report->output, " %s\n", message);
}

static void text_row(struct report *report, const void *row, const struct passed_cell *passed,
                     const struct error *failure)
{
    struct text_state *state = report->state;
    if (state->has_layout) {
        struct arena_mark mark = arena_mark(&state->scratch);
        struct grid grid = new_grid(report, 1, &state->scratch);
        if (has_width(report)) {
            grid.widths = state->widths;
            grid.hidden = state->hidden;
        } else {
            memcpy(grid.least_width, state->widths, grid.columns * sizeof grid.least_width[0]);
        }
        text_format_add_row(report, &grid, row, passed, failure != NULL ? failure->message : NULL);
        report->format->write_grid(&grid, report->output, false);
        if (failure != NULL && !state->has_failures) { /* there is no column for it */
            text_write_failure(report, failure->message);
        }
        arena_reset(&state->scratch, mark);
        return;
    }
    text_format_keep(report, row, passed, failure);
    if (state->kept_count == ROWS_LOOKED_AT) {
        write_kept(report);
    }
}

static void text_end(struct report *report)
{
    struct text_state *state = report->state;
    if (!state->has_layout && (state->kept_count > 0 || report->many)) {
        write_kept(report);
    }
    if (report->format == &format_html && state->has_layout) {
        grid_html_close(NULL, report->output);
    }
    if (report->format == &format_latex && state->has_layout) {
        grid_latex_close(NULL, state->laid_out, report->output);
    }
    text_write_below(report);
    const bool keeps_lines = report->format == &format_text || report->format == &format_markdown;
    if (report->explain != NULL && keeps_lines) {
        /* formulas keep their lines */
        output_character(report->output, '\n');
        const char *text = grid_printable(report->arena, report->explain);
        bool escaped = report->format == &format_markdown;
        output_string(report->output, escaped ? grid_markdown_text(report->arena, text) : text);
        output_character(report->output, '\n');
    } else {
        text_write_line(report, report->explain);
    }
    if (report->format == &format_html) {
        grid_html_end(report->output);
    }
    arena_free(&state->scratch);
}

#define TEXT(grid_writer)                                                                          \
    .is_for_people = true, .write_grid = (grid_writer), .begin = text_begin, .row = text_row,      \
    .end = text_end

const struct format format_text = {{"text", "aligned table with units"}, TEXT(grid_write_text)};
const struct format format_markdown = {
    {"markdown", "table for a document"}, .has_lists = true, TEXT(grid_write_markdown)};
const struct format format_latex = {{"latex", "table with booktabs for a LaTeX document"},
                                    TEXT(grid_write_latex)};
const struct format format_html = {{"html", "page for printing"}, TEXT(grid_write_html)};
