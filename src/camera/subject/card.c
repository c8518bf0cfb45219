/* camera/subject/card.c - the light of charts and of pictures. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/card.h"

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

/* A star in each square of the width: in squares from the corner of its own, and its light. */
struct star {
    double x, y, light;
};
static const double star_squares = 24, star_radius = 24.0 / 400;

static struct star star_in(double column, double row)
{
    const uint64_t which =
        (uint64_t)((int64_t)column + 4096) << 32 | (uint32_t)((int64_t)row + 4096);
    const struct random_words words = random_words(RANDOM_STARS, 0, which, 0);
    /* far enough from the sides to be whole */
    const double room = 1 - 2 * star_radius, per_word = 0x1p-32;
    return (struct star){star_radius + room * per_word * words.w[0],
                         star_radius + room * per_word * words.w[1],
                         pow(10, -0.4 * CHART_MAGNITUDES * sqrt(per_word * words.w[2]))};
}

static double star_light(double x, double y)
{
    const double column = floor(star_squares * x), row = floor(star_squares * y);
    const struct star star = star_in(column, row);
    const double away = hypot(star_squares * x - column - star.x, star_squares * y - row - star.y);
    return away < star_radius ? star.light : 0;
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
        return fabs(from_multiple(CHART_MESHES * x)) < CHART_GRID_HALF ||
                       fabs(from_multiple(CHART_MESHES * y)) < CHART_GRID_HALF
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

/* One that there is. */
static size_t card_clamped(long at, size_t count)
{
    if (at < 0) {
        return 0;
    }
    if (at >= (long)count) {
        return count - 1;
    }
    return (size_t)at;
}

struct card_light card_look(const struct card *card, double x, double y)
{
    if (!(fabs(x) <= card->width / 2 && fabs(y) <= card->height / 2)) {
        return (struct card_light){{0, 0, 0}};
    }
    if (card->chart == CHART_NONE) {
        const struct image *image = card->picture;
        /* one pixel on, so that none is below 0: rounded down without a call of floor */
        const double column = (x / card->width + 0.5) * (double)image->width + 0.5;
        const double row = (0.5 - y / card->height) * (double)image->height + 0.5;
        const long left = (long)column - 1, above = (long)row - 1;
        const float right = (float)(column - 1 - (double)left),
                    down = (float)(row - 1 - (double)above);
        const size_t step = image->channels < CARD_CHANNELS ? 0 : 1;
        const size_t begin = card_clamped(left, image->width) * image->channels;
        const size_t end = card_clamped(left + 1, image->width) * image->channels;
        const float *upper = image_row(image, card_clamped(above, image->height));
        const float *lower = image_row(image, card_clamped(above + 1, image->height));
        struct card_light light;
        for (size_t k = 0; k < CARD_CHANNELS; k++) {
            const float a = upper[begin + k * step], b = upper[end + k * step];
            const float c = lower[begin + k * step], d = lower[end + k * step];
            const float from = a + right * (b - a), to = c + right * (d - c);
            light.of[k] = from + down * (to - from);
        }
        return light;
    }
    const float light = (float)chart_light(card->chart, x / card->width, y / card->width,
                                           card->height / card->width / 2);
    return (struct card_light){{light, light, light}};
}

/* -------- where it is the same -------- */

/* How far an interval is from the nearest whole number; 0: one lies in it. */
static double from_whole(double low, double high)
{
    return floor(high) >= ceil(low) ? 0 : fmin(low - floor(low), ceil(high) - high);
}

/* How far a point lies from an interval. */
static double from_interval(double x, double low, double high)
{
    return fmax(0, fmax(low - x, x - high));
}

static bool has_stars(const double low[2], const double high[2])
{
    enum { MOST = 64 };
    const double column = floor(star_squares * low[0]), row = floor(star_squares * low[1]);
    const double columns = floor(star_squares * high[0]) - column + 1;
    const double rows = floor(star_squares * high[1]) - row + 1;
    for (int i = 0; i < MOST && i < columns * rows; i++) {
        const double x = column + fmod(i, columns), y = row + floor(i / columns);
        const struct star star = star_in(x, y);
        const double dx = from_interval(x + star.x, star_squares * low[0], star_squares * high[0]);
        const double dy = from_interval(y + star.y, star_squares * low[1], star_squares * high[1]);
        if (hypot(dx, dy) <= star_radius) {
            return true;
        }
    }
    return columns * rows > MOST;
}

/* In widths of the card, from its middle. */
static bool is_chart_even(enum chart chart, const double low[2], const double high[2], double half)
{
    const double left = low[0] + 0.5, right = high[0] + 0.5;
    const double x = from_whole(CHART_MESHES * low[0], CHART_MESHES * high[0]);
    const double y = from_whole(CHART_MESHES * low[1], CHART_MESHES * high[1]);
    const double bars = CHART_BARS_LEAST * exp2(floor(CHART_GROUPS * left)), beside = 1e-9;
    switch (chart) {
    case CHART_EDGE: /* a half plane that holds all corners or none */
        return (chart_light(chart, low[0], high[1], half) > 0.5) ==
               (chart_light(chart, high[0], low[1], half) > 0.5);
    case CHART_STAR:
        return hypot(from_interval(0, low[0], high[0]), from_interval(0, low[1], high[1])) >
               2 * CHART_STAR_RADIUS * half;
    case CHART_GRID:
        return x > CHART_GRID_HALF + beside && y > CHART_GRID_HALF + beside;
    case CHART_CHECKER:
        return x > beside && y > beside;
    case CHART_BARS: /* twice a cycle one ends: within a group at whole numbers */
        return from_whole(CHART_GROUPS * left, CHART_GROUPS * right) > beside &&
               from_whole(2 * bars * left, 2 * bars * right) > beside;
    case CHART_WEDGE:
        return from_whole(CHART_WEDGE_FIELDS * left, CHART_WEDGE_FIELDS * right) > beside;
    case CHART_POINTS:
        return hypot(x, y) > CHART_MESHES / 400.0 + beside;
    case CHART_STARS:
        return !has_stars(low, high);
    default:
        return false;
    }
}

static const float *pixel(const struct image *image, long column, long row)
{
    return image_row(image, card_clamped(row, image->height)) +
           card_clamped(column, image->width) * image->channels;
}

static bool is_picture_even(const struct card *card, const struct card_part *part)
{
    static const double most = 65536; /* pixels to look at */
    const struct image *image = card->picture;
    const double columns = (double)image->width, rows = (double)image->height;
    const long left = (long)floor((part->low[0] / card->width + 0.5) * columns - 0.5);
    const long right = (long)floor((part->high[0] / card->width + 0.5) * columns + 0.5);
    const long above = (long)floor((0.5 - part->high[1] / card->height) * rows - 0.5);
    const long below = (long)floor((0.5 - part->low[1] / card->height) * rows + 0.5);
    if ((double)(right - left + 1) * (double)(below - above + 1) > most) {
        return false;
    }
    for (long y = above; y <= below; y++) {
        for (long x = left; x <= right; x++) {
            for (size_t k = 0; k < image->channels && k < CARD_CHANNELS; k++) {
                if (pixel(image, x, y)[k] != pixel(image, left, above)[k]) {
                    return false;
                }
            }
        }
    }
    return true;
}

bool card_is_even(const struct card *card, const struct card_part *part, struct card_light *light)
{
    const double w = card->width, half[2] = {w / 2, card->height / 2};
    double low[2], high[2];
    bool is_beside = false, is_within = true;
    for (int k = 0; k < 2; k++) {
        low[k] = part->low[k] / w;
        high[k] = part->high[k] / w;
        is_beside = is_beside || part->low[k] > half[k] || part->high[k] < -half[k];
        is_within = is_within && part->low[k] >= -half[k] && part->high[k] <= half[k];
    }
    *light =
        card_look(card, (part->low[0] + part->high[0]) / 2, (part->low[1] + part->high[1]) / 2);
    return is_beside || (is_within && (card->chart == CHART_NONE
                                           ? is_picture_even(card, part)
                                           : is_chart_even(card->chart, low, high, half[1] / w)));
}
