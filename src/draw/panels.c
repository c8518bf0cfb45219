/* draw/panels.c - many small plots on one page, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/panels.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/panels_cell.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>
#include <stddef.h>

/* Given: panels, svg and the shared scales; the rest is set by panels_page_begin. */
struct panels_page {
    const struct panels *panels;
    struct svg *svg;
    struct panels_scale x, y;
    double left, top;        /* px, of the first panel */
    double width, height;    /* of a panel */
    double across, down;     /* from one panel to the next */
    double bottom;           /* px, below the notes and numbers of the last panels */
    double total_x, total_y; /* of the page */
};

static const double MARGIN = 20, TITLE = 17, WORDS = 13, LINE = 20; /* px */
static const double BOLD = 1.12;                                    /* letters, to plain ones */
static const double CAPTION = 26;                                   /* above a row */
static const double SAMPLE = 28;                                    /* px of a line in the legend */

static const char *const DARK = "#1d1d1d", *const SOFT = "#444";

/* -------- the legend -------- */

/* Where the words of an entry begin, and the next entry. */
static double words_from(bool spots)
{
    return spots ? 14 : SAMPLE + 8;
}

/* The legend from `y` on; drawn only if asked. The base line of its last line. */
static double lay_legend(const struct panels_page *page, double y, bool drawn)
{
    const struct panels *panels = page->panels;
    const double limit = page->total_x - MARGIN;
    double x = MARGIN, first = y;
    /* Are the keys used by spots only? Then their samples are spots. */
    bool spots = true;
    for (size_t i = 0; i < panels->count; i++) {
        for (size_t s = 0; s < panels->panels[i].count; s++) {
            spots = spots && panels->panels[i].series[s].spots;
        }
    }
    size_t count = panels->keys != NULL ? panels->key_count : 0;
    for (size_t key = 0; key <= count; key++) {
        const char *words = key < count ? panels->keys[key] : panels->circle_label;
        if (words == NULL) {
            continue;
        }
        const bool circle = key == count;
        double width = words_from(spots || circle) + svg_text_width(words, WORDS) + 18;
        /* Room for an entry: on the next line if it does not end within the page. */
        if (x + width > limit && x > MARGIN) {
            x = MARGIN;
            y += LINE;
        }
        if (drawn) {
            if (circle) {
                svg_styled_circle(page->svg,
                                  &(struct svg_style){.stroke = SOFT, .width = 1, .dash = "3 3"},
                                  x + 5, y - 4, 5);
            } else {
                const double xs[2] = {x + (spots ? 5 : 0), x + SAMPLE}, ys[2] = {y - 4, y - 4};
                const struct panels_mark mark = {.x = xs,
                                                 .y = ys,
                                                 .count = spots ? 1 : 2,
                                                 .key = key,
                                                 .spots = spots,
                                                 .large = true};
                panels_marks_draw(page->panels, page->svg, &mark);
            }
            svg_words(page->svg, x + words_from(spots || circle), y, WORDS, SVG_START, NULL, words);
        }
        x += width;
    }
    return x > MARGIN ? y : first - LINE;
}

/* -------- measures -------- */

static void set_size(struct panels_page *page)
{
    static const struct {
        size_t columns;
        double width, height, square;
    } sizes[] = {{1, 480, 220, 280}, {2, 330, 150, 250}, {3, 250, 140, 220}, {4, 200, 125, 180},
                 {6, 160, 110, 150}, {9, 130, 100, 110}, {99, 110, 90, 84}};
    size_t i = 0;
    while (sizes[i].columns < page->panels->columns) {
        i++;
    }
    bool square = page->panels->unit != NULL;
    page->width = square ? sizes[i].square : sizes[i].width;
    page->height = square ? sizes[i].square : sizes[i].height;
    if (page->panels->tall) {
        page->width *= 0.8;
        page->height = 1.15 * page->width;
    }
}

static bool any_title(const struct panels *panels)
{
    bool any = false;
    for (size_t i = 0; i < panels->count; i++) {
        any = any || panels->panels[i].title != NULL;
    }
    return any;
}

