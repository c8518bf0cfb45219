/* tests/unit/test_vision.c - machine vision: fields near 1:1, pixel densities, line rates. */
/* SPDX-License-Identifier: MIT */
#include <float.h>

#include "check.h"
#include "photo/fov_solve.h"
#include "photo/pixel_density.h"
#include "photo/telecentric.h"

/* Sukhamburg, line scan cameras, focal length: b = 0.099 and OO' = 605 mm want 605/(10.1 + 2). */
static void test_focal_length_from_sensor(void)
{
    struct error error;
    double f = 0, s = 0;
    check_source("vision", "mm");
    CHECK(fov_focal_length_from_sensor(0.099, 605, &f, &s, &error));
    CHECK_NEAR(f, 50, 0.5, "line of 0.099 at 605 mm: focal length");
    check_source(NULL, "");
    CHECK(fov_focal_length_from_sensor(1, 200, &f, &s, &error));
    CHECK_NEAR(f, 50, 0, "1:1: a quarter");
    CHECK_NEAR(s, 100, 0, "1:1: half");
    CHECK(fov_focal_length_from_sensor(0.25, 625, &f, &s, &error));
    CHECK_RELATIVE(f, 100.0, 4 * DBL_EPSILON, "D = f (2 + m + 1/m)");
    CHECK_RELATIVE(s, 500.0, 4 * DBL_EPSILON, "f (1 + 1/m)");
    CHECK(!fov_focal_length_from_sensor(0, 625, &f, &s, &error));
    CHECK(!fov_focal_length_from_sensor(1, -1, &f, &s, &error));
}

/* Schaefter + Kirchhoff, SK1024U3PD manual: 10 um, 45 kHz, 10.24 mm see 20 mm: 879 mm/s. */
static void test_line_rate(void)
{
    check_source("vision", "kHz");
    const double density = pixel_density(10.24 / 20, 0.010, 1);
    CHECK_NEAR(line_rate(879, density) / 1000, 45, 0.03, "SK1024U3PD: line rate");
    /* vision-doctor.com: 2048 pixels on 550 mm at 4 m/s, rounded to 0.27 mm: 14.8 kHz */
    CHECK_NEAR(line_rate(4000, 1 / 0.27) / 1000, 14.8, 0.05, "belt of 4 m/s: line rate");
    /* do3think: 2000 mm/s by 0.1 mm are 20 kHz */
    CHECK_NEAR(line_rate(2000, 1 / 0.1) / 1000, 20, 1e-12, "2 m/s by 0.1 mm: line rate");
    check_source(NULL, "");
    CHECK_RELATIVE(pixel_density(0.5, 0.005, 2), 50.0, 4 * DBL_EPSILON, "squeezed");
    CHECK(isnan(pixel_density(0.5, NAN, 1)));
}

/* mm per pixel, as the tables of both editions have them or their inverse. */
static void test_viewing_tasks(void)
{
    static const struct {
        const char *name;
        double density; /* px/m */
    } tasks[VIEWING_TASKS] = {
        {"monitor", 12.5},    {"detect", 25},    {"observe", 62.5},     {"recognise", 125},
        {"identify", 250},    {"inspect", 1000}, {"overview", 20},      {"outline", 40},
        {"discern", 80},      {"perceive", 125}, {"characterise", 250}, {"validate", 500},
        {"scrutinise", 1500},
    };
    check_source("iec62676", "px/m");
    for (int i = 0; i < VIEWING_TASKS; i++) {
        CHECK_TEXT(viewing_tasks[i].name, tasks[i].name);
        CHECK_NEAR(1000 * viewing_tasks[i].density, tasks[i].density, 1e-9, "the tasks: density");
    }
    check_source(NULL, "");
}

/* Depth 2 c N/m^2, by N or by the aperture at the subject; opto-e: WFN p k/m^2, k 0.015 mm/um. */
static void test_telecentric(void)
{
    struct error error;
    double depth = 0;
    CHECK(telecentric_depth(0.5, 8, 0.005, &depth, &error));
    CHECK_RELATIVE(depth, 0.32, 4 * DBL_EPSILON, "2 0.005 8/0.25");
    CHECK_RELATIVE(telecentric_fnumber(0.5, 0.05), 5.0, 4 * DBL_EPSILON, "m/(2 NA)");
    CHECK(telecentric_depth(0.5, telecentric_fnumber(0.5, 0.05), 0.005, &depth, &error));
    CHECK_RELATIVE(depth, 0.2, 4 * DBL_EPSILON, "c/(m NA)");
    check_source("vision", "mm");
    CHECK(telecentric_depth(0.38, 9.104, 7.5 * 0.0044, &depth, &error));
    CHECK_NEAR(depth, 9.104 * 4.4 * 0.015 / (0.38 * 0.38), 1e-12, "opto-e, k 0.015: depth");
    check_source(NULL, "");
    CHECK(!telecentric_depth(0, 8, 0.005, &depth, &error));
    CHECK(!telecentric_depth(1, -8, 0.005, &depth, &error));
    CHECK(!telecentric_depth(1, 8, 0, &depth, &error));
}

int main(void)
{
    test_telecentric();
    test_focal_length_from_sensor();
    test_line_rate();
    test_viewing_tasks();
    return check_report();
}
