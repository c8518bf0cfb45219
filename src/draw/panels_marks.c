/* draw/panels_marks.c - colours, dashes and shapes of the curves and spots of panels. */
/* SPDX-License-Identifier: MIT */
#include "draw/panels_marks.h"

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
    if (count > COUNT(chosen)) {
        return spectrum[key % COUNT(spectrum)];
    }
    return spectrum[chosen[count - 1][key] - '0'];
}

/* Corners of the shapes of spots, in their radius; the first is a dot. */
static const struct {
    size_t count;
    double x[4], y[4];
} shapes[] = {
    {0, {0}, {0}},
    {3, {0, 1.1, -1.1}, {-1.2, 0.8, 0.8}},
    {4, {-0.9, 0.9, 0.9, -0.9}, {-0.9, -0.9, 0.9, 0.9}},
    {4, {0, 1.25, 0, -1.25}, {-1.25, 0, 1.25, 0}},
    {3, {0, 1.1, -1.1}, {1.2, -0.8, -0.8}},
};

static const double RADIUS = 1.5, LARGE = 3; /* px, of a spot */

static void panels_marks_draw_spots(struct svg *svg, size_t look, const char *colour,
                                    const struct panels_mark *mark)
{
    size_t shape = look % COUNT(shapes), corners = shapes[shape].count;
    size_t each = (corners > 0 ? corners : 1) + 1;
    double *x = ARENA_ARRAY(svg->arena, mark->count * each + 1, double);
    double *y = ARENA_ARRAY(svg->arena, mark->count * each + 1, double);
    double radius = mark->large ? LARGE : RADIUS;
    size_t n = 0;
    for (size_t i = 0; i < mark->count; i++) {
        for (size_t k = 0; k + 1 < each; k++) {
            x[n] = mark->x[i] + radius * shapes[shape].x[k];
            y[n++] = mark->y[i] + radius * shapes[shape].y[k];
        }
        x[n] = y[n] = NAN;
        n++;
    }
    if (corners == 0) {
        svg_group_begin(svg, &(struct svg_style){.stroke = colour, .width = 2 * radius});
        svg_polyline(svg, x, y, n);
    } else {
        svg_group_begin(svg, &(struct svg_style){.fill = colour});
        svg_polygon(svg, x, y, n);
    }
    svg_group_end(svg);
}

void panels_marks_draw(const struct panels *panels, struct svg *svg, const struct panels_mark *mark)
{
    const char *colour = colour_of(panels, mark->key);
    /* The middle wavelength is a solid line; of other keys the first. */
    size_t middle = panels->light ? panels->key_count / 2 : 0;
    size_t look =
        (mark->key + panels->key_count - middle) % (panels->key_count > 0 ? panels->key_count : 1);
    if (mark->spots) {
        panels_marks_draw_spots(svg, look, colour, mark);
        return;
    }
    svg_styled_polyline(
        svg,
        &(struct svg_style){.stroke = colour, .width = 1.6, .dash = dashes[look % COUNT(dashes)]},
        mark->x, mark->y, mark->count);
}
