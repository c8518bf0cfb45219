/* draw/panels.c - many small plots on one page, in SVG. */
/* SPDX-License-Identifier: MIT */
#include "draw/panels.h"

#include "base/error.h"
#include "draw/panels_cell.h"
#include "draw/panels_page.h"
#include "draw/ticks.h"

#include <math.h>

enum { MOST = 400, MOST_COLUMNS = 20 };

static const double FARTHEST = 1e12;

/* -------- ranges -------- */

static void panels_include(struct panels_scale *scale, double low, double high)
{
    scale->low = fmin(scale->low, low);
    scale->high = fmax(scale->high, high);
}

static void include_panel(const struct panel *panel, struct panels_scale *x, struct panels_scale *y)
{
    for (size_t s = 0; s < panel->count; s++) {
        const struct panel_series *series = &panel->series[s];
        for (size_t i = 0; i < series->count; i++) {
            if (isfinite(series->x[i]) && isfinite(series->y[i])) {
                panels_include(x, series->x[i], series->x[i]);
                panels_include(y, series->y[i], series->y[i]);
            }
        }
    }
}

static bool panels_has_range(double low, double high)
{
    return low < high;
}

/* To round numbers; an x range that was given keeps its ends. */
static void set_axes(const struct panels *panels, struct panels_scale *x, struct panels_scale *y)
{
    bool given = !panels->own_x && panels_has_range(panels->x_low, panels->x_high);
    if (given) {
        panels_include(x, panels->x_low, panels->x_high);
    }
    if (!panels->own_y && panels_has_range(panels->y_low, panels->y_high)) {
        panels_include(y, panels->y_low, panels->y_high);
    }
    ticks_linear(x->low, x->high, &x->ticks);
    ticks_linear(y->low, y->high, &y->ticks);
    if (!given) {
        panels_include(x, x->ticks.value[0], x->ticks.value[x->ticks.count - 1]);
    }
    panels_include(y, y->ticks.value[0], y->ticks.value[y->ticks.count - 1]);
}

/* One scale for both directions, the origin in the middle. */
static void set_square(const struct panels *panels, struct panels_scale *x, struct panels_scale *y)
{
    double most = fmax(fmax(-x->low, x->high), fmax(-y->low, y->high));
    for (size_t i = 0; i < panels->count; i++) {
        most = fmax(most, panels->panels[i].circle);
    }
    most = most > 0 ? 1.06 * most : 1;
    *x = *y = (struct panels_scale){.low = -most, .high = most};
}

static const struct panels_scale nothing = {.low = INFINITY, .high = -INFINITY};

static bool set_shared(struct panels_page *page, struct error *error)
{
    const struct panels *panels = page->panels;
    page->x = page->y = nothing;
    for (size_t i = 0; i < panels->count; i++) {
        include_panel(&panels->panels[i], &page->x, &page->y);
    }
    if (!(page->y.low <= page->y.high)) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw: no panel has a point");
    }
    double most = fmax(fmax(-page->x.low, page->x.high), fmax(-page->y.low, page->y.high));
    if (most > FARTHEST) {
        return fail(error, ERROR_DOMAIN, "a value of %g cannot be drawn: the limit is %g", most,
                    FARTHEST);
    }
    if (panels->unit) {
        set_square(panels, &page->x, &page->y);
    } else {
        set_axes(panels, &page->x, &page->y);
    }
    return true;
}

/* The scales of one panel: its own where it has one and a point to set it by. */
static void choose_scales(const struct panels_page *page, const struct panel *panel,
                          struct panels_scale *x, struct panels_scale *y)
{
    const struct panels *panels = page->panels;
    struct panels_scale own_x = nothing, own_y = nothing;
    include_panel(panel, &own_x, &own_y);
    bool any = own_x.low <= own_x.high && !panels->unit;
    if (any) {
        set_axes(panels, &own_x, &own_y);
    }
    *x = any && panels->own_x ? own_x : page->x;
    *y = any && panels->own_y ? own_y : page->y;
}

bool panels_draw(const struct panels *panels, struct svg *svg, struct error *error)
{
    struct panels_page page = {.panels = panels, .svg = svg};
    if (panels->count > MOST || panels->columns > MOST_COLUMNS) {
        return fail(error, ERROR_USAGE,
                    "a page of %zu panels in %zu columns: at most %d in %d can be distinguished",
                    panels->count, panels->columns, MOST, MOST_COLUMNS);
    }
    if (!set_shared(&page, error)) {
        return false;
    }
    panels_page_begin(&page);
    for (size_t i = 0; i < panels->count; i++) {
        struct panels_cell cell = panels_page_cell(&page, i);
        choose_scales(&page, &panels->panels[i], &cell.x, &cell.y);
        panels_cell_draw(panels, svg, &cell, &panels->panels[i]);
    }
    panels_page_end(&page);
    return true;
}
