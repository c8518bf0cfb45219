/* draw/raster.c - false-colour maps with their scale, in SVG; or one as a picture. */
/* SPDX-License-Identifier: MIT */
#include "draw/raster.h"

#include "base/arena.h"
#include "base/constants.h"
#include "base/error.h"
#include "base/image/png.h"
#include "base/image/srgb.h"
#include "draw/contours.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

/* px */
static const double LEFT = 84, TOP = 104, SIDE = 250, ACROSS = 344, DOWN = 358, BOTTOM = 20;
static const double BAR_GAP = 34, BAR_WIDTH = 18, BAR_ROOM = 110, TICK = 5;
static const double MARGIN = 24, BOLDER = 1.2, TITLES_MOST = 760; /* wide, of pages of few maps */
static const double TITLE_SIZE = 16, SUBTITLE_SIZE = 12;
enum { CHANNELS = 4, BAR_STEPS = 256 };

/* A page at work. */
struct raster_page {
    const struct rasters *rasters;
    struct svg *svg;
    double low, high; /* of the scale; logarithms to the base 10 where it is one */
};

static double raster_scaled(const struct rasters *rasters, double value)
{
    return rasters->colours == RASTER_LOG ? log10(fmax(value, 1e-300)) : value;
}

/* The highest absolute value, of signed ones that of the bulk; 0: there is none, or all are 0. */
static bool find_highest(const struct rasters *rasters, const struct raster_map *map,
                         struct arena *arena, double *highest)
{
    double *sizes = ARENA_ARRAY(arena, map->size * map->size, double), most = 0;
    size_t count = 0;
    for (size_t i = 0; i < map->size * map->size; i++) {
        if (isfinite(map->values[i])) {
            sizes[count] = fabs(map->values[i]);
            most = fmax(most, sizes[count++]);
        }
    }
    most = rasters->colours == RASTER_SIGNED ? ticks_reach(sizes, count) : most;
    *highest = fmax(*highest, most);
    return count > 0;
}

static bool raster_find_scale(const struct rasters *rasters, struct arena *arena, double *low,
                              double *high, struct error *error)
{
    double highest = 0;
    bool any = false;
    for (size_t i = 0; i < rasters->count; i++) {
        any = find_highest(rasters, &rasters->maps[i], arena, &highest) || any;
    }
    if (!any) {
        return fail(error, ERROR_DOMAIN, "there is nothing to draw");
    }
    highest = rasters->own_scale ? 1 : fmax(highest, rasters->highest);
    highest = highest > 0 ? highest : 1;
    *high = raster_scaled(rasters, highest);
    if (rasters->colours == RASTER_LOG) {
        *low = *high - rasters->decades;
    } else if (rasters->colours == RASTER_SIGNED) {
        *low = -*high;
    } else {
        *low = 0;
    }
    return true;
}

/* A value between those of a map, and how much of what is about it is there. */
struct raster_sample {
    double value, cover;
};

/* At a place in pixels from the middle of the lowest on the left; by neighbours that are there. */
static struct raster_sample raster_interpolate(const struct rasters *rasters,
                                               const struct raster_map *map, double x, double y)
{
    const double last = (double)map->size - 1;
    x = fmin(fmax(x, 0), last);
    y = fmin(fmax(y, 0), last);
    const size_t column = (size_t)fmin(floor(x), last - 1), row = (size_t)fmin(floor(y), last - 1);
    const double right = x - (double)column, above = y - (double)row;
    const double across[] = {1 - right, right}, up[] = {1 - above, above};
    double sum = 0, weights = 0;
    for (size_t k = 0; k < 4; k++) {
        const double weight = across[k % 2] * up[k / 2];
        const double value = map->values[(row + k / 2) * map->size + column + k % 2];
        if (isfinite(value) && weight > 0) {
            sum += weight * raster_scaled(rasters, value);
            weights += weight;
        }
    }
    return (struct raster_sample){weights > 0 ? sum / weights : (double)NAN, weights};
}

/* sin(pi x)/(pi x): what is left of fringes of which a pixel has x. */
static double fringes_left(double x)
{
    return fabs(x) > 1e-6 ? sin(PI * x) / (PI * x) : 1;
}

