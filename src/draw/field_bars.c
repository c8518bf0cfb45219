/* draw/field_bars.c - astigmatism over an image format, as bars along both sections, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/field_bars.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

enum { COLUMNS = 3 };

/* px */
static const double LEFT = 76, TOP = 116, SIDE = 300, ACROSS = 396, FOOT = 66, HEAD = 30;
static const double MARGIN = 24, BOTTOM = 14, THICK = 2.6, THIN = 1.0, TITLE = 16, SMALL = 12;

static const char *const colours[] = {"#d55e00", "#0072b2"};
static const struct svg_style frame = {.stroke = "#444444"}, ground = {.fill = "#f6f6f6"};
static const struct svg_style circle = {.stroke = "#999999", .dash = "4 3"};

/* The page at work: mm of an image on it, and how long a mm of a focus is. */
struct bars_page {
    struct svg *svg;
    double largest; /* focus, mm */
    double x, y, scale;
};

static double bars_largest(const struct field_bars *page)
{
    double largest = 0;
    for (size_t i = 0; i < page->count; i++) {
        for (size_t k = 0; k < page->panels[i].count; k++) {
            const struct field_bar *bar = &page->panels[i].bars[k];
            largest = fmax(largest, fmax(fabs(bar->tangential), fabs(bar->sagittal)));
        }
    }
    return largest;
}

/* One bar about a place, px. */
static void bars_draw_focus(const struct bars_page *at, const double place[2], double direction,
                            double length, double focus, const char *colour)
{
    const struct svg_style style = {.stroke = colour, .width = focus > 0 ? THICK : THIN};
    const double x = cos(direction) * length / 2, y = sin(direction) * length / 2;
    svg_styled_line(at->svg, &style, place[0] - x, place[1] + y, place[0] + x, place[1] - y);
}

static void bars_draw_axis(const struct bars_page *at, double half, double x, double y, bool up)
{
    static const char *const names[] = {"x in the image (mm)", "y in the image (mm)"};
    struct ticks ticks;
    ticks_linear(-half, half, &ticks);
    for (size_t i = 0; i < ticks.count; i++) {
        const double value = ticks.value[i], along = value * at->scale;
        const char *text = ticks_text(at->svg->arena, &ticks, i);
        if (fabs(value) > half * (1 + 1e-9)) {
            continue;
        }
        if (up) {
            svg_styled_line(at->svg, &frame, x - 5, y - along, x, y - along);
            svg_words(at->svg, x - 8, y - along + 4, 11, SVG_END, NULL, text);
        } else {
            svg_styled_line(at->svg, &frame, x + along, y, x + along, y + 5);
            svg_words(at->svg, x + along, y + 17, 11, SVG_MIDDLE, NULL, text);
        }
    }
    if (up) {
        const double beside = fmax(48, 24 + ticks_width(at->svg->arena, &ticks, 11));
        svg_words_upwards(at->svg, x - beside, y, SMALL, names[1]);
    } else {
        svg_words(at->svg, x, y + 36, SMALL, SVG_MIDDLE, NULL, names[0]);
    }
}

static void bars_draw_panel(struct bars_page *at, const struct field_bars_panel *panel, double left,
                            double top)
{
    const double longest = fmax(panel->half[0], panel->half[1]);
    const double wide = SIDE * panel->half[0] / longest, high = SIDE * panel->half[1] / longest;
    struct svg *svg = at->svg;
    at->scale = SIDE / (2 * longest);
    at->x = left + SIDE / 2;
    at->y = top + high / 2;
    svg_styled_rect(svg, &ground, at->x - wide / 2, top, wide, high);
    if (panel->is_disc) {
        svg_styled_circle(svg, &circle, at->x, at->y, SIDE / 2);
    }
    for (size_t i = 0; i < panel->count; i++) {
        const struct field_bar *bar = &panel->bars[i];
        const double place[2] = {at->x + at->scale * bar->at[0], at->y - at->scale * bar->at[1]};
        const double unit = 0.94 * panel->spacing * at->scale / at->largest;
        const double quarter = 1.5707963267948966;
        bars_draw_focus(at, place, bar->direction, unit * fabs(bar->tangential), bar->tangential,
                        colours[0]);
        bars_draw_focus(at, place, bar->direction + quarter, unit * fabs(bar->sagittal),
                        bar->sagittal, colours[1]);
    }
    svg_styled_rect(svg, &frame, at->x - wide / 2, top, wide, high);
    bars_draw_axis(at, panel->half[0], at->x, top + high, false);
    bars_draw_axis(at, panel->half[1], at->x - wide / 2, at->y, true);
    svg_text(svg,
             &(struct svg_label){
                 .x = at->x, .y = top - 10, .size = 13, .width = ACROSS - 8, .anchor = SVG_MIDDLE},
             panel->title != NULL ? panel->title : "");
    if (panel->note != NULL) {
        svg_words(svg, at->x, top + high + 54, SMALL, SVG_MIDDLE, NULL, panel->note);
    }
}

