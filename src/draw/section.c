/* draw/section.c - cross-sections of a lens on a page, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/section.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>
#include <string.h>

#define MARGIN     44.0
#define TOP        66.0  /* title and subtitle */
#define MOST_HIGH  540.0 /* of the lens, px */
#define MOST_SHEET 900.0 /* of several of them together */
#define LEAST_HIGH 150.0
#define LINE       18.0 /* of the legend */

/* Of the fields, beside the red of the axis. */
static const char *const field_colours[] = {"#1f5fa8", "#c77700", "#00836b",
                                            "#a8478f", "#3f98d1", "#5a5a5a"};
enum { FIELD_COLOURS = sizeof field_colours / sizeof field_colours[0] };

static const char *const names[LAYOUT_KINDS] = {
    [LAYOUT_AXIAL] = "axis",
    [LAYOUT_CHIEF] = "chief rays",
    [LAYOUT_GAUSS] = "rays of the equivalent lens",
    [LAYOUT_EXTENDED] = "extended backwards",
    [LAYOUT_BLOCK] = "blocked",
    [LAYOUT_STOP] = "aperture stop",
    [LAYOUT_MIRROR] = "mirror",
    [LAYOUT_PLANE] = "principal plane",
    [LAYOUT_PUPIL] = "pupil",
};

static const char *const tints[] = {
    "#cfe3f5", "#fbe3bf", "#d3ecd0", "#f3d1d6", "#ddd5f0", "#f6f0b8", "#c5ebe8", "#ecd9c6",
    "#e3e7ea", "#f2cfe6", "#b9d3ea", "#e4efb6", "#f7cdb4", "#c9d8c5", "#d0cbe8", "#e6dfa8",
};
enum { TINTS = sizeof tints / sizeof tints[0] };

/* -------- where the views stand -------- */

/* The box of all parts, mm; z from where all views have the same place. */
struct extent {
    double left, right, low, high;
};

/* One view on the page. */
struct placed_view {
    struct extent box;
    double origin;      /* z of what stands under each other, mm */
    double top, bottom; /* of its parts, px */
};

/* The image planes, where all have one. */
static bool section_has_images(const struct section *section)
{
    for (size_t i = 0; i < section->view_count; i++) {
        if (!isfinite(section->views[i].layout->image)) {
            return false;
        }
    }
    return true;
}

static struct placed_view section_measure(const struct layout *layout, double origin)
{
    struct placed_view view = {.box = {INFINITY, -INFINITY, INFINITY, -INFINITY}, .origin = origin};
    for (size_t i = 0; i < layout->part_count; i++) {
        const struct layout_part *part = &layout->parts[i];
        for (size_t k = 0; k < part->count; k++) {
            view.box.left = fmin(view.box.left, part->z[k] - origin);
            view.box.right = fmax(view.box.right, part->z[k] - origin);
            view.box.low = fmin(view.box.low, part->y[k]);
            view.box.high = fmax(view.box.high, part->y[k]);
        }
    }
    return view;
}

/* Room for rows of labels above and below the lens, px. */
static double label_room(const struct layout *layout, bool below)
{
    size_t count = 0;
    for (size_t i = 0; i < layout->part_count; i++) {
        enum layout_kind kind = layout->parts[i].kind;
        bool under = kind == LAYOUT_POINT || kind == LAYOUT_PUPIL;
        count += layout->parts[i].label != NULL && under == below;
    }
    return 20 + 13 * fmin((double)count, 4);
}

/* How low the glass reaches, mm. */
static double section_glass_low(const struct layout *layout)
{
    double low = INFINITY;
    for (size_t i = 0; i < layout->part_count; i++) {
        const struct layout_part *part = &layout->parts[i];
        for (size_t k = 0; part->kind == LAYOUT_ELEMENT && k < part->count; k++) {
            low = fmin(low, part->y[k]);
        }
    }
    return low;
}

/*
 * Scale and places of all views.
 *
 * Result    where the last one ends, px
 */
