/* tests/unit/test_angle_of_view.c - what a sensor sees, against chief rays of other programs. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/angle_of_view.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"

static const double degree = RADIANS_PER_DEGREE;

/* A lens, and a sensor in its paraxial focus. */
struct camera {
    struct lens lens;
    struct setup setup;
    struct first_order first;
    struct view_question question;
};

static void look(struct camera *camera, double wavelength, double width, double height,
                 struct arena *arena)
{
    struct error error;
    const struct setup_question asked = {
        .lens = &camera->lens, .wavelength = wavelength, .fnumber = NAN};
    CHECK(setup_open(&asked, arena, &camera->setup, &error));
    CHECK(first_order_of_lens(&camera->lens, wavelength, SECTION_Y, arena, &camera->first, &error));
    camera->question = (struct view_question){.setup = &camera->setup,
                                              .film = camera->first.image,
                                              .subject = -INFINITY,
                                              .first = &camera->first,
                                              .squeeze = 1,
                                              .sensor = {width, height, NAN}};
}

static void open_text(struct camera *camera, const char *text, struct arena *arena)
{
    struct error error;
    bool read = lens_read("test", text_of(text), NULL, arena, &camera->lens, &error);
    CHECK(read);
}

/* Image heights of chief rays at the paraxial focus: mm, from another program, to 1e-6. */
static void test_heights(void)
{
    static const struct {
        const char *lens;
        double field, height; /* deg, mm */
    } cases[] = {
        {"cs348b-dgauss-50", 5, 4.403447},      {"cs348b-dgauss-50", 10, 8.859872},
        {"cs348b-dgauss-50", 15, 13.420694},    {"cs348b-dgauss-50", 22, 20.066464},
        {"cs348b-wide-22", 10, 3.877559},       {"cs348b-wide-22", 20, 7.970849},
        {"cs348b-wide-22", 30, 12.579561},      {"cs348b-telephoto-250", 1, 4.357002},
        {"cs348b-telephoto-250", 2, 8.721482},  {"cs348b-telephoto-250", 4, 17.503348},
        {"cs348b-telephoto-250", 5, 21.936563}, {"cs348b-fisheye-10", 10, 1.744306},
        {"cs348b-fisheye-10", 20, 3.491381},    {"cs348b-fisheye-10", 40, 7.002125},
        {"cs348b-fisheye-10", 60, 10.528418},   {"cs348b-fisheye-10", 70, 12.272904},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lensdb db = {.arena = &arena};
        struct error error;
        struct camera camera;
        struct view view;
        double side = 2 * cases[i].height;
        CHECK(lens_open(&db, text_of(cases[i].lens), &arena, &camera.lens, &error));
        look(&camera, lens_primary_wavelength(&camera.lens), side, side / 2, &arena);
        CHECK(view_of_lens(&camera.question, &arena, &view, &error));
        /* a micrometre in the sixth digit is at most 1e-6/f rad */
        CHECK_NEAR(view.horizontal.angle, 2 * cases[i].field * degree, 4e-7, cases[i].lens);
        CHECK(view.horizontal.part == 1);
        arena_free(&arena);
    }
}

/* The first lens of truth/rays_fisheye.txt; its chief rays by the same program of 50 digits. */
static const char retrofocus[] = "medium 1.0\nobject inf\n"
                                 "surface 60 2.5 1.62041 -\nsurface 18 14 1.0 -\n"
                                 "surface 80 2 1.62041 -\nsurface 14 12 1.0 -\n"
                                 "surface 30 6 1.7552 -\nsurface -80 5 1.0 -\n"
                                 "stop - 2 1.0 2.4\nsurface -60 1.5 1.80518 -\n"
                                 "surface 18 5 1.62041 -\nsurface -16 0.3 1.0 -\n"
                                 "surface 40 4 1.62041 -\nsurface -30 0 1.0 -\n";

static void test_wide(void)
{
    static const double chief[][2] = {{0.3 * 70, 2.898496299236818269259},
                                      {0.5 * 70, 4.834999245809360238416},
                                      {0.7 * 70, 6.780853951678157131735},
                                      {0.9 * 70, 8.746204873223232506935},
                                      {70, 9.741164209083239479194}};
    struct arena arena = {0};
    struct camera camera;
    struct view view;
    struct error error;
    open_text(&camera, retrofocus, &arena);
    for (size_t i = 0; i < sizeof chief / sizeof chief[0]; i++) {
        look(&camera, 0.5875618, 1, 2 * chief[i][1], &arena);
        CHECK(view_of_lens(&camera.question, &arena, &view, &error));
        CHECK_NEAR(view.vertical.angle, 2 * chief[i][0] * degree, 1e-13, "retrofocus");
    }
    arena_free(&arena);
}

