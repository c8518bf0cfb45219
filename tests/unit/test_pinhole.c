/* tests/unit/test_pinhole.c - pinhole cameras, by what others worked out. */
/* SPDX-License-Identifier: MIT */
#include "photo/pinhole.h"

#include <math.h>

#include "check.h"

static void test_published(void)
{
    static const struct {
        double f, wavelength, d, tolerance; /* mm */
        enum pinhole_rule rule;
        const char *source;
    } rows[] = {
        {49, 0.00055, 0.31, 0.005, PINHOLE_RAYLEIGH, "tomroelandts.com, Details: diameter"},
        {100, 0.00055, 0.366, 5e-4, PINHOLE_AIRY, "mail-archive.com, sundials: diameter"},
        {100, 0.000555, 0.3679, 1e-4, PINHOLE_AIRY, "G. Penate, 0.03679 sqrt f: diameter"},
        {100, 0.0005, 0.4472135955, 1e-9, PINHOLE_YOUNG, "[Young89] radius sqrt(w f): diameter"},
    };
    check_source("pinholes", "mm");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const struct pinhole_setting setting = {rows[i].f, INFINITY, rows[i].wavelength};
        struct error error;
        double d;
        CHECK(pinhole_best(&setting, rows[i].rule, &d, &error));
        CHECK_NEAR(d, rows[i].d, rows[i].tolerance, rows[i].source);
    }
    check_source(NULL, "");
}

/* [Mielenz99]: u = 2 pi a^2 (1/f + 1/s)/w is 1.8 pi by Rayleigh, pi by Petzval. */
static void test_mielenz(void)
{
    const double pi = 3.14159265358979323846;
    static const double distances[] = {INFINITY, 5000, 120};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        const struct pinhole_setting setting = {150, distances[i], 0.00055};
        struct error error;
        struct pinhole hole;
        double d;
        CHECK(pinhole_best(&setting, PINHOLE_RAYLEIGH, &d, &error));
        double u = 2 * pi * (d / 2) * (d / 2) * (1 / 150.0 + 1 / distances[i]) / 0.00055;
        CHECK_RELATIVE(u, 1.8 * pi, 1e-14, "Rayleigh");
        CHECK(pinhole_find(&setting, PINHOLE_RAYLEIGH, d, &hole, &error));
        CHECK_RELATIVE(hole.best_f, 150.0, 1e-12, "the depth again");
        CHECK(pinhole_best(&setting, PINHOLE_PETZVAL, &d, &error));
        u = 2 * pi * (d / 2) * (d / 2) * (1 / 150.0 + 1 / distances[i]) / 0.00055;
        CHECK_RELATIVE(u, pi, 1e-14, "Petzval");
    }
}

static void test_find(void)
{
    struct pinhole_setting setting = {49, INFINITY, 0.00055};
    struct pinhole hole;
    struct error error;
    CHECK(pinhole_find(&setting, PINHOLE_RAYLEIGH, 0.3, &hole, &error));
    CHECK_NEAR(hole.fnumber, 163, 0.5, "T. Roelandts: 49 mm/0.3 mm");
    CHECK_NEAR(hole.blur, 0.3, 0, "the shadow of what is far is the hole");
    CHECK(pinhole_find(&setting, PINHOLE_RAYLEIGH, 0.1, &hole, &error));
    CHECK_RELATIVE(hole.blur, 2.44 * 0.00055 * 490, 1e-14, "the Airy disc of f/490");
    setting.s = 49;
    CHECK(pinhole_find(&setting, PINHOLE_RAYLEIGH, 0.4, &hole, &error));
    CHECK_NEAR(hole.blur, 0.8, 1e-15, "the shadow from as far as the film is twice the hole");
    setting.s = 10;
    CHECK(pinhole_find(&setting, PINHOLE_RAYLEIGH, 0.4, &hole, &error));
    CHECK(isinf(hole.best_f));
}

static void test_refusals(void)
{
    static const struct pinhole_setting wrong[] = {
        {0, INFINITY, 0.00055}, {-1, 100, 0.00055}, {NAN, 100, 0.00055},
        {50, 0, 0.00055},       {50, 100, 0},       {INFINITY, 1, 1},
    };
    const struct pinhole_setting good = {50, INFINITY, 0.00055};
    struct pinhole hole;
    struct error error;
    double d;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        CHECK(!pinhole_best(&wrong[i], PINHOLE_RAYLEIGH, &d, &error));
        CHECK(!pinhole_find(&wrong[i], PINHOLE_RAYLEIGH, 0.3, &hole, &error));
    }
    CHECK(!pinhole_find(&good, PINHOLE_RAYLEIGH, 0, &hole, &error));
    CHECK_TEXT(error.message, "a hole of 0 mm is not above 0 and finite");
    /* squares that no number holds: the hole, or its f-number, is none */
    CHECK(!pinhole_best(&(struct pinhole_setting){1e-200, INFINITY, 1e-200}, PINHOLE_RAYLEIGH, &d,
                        &error));
    CHECK_TEXT(error.message, "the best hole is too small or large for a number");
    CHECK(!pinhole_best(&(struct pinhole_setting){1e200, INFINITY, 1e200}, PINHOLE_RAYLEIGH, &d,
                        &error));
    CHECK_TEXT(error.message, "the best hole is too small or large for a number");
    CHECK(!pinhole_find(&(struct pinhole_setting){50, INFINITY, 1e300}, PINHOLE_RAYLEIGH, 1e-20,
                        &hole, &error));
    CHECK_TEXT(error.message, "the hole is too small for a number");
    CHECK(!pinhole_find(&good, PINHOLE_RAYLEIGH, 1e-320, &hole, &error));
    CHECK_TEXT(error.message, "the hole is too small for a number");
    CHECK(!pinhole_find(&good, PINHOLE_RAYLEIGH, INFINITY, &hole, &error));
}

int main(void)
{
    test_published();
    test_mielenz();
    test_find();
    test_refusals();
    return check_report();
}
