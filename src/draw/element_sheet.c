/* draw/element_sheet.c - the drawing of an optical element in the tabular form of ISO 10110-1. */
/* SPDX-License-Identifier: MIT */
#include "draw/element_sheet.h"

#include "base/arena.h"

#include <math.h>

/* Coordinates are tenths of a millimetre. */
static const double UNITS = 10, LEFT = 60, RIGHT = 2040, MIDDLE_X = 1050, AXIS_Y = 560;
static const double FIELD_TOP = 170, FIELD_BOTTOM = 980, TABLE_TOP = 1010, LINE = 62;
static const double ROOM_X = 900, ROOM_Y = 520; /* for the element itself */
static const double SIZE = 32, ARROW = 16;
static const double RADIUS_AT = 0.55; /* height at which arrows meet the surfaces, over the rim's */
static const char *const BLACK = "#000000";

/* The largest round scale at which the element has room, as length on paper over its own. */
static double sheet_scale(const struct element_sheet *sheet)
{
    static const double scales[] = {100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
    double left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < sheet->count; i++) {
        left = fmin(left, sheet->z[i]);
        right = fmax(right, sheet->z[i]);
    }
    size_t i = 0;
    while (i + 1 < sizeof scales / sizeof scales[0] &&
           UNITS * scales[i] * fmax((right - left) / ROOM_X, sheet->diameter / ROOM_Y) > 1) {
        i++;
    }
    return scales[i];
}

static void sheet_arrow(struct svg *svg, double x, double y, double dx, double dy)
{
    const double xs[] = {x, x - ARROW * dx - 5 * dy, x - ARROW * dx + 5 * dy};
    const double ys[] = {y, y - ARROW * dy + 5 * dx, y - ARROW * dy - 5 * dx};
    svg_styled_polygon(svg, &(struct svg_style){.fill = BLACK}, xs, ys, 3);
}

/* Where the outline is at this height, the leftmost (side 0) or rightmost, and its slope dx/dy. */
static double sheet_outline_at(const double *x, const double *y, size_t count, double height,
                               size_t side, double *slope)
{
    double found = NAN;
    for (size_t i = 0; i < count; i++) {
        const size_t next = (i + 1) % count;
        const double rise = y[next] - y[i];
        if ((y[i] <= height) != (y[next] <= height)) {
            const double at = x[i] + (height - y[i]) * (x[next] - x[i]) / rise;
            if (isnan(found) || (side == 0 ? at < found : at > found)) {
                found = at;
                *slope = (x[next] - x[i]) / rise;
            }
        }
    }
    return found;
}

/* The radius of a surface: an arrow square to it from outside, and a line under its words. */
static void sheet_draw_radius(const struct element_sheet *sheet, size_t side, const double *x,
                              const double *y, double half, double limit, struct svg *svg)
{
    const struct svg_style thin = {.stroke = BLACK, .width = 2};
    const double out = side == 0 ? -1 : 1, height = AXIS_Y - RADIUS_AT * half;
    double slope = 0;
    const double at = sheet_outline_at(x, y, sheet->count, height, side, &slope);
    const double end = limit + 40 * out;
    /* the normal, as far as the words keep off the axis and within the element */
    const double low = fmin(height, AXIS_Y - 0.25 * half);
    const double away = height - slope * (end - at);
    const double line = fmin(fmax(away, AXIS_Y - half + SIZE + 20), fmax(low, AXIS_Y - 50));
    const double length = hypot(end - at, line - height);
    const double width = svg_text_width(sheet->radius[side], SIZE);
    svg_styled_line(svg, &thin, at, height, end, line);
    svg_styled_line(svg, &thin, end, line, end + (width + 20) * out, line);
    sheet_arrow(svg, at, height, (at - end) / length, (height - line) / length);
    svg_words(svg, end + 10 * out, line - 10, SIZE, side == 0 ? SVG_END : SVG_START, BLACK,
              sheet->radius[side]);
}

