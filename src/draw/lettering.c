/* draw/lettering.c - numbers written in pictures, from outlines. */
/* SPDX-License-Identifier: MIT */
#include "draw/lettering.h"

#include "base/constants.h"
#include "base/text.h"

#include <math.h>
#include <string.h>

/* Heights of a digit: how wide a stroke is, and at least in px; the room between two letters. */
static const double STROKE = 0.11, STROKE_LEAST = 1.1, SPACE = 0.16;

/* An arc of an ellipse, from one angle to another, degrees, clockwise from the right. */
struct letter_arc {
    double x, y, across, down, from, to;
};

/* A straight line. */
struct letter_line {
    double x1, y1, x2, y2;
};

enum { ARCS_MOST = 2, LINES_MOST = 3 };

/* In heights of a digit, y down from the base line. */
struct letter_shape {
    const char *letter; /* in UTF-8 */
    double width;
    struct letter_arc arcs[ARCS_MOST]; /* those of no size are none */
    struct letter_line lines[LINES_MOST];
};

static const struct letter_shape shapes[] = {
    {.letter = "0", .width = 0.6, .arcs = {{0.3, -0.5, 0.28, 0.5, 0, 360}}},
    {.letter = "1", .width = 0.42, .lines = {{0.06, -0.8, 0.32, -1}, {0.32, -1, 0.32, 0}}},
    {.letter = "2",
     .width = 0.58,
     .arcs = {{0.3, -0.72, 0.26, 0.28, 180, 400}},
     .lines = {{0.499, -0.54, 0.04, 0}, {0.04, 0, 0.56, 0}}},
    {.letter = "3",
     .width = 0.57,
     .arcs = {{0.28, -0.74, 0.24, 0.26, 200, 450}, {0.27, -0.24, 0.28, 0.24, 270, 520}}},
    {.letter = "4",
     .width = 0.6,
     .lines = {{0.42, 0, 0.42, -1}, {0.42, -1, 0.02, -0.3}, {0.02, -0.3, 0.58, -0.3}}},
    {.letter = "5",
     .width = 0.57,
     .arcs = {{0.28, -0.32, 0.28, 0.32, 228, 510}},
     .lines = {{0.5, -1, 0.12, -1}, {0.12, -1, 0.092, -0.558}}},
    {.letter = "6",
     .width = 0.58,
     .arcs = {{0.3, -0.32, 0.27, 0.32, 0, 360}, {0.53, -0.36, 0.5, 0.62, 180, 262}}},
    {.letter = "7", .width = 0.58, .lines = {{0.04, -1, 0.56, -1}, {0.56, -1, 0.2, 0}}},
    {.letter = "8",
     .width = 0.6,
     .arcs = {{0.3, -0.75, 0.23, 0.25, 0, 360}, {0.3, -0.25, 0.28, 0.25, 0, 360}}},
    {.letter = "9",
     .width = 0.58,
     .arcs = {{0.3, -0.68, 0.27, 0.32, 0, 360}, {0.07, -0.64, 0.5, 0.62, 0, 82}}},
    {.letter = ".", .width = 0.12, .arcs = {{0.06, -0.02, 0.02, 0.02, 0, 360}}},
    {.letter = "-", .width = 0.52, .lines = {{0.04, -0.42, 0.5, -0.42}}},
    {.letter = "+",
     .width = 0.56,
     .lines = {{0.04, -0.42, 0.52, -0.42}, {0.28, -0.66, 0.28, -0.18}}},
    {.letter = "/", .width = 0.4, .lines = {{0, 0.08, 0.38, -1.04}}},
    {.letter = "c", .width = 0.5, .arcs = {{0.29, -0.34, 0.26, 0.34, 45, 315}}},
    {.letter = "d",
     .width = 0.54,
     .arcs = {{0.27, -0.34, 0.25, 0.34, 0, 360}},
     .lines = {{0.52, -1.02, 0.52, 0}}},
    {.letter = "e",
     .width = 0.56,
     .arcs = {{0.29, -0.34, 0.26, 0.34, 40, 360}},
     .lines = {{0.03, -0.34, 0.55, -0.34}}},
    {.letter = "m",
     .width = 0.82,
     .arcs = {{0.235, -0.44, 0.185, 0.24, 180, 360}, {0.605, -0.44, 0.185, 0.24, 180, 360}},
     .lines = {{0.05, -0.68, 0.05, 0}, {0.42, -0.44, 0.42, 0}, {0.79, -0.44, 0.79, 0}}},
    {.letter = "²",
     .width = 0.32,
     .arcs = {{0.165, -0.9, 0.145, 0.155, 180, 400}},
     .lines = {{0.276, -0.8, 0.02, -0.5}, {0.02, -0.5, 0.31, -0.5}}},
};

