/* draw/wedge_camera.c - the camera in the drawing of a tilted lens. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"
#include "draw/svg.h"
#include "draw/wedge_view.h"

#include <math.h>

static const char *const BLACK = "#1d1d1d", *const GREY = "#666", *const RED = "#d0370a";

/* A lens seen from the side: two arcs of the given height about the origin. */
static void draw_lens(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    enum { POINTS = 17 };
    double x[2 * POINTS], y[2 * POINTS], half = wedge->lens_diameter / 2;
    double sine = sin(wedge->tilt), cosine = cos(wedge->tilt);
    for (size_t i = 0; i < POINTS; i++) {
        double t = 2.0 * (double)i / (POINTS - 1) - 1, thick = 0.22 * half * (1 - t * t);
        for (size_t side = 0; side < 2; side++) {
            double along = side == 0 ? thick : -thick; /* of the lens axis */
            size_t at = side == 0 ? i : 2 * POINTS - 1 - i;
            x[at] = view_x(view, along * cosine + half * t * sine);
            y[at] = view_y(view, half * t * cosine - along * sine);
        }
    }
    svg_styled_polygon(svg, &(struct svg_style){.fill = "#cfe3f2", .stroke = BLACK, .width = 1.4},
                       x, y, sizeof x / sizeof x[0]);
}

void wedge_draw_camera(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    double v = wedge->image, half = wedge->lens_diameter / 2, sensor = wedge->sensor_height / 2;
    double sine = sin(wedge->tilt), cosine = cos(wedge->tilt), middle = wedge->sensor_centre;
    double x[] = {view_x(view, half * sine), view_x(view, -v), view_x(view, -v),
                  view_x(view, -half * sine)};
    double y[] = {view_y(view, half * cosine), view_y(view, middle + sensor),
                  view_y(view, middle - sensor), view_y(view, -half * cosine)};
    svg_styled_polygon(svg, &(struct svg_style){.fill = "#e9e6e0", .stroke = "#b9b4aa", .width = 1},
                       x, y, 4);
    svg_group_begin(svg, &(struct svg_style){.stroke = BLACK, .width = 3});
    view_line(view, svg, -v, middle - sensor, -v, middle + sensor);
    svg_group_end(svg);
    draw_lens(svg, view, wedge);
}

/* The tilt as an arc between the lens and the direction of the sensor, above the lens. */
static void draw_tilt(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    enum { POINTS = 25 };
    double x[POINTS], y[POINTS];
    /* room for the number beside the arc, whatever the tilt */
    double room =
        fmin(view->y0 - view->top - 16, (view->right - view->x0 - 44) / fabs(sin(wedge->tilt)));
    double radius = room / view->scale;
    for (size_t i = 0; i < POINTS; i++) {
        double turn = wedge->tilt * (double)i / (POINTS - 1);
        x[i] = view_x(view, radius * sin(turn));
        y[i] = view_y(view, radius * cos(turn));
    }
    svg_group_begin(svg, &(struct svg_style){.stroke = GREY, .width = 1, .dash = "6 4"});
    view_line(view, svg, 0, 0, 0, radius * 1.1);
    view_line(view, svg, 0, 0, radius * 1.1 * sin(wedge->tilt), radius * 1.1 * cos(wedge->tilt));
    svg_group_end(svg);
    svg_styled_polyline(svg, &(struct svg_style){.stroke = RED, .width = 1.4}, x, y, POINTS);
    bool left = wedge->tilt < 0;
    svg_words(svg, fmax(x[0], x[POINTS - 1]) + 8, y[left ? 0 : POINTS - 1] + 4, 13, SVG_START, RED,
              wedge_degrees(svg->arena, wedge->tilt));
}

void wedge_draw_close_view(struct svg *svg, struct view *view, const struct wedge *wedge)
{
    double v = wedge->image, half = wedge->lens_diameter / 2;
    double height = fmax(half, fabs(wedge->sensor_centre) + wedge->sensor_height / 2);
    double before = fmax(0.5 * v, half);
    view->scale = fmin((view->right - view->left - 70) / (v + before),
                       (view->bottom - view->top - 72) / (2 * height));
    view->x0 = (view->left + view->right - view->scale * (before - v)) / 2;
    view->y0 = (view->top + view->bottom) / 2 - 8;
    double y = view->bottom - 30, left = view_x(view, -wedge->image), right = view->x0;
    svg_styled_rect(svg, &(struct svg_style){.stroke = "#bbb", .fill = "#fcfcfa"}, view->left,
                    view->top, view->right - view->left, view->bottom - view->top);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#aaa"});
    svg_line(svg, left, view->y0, view->right - 8, view->y0);
    svg_line(svg, left, y - 6, left, y + 6);
    svg_line(svg, right, y - 6, right, y + 6);
    svg_line(svg, left, y, right, y);
    svg_group_end(svg);
    wedge_draw_camera(svg, view, wedge);
    draw_tilt(svg, view, wedge);
    svg_words(svg, (left + right) / 2, y + 20, 13, SVG_MIDDLE, NULL,
              arena_printf(svg->arena, "v' = %s mm", wedge_digits(svg->arena, wedge->image)));
}