/* The mean intensity of fringes over a pixel that is `width` pixels of the map wide. */
static double raster_fringe(const struct rasters *rasters, const struct raster_map *map, double x,
                            double y, double width)
{
    const double half = width / 2, phase = raster_interpolate(rasters, map, x, y).value;
    const double across = raster_interpolate(rasters, map, x + half, y).value -
                          raster_interpolate(rasters, map, x - half, y).value;
    const double up = raster_interpolate(rasters, map, x, y + half).value -
                      raster_interpolate(rasters, map, x, y - half).value;
    const double left =
        fabs(across) < 1 && fabs(up) < 1 ? fringes_left(across) * fringes_left(up) : 0;
    return 0.5 + 0.5 * left * cos(2 * PI * phase);
}

/* The colour of a share of the scale, as light. */
static void raster_colour(const struct rasters *rasters, double share, float pixel[CHANNELS])
{
    double colour[3] = {share, share, share};
    if (rasters->colours != RASTER_FRINGES) {
        palette_scale(rasters->colours == RASTER_SIGNED, share, colour);
    }
    for (int k = 0; k < 3; k++) {
        pixel[k] = (float)srgb_light(colour[k]);
    }
}

/* The pixels of a map, each in `finer` squared parts. */
static bool raster_paint(const struct raster_page *page, const struct raster_map *map, size_t finer,
                         struct arena *arena, struct text *file, struct error *error)
{
    const struct rasters *rasters = page->rasters;
    const size_t size = finer * map->size;
    struct image image = {.width = size, .height = size, .channels = CHANNELS};
    const struct image_way way = {.bits = 8, .values = IMAGE_LIGHT};
    double own = 0;
    if (!image_new(&image, arena, error)) {
        return false;
    }
    if (rasters->own_scale) {
        find_highest(rasters, map, arena, &own);
    }
    own = own > 0 ? own : 1;
    for (size_t i = 0; i < size * size; i++) {
        const size_t row = size - 1 - i / size;
        const double x = ((double)(i % size) + 0.5) / (double)finer - 0.5;
        const double y = ((double)row + 0.5) / (double)finer - 0.5;
        const struct raster_sample at = raster_interpolate(rasters, map, x, y);
        const double value = at.value / (rasters->colours == RASTER_LOG ? 1 : own) -
                             (rasters->colours == RASTER_LOG ? log10(own) : 0);
        float *pixel = image.pixels + CHANNELS * i;
        double share = (value - page->low) / (page->high - page->low);
        if (rasters->colours == RASTER_FRINGES) {
            share = raster_fringe(rasters, map, x, y, 1 / (double)finer);
        }
        pixel[0] = pixel[1] = pixel[2] = 1;
        pixel[3] = 0;
        if (at.cover > 0 && !isnan(share)) {
            raster_colour(rasters, share, pixel);
            /* an edge as sharp as the finer pixels */
            pixel[3] = (float)fmin(fmax((at.cover - 0.5) * (double)finer + 0.5, 0), 1);
        }
    }
    return png_write(&image, &way, arena, file, error);
}

