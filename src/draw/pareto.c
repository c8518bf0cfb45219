/* draw/pareto.c - who has how large a share, the largest first, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/pareto.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double WIDTH = 800, RIGHT = 70, TOP = 96, BELOW = 62; /* px */
static const double ROW = 18, BAR = 11, WIDEST_LABEL = 240;
static const double NUMBER_SIZE = 11, LABEL_SIZE = 13, TITLE_SIZE = 17;

static void pareto_draw_bar(const struct plot_axis *x, double y, double share, double opacity,
                            struct svg *svg)
{
    svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(0), .opacity = opacity},
                    x->start, y + (ROW - BAR) / 2, plot_page_at(x, share) - x->start, BAR);
}

static void draw_row(const struct plot_axis *x, const struct pareto_bar *bar, double y,
                     struct svg *svg)
{
    const double base = y + ROW / 2 + 4;
    const struct svg_label name = {.x = x->start - 8,
                                   .y = base,
                                   .size = NUMBER_SIZE,
                                   .width = WIDEST_LABEL,
                                   .anchor = SVG_END};
    pareto_draw_bar(x, y, bar->whole, 0.35, svg);
    pareto_draw_bar(x, y, bar->part, 1, svg);
    svg_text(svg, &name, bar->label);
    svg_words(
        svg, plot_page_at(x, bar->whole) + 5, base, NUMBER_SIZE, SVG_START, "#444",
        arena_printf(svg->arena, bar->whole < 0.001 ? "%.2f %%" : "%.1f %%", 100 * bar->whole));
}

bool pareto_draw(const struct pareto *pareto, struct svg *svg, struct error *error)
{
    /* The rows that are drawn: the last stands for all that are left. */
    struct pareto_bar *rows = ARENA_ARRAY(svg->arena, pareto->count + 1, struct pareto_bar);
    const bool has_others = pareto->count > pareto->most;
    const size_t count = has_others ? pareto->most : pareto->count;
    for (size_t i = 0; i < pareto->count; i++) {
        struct pareto_bar *row = &rows[i < count ? i : count - 1];
        const struct pareto_bar *bar = &pareto->bars[i];
        row->label = (has_others && i + 1 >= count)
                         ? arena_printf(svg->arena, "%zu others", pareto->count - count + 1)
                         : bar->label;
        row->part += bar->part;
        row->whole += bar->whole;
    }
    double longest = 0, widest = 0;
    for (size_t i = 0; i < count; i++) {
        longest = fmax(longest, rows[i].whole);
        widest = fmax(widest, svg_text_width(rows[i].label, NUMBER_SIZE));
    }
    if (!(longest > 0 && isfinite(longest))) {
        return fail(error, ERROR_DOMAIN, "no bar has a length that can be drawn");
    }
    struct plot_axis axis = {
        .high = longest, .start = 28 + fmin(widest, WIDEST_LABEL), .stop = WIDTH - RIGHT};
    const double bottom = TOP + ROW * (double)count;
    plot_axis_to_ticks(&axis);
    svg_begin(svg, WIDTH, bottom + BELOW, pareto->title);
    for (size_t i = 0; i < axis.ticks.count; i++) {
        const double x = plot_page_at(&axis, axis.ticks.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = i == 0 ? "#333" : "#d4d4d4"}, x, TOP, x,
                        bottom + 4);
        svg_words(svg, x, bottom + 18, NUMBER_SIZE, SVG_MIDDLE, NULL,
                  arena_printf(svg->arena, "%.4g %%", 100 * axis.ticks.value[i]));
    }
    for (size_t i = 0; i < count; i++) {
        draw_row(&axis, &rows[i], TOP + ROW * (double)i, svg);
    }
    const char *const names[] = {pareto->part_name, pareto->whole_name};
    double at = axis.start;
    for (size_t k = 0; k < 2; k++) {
        svg_styled_rect(
            svg, &(struct svg_style){.fill = palette_colour(0), .opacity = k == 0 ? 1 : 0.35}, at,
            66, BAR, BAR);
        svg_words(svg, at + BAR + 5, 76, 12, SVG_START, NULL, names[k]);
        at += BAR + 24 + svg_text_width(names[k], 12);
    }
    svg_heading(svg, 20, 30, TITLE_SIZE, WIDTH - 32, pareto->title);
    svg_subheading(svg, 20, 50, LABEL_SIZE, WIDTH - 32, pareto->subtitle);
    svg_words(svg, (axis.start + WIDTH - RIGHT) / 2, bottom + 44, LABEL_SIZE, SVG_MIDDLE, NULL,
              pareto->x_label);
    svg_end(svg);
    return true;
}
