/* tests/unit/test_depth_card.c - rays over depth maps: by hand, and against a march in small steps. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/depth_card.h"

#include "check.h"

#include <math.h>

enum { COLUMNS = 41, ROWS = 23 };

/* A map and the picture beside it, whose first two channels say which column and row it was. */
struct fixture {
    struct arena arena;
    struct image depths, picture;
    struct depth_card_question question;
    struct depth_card relief;
};

/* Frame of 410 x 230 mm, 1000 mm before a pupil that lies 50 mm behind the first vertex. */
static void fill(struct fixture *fixture, double (*depth)(size_t column, size_t row))
{
    struct error error;
    *fixture = (struct fixture){.depths = {.width = COLUMNS, .height = ROWS, .channels = 1},
                                .picture = {.width = COLUMNS, .height = ROWS, .channels = 3},
                                .question = {.name = "map",
                                             .card = {.distance = 950, .width = 410, .height = 230},
                                             .sensor = 100,
                                             .pupil = 50,
                                             .radius = 40}};
    CHECK(image_new(&fixture->depths, &fixture->arena, &error));
    CHECK(image_new(&fixture->picture, &fixture->arena, &error));
    for (size_t i = 0; i < COLUMNS * ROWS; i++) {
        fixture->depths.pixels[i] = (float)depth(i % COLUMNS, i / COLUMNS);
        fixture->picture.pixels[3 * i] = (float)(i % COLUMNS) + 0.5F;
        fixture->picture.pixels[3 * i + 1] = (float)(i / COLUMNS) + 0.5F;
        fixture->picture.pixels[3 * i + 2] = 1;
    }
    fixture->question.depths = &fixture->depths;
    fixture->question.card.picture = &fixture->picture;
    CHECK(depth_card_open(&fixture->question, &fixture->arena, &fixture->relief, &error));
}

/* From (x, y) of the pupil through the point of the frame in column and row. */
static struct card_light look(const struct fixture *fixture, double x, double y, double column,
                              double row, enum depth_card_sight *sight)
{
    const double to[2] = {10 * column - 205, 115 - 10 * row};
    const struct depth_card_ray ray = {{x, y}, {(x - to[0]) / 1000, (y - to[1]) / 1000}};
    return depth_card_look(&fixture->relief, &ray, sight);
}

/* A disc of d mm before the pupil has its depth from the sensor, m. */
static double depth_of(double d)
{
    return (d + 50) / 1000;
}

static double at_frame(size_t column, size_t row)
{
    (void)column, (void)row;
    return depth_of(1000);
}

static double at_double(size_t column, size_t row)
{
    (void)column, (void)row;
    return depth_of(2000);
}

/* A ray through (x, 0) of the pupil and X = 0 of the frame is at -x in twice the distance: there
   a line of sight stands for -x/2 of the frame. */
static void test_planes(void)
{
    struct fixture fixture;
    enum depth_card_sight sight;
    fill(&fixture, at_frame);
    struct card_light light = look(&fixture, 20, -10, 12.25, 7.5, &sight);
    CHECK(sight == SIGHT_SEEN);
    CHECK_NEAR((double)light.of[0], 12.25, 1e-5, "column in the frame");
    CHECK_NEAR((double)light.of[1], 7.5, 1e-5, "row in the frame");
    arena_free(&fixture.arena);
    fill(&fixture, at_double);
    light = look(&fixture, 16, -8, 12.25, 7.5, &sight);
    CHECK(sight == SIGHT_SEEN);
    CHECK_NEAR((double)light.of[0], 12.25 - 0.8, 1e-5, "column behind the frame");
    CHECK_NEAR((double)light.of[1], 7.5 - 0.4, 1e-5, "row behind the frame");
    look(&fixture, 0, 0, -0.1, 7.5, &sight);
    CHECK(sight == SIGHT_SEEN); /* black beside a card is known */
    arena_free(&fixture.arena);
}

/* A bar of columns 18 to 21 in the frame, a wall in twice its distance. */
static double bar(size_t column, size_t row)
{
    (void)row;
    return depth_of(column >= 18 && column < 22 ? 1000 : 2000);
}

/* The ray moves 0.05 columns a mm of pupil between bar and wall, away from where it started. */
static void test_edges(void)
{
    static const struct {
        double x, column, expected;
        enum depth_card_sight sight;
        const char *what;
    } cases[] = {
        {20, 25.0, 24.0, SIGHT_SEEN, "beside the bar, to the wall"},
        {20, 20.25, 20.25, SIGHT_SEEN, "on the bar"},
        {20, 22.25, 22.5, SIGHT_BEHIND, "past the bar's edge, behind it"},
        {-20, 17.75, 17.5, SIGHT_BEHIND, "past its other edge"},
        {-20, 16.25, 17.25, SIGHT_SEEN, "up to the bar, to the wall"},
        {160, 22.25, 14.25, SIGHT_SEEN, "in past one edge and out past the other"},
        {0, 21.99, 21.5, SIGHT_SEEN, "the bar's edge has its own light"},
        {0, 22.01, 22.5, SIGHT_SEEN, "and so has the wall"},
    };
    struct fixture fixture;
    fill(&fixture, bar);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        enum depth_card_sight sight;
        const struct card_light light =
            look(&fixture, cases[i].x, 0, cases[i].column, 11.5, &sight);
        CHECK_NEAR((double)light.of[0], cases[i].expected, 1e-5, cases[i].what);
        CHECK_NEAR(sight, cases[i].sight, 0, cases[i].what);
    }
    arena_free(&fixture.arena);
}

