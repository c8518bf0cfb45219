/* tests/unit/test_grid.c - tables as narrow as a terminal: nothing that is shown is lost. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "report/grid.h"

#include <stdint.h>
#include <string.h>

enum { GRIDS = 2000, MOST_COLUMNS = 6, LONGEST = 40 };

/* Reproducible noise: a linear congruential generator, constants of Knuth's MMIX, high bits. */
static unsigned noise(uint64_t *state, unsigned below)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*state >> 33) % below;
}

/* Characters on the screen that are no blanks. */
static size_t marks(const char *text, size_t length)
{
    size_t count = 0;
    for (size_t i = 0; i < length; i++) {
        count += text[i] != ' ' && text[i] != '\n' && ((unsigned char)text[i] & 0xc0) != 0x80;
    }
    return count;
}

static size_t longest_line(const char *text, size_t length)
{
    size_t longest = 0, width = 0;
    for (size_t i = 0; i < length; i++) {
        width = text[i] == '\n' ? 0 : width + (((unsigned char)text[i] & 0xc0) != 0x80);
        longest = width > longest ? width : longest;
    }
    return longest;
}

static struct grid random_grid(uint64_t *state, struct arena *arena)
{
    static const char *const letters[] = {" ", "a", "bc", "\xc3\xa9", "-", "7", " ", "word"};
    struct grid grid = grid_new(arena, 1 + noise(state, MOST_COLUMNS), noise(state, 3));
    size_t rows = grid.head_rows + noise(state, 5);
    for (size_t j = 0; j < grid.columns; j++) {
        grid.left[j] = noise(state, 2) == 1;
    }
    for (size_t i = 0; i < rows; i++) {
        grid_add_row(&grid);
        for (size_t j = 0; j < grid.columns; j++) {
            const char *cell = "";
            for (unsigned k = noise(state, 12); k > 0; k--) {
                cell = arena_printf(arena, "%s%s", cell, letters[noise(state, 8)]);
            }
            grid_set(&grid, j, cell);
        }
    }
    return grid;
}

static size_t marks_of(const struct grid *grid)
{
    size_t count = 0;
    for (size_t i = 0; i < grid->rows; i++) {
        for (size_t j = 0; j < grid->columns; j++) {
            const char *cell = grid_cell(grid, i, j);
            bool shown = grid->hidden == NULL || !grid->hidden[j];
            count += shown ? marks(cell, strlen(cell)) : 0;
        }
    }
    return count;
}

static size_t width_of(const struct grid *grid)
{
    size_t width = 0;
    for (size_t j = 0; j < grid->columns; j++) {
        width += grid->hidden[j] ? 0 : grid->widths[j] + 2;
    }
    return width - 2;
}

/* Whatever the cells and the width: it ends, keeps within the width, and shows all it should. */
static void check_random(void)
{
    uint64_t state = 1;
    size_t lost = 0, wide = 0, left_out = 0, too_narrow = 0;
    for (int i = 0; i < GRIDS; i++) {
        struct arena arena = {0};
        struct output output;
        struct grid grid = random_grid(&state, &arena);
        size_t *least = ARENA_ARRAY(&arena, grid.columns, size_t);
        size_t *rank = ARENA_ARRAY(&arena, grid.columns, size_t);
        for (size_t j = 0; j < grid.columns; j++) {
            rank[j] = j;
        }
        output_begin(&output, -1, &arena);
        output.width = 5 + noise(&state, 60);
        left_out += grid_fit(&grid, output.width, least, rank);
        grid_write_text(&grid, &output, true);
        lost += marks(output.buffer, output.used) != marks_of(&grid);
        bool fits = width_of(&grid) <= output.width;
        wide += fits && longest_line(output.buffer, output.used) > output.width;
        too_narrow += !fits;
        arena_free(&arena);
    }
    CHECK(lost == 0 && wide == 0);
    CHECK(left_out > GRIDS / 4 && too_narrow < GRIDS / 4);
}

