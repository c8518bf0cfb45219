/* draw/bars.c - groups of bars up and down from zero, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/bars.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/svg.h"
#include "draw/ticks.h"
#include "draw/typeset.h"

#include <math.h>

static const double HEIGHT = 500, LEFT = 84, RIGHT = 24, BELOW = 66; /* px */
static const double NARROWEST = 800, WIDEST_BAR = 20, NARROWEST_BAR = 3, GAP = 8;
static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17;
static const double LEGEND_TOP = 74, LEGEND_STEP = 19, SWATCH = 11;

/* Where everything is, px. */
struct bars_page {
    double width;
    double pitch, bar; /* from group to group; one bar */
    struct plot_axis y;
};

/* In as many lines as it takes. Result: the y of the last; `svg` null: nothing is drawn. */
static double bars_draw_legend(const struct bars *bars, double width, struct svg *svg)
{
    double x = LEFT, y = LEGEND_TOP;
    for (size_t k = 0; k < bars->kind_count; k++) {
        const double needed = SWATCH + 5 + svg_text_width(bars->kinds[k], NUMBER_SIZE);
        if (x > LEFT && x + needed > width - RIGHT) {
            x = LEFT;
            y += LEGEND_STEP;
        }
        if (svg != NULL) {
            svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(k)}, x, y - SWATCH + 1,
                            SWATCH, SWATCH);
            svg_words(svg, x + SWATCH + 5, y, NUMBER_SIZE, SVG_START, NULL, bars->kinds[k]);
        }
        x += needed + 16;
    }
    return y;
}

static void draw_group(const struct bars *bars, size_t g, const struct bars_page *page,
                       struct svg *svg)
{
    const struct bar_group *group = &bars->groups[g];
    const double left = LEFT + (double)g * page->pitch, zero = plot_page_at(&page->y, 0);
    const double first = left + (page->pitch - page->bar * (double)bars->kind_count) / 2;
    for (size_t k = 0; k < bars->kind_count; k++) {
        const double y = plot_page_at(&page->y, group->values[k]);
        svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(k)},
                        first + (double)k * page->bar, fmin(y, zero), page->bar * 0.92,
                        fabs(y - zero));
    }
    if (group->label != NULL) {
        svg_text(svg,
                 &(struct svg_label){.x = left + page->pitch / 2,
                                     .y = page->y.start + 20,
                                     .size = NUMBER_SIZE,
                                     .anchor = SVG_MIDDLE,
                                     .bold = group->apart},
                 group->label);
    }
}

static void bars_draw_words(const struct bars *bars, double width, double top, double bottom,
                            struct svg *svg)
{
    const double room = width - LEFT - 12;
    svg_heading(svg, LEFT, 30, TITLE_SIZE, room, bars->title);
    svg_subheading(svg, LEFT, 50, LABEL_SIZE, room, bars->subtitle);
    svg_words(svg, (LEFT + width - RIGHT) / 2, bottom + 48, LABEL_SIZE, SVG_MIDDLE, NULL,
              bars->x_label);
    svg_words_upwards(svg, 22, (top + bottom) / 2, LABEL_SIZE, bars->y_label);
}

/* -------- each kind at its own scale -------- */

static const double STRIP = 66, STRIP_GAP = 28; /* px: of a kind, and to the next */

static void bars_draw_mark(const struct bar_group *group, size_t kind, const struct plot_axis *axis,
                           double x, double reach, struct svg *svg)
{
    if (group->marks != NULL && isfinite(group->marks[kind])) {
        const double y = plot_page_at(axis, group->marks[kind]);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#fff", .width = 4}, x - reach, y,
                        x + reach, y);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#000", .width = 1.6}, x - reach, y,
                        x + reach, y);
    }
}

/* The strip of a kind: bars about a line at 0, and lines at a round number on both sides. */
static void bars_draw_strip(const struct bars *bars, size_t kind, const struct bars_page *page,
                            double top, struct svg *svg)
{
    const double bottom = top + STRIP, right = page->width - RIGHT;
    struct plot_axis axis = {.start = bottom, .stop = top};
    for (size_t g = 0; g < bars->group_count; g++) {
        const struct bar_group *group = &bars->groups[g];
        const double value = group->values[kind]; /* of NaN fmin and fmax take the other */
        const double mark = group->marks != NULL ? group->marks[kind] : value;
        axis.low = fmin(axis.low, fmin(value, mark));
        axis.high = fmax(axis.high, fmax(value, mark));
    }
    const double most = fmax(axis.high, -axis.low), round = most > 0 ? ticks_round_below(most) : 1;
    const double room = 0.04 * (axis.high - axis.low);
    axis.low = axis.low < 0 || !(most > 0) ? axis.low - room : 0;
    axis.high = axis.high > 0 ? axis.high + room : 0;
    axis.high = most > 0 ? axis.high : 1;
    for (int side = -1; side <= 1; side++) {
        const double value = side * round, y = plot_page_at(&axis, value);
        if (value >= axis.low && value <= axis.high && (side == 0 || most > 0)) {
            svg_styled_line(svg, &(struct svg_style){.stroke = side == 0 ? "#333" : "#d4d4d4"},
                            LEFT, y, right, y);
            const char *digits = side == 0 ? "0" : ticks_fixed(svg->arena, value, 0);
            svg_words(svg, LEFT - 9, y + 4, NUMBER_SIZE, SVG_END, NULL, digits);
        }
    }
    const double bar = fmin(WIDEST_BAR, 0.6 * page->pitch), zero = plot_page_at(&axis, 0);
    for (size_t g = 0; g < bars->group_count; g++) {
        const double y = plot_page_at(&axis, bars->groups[g].values[kind]);
        svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(kind)},
                        LEFT + ((double)g + 0.5) * page->pitch - bar / 2, fmin(y, zero), bar,
                        fabs(y - zero));
        bars_draw_mark(&bars->groups[g], kind, &axis, LEFT + ((double)g + 0.5) * page->pitch,
                       0.7 * bar, svg);
    }
    svg_styled_line(svg, &(struct svg_style){.stroke = "#333"}, LEFT, top, LEFT, bottom);
    svg_words(svg, LEFT + 4, top - 6, NUMBER_SIZE, SVG_START, NULL, bars->kinds[kind]);
}

