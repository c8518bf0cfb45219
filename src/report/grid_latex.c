/* report/grid_latex.c - cells of text in rows and columns as a tabular of LaTeX, with booktabs. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"

#include <string.h>

/* What means something to LaTeX, or is another sign or none in its usual fonts. */
static const struct latex_sign {
    const char *sign; /* UTF-8 */
    const char *written;
} latex_signs[] = {
    {"\\", "\\textbackslash{}"},
    {"{", "\\{"},
    {"}", "\\}"},
    {"$", "\\$"},
    {"&", "\\&"},
    {"#", "\\#"},
    {"_", "\\_"},
    {"%", "\\%"},
    {"~", "\\textasciitilde{}"},
    {"^", "\\textasciicircum{}"},
    {"<", "\\textless{}"},
    {">", "\\textgreater{}"},
    {"|", "\\textbar{}"},
    /* the end of a line before takes these for its own arguments */
    {"[", "{[}"},
    {"*", "{*}"},
    {"\xce\xbc", "\\ensuremath{\\mu}"},
    {"\xe2\x80\xb2", "\\ensuremath{'}"},
    {"\xe2\x80\xb3", "\\ensuremath{''}"},
    {"\xe2\x81\xb4", "\\ensuremath{^4}"},
    {"\xe2\x88\x9e", "\\ensuremath{\\infty}"},
    {"\xe2\x88\x92", "\\ensuremath{-}"},
    {"\xc6\x92", "\\textit f"},
};

/* LONGEST_SIGN: bytes written for one; PAGE: rows that surely fit on one. */
enum { LONGEST_SIGN = 19, PAGE = 40 };

static const struct latex_sign *latex_sign(const char *text)
{
    for (size_t i = 0; i < sizeof latex_signs / sizeof latex_signs[0]; i++) {
        if (strncmp(text, latex_signs[i].sign, strlen(latex_signs[i].sign)) == 0) {
            return &latex_signs[i];
        }
    }
    return NULL;
}

/* Text that means nothing but itself in LaTeX. */
static const char *grid_latex_text(struct arena *arena, const char *string)
{
    char *text = arena_array(arena, LONGEST_SIGN * strlen(string) + 1, 1), *to = text;
    while (*string != '\0') {
        const struct latex_sign *sign = latex_sign(string);
        if (sign == NULL) {
            *to++ = *string++;
            continue;
        }
        const size_t length = strlen(sign->written);
        memcpy(to, sign->written, length);
        to += length;
        string += strlen(sign->sign);
    }
    return text;
}

void grid_latex_paragraph(struct arena *arena, struct output *output, const char *text)
{
    output_character(output, '\n');
    for (; *text != '\0'; text++) {
        const char *stop = strchr(text, '\n');
        const size_t length = stop != NULL ? (size_t)(stop - text) : strlen(text);
        output_string(output, grid_latex_text(arena, arena_string(arena, text, length)));
        /* lines stay lines, but none can be ended that has not begun */
        if (stop != NULL && length > 0 && stop[1] != '\n' && stop[1] != '\0') {
            output_string(output, " \\\\");
        }
        output_character(output, '\n');
        text += length;
        if (stop == NULL) {
            break;
        }
    }
}

/* A hyphen before a number is a minus. */
static void write_latex_cell(const struct grid *grid, struct output *output, size_t row, size_t j)
{
    const char *text = grid_cell(grid, row, j);
    if (text[0] == '-' && text[1] != '\0' && !grid->left[j] && row >= grid->head_rows) {
        output_string(output, "$-$");
        text++;
    }
    output_string(output, grid_latex_text(grid->arena, text));
}

/* Longer than a page: a table in pieces, each with the head. */
static const char *latex_environment(size_t rows)
{
    return rows > PAGE ? "longtable" : "tabular";
}

void grid_write_latex(const struct grid *grid, struct output *output, bool with_head)
{
    grid_make_printable(grid);
    const size_t rows = grid->rows - grid->head_rows;
    const bool is_long = rows > PAGE;
    if (with_head) {
        output_string(output, is_long ? "% needs the packages booktabs and longtable\n"
                                      : "% needs the package booktabs\n");
        if (grid->title != NULL) {
            output_string(output, "\\noindent\\textbf{");
            output_string(output,
                          grid_latex_text(grid->arena, grid_printable(grid->arena, grid->title)));
            output_string(output, "}\n\n\\smallskip\n");
        }
        output_printf(output, "%s\\begin{%s}{", is_long ? "" : "\\noindent",
                      latex_environment(rows));
        for (size_t j = 0; j < grid->columns; j++) {
            output_character(output, grid->left[j] ? 'l' : 'r');
        }
        output_string(output, "}\n\\toprule\n");
    }
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        for (size_t j = 0; j < grid->columns; j++) {
            output_string(output, j > 0 ? " & " : "");
            write_latex_cell(grid, output, i, j);
        }
        output_string(output, " \\\\\n");
        if (i + 1 == grid->head_rows) {
            output_string(output, is_long ? "\\midrule\n\\endhead\n" : "\\midrule\n");
        }
    }
}

void grid_latex_close(const struct grid *grid, size_t rows, struct output *output)
{
    output_printf(output, "\\bottomrule\n\\end{%s}\n", latex_environment(rows));
    if (grid != NULL && grid->note != NULL) {
        grid_latex_paragraph(grid->arena, output, grid_printable(grid->arena, grid->note));
    }
}
