/* draw/plot_frame.c - the axes of a plot, and its points as they can be drawn. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot_frame.h"

#include "draw/svg.h"

#include <math.h>
#include <stdlib.h>

static const double HUGEST = 1e200, TINIEST = 1e-200;

/* -------- values -------- */

double plot_drawable(double value, bool log)
{
    if (log && !(value > 0)) {
        return NAN;
    }
    if (fabs(value) > HUGEST) {
        return copysign(INFINITY, value);
    }
    const double least = log ? (double)NAN : 0;
    return fabs(value) < TINIEST ? least : value;
}

size_t plot_series_count(const struct plot *plot, const struct plot_series *series)
{
    return series->x != NULL ? series->count : plot->count;
}

double plot_x_at(const struct plot *plot, const struct plot_series *series, size_t i)
{
    return plot_drawable(series->x != NULL ? series->x[i] : plot->x[i], plot->log_x);
}

double plot_y_at(const struct plot *plot, const struct plot_series *series, size_t i)
{
    if (!isfinite(plot_x_at(plot, series, i))) {
        return NAN;
    }
    return plot_drawable(series->y[i], plot->log_y);
}

enum plot_place plot_place_at(const struct plot_series *series, size_t i)
{
    return series->places != NULL ? (enum plot_place)series->places[i] : PLOT_SAMPLE;
}

/* -------- axes -------- */

static void plot_frame_include(struct plot_axis *axis, double v)
{
    axis->low = fmin(axis->low, v);
    axis->high = fmax(axis->high, v);
}

bool plot_find_range(const struct plot *plot, struct plot_axis *x, struct plot_axis *y)
{
    x->low = y->low = INFINITY;
    x->high = y->high = -INFINITY;
    for (size_t s = 0; s < plot->series_count; s++) {
        const struct plot_series *series = &plot->series[s];
        for (size_t i = 0; i < plot_series_count(plot, series); i++) {
            double v = plot_y_at(plot, series, i);
            if (!isnan(v)) {
                plot_frame_include(x, plot_x_at(plot, series, i));
            }
            const bool is_far = plot->is_limited && !(v >= plot->y_least && v <= plot->y_most);
            if (isfinite(v) && !is_far && plot_place_at(series, i) != PLOT_BEYOND) {
                plot_frame_include(y, v);
            }
        }
    }
    const bool any = y->low <= y->high;
    if (any && plot->is_share) {
        plot_frame_include(y, 0);
        plot_frame_include(y, 1);
    }
    return any;
}

/* From which ratio of its ends on an axis is logarithmic: stops are steps of equal length. */
static double least_ratio(enum ticks_kind kind)
{
    static const double ratios[] = {
        [TICKS_NUMBERS] = 50, [TICKS_FNUMBER] = 1.9, [TICKS_TIME] = 10, [TICKS_ISO] = 1.9};
    return ratios[kind];
}

static int numbers_ascend(const void *first, const void *second)
{
    const double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

/* Where a few values are far from the rest: the y axis as the rest wants it. */
static void limit_to_bulk(struct plot *plot)
{
    enum { LEAST = 8, MOST = 4096 };
    double values[MOST];
    size_t count = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        for (size_t i = 0; i < plot_series_count(plot, &plot->series[s]) && count < MOST; i++) {
            const double v = plot_y_at(plot, &plot->series[s], i);
            values[count] = v;
            count += isfinite(v) ? 1 : 0;
        }
    }
    if (count < LEAST) {
        return;
    }
    qsort(values, count, sizeof values[0], numbers_ascend);
    const size_t tail = (count - 1) / 10;
    const double least = values[0], most = values[count - 1];
    const double low = values[tail], high = values[count - 1 - tail], room = 0.25 * (high - low);
    const bool above = most - high > 5 * (high - least), below = low - least > 5 * (most - low);
    plot->is_limited = high > low && (above || below);
    plot->y_least = below ? low - room : least;
    plot->y_most = above ? high + room : most;
}

