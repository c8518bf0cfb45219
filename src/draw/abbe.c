/* draw/abbe.c - the Abbe diagram: glasses by index and Abbe number, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/abbe.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/marks.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double LEFT = 70, TOP = 56, BOTTOM = 62; /* margins, px */
static const double NUMBER_SIZE = 12, AXIS_SIZE = 14, TITLE_SIZE = 17, LABEL_SIZE = 9.5;
static const double LEGEND_WIDTH = 118;

enum { MOST_LABELLED = 400 };

struct abbe_drawing {
    const struct abbe *abbe;
    struct svg *svg;
    struct plot_axis x, y;
    struct label_page page;
};

static bool is_drawable(const struct abbe_point *point)
{
    return isfinite(point->nd) && isfinite(point->Vd) && fabs(point->Vd) < 1e6;
}

static bool abbe_find_range(const struct abbe *abbe, struct plot_axis *x, struct plot_axis *y)
{
    x->low = y->low = INFINITY;
    x->high = y->high = -INFINITY;
    for (size_t i = 0; i < abbe->count; i++) {
        const struct abbe_point *point = &abbe->points[i];
        if (is_drawable(point)) {
            x->low = fmin(x->low, point->Vd);
            x->high = fmax(x->high, point->Vd);
            y->low = fmin(y->low, point->nd);
            y->high = fmax(y->high, point->nd);
        }
    }
    return y->low <= y->high;
}

/* Spans below which glasses are the same to their makers: the width of the tolerances. */
static const double LEAST_ND = 0.001, LEAST_VD = 1;

/* From tick to tick, with a little room around the outermost points. */
static void set_axis(struct plot_axis *axis, double least, double start, double stop)
{
    double span = axis->high - axis->low;
    double room = fmax(0.02 * span, 0.5 * (least - span));
    *axis = (struct plot_axis){
        .low = axis->low - room, .high = axis->high + room, .start = start, .stop = stop};
    plot_axis_to_ticks(axis);
}

static void draw_numbers(const struct abbe_drawing *drawing)
{
    const struct plot_axis *x = &drawing->x, *y = &drawing->y;
    struct svg *svg = drawing->svg;
    plot_axes_numbers(svg, x, y, NUMBER_SIZE);
    svg_words(svg, (x->start + x->stop) / 2, y->start + 42, AXIS_SIZE, SVG_MIDDLE, NULL,
              "Abbe number Vd");
    svg_words_upwards(svg, 20, (y->start + y->stop) / 2, AXIS_SIZE, "refractive index nd");
    const struct svg_label title = {.x = (x->start + x->stop) / 2,
                                    .y = 32,
                                    .size = TITLE_SIZE,
                                    .anchor = SVG_MIDDLE,
                                    .width = ABBE_WIDTH - 40,
                                    .bold = true};
    svg_title(svg, &title, drawing->abbe->title);
}

/* Crown left, flint right; the border is that of the makers' diagrams. */
static void draw_border(const struct abbe_drawing *drawing)
{
    const struct plot_axis *x = &drawing->x, *y = &drawing->y;
    struct svg *svg = drawing->svg;
    const double Vd[] = {55, 55, 50, 50};
    const double nd[] = {y->low, 1.6, 1.6, y->high};
    const struct svg_style style = {.stroke = "#888888", .dash = "7 4", .width = 1};
    double page_x[4], page_y[4];
    if (!(x->high < 50 && x->low > 55 && y->low < 1.6 && y->high > 1.6)) {
        return;
    }
    for (int i = 0; i < 4; i++) {
        page_x[i] = plot_page_at(x, Vd[i]);
        page_y[i] = plot_page_at(y, nd[i]);
    }
    svg_styled_polyline(svg, &style, page_x, page_y, 4);
    svg_words(svg, page_x[0] - 8, y->start - 8, NUMBER_SIZE, SVG_END, "#666666", "crown");
    svg_words(svg, page_x[0] + 8, y->start - 8, NUMBER_SIZE, SVG_START, "#666666", "flint");
}

static double mark_radius(const struct abbe *abbe, bool chosen)
{
    double usual = abbe->count > MOST_LABELLED ? 2 : 2.8;
    return chosen ? usual + 2 : usual;
}

