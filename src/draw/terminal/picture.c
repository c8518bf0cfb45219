/* draw/terminal/picture.c - pictures on a terminal: half blocks, sixels, kitty's graphics. */
/* SPDX-License-Identifier: MIT */
#include "draw/terminal/picture.h"

#include "base/base64.h"
#include "base/image/srgb.h"

#include <math.h>
#include <string.h>

enum { CHANNELS = 3 };

/* -------- smaller pictures -------- */

/* What a pixel adds to a mean, as light; transparency lets white through. */
static void pixel_add(const struct image *image, const float *pixel, double weight, double *sum)
{
    const bool has_alpha = image->channels % 2 == 0;
    const double alpha = has_alpha ? (double)pixel[image->channels - 1] : 1;
    for (size_t k = 0; k < CHANNELS; k++) {
        const double light = (double)pixel[image->channels < CHANNELS ? 0 : k];
        sum[k] += weight * (alpha * light + 1 - alpha);
    }
}

/*
 * A picture of another size, each pixel the mean of the light that it covers, encoded as sRGB.
 *
 * Given     small  its width and height; receives pixels of three channels
 */
static bool picture_resize(const struct image *image, struct arena *arena, struct image *small,
                           struct error *error)
{
    small->channels = CHANNELS;
    if (!image_new(small, arena, error)) {
        return false;
    }
    const double across = (double)image->width / (double)small->width;
    const double down = (double)image->height / (double)small->height;
    for (size_t v = 0; v < small->height; v++) {
        const double top = (double)v * down, bottom = top + down;
        for (size_t u = 0; u < small->width; u++) {
            const double left = (double)u * across, right = left + across;
            double sum[CHANNELS] = {0};
            for (size_t y = (size_t)top; y < image->height && (double)y < bottom; y++) {
                const double high = fmin((double)y + 1, bottom) - fmax((double)y, top);
                for (size_t x = (size_t)left; x < image->width && (double)x < right; x++) {
                    const double wide = fmin((double)x + 1, right) - fmax((double)x, left);
                    pixel_add(image, image_row(image, y) + x * image->channels, high * wide, sum);
                }
            }
            float *pixel = image_row(small, v) + u * CHANNELS;
            for (size_t k = 0; k < CHANNELS; k++) {
                const double light = fmin(fmax(sum[k] / (across * down), 0), 1);
                pixel[k] = (float)srgb_encoded(light);
            }
        }
    }
    return true;
}

/* Floyd and Steinberg: hand what rounding changed to the neighbours that are yet to come. */
static void diffuse_error(struct image *image, size_t x, size_t y, size_t channel, double off)
{
    static const struct {
        int x, y;
        double share;
    } shares[] = {{1, 0, 7.0 / 16}, {-1, 1, 3.0 / 16}, {0, 1, 5.0 / 16}, {1, 1, 1.0 / 16}};
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        const size_t column = x + (size_t)shares[i].x, row = y + (size_t)shares[i].y;
        if (column < image->width && row < image->height) {
            float *value = image_row(image, row) + column * image->channels + channel;
            *value = (float)((double)*value + shares[i].share * off);
        }
    }
}

/* -------- blocks -------- */

/* Rows of the screen that the line behind the picture and the one before it leave. */
static size_t view_rows(const struct page_view *view)
{
    enum { AROUND = 2, LEAST = 10 };
    return view->rows > LEAST + AROUND ? view->rows - AROUND : 0;
}

static unsigned char value_code(float value)
{
    return (unsigned char)lround(255 * fmin(fmax((double)value, 0), 1));
}

static void draw_half_blocks(const struct image *small, struct cells *cells)
{
    for (size_t y = 0; y < small->height; y++) {
        for (size_t x = 0; x < small->width; x++) {
            struct cell *cell = cells_at(cells, (long)x, (long)(y / 2));
            const float *pixel = image_row(small, y) + x * CHANNELS;
            cell->is_painted = true;
            for (size_t k = 0; k < CHANNELS; k++) {
                (y % 2 == 0 ? cell->upper : cell->lower)[k] = value_code(pixel[k]);
            }
        }
    }
}

static void draw_dither(struct image *small, struct cells *cells)
{
    static const double weights[] = {0.2126, 0.7152, 0.0722};
    for (size_t y = 0; y < small->height; y++) {
        for (size_t x = 0; x < small->width; x++) {
            float *pixel = image_row(small, y) + x * CHANNELS;
            double light = 0;
            for (size_t k = 0; k < CHANNELS; k++) {
                light += weights[k] * srgb_light((double)pixel[k]);
            }
            pixel[0] = (float)srgb_encoded(light);
        }
    }
    for (size_t y = 0; y < small->height; y++) {
        for (size_t x = 0; x < small->width; x++) {
            const double value = (double)image_row(small, y)[x * CHANNELS];
            const bool is_set = value >= 0.5;
            diffuse_error(small, x, y, 0, value - (is_set ? 1 : 0));
            cells_dot(cells, (long)x, (long)y, is_set, NULL);
        }
    }
}