/* From group to group, px, so that no label touches the next. */
static double bars_least_pitch(const struct bars *bars)
{
    double least = 14, before = -INFINITY;
    for (size_t g = 0; g < bars->group_count; g++) {
        const struct bar_group *group = &bars->groups[g];
        const double width = group->label == NULL
                                 ? -INFINITY
                                 : typeset_width(group->label, NUMBER_SIZE, group->apart);
        least = fmax(least, (before + width) / 2 + 5);
        before = width;
    }
    return least;
}

static void bars_draw_strips(const struct bars *bars, struct bars_page *page, struct svg *svg)
{
    const double top = LEGEND_TOP + 14, step = STRIP + STRIP_GAP;
    const double bottom = top + step * (double)bars->kind_count - STRIP_GAP;
    const double widest = 60; /* groups */
    const double count = (double)bars->group_count;
    page->width = fmax(NARROWEST, LEFT + RIGHT + count * bars_least_pitch(bars));
    page->pitch = fmin((page->width - LEFT - RIGHT) / count, widest);
    page->width = fmax(page->pitch * count + LEFT + RIGHT, 640);
    svg_begin(svg, page->width, bottom + BELOW, bars->title);
    for (size_t g = 0; g < bars->group_count; g++) {
        const double left = LEFT + (double)g * page->pitch;
        if (bars->groups[g].apart) {
            svg_styled_rect(svg, &(struct svg_style){.fill = "#f0f0f0"}, left, top - 4, page->pitch,
                            bottom - top + 8);
        }
        if (bars->groups[g].label != NULL) {
            svg_text(svg,
                     &(struct svg_label){.x = left + page->pitch / 2,
                                         .y = bottom + 20,
                                         .size = NUMBER_SIZE,
                                         .anchor = SVG_MIDDLE,
                                         .bold = bars->groups[g].apart},
                     bars->groups[g].label);
        }
    }
    for (size_t k = 0; k < bars->kind_count; k++) {
        bars_draw_strip(bars, k, page, top + step * (double)k, svg);
    }
    bars_draw_words(bars, page->width, top, bottom, svg);
}

bool bars_draw(const struct bars *bars, struct svg *svg, struct error *error)
{
    enum { MOST_GROUPS = 200 };
    const double count = (double)bars->group_count, kinds = (double)bars->kind_count;
    struct bars_page page = {
        .width = fmax(NARROWEST, LEFT + RIGHT + count * (kinds * NARROWEST_BAR + GAP)),
        .y.start = HEIGHT - BELOW};
    struct plot_axis *y_axis = &page.y;
    if (bars->group_count > MOST_GROUPS) {
        return fail(error, ERROR_USAGE, "%zu groups of bars: at most %d can be read",
                    bars->group_count, MOST_GROUPS);
    }
    const double longest = 1e100;
    bool any = false;
    for (size_t g = 0; g < bars->group_count; g++) {
        for (size_t k = 0; k < bars->kind_count; k++) {
            const double value = bars->groups[g].values[k];
            if (isfinite(value)) {
                any = true;
                y_axis->low = fmin(y_axis->low, value);
                y_axis->high = fmax(y_axis->high, value);
            }
        }
    }
    if (!any || !(fmax(y_axis->high, -y_axis->low) <= longest)) {
        return fail(error, ERROR_DOMAIN, "no bar has a length that can be drawn");
    }
    if (bars->own_scales) {
        bars_draw_strips(bars, &page, svg);
        svg_end(svg);
        return true;
    }
    page.pitch = (page.width - LEFT - RIGHT) / count;
    page.bar = fmin(WIDEST_BAR, (page.pitch - GAP) / kinds);
    y_axis->stop = bars_draw_legend(bars, page.width, NULL) + 16;
    plot_axis_to_ticks(y_axis);
    const double top = y_axis->stop, bottom = y_axis->start, zero = plot_page_at(y_axis, 0);
    svg_begin(svg, page.width, HEIGHT, bars->title);
    svg_group_begin(svg, &(struct svg_style){.fill = "#f0f0f0"});
    for (size_t g = 0; g < bars->group_count; g++) {
        if (bars->groups[g].apart) {
            svg_rect(svg, LEFT + (double)g * page.pitch, top, page.pitch, bottom - top);
        }
    }
    svg_group_end(svg);
    const double right = page.width - RIGHT;
    for (size_t i = 0; i < y_axis->ticks.count; i++) {
        const double y = plot_page_at(y_axis, y_axis->ticks.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8}, LEFT, y, right,
                        y);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#333"}, LEFT - 5, y, LEFT, y);
        svg_words(svg, LEFT - 9, y + 4, NUMBER_SIZE, SVG_END, NULL,
                  ticks_text(svg->arena, &y_axis->ticks, i));
    }
    for (size_t g = 0; g < bars->group_count; g++) {
        draw_group(bars, g, &page, svg);
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333"});
    svg_line(svg, LEFT, zero, right, zero);
    svg_line(svg, LEFT, top, LEFT, bottom);
    svg_group_end(svg);
    bars_draw_legend(bars, page.width, svg);
    bars_draw_words(bars, page.width, top, bottom, svg);
    svg_end(svg);
    return true;
}
