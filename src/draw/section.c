/* draw/section.c - cross-section of a lens on a page, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/section.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

#define MARGIN     44.0
#define TOP        74.0  /* title and subtitle */
#define MOST_HIGH  540.0 /* of the lens, px */
#define LEAST_HIGH 150.0
#define SMALL      12.0 /* size of labels */
#define LINE       18.0 /* of the legend */

/* Millimetres to px: x = x0 + scale z, y = y0 - scale y. */
struct section_page {
    struct svg *svg;
    const struct section *section;
    double x0, y0, scale;
    double bottom, height; /* of the lens; of the page */
    struct svg_box *taken; /* by labels */
    size_t taken_count;
};

static const struct svg_style styles[LAYOUT_KINDS] = {
    [LAYOUT_ELEMENT] = {.stroke = "#26323d", .width = 1.1},
    [LAYOUT_AXIS] = {.stroke = "#777777", .width = 0.8, .dash = "14 4 2 4"},
    [LAYOUT_AXIAL] = {.stroke = "#c0392b", .width = 1},
    [LAYOUT_OBLIQUE] = {.stroke = "#1f5fa8", .width = 0.9},
    [LAYOUT_CHIEF] = {.stroke = "#1f5fa8", .width = 1.5},
    [LAYOUT_GAUSS] = {.stroke = "#c0392b", .width = 1.2},
    [LAYOUT_EXTENDED] = {.stroke = "#c0392b", .width = 0.9, .dash = "4 4"},
    [LAYOUT_ARROW] = {.stroke = "#000000", .width = 2},
    [LAYOUT_HATCH] = {.stroke = "#555555", .width = 0.8},
    [LAYOUT_MIRROR] = {.stroke = "#000000", .width = 2.6},
    [LAYOUT_BLOCK] = {.stroke = "#000000", .width = 3.4},
    [LAYOUT_STOP] = {.stroke = "#000000", .width = 2.4},
    [LAYOUT_IMAGE] = {.stroke = "#000000", .width = 1.6},
    [LAYOUT_PLANE] = {.stroke = "#1b7a3d", .width = 1.1, .dash = "6 3"},
    [LAYOUT_PUPIL] = {.stroke = "#8e44ad", .width = 1.8},
    [LAYOUT_POINT] = {.fill = "#1b7a3d"},
};

