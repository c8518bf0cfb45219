/* tests/unit/test_diffraction.c - Airy disc, MTF and best f-number against outside values. */
/* SPDX-License-Identifier: MIT */
#include "photo/diffraction.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

/* tests/truth/diffraction.tsv: frequency, wavelength in mm, f-number, MTF, cut-off, Airy radius. */
static void test_truth(void)
{
    FILE *file = fopen("tests/truth/diffraction.tsv", "r");
    CHECK(file != NULL);
    char line[512];
    int rows = 0;
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        double c[6];
        char *at = line;
        if (line[0] == '#' || line[0] == 'f') {
            continue;
        }
        for (int i = 0; i < 6; i++) {
            c[i] = strtod(at, &at);
        }
        struct diffraction_setting s = {c[2], 0, 1, 1000 * c[1], 0, 0};
        struct diffraction d;
        struct diffraction_mtf mtf;
        struct error error;
        CHECK(diffraction_compute(&s, &d, &error));
        CHECK(diffraction_mtf_at(&s, c[0], &mtf, &error));
        CHECK_NEAR(mtf.total, c[3], 1e-13, "truth: MTF");
        CHECK_RELATIVE(d.cutoff, c[4], 1e-14, "truth: cut-off");
        CHECK_RELATIVE(d.airy_radius, c[5], 1e-14, "truth: Airy radius");
        rows++;
    }
    CHECK(rows == 40);
    if (file != NULL) {
        fclose(file);
    }
}

