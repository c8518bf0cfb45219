/* report/grid_text.c - a grid as an aligned table, cut to the width of a terminal. */
/* SPDX-License-Identifier: MIT */
#include "report/grid.h"

#include <stdint.h>
#include <string.h>

enum { NOTE_WIDTH = 79, GAP = 2, NARROWEST_WORDS = 16 };

static bool continues(char c)
{
    return ((unsigned char)c & 0xc0) == 0x80;
}

/* Characters on the screen: UTF-8 continuation bytes take no room. */
static size_t width_of(struct text text)
{
    size_t width = 0;
    for (size_t i = 0; i < text.length; i++) {
        width += !continues(text.start[i]);
    }
    return width;
}

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

void grid_measure(const struct grid *grid, size_t *widths)
{
    for (size_t j = 0; j < grid->columns; j++) {
        widths[j] = grid->least_width[j];
        for (size_t i = 0; i < grid->rows; i++) {
            widths[j] = larger(widths[j], width_of(text_of(grid_cell(grid, i, j))));
        }
    }
}

/* -------- lines of one cell -------- */

/* Cut off what goes into the next line of a cell: whole words, or a part of one too long for it. */
static struct text grid_text_next_line(struct text *rest, size_t width)
{
    size_t at = 0, used = 0, blank = 0, most = larger(width, 1); /* each takes something */
    while (at < rest->length && (used < most || continues(rest->start[at]))) {
        used += !continues(rest->start[at]);
        blank = rest->start[at] == ' ' ? at : blank;
        at++;
    }
    struct text line = *rest;
    if (at < rest->length) {
        bool ends = rest->start[at] == ' ';
        line.length = ends || blank == 0 ? at : blank;
    }
    rest->start += line.length;
    rest->length -= line.length;
    while (rest->length > 0 && rest->start[0] == ' ') {
        rest->start++;
        rest->length--;
    }
    return line;
}

static size_t count_lines(struct text cell, size_t width)
{
    size_t count = 0;
    do {
        grid_text_next_line(&cell, width);
        count++;
    } while (cell.length > 0);
    return count;
}

/* -------- as narrow as the terminal -------- */

/* How narrow a column may be: heads break between words, and so do cells of words. */
static size_t grid_text_least_of(const struct grid *grid, size_t column, size_t width)
{
    size_t least = grid->left[column] && width > NARROWEST_WORDS ? NARROWEST_WORDS : 0;
    for (size_t i = 0; i < grid->rows; i++) {
        const char *string = grid_cell(grid, i, column);
        if (i < grid->head_rows) {
            /* The longest word of a text: where its lines may break. */
            struct text rest = text_of(string);
            size_t longest = 0;
            while (rest.start != NULL && rest.length > 0) {
                longest = larger(longest, width_of(text_cut(&rest, ' ')));
            }
            least = larger(least, longest);
        } else if (!grid->left[column] || width <= NARROWEST_WORDS) {
            least = larger(least, width_of(text_of(string)));
        }
    }
    return least < width ? least : width;
}

/* The widest column that is shown and wider than its bound; the count of columns: there is none. */
static size_t widest_above(const struct grid *grid, const size_t *bounds)
{
    size_t widest = grid->columns;
    for (size_t j = 0; j < grid->columns; j++) {
        bool can = !grid->hidden[j] && grid->widths[j] > bounds[j];
        if (can && (widest == grid->columns || grid->widths[j] > grid->widths[widest])) {
            widest = j;
        }
    }
    return widest;
}

/*
 * Take from the widest columns what is too much; false if it is not enough. As long as that will
 * do only heads are broken, which takes a line and not one a row.
 */
static bool grid_text_narrow(struct grid *grid, size_t width, const size_t *natural,
                             const size_t *least, const size_t *bodies)
{
    memcpy(grid->widths, natural, grid->columns * sizeof *natural);
    size_t total = 0;
    for (size_t j = 0; j < grid->columns; j++) {
        total += grid->hidden[j] ? 0 : grid->widths[j] + GAP;
    }
    for (total = total > 0 ? total - GAP : 0; total > width; total--) {
        size_t widest = widest_above(grid, bodies);
        widest = widest < grid->columns ? widest : widest_above(grid, least);
        if (widest == grid->columns) {
            return false;
        }
        grid->widths[widest]--;
    }
    return true;
}

size_t grid_fit(struct grid *grid, size_t width, const size_t *least, const size_t *rank)
{
    size_t *natural = ARENA_ARRAY(grid->arena, grid->columns, size_t);
    size_t *narrowest = ARENA_ARRAY(grid->arena, grid->columns, size_t);
    size_t *bodies = ARENA_ARRAY(grid->arena, grid->columns, size_t);
    size_t left_out = 0;
    grid->widths = ARENA_ARRAY(grid->arena, grid->columns, size_t);
    grid->hidden = ARENA_ARRAY(grid->arena, grid->columns, bool);
    grid_measure(grid, natural);
    for (size_t j = 0; j < grid->columns; j++) {
        narrowest[j] = least[j] > 0 ? least[j] : grid_text_least_of(grid, j, natural[j]);
        bodies[j] = narrowest[j];
        for (size_t i = grid->head_rows; i < grid->rows; i++) {
            bodies[j] = larger(bodies[j], width_of(text_of(grid_cell(grid, i, j))));
        }
    }
    while (!grid_text_narrow(grid, width, natural, narrowest, bodies)) {
        size_t last = grid->columns;
        for (size_t j = 0; j < grid->columns; j++) {
            if (!grid->hidden[j] && rank[j] > 0 &&
                (last == grid->columns || rank[j] > rank[last])) {
                last = j;
            }
        }
        if (last == grid->columns) {
            break; /* what must stay is too wide: lines run over */
        }
        grid->hidden[last] = true;
        left_out++;
    }
    return left_out;
}

