/* tests/unit/test_light.c - lights and surfaces in bands: chromaticities, white, luminance. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "light/bands.h"
#include "light/bands_match.h"
#include "light/colour.h"
#include "light/illuminant.h"
#include "light/observer.h"

static const double seen[2] = {OBSERVER_LEAST, OBSERVER_MOST};

static struct spectrum named(const char *name)
{
    struct spectrum spectrum;
    struct error error;
    CHECK(spectrum_named(text_of(name), &spectrum, &error));
    return spectrum;
}

/* -------- what the eye sees of CIE's lights -------- */

/* CIE 15:2004 tables T.3 and T.8.1; equal energy by definition. */
static void test_chromaticities(void)
{
    static const struct {
        const char *name;
        double x, y, tolerance;
    } lights[] = {
        {"A", 0.44757, 0.40745, 2e-5},
        {"D50", 0.34567, 0.35850, 2e-5},
        {"D55", 0.33242, 0.34743, 2e-5},
        {"D65", 0.31271, 0.32902, 2e-5},
        {"D75", 0.29902, 0.31485, 2e-5},
        {"E", 1.0 / 3, 1.0 / 3, 6e-5},
        {"F2", 0.3721, 0.3751, 6e-5},
        {"F7", 0.3129, 0.3292, 6e-5},
        {"F11", 0.3805, 0.3769, 6e-5},
        /* the Planckian locus, Wyszecki and Stiles 1982 table 1(3.11), four digits */
        {"blackbody 1000K", 0.6527, 0.3445, 2e-4},
        {"blackbody:6500K", 0.3135, 0.3237, 2e-4},
        {"blackbody 10000 K", 0.2807, 0.2884, 2e-4},
    };
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        const struct spectrum light = named(lights[i].name);
        double xyz[1][3];
        observer_sum(&light, NULL, seen, 1, xyz);
        const double sum = xyz[0][0] + xyz[0][1] + xyz[0][2];
        CHECK_NEAR(xyz[0][0] / sum, lights[i].x, lights[i].tolerance, lights[i].name);
        CHECK_NEAR(xyz[0][1] / sum, lights[i].y, lights[i].tolerance, lights[i].name);
    }
}