/* Px left of each panel where own_y is set, else of the first. */
static double beside(const struct panels_page *page)
{
    const struct panels *panels = page->panels;
    if (panels->unit != NULL) {
        return 0;
    }
    return panels->own_y ? PANELS_NUMBERS + 22
                         : ticks_width(page->svg->arena, &page->y.ticks, PANELS_NUMBER_SIZE) + 10;
}

/* Between two panels of a row, so that the numbers at the ends of their axes are apart. */
static double gap_across(const struct panels_page *page, double beside_each)
{
    const struct panels *panels = page->panels;
    if (panels->unit != NULL) {
        return 14;
    }
    double ends = panels->own_x ? PANELS_NUMBERS
                                : ticks_width(page->svg->arena, &page->x.ticks, PANELS_NUMBER_SIZE);
    return panels->own_y ? beside_each + 12 : ends + 10;
}

static void panels_page_set_grid(struct panels_page *page)
{
    const struct panels *panels = page->panels;
    bool square = panels->unit != NULL;
    double numbers = beside(page), title = any_title(panels) ? 20 : 0;
    const double caption = panels->row_captions != NULL ? CAPTION : 0;
    double below = 14, under = 20; /* notes or numbers: of each row, and of the last */
    if (square) {
        below = 24;
    } else if (panels->own_x) {
        below = 48;
        under = 38;
    }
    page->left =
        MARGIN + (panels->y_label != NULL ? 22 : 0) + (panels->row_heads ? 22 : 0) + numbers;
    page->across = page->width + gap_across(page, numbers);
    page->down = page->height + title + below + caption;
    double grid = page->left + page->across * (double)(panels->columns - 1) + page->width + MARGIN;
    double words = fmax(panels->title != NULL ? BOLD * svg_text_width(panels->title, TITLE) : 0,
                        panels->subtitle != NULL ? svg_text_width(panels->subtitle, WORDS) : 0);
    const size_t rows = (panels->count + panels->columns - 1) / panels->columns;
    for (size_t i = 0; panels->row_captions != NULL && i < rows; i++) {
        words = fmax(words, page->left - MARGIN + svg_text_width(panels->row_captions[i], WORDS));
    }
    page->total_x = fmax(fmax(grid, 440), fmin(words + 2 * MARGIN + 1, 1000));
    double legend = lay_legend(page, panels->subtitle != NULL ? 76 : 56, false);
    page->top = legend + 16 + title + caption + (panels->column_heads != NULL ? 20 : 0);
    page->bottom = page->top + page->down * (double)(rows - 1) + page->height + under;
    page->total_y = page->bottom + (panels->x_label != NULL ? 20 : 0) + (square ? 30 : 0) + 10;
}

/* Measure the page and draw title, subtitle and legend. */
static void panels_page_begin(struct panels_page *page)
{
    const struct panels *panels = page->panels;
    set_size(page);
    panels_page_set_grid(page);
    svg_begin(page->svg, page->total_x, page->total_y, panels->title);
    double room = page->total_x - 2 * MARGIN;
    svg_heading(page->svg, MARGIN, 30, TITLE, room, panels->title);
    svg_subheading(page->svg, MARGIN, 52, WORDS, room, panels->subtitle);
    lay_legend(page, panels->subtitle != NULL ? 76 : 56, true);
}

/* Where panel i lies, with the shared scales. */
static struct panels_cell panels_page_cell(const struct panels_page *page, size_t i)
{
    const struct panels *panels = page->panels;
    size_t column = i % panels->columns, row = i / panels->columns;
    return (struct panels_cell){
        .left = page->left + page->across * (double)column,
        .top = page->top + page->down * (double)row,
        .width = page->width,
        .height = page->height,
        .room = page->across - 4,
        .x = page->x,
        .y = page->y,
        .x_numbers = panels->own_x || i + panels->columns >= panels->count,
        .y_numbers = panels->own_y || column == 0,
    };
}

/* -------- around them -------- */