/* By hand: heads break first, then words, then the last column is left out. */
static void check_steps(void)
{
    static const char *const cells[3][3] = {
        {"name", "focal length", "note"}, {"", "mm", ""}, {"a lens", "50", "one of many words"}};
    static const struct {
        size_t width, left_out;
        const char *text;
    } cases[] = {{80, 0,
                  "name    focal length  note\n"
                  "                  mm\n"
                  "a lens            50  one of many words\n"},
                 {33, 0,
                  "         focal\n"
                  "name    length  note\n"
                  "            mm\n"
                  "a lens      50  one of many words\n"},
                 {32, 0,
                  "         focal\n"
                  "name    length  note\n"
                  "            mm\n"
                  "a lens      50  one of many\n"
                  "                words\n"},
                 {31, 1,
                  "name    focal length\n"
                  "                  mm\n"
                  "a lens            50\n"},
                 {10, 2, "name\n\na lens\n"}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        struct arena arena = {0};
        struct output output;
        struct grid grid = grid_new(&arena, 3, 2);
        grid.left[0] = grid.left[2] = true;
        for (size_t i = 0; i < 3; i++) {
            grid_add_row(&grid);
            for (size_t j = 0; j < 3; j++) {
                grid_set(&grid, j, cells[i][j]);
            }
        }
        const size_t least[3] = {0}, rank[3] = {0, 1, 2};
        output_begin(&output, -1, &arena);
        output.width = cases[k].width;
        CHECK(grid_fit(&grid, output.width, least, rank) == cases[k].left_out);
        grid_write_text(&grid, &output, true);
        CHECK_TEXT(arena_string(&arena, output.buffer, output.used), cases[k].text);
        arena_free(&arena);
    }
}

static const char *latex_of(struct arena *arena, const char *text)
{
    struct output output;
    output_begin(&output, -1, arena);
    grid_latex_paragraph(arena, &output, text);
    return arena_string(arena, output.buffer, output.used);
}

/* The ten characters that LaTeX keeps for itself (its Reference Manual, "Reserved characters"). */
static void check_latex(void)
{
    struct arena arena = {0};
    struct output output;
    CHECK_TEXT(latex_of(&arena, "50% & $5_a^b {~#}"),
               "\n50\\% \\& \\$5\\_a\\textasciicircum{}b \\{\\textasciitilde{}\\#\\}\n");
    CHECK_TEXT(latex_of(&arena, "\\input{x}"), "\n\\textbackslash{}input\\{x\\}\n");
    /* behind the end of a row these would be its argument, or its star */
    CHECK_TEXT(latex_of(&arena, "[1] *"), "\n{[}1] {*}\n");
    struct grid grid = grid_new(&arena, 2, 2);
    static const char *const cells[3][2] = {{"lens", "distance"}, {"", "m"}, {"a-1", "-1.5"}};
    grid.left[0] = true;
    for (size_t i = 0; i < 3; i++) {
        grid_add_row(&grid);
        grid_set(&grid, 0, cells[i][0]);
        grid_set(&grid, 1, cells[i][1]);
    }
    output_begin(&output, -1, &arena);
    grid_write_latex(&grid, &output, true);
    grid_latex_close(NULL, 1, &output);
    grid_latex_paragraph(&arena, &output, "one\ntwo\n\nthree");
    CHECK_TEXT(arena_string(&arena, output.buffer, output.used),
               "% needs the package booktabs\n"
               "\\noindent\\begin{tabular}{lr}\n\\toprule\nlens & distance \\\\\n & m \\\\\n"
               "\\midrule\na-1 & $-$1.5 \\\\\n\\bottomrule\n\\end{tabular}\n"
               "\none \\\\\ntwo\n\nthree\n");
    arena_free(&arena);
}

int main(void)
{
    check_latex();
    check_random();
    check_steps();
    return check_report();
}
