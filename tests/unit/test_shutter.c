/* tests/unit/test_shutter.c - exposures by hand: growing holes, slits, and lines that are read. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "camera/film/lens_film.h"
#include "camera/sensor/shutter.h"
#include "check.h"
#include "file/lens_file.h"

static struct error error;
static struct shutter shutter;
static double interval[2];

static const struct shutter_question film = {.time = 1e-3,
                                             .width = 36,
                                             .height = 24,
                                             .travel = 4e-3,
                                             .overrun = (double)INFINITY,
                                             .opening = 0.6e-3,
                                             .closing = 1e-3};

static void open_as(enum shutter_kind kind, enum shutter_direction direction, double distance)
{
    struct shutter_question question = film;
    question.kind = kind;
    question.direction = direction;
    question.distance = distance;
    CHECK(shutter_open(&question, &shutter, &error));
}

/* From when to when it is open to a ray. */
static void look(double x, double y, double right, double up, double stop)
{
    const struct shutter_ray ray = {{x, y}, {right, up}, stop};
    shutter_interval(&shutter, &ray, interval);
}

static void test_global(void)
{
    open_as(SHUTTER_GLOBAL, SHUTTER_DOWN, 3);
    look(18, -12, 0.3, 0.2, NAN);
    CHECK_NEAR(interval[0], -0.5e-3, 0, "all at once");
    CHECK_NEAR(interval[1], 0.5e-3, 0, "all at once");
    shutter_span(&shutter, 0.5, interval);
    CHECK_NEAR(interval[1] - interval[0], 1e-3, 1e-18, "no longer than the exposure");
}

/* Of a picture 24 mm high and 36 mm wide, upside down on the film: its top is read first. */
static void test_rolling(void)
{
    static const struct {
        enum shutter_direction direction;
        double x, y, later; /* mm, s */
    } cases[] = {{SHUTTER_DOWN, 5, -12, -2e-3},   {SHUTTER_DOWN, 5, 6, 1e-3},
                 {SHUTTER_UP, -3, -12, 2e-3},     {SHUTTER_RIGHT, 18, 7, -2e-3},
                 {SHUTTER_RIGHT, -9, -7, 1e-3},   {SHUTTER_LEFT, 18, 7, 2e-3},
                 {SHUTTER_LEFT, -4.5, 0, -0.5e-3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        open_as(SHUTTER_ROLLING, cases[i].direction, 2);
        look(cases[i].x, cases[i].y, 0.4, 0.4, NAN);
        CHECK_NEAR(interval[0], cases[i].later - 0.5e-3, 1e-18, "begins with its line");
        CHECK_NEAR(interval[1], cases[i].later + 0.5e-3, 1e-18, "ends with its line");
    }
    shutter_span(&shutter, 9, interval);
    CHECK_NEAR(interval[0], -2.5e-3, 1e-18, "from the first line's begin");
    CHECK_NEAR(interval[1], 2.5e-3, 1e-18, "to the last line's end");
}

/*
 * A slit of 6 mm (1 ms at 6 m/s), 1.5 mm before the film: a ray that is 0.2 aslant passes it 0.3 mm
 * beside its place on the film, 0.05 ms later.
 */
static void test_slit(void)
{
    open_as(SHUTTER_FOCAL, SHUTTER_DOWN, 1.5);
    look(0, 3, 0, 0, NAN);
    CHECK_NEAR(interval[0], 0.5e-3 - 0.5e-3, 1e-18, "3 mm at 6 m/s");
    look(0, 3, -0.7, 0.2, NAN);
    CHECK_NEAR(interval[0], 0.05e-3, 1e-18, "aslant");
    CHECK_NEAR(interval[1], 1.05e-3, 1e-18, "as long");
    open_as(SHUTTER_FOCAL, SHUTTER_LEFT, 1.5);
    look(9, 3, 0.2, -0.7, NAN);
    CHECK_NEAR(interval[0] + interval[1], 2 * 9.3 * 4e-3 / 36, 1e-17, "along the width");
    shutter_span(&shutter, 18.3, interval);
    CHECK_NEAR(interval[1], 0.5e-3 + 18.3 * 4e-3 / 36, 1e-17, "the last ray's end");
}

/* Curtains that stop 0.2 mm beyond the film hide what passes further out. */
static void test_ends(void)
{
    struct shutter_question question = film;
    question.kind = SHUTTER_FOCAL;
    question.distance = 1.5;
    question.overrun = 0.2;
    CHECK(shutter_open(&question, &shutter, &error));
    look(0, 12, 0, 0.13, NAN);
    CHECK_NEAR(interval[1] - interval[0], 1e-3, 1e-17, "within");
    look(0, 12, 0, 0.14, NAN);
    CHECK(interval[0] == 0 && interval[1] == 0);
    look(0, -12, 0, -0.14, NAN);
    CHECK(interval[0] == 0 && interval[1] == 0);
    shutter_span(&shutter, 20, interval);
    CHECK_NEAR(interval[0], -0.5e-3 - 12.2 / 6e3, 1e-17, "no ray is earlier");
}

/* Light over time at a point: a round beam that the slit's edges cut, by its area on one side. */
static double open_beam(double width, double slit, double place)
{
    double area[2];
    for (int k = 0; k < 2; k++) {
        const double x = 2 * (place + (k == 0 ? -slit : slit) / 2) / width;
        const double cut = fmax(-1, fmin(1, x));
        area[k] = (cut * sqrt(1 - cut * cut) + asin(cut)) / PI;
    }
    return area[1] - area[0];
}

/* The beam's light by intervals of its rays is that of its open area, at any time. */
static void test_penumbra(void)
{
    enum { SIDE = 400 };
    const double radius = 0.25; /* of slopes: f/2 */
    open_as(SHUTTER_FOCAL, SHUTTER_UP, 4);
    for (double time = -0.9e-3; time < 0.9e-3; time += 0.15e-3) {
        double open = 0, all = 0;
        for (int i = 0; i < SIDE * SIDE; i++) {
            const double u = radius * (2 * (i % SIDE + 0.5) / SIDE - 1);
            const double v = radius * (2 * ((double)(i / SIDE) + 0.5) / SIDE - 1);
            if (u * u + v * v < radius * radius) {
                look(0, 0, u, v, NAN);
                all += 1;
                open += time >= interval[0] && time < interval[1];
            }
        }
        CHECK_NEAR(open / all, open_beam(2 * radius * 4, 6, time * 6e3), 2e-3, "segments");
    }
    /* the beam is 2 mm wide there: light for 8 mm of travel */
    const struct shutter_times times = shutter_times(&shutter, 2);
    CHECK_NEAR(times.total, 8 / 6e3, 1e-17, "until the beam is past");
    CHECK_RELATIVE(times.effective / times.total, 6.0 / 8, 1e-12, "[Ives20] w/(w + d/N)");
    shutter_span(&shutter, 12, interval);
    CHECK_NEAR(interval[1], 2.5e-3, 1e-17, "straight rays");
}

/* The integral of the open area over time, by the hole's radius. */
static double area_over_time(double beam)
{
    enum { STEPS = 200000 };
    const double from = -0.5e-3 - 0.6e-3 * sqrt(0.5), to = 0.5e-3 + 1e-3 * sqrt(0.5);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double time = from + (to - from) * (i + 0.5) / STEPS;
        const double hole = fmin(1, fmin((time - from) / 0.6e-3, (to - time) / 1e-3));
        const double open = fmin(hole / beam, 1);
        sum += open * open * (to - from) / STEPS;
    }
    return sum;
}

