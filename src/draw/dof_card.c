/* draw/dof_card.c - a card of depth of field to print and carry: A6, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/dof_card.h"

#include "base/arena.h"

#include <math.h>

/* Coordinates are tenths of a millimetre. */
static const double UNITS = 10, MARGIN = 55, RIGHT = 995, TOP = 185, BOTTOM = 1400;
static const double HEAD = 150;                    /* the column of distances */
static const double LARGEST = 32, SMALLEST = 17.5; /* of figures: 9 and 5 points */
static const double LEADING = 1.5;                 /* from line to line, of the size */

static const char *card_number(double metres, struct arena *arena)
{
    if (isinf(metres)) {
        return "∞";
    }
    /* three digits, no point without one behind it */
    return metres >= 99.95 ? arena_printf(arena, "%.0f", metres)
                           : arena_printf(arena, "%#.3g", metres);
}

static const struct dof_card_cell *card_cell(const struct dof_card *card, size_t lens, size_t row,
                                             size_t column)
{
    return &card->cells[(lens * card->distance_count + row) * card->fnumber_count + column];
}

/* "1.85–2.17", or a dash. */
static const char *card_range(const struct dof_card_cell *cell, struct arena *arena)
{
    return isnan(cell->near) ? "–"
                             : arena_printf(arena, "%s–%s", card_number(cell->near, arena),
                                            card_number(cell->far, arena));
}

/* Size of figures at which the widest of them fits its column and all lines the page. */
static double card_size(const struct dof_card *card, double column, struct arena *arena)
{
    const double lines =
        (double)(card->lens_count * (card->distance_count + 2)) + 0.6 * (double)card->lens_count;
    double size = fmin(LARGEST, (BOTTOM - TOP) / (LEADING * lines));
    for (size_t i = 0; i < card->lens_count; i++) {
        for (size_t k = 0; k < card->distance_count; k++) {
            for (size_t j = 0; j < card->fnumber_count; j++) {
                const char *text = card_range(card_cell(card, i, k, j), arena);
                size = fmin(size, (column - 12) / svg_text_width(text, 1));
            }
        }
    }
    return size;
}

/* The hyperfocal distance does not depend on that in focus: of the first row that has one. */
static double card_hyperfocal(const struct dof_card *card, size_t lens, size_t column)
{
    double hyperfocal = NAN;
    for (size_t k = card->distance_count; k-- > 0;) {
        const double here = card_cell(card, lens, k, column)->hyperfocal;
        hyperfocal = isnan(here) ? hyperfocal : here;
    }
    return hyperfocal;
}

/* One lens from its head line on; returns where the next one begins. */
static double card_draw_lens(const struct dof_card *card, size_t lens, double y, double size,
                             double column, struct svg *svg)
{
    struct arena *arena = svg->arena;
    const double line = LEADING * size;
    const struct svg_style band = {.fill = "#e8eef4"}, rule = {.stroke = "#9aa7b2", .width = 1.5};
    svg_styled_rect(svg, &band, MARGIN, y, RIGHT - MARGIN, line);
    y += 0.72 * line;
    svg_heading(svg, MARGIN + 8, y, size * 1.05, HEAD + column, card->lenses[lens]);
    y += line;
    svg_words(svg, MARGIN + 8, y, size, SVG_START, "#8a1f11", "hyperfocal");
    for (size_t j = 0; j < card->fnumber_count; j++) {
        const double H = card_hyperfocal(card, lens, j);
        svg_words(svg, MARGIN + HEAD + column * (double)(j + 1) - 8, y, size, SVG_END, "#8a1f11",
                  isnan(H) ? "–" : card_number(H, arena));
    }
    for (size_t k = 0; k < card->distance_count; k++) {
        svg_styled_line(svg, &rule, MARGIN, y + 0.35 * size, RIGHT, y + 0.35 * size);
        y += line;
        svg_words(svg, MARGIN + 8, y, size, SVG_START, "#000000",
                  arena_printf(arena, "%.4g", card->distances[k]));
        for (size_t j = 0; j < card->fnumber_count; j++) {
            svg_words(svg, MARGIN + HEAD + column * (double)(j + 1) - 8, y, size, SVG_END,
                      "#000000", card_range(card_cell(card, lens, k, j), arena));
        }
    }
    return y + 0.88 * line;
}

bool dof_card_draw(const struct dof_card *card, struct svg *svg, struct error *error)
{
    const double column = (RIGHT - MARGIN - HEAD) / (double)card->fnumber_count;
    const double size = card_size(card, column, svg->arena);
    if (!(size >= SMALLEST)) {
        fail(error, ERROR_USAGE,
             "%zu lenses with limits of %zu x %zu each are too many to be read on a card",
             card->lens_count, card->distance_count, card->fnumber_count);
        return error_hint(error, "make two cards of them");
    }
    svg_begin_mm(svg, DOF_CARD_WIDTH, DOF_CARD_HEIGHT, UNITS, card->title);
    svg_heading(svg, MARGIN, 76, 42, RIGHT - MARGIN, card->title);
    svg_subheading(svg, MARGIN, 116, 25, RIGHT - MARGIN, card->subtitle);
    svg_words(svg, MARGIN + 8, 166, size, SVG_START, "#444444", "focus, m");
    for (size_t j = 0; j < card->fnumber_count; j++) {
        svg_text(svg,
                 &(struct svg_label){.x = MARGIN + HEAD + column * (double)(j + 1) - 8,
                                     .y = 166,
                                     .size = size * 1.05,
                                     .anchor = SVG_END,
                                     .bold = true},
                 arena_printf(svg->arena, "f/%.3g", card->fnumbers[j]));
    }
    double y = TOP;
    for (size_t i = 0; i < card->lens_count; i++) {
        y = card_draw_lens(card, i, y, size, column, svg);
    }
    svg_words_within(svg, MARGIN, 1440, 22, RIGHT - MARGIN, "#444444",
                     "near–far limit, m; distances from the front principal plane");
    svg_end(svg);
    return true;
}
