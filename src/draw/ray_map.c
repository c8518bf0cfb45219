/* draw/ray_map.c - a map of errors over field and pupil, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/ray_map.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"

#include <math.h>

enum { MOST_COLUMNS = 12, MOST_ROWS = 8, SHADES = 3, BAR_STEPS = 60 };

static const double LEFT = 78, TOP = 96, CELL = 190, RADIUS = 78, BOTTOM = 84; /* px */
static const double ARROW = 0.25; /* longest arrow, in radii of the pupil */

/* From nothing to the largest error: ever darker, in grey too. */
static const unsigned char shades[SHADES][3] = {{158, 202, 225}, {253, 141, 60}, {140, 10, 20}};

struct map_drawing {
    struct svg *svg;
    double largest;
};

static const char *shade_of(const struct map_drawing *drawing, double share)
{
    double place = fmin(fmax(share, 0), 1) * (SHADES - 1);
    size_t low = (size_t)fmin(floor(place), SHADES - 2);
    double rest = place - (double)low;
    int colour[3];
    for (int i = 0; i < 3; i++) {
        colour[i] = (int)lround(shades[low][i] + rest * (shades[low + 1][i] - shades[low][i]));
    }
    return arena_printf(drawing->svg->arena, "#%02x%02x%02x", (unsigned)colour[0],
                        (unsigned)colour[1], (unsigned)colour[2]);
}

static double centre_x(size_t column)
{
    return LEFT + CELL * ((double)column + 0.5);
}

static double centre_y(size_t row)
{
    return TOP + CELL * ((double)row + 0.5);
}

static void draw_ray(const struct map_drawing *drawing, const struct ray_map_point *point)
{
    struct svg *svg = drawing->svg;
    double x = centre_x(point->column) + RADIUS * point->x;
    double y = centre_y(point->row) - RADIUS * point->y;
    double off = hypot(point->dx, point->dy);
    if (!isfinite(off)) {
        svg_group_begin(svg, &(struct svg_style){.stroke = "#888888"});
        svg_line(svg, x - 2, y - 2, x + 2, y + 2);
        svg_line(svg, x - 2, y + 2, x + 2, y - 2);
        svg_group_end(svg);
        return;
    }
    double share = drawing->largest > 0 ? off / drawing->largest : 0;
    double scale = drawing->largest > 0 ? ARROW * RADIUS / drawing->largest : 0;
    const char *colour = shade_of(drawing, share);
    svg_group_begin(svg, &(struct svg_style){.stroke = colour, .fill = colour, .width = 1.4});
    svg_circle(svg, x, y, 2.2);
    svg_line(svg, x, y, x + scale * point->dx, y - scale * point->dy);
    svg_group_end(svg);
}

static bool ray_map_check_map(const struct ray_map *map, double *largest, struct error *error)
{
    size_t count = 0;
    *largest = 0;
    for (size_t i = 0; i < map->count; i++) {
        double off = hypot(map->points[i].dx, map->points[i].dy);
        count += isfinite(off) ? 1 : 0;
        *largest = isfinite(off) ? fmax(*largest, off) : *largest;
    }
    if (count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no ray to draw");
    }
    if (map->column_count > MOST_COLUMNS || map->row_count > MOST_ROWS) {
        return fail(error, ERROR_DOMAIN,
                    "a map has room for %d fields and %d wavelengths, not for %zu and %zu: choose "
                    "with {field} and {wavelength}",
                    MOST_COLUMNS, MOST_ROWS, map->column_count, map->row_count);
    }
    return true;
}

bool ray_map_draw(const struct ray_map *map, struct svg *svg, struct error *error)
{
    struct map_drawing drawing = {.svg = svg};
    if (!ray_map_check_map(map, &drawing.largest, error)) {
        return false;
    }
    double width = fmax(LEFT + CELL * (double)map->column_count + 30, 620);
    double bottom = TOP + CELL * (double)map->row_count;
    svg_begin(svg, width, bottom + BOTTOM, map->title);
    svg_heading(svg, 24, 32, 17, width - 48, map->title);
    svg_subheading(svg, 24, 54, 12, width - 48, map->subtitle);
    /* the pupils, each field a column or row, and what stands beside them */
    const struct svg_style rim = {.stroke = "#bbbbbb"};
    for (size_t row = 0; row < map->row_count; row++) {
        svg_words_upwards(svg, LEFT - 34, centre_y(row), 13, map->rows[row]);
        for (size_t column = 0; column < map->column_count; column++) {
            bool found = false;
            for (size_t i = 0; i < map->count && !found; i++) {
                found = map->points[i].column == column && map->points[i].row == row &&
                        isfinite(map->points[i].dx);
            }
            svg_styled_circle(svg, &rim, centre_x(column), centre_y(row), RADIUS);
            if (!found) {
                svg_words(svg, centre_x(column), centre_y(row) + RADIUS + 14, 11, SVG_MIDDLE, NULL,
                          "no ray comes through");
            }
        }
    }
    for (size_t column = 0; column < map->column_count; column++) {
        svg_words(svg, centre_x(column), TOP - 8, 13, SVG_MIDDLE, NULL, map->columns[column]);
    }
    for (size_t i = 0; i < map->count; i++) {
        draw_ray(&drawing, &map->points[i]);
    }
    /* Colours from 0 to the largest error, and the longest arrow. */
    double y = bottom + 38;
    double bar = fmin(260, CELL * (double)map->column_count - 20), left = LEFT + 10;
    struct arena *arena = svg->arena;
    for (int i = 0; i < BAR_STEPS; i++) {
        svg_styled_rect(svg, &(struct svg_style){.fill = shade_of(&drawing, (i + 0.5) / BAR_STEPS)},
                        left + bar * i / BAR_STEPS, y, bar / BAR_STEPS + 0.5, 12);
    }
    for (int i = 0; i <= 2; i++) {
        svg_words(svg, left + bar * i / 2, y + 28, 12, SVG_MIDDLE, NULL,
                  arena_printf(arena, "%.3g%s%s", drawing.largest * i / 2, i == 2 ? " " : "",
                               i == 2 ? map->unit : ""));
    }
    svg_words(svg, left, y - 8, 12, SVG_START, NULL,
              "error in the image, colour and arrow; the circle is the stop, crosses are lost");
    svg_end(svg);
    return true;
}
