/* draw/grid_image.c - a square grid as a lens images it. */
/* SPDX-License-Identifier: MIT */
#include "draw/grid_image.h"

#include "base/arena.h"
#include "base/error.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

static const double LEFT = 76, TOP = 104, SIDE = 520, RIGHT = 28, BOTTOM = 92; /* px */
static const double TICK = 5, MARGIN = 1.04;

/* The page: a square of the image, its centre on the axis. */
struct grid_image_page {
    const struct grid_image *grid;
    struct svg *svg;
    double reach; /* of the axes from the centre, mm */
};

static double page_x(const struct grid_image_page *page, double x)
{
    return LEFT + SIDE / 2 * (1 + x / page->reach);
}

static double page_y(const struct grid_image_page *page, double y)
{
    return TOP + SIDE / 2 * (1 - y / page->reach);
}

static void grid_image_draw_axes(const struct grid_image_page *page)
{
    struct ticks ticks;
    struct svg *svg = page->svg;
    ticks_linear(-page->reach, page->reach, &ticks);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#444444"});
    svg_rect(svg, LEFT, TOP, SIDE, SIDE);
    for (size_t i = 0; i < ticks.count; i++) {
        if (fabs(ticks.value[i]) <= page->reach) {
            const double x = page_x(page, ticks.value[i]), y = page_y(page, ticks.value[i]);
            svg_line(svg, x, TOP + SIDE, x, TOP + SIDE + TICK);
            svg_line(svg, LEFT, y, LEFT - TICK, y);
        }
    }
    svg_group_end(svg);
    for (size_t i = 0; i < ticks.count; i++) {
        if (fabs(ticks.value[i]) <= page->reach) {
            const char *text = ticks_text(svg->arena, &ticks, i);
            svg_words(page->svg, page_x(page, ticks.value[i]), TOP + SIDE + 20, 12, SVG_MIDDLE,
                      NULL, text);
            svg_words(page->svg, LEFT - 9, page_y(page, ticks.value[i]) + 4, 12, SVG_END, NULL,
                      text);
        }
    }
    svg_words(page->svg, LEFT + SIDE / 2, TOP + SIDE + 40, 13, SVG_MIDDLE, NULL,
              "x in the image (mm)");
    svg_words_upwards(svg, 22, TOP + SIDE / 2, 13, "y in the image (mm)");
}

static const struct svg_style ideal_style = {.stroke = "#777777", .dash = "5 4", .width = 1};
static const struct svg_style image_style = {.stroke = "#0060a0", .width = 1.6};

bool grid_image_draw(const struct grid_image *grid, struct svg *svg, struct error *error)
{
    struct grid_image_page page = {.grid = grid, .svg = svg};
    const size_t count = 2 * grid->lines * grid->points;
    bool any = false;
    page.reach = grid->half;
    for (size_t i = 0; i < count; i++) {
        const double far = fmax(fabs(grid->x[i]), fabs(grid->y[i]));
        if (isfinite(far)) {
            page.reach = fmax(page.reach, far);
            any = true;
        }
    }
    page.reach *= MARGIN;
    if (!any) {
        return fail(error, ERROR_DOMAIN,
                    "no point of the grid is imaged: there is nothing to draw");
    }
    const double width = LEFT + SIDE + RIGHT, room = width - 48;
    double *x = ARENA_ARRAY(svg->arena, grid->points, double);
    double *y = ARENA_ARRAY(svg->arena, grid->points, double);
    svg_begin(svg, width, TOP + SIDE + BOTTOM, grid->title);
    svg_heading(svg, 24, 32, 16, 0.93 * room, grid->title);
    svg_subheading(svg, 24, 54, 12, room, grid->subtitle);
    svg_words_within(svg, 24, 72, 12, room, NULL, grid->note);
    grid_image_draw_axes(&page);
    /* the ideal grid, its image, and the legend below */
    svg_group_begin(svg, &ideal_style);
    for (size_t k = 0; k < grid->lines; k++) {
        const double at =
            grid->half * (2 * (double)k / (double)(grid->lines > 1 ? grid->lines - 1 : 1) - 1);
        const double low = page_x(&page, -grid->half), high = page_x(&page, grid->half);
        svg_line(svg, low, page_y(&page, at), high, page_y(&page, at));
        svg_line(svg, page_x(&page, at), page_y(&page, -grid->half), page_x(&page, at),
                 page_y(&page, grid->half));
    }
    svg_group_end(svg);
    svg_clip_begin(svg, LEFT, TOP, SIDE, SIDE);
    svg_group_begin(svg, &image_style);
    for (size_t k = 0; k < 2 * grid->lines; k++) {
        for (size_t i = 0; i < grid->points; i++) {
            x[i] = page_x(&page, grid->x[k * grid->points + i]);
            y[i] = page_y(&page, grid->y[k * grid->points + i]);
        }
        svg_polyline(svg, x, y, grid->points);
    }
    svg_group_end(svg);
    svg_group_end(svg);
    const double below = TOP + SIDE + 66, middle = LEFT + SIDE / 2;
    svg_styled_line(svg, &image_style, LEFT, below - 4, LEFT + 34, below - 4);
    svg_words(svg, LEFT + 42, below, 12, SVG_START, NULL, grid->image_label);
    svg_styled_line(svg, &ideal_style, middle, below - 4, middle + 34, below - 4);
    svg_words(svg, middle + 42, below, 12, SVG_START, NULL, grid->ideal_label);
    svg_end(svg);
    return true;
}
