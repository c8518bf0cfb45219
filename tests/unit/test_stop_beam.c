/* tests/unit/test_stop_beam.c - from points of a pupil to the beam: lines, projections, mirrors. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/wavelength.h"
#include "trace/pupil/stop_beam.h"

static struct error error;

static struct beam beam_of_point(double x, double y, double z)
{
    const double point[3] = {x, y, z};
    struct beam beam;
    CHECK(beam_from_point(point, 1.25, &beam, &error));
    return beam;
}

static double slope_of(const struct ray *ray, int axis)
{
    return ray->cosine[axis] / ray->cosine[2];
}

/* What lies at (0, 0): objects before the lens, and one that light runs towards. */
static struct beam beam_at(size_t which)
{
    static const double angles[2] = {0.1, -0.3};
    return which == 0   ? beam_of_point(0, 0, -90)
           : which == 1 ? beam_of_point(20, -35, -90)
           : which == 2 ? beam_of_point(-12, 9, 150)
                        : beam_from_infinity(angles, 1.25);
}

enum { BEAMS = 4 };

static const double places[][2] = {{0, 0}, {0.5, 0}, {0, 0.75}, {-0.6, 0.8}, {0.3, -0.9}};
enum { PLACES = sizeof places / sizeof *places };

/* Rays through the disc of an entrance pupil of radius 4 that lies 7 mm behind the first vertex. */
static void test_entrance(void)
{
    const struct first_order first = {.entrance_diameter = 8, .entrance_pupil = 7};
    struct stop_beam pupil;
    for (size_t which = 0; which < BEAMS; which++) {
        const struct beam beam = beam_at(which);
        CHECK(stop_beam_of_entrance(NULL, &beam, &first, WEIGHT_BEAM, &pupil, &error));
        CHECK(pupil.has_disc && isnan(pupil.radius) && pupil.beam == &beam && pupil.aim == NULL);
        for (size_t i = 0; i < PLACES; i++) {
            double at[2];
            stop_beam_place(&pupil, places[i][0], places[i][1], at);
            const struct ray ray = beam_ray(&beam, at[0], at[1]);
            struct ray aimed;
            CHECK(aim_at_entrance(&beam, &first, places[i][0], places[i][1], &aimed, &error));
            for (int axis = 0; axis < 2; axis++) {
                const double way = 7 - ray.point[2], other = 7 - aimed.point[2];
                CHECK_NEAR(ray.point[axis] + way * slope_of(&ray, axis), 4 * places[i][axis], 1e-13,
                           "in the pupil");
                CHECK_NEAR(aimed.point[axis] + other * slope_of(&aimed, axis), 4 * places[i][axis],
                           1e-13, "aimed at the pupil");
            }
        }
    }
}

