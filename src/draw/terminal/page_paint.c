/* draw/terminal/page_paint.c - the lines, areas and images of a drawing, as dots of a terminal. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/page_paint.h"

#include "base/error.h"
#include "base/image/png.h"
#include "draw/terminal/ink.h"

#include <math.h>
#include <string.h>

/* In which order the dots of a square are set as it gets darker (Bayer). */
static const int order[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};

/* -------- lines -------- */

static double dot_x(const struct page *page, double x)
{
    return DOTS_ACROSS * (page->left + page->scale * x);
}

static double dot_y(const struct page *page, double y)
{
    return DOTS_DOWN * (y - page->top) * page->scale / 2;
}

/* Where a shape is seen, in dots. */
static struct svg_bounds shape_window(const struct page *page, const struct svg_shape *shape)
{
    const struct svg_bounds window = {
        fmax(0, dot_x(page, shape->clip.left)), fmax(0, dot_y(page, shape->clip.top)),
        fmin((double)(DOTS_ACROSS * page->cells.columns) - 1, dot_x(page, shape->clip.right)),
        fmin((double)(DOTS_DOWN * page->cells.rows) - 1, dot_y(page, shape->clip.bottom))};
    return window;
}

/* Which part of a line, from 0 to 1, lies between two limits; false: none. */
static bool line_cut(double from, double to, double low, double high, double part[2])
{
    const double run = to - from;
    if (!(fabs(run) > 0)) {
        return from >= low && from <= high;
    }
    const double a = (low - from) / run, b = (high - from) / run;
    part[0] = fmax(part[0], fmin(a, b));
    part[1] = fmin(part[1], fmax(a, b));
    return part[0] <= part[1];
}

/* Which dots of a line are set, by the colour: so many on, so many off. */
static const struct stroke_dash {
    long on, off;
} dashes[] = {{1, 0}, {4, 3}, {1, 2}, {7, 2}, {2, 2}, {1, 4}, {3, 1}};

static struct stroke_dash lines_dash(const struct page *page, const struct svg_shape *shape)
{
    const size_t known = sizeof dashes / sizeof dashes[0];
    size_t i = 0;
    while (i < page->stroke_count &&
           memcmp(page->strokes[i].part, shape->stroke.part, sizeof shape->stroke.part) != 0) {
        i++;
    }
    if (shape->is_dashed) {
        return dashes[1];
    }
    const bool tells = page->view->colours == CELL_PLAIN && i < page->stroke_count;
    return tells ? dashes[i % known] : dashes[0];
}

/* The lines of a shape, a dot wide. */
static void paint_lines(const struct page *page, const struct svg_shape *shape)
{
    const struct svg_bounds window = shape_window(page, shape);
    const struct cell_ink ink = ink_of_colour(&shape->stroke);
    const struct stroke_dash dash = lines_dash(page, shape);
    long along = 0;
    for (size_t i = 0; i < shape->count; i++) {
        const size_t next = i + 1 < shape->count ? i + 1 : i;
        const double x = dot_x(page, shape->x[i]), y = dot_y(page, shape->y[i]);
        const double x2 = dot_x(page, shape->x[next]), y2 = dot_y(page, shape->y[next]);
        double part[2] = {0, 1};
        if (isnan(x) || isnan(y)) {
            along = 0;
            continue;
        }
        if (isnan(x2) || isnan(y2) || (next == i && shape->count > 1) ||
            !line_cut(x, x2, window.left, window.right, part) ||
            !line_cut(y, y2, window.top, window.bottom, part)) {
            continue;
        }
        const long steps = lround(fmax(fabs(x2 - x), fabs(y2 - y)) * (part[1] - part[0]));
        for (long k = 0; k <= steps; k++, along++) {
            const double t = part[0] + (part[1] - part[0]) * (double)k / (double)(steps + !steps);
            if (along % (dash.on + dash.off) < dash.on) {
                cells_dot(&page->cells, (long)floor(x + t * (x2 - x)),
                          (long)floor(y + t * (y2 - y)), true, &ink);
            }
        }
        along -= steps > 0; /* the next line begins where this one ends */
    }
}