static double section_place(struct section_page *page, struct placed_view *views,
                            struct error *error)
{
    const struct section *section = page->section;
    const bool by_images = section->view_count > 1 && section_has_images(section);
    struct extent all = {INFINITY, -INFINITY, 0, 0};
    for (size_t i = 0; i < section->view_count; i++) {
        const struct layout *layout = section->views[i].layout;
        views[i] = section_measure(layout, by_images ? layout->image : 0);
        all.left = fmin(all.left, views[i].box.left);
        all.right = fmax(all.right, views[i].box.right);
        all.high += views[i].box.high - views[i].box.low;
    }
    double across = all.right - all.left;
    if (!(across > 0 && all.high > 0)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: the lens has no extent");
    }
    if (!(across < 1e12 && all.high < 1e12)) {
        return fail(error, ERROR_DOMAIN, "the lens is too large to be drawn");
    }
    page->scale = fmin((SECTION_WIDTH - 2 * MARGIN) / across,
                       (section->view_count > 1 ? MOST_SHEET : MOST_HIGH) / all.high);
    page->x0 = (SECTION_WIDTH - page->scale * (all.left + all.right)) / 2;
    double y = TOP;
    for (size_t i = 0; i < section->view_count; i++) {
        const struct layout *layout = section->views[i].layout;
        const struct extent *box = &views[i].box;
        double high = page->scale * (box->high - box->low);
        double least = section->view_count > 1 ? high : fmax(LEAST_HIGH, high);
        views[i].top = y + label_room(layout, false) + (section->view_count > 1 ? LINE : 0) +
                       (least - high) / 2;
        views[i].bottom = views[i].top + high;
        double below = (least - high) / 2 + label_room(layout, true);
        double glass = page->scale * (box->low - section_glass_low(layout));
        double elements = i == 0 && section_element_room(layout) > 0
                              ? section_element_room(layout) + fmin(glass, 0) + 8
                              : 0;
        y = views[i].bottom + fmax(below, elements);
    }
    return y;
}

/* -------- parts -------- */

static struct svg_style part_style(const struct section_page *page, const struct layout_part *part)
{
    struct svg_style style = *section_style(part->kind);
    if (part->kind == LAYOUT_ELEMENT) {
        style.fill = tints[part->glass % TINTS];
        style.opacity = page->section->faint ? 0.45 : 0;
    } else if (part->kind == LAYOUT_OBLIQUE || part->kind == LAYOUT_CHIEF) {
        style.stroke = field_colours[part->field % FIELD_COLOURS];
    }
    return style;
}

static void draw_part(const struct section_page *page, const struct layout_part *part)
{
    struct svg *svg = page->svg;
    const struct svg_style style = part_style(page, part);
    double *x = ARENA_ARRAY(svg->arena, part->count, double);
    double *y = ARENA_ARRAY(svg->arena, part->count, double);
    for (size_t i = 0; i < part->count; i++) {
        x[i] = page->x0 + page->scale * part->z[i];
        y[i] = page->y0 - page->scale * part->y[i];
    }
    if (part->kind == LAYOUT_ELEMENT) {
        svg_styled_polygon(svg, &style, x, y, part->count);
    } else if (part->kind == LAYOUT_POINT) {
        svg_styled_circle(svg, &style, x[0], y[0], 3);
    } else {
        svg_styled_polyline(svg, &style, x, y, part->count);
    }
    if (part->kind == LAYOUT_ARROW) {
        size_t last = part->count - 1;
        const struct svg_style filled = {.fill = section_style(LAYOUT_ARROW)->stroke};
        double down = y[last] > y[0] ? -9 : 9;
        const double tip_x[] = {x[last], x[last] - 4.5, x[last] + 4.5};
        const double tip_y[] = {y[last], y[last] + down, y[last] + down};
        svg_styled_polygon(page->svg, &filled, tip_x, tip_y, 3);
    }
}

/* The first part of a kind; null: there is none. */
static const struct layout_part *section_part_of(const struct layout *layout, enum layout_kind kind)
{
    for (size_t i = 0; i < layout->part_count; i++) {
        if (layout->parts[i].kind == kind) {
            return &layout->parts[i];
        }
    }
    return NULL;
}

