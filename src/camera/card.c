/* camera/card.c - the light of charts and of pictures. */
/* SPDX-License-Identifier: MIT */
#include "camera/card.h"

#include "base/constants.h"
#include "base/random.h"

#include <math.h>

const struct word charts[] = {
    {"edge", "a slanted edge through the middle"},
    {"star", "36 cycles about the middle"},
    {"grid", "black lines on white"},
    {"checker", "squares of 1/12 of the width"},
    {"bars", "5 to 160 cycles over the width"},
    {"wedge", "21 greys half a stop apart"},
    {"points", "white discs on black"},
    {"stars", "discs here and there, of magnitudes 0 to 5"},
    {NULL, NULL},
};

/* How far from the nearest multiple, in multiples: -0.5 to 0.5. */
static double from_multiple(double x)
{
    return x - round(x);
}

/* A star in every square, far enough from its sides to be whole. */
static double star_light(double x, double y)
{
    static const double squares = 24, radius = 24.0 / 400;
    const double column = floor(squares * x), row = floor(squares * y);
    const uint64_t which =
        (uint64_t)((int64_t)column + 4096) << 32 | (uint32_t)((int64_t)row + 4096);
    const struct random_words words = random_words(RANDOM_STARS, 0, which, 0);
    const double room = 1 - 2 * radius, per_word = 0x1p-32;
    const double at_x = radius + room * per_word * words.w[0];
    const double at_y = radius + room * per_word * words.w[1];
    const bool is_inside = hypot(squares * x - column - at_x, squares * y - row - at_y) < radius;
    return is_inside ? pow(10, -0.4 * CHART_MAGNITUDES * sqrt(per_word * words.w[2])) : 0;
}

/*
 * Of charts whose light is one number.
 *
 * Given     x, y  in widths of the card, from its middle
 *           half  its height, halved, in the same
 */
static double chart_light(enum chart chart, double x, double y, double half)
{
    switch (chart) {
    case CHART_EDGE:
        return x < y * tan(CHART_EDGE_DEGREES * RADIANS_PER_DEGREE) ? 1 : CHART_EDGE_DARK;
    case CHART_STAR:
        return hypot(x, y) < 2 * CHART_STAR_RADIUS * half &&
                       sin(CHART_STAR_CYCLES * atan2(y, x)) < 0
                   ? 0
                   : 1;
    case CHART_GRID:
        return fabs(from_multiple(CHART_MESHES * x)) < 0.025 ||
                       fabs(from_multiple(CHART_MESHES * y)) < 0.025
                   ? 0
                   : 1;
    case CHART_CHECKER:
        return fmod(floor(CHART_MESHES * x) + floor(CHART_MESHES * y) + 1000, 2);
    case CHART_BARS:
        return from_multiple(CHART_BARS_LEAST * exp2(floor(CHART_GROUPS * (x + 0.5))) * (x + 0.5)) <
                       0
                   ? 1
                   : 0;
    case CHART_WEDGE:
        return exp2(-0.5 * floor(CHART_WEDGE_FIELDS * (x + 0.5)));
    case CHART_POINTS:
        return hypot(from_multiple(CHART_MESHES * x), from_multiple(CHART_MESHES * y)) <
                       CHART_MESHES / 400.0
                   ? 1
                   : 0;
    case CHART_STARS:
        return star_light(x, y);
    default:
        return 0;
    }
}

/* A channel of a pixel; those beyond the edge are as those on it. */
static float pixel(const struct image *image, long column, long row, size_t channel)
{
    const long last_x = (long)image->width - 1, last_y = (long)image->height - 1;
    column = column < 0 ? 0 : column > last_x ? last_x : column;
    row = row < 0 ? 0 : row > last_y ? last_y : row;
    return image_row(image, (size_t)row)[(size_t)column * image->channels + channel];
}

static struct card_light picture_light(const struct card *card, double x, double y)
{
    const struct image *image = card->picture;
    const double column = (x / card->width + 0.5) * (double)image->width - 0.5;
    const double row = (0.5 - y / card->height) * (double)image->height - 0.5;
    const long left = (long)floor(column), above = (long)floor(row);
    const float right = (float)(column - (double)left), down = (float)(row - (double)above);
    struct card_light light;
    for (size_t k = 0; k < 3; k++) {
        const size_t channel = image->channels < 3 ? 0 : k;
        const float a = pixel(image, left, above, channel);
        const float b = pixel(image, left + 1, above, channel);
        const float c = pixel(image, left, above + 1, channel);
        const float d = pixel(image, left + 1, above + 1, channel);
        const float upper = a + right * (b - a), lower = c + right * (d - c);
        light.of[k] = upper + down * (lower - upper);
    }
    return light;
}

struct card_light card_look(const struct card *card, double x, double y)
{
    if (!(fabs(x) <= card->width / 2 && fabs(y) <= card->height / 2)) {
        return (struct card_light){{0, 0, 0}};
    }
    if (card->chart == CHART_NONE) {
        return picture_light(card, x, y);
    }
    const float light = (float)chart_light(card->chart, x / card->width, y / card->width,
                                           card->height / card->width / 2);
    return (struct card_light){{light, light, light}};
}