static void draw_heads(const struct panels_page *page)
{
    const struct panels *panels = page->panels;
    size_t rows = (panels->count + panels->columns - 1) / panels->columns;
    for (size_t i = 0; panels->column_heads != NULL && i < panels->columns; i++) {
        const struct panels_cell cell = panels_page_cell(page, i);
        const struct svg_label label = {.x = cell.left + cell.width / 2,
                                        .y = cell.top - (any_title(panels) ? 27 : 7) -
                                             (panels->row_captions != NULL ? CAPTION : 0),
                                        .size = WORDS,
                                        .width = page->across - 4,
                                        .anchor = SVG_MIDDLE,
                                        .bold = true};
        svg_text(page->svg, &label, panels->column_heads[i]);
    }
    for (size_t i = 0; panels->row_captions != NULL && i < rows; i++) {
        const struct panels_cell cell = panels_page_cell(page, i * panels->columns);
        svg_words_within(page->svg, cell.left, cell.top - (any_title(panels) ? 28 : 9), WORDS,
                         page->total_x - cell.left - 4, NULL, panels->row_captions[i]);
    }
    for (size_t i = 0; panels->row_heads != NULL && i < rows; i++) {
        const struct panels_cell cell = panels_page_cell(page, i * panels->columns);
        const char *head = panels->row_heads[i] != NULL ? panels->row_heads[i] : "";
        /* long ones are smaller; bold is a tenth wider than what the width is counted for */
        double room = page->down - 12, width = 1.1 * svg_text_width(head, WORDS);
        svg_text(page->svg,
                 &(struct svg_label){.x = cell.left - beside(page) - 10,
                                     .y = cell.top + cell.height / 2,
                                     .size = WORDS * fmax(0.6, fmin(1, room / width)),
                                     .rotation = -90,
                                     .width = room,
                                     .anchor = SVG_MIDDLE,
                                     .bold = true},
                 head);
    }
}

/* Draw heads, labels of the axes and the scale bar, and end the drawing. */
static void panels_page_end(const struct panels_page *page)
{
    const struct panels *panels = page->panels;
    double across = page->across * (double)(panels->columns - 1) + page->width;
    double down = page->bottom - page->top;
    draw_heads(page);
    const struct svg_label below = {.x = page->left + across / 2,
                                    .y = page->bottom + 16,
                                    .size = WORDS,
                                    .width = page->total_x - 2 * MARGIN,
                                    .anchor = SVG_MIDDLE};
    const struct svg_label side = {.x = MARGIN + 10,
                                   .y = page->top + down / 2,
                                   .size = WORDS,
                                   .rotation = -90,
                                   .width = down + 60,
                                   .anchor = SVG_MIDDLE};
    svg_text(page->svg, &below, panels->x_label);
    svg_text(page->svg, &side, panels->y_label);
    if (panels->unit != NULL) {
        /* A round length of at most half a panel. */
        double y = page->total_y - 16;
        double scale = page->width / (page->x.high - page->x.low);
        double length = ticks_round_below(page->width / 2 / scale);
        double left = page->left, end = left + length * scale;
        struct svg *svg = page->svg;
        svg_scale_bar(svg, DARK, left, end, y);
        svg_words(svg, end + 8, y + 4, WORDS, SVG_START, NULL,
                  arena_printf(svg->arena, "%s %s", ticks_fixed(svg->arena, length, 0),
                               page->panels->unit));
    }
    svg_end(page->svg);
}

enum { MOST = 400, MOST_COLUMNS = 20 };

static const double FARTHEST = 1e12;

/* -------- ranges -------- */

static void panels_include(struct panels_scale *scale, double low, double high)
{
    scale->low = fmin(scale->low, low);
    scale->high = fmax(scale->high, high);
}

static void include_panel(const struct panel *panel, struct panels_scale *x, struct panels_scale *y)
{
    for (size_t s = 0; s < panel->count; s++) {
        const struct panel_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count; i++) {
            if (isfinite(series->x[i]) && isfinite(series->y[i])) {
                panels_include(x, series->x[i], series->x[i]);
                panels_include(y, series->y[i], series->y[i]);
            }
        }
    }
}

