/* draw/tally_plot.c - how figures are spread, and how many of them pass, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/tally_plot.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double WIDTH = 800, HEIGHT = 500; /* px */
static const double LEFT = 84, RIGHT = 24, TOP = 104, BELOW = 66;
static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17;

/* Colours: of what passes, and what fails. */
enum { PASSES = 0, FAILS = 1 };

struct tally_plot_page {
    struct ticks x, y;
    double low, high; /* of x */
    double bottom;
};

static double tally_plot_x_at(const struct tally_plot_page *page, double value)
{
    return LEFT + (value - page->low) / (page->high - page->low) * (WIDTH - LEFT - RIGHT);
}

static double tally_plot_y_at(const struct tally_plot_page *page, double value)
{
    const double high = page->y.value[page->y.count - 1];
    return page->bottom - value / high * (page->bottom - TOP);
}

static bool fails(const struct tally_plot *plot, double value)
{
    return plot->fails_above ? value > plot->limit : value < plot->limit;
}

static void draw_bars(const struct tally_plot *plot, const struct tally_plot_page *page,
                      struct svg *svg)
{
    const double part = (plot->high - plot->low) / (double)plot->count;
    for (size_t i = 0; i < plot->count; i++) {
        const double from = plot->low + part * (double)i;
        const double left = tally_plot_x_at(page, from), right = tally_plot_x_at(page, from + part);
        const double y = tally_plot_y_at(page, plot->values[i]);
        const size_t colour = fails(plot, from + part / 2) ? FAILS : PASSES;
        svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(colour), .opacity = 0.8},
                        left, y, (right - left) * 0.94, page->bottom - y);
    }
}

static void draw_curve(const struct tally_plot *plot, const struct tally_plot_page *page,
                       struct svg *svg)
{
    const size_t count = plot->count + 1;
    double *x = ARENA_ARRAY(svg->arena, count, double), *y = ARENA_ARRAY(svg->arena, count, double);
    const double part = (plot->high - plot->low) / (double)plot->count;
    for (size_t i = 0; i < count; i++) {
        x[i] = tally_plot_x_at(page, plot->low + part * (double)i);
        y[i] = tally_plot_y_at(page, plot->values[i]);
    }
    svg_styled_polyline(svg, &(struct svg_style){.stroke = palette_colour(PASSES), .width = 2}, x,
                        y, count);
}

enum { WORDS = 160 }; /* room of the words beside a mark */

/* A line from top to bottom; the words of the two stand in lines of their own. */
static void tally_plot_draw_mark(const struct tally_plot *plot, int which,
                                 const struct tally_plot_page *page, struct svg *svg)
{
    const double value = which == 0 ? plot->nominal : plot->limit;
    const double x = tally_plot_x_at(page, value), base = TOP - 22 + 16 * which;
    if (isnan(value)) {
        return;
    }
    /* Do the words stand left of the line? Away from the other one, where there is room. */
    double other = tally_plot_x_at(page, which == 0 ? plot->limit : plot->nominal);
    const bool wants = isnan(other) ? x > (LEFT + WIDTH - RIGHT) / 2 : x < other;
    const bool turns = wants ? x > LEFT + WORDS : x > WIDTH - RIGHT - WORDS;
    const struct svg_style style = {.stroke = which == 0 ? "#000" : palette_colour(FAILS),
                                    .width = 1.6,
                                    .dash = which == 0 ? NULL : "6 4"};
    svg_styled_line(svg, &style, x, base - 9, x, page->bottom);
    svg_words(svg, turns ? x - 5 : x + 5, base, NUMBER_SIZE, turns ? SVG_END : SVG_START, NULL,
              plot->marks[which]);
}

bool tally_plot_draw(const struct tally_plot *plot, struct svg *svg, struct error *error)
{
    struct tally_plot_page page;
    const double marks[2] = {plot->nominal, plot->limit};
    const size_t count = plot->count + (plot->is_curve ? 1 : 0);
    double low = plot->low, high = plot->high, most = 0;
    for (int k = 0; k < 2; k++) { /* of NaN fmin and fmax take the other one */
        low = fmin(low, marks[k]);
        high = fmax(high, marks[k]);
    }
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, plot->values[i]);
    }
    if (!(high - low > 0) || !isfinite(high - low)) {
        return fail(error, ERROR_DOMAIN, "all figures are the same: there is nothing to draw");
    }
    if (!(most > 0) || !isfinite(most)) {
        return fail(error, ERROR_DOMAIN, "no bar has a length that can be drawn");
    }
    page.low = low - 0.02 * (high - low);
    page.high = high + 0.02 * (high - low);
    page.bottom = HEIGHT - BELOW;
    ticks_linear(page.low, page.high, &page.x);
    ticks_linear(0, most, &page.y);
    svg_begin(svg, WIDTH, HEIGHT, plot->title);
    for (size_t i = 0; i < page.y.count; i++) {
        const double y = tally_plot_y_at(&page, page.y.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8}, LEFT, y,
                        WIDTH - RIGHT, y);
        svg_words(svg, LEFT - 9, y + 4, NUMBER_SIZE, SVG_END, NULL,
                  ticks_text(svg->arena, &page.y, i));
    }
    if (plot->is_curve) {
        draw_curve(plot, &page, svg);
    } else {
        draw_bars(plot, &page, svg);
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333"});
    svg_line(svg, LEFT, page.bottom, WIDTH - RIGHT, page.bottom);
    svg_line(svg, LEFT, TOP, LEFT, page.bottom);
    svg_group_end(svg);
    for (size_t i = 0; i < page.x.count; i++) {
        const double value = page.x.value[i], x = tally_plot_x_at(&page, value);
        if (value < page.low || value > page.high) {
            continue;
        }
        svg_styled_line(svg, &(struct svg_style){.stroke = "#333"}, x, page.bottom, x,
                        page.bottom + 5);
        svg_words(svg, x, page.bottom + 20, NUMBER_SIZE, SVG_MIDDLE, NULL,
                  ticks_text(svg->arena, &page.x, i));
    }
    for (int which = 0; which < 2; which++) {
        tally_plot_draw_mark(plot, which, &page, svg);
    }
    svg_heading(svg, 20, 30, TITLE_SIZE, WIDTH - 32, plot->title);
    svg_words_within(svg, 20, 52, LABEL_SIZE, WIDTH - 32, "#555", plot->subtitle);
    svg_words(svg, (LEFT + WIDTH - RIGHT) / 2, page.bottom + 48, LABEL_SIZE, SVG_MIDDLE, NULL,
              plot->x_label);
    svg_words_upwards(svg, 22, (TOP + page.bottom) / 2, LABEL_SIZE, plot->y_label);
    svg_end(svg);
    return true;
}
