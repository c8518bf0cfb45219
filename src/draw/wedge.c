/* draw/wedge.c - side view of a tilted lens and its wedge of sharpness, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/wedge.h"

#include "base/arena.h"
#include "base/constants.h"
#include "base/error.h"
#include "base/number.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Where things lie on the page, px. */
static const double MARGIN = 24, CAMERA_RIGHT = 294, CAMERA_TOP = 84, CAMERA_BOTTOM = 324;
static const double SCENE_LEFT = 372, SCENE_RIGHT = 976, SCENE_TOP = 84, SCENE_BOTTOM = 552;
static const double NAME_GAP = 34; /* between lines, for a name */
static const double NAMES = 124;   /* room for names left of the sensor */
static const double LEGEND = 356;  /* its first line */

static const char *const BLUE = "#0060a0", *const ORANGE = "#c25e00", *const RED = "#d0370a";
static const char *const GREY = "#666", *const BLACK = "#1d1d1d", *const TINT = "#56b4e9";

/* Millimetres to px: x = x0 + scale u, y = y0 - scale height. */
struct view {
    double x0, y0, scale;
    double left, right, top, bottom; /* px, the frame */
};

/* A convex area, mm. */
#define AREA_CORNERS 12

struct area {
    double u[AREA_CORNERS], y[AREA_CORNERS];
    size_t count;
};

/* A stretch of a line, mm, from left to right. */
struct stretch {
    double u[2], y[2];
    bool shown; /* false: none of it is in the view */
};

static double view_x(const struct view *view, double u)
{
    return view->x0 + view->scale * u;
}

static double view_y(const struct view *view, double y)
{
    return view->y0 - view->scale * y;
}

static bool view_holds(const struct view *view, double u, double y)
{
    double x = view_x(view, u), down = view_y(view, y);
    return x >= view->left && x <= view->right && down >= view->top && down <= view->bottom;
}

/* A line between two points given in mm. */
static void view_line(const struct view *view, struct svg *svg, double u1, double y1, double u2,
                      double y2)
{
    svg_line(svg, view_x(view, u1), view_y(view, y1), view_x(view, u2), view_y(view, y2));
}

/* Where a plane A u - B y = f is met straight ahead, mm; inf if it is not, in front of the lens. */
static double wedge_ahead(const struct wedge *wedge, double A)
{
    return A > 0 ? wedge->f / A : (double)INFINITY;
}

static double choose_depth(const struct wedge *wedge)
{
    double sharp = wedge_ahead(wedge, wedge->A), near = wedge_ahead(wedge, wedge->A_near);
    double hinge = fabs(wedge->hinge), depth = 10 * wedge->f;
    if (wedge->depth > 0) {
        return wedge->depth;
    }
    if (isfinite(sharp)) {
        depth = 1.25 * fmin(wedge_ahead(wedge, wedge->A_far), 2 * sharp);
    } else if (isfinite(near)) {
        depth = 1.3 * near;
    } else if (isfinite(hinge)) {
        depth = 6 * hinge;
    }
    /* farther away the hinge would be lost beside the lens */
    return isfinite(hinge) ? fmin(depth, 12 * hinge) : depth;
}

/* The view of the scene inside the frame whose sides (px) are set in `view`. */
static void view_choose(struct view *view, const struct wedge *wedge, double names_px)
{
    double hinge = fabs(wedge->hinge), depth = choose_depth(wedge);
    double width = view->right - view->left - names_px, height = view->bottom - view->top;
    bool shows_hinge = hinge < 4 * depth;
    double deepest = fmax(hinge, fmin(fabs(wedge->scheimpflug), 2 * hinge));
    double below = shows_hinge ? 1.1 * deepest : 0; /* above for a negative tilt */
    double above = fmax(0.3 * below, wedge->sensor_height);
    view->scale = width / (depth + wedge->image);
    if (shows_hinge && !(wedge->depth > 0)) {
        view->scale = fmin(view->scale, height / (below + above));
    }
    double spare = fmax(0, height / view->scale - below - above);
    /* a level plane opens its wedge to both sides, a steep one goes up */
    bool level = wedge->A < fabs(wedge->B);
    double under = below + spare * (shows_hinge && !level ? 0.25 : 0.5);
    view->x0 = view->left + names_px + view->scale * wedge->image;
    view->y0 =
        wedge->hinge > 0 ? view->bottom - view->scale * under : view->top + view->scale * under;
}

