/* draw/panels_cell.c - one of many small plots: its axes, curves and words. */
/* SPDX-License-Identifier: MIT */
#include "draw/panels_cell.h"

#include "base/arena.h"
#include "draw/palette.h"
#include "draw/panels.h"
#include "draw/svg.h"

#include <math.h>

/* For round line ends, which lengthen each dash by the line's width. */
static const char *const dashes[] = {NULL, "5 4", "0.1 3.2", "8 4 0.1 4", "10 4 3 4"};

/* The palette in the order of the spectrum, with a violet and a deep red. */
static const char *const spectrum[] = {"#6a3d9a", "#0072b2", "#56b4e9", "#009e73",
                                       "#e69f00", "#d55e00", "#800020"};
#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Which of the spectrum's colours so many wavelengths take, the shortest first. */
static const char *const chosen[] = {"1", "15", "135", "1345", "12345", "012345", "0123456"};

static const char *colour_of(const struct panels *panels, size_t key)
{
    size_t count = panels->key_count;
    if (!panels->light || count == 0) {
        return palette_colour(key);
    }
    return count > COUNT(chosen) ? spectrum[key % COUNT(spectrum)]
                                 : spectrum[chosen[count - 1][key] - '0'];
}

/* Of spots: px, and so many that they touch are smaller. */
static const double RADIUS = 1.5, SMALLEST = 0.7, LARGEST = 2.6, LARGE = 3, FEW = 300;

static double spot_radius(size_t count)
{
    const double radius = RADIUS * sqrt(FEW / (double)(count > 0 ? count : 1));
    return fmin(fmax(radius, SMALLEST), LARGEST);
}

/* Every so many of the points of a mark, from one on. */
static void panels_marks_draw_spots(struct svg *svg, const char *colour,
                                    const struct panels_mark *mark, double radius, size_t from,
                                    size_t step)
{
    double *x = ARENA_ARRAY(svg->arena, 2 * (mark->count / step + 1), double);
    double *y = ARENA_ARRAY(svg->arena, 2 * (mark->count / step + 1), double);
    size_t n = 0;
    for (size_t i = from; i < mark->count; i += step) {
        x[n] = mark->x[i];
        y[n++] = mark->y[i];
        x[n] = y[n] = NAN;
        n++;
    }
    svg_styled_polyline(svg, &(struct svg_style){.stroke = colour, .width = 2 * radius}, x, y, n);
}

void panels_marks_draw(const struct panels *panels, struct svg *svg, const struct panels_mark *mark)
{
    const char *colour = colour_of(panels, mark->key);
    /* The middle wavelength is a solid line; of other keys the first. */
    size_t middle = panels->light ? panels->key_count / 2 : 0;
    size_t look =
        (mark->key + panels->key_count - middle) % (panels->key_count > 0 ? panels->key_count : 1);
    if (mark->spots) {
        panels_marks_draw_spots(svg, colour, mark, LARGE, 0, 1);
        return;
    }
    svg_styled_polyline(
        svg,
        &(struct svg_style){.stroke = colour, .width = 1.6, .dash = dashes[look % COUNT(dashes)]},
        mark->x, mark->y, mark->count);
}

static const double WORDS = 13, NOTE = 11; /* px */

static const char *const DARK = "#1d1d1d", *const SOFT = "#444", *const GREY = "#888";

static double panels_cell_part_of(const struct panels_scale *scale, double v)
{
    return (v - scale->low) / (scale->high - scale->low);
}

static double at_x(const struct panels_cell *cell, double v)
{
    return cell->left + cell->width * panels_cell_part_of(&cell->x, v);
}

static double at_y(const struct panels_cell *cell, double v)
{
    return cell->top + cell->height * (1 - panels_cell_part_of(&cell->y, v));
}

/* Every how many ticks one has room, if each needs so many px. */
static double stride_of(const struct panels_scale *scale, double length, double room)
{
    static const double strides[] = {1, 2, 5, 10};
    double apart = length * scale->ticks.step / (scale->high - scale->low);
    size_t i = 0;
    while (i < 3 && apart * strides[i] < room) {
        i++;
    }
    return strides[i];
}