void plot_choose_axes(struct plot *plot)
{
    struct plot_axis x, y;
    plot->log_x = plot->log_y = plot->is_limited = false;
    bool any = plot_find_range(plot, &x, &y);
    plot->log_x = any && x.low > 0 && x.high / x.low > least_ratio(plot->x_kind);
    plot->log_y = any && y.low > 0 && y.high / y.low > least_ratio(plot->y_kind);
    if (!plot->log_y) {
        limit_to_bulk(plot);
    }
}

double plot_page_at(const struct plot_axis *axis, double value)
{
    double part = axis->log ? (log(value) - log(axis->low)) / (log(axis->high) - log(axis->low))
                            : (value - axis->low) / (axis->high - axis->low);
    return axis->start + part * (axis->stop - axis->start);
}

double plot_near_page(const struct plot_axis *axis, double at)
{
    const double room = 2 * fabs(axis->start - axis->stop);
    const double low = fmin(axis->start, axis->stop) - room;
    const double high = fmax(axis->start, axis->stop) + room;
    return fmin(fmax(at, low), high);
}

double plot_value_at(const struct plot_axis *axis, double at)
{
    const double part = (at - axis->start) / (axis->stop - axis->start);
    return axis->log ? exp(log(axis->low) + part * (log(axis->high) - log(axis->low)))
                     : axis->low + part * (axis->high - axis->low);
}

static void choose_ticks(struct plot_axis *axis)
{
    if (axis->log) {
        ticks_stops(axis->kind, axis->low, axis->high, &axis->ticks);
    } else {
        ticks_linear(axis->low, axis->high, &axis->ticks);
    }
}

void plot_axis_to_ticks(struct plot_axis *axis)
{
    choose_ticks(axis);
    axis->low = axis->ticks.value[0];
    axis->high = axis->ticks.value[axis->ticks.count - 1];
}

static void keep_ticks_inside(struct plot_axis *axis)
{
    double slack = 1e-9 * (axis->high - axis->low);
    size_t kept = 0;
    for (size_t i = 0; i < axis->ticks.count; i++) {
        double v = axis->ticks.value[i];
        if (v >= axis->low - slack && v <= axis->high + slack) {
            axis->ticks.text[kept] = axis->ticks.text[i];
            axis->ticks.value[kept++] = v;
        }
    }
    axis->ticks.count = kept;
}

void plot_set_x_axis(struct plot_axis *x)
{
    ticks_widen(&x->low, &x->high);
    choose_ticks(x);
    keep_ticks_inside(x);
    const size_t least = x->kind != TICKS_NUMBERS ? 2 : 3;
    if (x->ticks.count < least) { /* a short logarithmic axis between two round numbers */
        ticks_linear(x->low, x->high, &x->ticks);
        keep_ticks_inside(x);
    }
}

void plot_axes_grid(struct svg *svg, const struct plot_axis *x, const struct plot_axis *y)
{
    svg_group_begin(svg, &(struct svg_style){.stroke = "#dddddd", .width = 0.7});
    for (size_t i = 0; i < x->ticks.count; i++) {
        const double at = plot_page_at(x, x->ticks.value[i]);
        svg_line(svg, at, y->start, at, y->stop);
    }
    for (size_t i = 0; i < y->ticks.count; i++) {
        const double at = plot_page_at(y, y->ticks.value[i]);
        svg_line(svg, x->start, at, x->stop, at);
    }
    svg_group_end(svg);
    svg_styled_rect(svg, &(struct svg_style){.stroke = "#000000", .width = 1}, x->start, y->stop,
                    x->stop - x->start, y->start - y->stop);
}

void plot_axes_numbers(struct svg *svg, const struct plot_axis *x, const struct plot_axis *y,
                       double size)
{
    for (size_t i = 0; i < x->ticks.count; i++) {
        svg_words(svg, plot_page_at(x, x->ticks.value[i]), y->start + 18, size, SVG_MIDDLE, NULL,
                  ticks_text(svg->arena, &x->ticks, i));
    }
    for (size_t i = 0; i < y->ticks.count; i++) {
        svg_words(svg, x->start - 8, plot_page_at(y, y->ticks.value[i]) + 4, size, SVG_END, NULL,
                  ticks_text(svg->arena, &y->ticks, i));
    }
}
