/* draw/tally_plot.c - how figures are spread, and how many of them pass, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/tally_plot.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double WIDTH = 800, HEIGHT = 500; /* px */
static const double LEFT = 84, RIGHT = 24, TOP = 104, BOTTOM = 434;
static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17;

/* Colours: of what passes, and what fails. */
enum { PASSES = 0, FAILS = 1 };

static bool fails(const struct tally_plot *plot, double value)
{
    return plot->fails_above ? value > plot->limit : value < plot->limit;
}

static void draw_bars(const struct tally_plot *plot, const struct plot_axis *across,
                      const struct plot_axis *up, struct svg *svg)
{
    const double part = (plot->high - plot->low) / (double)plot->count;
    for (size_t i = 0; i < plot->count; i++) {
        const double from = plot->low + part * (double)i;
        const double left = plot_page_at(across, from), right = plot_page_at(across, from + part);
        const double y = plot_page_at(up, plot->values[i]);
        const size_t colour = fails(plot, from + part / 2) ? FAILS : PASSES;
        svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(colour), .opacity = 0.8},
                        left, y, (right - left) * 0.94, BOTTOM - y);
    }
}

static void draw_curve(const struct tally_plot *plot, const struct plot_axis *across,
                       const struct plot_axis *up, struct svg *svg)
{
    const size_t count = plot->count + 1;
    double *x = ARENA_ARRAY(svg->arena, count, double), *y = ARENA_ARRAY(svg->arena, count, double);
    const double part = (plot->high - plot->low) / (double)plot->count;
    for (size_t i = 0; i < count; i++) {
        x[i] = plot_page_at(across, plot->low + part * (double)i);
        y[i] = plot_page_at(up, plot->values[i]);
    }
    svg_styled_polyline(svg, &(struct svg_style){.stroke = palette_colour(PASSES), .width = 2}, x,
                        y, count);
}

enum { WORDS = 160 }; /* room of the words beside a mark */

/* A line from top to bottom; the words of the two stand in lines of their own. */
static void tally_plot_draw_mark(const struct tally_plot *plot, int which,
                                 const struct plot_axis *across, struct svg *svg)
{
    const double value = which == 0 ? plot->nominal : plot->limit;
    const double x = plot_page_at(across, value), base = TOP - 22 + 16 * which;
    if (isnan(value)) {
        return;
    }
    /* Do the words stand left of the line? Away from the other one, where there is room. */
    double other = plot_page_at(across, which == 0 ? plot->limit : plot->nominal);
    const bool wants = isnan(other) ? x > (LEFT + WIDTH - RIGHT) / 2 : x < other;
    const bool turns = wants ? x > LEFT + WORDS : x > WIDTH - RIGHT - WORDS;
    svg_styled_line(svg,
                    &(struct svg_style){.stroke = which == 0 ? "#000" : palette_colour(FAILS),
                                        .width = 1.6,
                                        .dash = which == 0 ? NULL : "6 4"},
                    x, base - 9, x, BOTTOM);
    svg_words(svg, turns ? x - 5 : x + 5, base, NUMBER_SIZE, turns ? SVG_END : SVG_START, NULL,
              plot->marks[which]);
}

bool tally_plot_draw(const struct tally_plot *plot, struct svg *svg, struct error *error)
{
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
    struct plot_axis across = {.low = low - 0.02 * (high - low),
                               .high = high + 0.02 * (high - low),
                               .start = LEFT,
                               .stop = WIDTH - RIGHT};
    struct plot_axis up = {.high = most, .start = BOTTOM, .stop = TOP};
    ticks_linear(across.low, across.high, &across.ticks);
    plot_axis_to_ticks(&up);
    svg_begin(svg, WIDTH, HEIGHT, plot->title);
    for (size_t i = 0; i < up.ticks.count; i++) {
        const double y = plot_page_at(&up, up.ticks.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8}, LEFT, y,
                        WIDTH - RIGHT, y);
        svg_words(svg, LEFT - 9, y + 4, NUMBER_SIZE, SVG_END, NULL,
                  ticks_text(svg->arena, &up.ticks, i));
    }
    if (plot->is_curve) {
        draw_curve(plot, &across, &up, svg);
    } else {
        draw_bars(plot, &across, &up, svg);
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333"});
    svg_line(svg, LEFT, BOTTOM, WIDTH - RIGHT, BOTTOM);
    svg_line(svg, LEFT, TOP, LEFT, BOTTOM);
    svg_group_end(svg);
    for (size_t i = 0; i < across.ticks.count; i++) {
        const double value = across.ticks.value[i], x = plot_page_at(&across, value);
        if (value >= across.low && value <= across.high) {
            svg_styled_line(svg, &(struct svg_style){.stroke = "#333"}, x, BOTTOM, x, BOTTOM + 5);
            svg_words(svg, x, BOTTOM + 20, NUMBER_SIZE, SVG_MIDDLE, NULL,
                      ticks_text(svg->arena, &across.ticks, i));
        }
    }
    for (int which = 0; which < 2; which++) {
        tally_plot_draw_mark(plot, which, &across, svg);
    }
    svg_heading(svg, 20, 30, TITLE_SIZE, WIDTH - 32, plot->title);
    svg_subheading(svg, 20, 52, LABEL_SIZE, WIDTH - 32, plot->subtitle);
    svg_words(svg, (LEFT + WIDTH - RIGHT) / 2, BOTTOM + 48, LABEL_SIZE, SVG_MIDDLE, NULL,
              plot->x_label);
    svg_words_upwards(svg, 22, (TOP + BOTTOM) / 2, LABEL_SIZE, plot->y_label);
    svg_end(svg);
    return true;
}
