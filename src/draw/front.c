/* draw/front.c - what costs more and errs less: points in a log-log plane with their front, SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/front.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/marks.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"

#include <math.h>
#include <stdlib.h>

static const double LEFT = 88, TOP = 72, BOTTOM = 62, LEGEND_WIDTH = 130; /* margins, px */
static const double NUMBER_SIZE = 12, AXIS_SIZE = 14, TITLE_SIZE = 17, LABEL_SIZE = 10.5;
static const double RADIUS = 3.4;

struct front_drawing {
    const struct front *front;
    struct svg *svg;
    struct plot_axis x, y;
    struct label_page page;
};

static bool front_has(const struct front_point *point)
{
    return isfinite(plot_drawable(point->x, true)) && isfinite(plot_drawable(point->y, true));
}

/* From decade to decade. */
static void front_set_axis(struct plot_axis *axis, double start, double stop)
{
    axis->log = true;
    axis->low = pow(10, floor(log10(axis->low) - 0.05));
    axis->high = pow(10, ceil(log10(axis->high) + 0.05));
    axis->start = start;
    axis->stop = stop;
    ticks_log(axis->low, axis->high, &axis->ticks);
    axis->low = fmin(axis->low, axis->ticks.value[0]);
    axis->high = fmax(axis->high, axis->ticks.value[axis->ticks.count - 1]);
}

static bool front_find_range(struct front_drawing *drawing)
{
    const struct front *front = drawing->front;
    struct plot_axis *x = &drawing->x, *y = &drawing->y;
    x->low = y->low = INFINITY;
    x->high = y->high = 0;
    for (size_t i = 0; i < front->count; i++) {
        const struct front_point *point = &front->points[i];
        if (front_has(point)) {
            x->low = fmin(x->low, point->x);
            x->high = fmax(x->high, point->x);
            y->low = fmin(y->low, point->y);
            y->high = fmax(y->high, point->y);
        }
    }
    /* room for labels above the worst of them */
    y->high *= pow(10, 0.06 * log10(y->high / y->low));
    return y->high > 0;
}

static void front_draw_frame(const struct front_drawing *drawing)
{
    const struct plot_axis *x = &drawing->x, *y = &drawing->y;
    const struct front *front = drawing->front;
    struct svg *svg = drawing->svg;
    plot_axes_grid(svg, x, y);
    plot_axes_numbers(svg, x, y, NUMBER_SIZE);
    svg_words(svg, (x->start + x->stop) / 2, y->start + 42, AXIS_SIZE, SVG_MIDDLE, NULL,
              front->x_label);
    svg_words_upwards(svg, 22, (y->start + y->stop) / 2, AXIS_SIZE, front->y_label);
    svg_heading(svg, LEFT, 30, TITLE_SIZE, FRONT_WIDTH - LEFT - 20, front->title);
    svg_subheading(svg, LEFT, 52, NUMBER_SIZE, FRONT_WIDTH - LEFT - 20, front->subtitle);
}

static int front_by_x(const void *first, const void *second)
{
    const struct front_point *a = *(const struct front_point *const *)first;
    const struct front_point *b = *(const struct front_point *const *)second;
    if (a->x < b->x || a->x > b->x) {
        return a->x < b->x ? -1 : 1;
    }
    return a->y < b->y ? -1 : a->y > b->y;
}

/* Its steps: from each point as far as the next, then down to that. */
static void front_draw_steps(struct front_drawing *drawing)
{
    const struct front *front = drawing->front;
    struct arena *arena = drawing->svg->arena;
    const struct front_point **best = ARENA_ARRAY(arena, front->count, const struct front_point *);
    double *x = ARENA_ARRAY(arena, 2 * front->count + 2, double);
    double *y = ARENA_ARRAY(arena, 2 * front->count + 2, double);
    size_t count = 0, at = 0;
    for (size_t i = 0; i < front->count; i++) {
        if (front->points[i].is_best && front_has(&front->points[i])) {
            best[count++] = &front->points[i];
        }
    }
    if (count == 0) {
        return;
    }
    qsort(best, count, sizeof *best, front_by_x);
    for (size_t i = 0; i < count; i++) {
        const double here = plot_page_at(&drawing->x, best[i]->x);
        x[at] = here;
        y[at] = i > 0 ? y[at - 1] : drawing->y.stop;
        x[at + 1] = here;
        y[at + 1] = plot_page_at(&drawing->y, best[i]->y);
        at += 2;
    }
    x[at] = drawing->x.stop;
    y[at] = y[at - 1];
    svg_styled_polyline(drawing->svg,
                        &(struct svg_style){.stroke = "#000000", .width = 1.4, .opacity = 0.55}, x,
                        y, at + 1);
    for (size_t i = 0; i < at; i++) {
        drawing->page.taken[drawing->page.taken_count++] =
            (struct svg_box){fmin(x[i], x[i + 1]) - 1, fmin(y[i], y[i + 1]) - 1,
                             fmax(x[i], x[i + 1]) + 1, fmax(y[i], y[i + 1]) + 1};
    }
}

