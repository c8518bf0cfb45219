/* tests/unit/test_palette.c - unit tests of draw/palette.c. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "draw/palette.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * What eyes see that lack a kind of cone: R, G, B of linear light.
 * G. M. Machado, M. M. Oliveira, L. A. F. Fernandes, A Physiologically-based Model for Simulation
 * of Color Vision Deficiency, IEEE Trans. Vis. Comput. Graph. 15 (2009), table of severity 1.0.
 */
static const struct {
    const char *name;
    double of[3][3];
} eyes[] = {
    {"all cones", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {"protanopia",
     {{0.152286, 1.052583, -0.204868},
      {0.114503, 0.786281, 0.099216},
      {-0.003882, -0.048116, 1.051998}}},
    {"deuteranopia",
     {{0.367322, 0.860646, -0.227968},
      {0.280085, 0.672501, 0.047413},
      {-0.011820, 0.042940, 0.968881}}},
    {"tritanopia",
     {{1.255528, -0.076749, -0.178779},
      {-0.078411, 0.930809, 0.147602},
      {0.004733, 0.691367, 0.303900}}},
};

static double decode(double v)
{
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

static double lab_curve(double t)
{
    return t > 216.0 / 24389 ? cbrt(t) : (24389.0 / 27 * t + 16) / 116;
}

/* CIE L*a*b* under D65 of "#rrggbb", as such an eye sees it. */
static void lab_of(const char *colour, const double eye[3][3], double lab[3])
{
    /* IEC 61966-2-1 */
    static const double xyz[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    static const double white[] = {0.9505, 1, 1.089};
    double rgb[3], seen[3], f[3];
    for (int i = 0; i < 3; i++) {
        const char two[] = {colour[1 + 2 * i], colour[2 + 2 * i], '\0'};
        rgb[i] = decode((double)strtol(two, NULL, 16) / 255);
    }
    for (int i = 0; i < 3; i++) {
        seen[i] = eye[i][0] * rgb[0] + eye[i][1] * rgb[1] + eye[i][2] * rgb[2];
        seen[i] = fmin(fmax(seen[i], 0), 1);
    }
    for (int i = 0; i < 3; i++) {
        const double *row = xyz[i];
        f[i] = lab_curve((row[0] * seen[0] + row[1] * seen[1] + row[2] * seen[2]) / white[i]);
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static const double RADIAN = 3.14159265358979323846 / 180;

static double hue_of(double a, double b)
{
    const double hue = atan2(b, a) / RADIAN;
    return hue < 0 ? hue + 360 : hue;
}

/* CIEDE2000: CIE 142-2001, in the symbols of Sharma, Wu, Dalal (2005). */
static double difference(const double one[3], const double two[3])
{
    const double mean = (hypot(one[1], one[2]) + hypot(two[1], two[2])) / 2;
    const double G = 0.5 * (1 - sqrt(pow(mean, 7) / (pow(mean, 7) + pow(25, 7))));
    const double a1 = (1 + G) * one[1], a2 = (1 + G) * two[1];
    const double C1 = hypot(a1, one[2]), C2 = hypot(a2, two[2]);
    const double h1 = hue_of(a1, one[2]), h2 = hue_of(a2, two[2]);
    const bool is_grey = !(C1 * C2 > 0);
    double dh = is_grey ? 0 : h2 - h1, h = h1 + h2;
    if (!is_grey && fabs(h1 - h2) > 180) {
        dh += dh > 180 ? -360 : 360;
        h = (h + (h < 360 ? 360 : -360)) / 2;
    } else if (!is_grey) {
        h /= 2;
    }
    const double dL = two[0] - one[0], dC = C2 - C1;
    const double dH = 2 * sqrt(C1 * C2) * sin(dh / 2 * RADIAN);
    const double L = (one[0] + two[0]) / 2, C = (C1 + C2) / 2;
    const double T = 1 - 0.17 * cos((h - 30) * RADIAN) + 0.24 * cos(2 * h * RADIAN) +
                     0.32 * cos((3 * h + 6) * RADIAN) - 0.20 * cos((4 * h - 63) * RADIAN);
    const double turn = 30 * exp(-pow((h - 275) / 25, 2));
    const double RC = 2 * sqrt(pow(C, 7) / (pow(C, 7) + pow(25, 7)));
    const double SL = 1 + 0.015 * pow(L - 50, 2) / sqrt(20 + pow(L - 50, 2));
    const double SC = 1 + 0.045 * C, SH = 1 + 0.015 * C * T, RT = -sin(2 * turn * RADIAN) * RC;
    return sqrt(pow(dL / SL, 2) + pow(dC / SC, 2) + pow(dH / SH, 2) + RT * dC / SC * dH / SH);
}

/* Rows of table 1 of Sharma, Wu, Dalal, The CIEDE2000 color-difference formula, 2005. */
static void test_difference(void)
{
    static const struct {
        double one[3], two[3], expected;
    } rows[] = {
        {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
        {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
        {{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
        {{50, 2.5, 0}, {61, -5, 29}, 22.8977},
        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        CHECK_NEAR(difference(rows[i].one, rows[i].two), rows[i].expected, 5e-5, "CIEDE2000");
    }
}

/* The colours of a theme, and its page, differ by more than 10 for all eyes. */
static void test_colours_differ(void)
{
    for (enum palette_theme theme = PALETTE_LIGHT; theme <= PALETTE_PRINT; theme++) {
        char colours[PALETTE_COLOURS + 1][PALETTE_LENGTH];
        for (size_t i = 0; i < PALETTE_COLOURS; i++) {
            CHECK(palette_in_theme(theme, palette_colour(i), colours[i]));
        }
        CHECK(palette_in_theme(theme, "#fff", colours[PALETTE_COLOURS]));
        for (size_t eye = 0; eye < sizeof eyes / sizeof eyes[0]; eye++) {
            double lab[PALETTE_COLOURS + 1][3];
            for (size_t i = 0; i <= PALETTE_COLOURS; i++) {
                lab_of(colours[i], eyes[eye].of, lab[i]);
                for (size_t k = 0; k < i; k++) {
                    CHECK(difference(lab[i], lab[k]) > 10);
                    /* and without colours on paper */
                    CHECK(theme != PALETTE_PRINT || eye > 0 || fabs(lab[i][0] - lab[k][0]) > 5);
                }
            }
        }
    }
}

/* Words and lines keep their distance from the page. */
static void test_themes(void)
{
    char shown[PALETTE_LENGTH];
    static const double all[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const char *const words[] = {"#000", "#333333", "#444", "#555", "#666666"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        double page[3], word[3];
        CHECK(palette_in_theme(PALETTE_DARK, "#ffffff", shown));
        lab_of(shown, all, page);
        CHECK(palette_in_theme(PALETTE_DARK, words[i], shown));
        lab_of(shown, all, word);
        CHECK(word[0] - page[0] > 50); /* a contrast over 4.5 : 1 as WCAG 2 has it */
    }
    CHECK(palette_in_theme(PALETTE_LIGHT, "#abc", shown) && strcmp(shown, "#aabbcc") == 0);
    CHECK(palette_in_theme(PALETTE_PRINT, "#cfe3f5", shown) && strcmp(shown, "#cfe3f5") == 0);
    CHECK(!palette_in_theme(PALETTE_DARK, "none", shown));
    CHECK(!palette_in_theme(PALETTE_DARK, "#12", shown));
}

int main(void)
{
    test_difference();
    test_colours_differ();
    test_themes();
    return check_report();
}
