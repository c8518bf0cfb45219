/* draw/plot.c - line plots of several series, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/error.h"
#include "draw/palette.h"
#include "draw/plot_frame.h"
#include "draw/plot_keys.h"
#include "draw/svg.h"
#include "draw/ticks.h"

static const double NUMBER_SIZE = 12, LABEL_SIZE = 13, TITLE_SIZE = 17; /* px */
static const size_t STRETCHES = 1000;                                   /* about one a pixel */
static const size_t DOTS_MAX = 30;
static const double BAND_TINT = 0.14; /* of their colour */

#define ARROWS 64

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
    if (!axis->log || decades > 6 || axis->ticks.text[0] != NULL) {
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
 * The edge at which a curve comes back to a finite value, px: that of the infinity it was at, or at
 * a pole, where it changes its sign, the one beyond which the value lies.
 */
static double comes_from(const struct plot_axis *axis, double before, double v)
{
    const double at = plot_page_at(axis, v);
    const bool is_below = at > axis->start || (before < 0 && at >= axis->stop);
    return is_below ? axis->start : axis->stop;
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
        if (isinf(v) && before >= frame->y.low && before <= frame->y.high) {
            plot_add_point(&points, before_x, off);
        }
        if (isinf(before) && v >= frame->y.low && v <= frame->y.high) {
            plot_add_point(&points, x, comes_from(&frame->y, before, v));
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

/* A tenth of a colour over the page. */
static const char *plot_tint(struct arena *arena, const char *colour)
{
    const long value = strtol(colour + 1, NULL, 16);
    long tint = 0;
    for (int shift = 16; shift >= 0; shift -= 8) {
        const double part = (double)(value >> shift & 255);
        tint = tint << 8 | lround(255 - BAND_TINT * (255 - part));
    }
    return arena_printf(arena, "#%06lx", (unsigned long)tint & 0xffffff);
}

/* How much of the page a band covers, px^2 of its samples. */
static double band_area(const struct plot *plot, const struct plot_frame *frame,
                        const struct plot_band *band)
{
    const struct plot_axis *axis = &frame->y;
    const struct plot_series *low = &plot->series[band->low];
    double area = 0;
    for (size_t i = 0; i + 1 < plot_series_count(plot, low); i++) {
        double y[2] = {plot_y_at(plot, low, i), INFINITY};
        if (band->high != PLOT_UNBOUNDED) {
            y[1] = plot_y_at(plot, &plot->series[band->high], i);
        }
        const double step = fabs(plot_page_at(&frame->x, plot_x_at(plot, low, i + 1)) -
                                 plot_page_at(&frame->x, plot_x_at(plot, low, i)));
        for (int k = 0; k < 2; k++) {
            y[k] = isinf(y[k]) ? axis->stop : fmax(plot_page_at(axis, y[k]), axis->stop);
        }
        area += isfinite(step * (y[0] - y[1])) ? step * fabs(y[0] - y[1]) : 0;
    }
    return area;
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

/*
 * An arrow at the edge that says where a curve goes, or comes from, with words beside it, where the
 * curve is not; one where several would lie together.
 */
static void draw_arrow(struct svg *svg, struct plot_frame *frame, double x, bool up, bool leaves,
                       const char *text)
{
    const double size = strstr(text, "∞") == NULL ? NUMBER_SIZE : 16;
    const double width = svg_text_width(text, size);
    const double at = up ? x : x + 2 * PLOT_WIDTH; /* those of one edge */
    for (size_t i = 0; i < frame->arrow_count; i++) {
        if (fabs(frame->arrow_x[i] - at) < 4 + width) {
            return;
        }
    }
    if (frame->arrow_count == ARROWS) {
        return;
    }
    frame->arrow_x[frame->arrow_count++] = at;
    svg_path(svg, x, up ? frame->y.stop : frame->y.start,
             up ? "M-4.5 0L0 -9 4.5 0z" : "M-4.5 -9L0 0 4.5 -9z");
    const bool has_right = x + 8 + width<frame->x.stop, has_left = x - 8 - width> frame->x.start;
    const double beside = has_right && (leaves || !has_left) ? x + 8 : x - 8 - width;
    const double above = fmax(frame->x.start, fmin(x - width / 2, PLOT_WIDTH - width - 4));
    svg_words(svg, up ? above : beside, up ? frame->y.stop - 12 : frame->y.start - 5, size,
              SVG_START, NULL, text);
}

/*
 * How far a curve goes that leaves the page between two points, the first or the second of which is
 * on it: "∞", "1200"; null: it only bends out between two samples. `asymptote` receives the point
 * before the curve is infinite.
 */
static const char *arrow_words(const struct plot *plot, const struct plot_axis *axis,
                               const struct plot_series *series, size_t from, bool onwards,
                               struct arena *arena, size_t *asymptote)
{
    const size_t count = plot_series_count(plot, series);
    const bool up = plot_y_at(plot, series, from) > axis->high;
    double most = up ? axis->high : axis->low;
    size_t last = from;
    bool is_sample = false, is_infinite = false;
    for (size_t i = from; i < count && !is_infinite; i += onwards ? 1 : (size_t)-1) {
        const double v = plot_y_at(plot, series, i);
        const enum plot_place place = plot_place_at(series, i);
        is_infinite = isinf(v) || (isnan(v) && place == PLOT_BEYOND); /* or at a pole */
        if (is_infinite || !(up ? v > axis->high : v < axis->low)) {
            break;
        }
        is_sample = is_sample || place == PLOT_SAMPLE;
        most = fabs(v) > fabs(most) ? v : most;
        last = i;
    }
    if (is_infinite) {
        *asymptote = isfinite(plot_y_at(plot, series, last)) ? last : *asymptote;
        return up ? "∞" : "−∞";
    }
    const double rounded = strtod(arena_printf(arena, "%.3g", most), NULL);
    return is_sample ? ticks_fixed(arena, rounded, 0) : NULL;
}

static bool is_on_axis(const struct plot_axis *axis, double v)
{
    return v >= axis->low && v <= axis->high;
}

/* Where a curve leaves for infinity or for what is far, and where it comes back from there. */
static void draw_arrows(struct svg *svg, const struct plot *plot, struct plot_frame *frame,
                        const struct plot_series *series)
{
    const struct plot_axis *axis = &frame->y;
    bool has_left = false;
    for (size_t i = 0; i + 1 < plot_series_count(plot, series); i++) {
        const double here = plot_y_at(plot, series, i), next = plot_y_at(plot, series, i + 1);
        const bool leaves = is_on_axis(axis, here) && !is_on_axis(axis, next) && !isnan(next);
        const bool returns = is_on_axis(axis, next) && !is_on_axis(axis, here) && !isnan(here);
        if (!leaves && !returns) {
            continue;
        }
        const size_t inside = leaves ? i : i + 1, outside = leaves ? i + 1 : i;
        const double in = leaves ? here : next, out = leaves ? next : here;
        const bool up = out > axis->high;
        size_t asymptote = inside;
        const char *text = arrow_words(plot, axis, series, outside, leaves, svg->arena, &asymptote);
        const bool is_infinite = text != NULL && strstr(text, "∞") != NULL;
        double x = plot_page_at(&frame->x, plot_x_at(plot, series, asymptote));
        if (!is_infinite && returns && has_left) {
            continue; /* said where it left */
        }
        has_left = has_left || leaves;
        if (!is_infinite) {
            x = plot_page_at(&frame->x, plot_x_at(plot, series, inside));
            const double at = plot_page_at(axis, in), edge = up ? axis->stop : axis->start;
            const double then = plot_page_at(&frame->x, plot_x_at(plot, series, outside));
            x += (edge - at) / (plot_page_at(axis, out) - at) * (then - x);
        }
        if (text != NULL) {
            draw_arrow(svg, frame, x, up, leaves, text);
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
        const bool is_seen = v >= frame->y.low && v <= frame->y.high;
        if (is_seen && plot_place_at(series, i) == PLOT_SAMPLE) {
            svg_circle(svg, plot_page_at(&frame->x, plot_x_at(plot, series, i)),
                       plot_page_at(&frame->y, v), 3.2);
        }
    }
}

static void plot_clip_begin(struct svg *svg, const struct plot_frame *frame)
{
    const struct plot_axis *x = &frame->x, *y = &frame->y;
    svg_clip_begin(svg, x->start, y->stop - 1, x->stop - x->start + 1, y->start - y->stop + 2);
}

/* What the bands fill, below grid and curves: the widest first, so that all are seen. */
static void plot_draw_bands(struct svg *svg, const struct plot *plot, struct plot_frame *frame)
{
    bool *done = ARENA_ARRAY(svg->arena, plot->band_count, bool);
    plot_clip_begin(svg, frame);
    for (size_t n = 0; n < plot->band_count; n++) {
        size_t widest = 0;
        double most = -1;
        for (size_t b = 0; b < plot->band_count; b++) {
            const double area = done[b] ? -1 : band_area(plot, frame, &plot->bands[b]);
            widest = area > most ? b : widest;
            most = fmax(most, area);
        }
        done[widest] = true;
        const char *colour = palette_colour(plot->series[plot->bands[widest].low].style);
        svg_group_begin(svg, &(struct svg_style){.fill = plot_tint(svg->arena, colour)});
        draw_band(svg, plot, frame, &plot->bands[widest]);
        svg_group_end(svg);
    }
    svg_group_end(svg);
}

static void plot_draw_curves(struct svg *svg, const struct plot *plot, struct plot_frame *frame)
{
    plot_clip_begin(svg, frame);
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

/* -------- the page -------- */

bool plot_draw(const struct plot *plot, struct svg *svg, struct error *error)
{
    struct plot_frame frame = {.x = {.log = plot->log_x, .kind = plot->x_kind},
                               .y = {.log = plot->log_y, .kind = plot->y_kind}};
    if (!plot_find_range(plot, &frame.x, &frame.y)) {
        return fail(error, ERROR_DOMAIN, "nothing to plot: no value is finite%s",
                    plot->log_x || plot->log_y ? " and positive" : "");
    }
    plot_set_x_axis(&frame.x);
    plot_axis_to_ticks(&frame.y);
    /* Place the frame so that all words fit around it. */
    const double width = plot_keys_width(plot);
    frame.x.start = 44 + ticks_width(svg->arena, &frame.y.ticks, NUMBER_SIZE);
    frame.x.stop = PLOT_WIDTH - (width > 0 ? fmin(width, 260) : 28);
    frame.y.start = PLOT_HEIGHT - 60;
    frame.y.stop = 88;
    svg_begin(svg, PLOT_WIDTH, PLOT_HEIGHT, plot->title);
    plot_draw_bands(svg, plot, &frame);
    plot_draw_grid(svg, plot, &frame);
    plot_draw_curves(svg, plot, &frame);
    plot_draw_axes(svg, plot, &frame);
    plot_draw_words(svg, plot, &frame);
    plot_keys_draw(svg, plot, &frame.x, &frame.y);
    svg_end(svg);
    return true;
}
