/* draw/pareto.c - who has how large a share, the largest first, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/pareto.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double WIDTH = 800, RIGHT = 70, TOP = 96, BELOW = 62; /* px */
static const double ROW = 18, BAR = 11, WIDEST_LABEL = 240;
static const double NUMBER_SIZE = 11, LABEL_SIZE = 13, TITLE_SIZE = 17;

/* Where everything is, px. */
struct pareto_page {
    double left, bottom;
    struct ticks ticks;
    const struct pareto_bar *bars;
    size_t count;
};

static double pareto_x_at(const struct pareto_page *page, double share)
{
    const double high = page->ticks.value[page->ticks.count - 1];
    return page->left + share / high * (WIDTH - RIGHT - page->left);
}

static void pareto_draw_bar(const struct pareto_page *page, double y, double share, size_t colour,
                            double opacity, struct svg *svg)
{
    const struct svg_style style = {.fill = palette_colour(colour), .opacity = opacity};
    svg_styled_rect(svg, &style, page->left, y + (ROW - BAR) / 2,
                    pareto_x_at(page, share) - page->left, BAR);
}

static void draw_row(const struct pareto_page *page, size_t i, struct svg *svg)
{
    const struct pareto_bar *bar = &page->bars[i];
    const double y = TOP + ROW * (double)i, base = y + ROW / 2 + 4;
    const struct svg_label name = {.x = page->left - 8,
                                   .y = base,
                                   .size = NUMBER_SIZE,
                                   .width = WIDEST_LABEL,
                                   .anchor = SVG_END};
    pareto_draw_bar(page, y, bar->whole, 0, 0.35, svg);
    pareto_draw_bar(page, y, bar->part, 0, 1, svg);
    svg_text(svg, &name, bar->label);
    svg_words(
        svg, pareto_x_at(page, bar->whole) + 5, base, NUMBER_SIZE, SVG_START, "#444",
        arena_printf(svg->arena, bar->whole < 0.001 ? "%.2f %%" : "%.1f %%", 100 * bar->whole));
}

bool pareto_draw(const struct pareto *pareto, struct svg *svg, struct error *error)
{
    struct pareto_page page;
    /* The rows that are drawn: the last stands for all that are left. */
    struct pareto_bar *rows = ARENA_ARRAY(svg->arena, pareto->count + 1, struct pareto_bar);
    const bool has_others = pareto->count > pareto->most;
    page.count = has_others ? pareto->most : pareto->count;
    page.bars = rows;
    for (size_t i = 0; i < pareto->count; i++) {
        struct pareto_bar *row = &rows[i < page.count ? i : page.count - 1];
        const struct pareto_bar *bar = &pareto->bars[i];
        const bool is_other = has_others && i + 1 >= page.count;
        row->label = is_other
                         ? arena_printf(svg->arena, "%zu others", pareto->count - page.count + 1)
                         : bar->label;
        row->part += bar->part;
        row->whole += bar->whole;
    }
    double longest = 0, widest = 0;
    for (size_t i = 0; i < page.count; i++) {
        longest = fmax(longest, page.bars[i].whole);
        widest = fmax(widest, svg_text_width(page.bars[i].label, NUMBER_SIZE));
    }
    if (!(longest > 0 && isfinite(longest))) {
        return fail(error, ERROR_DOMAIN, "no bar has a length that can be drawn");
    }
    page.left = 28 + fmin(widest, WIDEST_LABEL);
    page.bottom = TOP + ROW * (double)page.count;
    ticks_linear(0, longest, &page.ticks);
    svg_begin(svg, WIDTH, page.bottom + BELOW, pareto->title);
    for (size_t i = 0; i < page.ticks.count; i++) {
        const double x = pareto_x_at(&page, page.ticks.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = i == 0 ? "#333" : "#d4d4d4"}, x, TOP, x,
                        page.bottom + 4);
        svg_words(svg, x, page.bottom + 18, NUMBER_SIZE, SVG_MIDDLE, NULL,
                  arena_printf(svg->arena, "%.4g %%", 100 * page.ticks.value[i]));
    }
    for (size_t i = 0; i < page.count; i++) {
        draw_row(&page, i, svg);
    }
    const char *const names[] = {pareto->part_name, pareto->whole_name};
    double at = page.left;
    for (size_t k = 0; k < 2; k++) {
        const struct svg_style style = {.fill = palette_colour(0), .opacity = k == 0 ? 1 : 0.35};
        svg_styled_rect(svg, &style, at, 66, BAR, BAR);
        svg_words(svg, at + BAR + 5, 76, 12, SVG_START, NULL, names[k]);
        at += BAR + 24 + svg_text_width(names[k], 12);
    }
    svg_heading(svg, 20, 30, TITLE_SIZE, WIDTH - 32, pareto->title);
    svg_words_within(svg, 20, 50, LABEL_SIZE, WIDTH - 32, "#555", pareto->subtitle);
    svg_words(svg, (page.left + WIDTH - RIGHT) / 2, page.bottom + 44, LABEL_SIZE, SVG_MIDDLE, NULL,
              pareto->x_label);
    svg_end(svg);
    return true;
}
