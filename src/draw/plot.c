/* draw/plot.c - line plots of several series, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/svg.h"
#include "draw/ticks.h"

static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17; /* px */
static const size_t STRETCHES = 1000;                                   /* about one a pixel */
static const size_t DOTS_MAX = 30;

#define ARROWS 64

/* For round line ends, which lengthen each by the line's width, and for black-and-white print. */
static const char *const dashes[] = {NULL,        "7 5",      "0.1 4.5",
                                     "9 5 0.1 5", "13 5 3 5", "8 5 0.1 4 0.1 5"};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

struct plot_frame {
    struct plot_axis x, y;
    double arrow_x[ARROWS]; /* px, of the infinity signs drawn so far */
    size_t arrow_count;
};

struct plot_points {
    double *x, *y; /* px */
    size_t count;
};

/* -------- grid and axes -------- */

static void draw_minor(struct svg *svg, const struct plot_frame *frame,
                       const struct plot_axis *axis)
{
    double decades = log10(axis->high) - log10(axis->low);
    if (!axis->log || decades > 6) {
        return;
    }
    for (double decade = floor(log10(axis->low)); decade <= log10(axis->high); decade++) {
        for (int digit = 1; digit <= 9; digit++) {
            double v = digit * pow(10, decade), at = plot_page_at(axis, v);
            if (v < axis->low || v > axis->high) {
                continue;
            }
            if (axis == &frame->x) {
                svg_line(svg, at, frame->y.start, at, frame->y.stop);
            } else {
                svg_line(svg, frame->x.start, at, frame->x.stop, at);
            }
        }
    }
}

static void plot_draw_grid(struct svg *svg, const struct plot *plot, const struct plot_frame *frame)
{
    const struct plot_axis *x = &frame->x, *y = &frame->y;
    svg_group_begin(svg, &(struct svg_style){.stroke = "#eee", .width = 0.7});
    draw_minor(svg, frame, y);
    if (!plot->x_ticks) {
        draw_minor(svg, frame, x);
    }
    svg_group_end(svg);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8});
    for (size_t i = 0; i < y->ticks.count; i++) {
        double at = plot_page_at(y, y->ticks.value[i]);
        svg_line(svg, x->start, at, x->stop, at);
    }
    for (size_t i = 0; !plot->x_ticks && i < x->ticks.count; i++) {
        double at = plot_page_at(x, x->ticks.value[i]);
        svg_line(svg, at, y->start, at, y->stop);
    }
    svg_group_end(svg);
}

/* One mark of the x axis; its number only where it is clear of the one before. */
static void draw_x_tick(struct svg *svg, const struct plot_frame *frame, double at,
                        const char *text, double *clear)
{
    double half = svg_text_width(text, NUMBER_SIZE) / 2, bottom = frame->y.start;
    svg_line(svg, at, bottom, at, bottom + 5);
    if (at - half < *clear || at + half > PLOT_WIDTH) {
        return;
    }
    svg_words(svg, at, bottom + 19, NUMBER_SIZE, SVG_MIDDLE, NULL, text);
    *clear = at + half + 6;
}

static void plot_draw_axes(struct svg *svg, const struct plot *plot, const struct plot_frame *frame)
{
    const struct plot_axis *x = &frame->x, *y = &frame->y;
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333", .width = 1});
    svg_line(svg, x->start, y->start, x->stop, y->start);
    svg_line(svg, x->start, y->start, x->start, y->stop);
    double clear = 0;
    for (size_t i = 0; !plot->x_ticks && i < x->ticks.count; i++) {
        draw_x_tick(svg, frame, plot_page_at(x, x->ticks.value[i]),
                    ticks_text(svg->arena, &x->ticks, i), &clear);
    }
    for (size_t i = 0; plot->x_ticks && i < plot->x_tick_count; i++) {
        double v = plot->x_ticks[i], slack = 1e-9 * (x->high - x->low);
        if (v >= x->low - slack && v <= x->high + slack) {
            draw_x_tick(svg, frame, plot_page_at(x, v), arena_printf(svg->arena, "%.4g", v),
                        &clear);
        }
    }
    for (size_t i = 0; i < y->ticks.count; i++) {
        double at = plot_page_at(y, y->ticks.value[i]);
        svg_line(svg, x->start - 5, at, x->start, at);
        svg_words(svg, x->start - 9, at + 4, NUMBER_SIZE, SVG_END, NULL,
                  ticks_text(svg->arena, &y->ticks, i));
    }
    svg_group_end(svg);
}

