/* draw/bars.c - groups of bars up and down from zero, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/bars.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double HEIGHT = 500, LEFT = 84, RIGHT = 24, BELOW = 66; /* px */
static const double NARROWEST = 800, WIDEST_BAR = 20, NARROWEST_BAR = 3, GAP = 8;
static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17;
static const double LEGEND_TOP = 74, LEGEND_STEP = 19, SWATCH = 11;

/* Where everything is, px. */
struct bars_page {
    double width, top, bottom;
    double pitch, bar; /* from group to group; one bar */
    struct ticks ticks;
};

static double bars_y_at(const struct bars_page *page, double value)
{
    const double low = page->ticks.value[0], high = page->ticks.value[page->ticks.count - 1];
    return page->bottom - (value - low) / (high - low) * (page->bottom - page->top);
}

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
    const double left = LEFT + (double)g * page->pitch, zero = bars_y_at(page, 0);
    const double first = left + (page->pitch - page->bar * (double)bars->kind_count) / 2;
    for (size_t k = 0; k < bars->kind_count; k++) {
        const double value = group->values[k], y = bars_y_at(page, value);
        svg_styled_rect(svg, &(struct svg_style){.fill = palette_colour(k)},
                        first + (double)k * page->bar, fmin(y, zero), page->bar * 0.92,
                        fabs(y - zero));
    }
    if (group->label != NULL) {
        svg_text(svg,
                 &(struct svg_label){.x = left + page->pitch / 2,
                                     .y = page->bottom + 20,
                                     .size = NUMBER_SIZE,
                                     .anchor = SVG_MIDDLE,
                                     .bold = group->apart},
                 group->label);
    }
}

bool bars_draw(const struct bars *bars, struct svg *svg, struct error *error)
{
    enum { MOST_GROUPS = 200 };
    const double count = (double)bars->group_count, kinds = (double)bars->kind_count;
    double low, high;
    struct bars_page page = {
        .width = fmax(NARROWEST, LEFT + RIGHT + count * (kinds * NARROWEST_BAR + GAP)),
        .bottom = HEIGHT - BELOW};
    if (bars->group_count > MOST_GROUPS) {
        return fail(error, ERROR_USAGE, "%zu groups of bars: at most %d can be read",
                    bars->group_count, MOST_GROUPS);
    }
    const double longest = 1e100;
    bool any = false;
    low = high = 0;
    for (size_t g = 0; g < bars->group_count; g++) {
        for (size_t k = 0; k < bars->kind_count; k++) {
            const double value = bars->groups[g].values[k];
            if (isfinite(value)) {
                any = true;
                low = fmin(low, value);
                high = fmax(high, value);
            }
        }
    }
    if (!any || !(fmax(high, -low) <= longest)) {
        return fail(error, ERROR_DOMAIN, "no bar has a length that can be drawn");
    }
    page.pitch = (page.width - LEFT - RIGHT) / count;
    page.bar = fmin(WIDEST_BAR, (page.pitch - GAP) / kinds);
    page.top = bars_draw_legend(bars, page.width, NULL) + 16;
    ticks_linear(low, high, &page.ticks);
    svg_begin(svg, page.width, HEIGHT, bars->title);
    svg_group_begin(svg, &(struct svg_style){.fill = "#f0f0f0"});
    for (size_t g = 0; g < bars->group_count; g++) {
        if (bars->groups[g].apart) {
            svg_rect(svg, LEFT + (double)g * page.pitch, page.top, page.pitch,
                     page.bottom - page.top);
        }
    }
    svg_group_end(svg);
    const double right = page.width - RIGHT;
    for (size_t i = 0; i < page.ticks.count; i++) {
        const double y = bars_y_at(&page, page.ticks.value[i]);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8}, LEFT, y, right,
                        y);
        svg_styled_line(svg, &(struct svg_style){.stroke = "#333"}, LEFT - 5, y, LEFT, y);
        svg_words(svg, LEFT - 9, y + 4, NUMBER_SIZE, SVG_END, NULL,
                  ticks_text(svg->arena, &page.ticks, i));
    }
    for (size_t g = 0; g < bars->group_count; g++) {
        draw_group(bars, g, &page, svg);
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333"});
    svg_line(svg, LEFT, bars_y_at(&page, 0), page.width - RIGHT, bars_y_at(&page, 0));
    svg_line(svg, LEFT, page.top, LEFT, page.bottom);
    svg_group_end(svg);
    bars_draw_legend(bars, page.width, svg);
    const double room = page.width - LEFT - 12;
    svg_heading(svg, LEFT, 30, TITLE_SIZE, room, bars->title);
    svg_words_within(svg, LEFT, 50, LABEL_SIZE, room, "#555", bars->subtitle);
    svg_words(svg, (LEFT + page.width - RIGHT) / 2, page.bottom + 48, LABEL_SIZE, SVG_MIDDLE, NULL,
              bars->x_label);
    svg_words_upwards(svg, 22, (page.top + page.bottom) / 2, LABEL_SIZE, bars->y_label);
    svg_end(svg);
    return true;
}
