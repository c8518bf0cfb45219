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
#include <stdlib.h>

static const double LEFT = 70, TOP = 74, BOTTOM = 62; /* margins, px */
static const double NUMBER_SIZE = 12, AXIS_SIZE = 14, TITLE_SIZE = 17, LABEL_SIZE = 9.5;
static const double LEGEND_WIDTH = 118, FAMILY_MARGIN = 14, FAMILY_SIZE = 13;

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
              "Abbe number V_{d}");
    svg_words_upwards(svg, 20, (y->start + y->stop) / 2, AXIS_SIZE, "refractive index n_{d}");
    svg_heading(svg, LEFT, 32, TITLE_SIZE, ABBE_WIDTH - LEFT - 20, drawing->abbe->title);
    svg_subheading(svg, LEFT, 54, NUMBER_SIZE + 1, ABBE_WIDTH - LEFT - 20, drawing->abbe->subtitle);
}

/* Twice the area of a triangle, positive where it turns to the left. */
static double turn_of(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int corners_compare(const void *first, const void *second)
{
    const double *a = first, *b = second;
    const int by_x = (a[0] > b[0]) - (a[0] < b[0]);
    return by_x != 0 ? by_x : (a[1] > b[1]) - (a[1] < b[1]);
}

/*
 * The convex hull of points on the page: A. M. Andrew's monotone chain.
 *
 * Given     points  sorted here;  hull  receives up to 2 count corners
 * Result    how many
 */
static size_t hull_of(double (*points)[2], size_t count, double (*hull)[2])
{
    size_t corners = 0;
    qsort(points, count, sizeof points[0], corners_compare);
    for (int side = 0; side < 2; side++) { /* below from left to right, then above and back */
        const size_t begin = corners;
        for (size_t i = 0; i < count; i++) {
            const double *next = points[side == 0 ? i : count - 1 - i];
            while (corners > begin + 1 &&
                   turn_of(hull[corners - 2], hull[corners - 1], next) <= 0) {
                corners--;
            }
            hull[corners][0] = next[0];
            hull[corners++][1] = next[1];
        }
        corners--; /* the last is the first of the other side */
    }
    return corners;
}

/* The corners of a family's area on the page; 0: it has none. */
static size_t family_corners(const struct abbe_drawing *drawing, const struct abbe_family *family,
                             double *x, double *y)
{
    double(*points)[2] = arena_array(drawing->svg->arena, family->count + 1, 2 * sizeof(double));
    double(*hull)[2] = arena_array(drawing->svg->arena, 2 * family->count + 2, 2 * sizeof(double));
    size_t count = 0;
    for (size_t i = 0; i < family->count; i++) {
        points[count][0] = plot_page_at(&drawing->x, family->Vd[i]);
        points[count][1] = plot_page_at(&drawing->y, family->nd[i]);
        count += isfinite(points[count][0]) && isfinite(points[count][1]) ? 1 : 0;
    }
    const size_t corners = count >= 3 ? hull_of(points, count, hull) : 0;
    for (size_t i = 0; i < corners; i++) {
        x[i] = hull[i][0];
        y[i] = hull[i][1];
    }
    return corners;
}

static void draw_families(const struct abbe_drawing *drawing)
{
    const struct abbe *abbe = drawing->abbe;
    struct svg *svg = drawing->svg;
    const struct svg_box *frame = &drawing->page.frame;
    svg_clip_begin(svg, frame->left, frame->top, frame->right - frame->left,
                   frame->bottom - frame->top);
    for (size_t i = 0; i < abbe->family_count; i++) {
        const struct abbe_family *family = &abbe->families[i];
        double *x = ARENA_ARRAY(svg->arena, 2 * family->count + 2, double);
        double *y = ARENA_ARRAY(svg->arena, 2 * family->count + 2, double);
        const size_t corners = family_corners(drawing, family, x, y);
        const char *colour = palette_colour(i + (i % PALETTE_COLOURS > 3 ? 1 : 0)); /* not black */
        const struct svg_style area = {
            .fill = colour, .stroke = colour, .width = FAMILY_MARGIN, .opacity = 0.13};
        if (corners >= 3) {
            svg_styled_polygon(svg, &area, x, y, corners);
        }
    }
    svg_group_end(svg);
}

/* The name of each family where its area is empty. */
static void name_families(struct abbe_drawing *drawing)
{
    const struct abbe *abbe = drawing->abbe;
    struct svg *svg = drawing->svg;
    for (size_t i = 0; i < abbe->family_count; i++) {
        const struct abbe_family *family = &abbe->families[i];
        double *x = ARENA_ARRAY(svg->arena, 2 * family->count + 2, double);
        double *y = ARENA_ARRAY(svg->arena, 2 * family->count + 2, double);
        const size_t corners = family_corners(drawing, family, x, y);
        struct svg_label at = {.size = FAMILY_SIZE, .bold = true, .colour = "#555555"};
        for (size_t k = 0; k < corners; k++) {
            at.x += x[k] / (double)corners;
            at.y += y[k] / (double)corners;
        }
        if (corners >= 3) {
            label_put_about(&drawing->page, svg, &at, family->name);
        }
    }
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
    drawing.page.taken =
        ARENA_ARRAY(svg->arena, 2 * abbe->count + abbe->family_count + 1, struct svg_box);
    svg_begin(svg, ABBE_WIDTH, ABBE_HEIGHT, abbe->title);
    draw_families(&drawing);
    plot_axes_grid(svg, &drawing.x, &drawing.y);
    draw_border(&drawing);
    draw_numbers(&drawing);
    draw_points(&drawing, false);
    draw_points(&drawing, true);
    draw_labels(&drawing, true);
    name_families(&drawing);
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
