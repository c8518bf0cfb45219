/* tone/operator.c - light of a scene to that of a display. */
/* SPDX-License-Identifier: MIT */
#include "tone/operator.h"

#include "base/image/bytes.h"
#include "tone/sight.h"

#include <math.h>

enum { CHANNELS = 3, STEPS_BITS = 8, FRACTION_BITS = 23 - STEPS_BITS };

/* Luminances from about 1e-6 to 1e12, by the bits of floats. */
static const float LOWEST = 0x1p-20F, HIGHEST = 0x1p40F;

/* h of the header. */
static double filmic(double x)
{
    static const double A = 0.15, B = 0.5, C = 0.1, D = 0.2, E = 0.02, F = 0.3;
    return (x * (A * x + C * B) + D * E) / (x * (A * x + B) + D * F) - E / F;
}

/* L_d of a luminance, or of a channel by itself; not yet cut to the display's most. */
static double shown(const struct tone_way *way, const struct toned *toned, double luminance)
{
    const double share = luminance / toned->white, most = way->display.most;
    switch (way->operation) {
    case TONE_LINEAR:
        return most * share;
    case TONE_GAMMA:
        return most * pow(share, 1 / way->gamma);
    case TONE_FILMIC:
        return most * filmic(FILMIC_WHITE * share) / filmic(FILMIC_WHITE);
    case TONE_WARD:
        break;
    }
    return histogram_shown(&toned->histogram, luminance);
}

/* A function of luminance as a table, of the upper bits of floats from LOWEST on. */
static float operator_look_up(const float *curve, float x)
{
    const float above = x > LOWEST ? x : LOWEST, held = above < HIGHEST ? above : HIGHEST;
    const uint32_t bits = bytes_bits(held), mask = (1U << FRACTION_BITS) - 1;
    const float *at = curve + ((bits >> FRACTION_BITS) - (bytes_bits(LOWEST) >> FRACTION_BITS));
    const float rest = (float)(bits & mask) * (1.0F / (float)(mask + 1));
    return at[0] + rest * (at[1] - at[0]);
}

/* Mixed with a grey of the same luminance so far that no channel is above the most or below 0. */
static void operator_fit(float pixel[CHANNELS], float luminance, float most)
{
    float room = 1;
    for (int k = 0; k < CHANNELS; k++) {
        const float beyond = pixel[k] - luminance;
        if (pixel[k] > most) {
            room = fminf(room, (most - luminance) / beyond);
        } else if (pixel[k] < 0) {
            room = fminf(room, -luminance / beyond);
        }
    }
    for (int k = 0; k < CHANNELS && room < 1; k++) {
        pixel[k] = luminance + room * (pixel[k] - luminance);
    }
}

static void show_pixel(const struct tone_way *way, struct toned *toned, const float *curve,
                       float pixel[CHANNELS])
{
    const float luminance = sight_luminance(pixel);
    const bool is_single = way->operation == TONE_FILMIC;
    const float most = way->as_light ? (float)way->display.most : 1;
    toned->clipped += (double)luminance > toned->white;
    if (!(luminance > LOWEST)) { /* blacker than anybody sees */
        const float black = way->as_light ? (float)way->display.least : 0;
        pixel[0] = pixel[1] = pixel[2] = black;
        return;
    }
    if (is_single) {
        for (int k = 0; k < CHANNELS; k++) {
            pixel[k] = operator_look_up(curve, pixel[k]);
        }
        return;
    }
    const float factor = operator_look_up(curve, luminance), made = factor * luminance;
    for (int k = 0; k < CHANNELS; k++) {
        pixel[k] *= factor;
    }
    operator_fit(pixel, made < most ? made : most, most);
}

/* What makes the mean by logarithms a middle grey, over that mean. */
static double white_of_mean(const struct tone_way *way)
{
    switch (way->operation) {
    case TONE_GAMMA:
        return pow(TONE_GREY, -way->gamma);
    case TONE_FILMIC:
        return FILMIC_WHITE / 2 / TONE_GREY;
    case TONE_LINEAR:
    case TONE_WARD:
        break;
    }
    return 1 / TONE_GREY;
}

static bool choose_white(const struct tone_way *way, const struct foveal *foveal,
                         struct toned *toned, struct error *error)
{
    toned->log_mean = exp(foveal_log_mean(foveal));
    toned->white = way->white;
    if (way->operation == TONE_WARD) {
        toned->white = INFINITY;
        return histogram_adjust(foveal, &way->display, way->ceiling, &toned->histogram, error);
    }
    if (!isnan(way->white)) {
        return true;
    }
    toned->white = toned->log_mean * white_of_mean(way);
    return toned->white > 0 ||
           fail(error, ERROR_DOMAIN, "all is darker than %g cd/m2: {white} cannot be chosen",
                SIGHT_LEAST);
}

bool tone_show(const struct tone_way *way, const struct foveal *foveal, struct image *image,
               struct arena *arena, struct toned *toned, struct error *error)
{
    *toned = (struct toned){.white = NAN};
    if (!choose_white(way, foveal, toned, error)) {
        return false;
    }
    /* per luminance, unless channels go by themselves */
    const uint32_t first = bytes_bits(LOWEST) >> FRACTION_BITS;
    const uint32_t last = bytes_bits(HIGHEST) >> FRACTION_BITS;
    const bool is_single = way->operation == TONE_FILMIC;
    const struct display *display = &way->display;
    float *values = ARENA_ARRAY(arena, last - first + 2, float);
    for (uint32_t i = first; i <= last + 1; i++) {
        const double luminance = (double)bytes_float(i << FRACTION_BITS);
        const double cut = fmin(fmax(shown(way, toned, luminance), display->least), display->most);
        const double light =
            way->as_light ? cut : (cut - display->least) / (display->most - display->least);
        values[i - first] = (float)(light / (is_single ? 1 : luminance));
    }
    for (size_t i = 0; i < image->width * image->height; i++) {
        show_pixel(way, toned, values, image->pixels + CHANNELS * i);
    }
    return true;
}
