/* report/grid.h - cells of text in rows and columns, printed as text, markdown, html or csv. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_GRID_H
#define LENSCALC_REPORT_GRID_H

#include "report/report.h"

/* A table of strings. Head rows come first; null cells are empty. */
struct grid {
    struct arena *arena;
    size_t columns, rows, capacity, head_rows;
    const char **cells;  /* rows x columns */
    bool *left;          /* one a column: align left (words), not right (numbers) */
    size_t *least_width; /* one a column: print at least this wide */
    const char *title;   /* above; null = none */
    const char *note;    /* below; null = none */
};

struct grid grid_new(struct arena *arena, size_t columns, size_t head_rows);

/* Begin a row; its cells are set with grid_set in any order. */
void grid_add_row(struct grid *grid);

/* Set a cell of the last row; the string is copied. */
void grid_set(struct grid *grid, size_t column, const char *string);

/* Widths as printed (in characters, not bytes), one a column, at least least_width. */
void grid_measure(const struct grid *grid, size_t *widths);

/* Print in one of the formats that people or spreadsheets read. */
void grid_write_text(const struct grid *grid, struct output *output, bool with_head);
void grid_write_markdown(const struct grid *grid, struct output *output, bool with_head);
void grid_write_html(const struct grid *grid, struct output *output, bool with_head);
void grid_write_separated(const struct grid *grid, struct output *output, char separator);

/* A whole HTML page around tables: written first and last. */
void grid_html_begin(struct output *output, const char *title);
void grid_html_end(struct output *output);

/* End a table of grid_write_html, with the note of its grid (may be null) below. */
void grid_html_close(const struct grid *grid, struct output *output);

/* One line of text in an HTML page. */
void grid_html_paragraph(struct output *output, const char *text);

#endif