/* So large and dark that its outline says more, and what is written on it can be read. */
static bool area_is_ground(const struct page *page, const struct svg_shape *shape)
{
    static const double large = 16; /* dots */
    struct svg_bounds bounds = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < shape->count; i++) {
        if (!isnan(shape->x[i])) {
            svg_bounds_include(&bounds, dot_x(page, shape->x[i]), dot_y(page, shape->y[i]));
        }
    }
    return ink_is_grey(&shape->fill) && shape->stroke.is_none &&
           bounds.right - bounds.left > large && bounds.bottom - bounds.top > large;
}

/* How many dots of an area are set: 0 none, 16 all. */
static int area_density(const struct page *page, const struct svg_shape *shape)
{
    static const double faint = 0.3, solid = 0.45;
    const double contrast = ink_contrast(&shape->fill, &page->paper) * shape->opacity;
    if (contrast < faint || area_is_ground(page, shape)) {
        return 0;
    }
    return contrast > solid ? 16 : 4;
}

/* Columns of dots where a line of the page crosses the edges of an area, ascending. */
static size_t area_crossings(const struct page *page, const struct svg_shape *shape, double y,
                             double *crossings)
{
    size_t count = 0, first = 0;
    for (size_t i = 0; i < shape->count; i++) {
        if (isnan(shape->x[i])) {
            first = i + 1;
            continue;
        }
        const bool ends = i + 1 == shape->count || isnan(shape->x[i + 1]);
        const size_t next = ends ? first : i + 1;
        const double a = dot_y(page, shape->y[i]), b = dot_y(page, shape->y[next]);
        if ((a <= y) != (b <= y)) {
            const double t = (y - a) / (b - a);
            const double x = shape->x[i] + t * (shape->x[next] - shape->x[i]);
            size_t at = count++;
            for (; at > 0 && crossings[at - 1] > dot_x(page, x); at--) {
                crossings[at] = crossings[at - 1];
            }
            crossings[at] = dot_x(page, x);
        }
    }
    return count;
}

/* The area of a shape: what it covers is no longer seen, even if it is only a little darker. */
static void paint_area(const struct page *page, const struct svg_shape *shape)
{
    static const double covering = 0.9;
    const struct svg_bounds window = shape_window(page, shape);
    const struct cell_ink ink = ink_of_colour(&shape->fill);
    const int density = area_density(page, shape);
    double *crossings = ARENA_ARRAY(page->arena, shape->count + 1, double);
    if (density == 0 && shape->opacity < covering) {
        return;
    }
    bool any = false;
    for (long y = lround(ceil(window.top)); (double)y <= window.bottom; y++) {
        const size_t count = area_crossings(page, shape, (double)y + 0.5, crossings);
        for (size_t i = 0; i + 1 < count; i += 2) {
            const double left = fmax(crossings[i], window.left);
            const double right = fmin(crossings[i + 1], window.right + 1);
            for (long x = lround(ceil(left - 0.5)); (double)x + 0.5 < right; x++) {
                const bool is_set = order[y % 4][x % 4] < density;
                cells_dot(&page->cells, x, y, is_set, is_set ? &ink : NULL);
                any = true;
            }
        }
    }
    /* smaller than a dot */
    if (!any && density > 0 && shape->count > 0) {
        double x = 0, y = 0;
        for (size_t i = 0; i < shape->count; i++) {
            x += dot_x(page, shape->x[i]) / (double)shape->count;
            y += dot_y(page, shape->y[i]) / (double)shape->count;
        }
        if (x >= window.left && x <= window.right && y >= window.top && y <= window.bottom) {
            cells_dot(&page->cells, (long)floor(x), (long)floor(y), true, &ink);
        }
    }
}

/* -------- images -------- */