/* CIE 15:2004 table T.1, D65, and A by its formula with 40 digits. */
static void test_values(void)
{
    static const struct {
        const char *name;
        double wavelength, value, tolerance;
    } rows[] = {
        {"D65", 0.300, 0.000341, 2e-6},
        {"D65", 0.400, 0.827549, 2e-6},
        {"D65", 0.450, 1.17008, 2e-5},
        {"D65", 0.560, 1, 1e-12},
        {"D65", 0.600, 0.900062, 2e-6},
        {"D65", 0.780, 0.633828, 2e-6},
        {"D65", 0.2999, 0, 0},
        {"D65", 0.4025, (0.827549 + 0.871204) / 2, 2e-6},
        {"A", 0.400, 0.147080, 1e-6},
        {"A", 0.700, 1.98261, 1e-5},
        {"E", 0.555, 1, 0},
        {"F11", 0.545, 72.84, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct spectrum light = named(rows[i].name);
        CHECK_NEAR(spectrum_at(&light, rows[i].wavelength), rows[i].value, rows[i].tolerance,
                   rows[i].name);
    }
}

/* -------- names -------- */

static void test_names(void)
{
    struct spectrum spectrum;
    struct error error;
    CHECK(named("5600K").kind == SPECTRUM_DAYLIGHT && named("5600K").kelvin == 5600);
    CHECK(named("3200 K").kind == SPECTRUM_BLACKBODY);
    CHECK(named("blackbody:5600K").kind == SPECTRUM_BLACKBODY);
    CHECK(named(" d65 ").kind == SPECTRUM_DAYLIGHT);
    static const struct {
        const char *name, *message, *hint;
    } wrong[] = {
        {"D66", "unknown light 'D66'", "did you mean 'D65'?"},
        {"", "unknown light ''",
         "lights are A, D50, D55, D65, D75, E, F2, F7, F11, a temperature like 5600K, or "
         "'blackbody:2856K'"},
        {"400K", "the temperature 400 K of a black body is not from 500 to 100000 K", ""},
        {"30000K", "the temperature 30000 K of daylight is not from 4000 to 25000 K",
         "'blackbody:30000K' may be up to 100000 K"},
        {"daylight 3000K", "the temperature 3000 K of daylight is not from 4000 to 25000 K", ""},
        {"-5K", "the temperature -5 K of a black body is not from 500 to 100000 K", ""},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        CHECK(!spectrum_named(text_of(wrong[i].name), &spectrum, &error));
        CHECK(error.code == ERROR_USAGE);
        CHECK_TEXT(error.message, wrong[i].message);
        CHECK_TEXT(error.hint, wrong[i].hint);
    }
    CHECK(!spectrum_named(text_of("5600mm"), &spectrum, &error));
    CHECK(!spectrum_named(text_of("blackbody "), &spectrum, &error));
}

/* -------- red, green and blue -------- */

static double luminance(const struct bands *bands, const double of[BANDS_MOST])
{
    double y = 0;
    for (size_t k = 0; k < bands->count; k++) {
        y += of[k] *
             (0.2126 * bands->rgb[k][0] + 0.7152 * bands->rgb[k][1] + 0.0722 * bands->rgb[k][2]);
    }
    return y;
}

/* Light of luminance 1, white of D65, whatever is saturated. */
static void test_lights(void)
{
    struct bands bands;
    double of[BANDS_MOST], held;
    struct error error;
    bands_three(&bands);
    for (const struct word *word = illuminant_words; word->word != NULL; word++) {
        const struct spectrum light = named(word->word);
        CHECK(bands_of_light(&bands, &light, of, &held, &error) && held == 1);
        CHECK_NEAR(luminance(&bands, of), 1, 1e-14, word->word);
    }
    struct spectrum light = named("D65");
    CHECK(bands_of_light(&bands, &light, of, NULL, &error));
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(of[i], 1, 1e-14, "D65 is white");
    }
    /* x, y = 0.44757, 0.40745 through the inverse matrix that IEC 61966-2-1 prints */
    light = named("A");
    CHECK(bands_of_light(&bands, &light, of, NULL, &error));
    CHECK_NEAR(of[0], 1.84508, 5e-4, "red of A");
    CHECK_NEAR(of[1], 0.82626, 5e-4, "green of A");
    CHECK_NEAR(of[2], 0.23329, 5e-4, "blue of A");
    light = (struct spectrum){.kind = SPECTRUM_RGB, .rgb = {10, 0, 0}};
    CHECK(bands_of_light(&bands, &light, of, NULL, &error));
    CHECK_NEAR(of[0], 1 / 0.2126, 1e-13, "red alone");
    CHECK(of[1] == 0 && of[2] == 0);
    /* a line of sodium: beyond sRGB, so nearer to white, with no negative part */
    static const double wavelength[] = {0.588, 0.589, 0.590}, value[] = {0, 1, 0};
    light = (struct spectrum){
        .kind = SPECTRUM_TABLE, .count = 3, .wavelength = wavelength, .value = value};
    CHECK(bands_of_light(&bands, &light, of, &held, &error) && held < 1 && held > 0.8);
    CHECK_NEAR(luminance(&bands, of), 1, 1e-14, "a line");
    CHECK(of[0] > of[1] && of[1] > 0 && fabs(of[2]) < 1e-15);
}

static void test_surfaces(void)
{
    static const double wavelength[] = {0.3, 0.5, 0.6, 0.61, 0.9};
    struct bands bands;
    double of[BANDS_MOST], held;
    struct error error;
    bands_three(&bands);
    struct spectrum surface = {.kind = SPECTRUM_RGB, .rgb = {0.25, 0, 1}};
    CHECK(bands_of_surface(&bands, &surface, of, NULL, &error));
    CHECK(of[0] == 0.25 && of[1] == 0 && of[2] == 1);
    const double grey[] = {0.18, 0.18, 0.18, 0.18, 0.18};
    surface = (struct spectrum){
        .kind = SPECTRUM_TABLE, .count = 5, .wavelength = wavelength, .value = grey};
    CHECK(bands_of_surface(&bands, &surface, of, &held, &error));
    for (int i = 0; i < 3; i++) {
        CHECK_NEAR(of[i], 0.18, 1e-15, "grey");
    }
    CHECK_NEAR(held, 1, 1e-9, "grey is held");
    /* all that is red and no more: blue and green would be negative */
    const double red[] = {0, 0, 0, 1, 1};
    surface.value = red;
    CHECK(bands_of_surface(&bands, &surface, of, &held, &error) && held > 0.5 && held < 0.99);
    for (int i = 0; i < 3; i++) {
        CHECK(of[i] >= 0 && of[i] <= 1);
    }
    CHECK(of[0] > 0.5 && fmin(of[1], of[2]) < 1e-15);
    CHECK(bands_many(8, &bands, &error));
    CHECK(bands_of_surface(&bands, &surface, of, &held, &error) && held == 1);
}

