/* draw/plot.c - line plots of several series, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17; /* px */
static const double HUGEST = 1e200, TINIEST = 1e-200;
static const size_t STRETCHES = 1000; /* about one a pixel */
static const size_t DOTS_MAX = 30;

#define ARROWS 64

/* For round line ends, which lengthen each by the line's width, and for black-and-white print. */
static const char *const dashes[] = {NULL,        "7 5",      "0.1 4.5",
                                     "9 5 0.1 5", "13 5 3 5", "8 5 0.1 4 0.1 5"};

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

struct axis {
    bool log;
    double low, high;   /* values at the ends */
    double start, stop; /* px, where they lie */
    struct ticks ticks;
};

struct frame {
    struct axis x, y;
    double arrow_x[ARROWS]; /* px, of the infinity signs drawn so far */
    size_t arrow_count;
};

struct points {
    double *x, *y; /* px */
    size_t count;
};

/* -------- values and axes -------- */

/* A value as it can be drawn: NaN = gap, +-inf = off the edge. */
static double drawable(double v, bool log)
{
    if (log && !(v > 0)) {
        return NAN;
    }
    if (fabs(v) > HUGEST) {
        return copysign(INFINITY, v);
    }
    return fabs(v) < TINIEST ? (log ? NAN : 0) : v;
}

static double x_at(const struct plot *plot, size_t i)
{
    return drawable(plot->x[i], plot->log_x);
}

static double y_at(const struct plot *plot, const double *y, size_t i)
{
    if (!isfinite(x_at(plot, i))) {
        return NAN;
    }
    bool over = plot->y_limit > 0 && y[i] > plot->y_limit;
    return over ? INFINITY : drawable(y[i], plot->log_y);
}

static void include(struct axis *axis, double v)
{
    axis->low = fmin(axis->low, v);
    axis->high = fmax(axis->high, v);
}

/* The range of all points that can be drawn; false if there is none. */
static bool find_range(const struct plot *plot, struct axis *x, struct axis *y)
{
    x->low = y->low = INFINITY;
    x->high = y->high = -INFINITY;
    for (size_t i = 0; i < plot->count; i++) {
        for (size_t s = 0; s < plot->series_count; s++) {
            double v = y_at(plot, plot->series[s].y, i);
            if (!isnan(v)) {
                include(x, x_at(plot, i));
            }
            if (isfinite(v)) {
                include(y, v);
            }
        }
    }
    return y->low <= y->high;
}

void plot_choose_axes(struct plot *plot)
{
    struct axis x, y;
    plot->log_x = plot->log_y = false;
    bool any = find_range(plot, &x, &y);
    plot->log_x = any && x.low > 0 && x.high / x.low > 50;
    plot->log_y = any && y.low > 0 && y.high / y.low > 50;
}

static double page_at(const struct axis *axis, double v)
{
    double part = axis->log ? (log(v) - log(axis->low)) / (log(axis->high) - log(axis->low))
                            : (v - axis->low) / (axis->high - axis->low);
    return axis->start + part * (axis->stop - axis->start);
}

static void choose_ticks(struct axis *axis, double low, double high)
{
    if (axis->log) {
        ticks_log(low, high, &axis->ticks);
    } else {
        ticks_linear(low, high, &axis->ticks);
    }
}

/* The y axis reaches from tick to tick. */
static void set_y_axis(struct axis *y)
{
    choose_ticks(y, y->low, y->high);
    y->low = y->ticks.value[0];
    y->high = y->ticks.value[y->ticks.count - 1];
}

static void keep_ticks_inside(struct axis *axis)
{
    double slack = 1e-9 * (axis->high - axis->low);
    size_t kept = 0;
    for (size_t i = 0; i < axis->ticks.count; i++) {
        double v = axis->ticks.value[i];
        if (v >= axis->low - slack && v <= axis->high + slack) {
            axis->ticks.value[kept++] = v;
        }
    }
    axis->ticks.count = kept;
}

