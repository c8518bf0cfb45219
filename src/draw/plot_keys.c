/* draw/plot_keys.c - what the curves of a plot are called, at their ends. */
/* SPDX-License-Identifier: MIT */
#include "draw/plot_keys.h"

#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "draw/palette.h"

static const double SIZE = 12, GAP = 17; /* px */
static const double LINE = 28, BESIDE = 12, BEHIND = 18;

/* For round line ends, which lengthen each by the line's width, and for black-and-white print. */
static const char *const dashes[] = {NULL,        "7 5",      "0.1 4.5",
                                     "9 5 0.1 5", "13 5 3 5", "8 5 0.1 4 0.1 5"};

struct svg_style plot_line_of(const struct plot_series *series)
{
    const size_t dash = series->dash > 0 ? series->dash - 1 : series->style;
    return (struct svg_style){.stroke = palette_colour(series->style),
                              .dash = dashes[dash % (sizeof dashes / sizeof dashes[0])],
                              .width = 2};
}

struct plot_key {
    const struct plot_series *series;
    double y; /* px */
};

/* Do two curves have one label? */
static bool is_labelled_so(const struct plot_series *series, const char *label)
{
    return series->label != NULL && strcmp(series->label, label) == 0;
}

/* Of the curves before this one, how many have its label. */
static size_t plot_label_turn(const struct plot *plot, size_t s)
{
    size_t turn = 0;
    for (size_t i = 0; i < s; i++) {
        turn += is_labelled_so(&plot->series[i], plot->series[s].label);
    }
    return turn;
}

/* How many labels there are. */
static size_t plot_label_count(const struct plot *plot)
{
    size_t count = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        count += plot->series[s].label != NULL && plot_label_turn(plot, s) == 0;
    }
    return count;
}

double plot_keys_width(const struct plot *plot)
{
    double width = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        if (plot->series[s].label != NULL) {
            width = fmax(width, svg_text_width(plot->series[s].label, SIZE));
        }
    }
    const bool alone = plot->series_count == 1 || plot_label_count(plot) == 0;
    return alone ? 0 : BESIDE + LINE + 8 + width + BEHIND;
}

/* Where a curve ends on the page. */
static double plot_end_of(const struct plot *plot, const struct plot_axis *axis,
                          const struct plot_series *series)
{
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

/* The curves that have their label for the nth time, in the order of the series. */
static size_t plot_keys_collect(const struct plot *plot, const struct plot_axis *y, size_t turn,
                                struct plot_key *keys)
{
    size_t count = 0;
    for (size_t s = 0; s < plot->series_count; s++) {
        const struct plot_series *series = &plot->series[s];
        if (series->label != NULL && plot_label_turn(plot, s) == turn) {
            keys[count++] = (struct plot_key){series, plot_end_of(plot, y, series)};
        }
    }
    return count;
}

/* The least distance between two of them. */
static double plot_keys_apart(const struct plot_key *keys, size_t count)
{
    double apart = INFINITY;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < i; k++) {
            apart = fmin(apart, fabs(keys[i].y - keys[k].y));
        }
    }
    return apart;
}

/* One below the other in the order of the series, about where their curves end. */
static void plot_keys_list(struct plot_key *keys, size_t count, const struct plot_axis *y)
{
    double falls = 0, middle = 0;
    for (size_t i = 0; i < count; i++) {
        falls += (double)i * keys[i].y - (double)(count - 1) / 2 * keys[i].y;
        middle += keys[i].y / (double)count;
    }
    const double gap = fmin(GAP, (y->start - y->stop) / (double)count);
    const double half = gap * (double)(count - 1) / 2;
    middle = fmin(fmax(middle, y->stop + half), y->start - half);
    for (size_t i = 0; i < count; i++) {
        const double place = (double)i * gap - half;
        keys[i].y = middle + (falls < 0 ? -place : place);
    }
}

/* From top to bottom as the curves end, moved apart: down from the top, then up again. */
static void plot_keys_part(struct plot_key *keys, size_t count, const struct plot_axis *y)
{
    const double gap = fmin(GAP, (y->start - y->stop) / (double)(count + 1));
    for (size_t i = 1; i < count; i++) {
        const struct plot_key key = keys[i];
        size_t at = i;
        for (; at > 0 && keys[at - 1].y > key.y; at--) {
            keys[at] = keys[at - 1];
        }
        keys[at] = key;
    }
    double next = y->stop;
    for (size_t i = 0; i < count; i++) {
        keys[i].y = fmax(keys[i].y, next);
        next = keys[i].y + gap;
    }
    next = y->start;
    for (size_t i = count; i-- > 0;) {
        keys[i].y = fmin(keys[i].y, next);
        next = keys[i].y - gap;
    }
}

void plot_keys_draw(struct svg *svg, const struct plot *plot, const struct plot_axis *x,
                    const struct plot_axis *y)
{
    const size_t count = plot_label_count(plot);
    struct plot_key *keys = ARENA_ARRAY(svg->arena, plot->series_count, struct plot_key);
    if (count == 0 || plot->series_count == 1) {
        return;
    }
    size_t best = 0, found = count;
    double most = -1;
    for (size_t turn = 0; found == count; turn++) {
        found = plot_keys_collect(plot, y, turn, keys);
        const double apart = found == count ? plot_keys_apart(keys, count) : -1;
        best = apart > most ? turn : best;
        most = fmax(most, apart);
    }
    plot_keys_collect(plot, y, best, keys);
    if (most < GAP - 2 && plot->is_ordered) {
        plot_keys_list(keys, count, y);
    } else {
        plot_keys_part(keys, count, y);
    }
    const double size = fmin(SIZE, (y->start - y->stop) / (double)(count + 1));
    const double left = x->stop + BESIDE;
    for (size_t i = 0; i < count; i++) {
        const struct svg_style style = plot_line_of(keys[i].series);
        svg_styled_line(svg, &style, left, keys[i].y, left + LINE, keys[i].y);
        svg_words_within(svg, left + LINE + 8, keys[i].y + 4, size, PLOT_WIDTH - left - LINE - 14,
                         NULL, keys[i].series->label);
    }
}
