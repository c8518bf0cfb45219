/* report/grid.c - cells of text in rows and columns, printed as text, markdown, html or csv. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"

#include <string.h>

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
        char **cells = ARENA_ARRAY(grid->arena, capacity * grid->columns, char *);
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

void grid_make_printable(const struct grid *grid)
{
    for (size_t i = 0; i < grid->rows * grid->columns && !grid->is_printable; i++) {
        if (grid->cells[i] != NULL) {
            text_make_printable(grid->cells[i], "");
        }
    }
}

const char *grid_printable(struct arena *arena, const char *text)
{
    char *copy = text != NULL ? arena_string(arena, text, strlen(text)) : NULL;
    if (copy != NULL) {
        text_make_printable(copy, "\n");
    }
    return copy;
}

const char *grid_cell(const struct grid *grid, size_t row, size_t column)
{
    const char *string = grid->cells[row * grid->columns + column];
    return string != NULL ? string : "";
}

const char *grid_markdown_text(struct arena *arena, const char *string)
{
    char *text = arena_array(arena, 2 * strlen(string) + 1, 1), *to = text;
    for (; *string != '\0'; string++) {
        if (strchr("|\\<[]", *string) != NULL) {
            *to++ = '\\';
        }
        *to++ = *string;
    }
    return text;
}

static void write_markdown_row(const struct grid *grid, struct output *output, size_t row)
{
    output_character(output, '|');
    for (size_t j = 0; j < grid->columns; j++) {
        output_character(output, ' ');
        const char *text = row < grid->head_rows ? "" : grid_cell(grid, row, j);
        /* the head of one column in one cell: its rows joined */
        for (size_t i = row; i < grid->head_rows; i++) {
            const char *part = grid_cell(grid, i, j);
            if (part[0] != '\0') {
                text = text[0] == '\0' ? part : arena_printf(grid->arena, "%s (%s)", text, part);
            }
        }
        output_string(output, grid_markdown_text(grid->arena, text));
        output_string(output, " |");
    }
    output_character(output, '\n');
}

void grid_write_markdown(const struct grid *grid, struct output *output, bool with_head)
{
    grid_make_printable(grid);
    if (with_head) {
        /* Names, and the line under them that sets the alignment. */
        if (grid->title != NULL) {
            output_string(output, "**");
            output_string(
                output, grid_markdown_text(grid->arena, grid_printable(grid->arena, grid->title)));
            output_string(output, "**\n\n");
        }
        write_markdown_row(grid, output, 0);
        output_character(output, '|');
        for (size_t j = 0; j < grid->columns; j++) {
            output_string(output, grid->left[j] ? " :--- |" : " ---: |");
        }
        output_character(output, '\n');
    }
    for (size_t i = grid->head_rows; i < grid->rows; i++) {
        write_markdown_row(grid, output, i);
    }
    if (grid->note != NULL) {
        output_character(output, '\n');
        output_string(output,
                      grid_markdown_text(grid->arena, grid_printable(grid->arena, grid->note)));
        output_character(output, '\n');
    }
}

enum { UPRIGHT = 14 }; /* columns */

void grid_html_begin(struct output *output, const char *title)
{
    output_string(output, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                          "<title>");
    output_escaped(output, text_of(title));
    output_string(output,
                  "</title>\n<style>\n"
                  "body { font-family: Helvetica, Arial, sans-serif; margin: 2em; }\n"
                  "table { border-collapse: collapse; font-variant-numeric: tabular-nums; }\n"
                  "caption { text-align: left; font-weight: bold; padding-bottom: 0.6em; }\n"
                  "th, td { padding: 0.2em 0.8em; text-align: right; }\n"
                  "thead tr:last-child th { border-bottom: 1px solid; }\n"
                  "tbody tr:nth-child(even) { background: #f2f2f2; }\n"
                  ".w { text-align: left; }\n"
                  "thead { display: table-header-group; }\n"
                  "tr { break-inside: avoid; }\n"
                  "@page { margin: 15mm; }\n"
                  "@page many { size: landscape; margin: 10mm; }\n"
                  "@media print {\n"
                  "body { margin: 0; font-size: 9pt; }\n"
                  "th, td { padding: 0.15em 0.5em; }\n"
                  ".w { overflow-wrap: anywhere; }\n"
                  "tbody tr { border-bottom: 1px solid #ddd; }\n"
                  "body:has(.many) { page: many; }\n"
                  ".many { font-size: 6.5pt; }\n"
                  ".many th, .many td { padding: 0.15em 0.25em; }\n"
                  ".many .w { overflow-wrap: normal; }\n"
                  "}\n"
                  "</style>\n</head>\n<body>\n");
}

void grid_html_end(struct output *output)
{
    output_string(output, "</body>\n</html>\n");
}

void grid_html_paragraph(struct output *output, const char *text)
{
    output_string(output, "<p>");
    output_escaped(output, text_of(text));
    output_string(output, "</p>\n");
}

void grid_write_html(const struct grid *grid, struct output *output, bool with_head)
{
    grid_make_printable(grid);
    if (with_head) {
        /* more than a page has room for upright */
        output_string(output, grid->columns > UPRIGHT ? "<table class=\"many\">\n" : "<table>\n");
    }
    if (with_head && grid->title != NULL) {
        output_string(output, "<caption>");
        output_escaped(output, text_of(grid_printable(grid->arena, grid->title)));
        output_string(output, "</caption>\n");
    }
    bool has_head = with_head && grid->head_rows > 0;
    if (with_head) {
        output_string(output, has_head ? "<thead>\n" : "<tbody>\n");
    }
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        if (i == grid->head_rows && has_head) {
            output_string(output, "</thead>\n<tbody>\n");
        }
        const char *tag = i < grid->head_rows ? "th" : "td";
        output_string(output, "<tr>");
        for (size_t j = 0; j < grid->columns; j++) {
            output_printf(output, "<%s%s>", tag, grid->left[j] ? " class=\"w\"" : "");
            output_escaped(output, text_of(grid_cell(grid, i, j)));
            output_printf(output, "</%s>", tag);
        }
        output_string(output, "</tr>\n");
    }
    output_string(output, has_head && grid->rows == grid->head_rows ? "</thead>\n<tbody>\n" : "");
}

void grid_html_close(const struct grid *grid, struct output *output)
{
    output_string(output, "</tbody>\n</table>\n");
    if (grid != NULL && grid->note != NULL) {
        grid_html_paragraph(output, grid_printable(grid->arena, grid->note));
    }
}

void grid_write_separated(const struct grid *grid, struct output *output, char separator,
                          bool with_head)
{
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        for (size_t j = 0; j < grid->columns; j++) {
            if (j > 0) {
                output_character(output, separator);
            }
            const char *string = grid_cell(grid, i, j);
            if (strchr(string, separator) == NULL && strchr(string, '"') == NULL) {
                output_string(output, string);
                continue;
            }
            output_character(output, '"');
            for (; *string != '\0'; string++) {
                output_string(output, *string == '"' ? "\"" : "");
                output_character(output, *string);
            }
            output_character(output, '"');
        }
        output_character(output, '\n');
    }
}
