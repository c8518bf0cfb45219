/* draw/terminal/cells.c - a grid of characters: Braille dots, letters and half blocks. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/cells.h"

#include <stdlib.h>
#include <string.h>

void cells_new(struct cells *cells, size_t columns, size_t rows, enum cell_colours colours,
               struct arena *arena)
{
    *cells = (struct cells){.columns = columns, .rows = rows, .colours = colours};
    cells->all = ARENA_ARRAY(arena, columns * rows + 1, struct cell);
}

struct cell *cells_at(const struct cells *cells, long column, long row)
{
    const bool is_inside =
        column >= 0 && row >= 0 && (size_t)column < cells->columns && (size_t)row < cells->rows;
    return is_inside ? &cells->all[(size_t)row * cells->columns + (size_t)column] : NULL;
}

void cells_dot(const struct cells *cells, long x, long y, bool is_set, const struct cell_ink *ink)
{
    /* dots 1 to 8 of Braille: bits 0 to 7, two columns of three and a fourth row below */
    static const unsigned char bits[DOTS_DOWN][DOTS_ACROSS] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    struct cell *cell = x < 0 || y < 0 ? NULL : cells_at(cells, x / DOTS_ACROSS, y / DOTS_DOWN);
    if (cell == NULL) {
        return;
    }
    const unsigned char bit = bits[y % DOTS_DOWN][x % DOTS_ACROSS];
    cell->dots = (unsigned char)(is_set ? cell->dots | bit : cell->dots & ~bit);
    if (ink != NULL && ink->is_set) {
        cell->ink = *ink;
    }
}

void cells_write(const struct cells *cells, long column, long row, struct text words, bool is_bold,
                 const struct cell_ink *ink)
{
    while (words.length > 0) {
        const size_t bad = text_unprintable(words.start, words.length);
        const size_t whole = bad > 0 ? bad : text_utf8_length(words.start, words.length);
        const size_t step = whole > 0 ? whole : 1;
        const bool is_good = bad == 0 && whole > 0 && whole < sizeof cells->all->letter;
        const struct text letter = is_good ? (struct text){words.start, step} : text_of("?");
        const size_t wide = text_cells(letter);
        struct cell *cell = cells_at(cells, column, row);
        struct cell *next = wide == 2 ? cells_at(cells, column + 1, row) : cell;
        if (cell != NULL && next != NULL && wide > 0) {
            *cell = (struct cell){.is_bold = is_bold, .ink = *ink};
            memcpy(cell->letter, letter.start, letter.length);
            if (wide == 2) {
                *next = (struct cell){.is_hidden = true};
            }
        }
        column += (long)wide;
        words.start += step;
        words.length -= step;
    }
}

bool cells_are_free(const struct cells *cells, long column, long row, long count, bool dots)
{
    for (long i = column; i < column + count; i++) {
        const struct cell *cell = cells_at(cells, i, row);
        const bool has_letter =
            cell == NULL || cell->is_hidden || (cell->letter[0] != '\0' && cell->letter[0] != ' ');
        if (has_letter || (dots && (cell->dots != 0 || cell->is_painted))) {
            return false;
        }
    }
    return true;
}

/* -------- writing -------- */

/* The nearest colour of the cube of six levels, or grey, as xterm numbers them. */
static int cells_number_256(const unsigned char *part)
{
    static const int levels[] = {0, 95, 135, 175, 215, 255};
    int nearest[3], cube_error = 0, grey_error = 0;
    const int mean = (part[0] + part[1] + part[2]) / 3;
    int grey = (mean - 8 + 5) / 10;
    grey = grey < 0 ? 0 : grey;
    grey = grey > 23 ? 23 : grey;
    for (int k = 0; k < 3; k++) {
        nearest[k] = 0;
        for (int i = 1; i < 6; i++) {
            nearest[k] =
                abs(levels[i] - part[k]) < abs(levels[nearest[k]] - part[k]) ? i : nearest[k];
        }
        const int off = levels[nearest[k]] - part[k], off_grey = 8 + 10 * grey - part[k];
        cube_error += off * off;
        grey_error += off_grey * off_grey;
    }
    return grey_error < cube_error ? 232 + grey
                                   : 16 + 36 * nearest[0] + 6 * nearest[1] + nearest[2];
}

