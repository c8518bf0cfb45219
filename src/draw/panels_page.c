/* draw/panels_page.c - the page that panels lie on: its measures and words. */
/* SPDX-License-Identifier: MIT */
#include "draw/panels_page.h"

#include "base/arena.h"
#include "draw/panels.h"
#include "draw/panels_marks.h"
#include "draw/svg.h"

#include <math.h>

static const double MARGIN = 20, TITLE = 17, WORDS = 13, LINE = 20; /* px */
static const double BOLD = 1.12;                                    /* letters, to plain ones */
static const double SAMPLE = 28;                                    /* px of a line in the legend */

static const char *const DARK = "#1d1d1d", *const SOFT = "#444";

static void panels_page_write_at(struct svg *svg, const struct svg_label *label, const char *words)
{
    if (words != NULL) {
        svg_text(svg, label, words);
    }
}

/* -------- the legend -------- */

struct pen {
    double x, y;
};

/* Where the words of an entry begin, and the next entry. */
static double words_from(bool spots)
{
    return spots ? 14 : SAMPLE + 8;
}

static double entry_width(const char *words, bool spots)
{
    return words_from(spots) + svg_text_width(words, WORDS) + 18;
}

/* Are the keys used by spots only? Then their samples are spots. */
static bool only_spots(const struct panels *panels)
{
    bool spots = true;
    for (size_t i = 0; i < panels->count; i++) {
        for (size_t s = 0; s < panels->panels[i].count; s++) {
            spots = spots && panels->panels[i].series[s].spots;
        }
    }
    return spots;
}

static void draw_sample(const struct panels_page *page, size_t key, const struct pen *pen,
                        bool spots)
{
    const double x[2] = {pen->x + (spots ? 5 : 0), pen->x + SAMPLE};
    const double y[2] = {pen->y - 4, pen->y - 4};
    const struct panels_mark mark = {
        .x = x, .y = y, .count = spots ? 1 : 2, .key = key, .spots = spots, .large = true};
    panels_marks_draw(page->panels, page->svg, &mark);
}

static void draw_entry(const struct panels_page *page, size_t key, const struct pen *pen,
                       bool spots)
{
    const struct panels *panels = page->panels;
    bool circle = panels->keys == NULL || key >= panels->key_count;
    if (circle) {
        svg_styled_circle(page->svg, &(struct svg_style){.stroke = SOFT, .width = 1, .dash = "3 3"},
                          pen->x + 5, pen->y - 4, 5);
    } else {
        draw_sample(page, key, pen, spots);
    }
    svg_words(page->svg, pen->x + words_from(spots || circle), pen->y, WORDS, SVG_START, NULL,
              circle ? panels->circle_label : panels->keys[key]);
}

/* The legend from `y` on; drawn only if asked. The base line of its last line. */
static double lay_legend(const struct panels_page *page, double y, bool drawn)
{
    const struct panels *panels = page->panels;
    struct pen pen = {MARGIN, y};
    bool spots = only_spots(panels);
    size_t count = panels->keys != NULL ? panels->key_count : 0;
    for (size_t key = 0; key <= count; key++) {
        const char *words = key < count ? panels->keys[key] : panels->circle_label;
        if (words == NULL) {
            continue;
        }
        double width = entry_width(words, spots || key == count);
        /* Room for an entry: on the next line if it does not end within the page. */
        double limit = page->total_x - MARGIN;
        if (pen.x + width > limit && pen.x > MARGIN) {
            pen.x = MARGIN;
            pen.y += LINE;
        }
        if (drawn) {
            draw_entry(page, key, &pen, spots);
        }
        pen.x += width;
    }
    return pen.x > MARGIN ? pen.y : y - LINE;
}

/* -------- measures -------- */

static void set_size(struct panels_page *page)
{
    static const struct {
        size_t columns;
        double width, height, square;
    } sizes[] = {{1, 480, 220, 220}, {2, 330, 150, 180}, {3, 250, 140, 150}, {4, 200, 125, 150},
                 {6, 160, 110, 130}, {9, 130, 100, 110}, {99, 110, 90, 84}};
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
    return panels->own_y ? PANELS_NUMBERS + 22 : panels_cell_number(page->svg, &page->y.ticks) + 10;
}

/* Between two panels of a row, so that the numbers at the ends of their axes are apart. */
static double gap_across(const struct panels_page *page, double beside_each)
{
    const struct panels *panels = page->panels;
    if (panels->unit != NULL) {
        return 14;
    }
    double ends = panels->own_x ? PANELS_NUMBERS : panels_cell_number(page->svg, &page->x.ticks);
    return panels->own_y ? beside_each + 12 : ends + 10;
}

