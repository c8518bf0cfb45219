/* draw/wedge_view.c - how a tilted lens and its scene lie on the page. */
/* SPDX-License-Identifier: MIT */
#include "draw/wedge_view.h"

#include "base/arena.h"
#include "base/constants.h"
#include "base/number.h"
#include "draw/svg.h"

#include <math.h>

double view_x(const struct view *view, double u)
{
    return view->x0 + view->scale * u;
}

double view_y(const struct view *view, double y)
{
    return view->y0 - view->scale * y;
}

bool view_holds(const struct view *view, double u, double y)
{
    double x = view_x(view, u), down = view_y(view, y);
    return x >= view->left && x <= view->right && down >= view->top && down <= view->bottom;
}

void view_line(const struct view *view, struct svg *svg, double u1, double y1, double u2, double y2)
{
    svg_line(svg, view_x(view, u1), view_y(view, y1), view_x(view, u2), view_y(view, y2));
}

double wedge_ahead(const struct wedge *wedge, double A)
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

void view_choose(struct view *view, const struct wedge *wedge, double names_px)
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
static struct area wedge_view_cut(const struct area *area, double a, double b, double c)
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

/* The view before the lens. */
static struct area scene(const struct view *view)
{
    double right = (view->right - view->x0) / view->scale;
    double low = (view->y0 - view->bottom) / view->scale;
    double high = (view->y0 - view->top) / view->scale;
    return (struct area){{0, right, right, 0}, {low, low, high, high}, 4};
}

struct area view_sharp(const struct view *view, const struct wedge *wedge)
{
    struct area area = scene(view);
    area = wedge_view_cut(&area, wedge->A_near, -wedge->B, wedge->f);
    return wedge_view_cut(&area, -wedge->A_far, wedge->B, -wedge->f);
}

/* Narrow from..to to where low <= start + t step <= high. */
static void wedge_view_narrow(double start, double step, double low, double high, double *from,
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

struct stretch view_plane(const struct view *view, const struct wedge *wedge, double A)
{
    struct area all = scene(view);
    double B = wedge->B, square = A * A + B * B;
    double u = wedge->f * A / square, y = -wedge->f * B / square; /* nearest to the lens */
    double from = -(double)INFINITY, to = (double)INFINITY;
    wedge_view_narrow(u, B, all.u[0], all.u[1], &from, &to);
    wedge_view_narrow(y, A, all.y[0], all.y[2], &from, &to);
    struct stretch part = {{u + from * B, u + to * B}, {y + from * A, y + to * A}, from < to};
    if (part.u[0] > part.u[1]) {
        part = (struct stretch){{part.u[1], part.u[0]}, {part.y[1], part.y[0]}, part.shown};
    }
    return part;
}

const char *wedge_digits(struct arena *arena, double x)
{
    char text[NUMBER_LENGTH + 1];
    *number_write_digits(text, x, 4) = '\0';
    return arena_printf(arena, "%s", text);
}

const char *wedge_degrees(struct arena *arena, double angle)
{
    double turn = angle * DEGREES_PER_RADIAN;
    return arena_printf(arena, "%s%s°", turn < 0 ? "−" : "", wedge_digits(arena, fabs(turn)));
}
