/* light/spectrum.c - black bodies, daylight and tables by wavelength. */
/* SPDX-License-Identifier: MIT */
#include "light/spectrum.h"

#include "light/colour.h"

#include <math.h>

/* -------- black bodies -------- */

static const double c2 = 14387.768775; /* h c/k, um K: exact in the SI of 2019 */

/* e^x - 1 of the two in one quotient, which the smallest and largest of exponents leave finite. */
static double black_body_power(double kelvin, double wavelength)
{
    const double middle = 0.56, x = c2 / (wavelength * kelvin), x0 = c2 / (middle * kelvin);
    return pow(middle / wavelength, 5) * exp(x0 - x) * expm1(-x0) / expm1(-x);
}

/* -------- daylight -------- */

enum { DAYLIGHT_ROWS = 107 };
#define DAYLIGHT_FIRST 0.300
#define DAYLIGHT_STEP  0.005

/* S0, S1, S2. [CIE04] T.2, as in colord's tables. */
/* clang-format off */
static const double components[DAYLIGHT_ROWS][3] = {
    {0.04, 0.02, 0}, {3.02, 2.26, 1}, {6, 4.5, 2}, {17.8, 13.45, 3}, {29.6, 22.4, 4},
    {42.45, 32.2, 6.25}, {55.3, 42, 8.5}, {56.3, 41.3, 8.15}, {57.3, 40.6, 7.8},
    {59.55, 41.1, 7.25}, {61.8, 41.6, 6.7}, {61.65, 39.8, 6}, {61.5, 38, 5.3}, {65.15, 40.2, 5.7},
    {68.8, 42.4, 6.1}, {66.1, 40.45, 4.55}, {63.4, 38.5, 3}, {64.6, 36.75, 2.1}, {65.8, 35, 1.2},
    {80.3, 39.2, 0.05}, {94.8, 43.4, -1.1}, {99.8, 44.85, -0.8}, {104.8, 46.3, -0.5},
    {105.35, 45.1, -0.6}, {105.9, 43.9, -0.7}, {101.35, 40.5, -0.95}, {96.8, 37.1, -1.2},
    {105.35, 36.9, -1.9}, {113.9, 36.7, -2.6}, {119.75, 36.3, -2.75}, {125.6, 35.9, -2.9},
    {125.55, 34.25, -2.85}, {125.5, 32.6, -2.8}, {123.4, 30.25, -2.7}, {121.3, 27.9, -2.6},
    {121.3, 26.1, -2.6}, {121.3, 24.3, -2.6}, {117.4, 22.2, -2.2}, {113.5, 20.1, -1.8},
    {113.3, 18.15, -1.65}, {113.1, 16.2, -1.5}, {111.95, 14.7, -1.4}, {110.8, 13.2, -1.3},
    {108.65, 10.9, -1.25}, {106.5, 8.6, -1.2}, {107.65, 7.35, -1.1}, {108.8, 6.1, -1},
    {107.05, 5.15, -0.75}, {105.3, 4.2, -0.5}, {104.85, 3.05, -0.4}, {104.4, 1.9, -0.3},
    {102.2, 0.95, -0.15}, {100, 0, 0}, {98, -0.8, 0.1}, {96, -1.6, 0.2}, {95.55, -2.55, 0.35},
    {95.1, -3.5, 0.5}, {92.1, -3.5, 1.3}, {89.1, -3.5, 2.1}, {89.8, -4.65, 2.65},
    {90.5, -5.8, 3.2}, {90.4, -6.5, 3.65}, {90.3, -7.2, 4.1}, {89.35, -7.9, 4.4},
    {88.4, -8.6, 4.7}, {86.2, -9.05, 4.9}, {84, -9.5, 5.1}, {84.55, -10.2, 5.9},
    {85.1, -10.9, 6.7}, {83.5, -10.8, 7}, {81.9, -10.7, 7.3}, {82.25, -11.35, 7.95},
    {82.6, -12, 8.6}, {83.75, -13, 9.2}, {84.9, -14, 9.8}, {83.1, -13.8, 10}, {81.3, -13.6, 10.2},
    {76.6, -12.8, 9.25}, {71.9, -12, 8.3}, {73.1, -12.65, 8.95}, {74.3, -13.3, 9.6},
    {75.35, -13.1, 9.05}, {76.4, -12.9, 8.5}, {69.85, -11.75, 7.75}, {63.3, -10.6, 7},
    {67.5, -11.1, 7.3}, {71.7, -11.6, 7.6}, {74.35, -11.9, 7.8}, {77, -12.2, 8},
    {71.1, -11.2, 7.35}, {65.2, -10.2, 6.7}, {56.45, -9, 5.95}, {47.7, -7.8, 5.2},
    {58.15, -9.5, 6.3}, {68.6, -11.2, 7.4}, {66.8, -10.8, 7.1}, {65, -10.4, 6.8},
    {65.5, -10.5, 6.9}, {66, -10.6, 7}, {63.5, -10.15, 6.7}, {61, -9.7, 6.4}, {57.15, -9, 5.95},
    {53.3, -8.3, 5.5}, {56.1, -8.8, 5.8}, {58.9, -9.3, 6.1}, {60.4, -9.55, 6.3}, {61.9, -9.8, 6.5},
};
/* clang-format on */