/* Keep the part of a convex area where a u + b y >= c. */
static struct area area_cut(const struct area *area, double a, double b, double c)
{
    struct area kept = {.count = 0};
    for (size_t i = 0; i < area->count; i++) {
        size_t next = (i + 1) % area->count;
        double here = a * area->u[i] + b * area->y[i] - c;
        double there = a * area->u[next] + b * area->y[next] - c;
        if (here >= 0 && kept.count < AREA_CORNERS) {
            kept.u[kept.count] = area->u[i];
            kept.y[kept.count++] = area->y[i];
        }
        if ((here >= 0) != (there >= 0) && kept.count < AREA_CORNERS) {
            double part = here / (here - there);
            kept.u[kept.count] = area->u[i] + part * (area->u[next] - area->u[i]);
            kept.y[kept.count++] = area->y[i] + part * (area->y[next] - area->y[i]);
        }
    }
    return kept;
}

/* The view in front of the lens. */
static struct area scene(const struct view *view)
{
    double right = (view->right - view->x0) / view->scale;
    double low = (view->y0 - view->bottom) / view->scale;
    double high = (view->y0 - view->top) / view->scale;
    return (struct area){{0, right, right, 0}, {low, low, high, high}, 4};
}

/* What is sharp: the view in front of the lens, behind the near limit and before the far limit. */
static struct area view_sharp(const struct view *view, const struct wedge *wedge)
{
    struct area area = scene(view);
    area = area_cut(&area, wedge->A_near, -wedge->B, wedge->f);
    return area_cut(&area, -wedge->A_far, wedge->B, -wedge->f);
}

/* Narrow from..to to where low <= start + t step <= high. */
static void stretch_narrow(double start, double step, double low, double high, double *from,
                           double *to)
{
    if (fabs(step) > 0) {
        double a = (low - start) / step, b = (high - start) / step;
        *from = fmax(*from, fmin(a, b));
        *to = fmin(*to, fmax(a, b));
    } else if (!(start >= low && start <= high)) {
        *to = -(double)INFINITY;
    }
}

/* The part of the plane A u - B y = f that is in the view, in front of the lens. */
static struct stretch view_plane(const struct view *view, const struct wedge *wedge, double A)
{
    struct area all = scene(view);
    double B = wedge->B, square = A * A + B * B;
    double u = wedge->f * A / square, y = -wedge->f * B / square; /* nearest to the lens */
    double from = -(double)INFINITY, to = (double)INFINITY;
    stretch_narrow(u, B, all.u[0], all.u[1], &from, &to);
    stretch_narrow(y, A, all.y[0], all.y[2], &from, &to);
    struct stretch part = {{u + from * B, u + to * B}, {y + from * A, y + to * A}, from < to};
    if (part.u[0] > part.u[1]) {
        part = (struct stretch){{part.u[1], part.u[0]}, {part.y[1], part.y[0]}, part.shown};
    }
    return part;
}

/* Numbers as the drawing shows them: "0.18", "5°". */
static const char *wedge_digits(struct arena *arena, double x)
{
    char text[NUMBER_LENGTH + 1];
    *number_write_digits(text, x, 4) = '\0';
    return arena_printf(arena, "%s", text);
}

static const char *wedge_degrees(struct arena *arena, double angle)
{
    double turn = angle * DEGREES_PER_RADIAN;
    return arena_printf(arena, "%s%s°", turn < 0 ? "−" : "", wedge_digits(arena, fabs(turn)));
}

