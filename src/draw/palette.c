/* draw/palette.c - colours that the colour-blind can tell apart, on light pages, dark ones, paper. */
/* SPDX-License-Identifier: MIT */
#include "draw/palette.h"

#include <math.h>
#include <string.h>

/* The seven, then the page, by theme: tests/unit/test_palette.c says how far apart they are. */
static const char *const themes[][PALETTE_PRINT + 1] = {
    {"#0072b2", "#7f9cff", "#1d3b7a"}, {"#d55e00", "#ff6b4a", "#9c2f10"},
    {"#009e73", "#17ad80", "#12805f"}, {"#cc79a7", "#b07aa8", "#d0509a"},
    {"#000000", "#f4f4f4", "#000000"}, {"#e69f00", "#f0d03a", "#d39a10"},
    {"#56b4e9", "#90d3ff", "#74c4f0"}, {"#ffffff", "#17191d", "#ffffff"}};

const char *palette_colour(size_t i)
{
    return themes[i % PALETTE_COLOURS][PALETTE_LIGHT];
}

static const char hexadecimal[] = "0123456789abcdef";

/* "#rgb" and "#rrggbb" as numbers 0..255. */
static bool palette_read(const char *colour, int rgb[3])
{
    const size_t digits = strspn(colour + 1, "0123456789abcdefABCDEF");
    unsigned number = 0;
    if (colour[0] != '#' || (digits != 3 && digits != 6)) {
        return false;
    }
    for (size_t i = 1; i <= digits; i++) {
        const char *found = strchr(hexadecimal, colour[i] | 32); /* digits have that bit */
        number = number * 16 + (unsigned)(found - hexadecimal);
    }
    for (int i = 2; i >= 0; i--) {
        rgb[i] = (int)(digits == 3 ? (number & 15) * 17 : number & 255);
        number >>= digits == 3 ? 4 : 8;
    }
    return true;
}

static double srgb_decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double srgb_encode(double v)
{
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

/* Another lightness in OKLab; what no display has is cut. */
static void oklab_lighten(int rgb[3], double (*lightness)(double L))
{
    const double r = srgb_decode(rgb[0] / 255.0), g = srgb_decode(rgb[1] / 255.0),
                 b = srgb_decode(rgb[2] / 255.0);
    const double l = cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    const double L = lightness(0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s);
    const double A = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
    const double B = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
    const double l3 = pow(L + 0.3963377774 * A + 0.2158037573 * B, 3);
    const double m3 = pow(L - 0.1055613458 * A - 0.0638541728 * B, 3);
    const double s3 = pow(L - 0.0894841775 * A - 1.2914855480 * B, 3);
    const double linear[] = {4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
                             -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
                             -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
    for (int i = 0; i < 3; i++) {
        rgb[i] = (int)lround(255 * srgb_encode(fmin(fmax(linear[i], 0), 1)));
    }
}

static double lightness_on_dark(double L)
{
    return L < 0.5 ? 0.93 - 0.45 * L : 0.705 - 1.01 * (L - 0.5);
}

/* Words black, lines a third darker: a printer loses what is pale. */
static double lightness_on_paper(double L)
{
    return L < 0.6 ? 0.6 * L : fmin(L, 0.6 * 0.6 + (L - 0.6) * (1 - 0.36) / 0.4);
}

bool palette_in_theme(enum palette_theme theme, const char *colour, char shown[PALETTE_LENGTH])
{
    int rgb[3], own[3];
    if (!palette_read(colour, rgb)) {
        return false;
    }
    for (size_t i = 0; i < sizeof themes / sizeof themes[0]; i++) {
        if (palette_read(themes[i][PALETTE_LIGHT], own) && memcmp(own, rgb, sizeof own) == 0) {
            memcpy(shown, themes[i][theme], PALETTE_LENGTH);
            return true;
        }
    }
    const bool is_grey = rgb[0] == rgb[1] && rgb[1] == rgb[2];
    if (theme == PALETTE_DARK) {
        oklab_lighten(rgb, lightness_on_dark);
    } else if (theme == PALETTE_PRINT && is_grey) {
        oklab_lighten(rgb, lightness_on_paper);
    }
    for (int i = 0; i < 3; i++) {
        shown[1 + 2 * i] = hexadecimal[rgb[i] / 16];
        shown[2 + 2 * i] = hexadecimal[rgb[i] % 16];
    }
    shown[0] = '#';
    shown[PALETTE_LENGTH - 1] = '\0';
    return true;
}

/* Evenly from the lowest number to the highest. */
static const unsigned char light[][3] = {{10, 8, 36},   {62, 18, 106},  {142, 36, 106},
                                         {214, 78, 62}, {248, 154, 34}, {253, 247, 190}};
static const unsigned char diverging[][3] = {
    {24, 66, 148}, {104, 160, 210}, {247, 247, 247}, {236, 142, 104}, {158, 24, 38}};

void palette_scale(bool is_signed, double share, double colour[3])
{
    const unsigned char(*list)[3] = is_signed ? diverging : light;
    const double last = is_signed ? 4 : 5;
    const double place = fmin(fmax(share, 0), 1) * last;
    const size_t below = (size_t)fmin(floor(place), last - 1);
    const double rest = place - (double)below;
    for (int i = 0; i < 3; i++) {
        colour[i] = (list[below][i] + rest * (list[below + 1][i] - list[below][i])) / 255;
    }
}