/* -------- the legend -------- */

/* Where the next entry of a legend stands. */
struct legend_pen {
    double left, x, y;
    bool draw; /* false: it is only measured */
};

static void legend_entry(const struct section_page *page, struct legend_pen *pen,
                         const struct svg_style *style, const char *name)
{
    double width = 28 + svg_text_width(name, SECTION_SMALL) + 14;
    /* Go on behind a text of the legend, or in the next line. */
    if (pen->x > pen->left && pen->x + width > SECTION_WIDTH - MARGIN) {
        pen->x = pen->left;
        pen->y += LINE;
    }
    if (pen->draw) {
        svg_styled_line(page->svg, style, pen->x, pen->y - 4, pen->x + 22, pen->y - 4);
        section_write_text(page, pen->x + 28, pen->y, SVG_START, NULL, name);
    }
    pen->x += width;
}

/* The rays of a view by their fields. */
static void legend_fields(const struct section_page *page, struct legend_pen *pen)
{
    const struct layout *layout = page->layout;
    if (section_part_of(layout, LAYOUT_AXIAL) != NULL) {
        legend_entry(page, pen, section_style(LAYOUT_AXIAL), names[LAYOUT_AXIAL]);
    }
    for (size_t i = 0; i < layout->field_count; i++) {
        struct svg_style style = *section_style(LAYOUT_OBLIQUE);
        style.stroke = field_colours[i % FIELD_COLOURS];
        legend_entry(page, pen, &style, layout->fields[i]);
    }
}

static bool is_noted_before(const struct section *section, size_t view, const char *note)
{
    for (size_t i = 0; i < view; i++) {
        for (size_t k = 0; k < section->views[i].layout->note_count; k++) {
            if (strcmp(section->views[i].layout->notes[k], note) == 0) {
                return true;
            }
        }
    }
    return false;
}

/* The legend from y down; returns where it ends. */
static double section_draw_legend(struct section_page *page, double y, bool draw)
{
    const struct section *section = page->section;
    struct legend_pen pen = {MARGIN, MARGIN, y, draw};
    page->layout = section->views[0].layout;
    if (section->view_count == 1) {
        legend_fields(page, &pen);
    }
    for (size_t kind = 0; kind < LAYOUT_KINDS; kind++) {
        const struct layout_part *part = section_part_of(page->layout, (enum layout_kind)kind);
        if (names[kind] != NULL && kind != LAYOUT_AXIAL && part != NULL) {
            const struct svg_style style = part_style(page, part);
            legend_entry(page, &pen, &style, names[kind]);
        }
    }
    y = pen.y + (pen.x > MARGIN ? LINE : 0);
    for (size_t i = 0; i < section->view_count; i++) {
        const struct section_view *view = &section->views[i];
        for (size_t k = 0; k < view->layout->note_count; k++) {
            const char *note = view->layout->notes[k];
            if (is_noted_before(section, i, note)) {
                continue;
            }
            if (draw) {
                section_write_text(page, MARGIN, y, SVG_START, "#444444",
                                   section->view_count > 1
                                       ? arena_printf(page->svg->arena, "%s: %s", view->name, note)
                                       : note);
            }
            y += LINE;
        }
    }
    if (!section_labels_elements(section->views[0].layout)) {
        if (draw) {
            section_write_text(page, MARGIN, y, SVG_START, "#444444",
                               arena_printf(page->svg->arena, "%zu elements: too many to label",
                                            section->views[0].layout->element_count));
        }
        y += LINE;
    }
    return y;
}

