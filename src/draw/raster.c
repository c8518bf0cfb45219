/* draw/raster.c - false-colour maps with their scale, in SVG; or one as a picture. */
/* SPDX-License-Identifier: MIT */
#include "draw/raster.h"

#include "base/arena.h"
#include "base/error.h"
#include "base/image/png.h"
#include "base/image/srgb.h"
#include "draw/palette.h"
#include "draw/svg.h"
#include "draw/ticks.h"

#include <math.h>

/* px */
static const double LEFT = 84, TOP = 104, SIDE = 250, ACROSS = 344, DOWN = 358, BOTTOM = 20;
static const double BAR_GAP = 34, BAR_WIDTH = 18, BAR_ROOM = 110, TICK = 5;
static const double MARGIN = 24, BOLDER = 0.93, TITLES_MOST = 760; /* wide, of pages of few maps */
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

/* The highest absolute value; 0: there is none, or all are 0. */
static bool find_highest(const struct raster_map *map, double *highest)
{
    bool any = false;
    for (size_t i = 0; i < map->size * map->size; i++) {
        if (isfinite(map->values[i])) {
            *highest = fmax(*highest, fabs(map->values[i]));
            any = true;
        }
    }
    return any;
}

static bool raster_find_scale(const struct rasters *rasters, double *low, double *high,
                              struct error *error)
{
    double highest = 0;
    bool any = false;
    for (size_t i = 0; i < rasters->count; i++) {
        any = find_highest(&rasters->maps[i], &highest) || any;
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

/* The pixels of a map, or of the bar beside it. */
static bool raster_paint(const struct raster_page *page, const struct raster_map *map,
                         struct arena *arena, struct text *file, struct error *error)
{
    const struct rasters *rasters = page->rasters;
    const size_t width = map != NULL ? map->size : 1;
    struct image image = {
        .width = width, .height = map != NULL ? map->size : BAR_STEPS, .channels = CHANNELS};
    const struct image_way way = {.bits = 8, .values = IMAGE_LIGHT};
    double own = 0;
    if (!image_new(&image, arena, error)) {
        return false;
    }
    if (map != NULL && rasters->own_scale) {
        find_highest(map, &own);
    }
    for (size_t i = 0; i < image.width * image.height; i++) {
        const size_t row = image.height - 1 - i / width;
        double share = ((double)row + 0.5) / BAR_STEPS, colour[3];
        if (map != NULL) {
            const double value = map->values[row * width + i % width] / (own > 0 ? own : 1);
            share = (raster_scaled(rasters, value) - page->low) / (page->high - page->low);
            share = isnan(value) ? (double)NAN : share;
        }
        palette_scale(rasters->colours == RASTER_SIGNED, isnan(share) ? 0 : share, colour);
        float *pixel = image.pixels + CHANNELS * i;
        bool is_there = !isnan(share);
        for (int k = 0; k < 3; k++) {
            pixel[k] = (float)(is_there ? srgb_light(colour[k]) : 1);
        }
        pixel[3] = is_there ? 1 : 0;
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
            const char *text = is_log ? arena_printf(svg->arena, "1e%.0f", value)
                                      : ticks_text(svg->arena, &ticks, i);
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

static bool draw_map(const struct raster_page *page, size_t i, struct error *error)
{
    const struct rasters *rasters = page->rasters;
    const struct raster_map *map = &rasters->maps[i];
    struct text png;
    const double x = LEFT + ACROSS * (double)(i % rasters->columns);
    const double y = TOP + DOWN * (double)(i / rasters->columns);
    if (!raster_paint(page, map, page->svg->arena, &png, error)) {
        return false;
    }
    svg_styled_rect(page->svg, &nothing, x, y, SIDE, SIDE);
    svg_image(page->svg, x, y, SIDE, SIDE, png);
    svg_styled_rect(page->svg, &frame, x, y, SIDE, SIDE);
    raster_draw_axis(page->svg, -map->half, map->half, x, y + SIDE, SIDE, 0, false);
    raster_draw_axis(page->svg, -map->half, map->half, x, y + SIDE, SIDE, -1, false);
    raster_write_text(page, x + SIDE / 2, y - 10, 13, SVG_MIDDLE, map->title);
    raster_write_text(page, x + SIDE / 2, y + SIDE + 34, 12, SVG_MIDDLE, rasters->x_label);
    svg_words_upwards(page->svg, x - 48, y + SIDE / 2, 12, rasters->y_label);
    raster_write_text(page, x + SIDE / 2, y + SIDE + 54, 12, SVG_MIDDLE, map->note);
    return true;
}

bool rasters_draw(const struct rasters *rasters, struct svg *svg, struct error *error)
{
    struct raster_page page = {.rasters = rasters, .svg = svg};
    if (rasters->count > RASTER_MAPS_MOST) {
        return fail(error, ERROR_USAGE, "a page has room for %d maps, not for %zu",
                    RASTER_MAPS_MOST, rasters->count);
    }
    if (!raster_find_scale(rasters, &page.low, &page.high, error)) {
        return false;
    }
    const size_t columns = rasters->count < rasters->columns ? rasters->count : rasters->columns;
    const size_t rows = (rasters->count + rasters->columns - 1) / rasters->columns;
    const double bar = LEFT + ACROSS * (double)(columns - 1) + SIDE + BAR_GAP;
    const char *const above = rasters->title != NULL ? rasters->title : "";
    const char *const below = rasters->subtitle != NULL ? rasters->subtitle : "";
    const double room =
        fmin(fmax(svg_text_width(above, TITLE_SIZE) / BOLDER, svg_text_width(below, SUBTITLE_SIZE)),
             TITLES_MOST) +
        1;
    const double width = fmax(bar + BAR_ROOM, room + 2 * MARGIN);
    svg_begin(svg, width, TOP + DOWN * (double)rows - 30 + BOTTOM, rasters->title);
    svg_heading(svg, MARGIN, 32, TITLE_SIZE, BOLDER * (width - 2 * MARGIN), above);
    svg_subheading(svg, MARGIN, 54, SUBTITLE_SIZE, width - 2 * MARGIN, below);
    for (size_t i = 0; i < rasters->count; i++) {
        if (!draw_map(&page, i, error)) {
            return false;
        }
    }
    /* the scale of colours beside them */
    struct text png;
    if (!raster_paint(&page, NULL, svg->arena, &png, error)) {
        return false;
    }
    svg_image(svg, bar, TOP, BAR_WIDTH, SIDE, png);
    svg_styled_rect(svg, &frame, bar, TOP, BAR_WIDTH, SIDE);
    raster_draw_axis(svg, page.low, page.high, bar + BAR_WIDTH, TOP + SIDE, SIDE, 1,
                     rasters->colours == RASTER_LOG);
    svg_words_upwards(svg, bar + BAR_WIDTH + 62, TOP + SIDE / 2, 12, rasters->scale_label);
    svg_end(svg);
    return true;
}

bool raster_png(const struct rasters *rasters, size_t map, struct arena *arena, struct text *file,
                struct error *error)
{
    struct raster_page page = {.rasters = rasters};
    return raster_find_scale(rasters, &page.low, &page.high, error) &&
           raster_paint(&page, &rasters->maps[map], arena, file, error);
}