static void panels_page_set_grid(struct panels_page *page)
{
    const struct panels *panels = page->panels;
    bool square = panels->unit != NULL;
    double numbers = beside(page), title = any_title(panels) ? 20 : 0;
    page->left =
        MARGIN + (panels->y_label != NULL ? 22 : 0) + (panels->row_heads ? 22 : 0) + numbers;
    page->across = page->width + gap_across(page, numbers);
    page->down = page->height + title + (square ? 24 : panels->own_x ? 48 : 14);
    double grid = page->left + page->across * (double)(panels->columns - 1) + page->width + MARGIN;
    double words = fmax(panels->title != NULL ? BOLD * svg_text_width(panels->title, TITLE) : 0,
                        panels->subtitle != NULL ? svg_text_width(panels->subtitle, WORDS) : 0);
    page->total_x = fmax(fmax(grid, 440), fmin(words + 2 * MARGIN, 1000));
    double legend = lay_legend(page, panels->subtitle != NULL ? 76 : 56, false);
    page->top = legend + 16 + title + (panels->column_heads != NULL ? 20 : 0);
    size_t rows = (panels->count + panels->columns - 1) / panels->columns;
    double under = square ? 20 : panels->own_x ? 38 : 20; /* notes or numbers */
    page->bottom = page->top + page->down * (double)(rows - 1) + page->height + under;
    page->total_y = page->bottom + (panels->x_label != NULL ? 20 : 0) + (square ? 30 : 0) + 10;
}

void panels_page_begin(struct panels_page *page)
{
    const struct panels *panels = page->panels;
    set_size(page);
    panels_page_set_grid(page);
    svg_begin(page->svg, page->total_x, page->total_y, panels->title);
    double room = page->total_x - 2 * MARGIN;
    panels_page_write_at(
        page->svg,
        &(struct svg_label){.x = MARGIN, .y = 30, .size = TITLE, .width = room, .bold = true},
        panels->title);
    panels_page_write_at(
        page->svg,
        &(struct svg_label){.x = MARGIN, .y = 52, .size = WORDS, .width = room, .colour = SOFT},
        panels->subtitle);
    lay_legend(page, panels->subtitle != NULL ? 76 : 56, true);
}

struct panels_cell panels_page_cell(const struct panels_page *page, size_t i)
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
                                        .y = cell.top - (any_title(panels) ? 27 : 7),
                                        .size = WORDS,
                                        .width = page->across - 4,
                                        .anchor = SVG_MIDDLE,
                                        .bold = true};
        panels_page_write_at(page->svg, &label, panels->column_heads[i]);
    }
    for (size_t i = 0; panels->row_heads != NULL && i < rows; i++) {
        const struct panels_cell cell = panels_page_cell(page, i * panels->columns);
        const char *head = panels->row_heads[i] != NULL ? panels->row_heads[i] : "";
        /* long ones are smaller; bold is a tenth wider than what the width is counted for */
        double room = page->down - 12, width = 1.1 * svg_text_width(head, WORDS);
        const struct svg_label label = {.x = cell.left - beside(page) - 10,
                                        .y = cell.top + cell.height / 2,
                                        .size = WORDS * fmax(0.6, fmin(1, room / width)),
                                        .rotation = -90,
                                        .width = room,
                                        .anchor = SVG_MIDDLE,
                                        .bold = true};
        svg_text(page->svg, &label, head);
    }
}

/* A round length of at most half a panel. */
static void panels_page_draw_bar(const struct panels_page *page, double y)
{
    double scale = page->width / (page->x.high - page->x.low), most = page->width / 2 / scale;
    double power = pow(10, floor(log10(most)));
    double length = most >= 5 * power ? 5 * power : most >= 2 * power ? 2 * power : power;
    double left = page->left, end = left + length * scale;
    struct svg *svg = page->svg;
    svg_group_begin(svg, &(struct svg_style){.stroke = DARK, .width = 1.4});
    svg_line(svg, left, y, end, y);
    svg_line(svg, left, y - 4, left, y + 4);
    svg_line(svg, end, y - 4, end, y + 4);
    svg_group_end(svg);
    svg_words(
        svg, end + 8, y + 4, WORDS, SVG_START, NULL,
        arena_printf(svg->arena, "%s %s", ticks_fixed(svg->arena, length, 0), page->panels->unit));
}

void panels_page_end(const struct panels_page *page)
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
    panels_page_write_at(page->svg, &below, panels->x_label);
    panels_page_write_at(page->svg, &side, panels->y_label);
    if (panels->unit != NULL) {
        panels_page_draw_bar(page, page->total_y - 16);
    }
    svg_end(page->svg);
}
