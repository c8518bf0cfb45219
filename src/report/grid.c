/* report/grid.c - cells of text in rows and columns, printed as text, markdown, html or csv. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"

#include <string.h>

enum { NOTE_WIDTH = 79 };

struct grid grid_new(struct arena *arena, size_t columns, size_t head_rows)
{
    struct grid grid = {.arena = arena, .columns = columns, .head_rows = head_rows};
    grid.left = ARENA_ARRAY(arena, columns, bool);
    grid.least_width = ARENA_ARRAY(arena, columns, size_t);
    return grid;
}

void grid_add_row(struct grid *grid)
{
    if (grid->rows == grid->capacity) {
        size_t capacity = grid->capacity == 0 ? 16 : 2 * grid->capacity;
        const char **cells = ARENA_ARRAY(grid->arena, capacity * grid->columns, const char *);
        if (grid->rows > 0) {
            memcpy(cells, grid->cells, grid->rows * grid->columns * sizeof *cells);
        }
        grid->cells = cells;
        grid->capacity = capacity;
    }
    grid->rows++;
}

void grid_set(struct grid *grid, size_t column, const char *string)
{
    grid->cells[(grid->rows - 1) * grid->columns + column] =
        arena_string(grid->arena, string, strlen(string));
}

static const char *cell(const struct grid *grid, size_t row, size_t column)
{
    const char *string = grid->cells[row * grid->columns + column];
    return string != NULL ? string : "";
}

/* Characters on the screen: UTF-8 continuation bytes take no room. */
static size_t width_of(const char *string)
{
    size_t width = 0;
    for (; *string != '\0'; string++) {
        width += ((unsigned char)*string & 0xc0) != 0x80;
    }
    return width;
}

void grid_measure(const struct grid *grid, size_t *widths)
{
    for (size_t j = 0; j < grid->columns; j++) {
        widths[j] = grid->least_width[j];
        for (size_t i = 0; i < grid->rows; i++) {
            size_t width = width_of(cell(grid, i, j));
            widths[j] = width > widths[j] ? width : widths[j];
        }
    }
}

static size_t *measured(const struct grid *grid)
{
    size_t *widths = ARENA_ARRAY(grid->arena, grid->columns, size_t);
    grid_measure(grid, widths);
    return widths;
}

/* One cell padded to its width; nothing behind the last cell of a line. */
static void write_padded(struct output *output, const char *string, size_t width, bool left,
                         bool last)
{
    size_t blanks = width - width_of(string);
    if (!left) {
        output_spaces(output, blanks);
    }
    output_string(output, string);
    if (left && !last) {
        output_spaces(output, blanks);
    }
}

/* Is everything from this column on empty? */
static bool is_tail_empty(const struct grid *grid, size_t row, size_t column)
{
    for (; column < grid->columns; column++) {
        if (cell(grid, row, column)[0] != '\0') {
            return false;
        }
    }
    return true;
}

void grid_write_text(const struct grid *grid, struct output *output, bool with_head)
{
    const size_t *widths = measured(grid);
    if (grid->title != NULL && with_head) {
        output_printf(output, "%s\n\n", grid->title);
    }
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        for (size_t j = 0; j < grid->columns && !is_tail_empty(grid, i, j); j++) {
            output_string(output, j > 0 ? "  " : "");
            write_padded(output, cell(grid, i, j), widths[j], grid->left[j],
                         is_tail_empty(grid, i, j + 1));
        }
        output_character(output, '\n');
    }
    if (grid->note != NULL) {
        output_character(output, '\n');
        output_wrapped(output, grid->note, NOTE_WIDTH);
    }
}

/* The head of one column in one cell: its rows joined. */
static const char *joined_head(const struct grid *grid, size_t column)
{
    const char *head = "";
    for (size_t i = 0; i < grid->head_rows; i++) {
        const char *part = cell(grid, i, column);
        if (part[0] != '\0') {
            head = head[0] == '\0' ? part : arena_printf(grid->arena, "%s (%s)", head, part);
        }
    }
    return head;
}

/* A pipe or a backslash would end or change a markdown cell. */
static void write_markdown_cell(struct output *output, const char *string)
{
    for (; *string != '\0'; string++) {
        if (*string == '|' || *string == '\\') {
            output_character(output, '\\');
        }
        output_character(output, *string);
    }
}

static void write_markdown_row(const struct grid *grid, struct output *output, size_t row)
{
    output_character(output, '|');
    for (size_t j = 0; j < grid->columns; j++) {
        output_character(output, ' ');
        write_markdown_cell(output,
                            row < grid->head_rows ? joined_head(grid, j) : cell(grid, row, j));
        output_string(output, " |");
    }
    output_character(output, '\n');
}