/* -------- many bands -------- */

/* Linear sRGB of light in bands, times what a surface reflects of it, if there is one. */
static void rgb_of(const struct bands *bands, const double light[BANDS_MOST],
                   const double surface[BANDS_MOST], double rgb[3])
{
    for (int i = 0; i < 3; i++) {
        rgb[i] = 0;
        for (size_t k = 0; k < bands->count; k++) {
            rgb[i] += light[k] * (surface != NULL ? surface[k] : 1) * bands->rgb[k][i];
        }
    }
}

/* White is 1 in each band, and colours of sRGB come back: exactly, whatever the count. */
static void test_colours_return(void)
{
    static const double colours[][3] = {{1, 0, 0}, {0, 1, 0},     {0, 0, 1},
                                        {1, 1, 1}, {0.2, 0.9, 0}, {0.18, 0.18, 0.18}};
    const struct spectrum d65 = named("D65");
    struct bands bands;
    struct error error;
    for (size_t count = BANDS_LEAST; count <= BANDS_MOST; count++) {
        double white[BANDS_MOST], of[BANDS_MOST], rgb[3];
        CHECK(bands_many(count, &bands, &error) && bands.count == count);
        CHECK(bands_of_light(&bands, &d65, white, NULL, &error));
        for (size_t k = 0; k < count; k++) {
            const double *basis = bands.basis[k];
            CHECK_NEAR(white[k], 1, 1e-13, "white of a band");
            CHECK(basis[0] >= 0 && basis[1] >= 0 && basis[2] >= 0);
            CHECK_NEAR(basis[0] + basis[1] + basis[2], 1, 1e-15, "sum of the primaries");
            CHECK_NEAR(bands.wavelength[k], 0.39 + 0.32 * ((double)k + 0.5) / (double)count, 1e-15,
                       "wavelength");
        }
        for (size_t c = 0; c < sizeof colours / sizeof colours[0]; c++) {
            const struct spectrum surface = {.kind = SPECTRUM_RGB,
                                             .rgb = {colours[c][0], colours[c][1], colours[c][2]}};
            CHECK(bands_of_surface(&bands, &surface, of, NULL, &error));
            rgb_of(&bands, white, of, rgb);
            for (int i = 0; i < 3; i++) {
                CHECK_NEAR(rgb[i], colours[c][i], 1e-13, "a colour of sRGB");
            }
        }
    }
    CHECK(!bands_many(7, &bands, &error) && !bands_many(65, &bands, &error));
    CHECK_TEXT(error.message, "65 bands of the spectrum; there may be 8 to 64");
}