/* The shape of the letter that begins a text, which goes on behind it; null: there is none. */
static const struct letter_shape *take_shape(const char **text)
{
    const size_t length = text_utf8_length(*text, strlen(*text));
    const struct letter_shape *found = NULL;
    for (size_t i = 0; i < sizeof shapes / sizeof shapes[0] && found == NULL; i++) {
        const char *letter = shapes[i].letter;
        found = strlen(letter) == length && memcmp(letter, *text, length) == 0 ? &shapes[i] : NULL;
    }
    *text += length > 0 ? length : 1;
    return found;
}

double lettering_width(const char *text, double height)
{
    double width = 0;
    while (*text != '\0') {
        const struct letter_shape *shape = take_shape(&text);
        width += shape != NULL ? (shape->width + SPACE) * height : 0;
    }
    return fmax(0, width - SPACE * height);
}

/* Distance of a point from a line. */
static double line_distance(const struct letter_line *line, double x, double y)
{
    const double across = line->x2 - line->x1, down = line->y2 - line->y1;
    const double square = across * across + down * down;
    double part = square > 0 ? ((x - line->x1) * across + (y - line->y1) * down) / square : 0;
    part = fmin(fmax(part, 0), 1);
    return hypot(x - line->x1 - part * across, y - line->y1 - part * down);
}

/* The same from a line of a letter. */
static double stroke_distance(const struct letter_shape *shape, double x, double y)
{
    enum { STEPS = 32 };
    double nearest = INFINITY;
    for (size_t i = 0; i < LINES_MOST; i++) {
        const struct letter_line *line = &shape->lines[i];
        if (line->x1 < line->x2 || line->x1 > line->x2 || line->y1 < line->y2 ||
            line->y1 > line->y2) {
            nearest = fmin(nearest, line_distance(line, x, y));
        }
    }
    for (size_t i = 0; i < ARCS_MOST; i++) {
        const struct letter_arc *arc = &shape->arcs[i];
        struct letter_line chord = {0};
        for (int k = 0; k <= STEPS && arc->across > 0; k++) {
            const double turn =
                RADIANS_PER_DEGREE * (arc->from + (arc->to - arc->from) * k / STEPS);
            chord.x1 = chord.x2;
            chord.y1 = chord.y2;
            chord.x2 = arc->x + arc->across * cos(turn);
            chord.y2 = arc->y + arc->down * sin(turn);
            if (k > 0) {
                nearest = fmin(nearest, line_distance(&chord, x, y));
            }
        }
    }
    return nearest;
}

static void letter_write(struct image *image, double x, double y, double height,
                         const struct letter_shape *shape)
{
    const double half = fmax(STROKE * height, STROKE_LEAST) / 2;
    const double left = fmax(0, floor(x - half - 1)), top = fmax(0, floor(y - 1.1 * height - 1));
    const double right = x + shape->width * height + half + 1, bottom = y + 0.2 * height + 1;
    for (size_t v = (size_t)top; v < image->height && (double)v < bottom; v++) {
        for (size_t u = (size_t)left; u < image->width && (double)u < right; u++) {
            const double away = height * stroke_distance(shape, ((double)u + 0.5 - x) / height,
                                                         ((double)v + 0.5 - y) / height);
            const float covered = (float)fmin(fmax(half - away + 0.5, 0), 1);
            float *pixel = image_row(image, v) + u * image->channels;
            for (size_t k = 0; k < image->channels; k++) {
                pixel[k] += covered * (1 - pixel[k]);
            }
        }
    }
}

void lettering_write(struct image *image, double x, double y, double height, const char *text)
{
    while (*text != '\0') {
        const struct letter_shape *shape = take_shape(&text);
        if (shape != NULL) {
            letter_write(image, x, y, height, shape);
            x += (shape->width + SPACE) * height;
        }
    }
}