static const char *const names[LAYOUT_KINDS] = {
    [LAYOUT_AXIAL] = "rays from the axis",
    [LAYOUT_OBLIQUE] = "rays of the field's edge",
    [LAYOUT_CHIEF] = "chief ray",
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

/* The box of all parts, mm. */
struct extent {
    double left, right, low, high;
};

static struct extent section_measure(const struct section *section)
{
    struct extent box = {INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (size_t i = 0; i < section->layout->part_count; i++) {
        const struct layout_part *part = &section->layout->parts[i];
        for (size_t k = 0; k < part->count; k++) {
            box.left = fmin(box.left, part->z[k]);
            box.right = fmax(box.right, part->z[k]);
            box.low = fmin(box.low, part->y[k]);
            box.high = fmax(box.high, part->y[k]);
        }
    }
    return box;
}

static void section_write_text(const struct section_page *page, double x, double y,
                               enum svg_anchor anchor, const char *colour, const char *text)
{
    svg_text(page->svg,
             &(struct svg_label){.x = x,
                                 .y = y,
                                 .size = SMALL,
                                 .anchor = anchor,
                                 .colour = colour,
                                 .width = anchor == SVG_START ? SECTION_WIDTH - 16 - x : 0},
             text);
}

/* The end of what lies under or over a label of this width: the element's rim, or `end` (px). */
static double clear_of_glass(const struct section_page *page, double x, double width, double end,
                             double up)
{
    for (size_t i = 0; i < page->section->layout->part_count; i++) {
        const struct layout_part *part = &page->section->layout->parts[i];
        for (size_t k = 0; part->kind == LAYOUT_ELEMENT && k < part->count; k++) {
            double at = page->x0 + page->scale * part->z[k];
            double y = page->y0 - page->scale * part->y[k];
            if (fabs(at - x) < width / 2 + 3 && (y - end) * up < 0) {
                end = y;
            }
        }
    }
    return end;
}

/* Labels from left to right, so that each sees what is taken. */
static void write_labels(struct section_page *page)
{
    const struct section *section = page->section;
    double from = -INFINITY;
    size_t index = 0;
    for (;;) {
        const struct layout_part *next = NULL;
        size_t place = 0;
        for (size_t i = 0; i < section->layout->part_count; i++) {
            const struct layout_part *part = &section->layout->parts[i];
            bool later =
                part->label != NULL && (part->z[0] > from || (!(part->z[0] < from) && i > index));
            if (later && (next == NULL || part->z[0] < next->z[0])) {
                next = part;
                place = i;
            }
        }
        if (next == NULL) {
            return;
        }
        /* Above or below its part, outwards until it touches no other label. */
        bool point = next->kind == LAYOUT_POINT, below = next->kind == LAYOUT_PUPIL || point;
        double width = svg_text_width(next->label, SMALL), x = page->x0 + page->scale * next->z[0];
        double up = below ? -1 : 1, end = next->y[next->count - 1];
        double y = page->y0 - page->scale * end;
        x += point ? 5 + width / 2 : 0;
        x = fmax(8 + width / 2, fmin(SECTION_WIDTH - 8 - width / 2, x));
        y = (point ? y : clear_of_glass(page, x, width, y, up)) + (below ? 15 : -6);
        struct svg_box box = {x - width / 2 - 2, y - 10, x + width / 2 + 2, y + 2};
        while (!svg_is_free(page->taken, page->taken_count, &box)) {
            y -= 13 * up;
            box.top = y - 10;
            box.bottom = y + 2;
        }
        page->taken[page->taken_count++] = box;
        const struct svg_style *style = &styles[next->kind];
        section_write_text(page, x, y, SVG_MIDDLE,
                           style->stroke != NULL ? style->stroke : style->fill, next->label);
        from = next->z[0];
        index = place;
    }
}

static void draw_part(const struct section_page *page, const struct layout_part *part)
{
    struct svg *svg = page->svg;
    struct svg_style style = styles[part->kind];
    double *x = ARENA_ARRAY(svg->arena, part->count, double);
    double *y = ARENA_ARRAY(svg->arena, part->count, double);
    for (size_t i = 0; i < part->count; i++) {
        x[i] = page->x0 + page->scale * part->z[i];
        y[i] = page->y0 - page->scale * part->y[i];
    }
    if (part->kind == LAYOUT_ELEMENT) {
        style.fill = tints[part->glass % TINTS];
        style.opacity = page->section->faint ? 0.45 : 0;
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
        const struct svg_style filled = {.fill = styles[LAYOUT_ARROW].stroke};
        double down = y[last] > y[0] ? -9 : 9;
        const double tip_x[] = {x[last], x[last] - 4.5, x[last] + 4.5};
        const double tip_y[] = {y[last], y[last] + down, y[last] + down};
        svg_styled_polygon(page->svg, &filled, tip_x, tip_y, 3);
    }
}

static bool occurs(const struct section *section, enum layout_kind kind)
{
    for (size_t i = 0; i < section->layout->part_count; i++) {
        if (section->layout->parts[i].kind == kind) {
            return true;
        }
    }
    return false;
}

/* The legend from y down; returns where it ends. With `draw` false it is only measured. */
static double section_draw_legend(const struct section_page *page, double y, bool draw)
{
    const struct section *section = page->section;
    double x = MARGIN;
    for (size_t i = 0; i < section->layout->glass_count + LAYOUT_KINDS; i++) {
        bool glass = i < section->layout->glass_count;
        size_t kind = glass ? LAYOUT_ELEMENT : i - section->layout->glass_count;
        const char *name = glass ? section->layout->glasses[i] : names[kind];
        if (i == section->layout->glass_count && x > MARGIN) {
            x = MARGIN;
            y += LINE;
        }
        if (name == NULL || (!glass && !occurs(section, (enum layout_kind)kind))) {
            continue;
        }
        double width = 28 + svg_text_width(name, SMALL) + 14;
        /* Go on behind a text of the legend, or in the next line. */
        if (x > MARGIN && x + width > SECTION_WIDTH - MARGIN) {
            x = MARGIN;
            y += LINE;
        }
        if (draw) {
            struct svg_style style = styles[kind];
            style.fill = glass ? tints[i % TINTS] : NULL;
            if (glass) {
                svg_styled_rect(page->svg, &style, x, y - 10, 20, 11);
            } else {
                svg_styled_line(page->svg, &style, x, y - 4, x + 22, y - 4);
            }
            section_write_text(page, x + 28, y, SVG_START, NULL, name);
        }
        x += width;
    }
    y += x > MARGIN ? LINE : 0;
    for (size_t i = 0; i < section->layout->note_count; i++, y += LINE) {
        if (draw) {
            section_write_text(page, MARGIN, y, SVG_START, "#444444", section->layout->notes[i]);
        }
    }
    return y;
}

/* Room for rows of labels above and below the lens, px. */
static double label_room(const struct section *section, bool below)
{
    size_t count = 0;
    for (size_t i = 0; i < section->layout->part_count; i++) {
        enum layout_kind kind = section->layout->parts[i].kind;
        bool under = kind == LAYOUT_POINT || kind == LAYOUT_PUPIL;
        count += section->layout->parts[i].label != NULL && under == below;
    }
    return 20 + 13 * fmin((double)count, 4);
}

bool section_draw(const struct section *section, struct svg *svg, struct error *error)
{
    struct section_page page = {.svg = svg, .section = section};
    const struct extent box = section_measure(section);
    double across = box.right - box.left, high = box.high - box.low;
    if (!(across > 0 && high > 0)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: the lens has no extent");
    }
    if (!(across < 1e12 && high < 1e12)) {
        return fail(error, ERROR_DOMAIN, "the lens is too large to be drawn");
    }
    page.scale = fmin((SECTION_WIDTH - 2 * MARGIN) / across, MOST_HIGH / high);
    double above = TOP + label_room(section, false), room = fmax(LEAST_HIGH, page.scale * high);
    page.x0 = (SECTION_WIDTH - page.scale * (box.left + box.right)) / 2;
    page.y0 = above + room / 2 + page.scale * (box.low + box.high) / 2;
    page.bottom = above + room + label_room(section, true);
    page.height = section_draw_legend(&page, page.bottom + 46, false) + 8;
    page.taken = ARENA_ARRAY(svg->arena, section->layout->part_count, struct svg_box);
    svg_begin(svg, SECTION_WIDTH, page.height, section->title);
    const struct svg_label title = {.x = SECTION_WIDTH / 2,
                                    .y = 30,
                                    .size = 18,
                                    .anchor = SVG_MIDDLE,
                                    .width = SECTION_WIDTH - 40,
                                    .bold = true};
    const struct svg_label below = {.x = SECTION_WIDTH / 2,
                                    .y = 52,
                                    .size = 13,
                                    .anchor = SVG_MIDDLE,
                                    .width = SECTION_WIDTH - 40,
                                    .colour = "#444444"};
    svg_text(svg, &title, section->title);
    svg_text(svg, &below, section->subtitle);
    for (int kind = 0; kind < LAYOUT_KINDS; kind++) {
        for (size_t i = 0; i < section->layout->part_count; i++) {
            if ((int)section->layout->parts[i].kind == kind) {
                draw_part(&page, &section->layout->parts[i]);
            }
        }
    }
    write_labels(&page);
    /* 1, 2 or 5 times a power of ten, at most a sixth of the page. */
    double y = page.bottom + 12;
    double length = ticks_round_below(SECTION_WIDTH / 6 / page.scale);
    double x = MARGIN, end = MARGIN + length * page.scale;
    svg_scale_bar(page.svg, "#000000", x, end, y);
    section_write_text(&page, end + 8, y + 4, SVG_START, NULL,
                       arena_printf(page.svg->arena, "%.10g mm", length));
    section_draw_legend(&page, page.bottom + 46, true);
    svg_end(svg);
    return true;
}