static bool panels_cell_is_marked(const struct panels_scale *scale, size_t i, double stride)
{
    double v = scale->ticks.value[i], slack = 1e-9 * (scale->high - scale->low);
    double steps = round(v / scale->ticks.step);
    bool inside = v >= scale->low - slack && v <= scale->high + slack;
    return inside && fabs(remainder(steps, stride)) < 0.5;
}

static void draw_x_ticks(struct svg *svg, const struct panels_cell *cell, bool lines)
{
    double stride = stride_of(&cell->x, cell->width,
                              ticks_width(svg->arena, &cell->x.ticks, PANELS_NUMBER_SIZE) + 8);
    double bottom = cell->top + cell->height;
    for (size_t i = 0; i < cell->x.ticks.count; i++) {
        if (!panels_cell_is_marked(&cell->x, i, stride)) {
            continue;
        }
        double x = at_x(cell, cell->x.ticks.value[i]);
        if (lines) {
            svg_line(svg, x, cell->top, x, bottom);
        }
        if (cell->x_numbers) {
            svg_words(svg, x, bottom + 14, PANELS_NUMBER_SIZE, SVG_MIDDLE, NULL,
                      ticks_text(svg->arena, &cell->x.ticks, i));
        }
    }
}

static void draw_y_ticks(struct svg *svg, const struct panels_cell *cell, bool lines)
{
    double stride = stride_of(&cell->y, cell->height, 16);
    for (size_t i = 0; i < cell->y.ticks.count; i++) {
        if (!panels_cell_is_marked(&cell->y, i, stride)) {
            continue;
        }
        double y = at_y(cell, cell->y.ticks.value[i]);
        if (lines) {
            svg_line(svg, cell->left, y, cell->left + cell->width, y);
        }
        if (cell->y_numbers) {
            svg_words(svg, cell->left - 6, y + 4, PANELS_NUMBER_SIZE, SVG_END, NULL,
                      ticks_text(svg->arena, &cell->y.ticks, i));
        }
    }
}

static bool holds_zero(const struct panels_scale *scale)
{
    return scale->low <= 0 && scale->high >= 0;
}

/* The points of a series on the page. */
static struct panels_mark panels_cell_mark(struct arena *arena, const struct panels_cell *cell,
                                           const struct panel_series *series)
{
    double *x = ARENA_ARRAY(arena, series->count + 1, double);
    double *y = ARENA_ARRAY(arena, series->count + 1, double);
    for (size_t i = 0; i < series->count; i++) {
        x[i] = at_x(cell, series->x[i]);
        y[i] = at_y(cell, series->y[i]);
    }
    return (struct panels_mark){
        .x = x, .y = y, .count = series->count, .key = series->key, .spots = series->spots};
}

/* Spots of all series, a slice of each in turn: where they overlap the colours mix. */
static void draw_spots(const struct panels *panels, struct svg *svg, const struct panels_cell *cell,
                       const struct panel *panel)
{
    struct panels_mark *marks = ARENA_ARRAY(svg->arena, panel->count + 1, struct panels_mark);
    size_t all = 0, count = 0;
    for (size_t s = 0; s < panel->count; s++) {
        if (panel->series[s].spots) {
            marks[count] = panels_cell_mark(svg->arena, cell, &panel->series[s]);
            all += marks[count++].count;
        }
    }
    enum { SLICES = 24 };
    const size_t slices = count > 1 ? SLICES : 1;
    for (size_t slice = 0; slice < slices; slice++) {
        for (size_t s = 0; s < count; s++) {
            /* none is always the last */
            const struct panels_mark *mark = &marks[(s + slice) % count];
            panels_marks_draw_spots(svg, colour_of(panels, mark->key), mark, spot_radius(all),
                                    slice, slices);
        }
    }
}

/* The curves and spots. */
static void draw_series(const struct panels *panels, struct svg *svg,
                        const struct panels_cell *cell, const struct panel *panel)
{
    svg_clip_begin(svg, cell->left - 1, cell->top - 1, cell->width + 2, cell->height + 2);
    for (size_t s = 0; s < panel->count; s++) {
        if (!panel->series[s].spots) {
            const struct panels_mark mark = panels_cell_mark(svg->arena, cell, &panel->series[s]);
            panels_marks_draw(panels, svg, &mark);
        }
    }
    draw_spots(panels, svg, cell, panel);
    if (panel->circle > 0) {
        svg_styled_circle(svg, &(struct svg_style){.stroke = SOFT, .width = 1, .dash = "3 3"},
                          at_x(cell, 0), at_y(cell, 0), at_x(cell, panel->circle) - at_x(cell, 0));
    }
    svg_group_end(svg);
}