/* -------- printing -------- */

static bool text_is_hidden(const struct grid *grid, size_t column)
{
    return grid->hidden != NULL && grid->hidden[column];
}

/* A line of the screen: the pieces of a row's cells. */
static void write_line(const struct grid *grid, struct output *output, const size_t *widths,
                       const struct text *pieces, enum style style)
{
    size_t behind = grid->columns; /* the last that says something */
    while (behind > 0 && (pieces[behind - 1].length == 0 || text_is_hidden(grid, behind - 1))) {
        behind--;
    }
    size_t gap = 0;
    if (style != STYLE_PLAIN) {
        output_style(output, style);
    }
    for (size_t j = 0; j < behind; j++) {
        if (text_is_hidden(grid, j)) {
            continue;
        }
        size_t used = width_of(pieces[j]), blanks = widths[j] > used ? widths[j] - used : 0;
        output_spaces(output, grid->left[j] ? gap : gap + blanks);
        output_text(output, pieces[j].start, pieces[j].length);
        if (grid->left[j] && j + 1 < behind) {
            output_spaces(output, blanks);
        }
        gap = GAP;
    }
    if (style != STYLE_PLAIN) {
        output_style(output, STYLE_PLAIN);
    }
    output_character(output, '\n');
}

/* Do the cells of this row in this column go on in further lines? */
static bool wraps(const struct grid *grid, size_t row, size_t column)
{
    return grid->widths != NULL && !text_is_hidden(grid, column) &&
           (row < grid->head_rows || grid->left[column]);
}

static void write_rows(const struct grid *grid, struct output *output, const size_t *widths,
                       bool with_head)
{
    struct text *pieces = ARENA_ARRAY(grid->arena, grid->columns + 1, struct text);
    for (size_t i = with_head ? 0 : grid->head_rows; i < grid->rows; i++) {
        size_t lines = 1;
        for (size_t j = 0; j < grid->columns; j++) {
            pieces[j] = text_of(grid_cell(grid, i, j));
            if (wraps(grid, i, j)) {
                lines = larger(lines, count_lines(pieces[j], widths[j]));
            }
        }
        for (size_t k = 0; k < lines; k++) {
            for (size_t j = 0; j < grid->columns && grid->widths != NULL; j++) {
                /* What line `k` of `lines` shows of a cell; heads stand on their rows. */
                struct text cell = text_of(grid_cell(grid, i, j));
                size_t width = wraps(grid, i, j) ? grid->widths[j] : SIZE_MAX;
                size_t own = count_lines(cell, width);
                size_t above = i < grid->head_rows ? lines - own : 0;
                pieces[j] = k < above ? (struct text){"", 0} : grid_text_next_line(&cell, width);
                for (size_t line = above; line < k; line++) {
                    pieces[j] =
                        cell.length > 0 ? grid_text_next_line(&cell, width) : (struct text){"", 0};
                }
            }
            write_line(grid, output, widths, pieces,
                       i < grid->head_rows ? STYLE_HEAD : STYLE_PLAIN);
        }
    }
}

/* As many columns at a time as the terminal shows, the first one in each block. */
static void write_blocks(const struct grid *grid, struct output *output, const size_t *widths)
{
    struct grid block = *grid;
    size_t first = 1;
    block.hidden = ARENA_ARRAY(grid->arena, grid->columns, bool);
    while (first < grid->columns) {
        size_t behind = first + 1, used = widths[0] + GAP + widths[first];
        while (behind < grid->columns && used + GAP + widths[behind] <= output->width) {
            used += GAP + widths[behind++];
        }
        for (size_t j = 1; j < grid->columns; j++) {
            block.hidden[j] = j < first || j >= behind;
        }
        output_string(output, first > 1 ? "\n" : "");
        write_rows(&block, output, widths, true);
        first = behind;
    }
}

void grid_write_text(const struct grid *grid, struct output *output, bool with_head)
{
    const size_t *widths = grid->widths != NULL ? grid->widths : grid->measured;
    grid_make_printable(grid);
    if (widths == NULL) {
        size_t *own = ARENA_ARRAY(grid->arena, grid->columns, size_t);
        grid_measure(grid, own);
        widths = own;
    }
    if (grid->title != NULL && with_head) {
        output_styled(output, STYLE_HEAD, grid_printable(grid->arena, grid->title));
        output_string(output, "\n\n");
    }
    if (grid->in_blocks && output->width > 0) {
        write_blocks(grid, output, widths);
    } else {
        write_rows(grid, output, widths, with_head);
    }
    if (grid->note != NULL) {
        output_character(output, '\n');
        output_wrapped(output, grid_printable(grid->arena, grid->note),
                       output->width > 0 ? output->width : NOTE_WIDTH);
    }
}