/* Lights have luminance 1; what they make of surfaces is what the whole sums make of them. */
static void test_many_lights(void)
{
    enum { ROWS = 48 };
    double wavelength[ROWS], value[3][ROWS];
    for (int i = 0; i < ROWS; i++) {
        wavelength[i] = 0.36 + 0.01 * i;
        value[0][i] = 0.05 + 0.85 / (1 + exp((0.55 - wavelength[i]) / 0.02)); /* orange */
        value[1][i] = 0.8 * exp(-pow((wavelength[i] - 0.52) / 0.05, 2));      /* green */
        value[2][i] = 0.7 * exp(-pow((wavelength[i] - 0.45) / 0.06, 2));      /* blue */
    }
    struct bands bands;
    struct error error;
    CHECK(bands_many(32, &bands, &error));
    for (const struct word *word = illuminant_words; word->word != NULL; word++) {
        const struct spectrum light = named(word->word);
        const double allowed = word->word[0] == 'F' ? 0.008 : 0.002;
        double of[BANDS_MOST], held, shares[BANDS_MOST], xyz[1][3], lit[1][3], rgb[3];
        CHECK(bands_of_light(&bands, &light, of, &held, &error) && held == 1);
        CHECK_NEAR(luminance(&bands, of), 1, 1e-13, word->word);
        observer_sum(&light, NULL, seen, 1, xyz);
        for (int c = 0; c < 3; c++) {
            const struct spectrum surface = {
                .kind = SPECTRUM_TABLE, .count = ROWS, .wavelength = wavelength, .value = value[c]};
            CHECK(bands_of_surface(&bands, &surface, shares, NULL, &error));
            rgb_of(&bands, of, shares, rgb);
            observer_sum(&light, &surface, seen, 1, lit);
            for (int i = 0; i < 3; i++) {
                const double *row = colour_xyz_of_srgb.at[i];
                CHECK_NEAR(row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2],
                           lit[0][i] / xyz[0][1], allowed, word->word);
            }
        }
    }
}

/* Linear sRGB to X/Y and Z/Y. */
static void ratios_of(const struct bands *bands, const double of[BANDS_MOST], double ratios[2])
{
    double rgb[3], xyz[3] = {0};
    rgb_of(bands, of, NULL, rgb);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            xyz[i] += colour_xyz_of_srgb.at[i][j] * rgb[j];
        }
    }
    ratios[0] = xyz[0] / xyz[1];
    ratios[1] = xyz[2] / xyz[1];
}

/*
 * Light that is narrow has the colour that the observer's table gives by sums over its steps of
 * 5 nm, by a program of its own, within what the white of sRGB, rounded, differs from sums over
 * D65.
 */
static void test_narrow(void)
{
    static const struct {
        double wavelength[5], value[5], x, z; /* X/Y, Z/Y */
        size_t least;                         /* bands that hold it */
    } lights[] = {
        {{0.385, 0.395, 0.405, 0.415, 0.425}, {0, 0.14, 1, 0.14, 0}, 35.69341, 170.11076, 24},
        {{0.420, 0.435, 0.450, 0.465, 0.480}, {0, 0.3, 1, 0.3, 0}, 7.407431, 39.604874, 16},
        {{0.600, 0.610, 0.620, 0.630, 0.640}, {0, 0.3, 1, 0.3, 0}, 2.192458, 0.000508, 32},
    };
    struct bands bands;
    struct error error;
    for (size_t i = 0; i < sizeof lights / sizeof lights[0]; i++) {
        const struct spectrum light = {.kind = SPECTRUM_TABLE,
                                       .count = 5,
                                       .wavelength = lights[i].wavelength,
                                       .value = lights[i].value};
        for (size_t count = lights[i].least; count <= BANDS_MOST; count++) {
            double of[BANDS_MOST], ratios[2];
            CHECK(bands_many(count, &bands, &error));
            CHECK(bands_of_light(&bands, &light, of, NULL, &error));
            ratios_of(&bands, of, ratios);
            CHECK_NEAR(ratios[0], lights[i].x, 5e-4 * lights[i].x, "X/Y");
            CHECK_NEAR(ratios[1], lights[i].z, 5e-4 * (lights[i].z + 1), "Z/Y");
            CHECK(bands_off(&bands, &light, of) < 5e-5);
        }
    }
}

/* Lines anywhere, in any count: luminance 1, by parts and of bands that are not below 0. */
static void test_lines(void)
{
    static const double value[] = {0, 1, 0};
    struct bands bands;
    struct error error;
    for (size_t count = BANDS_LEAST; count <= BANDS_MOST; count += count < 16 ? 1 : 16) {
        CHECK(bands_many(count, &bands, &error));
        for (size_t k = 0; k < count; k++) {
            CHECK(colour_luminance(bands.rgb[k]) > 0);
        }
        for (int l = 365; l < 825; l += 5) {
            const double wavelength[] = {l / 1000.0 - 0.001, l / 1000.0, l / 1000.0 + 0.001};
            const struct spectrum light = {
                .kind = SPECTRUM_TABLE, .count = 3, .wavelength = wavelength, .value = value};
            double of[BANDS_MOST], least = 0;
            CHECK(bands_of_light(&bands, &light, of, NULL, &error));
            for (size_t k = 0; k < count; k++) {
                least = fmin(least, of[k]);
            }
            CHECK(least == 0);
            CHECK_NEAR(luminance(&bands, of), 1, 1e-12, "a line");
            CHECK(bands_off(&bands, &light, of) < (count < 16 ? 0.07 : 0.03));
        }
    }
}