static void test_leaf(void)
{
    enum { RINGS = 2000 };
    static const double beams[] = {1, 0.5, 0.125, 0.01};
    open_as(SHUTTER_LEAF, SHUTTER_DOWN, 0);
    look(18, 12, 1, 1, sqrt(0.5));
    CHECK_NEAR(interval[0], -0.5e-3, 1e-18, "half of the light: T");
    CHECK_NEAR(interval[1], 0.5e-3, 1e-18, "half of the light: T");
    for (size_t k = 0; k < sizeof beams / sizeof *beams; k++) {
        const double beam = beams[k], expected = area_over_time(beam);
        double sum = 0;
        shutter.stopped = beam;
        for (int i = 0; i < RINGS; i++) {
            const double low = (double)i / RINGS, high = (i + 1.0) / RINGS;
            look(0, 0, 0, 0, beam * (low + high) / 2);
            sum += (high * high - low * low) * (interval[1] - interval[0]);
        }
        CHECK_RELATIVE(sum, expected, 1e-6, "open area over time");
        const struct shutter_times times = shutter_times(&shutter, NAN);
        CHECK_RELATIVE(times.effective, expected, 1e-8, "in closed form");
        CHECK_RELATIVE(times.total, 1e-3 + 1.6e-3 * sqrt(0.5), 1e-12, "whatever the beam");
    }
    look(0, 0, 0, 0, 0);
    double span[2];
    shutter_span(&shutter, 0.5, span);
    CHECK(span[0] == interval[0] && span[1] == interval[1]);
    look(0, 0, 0, 0, 1);
    CHECK_RELATIVE(interval[1] - interval[0], 1e-3 - 1.6e-3 * (1 - sqrt(0.5)), 1e-12, "the rim");
    look(0, 0, 0, 0, NAN);
    CHECK(isfinite(interval[0]) && isfinite(interval[1]));
}

/*
 * Behind a stop alone, 5 mm wide and 50 mm before a film of 36 x 24 mm, the last ray goes from the
 * edge of the film to the near side of the stop.
 */