/* Names, and the line under them that sets the alignment. */
static void write_markdown_head(const struct grid *grid, struct output *output)
{
    if (grid->title != NULL) {
        output_printf(output, "**%s**\n\n", grid->title);
    }
    write_markdown_row(grid, output, 0);
    output_character(output, '|');
    for (size_t j = 0; j < grid->columns; j++) {
        output_string(output, grid->left[j] ? " :--- |" : " ---: |");
    }
    output_character(output, '\n');
}

void grid_write_markdown(const struct grid *grid, struct output *output, bool with_head)
{
    if (with_head) {
        write_markdown_head(grid, output);
    }
    for (size_t i = grid->head_rows; i < grid->rows; i++) {
        write_markdown_row(grid, output, i);
    }
    if (grid->note != NULL) {
        output_printf(output, "\n%s\n", grid->note);
    }
}

static void write_html(struct output *output, const char *string)
{
    for (; *string != '\0'; string++) {
        switch (*string) {
        case '&':
            output_string(output, "&amp;");
            break;
        case '<':
            output_string(output, "&lt;");
            break;
        case '>':
            output_string(output, "&gt;");
            break;
        default:
            output_character(output, *string);
        }
    }
}

void grid_html_begin(struct output *output, const char *title)
{
    output_string(output, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                          "<title>");
    write_html(output, title);
    output_string(output,
                  "</title>\n<style>\n"
                  "body { font-family: Helvetica, Arial, sans-serif; margin: 2em; }\n"
                  "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
                  "caption { text-align: left; font-weight: bold; padding-bottom: 0.6em; }\n"
                  "th, td { padding: 0.2em 0.8em; text-align: right; }\n"
                  "thead tr:last-child th { border-bottom: 1px solid; }\n"
                  "tbody tr:nth-child(even) { background: #f2f2f2; }\n"
                  ".w { text-align: left; }\n"
                  "@media print { body { margin: 0; } }\n"
                  "</style>\n</head>\n<body>\n");
}

void grid_html_end(struct output *output)
{
    output_string(output, "</body>\n</html>\n");
}

void grid_html_paragraph(struct output *output, const char *text)
{
    output_string(output, "<p>");
    write_html(output, text);
    output_string(output, "</p>\n");
}

static void write_html_row(const struct grid *grid, struct output *output, size_t row)
{
    const char *tag = row < grid->head_rows ? "th" : "td";
    output_string(output, "<tr>");
    for (size_t j = 0; j < grid->columns; j++) {
        output_printf(output, "<%s%s>", tag, grid->left[j] ? " class=\"w\"" : "");
        write_html(output, cell(grid, row, j));
        output_printf(output, "</%s>", tag);
    }
    output_string(output, "</tr>\n");
}

void grid_write_html(const struct grid *grid, struct output *output, bool with_head)
{
    if (with_head) {
        output_string(output, "<table>\n");
    }
    if (with_head && grid->title != NULL) {
        output_string(output, "<caption>");
        write_html(output, grid->title);
        output_string(output, "</caption>\n");
    }
    output_string(output, with_head ? "<thead>\n" : "");
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        if (i == grid->head_rows && with_head) {
            output_string(output, "</thead>\n<tbody>\n");
        }
        write_html_row(grid, output, i);
    }
    output_string(output, grid->rows == grid->head_rows ? "</thead>\n<tbody>\n" : "");
}

void grid_html_close(const struct grid *grid, struct output *output)
{
    output_string(output, "</tbody>\n</table>\n");
    if (grid != NULL && grid->note != NULL) {
        grid_html_paragraph(output, grid->note);
    }
}

static void write_quoted(struct output *output, const char *string, char separator)
{
    if (strchr(string, separator) == NULL && strchr(string, '"') == NULL) {
        output_string(output, string);
        return;
    }
    output_character(output, '"');
    for (; *string != '\0'; string++) {
        output_string(output, *string == '"' ? "\"" : "");
        output_character(output, *string);
    }
    output_character(output, '"');
}

void grid_write_separated(const struct grid *grid, struct output *output, char separator)
{
    for (size_t i = 0; i < grid->rows; i++) {
        for (size_t j = 0; j < grid->columns; j++) {
            if (j > 0) {
                output_character(output, separator);
            }
            write_quoted(output, cell(grid, i, j), separator);
        }
        output_character(output, '\n');
    }
}