/* How many bands a line of 500 nm needs; RGB is the same in all. */
static void test_needed(void)
{
    static const double wavelength[] = {0.499, 0.500, 0.501}, value[] = {0, 1, 0};
    const struct spectrum line = {
        .kind = SPECTRUM_TABLE, .count = 3, .wavelength = wavelength, .value = value};
    const struct spectrum red = {.kind = SPECTRUM_RGB, .rgb = {1, 0, 0}};
    struct bands bands;
    struct error error;
    double of[BANDS_MOST], off;
    const size_t count = bands_needed(&line, 0.002, &off);
    CHECK(bands_many(count, &bands, &error));
    CHECK(bands_of_light(&bands, &line, of, NULL, &error));
    CHECK(off <= 0.002 && bands_off(&bands, &line, of) == off);
    CHECK(bands_needed(&line, 0, &off) > count && off > 0 && off < 0.002);
    CHECK(bands_needed(&red, 0, &off) == BANDS_LEAST && off == 0);
}

static void test_refused(void)
{
    static const double rising[] = {0.4, 0.5}, level[] = {0.4, 0.4}, far[] = {1.0, 1.1};
    static const double nothing[] = {0, 0}, much[] = {0.5, 1.5}, some[] = {1, 1};
    const double wrong[] = {1, (double)NAN};
    const struct {
        struct spectrum spectrum;
        bool is_surface;
        const char *message;
    } cases[] = {
        {{.kind = SPECTRUM_NONE}, false, "no spectrum is given"},
        {{.kind = SPECTRUM_RGB, .rgb = {1, -1, 0}},
         false,
         "green of the colour is -1; it must be a number of at least 0"},
        {{.kind = SPECTRUM_RGB},
         false,
         "the spectrum of the light has nothing between 0.36 and 0.83 um: no eye sees it"},
        {{.kind = SPECTRUM_TABLE, .count = 2, .wavelength = rising, .value = nothing},
         false,
         "the spectrum of the light has nothing between 0.36 and 0.83 um: no eye sees it"},
        {{.kind = SPECTRUM_TABLE, .count = 2, .wavelength = far, .value = some},
         false,
         "the spectrum of the light has nothing between 0.36 and 0.83 um: no eye sees it"},
        {{.kind = SPECTRUM_TABLE, .count = 2, .wavelength = level, .value = some},
         false,
         "the wavelength 0.4 um of the spectrum is not above the one before it"},
        {{.kind = SPECTRUM_TABLE, .count = 2, .wavelength = rising, .value = wrong},
         false,
         "a value of the spectrum is nan; it must be a number of at least 0"},
        {{.kind = SPECTRUM_TABLE, .count = 1, .wavelength = rising, .value = some},
         false,
         "a table of a spectrum has at least two rows"},
        {{.kind = SPECTRUM_TABLE, .count = 2, .wavelength = rising, .value = much},
         true,
         "a surface reflects 1.5 of the light; at most is 1"},
        {{.kind = SPECTRUM_DAYLIGHT, .kelvin = 5000},
         true,
         "a surface has the spectrum of a light"},
    };
    struct bands bands;
    double of[BANDS_MOST];
    struct error error;
    bands_three(&bands);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK(!(cases[i].is_surface
                    ? bands_of_surface(&bands, &cases[i].spectrum, of, NULL, &error)
                    : bands_of_light(&bands, &cases[i].spectrum, of, NULL, &error)));
        CHECK(error.code == ERROR_DOMAIN);
        CHECK_TEXT(error.message, cases[i].message);
    }
}