static void plot_draw_words(struct svg *svg, const struct plot *plot,
                            const struct plot_frame *frame)
{
    const struct plot_axis *x = &frame->x, *y = &frame->y;
    double left = x->start, room = PLOT_WIDTH - left - 12;
    struct svg_label below = {.x = (left + x->stop) / 2,
                              .y = y->start + 44,
                              .size = LABEL_SIZE,
                              .width = x->stop - left,
                              .anchor = SVG_MIDDLE};
    struct svg_label beside = {.x = 22,
                               .y = (y->start + y->stop) / 2,
                               .size = LABEL_SIZE,
                               .rotation = -90,
                               .width = y->start - y->stop + 40,
                               .anchor = SVG_MIDDLE};
    svg_heading(svg, left, 32, TITLE_SIZE, room, plot->title);
    svg_subheading(svg, left, 52, LABEL_SIZE, room, plot->subtitle);
    svg_text(svg, &below, plot->x_label ? plot->x_label : "");
    svg_text(svg, &beside, plot->y_label ? plot->y_label : "");
}

/* -------- curves -------- */

/*
 * Which of the points from .. to - 1 are drawn: all, or of each stretch of a long series the least
 * and the greatest value in the order they come, so that no peak is lost.
 */
static size_t thin(const struct plot *plot, const struct plot_series *series, size_t from,
                   size_t to, size_t *index)
{
    const size_t all = plot_series_count(plot, series);
    const size_t stretch = all > 2 * STRETCHES ? (all + STRETCHES - 1) / STRETCHES : 1;
    size_t count = 0;
    for (size_t start = from; start < to; start += stretch) {
        size_t end = to - start < stretch ? to : start + stretch, least = start, greatest = start;
        for (size_t i = start; i < end; i++) {
            double v = plot_y_at(plot, series, i);
            if (isnan(plot_y_at(plot, series, least)) || v < plot_y_at(plot, series, least)) {
                least = i;
            }
            if (isnan(plot_y_at(plot, series, greatest)) || v > plot_y_at(plot, series, greatest)) {
                greatest = i;
            }
        }
        index[count++] = least < greatest ? least : greatest;
        if (least != greatest) {
            index[count++] = least < greatest ? greatest : least;
        }
    }
    return count;
}

static void plot_add_point(struct plot_points *points, double x, double y)
{
    points->x[points->count] = x;
    points->y[points->count++] = y;
}

/*
 * The points of a curve on the page. Between a finite and an infinite value it runs vertically to
 * the edge at the finite one's x, and on along the edge if it is the `edge` of an area.
 */
static struct plot_points plot_trace(const struct plot *plot, const struct plot_frame *frame,
                                     const struct plot_series *series, size_t from, size_t to,
                                     bool edge, struct arena *arena)
{
    size_t *index = ARENA_ARRAY(arena, 2 * STRETCHES + 2, size_t);
    size_t count = thin(plot, series, from, to, index);
    struct plot_points points = {ARENA_ARRAY(arena, 2 * count, double),
                                 ARENA_ARRAY(arena, 2 * count, double), 0};
    double before = NAN, before_x = NAN;
    for (size_t i = 0; i < count; i++) {
        double v = plot_y_at(plot, series, index[i]);
        double x = plot_page_at(&frame->x, plot_x_at(plot, series, index[i]));
        double leaves = isinf(v) ? v : before, off = leaves > 0 ? frame->y.stop : frame->y.start;
        if (isinf(v) && isfinite(before)) {
            plot_add_point(&points, before_x, off);
        }
        if (isinf(before) && isfinite(v)) {
            plot_add_point(&points, x, off);
        }
        double y = NAN;
        if (isfinite(v)) {
            y = plot_near_page(&frame->y, plot_page_at(&frame->y, v));
        } else if (isinf(v) && edge) {
            y = off;
        }
        plot_add_point(&points, x, y);
        before = v;
        before_x = x;
    }
    return points;
}