static void sheet_draw_element(const struct element_sheet *sheet, double scale, struct svg *svg)
{
    const struct svg_style glass = {.stroke = BLACK, .fill = "#eef4fa", .width = 5};
    const struct svg_style axis = {.stroke = BLACK, .width = 2, .dash = "40 10 5 10 5 10"};
    const struct svg_style thin = {.stroke = BLACK, .width = 2};
    const double k = UNITS * scale, middle = (sheet->vertex[0] + sheet->vertex[1]) / 2;
    double *x = ARENA_ARRAY(svg->arena, sheet->count, double);
    double *y = ARENA_ARRAY(svg->arena, sheet->count, double);
    double left = INFINITY, right = -INFINITY;
    for (size_t i = 0; i < sheet->count; i++) {
        x[i] = MIDDLE_X + k * (sheet->z[i] - middle);
        y[i] = AXIS_Y - k * sheet->y[i];
        left = fmin(left, x[i]);
        right = fmax(right, x[i]);
    }
    svg_styled_polygon(svg, &glass, x, y, sheet->count);
    svg_styled_line(svg, &axis, left - 120, AXIS_Y, right + 120, AXIS_Y);
    /* thickness, below */
    const double half = k * sheet->diameter / 2, low = AXIS_Y + half + 90;
    for (size_t i = 0; i < 2; i++) {
        const double at = MIDDLE_X + k * (sheet->vertex[i] - middle), out = i == 0 ? 1 : -1;
        svg_styled_line(svg, &thin, at, AXIS_Y + 10, at, low + 15);
        svg_styled_line(svg, &thin, at, low, at - 90 * out, low);
        sheet_arrow(svg, at, low, out, 0);
    }
    svg_words(svg, MIDDLE_X + k * (sheet->vertex[1] - middle) + 100, low + 11, SIZE, SVG_START,
              BLACK, sheet->thickness);
    sheet_draw_radius(sheet, 0, x, y, half, left, svg);
    sheet_draw_radius(sheet, 1, x, y, half, right, svg);
    /* diameter, to the right of the radius */
    const double far = right + 130 + svg_text_width(sheet->radius[1], SIZE);
    for (int side = -1; side <= 1; side += 2) {
        const double at = AXIS_Y + side * half;
        const double rim = MIDDLE_X + k * (sheet->edge[1] - middle);
        svg_styled_line(svg, &thin, rim + 12, at, far + 15, at);
        sheet_arrow(svg, far, at, 0, side);
    }
    svg_styled_line(svg, &thin, far, AXIS_Y - half, far, AXIS_Y + half);
    svg_words_upwards(svg, far - 12, AXIS_Y, SIZE, sheet->across);
}

static void sheet_draw_table(const struct element_sheet *sheet, struct svg *svg)
{
    static const char *const heads[] = {"Left surface", "Material", "Right surface"};
    const char *const *const columns[] = {sheet->left, sheet->material, sheet->right};
    const struct svg_style rule = {.stroke = BLACK, .width = 3};
    const double width = (RIGHT - LEFT) / 3, bottom = TABLE_TOP + LINE * (ELEMENT_LINES + 1.4);
    svg_styled_rect(svg, &rule, LEFT, TABLE_TOP, RIGHT - LEFT, bottom - TABLE_TOP);
    svg_styled_line(svg, &rule, LEFT, TABLE_TOP + 1.2 * LINE, RIGHT, TABLE_TOP + 1.2 * LINE);
    for (size_t i = 0; i < 3; i++) {
        const double x = LEFT + width * (double)i;
        const struct svg_label head = {
            .x = x + 20, .y = TABLE_TOP + 0.8 * LINE, .size = SIZE, .bold = true};
        svg_text(svg, &head, heads[i]);
        for (size_t k = 0; k < ELEMENT_LINES && columns[i][k] != NULL; k++) {
            svg_words_within(svg, x + 20, TABLE_TOP + LINE * ((double)k + 2), SIZE, width - 30,
                             BLACK, columns[i][k]);
        }
        if (i > 0) {
            svg_styled_line(svg, &rule, x, TABLE_TOP, x, bottom);
        }
    }
    for (size_t i = 0; i < sheet->note_count; i++) {
        svg_words_within(svg, LEFT, bottom + 44 * (double)(i + 1), 26, RIGHT - LEFT, "#333333",
                         sheet->notes[i]);
    }
}

void element_sheet_draw(const struct element_sheet *sheet, struct svg *svg)
{
    const double scale = sheet_scale(sheet);
    svg_begin_mm(svg, ELEMENT_SHEET_WIDTH, ELEMENT_SHEET_HEIGHT, UNITS, sheet->title);
    svg_heading(svg, LEFT, 80, 44, RIGHT - LEFT - 500, sheet->title);
    svg_subheading(svg, LEFT, 130, SIZE, 1000, sheet->part);
    svg_words(svg, RIGHT, 80, SIZE, SVG_END, BLACK,
              scale >= 1 ? arena_printf(svg->arena, "scale %.4g : 1", scale)
                         : arena_printf(svg->arena, "scale 1 : %.4g", 1 / scale));
    svg_words(svg, RIGHT, 130, SIZE, SVG_END, BLACK, "Indications according to ISO 10110");
    svg_styled_rect(svg, &(struct svg_style){.stroke = BLACK, .width = 3}, LEFT, FIELD_TOP,
                    RIGHT - LEFT, FIELD_BOTTOM - FIELD_TOP);
    sheet_draw_element(sheet, scale, svg);
    sheet_draw_table(sheet, svg);
    svg_end(svg);
}
