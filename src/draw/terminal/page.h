/* draw/terminal/page.h - SVG drawings as lines of a terminal: curves of Braille dots, and words. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_PAGE_H
#define LENSCALC_DRAW_TERMINAL_PAGE_H

#include "base/arena.h"
#include "base/text.h"
#include "draw/terminal/cells.h"
#include "optics/growing.h"

/* Where a drawing or picture is shown. */
struct page_view {
    size_t columns; /* at least 1 */
    size_t rows;    /* of the screen; 0 = unknown */
    enum cell_colours colours;
};

/*
 * Draw a drawing.
 *
 * Given     drawing  as draw/svg.h writes it
 *           view     where
 *           lines    receives the lines: first the words that stand above all else in the drawing,
 *                    its title, and last its notes, which stand below, over the whole width
 * Result    Lengths across and down have one scale, as a cell is twice as high as wide; words are
 *           characters, and where two would meet, the later one moves a little, is cut, or, a
 *           number of an axis, left out. Words that are turned stand upright above what they
 *           describe. Without colours, curves of different colours have different dashes
 */
void page_draw(struct text drawing, const struct page_view *view, struct arena *arena,
               struct text_buffer *lines);

#endif