/* The band in every stretch where both curves have values; stretches below a pixel are left out. */
static void draw_band(struct svg *svg, const struct plot *plot, const struct plot_frame *frame,
                      const struct plot_band *band)
{
    const struct plot_series *low = &plot->series[band->low];
    const size_t count = plot_series_count(plot, low);
    struct plot_series high = *low;
    double *infinite = ARENA_ARRAY(svg->arena, count, double);
    for (size_t i = 0; i < count; i++) {
        infinite[i] = INFINITY;
    }
    high.y = band->high == PLOT_UNBOUNDED ? infinite : plot->series[band->high].y;
    size_t start = 0;
    for (size_t i = 0; i <= count; i++) {
        if (i < count && !isnan(plot_y_at(plot, low, i)) && !isnan(plot_y_at(plot, &high, i))) {
            continue;
        }
        if (i - start > 1 && i - start > count / STRETCHES) {
            struct plot_points below = plot_trace(plot, frame, low, start, i, true, svg->arena);
            struct plot_points above = plot_trace(plot, frame, &high, start, i, true, svg->arena);
            /* along the upper curve, and back along the lower */
            size_t corners = below.count + above.count;
            struct plot_points area = {ARENA_ARRAY(svg->arena, corners, double),
                                       ARENA_ARRAY(svg->arena, corners, double), 0};
            for (size_t k = 0; k < above.count; k++) {
                plot_add_point(&area, above.x[k], above.y[k]);
            }
            for (size_t k = below.count; k-- > 0;) {
                plot_add_point(&area, below.x[k], below.y[k]);
            }
            svg_polygon(svg, area.x, area.y, area.count);
        }
        start = i + 1;
    }
}

static struct svg_style plot_line_of(const struct plot_series *series)
{
    const size_t dash = series->dash > 0 ? series->dash - 1 : series->style;
    return (struct svg_style){
        .stroke = palette_colour(series->style), .dash = dashes[dash % COUNT(dashes)], .width = 2};
}

/* An arrow at the edge that says where a curve goes; one where several would lie together. */
static void draw_arrow(struct svg *svg, struct plot_frame *frame, double x, bool up)
{
    for (size_t i = 0; i < frame->arrow_count; i++) {
        if (fabs(frame->arrow_x[i] - x) < 12) {
            return;
        }
    }
    if (frame->arrow_count == ARROWS) {
        return;
    }
    frame->arrow_x[frame->arrow_count++] = x;
    svg_path(svg, x, up ? frame->y.stop : frame->y.start,
             up ? "M-4.5 0L0 -9 4.5 0z" : "M-4.5 -9L0 0 4.5 -9z");
    double side = x + 40 > frame->x.stop ? -24 : 6;
    svg_words(svg, up ? x : x + side, up ? frame->y.stop - 11 : frame->y.start - 5, 16,
              up ? SVG_MIDDLE : SVG_START, NULL, up ? "∞" : "−∞");
}

/* Where a curve leaves for infinity, or comes from there. */
static void draw_arrows(struct svg *svg, const struct plot *plot, struct plot_frame *frame,
                        const struct plot_series *series)
{
    for (size_t i = 0; i + 1 < plot_series_count(plot, series); i++) {
        double here = plot_y_at(plot, series, i), next = plot_y_at(plot, series, i + 1);
        bool leaves = isfinite(here) && isinf(next), returns = isinf(here) && isfinite(next);
        if (leaves || returns) {
            const double x = plot_x_at(plot, series, leaves ? i : i + 1);
            draw_arrow(svg, frame, plot_page_at(&frame->x, x), (leaves ? next : here) > 0);
        }
    }
}

/* A dot at each sample, where they are few; what was put between them is the curve's alone. */
static void draw_dots(struct svg *svg, const struct plot *plot, const struct plot_frame *frame,
                      const struct plot_series *series)
{
    const size_t count = plot_series_count(plot, series);
    size_t samples = 0;
    for (size_t i = 0; i < count; i++) {
        samples += plot_place_at(series, i) == PLOT_SAMPLE;
    }
    for (size_t i = 0; i < count && samples <= DOTS_MAX; i++) {
        double v = plot_y_at(plot, series, i);
        if (isfinite(v) && plot_place_at(series, i) == PLOT_SAMPLE) {
            svg_circle(svg, plot_page_at(&frame->x, plot_x_at(plot, series, i)),
                       plot_page_at(&frame->y, v), 3.2);
        }
    }
}