/* Bellows, sensor and lens to scale. */
static void wedge_draw_camera(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    double v = wedge->image, half = wedge->lens_diameter / 2, sensor = wedge->sensor_height / 2;
    double sine = sin(wedge->tilt), cosine = cos(wedge->tilt), middle = wedge->sensor_centre;
    double x[] = {view_x(view, half * sine), view_x(view, -v), view_x(view, -v),
                  view_x(view, -half * sine)};
    double y[] = {view_y(view, half * cosine), view_y(view, middle + sensor),
                  view_y(view, middle - sensor), view_y(view, -half * cosine)};
    svg_styled_polygon(svg, &(struct svg_style){.fill = "#e9e6e0", .stroke = "#b9b4aa", .width = 1},
                       x, y, 4);
    /* the sensor */
    svg_styled_line(svg, &(struct svg_style){.stroke = BLACK, .width = 3}, x[1], y[2], x[1], y[1]);
    /* A lens seen from the side: two arcs of the given height about the origin. */
    enum { POINTS = 17 };
    double lens_x[2 * POINTS], lens_y[2 * POINTS];
    for (size_t i = 0; i < POINTS; i++) {
        double t = 2.0 * (double)i / (POINTS - 1) - 1, thick = 0.22 * half * (1 - t * t);
        for (size_t side = 0; side < 2; side++) {
            double along = side == 0 ? thick : -thick; /* of the lens axis */
            size_t at = side == 0 ? i : 2 * POINTS - 1 - i;
            lens_x[at] = view_x(view, along * cosine + half * t * sine);
            lens_y[at] = view_y(view, half * t * cosine - along * sine);
        }
    }
    svg_styled_polygon(svg, &(struct svg_style){.fill = "#cfe3f2", .stroke = BLACK, .width = 1.4},
                       lens_x, lens_y, sizeof lens_x / sizeof lens_x[0]);
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

/* The camera enlarged inside the frame set in `view` (px), with its tilt and image distance. */
static void wedge_draw_close_view(struct svg *svg, struct view *view, const struct wedge *wedge)
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

static const char *metres(struct arena *arena, double length)
{
    return isinf(length) ? "∞" : arena_printf(arena, "%s m", wedge_digits(arena, length / 1000));
}

/* Its name along the line near its far end, so much above it (px). */
static void name_plane(struct svg *svg, const struct view *view, const struct stretch *part,
                       double lift, const char *colour, const char *name)
{
    double x1 = view_x(view, part->u[0]), y1 = view_y(view, part->y[0]);
    double x2 = view_x(view, part->u[1]), y2 = view_y(view, part->y[1]);
    double length = hypot(x2 - x1, y2 - y1), in = 14 / length, turn = atan2(y2 - y1, x2 - x1);
    if (!(length > svg_text_width(name, 13) + 30)) {
        return;
    }
    svg_text(svg,
             &(struct svg_label){.x = x2 + in * (x1 - x2) + lift * sin(turn),
                                 .y = y2 + in * (y1 - y2) - lift * cos(turn),
                                 .size = 13,
                                 .rotation = turn * DEGREES_PER_RADIAN,
                                 .anchor = SVG_END,
                                 .colour = colour},
             name);
}

static void draw_planes(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    const struct {
        double A;
        const char *name;
        struct svg_style style;
    } planes[] = {
        {wedge->A, "plane of sharp focus", {.stroke = BLUE, .width = 2.4}},
        {wedge->A_near, "near limit", {.stroke = ORANGE, .width = 1.4, .dash = "7 4"}},
        {wedge->A_far, "far limit", {.stroke = ORANGE, .width = 1.4, .dash = "2 3"}},
    };
    struct stretch parts[3];
    for (size_t i = 0; i < 3; i++) {
        parts[i] = view_plane(view, wedge, planes[i].A);
        if (parts[i].shown) {
            svg_styled_line(svg, &planes[i].style, view_x(view, parts[i].u[0]),
                            view_y(view, parts[i].y[0]), view_x(view, parts[i].u[1]),
                            view_y(view, parts[i].y[1]));
        }
    }
    for (size_t i = 0; i < 3; i++) {
        /* How far apart two lines end on the right, px; 0 if one is not in the view. */
        const struct stretch *b = &parts[i == 0 ? 1 : i];
        double apart = view->scale * hypot(parts[0].u[1] - b->u[1], parts[0].y[1] - b->y[1]);
        double gap = parts[0].shown && b->shown ? apart : 0;
        bool room = gap > NAME_GAP;
        /* the sharp plane's name stands above a wedge that is too thin for it */
        if (parts[i].shown && (room || i == 0)) {
            name_plane(svg, view, &parts[i], room ? 5 : 5 + gap, planes[i].style.stroke,
                       planes[i].name);
        }
    }
}

/* -------- the construction behind the lens -------- */

/* The two lines in which planes meet, end on, with names that keep clear of each other. */
static void draw_meetings(struct svg *svg, const struct view *view, const struct wedge *wedge)
{
    bool hinge = isfinite(wedge->hinge) && view_holds(view, 0, -wedge->hinge);
    bool line_shown =
        isfinite(wedge->scheimpflug) && view_holds(view, -wedge->image, -wedge->scheimpflug);
    double y1 = view_y(view, -wedge->hinge), y2 = view_y(view, -wedge->scheimpflug);
    double apart = hinge && line_shown ? fmax(0, 20 - fabs(y2 - y1)) / 2 : 0;
    double sign = copysign(1, fabs(y2 - y1) < 1 ? wedge->hinge : y2 - y1);
    const double sensor = view_x(view, -wedge->image), names = sensor - 10;
    if (line_shown) {
        svg_styled_circle(svg, &(struct svg_style){.fill = BLACK}, sensor, y2, 4);
        svg_words(svg, names, y2 + 5 + sign * apart, 13, SVG_END, BLACK, "Scheimpflug line");
    }
    if (hinge) {
        svg_styled_circle(svg, &(struct svg_style){.fill = RED}, view_x(view, 0), y1, 4);
        svg_words(svg, names, y1 + 5 - sign * apart, 13, SVG_END, RED, "hinge line");
    }
    if (hinge && fabs(y1 - view->y0) > 50) {
        svg_words(svg, names, (y1 + view->y0) / 2 + 5, 13, SVG_END, RED,
                  arena_printf(svg->arena, "J = %s", metres(svg->arena, fabs(wedge->hinge))));
    }
}

/* -------- frame, scales, legend -------- */

/* Ticks in metres along one side of the frame. */
static void wedge_draw_scale(struct svg *svg, const struct view *view, bool along)
{
    struct ticks ticks;
    double low = along ? 0 : (view->y0 - view->bottom) / view->scale;
    double high = (along ? view->right - view->x0 : view->y0 - view->top) / view->scale;
    ticks_linear(low / 1000, high / 1000, &ticks);
    svg_group_begin(svg, &(struct svg_style){.stroke = "#555", .width = 1});
    for (size_t i = 0; i < ticks.count; i++) {
        double x = view_x(view, 1000 * ticks.value[i]), y = view_y(view, 1000 * ticks.value[i]);
        bool inside = along ? x <= view->right + 0.5 : y >= view->top && y <= view->bottom;
        if (!inside) {
            continue;
        }
        svg_line(svg, along ? x : view->left - 5, along ? view->bottom : y, along ? x : view->left,
                 along ? view->bottom + 5 : y);
        svg_words(svg, along ? x : view->left - 9, along ? view->bottom + 20 : y + 4, 12,
                  along ? SVG_MIDDLE : SVG_END, "#444", ticks_text(svg->arena, &ticks, i));
    }
    svg_group_end(svg);
}

static void wedge_draw_frame(struct svg *svg, const struct view *view)
{
    svg_styled_rect(svg, &(struct svg_style){.stroke = "#555"}, view->left, view->top,
                    view->right - view->left, view->bottom - view->top);
    wedge_draw_scale(svg, view, true);
    wedge_draw_scale(svg, view, false);
    struct svg_label label = {.x = (view->x0 + view->right) / 2,
                              .y = view->bottom + 44,
                              .size = 13,
                              .anchor = SVG_MIDDLE,
                              .colour = "#444"};
    svg_text(svg, &label, "distance from the lens (m)");
    label.x = view->left - 50;
    label.y = (view->top + view->bottom) / 2;
    label.rotation = -90;
    svg_text(svg, &label, "height against the lens (m)");
}

/* "hinge line, 1.72 m below" (the lens) */
static const char *depth_words(struct arena *arena, const char *name, double depth)
{
    if (isinf(depth)) {
        return arena_printf(arena, "%s at infinity", name);
    }
    return arena_printf(arena, "%s, %s %s", name, metres(arena, fabs(depth)),
                        depth > 0 ? "below" : "above");
}

static const char *angle_words(struct arena *arena, const char *name, double A, double B)
{
    return arena_printf(arena, "%s, %s to sensor", name, wedge_degrees(arena, atan2(B, A)));
}

static void wedge_draw_legend(struct svg *svg, const struct wedge *wedge)
{
    struct arena *arena = svg->arena;
    double B = wedge->B;
    const struct {
        struct svg_style style;
        const char *words;
    } entries[] = {
        {{.stroke = BLUE, .width = 2.4}, angle_words(arena, "plane of focus", wedge->A, B)},
        {{.stroke = ORANGE, .width = 1.4, .dash = "7 4"},
         angle_words(arena, "near limit", wedge->A_near, B)},
        {{.stroke = ORANGE, .width = 1.4, .dash = "2 3"},
         angle_words(arena, "far limit", wedge->A_far, B)},
        {{.fill = TINT, .opacity = 0.22}, "sharp enough"},
        {{.stroke = GREY, .width = 1.2, .dash = "6 4"}, "lens plane, sensor plane, extended"},
        {{.stroke = RED, .width = 4}, depth_words(arena, "hinge line", wedge->hinge)},
        {{.stroke = BLACK, .width = 4}, depth_words(arena, "Scheimpflug line", wedge->scheimpflug)},
        {{.stroke = "#aaa", .width = 1},
         arena_printf(arena, "ahead, %s to %s", metres(arena, wedge_ahead(wedge, wedge->A_near)),
                      metres(arena, wedge_ahead(wedge, wedge->A_far)))},
    };
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        const struct svg_style *style = &entries[i].style;
        const double y = LEGEND + 24 * (double)i;
        if (style->fill != NULL) {
            svg_styled_rect(svg, style, MARGIN, y - 10, 26, 12);
        } else {
            svg_styled_line(svg, style, MARGIN, y - 4, MARGIN + 26, y - 4);
        }
        svg_words_within(svg, MARGIN + 34, y, 12.5, CAMERA_RIGHT - MARGIN - 34, NULL,
                         entries[i].words);
    }
}