static void front_draw_group(struct front_drawing *drawing, size_t group)
{
    const struct front *front = drawing->front;
    struct svg *svg = drawing->svg;
    double *x = ARENA_ARRAY(svg->arena, front->count, double);
    double *y = ARENA_ARRAY(svg->arena, front->count, double);
    size_t count = 0;
    for (size_t i = 0; i < front->count; i++) {
        const struct front_point *point = &front->points[i];
        if (point->group == group && front_has(point)) {
            x[count] = plot_page_at(&drawing->x, point->x);
            y[count++] = plot_page_at(&drawing->y, point->y);
        }
    }
    if (front->groups[group].is_line) {
        svg_styled_polyline(
            svg, &(struct svg_style){.stroke = palette_colour(group), .width = 1, .opacity = 0.6},
            x, y, count);
    }
    svg_group_begin(svg, &(struct svg_style){.fill = palette_colour(group)});
    for (size_t i = 0; i < count; i++) {
        mark_draw(svg, group, x[i], y[i], RADIUS);
        label_page_take(&drawing->page, x[i], y[i], RADIUS);
    }
    svg_group_end(svg);
}

/* Beside its point, or farther away with a line to it. */
static void front_put_label(struct front_drawing *drawing, const struct front_point *point)
{
    static const double gaps[] = {5.9, 14, 24, 36, 50};
    const struct svg_label at = {.x = plot_page_at(&drawing->x, point->x),
                                 .y = plot_page_at(&drawing->y, point->y),
                                 .size = LABEL_SIZE,
                                 .colour = point->is_best ? NULL : "#666666"};
    size_t i = 0;
    while (i < sizeof gaps / sizeof gaps[0] &&
           !label_put(&drawing->page, drawing->svg, &at, gaps[i], false, point->label)) {
        i++;
    }
    if (i > 0 && i < sizeof gaps / sizeof gaps[0]) {
        const struct svg_box *box = &drawing->page.taken[drawing->page.taken_count - 1];
        svg_styled_line(drawing->svg, &(struct svg_style){.stroke = "#999999", .width = 0.6}, at.x,
                        at.y, fmin(fmax(at.x, box->left), box->right),
                        fmin(fmax(at.y, box->top), box->bottom));
    }
}

static void front_draw_labels(struct front_drawing *drawing, bool best)
{
    const struct front *front = drawing->front;
    for (size_t i = 0; i < front->count; i++) {
        const struct front_point *point = &front->points[i];
        if (point->is_best == best && point->label != NULL && front_has(point)) {
            front_put_label(drawing, point);
        }
    }
}

bool front_draw(const struct front *front, struct svg *svg, struct error *error)
{
    struct front_drawing drawing = {.front = front, .svg = svg};
    if (!front_find_range(&drawing)) {
        return fail(error, ERROR_DOMAIN, "nothing to draw: no point has a time and an error");
    }
    front_set_axis(&drawing.x, LEFT, FRONT_WIDTH - LEGEND_WIDTH);
    front_set_axis(&drawing.y, FRONT_HEIGHT - BOTTOM, TOP);
    drawing.page.frame =
        (struct svg_box){drawing.x.start, drawing.y.stop, drawing.x.stop, drawing.y.start};
    drawing.page.taken = ARENA_ARRAY(svg->arena, 4 * front->count + 1, struct svg_box);
    svg_begin(svg, FRONT_WIDTH, FRONT_HEIGHT, front->title);
    front_draw_frame(&drawing);
    front_draw_steps(&drawing);
    for (size_t group = 0; group < front->group_count; group++) {
        front_draw_group(&drawing, group);
    }
    front_draw_labels(&drawing, true);
    front_draw_labels(&drawing, false);
    /* the legend */
    const double x = FRONT_WIDTH - LEGEND_WIDTH + 18;
    double y = TOP + 10;
    for (size_t group = 0; group < front->group_count; group++, y += 19) {
        svg_group_begin(svg, &(struct svg_style){.fill = palette_colour(group)});
        mark_draw(svg, group, x, y, 4);
        svg_group_end(svg);
        svg_words(svg, x + 11, y + 4, NUMBER_SIZE, SVG_START, NULL, front->groups[group].name);
    }
    svg_styled_line(svg, &(struct svg_style){.stroke = "#000000", .width = 1.4, .opacity = 0.55},
                    x - 6, y, x + 6, y);
    svg_words(svg, x + 11, y + 4, NUMBER_SIZE, SVG_START, NULL, "front");
    svg_end(svg);
    return true;
}