/* ", 2 % outside": of the points those that the panel does not show; null: none. */
static const char *points_outside(struct arena *arena, const struct panels_cell *cell,
                                  const struct panel *panel)
{
    size_t all = 0, out = 0;
    for (size_t s = 0; s < panel->count; s++) {
        const struct panel_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count; i++) {
            const bool is_there = isfinite(series->x[i] + series->y[i]);
            const double far = fmax(fabs(series->x[i]), fabs(series->y[i]));
            all += is_there ? 1 : 0;
            out += is_there && far > cell->x.high ? 1 : 0;
        }
    }
    return out > 0 ? arena_printf(arena, ", %.2g %% outside", 100 * (double)out / (double)all)
                   : NULL;
}

/* Below spots; inside at the top of curves, or in the middle of what is empty. */
static void panels_cell_draw_note(const struct panels *panels, struct svg *svg,
                                  const struct panels_cell *cell, const struct panel *panel,
                                  bool any)
{
    const bool spots = panels->unit != NULL;
    const char *outside = spots ? points_outside(svg->arena, cell, panel) : NULL;
    double y = spots ? cell->top + cell->height + 14 : cell->top + 14;
    if (!any) {
        y = cell->top + cell->height / 2 + 4;
    }
    struct svg_label note = {.x = cell->left + cell->width / 2,
                             .y = y,
                             .size = NOTE,
                             .width = cell->room,
                             .anchor = SVG_MIDDLE,
                             .colour = SOFT};
    svg_text(svg, &note,
             outside != NULL && panel->note != NULL ? ARENA_JOIN(svg->arena, panel->note, outside)
                                                    : panel->note);
}

void panels_cell_draw(const struct panels *panels, struct svg *svg, const struct panels_cell *cell,
                      const struct panel *panel)
{
    /* Can one point at least be seen? */
    bool any = false;
    for (size_t s = 0; s < panel->count; s++) {
        const struct panel_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count && !any; i++) {
            any = isfinite(at_x(cell, series->x[i])) && isfinite(at_y(cell, series->y[i]));
        }
    }
    /* lines of the ticks and of zero; none go through the words in a panel without points */
    bool ticks = panels->unit == NULL;
    if (ticks) {
        svg_group_begin(svg, &(struct svg_style){.stroke = "#e6e6e6", .width = 1});
        draw_x_ticks(svg, cell, any);
        draw_y_ticks(svg, cell, any);
        svg_group_end(svg);
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = ticks ? "#999" : "#ddd", .width = 1});
    if (any && holds_zero(&cell->x)) {
        svg_line(svg, at_x(cell, 0), cell->top, at_x(cell, 0), cell->top + cell->height);
    }
    if (any && holds_zero(&cell->y)) {
        svg_line(svg, cell->left, at_y(cell, 0), cell->left + cell->width, at_y(cell, 0));
    }
    svg_group_end(svg);
    svg_styled_rect(svg, &(struct svg_style){.stroke = GREY, .width = 1}, cell->left, cell->top,
                    cell->width, cell->height);
    if (any) {
        draw_series(panels, svg, cell, panel);
    }
    panels_cell_draw_note(panels, svg, cell, panel, any);
    struct svg_label title = {.x = cell->left + cell->width / 2,
                              .y = cell->top - 7,
                              .size = WORDS,
                              .width = cell->room,
                              .anchor = SVG_MIDDLE,
                              .colour = DARK};
    svg_text(svg, &title, panel->title);
    if (panels->own_x && ticks) {
        title.y = cell->top + cell->height + 32;
        svg_text(svg, &title, panel->x_label);
    }
    if (panels->own_y && ticks) {
        svg_text(svg,
                 &(struct svg_label){.x = cell->left - PANELS_NUMBERS - 6,
                                     .y = cell->top + cell->height / 2,
                                     .size = WORDS,
                                     .rotation = -90,
                                     .width = cell->height + 20,
                                     .anchor = SVG_MIDDLE},
                 panel->y_label);
    }
}
