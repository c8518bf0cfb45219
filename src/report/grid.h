/* report/grid.h - cells of text in rows and columns, printed as text, markdown, latex, html, csv. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_GRID_H
#define LENSCALC_REPORT_GRID_H

#include "report/report.h"

/* A table of strings. Head rows come first; null cells are empty. */
struct grid {
    struct arena *arena;
    size_t columns, rows, capacity, head_rows;
    char **cells;           /* rows x columns */
    bool is_printable;      /* to be set behind grid_make_printable, which then has nothing to do */
    bool *left;             /* one a column: align left (words), not right (numbers) */
    size_t *least_width;    /* one a column: print at least this wide */
    const size_t *measured; /* by grid_measure, of printable cells; null: not yet */
    /* Of a terminal, one a column, by grid_fit; null = as wide as the widest cell, all shown. */
    size_t *widths;    /* longer words go on in another line */
    bool *hidden;      /* left out */
    bool in_blocks;    /* a table too wide for the terminal goes on below, its first column again */
    const char *title; /* above; null = none */
    const char *note;  /* below; null = none */
};

struct grid grid_new(struct arena *arena, size_t columns, size_t head_rows);

/* Begin a row; its cells are set with grid_set in any order. */
void grid_add_row(struct grid *grid);

/* Set a cell of the last row; the string is copied. */
void grid_set(struct grid *grid, size_t column, const char *string);

/* A cell; "" if it was not set. */
const char *grid_cell(const struct grid *grid, size_t row, size_t column);

/* Put '?' in the place of what must not reach a terminal, in all cells. */
void grid_make_printable(const struct grid *grid);

/* A copy of a text with '?' there; line feeds stay; null stays null. */
const char *grid_printable(struct arena *arena, const char *text);

/* Widths as printed (in characters, not bytes), one a column, at least least_width. */
void grid_measure(const struct grid *grid, size_t *widths);

/*
 * Make a grid as narrow as a terminal: long words go on in further lines, then columns are left
 * out. Sets widths and hidden.
 *
 * Given     width  of the terminal
 *           least  one a column: no narrower than this; 0 = as its words and numbers allow
 *           rank   one a column: the highest is left out first; 0 = never
 * Result    how many are left out
 */
size_t grid_fit(struct grid *grid, size_t width, const size_t *least, const size_t *rank);

/* Print in one of the formats that people or spreadsheets read. */
void grid_write_text(const struct grid *grid, struct output *output, bool with_head);
void grid_write_markdown(const struct grid *grid, struct output *output, bool with_head);
void grid_write_html(const struct grid *grid, struct output *output, bool with_head);
void grid_write_latex(const struct grid *grid, struct output *output, bool with_head);
void grid_write_separated(const struct grid *grid, struct output *output, char separator,
                          bool with_head);

/* Text that means nothing but itself in Markdown: no end of a cell, no HTML, no link. */
const char *grid_markdown_text(struct arena *arena, const char *string);

/* Text below a table of LaTeX, with no commands of it; its lines stay lines. */
void grid_latex_paragraph(struct arena *arena, struct output *output, const char *text);

/* End a table that grid_write_latex began with so many rows behind the head, with the note of its
   grid (may be null) below. */
void grid_latex_close(const struct grid *grid, size_t rows, struct output *output);

/* A whole HTML page around tables: written first and last. */
void grid_html_begin(struct output *output, const char *title);
void grid_html_end(struct output *output);

/* End a table of grid_write_html, with the note of its grid (may be null) below. */
void grid_html_close(const struct grid *grid, struct output *output);

/* One line of text in an HTML page. */
void grid_html_paragraph(struct output *output, const char *text);

#endif
