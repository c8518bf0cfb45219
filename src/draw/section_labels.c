/* draw/section_labels.c - what is written into a cross-section. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "draw/section.h"
#include "draw/svg.h"

#include <math.h>

static const double ELEMENT_SIZE = 11, ELEMENT_GAP = 15; /* px */
static const double LEADER = 16;                         /* px, from the glass to its label */

static const struct svg_style styles[LAYOUT_KINDS] = {
    [LAYOUT_ELEMENT] = {.stroke = "#26323d", .width = 1.1},
    [LAYOUT_AXIS] = {.stroke = "#777777", .width = 0.8, .dash = "14 4 2 4"},
    [LAYOUT_AXIAL] = {.stroke = "#c0392b", .width = 1},
    [LAYOUT_OBLIQUE] = {.stroke = "#1f5fa8", .width = 0.9},
    [LAYOUT_CHIEF] = {.stroke = "#333333", .width = 1.5},
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

const struct svg_style *section_style(enum layout_kind kind)
{
    return &styles[kind];
}

void section_write_text(const struct section_page *page, double x, double y, enum svg_anchor anchor,
                        const char *colour, const char *text)
{
    svg_text(page->svg,
             &(struct svg_label){.x = x,
                                 .y = y,
                                 .size = SECTION_SMALL,
                                 .anchor = anchor,
                                 .colour = colour,
                                 .width = anchor == SVG_START ? SECTION_WIDTH - 16 - x : 0},
             text);
}

/* The end of what lies under or over a label of this width: the element's rim, or `end` (px). */
static double clear_of_glass(const struct section_page *page, double x, double width, double end,
                             double up)
{
    for (size_t i = 0; i < page->layout->part_count; i++) {
        const struct layout_part *part = &page->layout->parts[i];
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

/* The next part to the right that has a label; null: that was the last one. */
static const struct layout_part *next_labelled(const struct layout *layout, double from,
                                               size_t *index)
{
    const struct layout_part *next = NULL;
    size_t place = 0;
    for (size_t i = 0; i < layout->part_count; i++) {
        const struct layout_part *part = &layout->parts[i];
        bool later =
            part->label != NULL && (part->z[0] > from || (!(part->z[0] < from) && i > *index));
        if (later && (next == NULL || part->z[0] < next->z[0])) {
            next = part;
            place = i;
        }
    }
    *index = place;
    return next;
}

/* From left to right, so that each sees what is taken; outwards until it touches no other label. */
void section_write_labels(struct section_page *page)
{
    size_t index = 0;
    const struct layout_part *next = next_labelled(page->layout, -INFINITY, &index);
    for (; next != NULL; next = next_labelled(page->layout, next->z[0], &index)) {
        /* above or below its part */
        bool point = next->kind == LAYOUT_POINT, below = next->kind == LAYOUT_PUPIL || point;
        double width = svg_text_width(next->label, SECTION_SMALL);
        double x = page->x0 + page->scale * next->z[0];
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
        const struct svg_style *style = section_style(next->kind);
        section_write_text(page, x, y, SVG_MIDDLE,
                           style->stroke != NULL ? style->stroke : style->fill, next->label);
    }
}

static const char *element_text(const struct layout *layout, size_t i, struct arena *arena)
{
    return arena_printf(arena, "%zu · %s", i + 1, layout->glasses[layout->elements[i].glass]);
}

bool section_labels_elements(const struct layout *layout)
{
    return (double)layout->element_count * ELEMENT_GAP <= SECTION_WIDTH - 2 * ELEMENT_GAP;
}

double section_element_room(const struct layout *layout)
{
    double longest = 0;
    if (!section_labels_elements(layout)) {
        return 0;
    }
    for (size_t i = 0; i < layout->element_count; i++) {
        const char *text = element_text(layout, i, layout->arena);
        longest = fmax(longest, svg_text_width(text, ELEMENT_SIZE));
    }
    return longest > 0 ? LEADER + longest + 4 : 0;
}

/* Places from left to right become at least ELEMENT_GAP apart, each near to its own. */
static void spread_apart(double *x, size_t count)
{
    for (int step = 0; step < 200; step++) {
        for (size_t i = 1; i < count; i++) {
            double more = ELEMENT_GAP - (x[i] - x[i - 1]);
            if (more > 0) {
                x[i - 1] -= more / 2;
                x[i] += more / 2;
            }
        }
    }
    for (size_t i = 1; i < count; i++) {
        x[i] = fmax(x[i], x[i - 1] + ELEMENT_GAP);
    }
}

void section_write_elements(struct section_page *page)
{
    const struct layout *layout = page->layout;
    struct arena *arena = page->svg->arena;
    const size_t count = section_labels_elements(layout) ? layout->element_count : 0;
    double *x = ARENA_ARRAY(arena, count, double), low = -INFINITY;
    size_t *order = ARENA_ARRAY(arena, count, size_t);
    for (size_t i = 0; i < count; i++) {
        size_t k = i;
        for (; k > 0 && layout->elements[order[k - 1]].z > layout->elements[i].z; k--) {
            order[k] = order[k - 1];
        }
        order[k] = i;
    }
    for (size_t i = 0; i < count; i++) {
        const struct layout_element *element = &layout->elements[order[i]];
        x[i] = page->x0 + page->scale * element->z;
        low = fmax(low, clear_of_glass(page, x[i], ELEMENT_GAP,
                                       page->y0 - page->scale * element->low, -1));
    }
    spread_apart(x, count);
    for (size_t i = 0; i < count; i++) {
        const struct layout_element *element = &layout->elements[order[i]];
        const struct svg_style thin = {.stroke = "#999999", .width = 0.6};
        const char *text = element_text(layout, order[i], arena);
        double at = page->x0 + page->scale * element->z, y = low + LEADER;
        double rim = page->y0 - page->scale * element->low;
        const double leader_x[] = {at, at, x[i]}, leader_y[] = {rim + 1, low + 3, y - 3};
        svg_styled_polyline(page->svg, &thin, leader_x, leader_y, 3);
        svg_text(page->svg,
                 &(struct svg_label){.x = x[i] + ELEMENT_SIZE / 3,
                                     .y = y,
                                     .size = ELEMENT_SIZE,
                                     .rotation = -90,
                                     .anchor = SVG_END},
                 text);
        page->taken[page->taken_count++] =
            (struct svg_box){x[i] - 7, y - 3, x[i] + 7, y + svg_text_width(text, ELEMENT_SIZE) + 2};
    }
}