/* A plane that leans back: 1/d falls from 1/800 in the first column's middle by 1/100000 each. */
static double leaning(size_t column, size_t row)
{
    (void)row;
    return depth_of(1 / (1 / 800.0 - 1e-5 * (double)column));
}

/* w = 1/800 - (U - 0.5)/1e5 and U = u + 100 x (w - 1/1000): planes are planes, 0.5 px of steps. */
static void test_plane(void)
{
    struct fixture fixture;
    fill(&fixture, leaning);
    for (double x = -20; x <= 20; x += 4) {
        for (double column = 5; column < 36; column += 0.37) {
            enum depth_card_sight sight;
            const struct card_light light = look(&fixture, x, 3, column, 11.5, &sight);
            const double U = (column + 100 * x * (1 / 800.0 + 0.5e-5 - 1e-3)) / (1 + 1e-3 * x);
            CHECK_NEAR((double)light.of[0], U, 0.02, "column on a leaning plane");
            CHECK(sight == SIGHT_SEEN);
        }
    }
    arena_free(&fixture.arena);
}

/* -------- against a march -------- */

static double rough(size_t column, size_t row)
{
    const double share = fmod((double)column * 0.754878 + (double)row * 0.569840, 1);
    return depth_of(share < 0.7 ? 4000 : 300 + 3000 * share);
}

/* The first pixel whose patch the ray passes in small steps from front to back, edges or not. */
static bool march(const struct fixture *fixture, const double from[2], const double per_w[2],
                  long met[2])
{
    enum { STEPS = 20000 };
    const double most = 1 / 300.0;
    for (int i = 0; i <= STEPS; i++) {
        const double w = most * (1 - (double)i / STEPS);
        const long column = (long)floor(from[0] + per_w[0] * w);
        const long row = (long)floor(from[1] + per_w[1] * w);
        if (column < 0 || column >= COLUMNS || row < 0 || row >= ROWS) {
            continue;
        }
        const double d = (double)fixture->depths.pixels[row * COLUMNS + column] * 1000 - 50;
        if (w <= 1 / d) {
            met[0] = column;
            met[1] = row;
            /* a wall is passed, not a patch: the next step is inside */
            return w > 1 / d - 2 * most / STEPS;
        }
    }
    return false;
}

static void test_march(void)
{
    struct fixture fixture;
    fill(&fixture, rough);
    int compared = 0;
    for (int i = 0; i < 400; i++) {
        const double u = fmod(i * 0.618034, 1), v = fmod(i * 0.754878, 1),
                     s = fmod(i * 0.569840, 1);
        const double x = 40 * (fmod(i * 0.318, 1) - 0.5), y = 40 * (s - 0.5);
        const double column = 2 + 37 * u, row = 2 + 19 * v;
        const double per_w[2] = {100 * x, -100 * y};
        const double from[2] = {column - per_w[0] / 1000, row - per_w[1] / 1000};
        long met[2];
        enum depth_card_sight sight;
        const struct card_light light = look(&fixture, x, y, column, row, &sight);
        if (march(&fixture, from, per_w, met)) {
            CHECK(sight == SIGHT_SEEN);
            CHECK_NEAR((double)light.of[0], (double)met[0] + 0.5, 0.5 + 1e-4, "column of a march");
            CHECK_NEAR((double)light.of[1], (double)met[1] + 0.5, 0.5 + 1e-4, "row of a march");
            compared++;
        }
    }
    CHECK(compared > 200);
    arena_free(&fixture.arena);
}

/* -------- refused -------- */

static void test_errors(void)
{
    static const struct {
        float depth;
        const char *message;
    } cases[] = {
        {0, "map: the depth in column 5, row 3 is 0 m: it must be above 0"},
        {-1, "map: the depth in column 5, row 3 is -1 m: it must be above 0"},
        {NAN, "map: the depth in column 5, row 3 is nan m: it must be above 0"},
        {0.0625F, "map: the depth in column 5, row 3, 0.0625 m, lies within the lens, which "
                  "reaches to 0.1 m before the sensor"},
    };
    struct fixture fixture;
    struct error error;
    fill(&fixture, at_frame);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fixture.depths.pixels[2 * COLUMNS + 4] = cases[i].depth;
        CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
        CHECK_TEXT(error.message, cases[i].message);
    }
    fixture.depths.pixels[2 * COLUMNS + 4] = INFINITY;
    CHECK(depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    fixture.question.pupil = INFINITY;
    CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    arena_free(&fixture.arena);
}

int main(void)
{
    test_planes();
    test_edges();
    test_plane();
    test_march();
    test_errors();
    return check_report();
}