static double spectrum_rounded(double value)
{
    return floor(value * 1000 + 0.5) / 1000;
}

static double daylight_power(double kelvin, double wavelength)
{
    const double rows = (wavelength - DAYLIGHT_FIRST) / DAYLIGHT_STEP;
    struct colour white;
    struct error unused;
    if (!(rows >= 0 && rows <= DAYLIGHT_ROWS - 1) || !colour_white(kelvin, &white, &unused)) {
        return 0;
    }
    const double sum = white.part[0] + white.part[1] + white.part[2];
    const double x = white.part[0] / sum, y = white.part[1] / sum;
    const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
    const double m1 = spectrum_rounded((-1.3515 - 1.7703 * x + 5.9114 * y) / m);
    const double m2 = spectrum_rounded((0.0300 - 31.4424 * x + 30.0717 * y) / m);
    const size_t row = rows < DAYLIGHT_ROWS - 1 ? (size_t)rows : DAYLIGHT_ROWS - 2;
    double ends[2];
    for (size_t i = 0; i < 2; i++) {
        const double *s = components[row + i];
        ends[i] = s[0] + m1 * s[1] + m2 * s[2];
    }
    const double value = ends[0] + (rows - (double)row) * (ends[1] - ends[0]);
    return value > 0 ? value / 100 : 0;
}

/* -------- tables -------- */

static double table_at(const struct spectrum *table, double wavelength)
{
    const double *rows = table->wavelength;
    size_t low = 0, high = table->count - 1;
    if (!(wavelength >= rows[low] && wavelength <= rows[high])) {
        return 0;
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (rows[middle] <= wavelength) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double share = (wavelength - rows[low]) / (rows[high] - rows[low]);
    return table->value[low] + share * (table->value[high] - table->value[low]);
}

double spectrum_at(const struct spectrum *spectrum, double wavelength)
{
    switch (spectrum->kind) {
    case SPECTRUM_BLACKBODY:
        return black_body_power(spectrum->kelvin, wavelength);
    case SPECTRUM_DAYLIGHT:
        return daylight_power(spectrum->kelvin, wavelength);
    case SPECTRUM_TABLE:
        return table_at(spectrum, wavelength);
    default:
        return 0;
    }
}

/* -------- checks -------- */

static bool fail_number(const char *what, double value, struct error *error)
{
    return fail(error, ERROR_DOMAIN, "%s is %.6g; it must be a number of at least 0", what, value);
}

static bool check_rgb(const struct spectrum *spectrum, struct error *error)
{
    static const char *const names[3] = {"red of the colour", "green of the colour",
                                         "blue of the colour"};
    for (int i = 0; i < 3; i++) {
        if (!(spectrum->rgb[i] >= 0 && spectrum->rgb[i] < (double)INFINITY)) {
            return fail_number(names[i], spectrum->rgb[i], error);
        }
    }
    return true;
}

static bool check_kelvin(const struct spectrum *spectrum, const char *what, const int range[2],
                         struct error *error)
{
    if (!(spectrum->kelvin >= range[0] && spectrum->kelvin <= range[1])) {
        return fail(error, ERROR_DOMAIN, "the temperature %.6g K of %s is not from %d to %d K",
                    spectrum->kelvin, what, range[0], range[1]);
    }
    return true;
}

bool spectrum_check(const struct spectrum *spectrum, struct error *error)
{
    static const int black[2] = {BLACKBODY_LEAST, BLACKBODY_MOST};
    static const int day[2] = {WHITE_DAYLIGHT, WHITE_MOST};
    switch (spectrum->kind) {
    case SPECTRUM_RGB:
        return check_rgb(spectrum, error);
    case SPECTRUM_BLACKBODY:
        return check_kelvin(spectrum, "a black body", black, error);
    case SPECTRUM_DAYLIGHT:
        return check_kelvin(spectrum, "daylight", day, error);
    case SPECTRUM_TABLE:
        if (spectrum->count < 2) {
            return fail(error, ERROR_DOMAIN, "a table of a spectrum has at least two rows");
        }
        for (size_t i = 0; i < spectrum->count; i++) {
            if (!(spectrum->value[i] >= 0 && spectrum->value[i] < (double)INFINITY)) {
                return fail_number("a value of the spectrum", spectrum->value[i], error);
            }
            if (!(spectrum->wavelength[i] > (i == 0 ? 0 : spectrum->wavelength[i - 1])) ||
                !(spectrum->wavelength[i] < (double)INFINITY)) {
                return fail(error, ERROR_DOMAIN,
                            "the wavelength %.6g um of the spectrum is not above the one before it",
                            spectrum->wavelength[i]);
            }
        }
        return true;
    case SPECTRUM_NONE:
        break;
    }
    return fail(error, ERROR_DOMAIN, "no spectrum is given");
}