/* A thin lens in its stop: chief rays go straight on, so that tan t is height over film. */
static void test_thin(void)
{
    struct arena arena = {0};
    struct camera camera;
    struct view view;
    struct error error;
    open_text(&camera, "object inf\nstop - 0 air 10\nthick 50 0 air -\n", &arena);
    look(&camera, 0.5875618, 36, 24, &arena);
    CHECK_NEAR(camera.question.film, 50, 1e-12, "film of a thin lens");
    camera.question.subject = -1000;
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK_NEAR(view.horizontal.angle, 2 * atan(0.36), 1e-14, "36 mm at 50 mm");
    CHECK_NEAR(view.vertical.angle, 2 * atan(0.24), 1e-14, "24 mm at 50 mm");
    CHECK_NEAR(view.diagonal.angle, 2 * atan(hypot(18, 12) / 50), 1e-14, "the diagonal");
    CHECK_NEAR(view.horizontal.size, 720, 1e-10, "36 mm at 1 m through 50 mm");
    CHECK_NEAR(view.diagonal.size, 20 * hypot(36, 24), 1e-10, "the diagonal at 1 m");
    CHECK(isnan(view.circle) && isnan(view.clear));
    camera.question.squeeze = 2;
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK_NEAR(view.horizontal.angle, 2 * atan(0.72), 1e-14, "squeezed");
    CHECK_NEAR(view.vertical.angle, 2 * atan(0.24), 1e-14, "not squeezed");
    CHECK_NEAR(view.diagonal.size, 20 * hypot(72, 24), 1e-10, "squeezed diagonal");
    arena_free(&arena);
}

/* The middle of a hollow front lies behind its edge: what is nearer than the edge is not seen from
   there. Chief rays are straight lines through the stop, 10 mm behind. */
static void test_hollow(void)
{
    struct arena arena = {0};
    struct camera camera;
    struct view view;
    struct error error;
    open_text(&camera, "object inf\nsurface -20 10 air 40\nstop - 0 air 2\nthick 50 0 air -\n",
              &arena);
    look(&camera, 0.5875618, 80, 10, &arena);
    /* half of 80 mm at 50 mm: 0.8, so that the ray leaves 8.8 mm off the axis and 2.1 before it */
    camera.question.subject = -1;
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK(isnan(view.horizontal.size));
    CHECK_NEAR(view.horizontal.angle, 2 * atan(0.8), 1e-13, "80 mm at 50 mm");
    CHECK_NEAR(view.vertical.size, 2.2, 1e-12, "10 mm at 11 mm through 50 mm");
    camera.question.subject = -3;
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK_NEAR(view.horizontal.size, 20.8, 1e-12, "80 mm at 13 mm through 50 mm");
    arena_free(&arena);
}

/* A tube before the lens: its clear aperture, and nothing else, ends the field. */
static void test_circle(void)
{
    struct arena arena = {0};
    struct camera camera;
    struct view view;
    struct error error;
    /* a rim of 20 mm, 50 mm before a stop of 2 mm: chief rays up to 10/50, light to 11/50 */
    open_text(&camera, "object inf\nsurface - 50 air 20\nstop - 0 air 2\nthick 50 0 air -\n",
              &arena);
    look(&camera, 0.5875618, 36, 24, &arena);
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK_NEAR(view.clear, 20, 1e-6, "chief rays end at 10/50 of 50 mm");
    CHECK_NEAR(view.circle, 22, 22 * 2e-3, "light ends at 11/50 of 50 mm");
    CHECK_NEAR(view.horizontal.angle, 2 * atan(0.22), 1e-3, "the angle ends there");
    CHECK_NEAR(view.diagonal.angle, view.vertical.angle, 1e-3, "in all directions");
    CHECK(view.horizontal.part < 1 && view.vertical.part < 1);
    /* what the lens states of its field counts, beside its clear apertures */
    open_text(
        &camera,
        "object inf\nfield angle 0 20\nsurface - 50 air 20\nstop - 0 air 2\nthick 50 0 air -\n",
        &arena);
    look(&camera, 0.5875618, 36, 2, &arena);
    CHECK(view_of_lens(&camera.question, &arena, &view, &error));
    CHECK_NEAR(view.horizontal.angle, 2 * atan(0.36), 1e-12, "19.8 deg are within the field");
    CHECK_NEAR(view.clear, 20, 1e-6, "with its chief rays stopped");
    arena_free(&arena);
}

static void test_refusals(void)
{
    struct arena arena = {0};
    struct camera camera;
    struct view view;
    struct error error;
    open_text(&camera, "object inf\nsurface 50 5 1.5 20\nsurface -50 0 air 20\n", &arena);
    look(&camera, 0.5875618, 36, 24, &arena);
    CHECK(!view_of_lens(&camera.question, &arena, &view, &error));
    CHECK(error.code == ERROR_DOMAIN && strstr(error.message, "no stop") != NULL);
    open_text(&camera, "object inf\nstop - 0 air 10\nthick 50 0 air -\n", &arena);
    look(&camera, 0.5875618, 36, 24, &arena);
    camera.question.film = -1;
    CHECK(!view_of_lens(&camera.question, &arena, &view, &error));
    arena_free(&arena);
}

int main(void)
{
    test_heights();
    test_wide();
    test_thin();
    test_hollow();
    test_circle();
    test_refusals();
    return check_report();
}