/* What has no paraxial entrance pupil, or never meets it, is refused with the reason. */
static void test_refused(void)
{
    static const double aside[3] = {0, 1, 0};
    struct beam moved = beam_of_point(3, -1, 5); /* by 2 along the axis */
    moved.foot[0] = 1;
    moved.foot[2] = 2;
    const struct {
        struct beam beam;
        double diameter, pupil;
        const char *words;
    } cases[] = {
        {beam_at(1), 8, INFINITY, "the entrance pupil is infinitely far away"},
        {beam_at(1), NAN, 7, "the lens has no entrance pupil"},
        {beam_at(1), 8, NAN, "the lens has no entrance pupil"},
        {beam_along(aside, 1), 8, 7, "a field of 90 deg or more never meets"},
        {beam_of_point(0, 0, 7), 8, 7, "the object lies in the plane of the entrance pupil"},
        {beam_of_point(0, 3, 7), 8, 7, "the object lies in the plane of the entrance pupil"},
        {moved, 8, 7, "the object lies in the plane of the entrance pupil"},
        {beam_of_point(3, 0, 7), 8, 7, "the object lies in the plane of the entrance pupil"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct first_order first = {.entrance_diameter = cases[i].diameter,
                                          .entrance_pupil = cases[i].pupil};
        struct stop_beam pupil;
        CHECK(!stop_beam_of_entrance(NULL, &cases[i].beam, &first, WEIGHT_BEAM, &pupil, &error));
        CHECK(strncmp(error.message, cases[i].words, strlen(cases[i].words)) == 0);
    }
}

/* A telecentric object space: a cone about the axis, of slopes v/n = 0.2/1.25 at its edge. */
static void test_telecentric(void)
{
    struct first_order first = {.is_telecentric = true, .marginal_v = 0.2, .index_object = 1.25};
    struct stop_beam pupil;
    for (size_t which = 0; which < 3; which++) {
        const struct beam beam = beam_at(which);
        const double height[2] = {-beam.distance * beam.axis[0], -beam.distance * beam.axis[1]};
        CHECK(stop_beam_of_entrance(NULL, &beam, &first, WEIGHT_BEAM, &pupil, &error));
        for (size_t i = 0; i < PLACES; i++) {
            double at[2];
            stop_beam_place(&pupil, places[i][0], places[i][1], at);
            const struct ray ray = beam_ray(&beam, at[0], at[1]);
            struct ray aimed;
            CHECK(aim_at_entrance(&beam, &first, places[i][0], places[i][1], &aimed, &error));
            for (int axis = 0; axis < 2; axis++) {
                CHECK_NEAR(slope_of(&ray, axis), 0.16 * places[i][axis], 1e-14, "in the cone");
                CHECK_NEAR(slope_of(&aimed, axis), 0.16 * places[i][axis], 1e-14, "aimed");
            }
        }
        /* the chief ray is parallel to the axis, and needs no aperture */
        struct first_order open = first;
        struct ray chief;
        open.marginal_v = NAN;
        CHECK(aim_at_entrance(&beam, &open, 0, 0, &chief, &error));
        for (int axis = 0; axis < 2; axis++) {
            const double back = chief.point[2] * slope_of(&chief, axis);
            CHECK_NEAR(chief.cosine[axis], 0, 1e-15, "parallel to the axis");
            CHECK_NEAR(chief.point[axis] - back, height[axis], 1e-13, "from the object");
        }
        CHECK(!aim_at_entrance(&beam, &open, 0, 1, &chief, &error));
        CHECK(!aim_at_entrance(&beam, &open, 1, 0, &chief, &error));
        CHECK(!stop_beam_of_entrance(NULL, &beam, &open, WEIGHT_BEAM, &pupil, &error));
    }
}

static double square_of(const struct stop_beam *pupil, double u, double v)
{
    enum { X, Y };
    const double h = 1e-4;
    double at[4][2];
    stop_beam_place(pupil, u + h, v, at[0]);
    stop_beam_place(pupil, u - h, v, at[1]);
    stop_beam_place(pupil, u, v + h, at[2]);
    stop_beam_place(pupil, u, v - h, at[3]);
    const double by_u[2] = {at[0][X] - at[1][X], at[0][Y] - at[1][Y]};
    const double by_v[2] = {at[2][X] - at[3][X], at[2][Y] - at[3][Y]};
    return fabs(by_u[X] * by_v[Y] - by_u[Y] * by_v[X]) / (4 * h * h);
}

/* An area of the beam's plane by differences; 1 on the average, by rings of the disc. */
static void test_density(void)
{
    enum { RINGS = 400, ARMS = 64 };
    const struct first_order first = {.entrance_diameter = 24, .entrance_pupil = 17};
    for (size_t which = 0; which < BEAMS; which++) {
        const struct beam beam = beam_at(which);
        struct stop_beam pupil;
        CHECK(stop_beam_of_entrance(NULL, &beam, &first, WEIGHT_BEAM, &pupil, &error));
        double sum = 0;
        for (int i = 0; i < RINGS * ARMS; i++) {
            const double r = sqrt((i / ARMS + 0.5) / RINGS), angle = 2 * PI * (i % ARMS) / ARMS;
            sum += stop_beam_density(&pupil, r * cos(angle), r * sin(angle));
        }
        CHECK_NEAR(sum / (RINGS * ARMS), 1, 1e-6, "mean");
        for (size_t i = 0; i < PLACES; i++) {
            const double u = places[i][0], v = places[i][1];
            CHECK_RELATIVE(stop_beam_density(&pupil, u, v) / stop_beam_density(&pupil, 0, 0),
                           square_of(&pupil, u, v) / square_of(&pupil, 0, 0), 1e-7, "density");
            /* of a part of a line, where that ends in the beam */
            for (double share = 0; share <= 1; share += 0.25) {
                const double from[2] = {0.2, -0.1};
                const double part = stop_beam_share(&pupil, from, places[i], share);
                double ends[2][2], here[2];
                stop_beam_place(&pupil, from[0], from[1], ends[0]);
                stop_beam_place(&pupil, u, v, ends[1]);
                stop_beam_place(&pupil, from[0] + part * (u - from[0]),
                                from[1] + part * (v - from[1]), here);
                for (int axis = 0; axis < 2; axis++) {
                    CHECK_NEAR(here[axis], ends[0][axis] + share * (ends[1][axis] - ends[0][axis]),
                               1e-12, "share of a line");
                }
            }
        }
    }
}

/* Over a stop: what a linear aim says of the rays is where they should be there, exactly. */
static void test_of_stop(void)
{
    const struct aim aim = {.beam = beam_at(1),
                            .chief = {0.4, -1.5},
                            .centre = {0.25, -0.6},
                            .slope = {0.8, 0.3, -0.2, 0.5},
                            .stop_radius = 3};
    const struct stop_beam pupil = stop_beam_of_stop(&aim, NULL, WEIGHT_PUPIL);
    CHECK(pupil.radius == 3 && pupil.aim == &aim && pupil.beam == &aim.beam && !pupil.has_disc);
    CHECK(pupil.weight == WEIGHT_PUPIL);
    for (size_t i = 0; i < PLACES; i++) {
        const double *place = places[i], from[2] = {0.2, -0.1};
        double at[2];
        stop_beam_place(&pupil, place[0], place[1], at);
        for (int k = 0; k < 2; k++) {
            const double in_stop = aim.centre[k] + aim.slope[2 * k] * (at[0] - aim.chief[0]) +
                                   aim.slope[2 * k + 1] * (at[1] - aim.chief[1]);
            CHECK_NEAR(in_stop, 3 * place[k], 1e-14, "in the stop");
        }
        /* its rays are no projection, from however near */
        CHECK(stop_beam_density(&pupil, place[0], place[1]) == 1);
        CHECK(stop_beam_share(&pupil, from, place, 0.3) == 0.3);
    }
}

/* What of a beam has to be 0 for halves that mirror each other, and what need not. */
static void test_mirrored(void)
{
    struct arena arena = {0};
    static const char *const texts[] = {
        "aperture stop\nsurface 50 5 1.5 20\nstop - 5 air 10\n",
        "aperture stop\nsurface 50 5 1.5 20 cyl=y\nstop - 5 air 10\n"};
    struct system systems[2];
    for (size_t i = 0; i < 2; i++) {
        struct lens *lens = ARENA_NEW(&arena, struct lens);
        const struct system_options options = system_options_default();
        CHECK(lens_read("t.lens", text_of(texts[i]), NULL, &arena, lens, &error));
        CHECK(system_compile(lens, WAVELENGTH_D, &options, &arena, &systems[i], &error));
    }
    for (int i = 0; i < 4; i++) {
        const bool has_disc = i % 2 == 0;
        struct beam beam = i < 2 ? beam_of_point(0, 20, -90) : beam_of_point(0, 0, -90);
        beam.foot[1] = beam.foot[2] = 2;
        struct stop_beam pupil = {.system = &systems[0],
                                  .beam = &beam,
                                  .has_disc = has_disc,
                                  .origin = {0, 2},
                                  .disc = {0, 3, 4},
                                  .axes = {5, 0, 0, 6},
                                  .extent = 7};
        /* x, or what leads there: of the pupil, of the beam */
        struct {
            double *number;
            bool of_disc, of_axes;
        } needed[] = {{&pupil.disc[0], true, false},    {&pupil.origin[0], false, true},
                      {&pupil.axes[1], false, true},    {&pupil.axes[2], false, true},
                      {&beam.axis[0], true, true},      {&beam.foot[0], true, true},
                      {&beam.across[0][1], true, true}, {&beam.across[0][2], true, true},
                      {&beam.across[1][0], true, true}};
        CHECK(stop_beam_is_mirrored(&pupil));
        for (size_t k = 0; k < sizeof needed / sizeof *needed; k++) {
            CHECK(*needed[k].number == 0);
            *needed[k].number = 0.5;
            CHECK(stop_beam_is_mirrored(&pupil) ==
                  !(has_disc ? needed[k].of_disc : needed[k].of_axes));
            *needed[k].number = 0;
        }
        /* one way to be not centred is not undone by the other being so */
        pupil.axes[1] = pupil.axes[2] = 0.5;
        CHECK(stop_beam_is_mirrored(&pupil) == has_disc);
        pupil.axes[1] = pupil.axes[2] = 0;
        pupil.system = &systems[1];
        CHECK(!stop_beam_is_mirrored(&pupil));
    }
    arena_free(&arena);
}

int main(void)
{
    test_entrance();
    test_refused();
    test_telecentric();
    test_density();
    test_of_stop();
    test_mirrored();
    return check_report();
}