static void draw_points(struct abbe_drawing *drawing, bool chosen)
{
    const struct abbe *abbe = drawing->abbe;
    struct svg *svg = drawing->svg;
    double radius = mark_radius(abbe, chosen);
    for (size_t group = 0; group < abbe->group_count; group++) {
        svg_group_begin(
            svg, &(struct svg_style){.fill = palette_colour(group),
                                     .stroke = chosen ? "#000000" : NULL,
                                     .width = 1.2,
                                     .opacity = chosen || abbe->count <= MOST_LABELLED ? 1 : 0.65});
        for (size_t i = 0; i < abbe->count; i++) {
            const struct abbe_point *point = &abbe->points[i];
            if (point->group == group && point->chosen == chosen && is_drawable(point)) {
                double x = plot_page_at(&drawing->x, point->Vd),
                       y = plot_page_at(&drawing->y, point->nd);
                mark_draw(svg, group, x, y, radius);
                label_page_take(&drawing->page, x, y, radius);
            }
        }
        svg_group_end(svg);
    }
}

static void label_point(struct abbe_drawing *drawing, const struct abbe_point *point)
{
    const struct svg_label at = {.x = plot_page_at(&drawing->x, point->Vd),
                                 .y = plot_page_at(&drawing->y, point->nd),
                                 .size = point->chosen ? LABEL_SIZE + 2.5 : LABEL_SIZE,
                                 .colour = point->chosen ? NULL : "#333333"};
    label_put(&drawing->page, drawing->svg, &at, mark_radius(drawing->abbe, point->chosen) + 1.5,
              point->chosen, point->label);
}

static void draw_labels(struct abbe_drawing *drawing, bool chosen)
{
    const struct abbe *abbe = drawing->abbe;
    for (size_t i = 0; i < abbe->count; i++) {
        const struct abbe_point *point = &abbe->points[i];
        if (point->chosen == chosen && is_drawable(point) && point->label != NULL &&
            (chosen || abbe->count <= MOST_LABELLED)) {
            label_point(drawing, point);
        }
    }
}

bool abbe_draw(const struct abbe *abbe, struct svg *svg, struct error *error)
{
    struct abbe_drawing drawing = {.abbe = abbe, .svg = svg};
    if (!abbe_find_range(abbe, &drawing.x, &drawing.y)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: no glass with nd and Vd");
    }
    set_axis(&drawing.y, LEAST_ND, ABBE_HEIGHT - BOTTOM, TOP);
    set_axis(&drawing.x, LEAST_VD, ABBE_WIDTH - LEGEND_WIDTH, LEFT);
    /* Vd falls to the right: the axis is turned round once its ticks are chosen */
    drawing.x = (struct plot_axis){.low = drawing.x.high,
                                   .high = drawing.x.low,
                                   .start = LEFT,
                                   .stop = ABBE_WIDTH - LEGEND_WIDTH,
                                   .ticks = drawing.x.ticks};
    drawing.page.frame =
        (struct svg_box){drawing.x.start, drawing.y.stop, drawing.x.stop, drawing.y.start};
    drawing.page.taken = ARENA_ARRAY(svg->arena, 2 * abbe->count + 1, struct svg_box);
    svg_begin(svg, ABBE_WIDTH, ABBE_HEIGHT, abbe->title);
    plot_axes_grid(svg, &drawing.x, &drawing.y);
    draw_border(&drawing);
    draw_numbers(&drawing);
    draw_points(&drawing, false);
    draw_points(&drawing, true);
    draw_labels(&drawing, true);
    draw_labels(&drawing, false);
    /* the legend */
    double x = ABBE_WIDTH - LEGEND_WIDTH + 14, y = TOP + 10;
    for (size_t group = 0; group < abbe->group_count; group++, y += 19) {
        svg_group_begin(svg, &(struct svg_style){.fill = palette_colour(group)});
        mark_draw(svg, group, x, y, 4);
        svg_group_end(svg);
        svg_words(svg, x + 11, y + 4, NUMBER_SIZE, SVG_START, NULL, abbe->groups[group]);
    }
    svg_end(svg);
    return true;
}
