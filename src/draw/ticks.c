/* draw/ticks.c - round numbers along an axis, and how they are written. */
/* SPDX-License-Identifier: MIT */
#include "draw/ticks.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/number.h"
#include "draw/svg.h"

void ticks_widen(double *low, double *high)
{
    double size = fmax(fabs(*low), fabs(*high));
    if (*high - *low > 1e-9 * size) {
        return;
    }
    double margin = size > 0 ? 0.1 * size : 1;
    *low -= margin;
    *high += margin;
}

void ticks_linear(double low, double high, struct ticks *ticks)
{
    ticks_widen(&low, &high);
    /* the smallest of 1, 2, 5, 10 times a power of ten of which at most eight fit in */
    double raw = (high - low) / 8;
    double decade = pow(10, floor(log10(raw)));
    double ratio = raw / decade * (1 - 1e-9); /* so that 1.0000000001 is still 1 */
    double mantissa = 10;
    if (ratio <= 1) {
        mantissa = 1;
    } else if (ratio <= 2) {
        mantissa = 2;
    } else if (ratio <= 5) {
        mantissa = 5;
    }
    double step = decade * mantissa;
    double first = floor(low / step + 1e-6), last = ceil(high / step - 1e-6);
    *ticks = (struct ticks){.step = step};
    for (double i = first; i <= last && ticks->count < TICKS_MOST; i++) {
        ticks->value[ticks->count++] = i * step + 0.0;
    }
}

/* The n-th of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ...; the zeroth is 1. */
static double one_two_five(double n)
{
    static const double mantissa[] = {1, 2, 5};
    double decade = floor(n / 3);
    return mantissa[(int)(n - 3 * decade)] * pow(10, decade);
}

static double one_two_five_below(double x)
{
    double n = 3 * floor(log10(x)) - 3;
    while (one_two_five(n + 1) <= x * (1 + 1e-9)) {
        n++;
    }
    return n;
}

void ticks_log(double low, double high, struct ticks *ticks)
{
    if (high < 4 * low) {
        ticks_linear(low, high, ticks);
        return;
    }
    double below = one_two_five_below(low), above = one_two_five_below(high);
    if (one_two_five(above) < high * (1 - 1e-9)) {
        above++;
    }
    double stride = 1, first = below, last = above;
    while ((last - first) / stride > TICKS_MOST - 1) {
        stride = stride < 3 ? 3 : stride + 3; /* whole decades */
        first = floor(below / stride) * stride;
        last = ceil(above / stride) * stride;
    }
    *ticks = (struct ticks){.step = 0};
    for (double n = first; n <= last; n += stride) {
        ticks->value[ticks->count++] = one_two_five(n);
    }
}

struct stop_label {
    double value;
    const char *text;
};

static const struct stop_label fnumber_stops[] = {
    {0.5, "f/0.5"}, {0.7, "f/0.7"}, {1, "f/1"},     {1.4, "f/1.4"}, {2, "f/2"},
    {2.8, "f/2.8"}, {4, "f/4"},     {5.6, "f/5.6"}, {8, "f/8"},     {11, "f/11"},
    {16, "f/16"},   {22, "f/22"},   {32, "f/32"},   {45, "f/45"},   {64, "f/64"},
    {90, "f/90"},   {128, "f/128"}, {180, "f/180"}, {256, "f/256"}, {0, NULL}};

static const struct stop_label time_stops[] = {{1 / 64000.0, "1/64000"},
                                               {1 / 32000.0, "1/32000"},
                                               {1 / 16000.0, "1/16000"},
                                               {1 / 8000.0, "1/8000"},
                                               {1 / 4000.0, "1/4000"},
                                               {1 / 2000.0, "1/2000"},
                                               {1 / 1000.0, "1/1000"},
                                               {1 / 500.0, "1/500"},
                                               {1 / 250.0, "1/250"},
                                               {1 / 125.0, "1/125"},
                                               {1 / 60.0, "1/60"},
                                               {1 / 30.0, "1/30"},
                                               {1 / 15.0, "1/15"},
                                               {1 / 8.0, "1/8"},
                                               {1 / 4.0, "1/4"},
                                               {1 / 2.0, "1/2"},
                                               {1, "1"},
                                               {2, "2"},
                                               {4, "4"},
                                               {8, "8"},
                                               {15, "15"},
                                               {30, "30"},
                                               {60, "60"},
                                               {120, "120"},
                                               {240, "240"},
                                               {480, "480"},
                                               {900, "900"},
                                               {1800, "1800"},
                                               {0, NULL}};

static const struct stop_label iso_stops[] = {
    {3, "3"},           {6, "6"},           {12, "12"},         {25, "25"},
    {50, "50"},         {100, "100"},       {200, "200"},       {400, "400"},
    {800, "800"},       {1600, "1600"},     {3200, "3200"},     {6400, "6400"},
    {12800, "12800"},   {25600, "25600"},   {51200, "51200"},   {102400, "102400"},
    {204800, "204800"}, {409600, "409600"}, {819200, "819200"}, {0, NULL}};