static void test_airy(void)
{
    static const struct {
        double N, nm, radius_um, tolerance;
        const char *source;
    } rows[] = {
        {64, 500, 39.04, 0.02, "lecture: 1.22 x 64 x 0.5 um = 0.03904 mm; exact constant 0.039029"},
        {64, 500, 39.029436520528144, 1e-11, "3.8317059702075123 (DLMF 10.21)/pi x 32 um"},
        {8, 555, 5.42, 0.01, "Imatest, diffraction: 1.22 x 0.555 um x 8"},
        {16, 550, 10.74, 0.01, "Born and Wolf 8.5.2: 1.22 wavelength N"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct diffraction_setting s = {rows[i].N, 0, 1, rows[i].nm / 1000, 0, 0};
        struct diffraction d;
        struct error error;
        CHECK(diffraction_compute(&s, &d, &error));
        CHECK_NEAR(1000 * d.airy_radius, rows[i].radius_um, rows[i].tolerance, rows[i].source);
        CHECK_RELATIVE(d.airy_diameter, 2 * d.airy_radius, 1e-15, "diameter");
        CHECK_RELATIVE(d.rayleigh_frequency * d.rayleigh, 1.0, 1e-15, "1/Rayleigh");
        CHECK(isinf(d.nyquist));
    }
}

/* At 1:1 a lens at f/8 works at f/16, at P = 2 at f/12. */
static void test_close_up(void)
{
    struct diffraction_setting s = {8, 1, 1, 0.55, 0, 0.004};
    struct diffraction d;
    struct error error;
    CHECK(diffraction_compute(&s, &d, &error));
    CHECK_NEAR(d.working_fnumber, 16, 1e-14, "1:1");
    CHECK_NEAR(d.nyquist, 125, 1e-12, "4 um pixels");
    s.P = 2;
    CHECK(diffraction_compute(&s, &d, &error));
    CHECK_NEAR(d.working_fnumber, 12, 1e-14, "1:1, P = 2");
}

/* MTF factors by mpmath 1.3 at 30 digits: (2/pi)(acos x - x sqrt(1 - x^2)), 2 J1(z)/z, sin(z)/z. */
static void test_factors(void)
{
    static const struct {
        double x, lens, relative;
    } lens[] = {
        {1e-9, 0.99999999872676045526, 1e-15},
        {0.25, 0.68503764247429256107, 1e-15},
        {0.5, 0.39100221895577064191, 1e-15},
        {0.9, 0.037386073468498645722, 1e-14},
        {0.999, 3.7954974373401407784e-5, 1e-12},
        {0.999999, 1.2004215748128621176e-9, 1e-9}, /* 1 - x itself is known to 1e-10 */
        {1, 0, 0},
        {1.5, 0, 0},
    };
    static const struct {
        double z, defocus;
    } defocus[] = {
        {0, 1},
        {0.5, 0.96907383069949554554},
        {1, 0.88010117148986703192},
        {3, 0.22603930568395763928},
        {5, 0.13103165503658608882},
        {10, 0.0086945492337722873339},
        {50, 0.0039004731250070055065},
    };
    const double pi = acos(-1);
    struct diffraction_mtf mtf;
    struct error error;
    for (size_t i = 0; i < sizeof lens / sizeof *lens; i++) {
        struct diffraction_setting s = {1, 0, 1, 1000, 0, 0}; /* cut-off 1 per mm */
        CHECK(diffraction_mtf_at(&s, lens[i].x, &mtf, &error));
        CHECK_RELATIVE(mtf.lens, lens[i].lens, lens[i].relative, "mpmath: perfect lens");
    }
    for (size_t i = 0; i < sizeof defocus / sizeof *defocus; i++) {
        struct diffraction_setting s = {1, 0, 1, 1e-6, defocus[i].z / pi, 0};
        CHECK(diffraction_mtf_at(&s, 1, &mtf, &error));
        CHECK_NEAR(mtf.defocus, defocus[i].defocus, 2e-16 * fmax(1, defocus[i].z),
                   "mpmath: defocus");
    }
    struct diffraction_setting s = {4, 0, 1, 0.5, 0, 0.005}; /* at Nyquist a pixel gives 2/pi */
    CHECK(diffraction_mtf_at(&s, 100, &mtf, &error));
    CHECK_RELATIVE(mtf.pixel, 2 / pi, 1e-15, "pixel at Nyquist: 2/pi");
    CHECK_RELATIVE(mtf.total, mtf.lens * mtf.pixel, 1e-15, "product");
    CHECK(diffraction_mtf_at(&s, 200, &mtf, &error));
    CHECK_NEAR(mtf.pixel, 0, 1e-15, "pixel at 1/pitch");
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void test_frequencies(void)
{
    static const struct {
        double level, x, tolerance;
        const char *source;
    } rows[] = {
        {0.5, 0.403972753299517209, 1e-15, "mpmath root"},
        {0.2, 0.687048826132540546, 1e-15, "mpmath root"},
        {0.1, 0.805383636520119782, 1e-15, "mpmath root"},
        {0.5, 0.4, 0.01, "Littlefield, photomacrography.net 124831: 50 % at about 40 %"},
        {0.1, 0.8, 0.01, "Littlefield, photomacrography.net 124831: 10 % at about 80 %"},
    };
    struct diffraction_setting perfect = {10, 0, 1, 0.5, 0, 0};
    struct error error;
    double nu;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        CHECK(diffraction_frequency(&perfect, rows[i].level, &nu, &error));
        CHECK_NEAR(nu / 200, rows[i].x, rows[i].tolerance, rows[i].source);
    }
    uint64_t state = 17;
    for (int i = 0; i < 2000; i++) {
        struct diffraction_setting s = {1 + 30 * uniform(&state), uniform(&state),
                                        0.5 + uniform(&state),    0.4 + 0.3 * uniform(&state),
                                        0.05 * uniform(&state),   0.01 * uniform(&state)};
        double level = 0.02 + 0.96 * uniform(&state);
        struct diffraction_mtf mtf, before;
        CHECK(diffraction_frequency(&s, level, &nu, &error));
        CHECK(diffraction_mtf_at(&s, nu, &mtf, &error));
        CHECK_NEAR(mtf.total, level, 1e-13, "the MTF at the frequency is the level");
        CHECK(diffraction_mtf_at(&s, nu * uniform(&state), &before, &error));
        CHECK(before.total >= level - 1e-13);
    }
    CHECK(!diffraction_frequency(&perfect, 1, &nu, &error));
    CHECK(!diffraction_frequency(&perfect, 0, &nu, &error));
}

static void test_fnumber(void)
{
    double N;
    struct error error;
    CHECK(diffraction_fnumber(2 * 0.039029436520528144, 0.5, 0, 1, &N, &error));
    CHECK_RELATIVE(N, 64.0, 1e-14, "back to the lecture's f/64");
    CHECK(diffraction_fnumber(2 * 0.039029436520528144, 0.5, 1, 1, &N, &error));
    CHECK_RELATIVE(N, 32.0, 1e-14, "at 1:1 f/32 as marked");
    CHECK(!diffraction_fnumber(0, 0.5, 0, 1, &N, &error));
}

/* Hansma's table (largeformatphotography.info/fstop.html): focus spread in mm, f-number written as
   a stop and tenths of a stop. Within a quarter of a stop: the table is rounded and takes 375. */
static void test_optimum(void)
{
    static const struct {
        double spread, stop;
        int tenths;
    } hansma[] = {{1, 16, 6},     {2, 22.627, 6}, {3, 32, 2},     {4, 32, 6},     {5, 32, 9},
                  {6, 45.255, 2}, {7, 45.255, 4}, {8, 45.255, 6}, {9, 45.255, 8}, {10, 64, 0}};
    struct diffraction_optimum o;
    struct error error;
    for (size_t i = 0; i < sizeof hansma / sizeof *hansma; i++) {
        CHECK(diffraction_optimum(hansma[i].spread, 0.546, 0, 1, &o, &error));
        double stops = 2 * log2(o.fnumber / hansma[i].stop);
        CHECK_NEAR(stops, 0.1 * hansma[i].tenths, 0.25, "Hansma's table");
        CHECK_RELATIVE(o.fnumber, sqrt(375 * hansma[i].spread), 0.002, "Hansma: sqrt(375 D)");
        CHECK_RELATIVE(o.airy_diameter, o.defocus, 1e-14, "both blurs equal");
        CHECK_RELATIVE(o.blur, sqrt(2) * o.defocus, 1e-14, "combined blur");
    }
    /* a minimum: any other f-number is worse */
    CHECK(diffraction_optimum(2, 0.55, 0.5, 1, &o, &error));
    CHECK_RELATIVE(o.working_fnumber, 1.5 * o.fnumber, 1e-14, "magnification");
    for (int sign = -1; sign <= 1; sign += 2) {
        double N = o.working_fnumber * (1 + 0.02 * sign);
        CHECK(hypot(2 / (2 * N), 2 * DIFFRACTION_AIRY_RADIUS * 0.00055 * N) > o.blur);
    }
    CHECK(!diffraction_optimum(0, 0.55, 0, 1, &o, &error));
}

static void test_focus_spread(void)
{
    double spread;
    struct error error;
    CHECK(diffraction_focus_spread(150, 3150, (double)INFINITY, &spread, &error));
    CHECK_NEAR(spread, 7.5, 1e-13, "Newton: 150^2/3000");
    CHECK(diffraction_focus_spread(150, 3150, 3150, &spread, &error));
    CHECK_NEAR(spread, 0, 0, "flat subject");
    CHECK(diffraction_focus_spread(50, 450, 1000, &spread, &error)); /* 56.25 - 1000/19 */
    CHECK_NEAR(spread, 56.25 - 1000.0 / 19, 1e-13, "difference of image distances");
    CHECK(!diffraction_focus_spread(50, 40, 1000, &spread, &error));
    CHECK(!diffraction_focus_spread(50, 400, 100, &spread, &error));
}

static void test_angles(void)
{
    const double arcsec = acos(-1) / 648000;
    struct diffraction_angles a;
    struct error error;
    CHECK(diffraction_resolve(116, 0.55, &a, &error));
    CHECK_NEAR(a.dawes / arcsec, 1, 1e-14, "Wikipedia, Dawes' limit: 116/D arcsec");
    CHECK(diffraction_resolve(100, 0.46, &a, &error));
    CHECK_RELATIVE(a.rayleigh, a.dawes, 0.005, "Wikipedia: Dawes agrees with Rayleigh at 460 nm");
    CHECK_RELATIVE(a.sparrow / a.rayleigh, 0.776567, 1e-5,
                   "Sparrow 0.947155 to Rayleigh 1.219670, mpmath");
    CHECK(!diffraction_resolve(0, 0.55, &a, &error));
    /* Sparrow: the sum of two Airy discs is flat half-way, I(x - h) + I(x + h) at x = 0 */
    double h = acos(-1) * DIFFRACTION_SPARROW / 2, t = 1e-3, value[3];
    for (int i = 0; i < 3; i++) { /* 2 J1(z)/z by the defocus factor */
        struct diffraction_setting s = {1, 0, 1, 1e-6, (h + (i - 1) * t) / acos(-1), 0};
        struct diffraction_mtf mtf;
        CHECK(diffraction_mtf_at(&s, 1, &mtf, &error));
        value[i] = mtf.defocus * mtf.defocus;
    }
    CHECK_NEAR((value[0] - 2 * value[1] + value[2]) / (t * t), 0, 1e-6, "Sparrow: no curvature");
}

static void test_refusals(void)
{
    static const struct {
        struct diffraction_setting setting;
        const char *words;
    } rows[] = {
        {{0, 0, 1, 0.5, 0, 0}, "f-number 0"},
        {{8, -1, 1, 0.5, 0, 0}, "magnification -1"},
        {{8, 0, 0, 0.5, 0, 0}, "pupil magnification 0"},
        {{8, 0, 1, NONE, 0, 0}, "wavelength"},
        {{8, 0, 1, 0.5, -0.1, 0}, "blur by defocus -0.1"},
        {{8, 0, 1, 0.5, 0, NONE}, "pixel pitch"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct diffraction d;
        struct error error;
        CHECK(!diffraction_compute(&rows[i].setting, &d, &error));
        CHECK(error.code == ERROR_DOMAIN);
        check_at(strstr(error.message, rows[i].words) != NULL, __FILE__, __LINE__, rows[i].words);
    }
    struct diffraction_setting s = {8, 0, 1, 0.5, 0, 0};
    struct diffraction_mtf mtf;
    struct error error;
    CHECK(!diffraction_mtf_at(&s, -1, &mtf, &error));
}

static void test_numerical_aperture(void)
{
    CHECK_NEAR(fnumber_from_na(0.25, 0, 1), 2, 1e-15, "far away: 1/(2 NA)");
    CHECK_NEAR(fnumber_from_na(0.1, 1, 1), 2.5, 1e-15,
               "life size: 1/(2 x 0.1) is at work, half marked");
    CHECK_NEAR(fnumber_from_na(0.65, 40, 1) * 41, 40 / 1.3, 1e-12, "at work: m/(2 NA)");
    CHECK_NEAR(fnumber_from_na(0.1, 1, 2) * 1.5, 5, 1e-15, "pupils: N (1 + m/P)");
}

int main(void)
{
    test_numerical_aperture();
    test_truth();
    test_airy();
    test_close_up();
    test_factors();
    test_frequencies();
    test_fnumber();
    test_optimum();
    test_focus_spread();
    test_angles();
    test_refusals();
    return check_report();
}