/* What the terminal was told last. */
struct cell_state {
    const struct cells *cells;
    struct text_buffer *lines;
    bool is_bold;
    struct cell_ink front, back;
};

static bool ink_is_same(const struct cell_ink *a, const struct cell_ink *b)
{
    return a->is_set == b->is_set && (!a->is_set || memcmp(a->part, b->part, sizeof a->part) == 0);
}

static void state_put_ink(const struct cell_state *state, int which, const struct cell_ink *ink)
{
    if (!ink->is_set) {
        growing_format(state->lines, "\033[%d9m", which);
    } else if (state->cells->colours == CELL_256) {
        growing_format(state->lines, "\033[%d8;5;%dm", which, cells_number_256(ink->part));
    } else {
        growing_format(state->lines, "\033[%d8;2;%d;%d;%dm", which, ink->part[0], ink->part[1],
                       ink->part[2]);
    }
}

/* Have the terminal write like this from here on. */
static void state_turn(struct cell_state *state, bool is_bold, struct cell_ink front,
                       struct cell_ink back)
{
    if (state->cells->colours == CELL_PLAIN) {
        return;
    }
    const bool ends = (state->is_bold && !is_bold) || (state->front.is_set && !front.is_set) ||
                      (state->back.is_set && !back.is_set);
    if (ends) {
        growing_string(state->lines, "\033[0m");
        *state = (struct cell_state){.cells = state->cells, .lines = state->lines};
    }
    if (is_bold && !state->is_bold) {
        growing_string(state->lines, "\033[1m");
    }
    if (!ink_is_same(&state->front, &front)) {
        state_put_ink(state, 3, &front);
    }
    if (!ink_is_same(&state->back, &back)) {
        state_put_ink(state, 4, &back);
    }
    state->is_bold = is_bold;
    state->front = front;
    state->back = back;
}

static struct cell_ink ink_of(const unsigned char *part)
{
    return (struct cell_ink){.is_set = true, .part = {part[0], part[1], part[2]}};
}

static bool cell_is_empty(const struct cell *cell)
{
    return !cell->is_hidden && !cell->is_painted && cell->dots == 0 &&
           (cell->letter[0] == '\0' || cell->letter[0] == ' ');
}

static void state_put_cell(struct cell_state *state, const struct cell *cell)
{
    static const struct cell_ink none = {.is_set = false};
    if (cell->is_hidden) {
        return;
    }
    if (cell_is_empty(cell)) {
        state_turn(state, state->is_bold, state->front, none); /* a blank shows its ground alone */
        growing_string(state->lines, " ");
    } else if (cell->letter[0] != '\0') {
        state_turn(state, cell->is_bold, cell->ink, none);
        growing_string(state->lines, cell->letter);
    } else if (cell->is_painted) {
        state_turn(state, false, ink_of(cell->upper), ink_of(cell->lower));
        growing_string(state->lines, "▀");
    } else {
        const char braille[] = {(char)0xe2, (char)(0xa0 | cell->dots >> 6),
                                (char)(0x80 | (cell->dots & 0x3f))};
        state_turn(state, false, cell->ink, none);
        growing_put(state->lines, braille, sizeof braille);
    }
}

void cells_put(const struct cells *cells, struct text_buffer *lines)
{
    size_t blank = 0; /* lines that come only between others */
    bool any = false;
    for (size_t row = 0; row < cells->rows; row++) {
        const struct cell *line = &cells->all[row * cells->columns];
        struct cell_state state = {.cells = cells, .lines = lines};
        size_t count = cells->columns;
        while (count > 0 && cell_is_empty(&line[count - 1])) {
            count--;
        }
        for (; count > 0 && any && blank > 0; blank--) {
            growing_string(lines, "\n");
        }
        for (size_t i = 0; i < count; i++) {
            state_put_cell(&state, &line[i]);
        }
        if (count > 0) {
            static const struct cell_ink none = {.is_set = false};
            state_turn(&state, false, none, none);
            growing_string(lines, "\n");
            any = true;
            blank = 0;
        } else {
            blank++;
        }
    }
}
