/* draw/outlines.c - a grid of shapes. */
/* SPDX-License-Identifier: MIT */
#include "draw/outlines.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

enum { ACROSS = 5, MOST = 100 };

/* Of a cell, and of the page, px. */
static const double CELL = 180, HEAD = 40, FOOT = 24, TOP = 72, BOTTOM = 64, MARGIN = 20;
static const double HALF = 76; /* of the largest shape */

static const struct svg_style area = {
    .stroke = "#0060a0", .fill = "#56b4e9", .width = 1.4, .opacity = 0.75};
static const struct svg_style dashed = {.stroke = "#888", .width = 1, .dash = "4 3"};

/* A shape about its origin (px) at so many px a unit. */
static void draw_shape(struct svg *svg, const struct svg_style *style, double scale,
                       double origin_x, double origin_y, const double (*points)[2], size_t count)
{
    double *x = ARENA_ARRAY(svg->arena, count + 1, double);
    double *y = ARENA_ARRAY(svg->arena, count + 1, double);
    for (size_t i = 0; i < count; i++) {
        x[i] = origin_x + scale * points[i][0];
        y[i] = origin_y - scale * points[i][1];
    }
    svg_styled_polygon(svg, style, x, y, count);
}

static void outlines_draw_words(struct svg *svg, double x, double y, bool bold, const char *words)
{
    svg_text(svg,
             &(struct svg_label){.x = x,
                                 .y = y,
                                 .size = 13,
                                 .width = CELL - 8,
                                 .anchor = SVG_MIDDLE,
                                 .colour = bold ? "#1d1d1d" : "#444",
                                 .bold = bold},
             words);
}

static void draw_foot(struct svg *svg, const struct outlines *outlines, double scale, double y)
{
    double length = ticks_round_below(HALF / scale), x = MARGIN + 10, end = x + length * scale;
    svg_scale_bar(svg, "#1d1d1d", x, end, y);
    const char *words = arena_printf(svg->arena, "%g %s", length, outlines->unit);
    svg_words(svg, end + 8, y + 5, 13, SVG_START, NULL, words);
    x = end + 24 + svg_text_width(words, 13);
    for (int i = 0; i < 2; i++) {
        if (outlines->legend[i] == NULL) {
            continue;
        }
        svg_styled_circle(svg, i == 0 ? &area : &dashed, x + 7, y, 7);
        svg_words(svg, x + 20, y + 5, 13, SVG_START, NULL, outlines->legend[i]);
        x += 40 + svg_text_width(outlines->legend[i], 13);
    }
}

bool outlines_draw(const struct outlines *outlines, struct svg *svg, struct error *error)
{
    double most = 0; /* the farthest */
    for (size_t i = 0; i < outlines->count; i++) {
        const struct pupil_outline *shape = &outlines->shapes[i];
        for (size_t k = 0; k < shape->count; k++) {
            most = fmax(most, fmax(fabs(shape->points[k][0]), fabs(shape->points[k][1])));
        }
        for (size_t k = 0; k < shape->dashed_count; k++) {
            most = fmax(most, fmax(fabs(shape->dashed[k][0]), fabs(shape->dashed[k][1])));
        }
    }
    if (outlines->count > MOST) {
        return fail(error, ERROR_USAGE, "a drawing of %zu shapes: at most %d can be distinguished",
                    outlines->count, MOST);
    }
    if (!(most > 0 && most < 1e12)) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw: no ray arrives");
    }
    size_t across = outlines->count < ACROSS ? outlines->count : ACROSS;
    size_t down = (outlines->count + across - 1) / across;
    /* at least as wide as what is written above and below */
    double words = MARGIN + 160 + HALF;
    for (int i = 0; i < 2; i++) {
        const char *legend = outlines->legend[i];
        words += legend != NULL ? 40 + svg_text_width(legend, 13) : 0;
    }
    const char *subtitle = outlines->subtitle != NULL ? outlines->subtitle : "";
    const double above = fmax(svg_text_width(outlines->title, 17), svg_text_width(subtitle, 13));
    words = fmax(words, 2 * MARGIN + above + 1);
    double width = fmax(words, 2 * MARGIN + (double)across * CELL),
           tall = HEAD + 2 * HALF + FOOT + 16;
    double height = TOP + (double)down * tall + BOTTOM, scale = HALF / most;
    svg_begin(svg, width, height, outlines->title);
    svg_heading(svg, MARGIN, 30, 17, width - 2 * MARGIN, outlines->title);
    svg_subheading(svg, MARGIN, 52, 13, width - 2 * MARGIN, subtitle);
    for (size_t i = 0; i < outlines->count; i++) {
        const struct pupil_outline *shape = &outlines->shapes[i];
        const double x = MARGIN + ((double)(i % across) + 0.5) * CELL;
        const double y = TOP + (double)(i / across) * tall + HEAD + HALF;
        svg_group_begin(svg, &(struct svg_style){.stroke = "#ccc", .width = 1});
        svg_line(svg, x - HALF - 6, y, x + HALF + 6, y);
        svg_line(svg, x, y - HALF - 6, x, y + HALF + 6);
        svg_group_end(svg);
        draw_shape(svg, &area, scale, x, y, shape->points, shape->count);
        draw_shape(svg, &dashed, scale, x, y, shape->dashed, shape->dashed_count);
        outlines_draw_words(svg, x, y - HALF - 16, true, shape->label);
        outlines_draw_words(svg, x, y + HALF + 24, false, shape->note);
    }
    draw_foot(svg, outlines, scale, height - BOTTOM / 2);
    svg_end(svg);
    return true;
}