/* To round numbers; an x range that was given keeps its ends. */
static void set_axes(const struct panels *panels, struct panels_scale *x, struct panels_scale *y)
{
    bool given = !panels->own_x && panels->x_low < panels->x_high;
    if (given) {
        panels_include(x, panels->x_low, panels->x_high);
    }
    if (!panels->own_y && panels->y_low < panels->y_high) {
        panels_include(y, panels->y_low, panels->y_high);
    }
    ticks_linear(x->low, x->high, &x->ticks);
    ticks_linear(y->low, y->high, &y->ticks);
    if (!given) {
        panels_include(x, x->ticks.value[0], x->ticks.value[x->ticks.count - 1]);
    }
    panels_include(y, y->ticks.value[0], y->ticks.value[y->ticks.count - 1]);
}

/* How far out a panel of spots is looked at. */
static double spots_reach(const struct panel *panel, struct arena *arena)
{
    size_t all = 0, count = 0;
    for (size_t s = 0; s < panel->count; s++) {
        all += panel->series[s].count;
    }
    double *far = ARENA_ARRAY(arena, all + 1, double);
    for (size_t s = 0; s < panel->count; s++) {
        const struct panel_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count; i++) {
            far[count] = fmax(fabs(series->x[i]), fabs(series->y[i]));
            count += isfinite(series->x[i] + series->y[i]) ? 1 : 0;
        }
    }
    return ticks_reach(far, count);
}

static const struct panels_scale nothing = {.low = INFINITY, .high = -INFINITY};

static bool set_shared(struct panels_page *page, struct error *error)
{
    const struct panels *panels = page->panels;
    page->x = page->y = nothing;
    for (size_t i = 0; i < panels->count; i++) {
        include_panel(&panels->panels[i], &page->x, &page->y);
    }
    if (!(page->y.low <= page->y.high)) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw: no panel has a point");
    }
    double most = fmax(fmax(-page->x.low, page->x.high), fmax(-page->y.low, page->y.high));
    if (most > FARTHEST) {
        return fail(error, ERROR_DOMAIN, "a value of %g cannot be drawn: the limit is %g", most,
                    FARTHEST);
    }
    if (panels->unit) {
        /* One scale for both directions, the origin in the middle. */
        most = 0;
        for (size_t k = 0; k < panels->count; k++) {
            most = fmax(most, panels->panels[k].circle);
            most = fmax(most, spots_reach(&panels->panels[k], page->svg->arena));
        }
        most = most > 0 ? 1.06 * most : 1;
        page->x = page->y = (struct panels_scale){.low = -most, .high = most};
    } else {
        set_axes(panels, &page->x, &page->y);
    }
    return true;
}

/* The scales of one panel: its own where it has one and a point to set it by. */
static void choose_scales(const struct panels_page *page, const struct panel *panel,
                          struct panels_scale *x, struct panels_scale *y)
{
    const struct panels *panels = page->panels;
    struct panels_scale own_x = nothing, own_y = nothing;
    include_panel(panel, &own_x, &own_y);
    bool any = own_x.low <= own_x.high && !panels->unit;
    if (any) {
        set_axes(panels, &own_x, &own_y);
    }
    *x = any && panels->own_x ? own_x : page->x;
    *y = any && panels->own_y ? own_y : page->y;
}

bool panels_draw(const struct panels *panels, struct svg *svg, struct error *error)
{
    struct panels_page page = {.panels = panels, .svg = svg};
    if (panels->count > MOST || panels->columns > MOST_COLUMNS) {
        return fail(error, ERROR_USAGE,
                    "a page of %zu panels in %zu columns: at most %d in %d can be distinguished",
                    panels->count, panels->columns, MOST, MOST_COLUMNS);
    }
    if (!set_shared(&page, error)) {
        return false;
    }
    panels_page_begin(&page);
    for (size_t i = 0; i < panels->count; i++) {
        struct panels_cell cell = panels_page_cell(&page, i);
        if (panels->panels[i].is_absent) {
            continue;
        }
        choose_scales(&page, &panels->panels[i], &cell.x, &cell.y);
        panels_cell_draw(panels, svg, &cell, &panels->panels[i]);
    }
    panels_page_end(&page);
    return true;
}