/* The bar of colours. */
static bool raster_paint_bar(const struct rasters *rasters, struct arena *arena, struct text *file,
                             struct error *error)
{
    struct image image = {.width = 1, .height = BAR_STEPS, .channels = CHANNELS};
    const struct image_way way = {.bits = 8, .values = IMAGE_LIGHT};
    if (!image_new(&image, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < BAR_STEPS; i++) {
        float *pixel = image.pixels + CHANNELS * i;
        raster_colour(rasters, 1 - ((double)i + 0.5) / BAR_STEPS, pixel);
        pixel[3] = 1;
    }
    return png_write(&image, &way, arena, file, error);
}

static void raster_write_text(const struct raster_page *page, double x, double y, double size,
                              enum svg_anchor anchor, const char *text)
{
    if (text != NULL) {
        svg_words(page->svg, x, y, size, anchor, NULL, text);
    }
}

static const struct svg_style frame = {.stroke = "#444444"}, nothing = {.fill = "#dddddd"};

/* "10" with an exponent, a whole number of one digit. */
static const char *raster_power(struct arena *arena, double exponent)
{
    static const char *const digits[] = {
        "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
        "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
    const size_t digit = (size_t)fmin(fabs(round(exponent)), 9);
    const char *minus = exponent < 0 ? "\xe2\x81\xbb" : "";
    return digit == 0 ? "1" : ARENA_JOIN(arena, "10", minus, digits[digit]);
}

/*
 * Ticks from low to high, from x0, y0 (px) on: along x (upwards = 0), or upwards with their numbers
 * on the left (-1) or right (1); is_log: of powers of ten.
 */
static void raster_draw_axis(struct svg *svg, double low, double high, double x0, double y0,
                             double length, int upwards, bool is_log)
{
    struct ticks ticks;
    const double slack = 1e-9 * (high - low), side = upwards;
    ticks_linear(low, high, &ticks);
    for (size_t i = 0; i < ticks.count; i++) {
        const double value = ticks.value[i];
        const bool between = is_log && fabs(value - round(value)) > slack;
        if (value >= low - slack && value <= high + slack && !between) {
            const char *text =
                is_log ? raster_power(svg->arena, value) : ticks_text(svg->arena, &ticks, i);
            const double at = (value - low) / (high - low) * length;
            const double x = upwards == 0 ? x0 + at : x0, y = upwards == 0 ? y0 : y0 - at;
            svg_styled_line(svg, &frame, x, y, x + side * TICK, upwards == 0 ? y + TICK : y);
            if (upwards == 0) {
                svg_words(svg, x, y + 17, 11, SVG_MIDDLE, NULL, text);
            } else {
                svg_words(svg, x + 8 * side, y + 4, 11, side < 0 ? SVG_END : SVG_START, NULL, text);
            }
        }
    }
}

/* Contour lines over a map, of which so many corners are enough. */
static void raster_draw_contours(const struct raster_map *map, double x, double y, struct svg *svg)
{
    enum { CORNERS = 160, LINES_MOST = 100 };
    const size_t stride = map->size / CORNERS + 1, size = (map->size - 1) / stride + 1;
    double *values = ARENA_ARRAY(svg->arena, size * size, double), low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < size * size; i++) {
        values[i] = map->values[i / size * stride * map->size + i % size * stride];
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    /* values are those of the middles of pixels */
    const double pixel = SIDE / (double)map->size;
    const double side = pixel * (double)((size - 1) * stride);
    const struct contour_map contours = {size, values, x + pixel / 2, y + SIDE - pixel / 2 - side,
                                         side};
    svg_group_begin(svg, &(struct svg_style){.stroke = "#222222", .width = 0.6, .opacity = 0.7});
    double level = map->step * ceil(low / map->step);
    for (int i = 0; i < LINES_MOST && level < high; i++, level += map->step) {
        contours_draw(&contours, level, svg);
    }
    svg_group_end(svg);
}

/* A bar of round length in the lower left corner of a map. */
static void raster_draw_length(const struct rasters *rasters, const struct raster_map *map,
                               double x, double y, struct svg *svg)
{
    const double length = ticks_round_below(0.6 * map->half);
    const double left = x + 12, base = y + SIDE - 12;
    const double end = left + length / (2 * map->half) * SIDE;
    const char *words =
        ARENA_JOIN(svg->arena, ticks_fixed(svg->arena, length, 0), " ", rasters->unit);
    const double wide = fmax(end - left, svg_text_width(words, 11)) + 12;
    svg_styled_rect(svg, &(struct svg_style){.fill = "#000000", .opacity = 0.5}, left - 6,
                    base - 22, wide, 30);
    svg_scale_bar(svg, "#ffffff", left, end, base);
    svg_words(svg, left, base - 8, 11, SVG_START, "#ffffff", words);
}

static bool draw_map(const struct raster_page *page, size_t i, struct error *error)
{
    enum { PIXELS = 320 }; /* along a side at least */
    const struct rasters *rasters = page->rasters;
    const struct raster_map *map = &rasters->maps[i];
    struct text png;
    struct svg *svg = page->svg;
    const double x = LEFT + ACROSS * (double)(i % rasters->columns);
    const double y = TOP + DOWN * (double)(i / rasters->columns);
    const double *centre = map->centre, half = map->half;
    if (!raster_paint(page, map, (PIXELS - 1) / map->size + 1, svg->arena, &png, error)) {
        return false;
    }
    svg_styled_rect(svg, &nothing, x, y, SIDE, SIDE);
    svg_image(svg, x, y, SIDE, SIDE, png);
    if (map->step > 0) {
        raster_draw_contours(map, x, y, svg);
    }
    if (rasters->unit != NULL) {
        raster_draw_length(rasters, map, x, y, svg);
    }
    svg_styled_rect(svg, &frame, x, y, SIDE, SIDE);
    raster_draw_axis(svg, centre[0] - half, centre[0] + half, x, y + SIDE, SIDE, 0, false);
    raster_draw_axis(svg, centre[1] - half, centre[1] + half, x, y + SIDE, SIDE, -1, false);
    svg_text(
        svg,
        &(struct svg_label){
            .x = x + SIDE / 2, .y = y - 10, .size = 13, .width = ACROSS - 8, .anchor = SVG_MIDDLE},
        map->title);
    raster_write_text(page, x + SIDE / 2, y + SIDE + 34, 12, SVG_MIDDLE, rasters->x_label);
    svg_words_upwards(svg, x - 48, y + SIDE / 2, 12, rasters->y_label);
    raster_write_text(page, x + SIDE / 2, y + SIDE + 54, 12, SVG_MIDDLE, map->note);
    return true;
}

/* The scale of colours beside the maps. */
static bool raster_draw_bar(const struct raster_page *page, double x, struct error *error)
{
    const struct rasters *rasters = page->rasters;
    struct svg *svg = page->svg;
    struct text png;
    if (!raster_paint_bar(rasters, svg->arena, &png, error)) {
        return false;
    }
    svg_image(svg, x, TOP, BAR_WIDTH, SIDE, png);
    svg_styled_rect(svg, &frame, x, TOP, BAR_WIDTH, SIDE);
    raster_draw_axis(svg, page->low, page->high, x + BAR_WIDTH, TOP + SIDE, SIDE, 1,
                     rasters->colours == RASTER_LOG);
    svg_words_upwards(svg, x + BAR_WIDTH + 62, TOP + SIDE / 2, 12, rasters->scale_label);
    return true;
}

bool rasters_draw(const struct rasters *rasters, struct svg *svg, struct error *error)
{
    struct raster_page page = {.rasters = rasters, .svg = svg};
    if (rasters->count > RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for %zu",
                    RASTER_MAPS_MOST, rasters->count);
    }
    if (!raster_find_scale(rasters, svg->arena, &page.low, &page.high, error)) {
        return false;
    }
    const size_t columns = rasters->count < rasters->columns ? rasters->count : rasters->columns;
    const size_t rows = (rasters->count + rasters->columns - 1) / rasters->columns;
    const double bar = LEFT + ACROSS * (double)(columns - 1) + SIDE + BAR_GAP;
    const char *const above = rasters->title != NULL ? rasters->title : "";
    const char *const below = rasters->subtitle != NULL ? rasters->subtitle : "";
    const double room =
        fmin(fmax(BOLDER * svg_text_width(above, TITLE_SIZE), svg_text_width(below, SUBTITLE_SIZE)),
             TITLES_MOST) +
        1;
    const double end = rasters->colours == RASTER_FRINGES ? bar : bar + BAR_ROOM;
    const double width = fmax(end, room + 2 * MARGIN);
    svg_begin(svg, width, TOP + DOWN * (double)rows - 30 + BOTTOM, rasters->title);
    svg_heading(svg, MARGIN, 32, TITLE_SIZE, width - 2 * MARGIN, above);
    svg_subheading(svg, MARGIN, 54, SUBTITLE_SIZE, width - 2 * MARGIN, below);
    for (size_t i = 0; i < rasters->count; i++) {
        if (!draw_map(&page, i, error)) {
            return false;
        }
    }
    if (rasters->colours != RASTER_FRINGES && !raster_draw_bar(&page, bar, error)) {
        return false;
    }
    svg_end(svg);
    return true;
}

bool raster_png(const struct rasters *rasters, size_t map, struct arena *arena, struct text *file,
                struct error *error)
{
    struct raster_page page = {.rasters = rasters};
    return raster_find_scale(rasters, arena, &page.low, &page.high, error) &&
           raster_paint(&page, &rasters->maps[map], 1, arena, file, error);
}