static void plot_draw_curves(struct svg *svg, const struct plot *plot, struct plot_frame *frame)
{
    const struct plot_axis *x = &frame->x, *y = &frame->y;
    svg_clip_begin(svg, x->start, y->stop - 1, x->stop - x->start + 1, y->start - y->stop + 2);
    for (size_t b = 0; b < plot->band_count; b++) {
        const char *colour = palette_colour(plot->series[plot->bands[b].low].style);
        svg_group_begin(svg, &(struct svg_style){.fill = colour, .opacity = 0.13});
        draw_band(svg, plot, frame, &plot->bands[b]);
        svg_group_end(svg);
    }
    for (size_t s = 0; s < plot->series_count; s++) {
        struct svg_style style = plot_line_of(&plot->series[s]);
        struct plot_points line =
            plot_trace(plot, frame, &plot->series[s], 0, plot_series_count(plot, &plot->series[s]),
                       false, svg->arena);
        svg_styled_polyline(svg, &style, line.x, line.y, line.count);
    }
    svg_group_end(svg);
    for (size_t s = 0; s < plot->series_count; s++) {
        const char *colour = palette_colour(plot->series[s].style);
        svg_group_begin(svg, &(struct svg_style){.fill = colour, .stroke = "#fff"});
        draw_arrows(svg, plot, frame, &plot->series[s]);
        draw_dots(svg, plot, frame, &plot->series[s]);
        svg_group_end(svg);
    }
}

/* -------- labels of the curves -------- */

struct plot_key {
    const struct plot_series *series;
    double y; /* px */
};

/* Where a curve ends on the page. */
static double plot_end_of(const struct plot *plot, const struct plot_frame *frame,
                          const struct plot_series *series)
{
    const struct plot_axis *axis = &frame->y;
    for (size_t i = plot_series_count(plot, series); i-- > 0;) {
        double v = plot_y_at(plot, series, i);
        if (isinf(v)) {
            return v > 0 ? axis->stop : axis->start;
        }
        if (!isnan(v)) {
            return fmin(fmax(plot_page_at(axis, v), axis->stop), axis->start);
        }
    }
    return axis->start;
}

static void draw_keys(struct svg *svg, const struct plot *plot, const struct plot_frame *frame)
{
    struct plot_key *keys = ARENA_ARRAY(svg->arena, plot->series_count, struct plot_key);
    /* The labelled series from top to bottom, as their curves end. */
    size_t count = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        if (!plot->series[s].label) {
            continue;
        }
        struct plot_key key = {&plot->series[s], plot_end_of(plot, frame, &plot->series[s])};
        size_t at = count++;
        for (; at > 0 && keys[at - 1].y > key.y; at--) {
            keys[at] = keys[at - 1];
        }
        keys[at] = key;
    }
    double left = frame->x.stop + 12, height = frame->y.start - frame->y.stop;
    double gap = fmin(18, height / (double)(count + 1));
    /* Move the labels apart: down from the top, then up again from the lower edge. */
    double next = frame->y.stop;
    for (size_t i = 0; i < count; i++) {
        keys[i].y = fmax(keys[i].y, next);
        next = keys[i].y + gap;
    }
    next = frame->y.start;
    for (size_t i = count; i-- > 0;) {
        keys[i].y = fmin(keys[i].y, next);
        next = keys[i].y - gap;
    }
    for (size_t i = 0; i < count; i++) {
        struct svg_style style = plot_line_of(keys[i].series);
        svg_styled_line(svg, &style, left, keys[i].y, left + 28, keys[i].y);
        svg_words_within(svg, left + 36, keys[i].y + 4, fmin(NUMBER_SIZE, gap),
                         PLOT_WIDTH - left - 42, NULL, keys[i].series->label);
    }
}

/* -------- the page -------- */

bool plot_draw(const struct plot *plot, struct svg *svg, struct error *error)
{
    struct plot_frame frame = {.x.log = plot->log_x, .y.log = plot->log_y};
    if (!plot_find_range(plot, &frame.x, &frame.y)) {
        return fail(error, ERROR_DOMAIN, "nothing to plot: no value is finite%s",
                    plot->log_x || plot->log_y ? " and positive" : "");
    }
    plot_set_x_axis(&frame.x);
    plot_axis_to_ticks(&frame.y);
    /* Place the frame so that all words fit around it. */
    double width = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        if (plot->series[s].label) {
            width = fmax(width, svg_text_width(plot->series[s].label, NUMBER_SIZE));
        }
    }
    frame.x.start = 44 + ticks_width(svg->arena, &frame.y.ticks, NUMBER_SIZE);
    frame.x.stop = PLOT_WIDTH - (width > 0 ? fmin(58 + width, 260) : 28);
    frame.y.start = PLOT_HEIGHT - 60;
    frame.y.stop = 88;
    svg_begin(svg, PLOT_WIDTH, PLOT_HEIGHT, plot->title);
    plot_draw_grid(svg, plot, &frame);
    plot_draw_curves(svg, plot, &frame);
    plot_draw_axes(svg, plot, &frame);
    plot_draw_words(svg, plot, &frame);
    draw_keys(svg, plot, &frame);
    svg_end(svg);
    return true;
}