void ticks_stops(enum ticks_kind kind, double low, double high, struct ticks *ticks)
{
    static const struct stop_label *const series[] = {NULL, fnumber_stops, time_stops, iso_stops};
    const struct stop_label *stops = series[kind];
    if (stops == NULL || stops[0].value > low * (1 + 1e-9)) {
        ticks_log(low, high, ticks);
        return;
    }
    size_t first = 0, last = 0;
    while (stops[first + 1].text != NULL && stops[first + 1].value <= low * (1 + 1e-9)) {
        first++;
    }
    for (last = first; stops[last].text != NULL && stops[last].value < high * (1 - 1e-9);) {
        last++;
    }
    if (stops[last].text == NULL || last == first) {
        ticks_log(low, high, ticks);
        return;
    }
    size_t stride = 1;
    while ((last - first + stride - 1) / stride > TICKS_MOST - 1) {
        stride++;
    }
    *ticks = (struct ticks){.step = 0};
    for (size_t i = first; i < last + stride; i += stride) {
        size_t at = i; /* the series may end amid a stride */
        for (size_t k = last; k < i && at == i; k++) {
            at = stops[k + 1].text == NULL ? k : i;
        }
        ticks->text[ticks->count] = stops[at].text;
        ticks->value[ticks->count++] = stops[at].value;
    }
}

/* x with a fixed number of decimals and a true minus sign. */
const char *ticks_fixed(struct arena *arena, double x, int decimals)
{
    char digits[NUMBER_LENGTH + 1] = "";
    char zeros[] = "0000000000000000";
    *number_write_digits(digits, fabs(x), 12) = '\0';
    const char *point = strchr(digits, '.');
    int missing = decimals - (point ? (int)strlen(point + 1) : 0);
    if (missing < 0 || strchr(digits, 'e')) {
        missing = 0;
    } else if (missing > 15) {
        missing = 15;
    }
    return arena_printf(arena, "%s%s%s%.*s", x < 0 ? "−" : "", digits,
                        missing > 0 && !point ? "." : "", missing, zeros);
}

/* floor(log10(x)), where 999.9999999 counts as 1000. */
static int exponent_of(double x)
{
    return (int)floor(log10(x * (1 + 1e-9)));
}

const char *ticks_text(struct arena *arena, const struct ticks *ticks, size_t i)
{
    double x = ticks->value[i];
    if (ticks->text[i] != NULL) {
        return ticks->text[i];
    }
    double first = fabs(ticks->value[0]), last = fabs(ticks->value[ticks->count - 1]);
    double greatest = fmax(first, last);
    bool linear = ticks->step > 0;
    if (!(fabs(x) > 0)) {
        return "0";
    }
    int place = linear ? exponent_of(ticks->step) : 0; /* of the last digit written */
    if (greatest >= 0.999e6 || greatest < 1e-3 || (!linear && first < 0.999e-4)) {
        int exponent = exponent_of(linear ? greatest : fabs(x));
        int decimals = linear && place < exponent ? exponent - place : 0;
        /* as 2×10⁻⁵ */
        static const char *const digit[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
        const char *text = "";
        for (int rest = exponent < 0 ? -exponent : exponent; rest > 0 || !*text; rest /= 10) {
            text = arena_printf(arena, "%s%s", digit[rest % 10], text);
        }
        const char *power = exponent < 0 ? arena_printf(arena, "⁻%s", text) : text;
        double mantissa = x / pow(10, exponent);
        if (fabs(mantissa - 1) < 1e-9 && decimals == 0) {
            return arena_printf(arena, "10%s", power);
        }
        return arena_printf(arena, "%s×10%s", ticks_fixed(arena, mantissa, decimals), power);
    }
    return ticks_fixed(arena, x, place < 0 ? -place : 0);
}

double ticks_width(struct arena *arena, const struct ticks *ticks, double size)
{
    double width = 0;
    for (size_t i = 0; i < ticks->count; i++) {
        width = fmax(width, svg_text_width(ticks_text(arena, ticks, i), size));
    }
    return width;
}

double ticks_round_below(double most)
{
    return one_two_five(one_two_five_below(most));
}

static int ticks_ascending(const void *first, const void *second)
{
    const double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

double ticks_reach(double *values, size_t count)
{
    const size_t share = 50; /* one in so many may lie outside */
    const double room = 1.3;
    if (count == 0) {
        return 0;
    }
    qsort(values, count, sizeof *values, ticks_ascending);
    const double most = values[count - 1], inner = values[count - 1 - count / share];
    return most > 2 * inner && inner > 0 ? fmin(room * inner, most) : most;
}