static bool check_wedge(const struct wedge *wedge, struct error *error)
{
    const double positive[] = {wedge->f, wedge->image, wedge->sensor_height, wedge->lens_diameter};
    const double finite[] = {wedge->A, wedge->A_near, wedge->A_far, wedge->B, wedge->sensor_centre};
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; i++) {
        if (!(positive[i] > 0 && isfinite(positive[i]))) {
            return fail(error, ERROR_DOMAIN, "a length of %g mm cannot be drawn (above 0, finite)",
                        positive[i]);
        }
    }
    for (size_t i = 0; i < sizeof finite / sizeof finite[0]; i++) {
        if (!isfinite(finite[i])) {
            return fail(error, ERROR_DOMAIN, "a plane of sharpness with %g cannot be drawn",
                        finite[i]);
        }
    }
    if (!(fabs(wedge->tilt) < PI / 2)) {
        return fail(error, ERROR_DOMAIN, "a tilt of %g rad cannot be drawn", wedge->tilt);
    }
    return (wedge->depth >= 0 && isfinite(wedge->depth)) ||
           fail(error, ERROR_DOMAIN, "a depth of %g mm cannot be drawn (0 or more, finite)",
                wedge->depth);
}

bool wedge_draw(const struct wedge *wedge, struct svg *svg, struct error *error)
{
    if (!check_wedge(wedge, error)) {
        return false;
    }
    struct view view = {
        .left = SCENE_LEFT, .right = SCENE_RIGHT, .top = SCENE_TOP, .bottom = SCENE_BOTTOM};
    struct view camera = {
        .left = MARGIN, .right = CAMERA_RIGHT, .top = CAMERA_TOP, .bottom = CAMERA_BOTTOM};
    view_choose(&view, wedge, NAMES);
    svg_begin(svg, WEDGE_WIDTH, WEDGE_HEIGHT, wedge->title);
    double width = WEDGE_WIDTH - 2 * MARGIN;
    svg_heading(svg, MARGIN, 36, 18, width, wedge->title);
    svg_subheading(svg, MARGIN, 60, 13, width, wedge->subtitle);
    wedge_draw_close_view(svg, &camera, wedge);
    svg_clip_begin(svg, view.left, view.top, view.right - view.left, view.bottom - view.top);
    /* what is sharp */
    struct area area = view_sharp(&view, wedge);
    double x[AREA_CORNERS], y[AREA_CORNERS];
    for (size_t i = 0; i < area.count; i++) {
        x[i] = view_x(&view, area.u[i]);
        y[i] = view_y(&view, area.y[i]);
    }
    svg_styled_polygon(svg, &(struct svg_style){.fill = TINT, .opacity = 0.22}, x, y, area.count);
    /* Lens plane, sensor plane and plane of focus run together in the Scheimpflug line. */
    double v = wedge->image, down = -wedge->scheimpflug, J = -wedge->hinge;
    double top = copysign(wedge->sensor_height, wedge->hinge);
    svg_group_begin(svg, &(struct svg_style){.stroke = GREY, .width = 1.2, .dash = "6 4"});
    if (isfinite(J)) {
        view_line(&view, svg, top * tan(wedge->tilt), top, -v, down);
        view_line(&view, svg, -v, top, -v, down);
        view_line(&view, svg, -v, down, 0, J);
    }
    svg_group_end(svg);
    svg_styled_line(svg, &(struct svg_style){.stroke = "#aaa", .width = 1}, view.x0, view.y0,
                    view.right, view.y0);
    /* to the hinge, if that is not at infinity: the line is left out then */
    svg_styled_line(svg, &(struct svg_style){.stroke = RED, .width = 1, .dash = "2 3"}, view.x0,
                    view.y0, view.x0, view_y(&view, J));
    draw_planes(svg, &view, wedge);
    wedge_draw_camera(svg, &view, wedge);
    svg_group_end(svg);
    draw_meetings(svg, &view, wedge);
    wedge_draw_frame(svg, &view);
    wedge_draw_legend(svg, wedge);
    svg_end(svg);
    return true;
}
