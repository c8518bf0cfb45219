/* light/illuminant.c - CIE's illuminants, temperatures, and stars. */
/* SPDX-License-Identifier: MIT */
#include "light/illuminant.h"

#include "base/quantity.h"
#include "light/colour.h"

#include <math.h>

/* -------- tables -------- */

enum { LAMP_ROWS = 81 };

/* clang-format off */
static const double lamp_wavelengths[LAMP_ROWS] = {
    0.380, 0.385, 0.390, 0.395, 0.400, 0.405, 0.410, 0.415, 0.420, 0.425, 0.430, 0.435, 0.440,
    0.445, 0.450, 0.455, 0.460, 0.465, 0.470, 0.475, 0.480, 0.485, 0.490, 0.495, 0.500, 0.505,
    0.510, 0.515, 0.520, 0.525, 0.530, 0.535, 0.540, 0.545, 0.550, 0.555, 0.560, 0.565, 0.570,
    0.575, 0.580, 0.585, 0.590, 0.595, 0.600, 0.605, 0.610, 0.615, 0.620, 0.625, 0.630, 0.635,
    0.640, 0.645, 0.650, 0.655, 0.660, 0.665, 0.670, 0.675, 0.680, 0.685, 0.690, 0.695, 0.700,
    0.705, 0.710, 0.715, 0.720, 0.725, 0.730, 0.735, 0.740, 0.745, 0.750, 0.755, 0.760, 0.765,
    0.770, 0.775, 0.780
};

static const double f2[LAMP_ROWS] = {
    1.18, 1.48, 1.84, 2.15, 3.44, 15.69, 3.85, 3.74, 4.19, 4.62, 5.06, 34.98, 11.81, 6.27, 6.63,
    6.93, 7.19, 7.4, 7.54, 7.62, 7.65, 7.62, 7.62, 7.45, 7.28, 7.15, 7.05, 7.04, 7.16, 7.47, 8.04,
    8.88, 10.01, 24.88, 16.64, 14.59, 16.16, 17.56, 18.62, 21.47, 22.79, 19.29, 18.66, 17.73,
    16.54, 15.21, 13.8, 12.36, 10.95, 9.65, 8.4, 7.32, 6.31, 5.43, 4.68, 4.02, 3.45, 2.96, 2.55,
    2.19, 1.89, 1.64, 1.53, 1.27, 1.1, 0.99, 0.88, 0.76, 0.68, 0.61, 0.56, 0.54, 0.51, 0.47, 0.47,
    0.43, 0.46, 0.47, 0.4, 0.33, 0.27,
};

static const double f7[LAMP_ROWS] = {
    2.56, 3.18, 3.84, 4.53, 6.15, 19.37, 7.37, 7.05, 7.71, 8.41, 9.15, 44.14, 17.52, 11.35, 12,
    12.58, 13.08, 13.45, 13.71, 13.88, 13.95, 13.93, 13.82, 13.64, 13.43, 13.25, 13.08, 12.93,
    12.78, 12.6, 12.44, 12.33, 12.26, 29.52, 17.05, 12.44, 12.58, 12.72, 12.83, 15.46, 16.75,
    12.83, 12.67, 12.45, 12.19, 11.89, 11.6, 11.35, 11.12, 10.95, 10.76, 10.42, 10.11, 10.04,
    10.02, 10.11, 9.87, 8.65, 7.27, 6.44, 5.83, 5.41, 5.04, 4.57, 4.12, 3.77, 3.46, 3.08, 2.73,
    2.47, 2.25, 2.06, 1.9, 1.75, 1.62, 1.54, 1.45, 1.32, 1.17, 0.99, 0.81,
};

static const double f11[LAMP_ROWS] = {
    0.91, 0.63, 0.46, 0.37, 1.29, 12.68, 1.59, 1.79, 2.46, 3.33, 4.49, 33.94, 12.13, 6.95, 7.19,
    7.12, 6.72, 6.13, 5.46, 4.79, 5.66, 14.29, 14.96, 8.97, 4.72, 2.33, 1.47, 1.1, 0.89, 0.83,
    1.18, 4.9, 39.59, 72.84, 32.61, 7.52, 2.83, 1.96, 1.67, 4.43, 11.28, 14.76, 12.73, 9.74, 7.33,
    9.72, 55.27, 42.58, 13.18, 13.16, 12.26, 5.11, 2.07, 2.34, 3.58, 3.01, 2.48, 2.14, 1.54, 1.33,
    1.46, 1.94, 2, 1.2, 1.35, 4.1, 5.58, 2.51, 0.57, 0.27, 0.23, 0.21, 0.24, 0.24, 0.2, 0.24, 0.32,
    0.26, 0.16, 0.12, 0.09,
};
/* clang-format on */