/* The x axis ends where the data end. */
static void set_x_axis(struct axis *x)
{
    ticks_widen(&x->low, &x->high);
    choose_ticks(x, x->low, x->high);
    keep_ticks_inside(x);
    if (x->ticks.count < 3) { /* a short logarithmic axis between two round numbers */
        ticks_linear(x->low, x->high, &x->ticks);
        keep_ticks_inside(x);
    }
}

/* -------- grid and axes -------- */

static void draw_minor(struct svg *svg, const struct frame *frame, const struct axis *axis)
{
    double decades = log10(axis->high) - log10(axis->low);
    if (!axis->log || decades > 6) {
        return;
    }
    for (double decade = floor(log10(axis->low)); decade <= log10(axis->high); decade++) {
        for (int digit = 1; digit <= 9; digit++) {
            double v = digit * pow(10, decade), at = page_at(axis, v);
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

static void draw_grid(struct svg *svg, const struct plot *plot, const struct frame *frame)
{
    const struct axis *x = &frame->x, *y = &frame->y;
    svg_group_begin(svg, &(struct svg_style){.stroke = "#eee", .width = 0.7});
    draw_minor(svg, frame, y);
    if (!plot->x_ticks) {
        draw_minor(svg, frame, x);
    }
    svg_group_end(svg);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#d4d4d4", .width = 0.8});
    for (size_t i = 0; i < y->ticks.count; i++) {
        double at = page_at(y, y->ticks.value[i]);
        svg_line(svg, x->start, at, x->stop, at);
    }
    for (size_t i = 0; !plot->x_ticks && i < x->ticks.count; i++) {
        double at = page_at(x, x->ticks.value[i]);
        svg_line(svg, at, y->start, at, y->stop);
    }
    svg_group_end(svg);
}

/* One mark of the x axis; its number only where it is clear of the one before. */
static void draw_x_tick(struct svg *svg, const struct frame *frame, double at, const char *text,
                        double *clear)
{
    double half = svg_text_width(text, NUMBER_SIZE) / 2, bottom = frame->y.start;
    svg_line(svg, at, bottom, at, bottom + 5);
    if (at - half < *clear || at + half > PLOT_WIDTH) {
        return;
    }
    svg_text(
        svg,
        &(struct svg_label){.x = at, .y = bottom + 19, .size = NUMBER_SIZE, .anchor = SVG_MIDDLE},
        text);
    *clear = at + half + 6;
}

static void draw_x_numbers(struct svg *svg, const struct plot *plot, const struct frame *frame)
{
    const struct axis *x = &frame->x;
    double clear = 0;
    for (size_t i = 0; !plot->x_ticks && i < x->ticks.count; i++) {
        draw_x_tick(svg, frame, page_at(x, x->ticks.value[i]), ticks_text(svg->arena, &x->ticks, i),
                    &clear);
    }
    for (size_t i = 0; plot->x_ticks && i < plot->x_tick_count; i++) {
        double v = plot->x_ticks[i], slack = 1e-9 * (x->high - x->low);
        if (v >= x->low - slack && v <= x->high + slack) {
            draw_x_tick(svg, frame, page_at(x, v), ticks_fixed(svg->arena, v, 0), &clear);
        }
    }
}

static void draw_axes(struct svg *svg, const struct plot *plot, const struct frame *frame)
{
    const struct axis *x = &frame->x, *y = &frame->y;
    svg_group_begin(svg, &(struct svg_style){.stroke = "#333", .width = 1});
    svg_line(svg, x->start, y->start, x->stop, y->start);
    svg_line(svg, x->start, y->start, x->start, y->stop);
    draw_x_numbers(svg, plot, frame);
    for (size_t i = 0; i < y->ticks.count; i++) {
        double at = page_at(y, y->ticks.value[i]);
        svg_line(svg, x->start - 5, at, x->start, at);
        svg_text(svg,
                 &(struct svg_label){
                     .x = x->start - 9, .y = at + 4, .size = NUMBER_SIZE, .anchor = SVG_END},
                 ticks_text(svg->arena, &y->ticks, i));
    }
    svg_group_end(svg);
}

static void draw_words(struct svg *svg, const struct plot *plot, const struct frame *frame)
{
    const struct axis *x = &frame->x, *y = &frame->y;
    double left = x->start, room = PLOT_WIDTH - left - 12;
    struct svg_label title = {.x = left, .y = 32, .size = TITLE_SIZE, .width = room, .bold = true};
    struct svg_label subtitle = {
        .x = left, .y = 52, .size = LABEL_SIZE, .width = room, .colour = "#555"};
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
    svg_text(svg, &title, plot->title ? plot->title : "");
    svg_text(svg, &subtitle, plot->subtitle ? plot->subtitle : "");
    svg_text(svg, &below, plot->x_label ? plot->x_label : "");
    svg_text(svg, &beside, plot->y_label ? plot->y_label : "");
}

/* -------- curves -------- */

/*
 * Which of the points from .. to - 1 are drawn: all, or of each stretch of a long series the least
 * and the greatest value in the order they come, so that no peak is lost.
 */
static size_t thin(const struct plot *plot, const double *y, size_t from, size_t to, size_t *index)
{
    size_t stretch = plot->count > 2 * STRETCHES ? (plot->count + STRETCHES - 1) / STRETCHES : 1;
    size_t count = 0;
    for (size_t start = from; start < to; start += stretch) {
        size_t end = to - start < stretch ? to : start + stretch, least = start, greatest = start;
        for (size_t i = start; i < end; i++) {
            double v = y_at(plot, y, i);
            if (isnan(y_at(plot, y, least)) || v < y_at(plot, y, least)) {
                least = i;
            }
            if (isnan(y_at(plot, y, greatest)) || v > y_at(plot, y, greatest)) {
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

static void add_point(struct points *points, double x, double y)
{
    points->x[points->count] = x;
    points->y[points->count++] = y;
}

/*
 * The points of a curve on the page. Between a finite and an infinite value it runs vertically to
 * the edge at the finite one's x, and on along the edge if it is the `edge` of an area.
 */
static struct points trace(const struct plot *plot, const struct frame *frame, const double *y,
                           size_t from, size_t to, bool edge, struct arena *arena)
{
    size_t *index = ARENA_ARRAY(arena, 2 * STRETCHES + 2, size_t);
    size_t count = thin(plot, y, from, to, index);
    struct points points = {ARENA_ARRAY(arena, 2 * count, double),
                            ARENA_ARRAY(arena, 2 * count, double), 0};
    double before = NAN, before_x = NAN;
    for (size_t i = 0; i < count; i++) {
        double v = y_at(plot, y, index[i]);
        double x = page_at(&frame->x, x_at(plot, index[i]));
        double off = (isinf(v) ? v : before) > 0 ? frame->y.stop : frame->y.start;
        if (isinf(v) && isfinite(before)) {
            add_point(&points, before_x, off);
        }
        if (isinf(before) && isfinite(v)) {
            add_point(&points, x, off);
        }
        double inside = isnan(v) ? NAN : page_at(&frame->y, v);
        add_point(&points, x, !isinf(v) ? inside : edge ? off : NAN);
        before = v;
        before_x = x;
    }
    return points;
}

static void draw_area(struct svg *svg, const struct points *low, const struct points *high)
{
    size_t count = low->count + high->count;
    struct points area = {ARENA_ARRAY(svg->arena, count, double),
                          ARENA_ARRAY(svg->arena, count, double), 0};
    for (size_t i = 0; i < high->count; i++) {
        add_point(&area, high->x[i], high->y[i]);
    }
    for (size_t i = low->count; i-- > 0;) {
        add_point(&area, low->x[i], low->y[i]);
    }
    svg_polygon(svg, area.x, area.y, area.count);
}

/* The band in every stretch where both curves have values; stretches below a pixel are left out. */
static void draw_band(struct svg *svg, const struct plot *plot, const struct frame *frame,
                      const struct plot_band *band)
{
    const double *low = plot->series[band->low].y, *high = plot->series[band->high].y;
    size_t start = 0;
    for (size_t i = 0; i <= plot->count; i++) {
        if (i < plot->count && !isnan(y_at(plot, low, i)) && !isnan(y_at(plot, high, i))) {
            continue;
        }
        if (i - start > 1 && i - start > plot->count / STRETCHES) {
            struct points below = trace(plot, frame, low, start, i, true, svg->arena);
            struct points above = trace(plot, frame, high, start, i, true, svg->arena);
            draw_area(svg, &below, &above);
        }
        start = i + 1;
    }
}

static struct svg_style line_of(const struct plot_series *series)
{
    const size_t dash = series->dash > 0 ? series->dash - 1 : series->style;
    return (struct svg_style){
        .stroke = palette_colour(series->style), .dash = dashes[dash % COUNT(dashes)], .width = 2};
}

/* An arrow at the edge that says where a curve goes; one where several would lie together. */
static void draw_arrow(struct svg *svg, struct frame *frame, double x, bool up)
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
    svg_text(svg,
             &(struct svg_label){.x = up ? x : x + side,
                                 .y = up ? frame->y.stop - 11 : frame->y.start - 5,
                                 .size = 16,
                                 .anchor = up ? SVG_MIDDLE : SVG_START},
             up ? "∞" : "−∞");
}

static void draw_arrows(struct svg *svg, const struct plot *plot, struct frame *frame,
                        const double *y)
{
    for (size_t i = 0; i + 1 < plot->count; i++) {
        double a = y_at(plot, y, i), b = y_at(plot, y, i + 1);
        bool leaves = isfinite(a) && isinf(b), returns = isinf(a) && isfinite(b);
        if (leaves || returns) {
            draw_arrow(svg, frame, page_at(&frame->x, x_at(plot, leaves ? i : i + 1)),
                       (leaves ? b : a) > 0);
        }
    }
}

static void draw_dots(struct svg *svg, const struct plot *plot, const struct frame *frame,
                      const double *y)
{
    for (size_t i = 0; i < plot->count; i++) {
        double v = y_at(plot, y, i);
        if (isfinite(v)) {
            svg_circle(svg, page_at(&frame->x, x_at(plot, i)), page_at(&frame->y, v), 3.2);
        }
    }
}

static void draw_curves(struct svg *svg, const struct plot *plot, struct frame *frame)
{
    const struct axis *x = &frame->x, *y = &frame->y;
    svg_clip_begin(svg, x->start, y->stop - 1, x->stop - x->start + 1, y->start - y->stop + 2);
    for (size_t b = 0; b < plot->band_count; b++) {
        const char *colour = palette_colour(plot->series[plot->bands[b].low].style);
        svg_group_begin(svg, &(struct svg_style){.fill = colour, .opacity = 0.13});
        draw_band(svg, plot, frame, &plot->bands[b]);
        svg_group_end(svg);
    }
    for (size_t s = 0; s < plot->series_count; s++) {
        struct svg_style style = line_of(&plot->series[s]);
        struct points line =
            trace(plot, frame, plot->series[s].y, 0, plot->count, false, svg->arena);
        svg_group_begin(svg, &style);
        svg_polyline(svg, line.x, line.y, line.count);
        svg_group_end(svg);
    }
    svg_group_end(svg);
    for (size_t s = 0; s < plot->series_count; s++) {
        const char *colour = palette_colour(plot->series[s].style);
        svg_group_begin(svg, &(struct svg_style){.fill = colour, .stroke = "#fff"});
        draw_arrows(svg, plot, frame, plot->series[s].y);
        if (plot->count <= DOTS_MAX) {
            draw_dots(svg, plot, frame, plot->series[s].y);
        }
        svg_group_end(svg);
    }
}

/* -------- labels of the curves -------- */

struct key {
    const struct plot_series *series;
    double y; /* px */
};

/* Where a curve ends on the page. */
static double end_of(const struct plot *plot, const struct frame *frame, const double *y)
{
    const struct axis *axis = &frame->y;
    for (size_t i = plot->count; i-- > 0;) {
        double v = y_at(plot, y, i);
        if (isinf(v)) {
            return v > 0 ? axis->stop : axis->start;
        }
        if (!isnan(v)) {
            return page_at(axis, v);
        }
    }
    return axis->start;
}

/* The labelled series from top to bottom, as their curves end. */
static size_t collect_keys(const struct plot *plot, const struct frame *frame, struct key *keys)
{
    size_t count = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        if (!plot->series[s].label) {
            continue;
        }
        struct key key = {&plot->series[s], end_of(plot, frame, plot->series[s].y)};
        size_t at = count++;
        for (; at > 0 && keys[at - 1].y > key.y; at--) {
            keys[at] = keys[at - 1];
        }
        keys[at] = key;
    }
    return count;
}

/* Move the labels apart: down from the top, then up again from the lower edge. */
static void spread_keys(struct key *keys, size_t count, double top, double bottom, double gap)
{
    double next = top;
    for (size_t i = 0; i < count; i++) {
        keys[i].y = fmax(keys[i].y, next);
        next = keys[i].y + gap;
    }
    next = bottom;
    for (size_t i = count; i-- > 0;) {
        keys[i].y = fmin(keys[i].y, next);
        next = keys[i].y - gap;
    }
}

static void draw_keys(struct svg *svg, const struct plot *plot, const struct frame *frame)
{
    struct key *keys = ARENA_ARRAY(svg->arena, plot->series_count, struct key);
    size_t count = collect_keys(plot, frame, keys);
    double left = frame->x.stop + 12, height = frame->y.start - frame->y.stop;
    double gap = fmin(18, height / (double)(count + 1));
    spread_keys(keys, count, frame->y.stop, frame->y.start, gap);
    for (size_t i = 0; i < count; i++) {
        struct svg_style style = line_of(keys[i].series);
        svg_group_begin(svg, &style);
        svg_line(svg, left, keys[i].y, left + 28, keys[i].y);
        svg_group_end(svg);
        svg_text(svg,
                 &(struct svg_label){.x = left + 36,
                                     .y = keys[i].y + 4,
                                     .size = fmin(NUMBER_SIZE, gap),
                                     .width = PLOT_WIDTH - left - 42},
                 keys[i].series->label);
    }
}

/* -------- the page -------- */

static double widest_number(struct svg *svg, const struct ticks *ticks)
{
    double width = 0;
    for (size_t i = 0; i < ticks->count; i++) {
        width = fmax(width, svg_text_width(ticks_text(svg->arena, ticks, i), NUMBER_SIZE));
    }
    return width;
}

static double widest_label(const struct plot *plot)
{
    double width = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        if (plot->series[s].label) {
            width = fmax(width, svg_text_width(plot->series[s].label, NUMBER_SIZE));
        }
    }
    return width;
}

/* Place the frame so that all words fit around it. */
static void set_frame(struct svg *svg, const struct plot *plot, struct frame *frame)
{
    double label = widest_label(plot);
    frame->x.start = 44 + widest_number(svg, &frame->y.ticks);
    frame->x.stop = PLOT_WIDTH - (label > 0 ? fmin(58 + label, 260) : 28);
    frame->y.start = PLOT_HEIGHT - 60;
    frame->y.stop = 88;
}

bool plot_draw(const struct plot *plot, struct svg *svg, struct error *error)
{
    struct frame frame = {.x.log = plot->log_x, .y.log = plot->log_y};
    if (!find_range(plot, &frame.x, &frame.y)) {
        return fail(error, ERROR_DOMAIN, "nothing to plot: no value is finite%s",
                    plot->log_x || plot->log_y ? " and positive" : "");
    }
    set_x_axis(&frame.x);
    set_y_axis(&frame.y);
    set_frame(svg, plot, &frame);
    svg_begin(svg, PLOT_WIDTH, PLOT_HEIGHT, plot->title);
    draw_grid(svg, plot, &frame);
    draw_curves(svg, plot, &frame);
    draw_axes(svg, plot, &frame);
    draw_words(svg, plot, &frame);
    draw_keys(svg, plot, &frame);
    svg_end(svg);
    return true;
}
