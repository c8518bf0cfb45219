/* draw/terminal/cells.h - a grid of characters: Braille dots, letters and half blocks. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_CELLS_H
#define LENSCALC_DRAW_TERMINAL_CELLS_H

#include "base/arena.h"
#include "base/text.h"
#include "optics/growing.h"

#include <stdbool.h>
#include <stddef.h>

/* Which colours are written. */
enum cell_colours {
    CELL_PLAIN, /* none: characters alone */
    CELL_256,   /* the cube and the greys of xterm */
    CELL_TRUE   /* 24 bits */
};

/* Dots of a cell, across and down: U+2800 and on. */
enum { DOTS_ACROSS = 2, DOTS_DOWN = 4 };

struct cell_ink {
    bool is_set; /* else the terminal's own colour */
    unsigned char part[3];
};

struct cell {
    char letter[8]; /* a character, "" = none; it hides the dots */
    bool is_hidden; /* behind the left half of a wide character */
    bool is_bold, is_painted;
    unsigned char dots;
    struct cell_ink ink;              /* of letter and dots */
    unsigned char upper[3], lower[3]; /* of a painted cell: colours of its halves */
};

struct cells {
    size_t columns, rows;
    enum cell_colours colours;
    struct cell *all; /* rows from the top */
};

void cells_new(struct cells *cells, size_t columns, size_t rows, enum cell_colours colours,
               struct arena *arena);

/* What lies outside is no cell, and no dot. */
struct cell *cells_at(const struct cells *cells, long column, long row);

/* Set or clear one dot, counted from the upper left; `ink` null: as it is. */
void cells_dot(const struct cells *cells, long x, long y, bool is_set, const struct cell_ink *ink);

/*
 * Write a text from a cell on, character by character; what must not reach a terminal is '?', what
 * has no room is cut.
 */
void cells_write(const struct cells *cells, long column, long row, struct text words, bool is_bold,
                 const struct cell_ink *ink);

/* Are there neither letters in these cells, nor, with `dots`, anything else? Outside nothing is. */
bool cells_are_free(const struct cells *cells, long column, long row, long count, bool dots);

/* Lines of text, without blanks at their ends or lines without anything at the end. */
void cells_put(const struct cells *cells, struct text_buffer *lines);

#endif