static const double even_wavelengths[2] = {0.3, 0.83}, even[2] = {1, 1};

/* -------- names -------- */

const struct word illuminant_words[] = {
    {"A", "tungsten lamp, a black body of 2856 K"},
    {"D50", "daylight of 5003 K"},
    {"D55", "daylight of 5503 K"},
    {"D65", "daylight of 6504 K, the white of sRGB"},
    {"D75", "daylight of 7504 K"},
    {"E", "the same at all wavelengths"},
    {"F2", "fluorescent lamp, cool white, 4230 K"},
    {"F7", "fluorescent lamp, daylight, 6500 K"},
    {"F11", "fluorescent lamp of three bands, 4000 K"},
    {NULL, NULL},
};

#define LAMP(of)                                                                                   \
    {                                                                                              \
        .kind = SPECTRUM_TABLE, .count = LAMP_ROWS, .wavelength = lamp_wavelengths, .value = (of)  \
    }
/* D series: 14388/14380 of 5000, 5500, 6500 and 7500 K, as colour_white's formula takes them. */
#define DAY(of)                                                                                    \
    {                                                                                              \
        .kind = SPECTRUM_DAYLIGHT, .kelvin = (of) * (1.4388 / 1.4380)                              \
    }

enum { DAY_65 = 3 };

/* In the order of the words. */
static const struct spectrum illuminants[] = {
    {.kind = SPECTRUM_BLACKBODY, .kelvin = 2848 * (1.4387768775 / 1.4350)},
    DAY(5000),
    DAY(5500),
    DAY(6500),
    DAY(7500),
    {.kind = SPECTRUM_TABLE, .count = 2, .wavelength = even_wavelengths, .value = even},
    LAMP(f2),
    LAMP(f7),
    LAMP(f11),
};

static const struct {
    const char *word;
    enum spectrum_kind kind;
} kinds[] = {{"blackbody", SPECTRUM_BLACKBODY}, {"daylight", SPECTRUM_DAYLIGHT}};

/* -------- reading -------- */

/* Nothing of that name: what is near? */
static bool illuminant_fail_unknown(struct text name, struct error *error)
{
    struct nearest nearest = {.typed = name};
    for (const struct word *word = illuminant_words; word->word != NULL; word++) {
        nearest_offer(&nearest, text_of(word->word));
    }
    fail_at(error, ERROR_USAGE, name, 1, "unknown light '%.*s'", text_shown(name), name.start);
    return nearest.best.start != NULL
               ? error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                            nearest.best.start)
               : error_hint(error, "lights are A, D50, D55, D65, D75, E, F2, F7, F11, a "
                                   "temperature like 5600K, or 'blackbody:2856K'");
}

static bool read_kelvin(struct text text, struct spectrum *spectrum, struct error *error)
{
    double kelvin;
    if (!quantity_read(text, &dimension_colour, NULL, &kelvin, NULL, error)) {
        return false;
    }
    if (spectrum->kind == SPECTRUM_NONE) {
        spectrum->kind = kelvin < WHITE_DAYLIGHT ? SPECTRUM_BLACKBODY : SPECTRUM_DAYLIGHT;
    }
    spectrum->kelvin = kelvin;
    if (!spectrum_check(spectrum, error)) {
        error->code = ERROR_USAGE;
        return spectrum->kind == SPECTRUM_DAYLIGHT && kelvin > WHITE_MOST
                   ? error_hint(error, "'blackbody:%gK' may be up to %d K", kelvin, BLACKBODY_MOST)
                   : false;
    }
    return true;
}

bool spectrum_named(struct text name, struct spectrum *spectrum, struct error *error)
{
    const struct text trimmed = text_trim(name);
    *spectrum = (struct spectrum){.kind = SPECTRUM_NONE};
    for (size_t i = 0; illuminant_words[i].word != NULL; i++) {
        if (text_same(trimmed, illuminant_words[i].word)) {
            *spectrum = illuminants[i];
            return true;
        }
    }
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const struct text rest = text_behind(trimmed, kinds[i].word);
        if (rest.start != NULL && (rest.start[0] == ' ' || rest.start[0] == ':')) {
            spectrum->kind = kinds[i].kind;
            return read_kelvin((struct text){rest.start + 1, rest.length - 1}, spectrum, error);
        }
    }
    if (trimmed.length > 0 && (char_is_digit(trimmed.start[0]) || trimmed.start[0] == '-')) {
        return read_kelvin(trimmed, spectrum, error);
    }
    return illuminant_fail_unknown(trimmed, error);
}

struct spectrum spectrum_white(void)
{
    return illuminants[DAY_65];
}

/* -------- stars -------- */

double illuminant_star(double magnitude)
{
    return 2.54e-6 * pow(10, -0.4 * magnitude);
}
