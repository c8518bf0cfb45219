/* tests/unit/test_pupil_fan.c - pupil aberrations against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/pupil_fan.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"

enum { POINTS = 5 };

/* The fan of a field of a lens, whose numbers last as long as the arena; false: with an error. */
static bool trace(const char *text, double degrees, bool clip, struct arena *arena, struct fan *fan,
                  struct error *error)
{
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct lens *lens = ARENA_NEW(arena, struct lens);
    const struct setup_question question = {
        .lens = lens, .wavelength = NAN, .fnumber = NAN, .wavelengths = WAVELENGTHS_PRIMARY};
    struct field_point *field = ARENA_NEW(arena, struct field_point);
    *field = (struct field_point){FIELD_ANGLE, {0, degrees * RADIANS_PER_DEGREE}};
    const struct bundle_question bundle = {.setup = setup, .field = field, .clip = clip};
    CHECK(lens_read("test", text_of(text), NULL, arena, lens, error) &&
          setup_open(&question, arena, setup, error));
    return pupil_fan_trace(&bundle, POINTS, arena, fan, error);
}

/* A stop in front of the lens is its entrance pupil. */
static void test_in_front(void)
{
    struct arena arena = {0};
    struct error error = {0};
    struct fan fan;
    CHECK(trace("wavelength d\nobject inf\naperture epd 4\nstop - 2 air -\nsurface 50 2 1.5 -\n"
                "surface - 98 air -\n",
                20, true, &arena, &fan, &error));
    for (size_t i = 0; i < (size_t)(FAN_SECTIONS * POINTS); i++) {
        CHECK(fan.rays[i].status == RAY_OK);
        CHECK_NEAR(hypot(fan.rays[i].off[0], fan.rays[i].off[1]), 0, 1e-15, "stop in front");
    }
    arena_free(&arena);
}

/*
 * A plate, t = 20, n = 1.5, 10 in front of a stop of radius 5: the paraxial pupil lies t/n + 10
 * behind the plate's face, real rays cross the stop t (tan(angle in glass) - tan(angle)/n) off.
 */
static void test_plate(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 20 1.5 -\n"
                               "surface - 10 air -\nstop - 50 air 10\n";
    const double angle = 30 * RADIANS_PER_DEGREE, n = 1.5;
    const double off = 20 * (tan(asin(sin(angle) / n)) - tan(angle) / n) / 5;
    struct arena arena = {0};
    struct error error = {0};
    struct fan fan;
    CHECK(trace(text, 30, true, &arena, &fan, &error));
    for (size_t i = 0; i < (size_t)(FAN_SECTIONS * POINTS); i++) {
        const double h = (double)(i % POINTS) / 2 - 1;
        const struct fan_ray *ray = &fan.rays[i];
        CHECK_NEAR(ray->pupil[i < POINTS ? 1 : 0], h, 1e-15, "pupil");
        CHECK_NEAR(ray->off[0], 0, 1e-14, "plate, x");
        CHECK_NEAR(ray->off[1], off, 1e-13, "plate, y");
    }
    arena_free(&arena);
}

/* A surface, R = 50, and a stop of radius 8 in glass 30 behind it, n = 1.5: rays of the axis. */
static void test_sphere(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface 50 30 1.5 -\n"
                               "stop - 70 1.5 16\nsurface - 10 air -\n";
    const double R = 50, n = 1.5, z = 30, stop = 8;
    const double radius = stop / (1 - z * (n - 1) / (n * R)); /* of the entrance pupil */
    struct arena arena = {0};
    struct error error = {0};
    struct fan fan;
    CHECK(trace(text, 0, true, &arena, &fan, &error));
    for (size_t i = 0; i < POINTS; i++) {
        const double share = (double)i / 2 - 1, h = share * radius;
        const double incidence = asin(h / R), sag = R * (1 - cos(incidence));
        const double y = h - (z - sag) * tan(incidence - asin(h / (n * R)));
        CHECK_NEAR(fan.rays[i].off[1], y / stop - share, 1e-14, "sphere, tangential");
        CHECK_NEAR(fan.rays[POINTS + i].off[0], y / stop - share, 1e-14, "sphere, sagittal");
    }
    CHECK(fabs(fan.rays[0].off[1]) > 1e-6);
    arena_free(&arena);
}

/* An aperture in front of the stop blocks rays, the stop itself none. */
static void test_clipped(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 20 air 8\n"
                               "stop - 50 air 10\n";
    struct arena arena = {0};
    struct error error = {0};
    struct fan fan;
    CHECK(trace(text, 0, true, &arena, &fan, &error));
    CHECK(fan.rays[0].status == RAY_CLIPPED && fan.rays[0].surface == 1);
    CHECK(isnan(fan.rays[0].off[1]) && fan.rays[1].status == RAY_OK);
    CHECK(trace(text, 0, false, &arena, &fan, &error) && fan.rays[0].status == RAY_OK);
    CHECK(!trace("wavelength d\nobject inf\naperture epd 4\nsurface 50 2 1.5 -\n"
                 "surface - 98 air -\n",
                 0, true, &arena, &fan, &error) &&
          error.code == ERROR_DOMAIN);
    arena_free(&arena);
}

int main(void)
{
    test_in_front();
    test_plate();
    test_sphere();
    test_clipped();
    return check_report();
}