bool picture_blocks(const struct image *image, const struct page_view *view, struct arena *arena,
                    struct text_buffer *lines, struct error *error)
{
    const bool is_plain = view->colours == CELL_PLAIN;
    const size_t across = is_plain ? DOTS_ACROSS : 1, down = is_plain ? DOTS_DOWN : 2;
    const double proportion = image_proportion(image);
    const size_t rows = view_rows(view);
    double columns = (double)view->columns;
    if (rows > 0) {
        columns =
            fmin(columns, 2 * (double)rows * proportion); /* a cell is twice as high as wide */
    }
    struct image small = {.width = (size_t)fmax(1, floor(columns)) * across};
    const double high = (double)small.width / (double)across / proportion / 2 * (double)down;
    small.height = (size_t)fmax(1, round(high));
    struct cells cells;
    if (!picture_resize(image, arena, &small, error)) {
        return false;
    }
    cells_new(&cells, small.width / across, (small.height + down - 1) / down, view->colours, arena);
    if (is_plain) {
        draw_dither(&small, &cells);
    } else {
        draw_half_blocks(&small, &cells);
    }
    cells_put(&cells, lines);
    return true;
}

/* -------- sixels -------- */

enum { LEVELS = 6, COLOURS = LEVELS * LEVELS * LEVELS, BAND = 6 };

/* The numbers of the colours of the pixels. */
static unsigned char *sixel_colours(struct image *small, struct arena *arena)
{
    unsigned char *numbers = arena_buffer_array(arena, small->width * small->height, 1);
    for (size_t y = 0; y < small->height; y++) {
        for (size_t x = 0; x < small->width; x++) {
            unsigned number = 0;
            for (size_t k = 0; k < CHANNELS; k++) {
                const double value = (double)image_row(small, y)[x * CHANNELS + k];
                const double level = round(fmin(fmax(value, 0), 1) * (LEVELS - 1));
                diffuse_error(small, x, y, k, value - level / (LEVELS - 1));
                number = number * LEVELS + (unsigned)level;
            }
            numbers[y * small->width + x] = (unsigned char)number;
        }
    }
    return numbers;
}

/* A row of sixels of one colour, those that are alike as a number and one of them. */
static void sixel_put_row(struct text_buffer *lines, const char *row, size_t width)
{
    enum { FEW = 3 };
    while (width > 0 && row[width - 1] == '?') {
        width--; /* nothing at the end */
    }
    for (size_t i = 0, same; i < width; i += same) {
        same = 1;
        while (i + same < width && row[i + same] == row[i]) {
            same++;
        }
        if (same > FEW) {
            growing_format(lines, "!%zu%c", same, row[i]);
        } else {
            growing_put(lines, row + i, same);
        }
    }
}

/* Six rows of pixels: for each colour in them a row of sixels. */
static void sixel_put_band(struct text_buffer *lines, const unsigned char *numbers, size_t width,
                           size_t height, char *row)
{
    bool has[COLOURS] = {false};
    bool any = false;
    for (size_t i = 0; i < width * height; i++) {
        has[numbers[i]] = true;
    }
    for (size_t c = 0; c < COLOURS; c++) {
        if (!has[c]) {
            continue;
        }
        for (size_t x = 0; x < width; x++) {
            int bits = 0;
            for (size_t y = 0; y < height; y++) {
                bits |= (numbers[y * width + x] == c) << y;
            }
            row[x] = (char)('?' + bits);
        }
        growing_format(lines, "%s#%zu", any ? "$" : "", c);
        sixel_put_row(lines, row, width);
        any = true;
    }
    growing_string(lines, "-");
}

bool picture_sixel(const struct image *image, size_t width, struct arena *arena,
                   struct text_buffer *lines, struct error *error)
{
    const double high = (double)width / image_proportion(image);
    struct image small = {.width = width, .height = (size_t)fmax(1, round(high))};
    if (!picture_resize(image, arena, &small, error)) {
        return false;
    }
    const unsigned char *numbers = sixel_colours(&small, arena);
    char *row = arena_buffer(arena, width);
    /* pixels are squares; what is not drawn stays as it is */
    growing_format(lines, "\033P0;1;0q\"1;1;%zu;%zu", small.width, small.height);
    for (int c = 0; c < COLOURS; c++) {
        const int percent = 100 / (LEVELS - 1);
        growing_format(lines, "#%d;2;%d;%d;%d", c, percent * (c / (LEVELS * LEVELS)),
                       percent * (c / LEVELS % LEVELS), percent * (c % LEVELS));
    }
    for (size_t y = 0; y < small.height; y += BAND) {
        const size_t left = small.height - y;
        sixel_put_band(lines, numbers + y * small.width, small.width, left < BAND ? left : BAND,
                       row);
    }
    growing_string(lines, "\033\\\n");
    return true;
}

/* -------- kitty -------- */

void picture_kitty(struct text png, size_t columns, struct text_buffer *lines)
{
    enum { PIECE = 3072 }; /* bytes, 4096 letters */
    for (size_t at = 0; at < png.length; at += PIECE) {
        const size_t length = png.length - at < PIECE ? png.length - at : PIECE;
        const int more = at + length < png.length;
        if (at > 0) {
            growing_format(lines, "\033_Gm=%d;", more);
        } else if (columns > 0) {
            growing_format(lines, "\033_Ga=T,f=100,q=2,c=%zu,m=%d;", columns, more);
        } else {
            growing_format(lines, "\033_Ga=T,f=100,q=2,m=%d;", more);
        }
        for (size_t i = 0; i < length; i += 3) {
            char four[4];
            base64_letters((struct text){png.start + at, length}, i, four);
            growing_put(lines, four, sizeof four);
        }
        growing_string(lines, "\033\\");
    }
    growing_string(lines, "\n");
}