/*
 * Magnitude 0 of the AB scale is 3631 Jy at every frequency: 683 lm/W times the integral of
 * 3631e-26 c/l^2 V(l) over the wavelength, here with the observer's own y.
 */
static void test_stars(void)
{
    double wavelength[95], flux[95], xyz[1][3];
    for (int i = 0; i < 95; i++) {
        wavelength[i] = 0.36 + 0.005 * i;
        flux[i] = 3631e-26 * 299792458 / (wavelength[i] * wavelength[i] * 1e-12); /* W/m^2/m */
    }
    const struct spectrum light = {
        .kind = SPECTRUM_TABLE, .count = 95, .wavelength = wavelength, .value = flux};
    observer_sum(&light, NULL, seen, 1, xyz);
    CHECK_RELATIVE(illuminant_star(0), 683 * 1e-6 * xyz[0][1], 0.02, "magnitude 0");
    CHECK_RELATIVE(illuminant_star(5), 2.54e-8, 1e-14, "magnitude 5");
}

/*
 * Of all changes that give the colour, the one with the smallest sum (y - a)^2/2 w: there
 * (y - a)/w = c.m with one m for all bands that have light.
 */
static void test_match_is_least(void)
{
    struct bands bands;
    double of[BANDS_MOST], y[BANDS_MOST], a[BANDS_MOST], c[BANDS_MOST][3], w[BANDS_MOST];
    CHECK(bands_many(16, &bands, &(struct error){0}));
    double all = 0, unmatched[BANDS_MOST];
    for (size_t k = 0; k < bands.count; k++) {
        unmatched[k] = 0.2 + (double)(k * 7 % 5);
        of[k] = unmatched[k];
    }
    const struct spectrum light = named("F11");
    bands_match(&bands, &light, of);
    double sum = 0;
    for (size_t k = 0; k < bands.count; k++) {
        const struct colour rgb = {{bands.rgb[k][0], bands.rgb[k][1], bands.rgb[k][2]}};
        const struct colour xyz = colour_turned(&colour_xyz_of_srgb, rgb);
        const double unit = xyz.part[0] + xyz.part[1] + xyz.part[2];
        a[k] = unmatched[k] * unit;
        y[k] = of[k] * unit;
        all += a[k];
        sum += y[k];
        for (int i = 0; i < 3; i++) {
            c[k][i] = xyz.part[i] / unit;
        }
    }
    double normal[3][4] = {{0}};
    for (size_t k = 0; k < bands.count; k++) {
        a[k] /= all;
        y[k] /= sum;
    }
    for (size_t k = 0; k < bands.count; k++) {
        const double last = k > 0 ? a[k - 1] : 0, next = k + 1 < bands.count ? a[k + 1] : 0;
        w[k] = a[k] / 2 + (last + next) / 4;
        for (int i = 0; i < 3 && y[k] > 0; i++) {
            for (int j = 0; j < 3; j++) {
                normal[i][j] += c[k][i] * c[k][j];
            }
            normal[i][3] += c[k][i] * (y[k] - a[k]) / w[k];
        }
    }
    for (int i = 0; i < 3; i++) { /* Gauss and Jordan */
        for (int j = 0; j < 3; j++) {
            const double factor = j == i ? 0 : normal[j][i] / normal[i][i];
            for (int n = 0; n < 4; n++) {
                normal[j][n] -= factor * normal[i][n];
            }
        }
    }
    size_t lit = 0;
    for (size_t k = 0; k < bands.count; k++) {
        double expected = 0;
        for (int i = 0; i < 3; i++) {
            expected += c[k][i] * normal[i][3] / normal[i][i];
        }
        lit += y[k] > 0;
        if (y[k] > 0) {
            /* the sum of shares is 1 within the penalty of 1e-10 */
            CHECK_NEAR((y[k] - a[k]) / w[k], expected, 1e-6, "one multiplier for all bands");
        }
    }
    CHECK(lit > 8);
}

int main(void)
{
    test_chromaticities();
    test_values();
    test_names();
    test_lights();
    test_surfaces();
    test_colours_return();
    test_many_lights();
    test_narrow();
    test_lines();
    test_needed();
    test_refused();
    test_stars();
    test_match_is_least();
    return check_report();
}