/* What the bars are, and how long: below the titles. */
static double bars_draw_legend(const struct bars_page *at, double length, double y)
{
    static const char *const words[] = {"T: tangential focus", "S: sagittal focus"};
    struct svg *svg = at->svg;
    double x = MARGIN;
    for (int k = 0; k < 2; k++) {
        const struct svg_style style = {.stroke = colours[k], .width = THICK};
        svg_styled_line(svg, &style, x, y, x + 22, y);
        svg_words(svg, x + 28, y + 4, SMALL, SVG_START, NULL, words[k]);
        x += 44 + svg_text_width(words[k], SMALL);
    }
    const double round = ticks_round_below(at->largest);
    const char *size = ARENA_JOIN(svg->arena, ticks_fixed(svg->arena, round, 0),
                                  " mm from the image plane; thick: behind it");
    svg_scale_bar(svg, "#1d1d1d", x, x + length * round / at->largest, y);
    x += length * round / at->largest + 8;
    svg_words(svg, x, y + 4, SMALL, SVG_START, NULL, size);
    return x + svg_text_width(size, SMALL) + MARGIN;
}

bool field_bars_draw(const struct field_bars *page, struct svg *svg, struct error *error)
{
    struct bars_page at = {.svg = svg, .largest = bars_largest(page)};
    const size_t columns = page->count < COLUMNS ? page->count : COLUMNS;
    size_t total = 0;
    double tallest = 0, length = 0;
    for (size_t i = 0; i < page->count; i++) {
        const struct field_bars_panel *panel = &page->panels[i];
        const double longest = fmax(panel->half[0], panel->half[1]);
        total += panel->count;
        tallest = fmax(tallest, SIDE * panel->half[1] / longest);
        length = 0.94 * panel->spacing * SIDE / (2 * longest);
    }
    if (total == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    at.largest = at.largest > 0 ? at.largest : 1;
    const double down = HEAD + tallest + FOOT;
    const double rows = (double)((page->count + columns - 1) / columns);
    const double words =
        2 * MARGIN + 1 +
        fmax(1.2 * svg_text_width(page->title, TITLE), svg_text_width(page->subtitle, SMALL));
    struct svg measured = {.arena = svg->arena};
    struct bars_page trial = at;
    trial.svg = &measured;
    svg_begin(&measured, 1, 1, "");
    const double legend = bars_draw_legend(&trial, length, 0);
    const double width = fmax(fmax(words, legend), LEFT + ACROSS * (double)columns - 72);
    svg_begin(svg, width, TOP + rows * down - HEAD + BOTTOM, page->title);
    svg_heading(svg, MARGIN, 32, TITLE, width - 2 * MARGIN, page->title);
    svg_subheading(svg, MARGIN, 54, SMALL, width - 2 * MARGIN, page->subtitle);
    bars_draw_legend(&at, length, 76);
    for (size_t i = 0; i < page->count; i++) {
        bars_draw_panel(&at, &page->panels[i], LEFT + ACROSS * (double)(i % columns),
                        TOP + down * (double)(i / columns));
    }
    svg_end(svg);
    return true;
}