static void test_span(void)
{
    static const char text[] = "lens stop\nwavelength d\nobject inf\naperture stop\n"
                               "stop - 50 air 5\n";
    struct arena arena = {0};
    struct lens lens;
    struct setup setup;
    struct lens_film opened;
    const struct setup_question question = {
        .lens = &lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_AT, .distance = 50};
    open_as(SHUTTER_FOCAL, SHUTTER_DOWN, 8);
    const struct film_question asked = {
        .setup = &setup, .width = 36, .height = 24, .shutter = &shutter};
    const bool good = lens_read("test", text_of(text), NULL, &arena, &lens, &error) &&
                      setup_open(&question, &arena, &setup, &error) &&
                      setup_place_image(&setup, &plane, &error) &&
                      lens_film_open(&asked, &arena, &opened, &error);
    CHECK(good);
    if (good) {
        double span[2];
        const double last = 12 + 8 * (2.5 - 12) / 50, step = 24 / 16.0;
        lens_film_span(&opened, span);
        CHECK_NEAR(span[1], 0.5e-3 + (last + step) / 6e3, 5e-7, "and a step more");
        CHECK_NEAR(span[0], -span[1], 1e-15, "the first");
    }
    arena_free(&arena);
}

/* Starts of rays that were asked for: along where the curtains go, to (0.6, 0.8), and beside it. */
static struct {
    double least[2], most[2], v;
    int blocks;
} starts;

/* Rays as steep everywhere, but for half of a block that carries no light and is steeper. */
static void aim_alike(const struct lens_film *opened, struct film_samples *samples,
                      struct ray_block *block)
{
    (void)opened;
    starts.blocks++;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        const double x = samples->x[i], y = samples->y[i];
        const double at[2] = {0.6 * x + 0.8 * y, 0.6 * y - 0.8 * x};
        for (int k = 0; k < 2; k++) {
            starts.least[k] = fmin(starts.least[k], at[k]);
            starts.most[k] = fmax(starts.most[k], at[k]);
        }
        starts.v = fmin(starts.v, samples->v[i]);
        block->p[i] = i % 2 == 0 ? 0.18 : 0.3; /* 0.3 of 0.9 along (0.6, 0.8) */
        block->q[i] = i % 2 == 0 ? 0.2025 : 0.4;
        block->r[i] = -0.9;
        samples->weight[i] = i % 2 == 0 ? 1 : 0;
    }
}

/*
 * It is asked about 17 x 17 points, 24 mm along the curtains' way and, whatever that is, as far
 * beside it as the corner: 8 mm before the film they pass 0.3 * 8 mm further on.
 */
static void test_span_turned(void)
{
    double span[2], expected[2];
    open_as(SHUTTER_FOCAL, SHUTTER_DOWN, 8);
    shutter.along[0] = 0.6;
    shutter.along[1] = 0.8;
    const struct lens_film opened = {.aim = aim_alike, .shutter = &shutter, .corner = 20};
    starts.least[0] = starts.least[1] = starts.v = INFINITY;
    starts.most[0] = starts.most[1] = -INFINITY;
    lens_film_span(&opened, span);
    CHECK(starts.blocks == 17 * 17);
    CHECK_NEAR(starts.least[0], -12, 1e-12, "one edge");
    CHECK_NEAR(starts.most[0], 12, 1e-12, "the other");
    CHECK_NEAR(starts.least[1], -20, 1e-12, "a corner");
    CHECK_NEAR(starts.most[1], 20, 1e-12, "the other corner");
    CHECK(starts.v == 1); /* the rim */
    shutter_span(&shutter, 12 + 0.3 * 8 + 24 / 16.0, expected);
    CHECK_NEAR(span[0], expected[0], 1e-15, "the first");
    CHECK_NEAR(span[1], expected[1], 1e-15, "the last");
}

/* Each would be refused. */
static void test_refused(void)
{
    struct shutter_question question = film;
    question.kind = SHUTTER_LEAF;
    question.time = 1.6e-3 * (1 - sqrt(0.5)) * 1.0001;
    CHECK(shutter_open(&question, &shutter, &error));
    question.time *= 0.9998;
    CHECK(!shutter_open(&question, &shutter, &error) && error.code == ERROR_DOMAIN);
    question = film;
    question.kind = SHUTTER_LEAF;
    question.opening = -1e-3;
    CHECK(!shutter_open(&question, &shutter, &error));
    question.kind = SHUTTER_FOCAL;
    CHECK(shutter_open(&question, &shutter, &error));
    question.distance = -1;
    CHECK(!shutter_open(&question, &shutter, &error));
    question.distance = 0;
    question.travel = 0;
    CHECK(!shutter_open(&question, &shutter, &error));
    question.travel = 1.1e8 * question.time;
    CHECK(!shutter_open(&question, &shutter, &error));
    question.kind = SHUTTER_ROLLING;
    question.travel = NAN;
    CHECK(!shutter_open(&question, &shutter, &error));
    question.kind = SHUTTER_GLOBAL;
    CHECK(shutter_open(&question, &shutter, &error));
    question.time = NAN;
    CHECK(!shutter_open(&question, &shutter, &error));
}

int main(void)
{
    test_global();
    test_rolling();
    test_slit();
    test_ends();
    test_penumbra();
    test_leaf();
    test_span();
    test_span_turned();
    test_refused();
    return check_report();
}