/* A rectangle in cells. */
struct image_place {
    double left, top, wide, high;
};

/* The colour of a picture at a place of it, 0..1 across and down; none: it is transparent. */
static struct svg_colour image_colour(const struct image *image, double x, double y)
{
    const float *pixel = image_row(image, (size_t)(y * (double)image->height)) +
                         (size_t)(x * (double)image->width) * image->channels;
    const bool has_alpha = image->channels % 2 == 0;
    struct svg_colour colour = {.is_none = has_alpha && pixel[image->channels - 1] < 0.5F};
    for (size_t k = 0; k < 3; k++) {
        colour.part[k] = fmin(fmax((double)pixel[image->channels < 3 ? 0 : k], 0), 1);
    }
    return colour;
}

/* Half a cell in a colour; its other half is the page until that has one. */
static void paint_half(const struct page *page, struct cell *cell, bool is_upper,
                       const struct svg_colour *colour)
{
    for (size_t k = 0; k < 3 && !cell->is_painted; k++) {
        cell->upper[k] = cell->lower[k] = (unsigned char)lround(255 * page->paper.part[k]);
    }
    cell->is_painted = true;
    for (size_t k = 0; k < 3; k++) {
        (is_upper ? cell->upper : cell->lower)[k] = (unsigned char)lround(255 * colour->part[k]);
    }
}

/* A picture over a rectangle: half a cell has the colour of its middle, or dots its contrast. */
static void paint_image(const struct page *page, const struct svg_shape *shape)
{
    struct image image;
    struct error ignored;
    const struct image_wish wish = {.values = IMAGE_CODES};
    if (shape->count < 3 || !png_read(shape->png, &wish, page->arena, &image, &ignored)) {
        return;
    }
    const bool is_plain = page->view->colours == CELL_PLAIN;
    const long down = is_plain ? DOTS_DOWN : 2, across = is_plain ? DOTS_ACROSS : 1;
    const struct image_place at = {
        page->left + page->scale * shape->x[0], (shape->y[0] - page->top) * page->scale / 2,
        page->scale * (shape->x[2] - shape->x[0]), page->scale / 2 * (shape->y[2] - shape->y[0])};
    const long right = lround((at.left + at.wide) * (double)across);
    const long bottom = lround((at.top + at.high) * (double)down);
    for (long v = lround(at.top * (double)down); v < bottom; v++) {
        for (long u = lround(at.left * (double)across); u < right; u++) {
            const double x = (((double)u + 0.5) / (double)across - at.left) / at.wide;
            const double y = (((double)v + 0.5) / (double)down - at.top) / at.high;
            struct cell *cell =
                u < 0 || v < 0 ? NULL : cells_at(&page->cells, u / across, v / down);
            if (cell == NULL || !(x >= 0 && x < 1 && y >= 0 && y < 1)) {
                continue;
            }
            const struct svg_colour colour = image_colour(&image, x, y);
            if (is_plain && !colour.is_none) {
                const double contrast = ink_contrast(&colour, &page->paper);
                cells_dot(&page->cells, u, v, 16 * contrast > order[v % 4][u % 4] + 0.5, NULL);
            } else if (!colour.is_none) {
                paint_half(page, cell, v % 2 == 0, &colour);
            }
        }
    }
}

void page_paint(const struct page *page, const struct svg_shape *shape)
{
    static const double visible = 0.2; /* lines that only help the eye are left out */
    if (shape->kind == SVG_SHAPE_IMAGE) {
        paint_image(page, shape);
        return;
    }
    if (!shape->fill.is_none) {
        paint_area(page, shape);
    }
    struct svg_shape outline = *shape;
    if (!shape->fill.is_none && area_is_ground(page, shape)) {
        outline.stroke = shape->fill;
    }
    if (!outline.stroke.is_none &&
        outline.opacity * ink_contrast(&outline.stroke, &page->paper) > visible) {
        paint_lines(page, &outline);
    }
}