/* The table of elements from y down: columns as wide as what is in them; returns where it ends. */
static double section_draw_list(const struct section_page *page, double y)
{
    const struct section_table *list = &page->section->list;
    const struct svg_style rule = {.stroke = "#888888", .width = 0.8};
    double x = MARGIN, gap = 18;
    for (size_t k = 0; k < list->columns; k++) {
        double width = svg_text_width(list->heads[k], SECTION_SMALL);
        for (size_t i = 0; i < list->rows; i++) {
            const char *cell = list->cells[i * list->columns + k];
            width = fmax(width, cell != NULL ? svg_text_width(cell, SECTION_SMALL) : 0);
        }
        section_write_text(page, x + width, y + 14, SVG_END, "#444444", list->heads[k]);
        for (size_t i = 0; i < list->rows; i++) {
            section_write_text(page, x + width, y + 36 + LINE * (double)i, SVG_END, NULL,
                               list->cells[i * list->columns + k]);
        }
        x += width + gap;
    }
    if (list->rows > 0) {
        double end = fmin(x - gap, SECTION_WIDTH - MARGIN);
        svg_styled_line(page->svg, &rule, MARGIN, y + 20, end, y + 20);
        y += 36 + LINE * (double)list->rows;
    }
    return y;
}

/* -------- the page -------- */

static void section_draw_titles(const struct section *section, struct svg *svg)
{
    struct svg_label label = {.x = SECTION_WIDTH / 2,
                              .y = 30,
                              .size = 18,
                              .anchor = SVG_MIDDLE,
                              .width = SECTION_WIDTH - 40,
                              .bold = true};
    svg_title(svg, &label, section->title);
    label.y = 52;
    label.size = 13;
    label.bold = false;
    label.colour = "#444444";
    svg_subtitle(svg, &label, section->subtitle);
}

static void section_draw_view(struct section_page *page, const struct placed_view *placed,
                              size_t view)
{
    const struct section *section = page->section;
    const struct layout *layout = section->views[view].layout;
    const double x0 = page->x0;
    page->layout = layout;
    page->x0 -= page->scale * placed->origin;
    page->y0 = placed->top + page->scale * placed->box.high;
    page->taken =
        ARENA_ARRAY(page->svg->arena, layout->part_count + layout->element_count, struct svg_box);
    page->taken_count = 0;
    for (int kind = 0; kind < LAYOUT_KINDS; kind++) {
        for (size_t i = 0; i < layout->part_count; i++) {
            if ((int)layout->parts[i].kind == kind) {
                draw_part(page, &layout->parts[i]);
            }
        }
    }
    if (view == 0) {
        section_write_elements(page);
    }
    section_write_labels(page);
    if (section->view_count > 1) {
        const double y = placed->top - label_room(layout, false) - 2;
        const struct svg_label name = {.x = MARGIN, .y = y, .size = 13, .bold = true};
        svg_text(page->svg, &name, section->views[view].name);
        double x = MARGIN + svg_text_width(section->views[view].name, 13) * 1.1 + 14;
        section_write_text(page, x, y, SVG_START, "#444444", section->views[view].caption);
        x += svg_text_width(section->views[view].caption, SECTION_SMALL) + 22;
        struct legend_pen pen = {x, x, y, true};
        legend_fields(page, &pen);
    }
    page->x0 = x0;
}

bool section_draw(const struct section *section, struct svg *svg, struct error *error)
{
    struct section_page page = {.svg = svg, .section = section};
    struct placed_view *views = ARENA_ARRAY(svg->arena, section->view_count, struct placed_view);
    double bottom = section_place(&page, views, error);
    if (!(bottom > 0)) {
        return false;
    }
    double height = section_draw_legend(&page, bottom + 46, false) + 8;
    double list = section->list.rows > 0 ? 40 + LINE * (double)section->list.rows : 0;
    svg_begin(svg, SECTION_WIDTH, height + list, section->title);
    section_draw_titles(section, svg);
    for (size_t i = 0; i < section->view_count; i++) {
        section_draw_view(&page, &views[i], i);
    }
    /* 1, 2 or 5 times a power of ten, at most a sixth of the page. */
    double y = bottom + 12;
    double length = ticks_round_below(SECTION_WIDTH / 6 / page.scale);
    double x = MARGIN, end = MARGIN + length * page.scale;
    svg_scale_bar(page.svg, "#000000", x, end, y);
    section_write_text(&page, end + 8, y + 4, SVG_START, NULL,
                       arena_printf(page.svg->arena, "%.10g mm", length));
    section_draw_legend(&page, bottom + 46, true);
    section_draw_list(&page, height - 8);
    svg_end(svg);
    return true;
}
