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

static void check_black(struct card_light light)
{
    CHECK(light.of[0] == 0 && light.of[1] == 0 && light.of[2] == 0);
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
    check_black(look(&fixture, 0, 0, -0.1, 7.5, &sight));
    CHECK(sight == SIGHT_SEEN);                          /* black beside a card is known */
    check_black(look(&fixture, 0, 0, 1e6, 7.5, &sight)); /* nor is anything so far beside */
    CHECK(sight == SIGHT_SEEN);
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

/* A bar of columns 18 to 21 in the frame, a wall behind it by a parallax, in pixels, of 4000/mm. */
static double wall_parallax;

static double shelf(size_t column, size_t row)
{
    (void)row;
    return depth_of(column >= 18 && column < 22 ? 1000 : 1 / (1e-3 - wall_parallax / 4000));
}

/* Steps of less than a pixel belong to the surface; behind greater ones nothing is known. */
static void test_steps(void)
{
    static const struct {
        double parallax, expected;
        enum depth_card_sight sight;
    } cases[] = {{0.9, 22, SIGHT_SEEN}, {1.1, 22.5, SIGHT_BEHIND}, {1.9, 22.5, SIGHT_BEHIND}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        enum depth_card_sight sight;
        wall_parallax = cases[i].parallax;
        fill(&fixture, shelf);
        struct card_light light = look(&fixture, 40, 0, 22.25, 11.5, &sight);
        CHECK_NEAR((double)light.of[0], cases[i].expected, 1e-5, "at a step");
        CHECK_NEAR(sight, cases[i].sight, 0, "a step");
        fixture.relief.hidden = HIDDEN_BLACK;
        light = look(&fixture, 40, 0, 22.25, 11.5, &sight);
        if (cases[i].sight == SIGHT_BEHIND) {
            check_black(light);
        } else {
            CHECK_NEAR((double)light.of[0], cases[i].expected, 1e-5, "nothing is hidden");
        }
        arena_free(&fixture.arena);
    }
}

static double post(size_t column, size_t row)
{
    (void)row;
    return depth_of(column == 20 ? 1000 : 2000);
}

/* The light of a pixel that is narrower than one of the picture is that of its middle. */
static void test_coarse(void)
{
    struct fixture fixture;
    struct error error;
    enum depth_card_sight sight;
    fill(&fixture, post);
    fixture.picture.width = fixture.picture.height = 10;
    for (size_t i = 0; i < 100; i++) {
        fixture.picture.pixels[3 * i] = (float)(i % 10) + 0.5F;
        fixture.picture.pixels[3 * i + 1] = (float)(i / 10) + 0.5F;
    }
    CHECK(depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    for (double column = 20.1; column < 21; column += 0.2) {
        const struct card_light light = look(&fixture, 0, 0, column, 8.3, &sight);
        CHECK_NEAR((double)light.of[0], 20.5 * 10 / COLUMNS, 1e-5, "the middle of a post");
        CHECK_NEAR((double)light.of[1], 8.3 * 10 / ROWS, 1e-5, "where it is met along it");
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

/* From 300 mm in the first row's or column's middle to 4000 mm in the 41st, so that rays cross many
   pixels on their way; a step of w is s = (1/300 - 1/4000)/40. */
static double steep_columns(size_t column, size_t row)
{
    (void)row;
    return depth_of(1 / (1 / 300.0 - (1 / 300.0 - 1 / 4000.0) / 40 * (double)column));
}

static double steep_rows(size_t column, size_t row)
{
    (void)column;
    return steep_columns(row, 0);
}

/* w = 1/300 - s (U - 0.5) and U = u + 100 x (w - 1/1000); rows go down where y goes up. */
static void test_steep(void)
{
    static const double s = (1 / 300.0 - 1 / 4000.0) / 40;
    for (int axis = 0; axis < 2; axis++) {
        struct fixture fixture;
        fill(&fixture, axis == 0 ? steep_columns : steep_rows);
        const double count = axis == 0 ? COLUMNS : ROWS;
        for (double x = -28; x <= 28; x += 7) {
            for (double at = 1; at < count - 1; at += 0.61) {
                enum depth_card_sight sight;
                const double along = axis == 0 ? x : -x, across = 3, middle = 11.5;
                const struct card_light light = axis == 0
                                                    ? look(&fixture, x, across, at, middle, &sight)
                                                    : look(&fixture, across, x, middle, at, &sight);
                const double U =
                    (at + 100 * along * (1 / 300.0 + s / 2 - 1e-3)) / (1 + 100 * along * s);
                const double w = 1 / 300.0 - s * (U - 0.5), off = fabs(100 * x * s) / 2;
                if (U < 1 || U > count - 1) {
                    continue;
                }
                CHECK_NEAR((double)light.of[axis], U, off / (1 - 2 * off) + 1e-4,
                           "along a steep plane");
                CHECK_NEAR((double)light.of[1 - axis],
                           middle + (axis == 0 ? -100 : 100) * across * (w - 1e-3), 0.02,
                           "across it");
                CHECK(sight == SIGHT_SEEN);
            }
        }
        arena_free(&fixture.arena);
    }
}

/* Beside a frame that goes on its border does, in lines of sight, at the border's distances. */
static void test_endless(void)
{
    struct fixture fixture;
    enum depth_card_sight sight;
    static const double s = (1 / 300.0 - 1 / 4000.0) / 40;
    fill(&fixture, steep_rows);
    fixture.relief.is_endless = true;
    for (double y = -28; y <= 28; y += 7) {
        for (double row = 1; row < ROWS - 1; row += 0.61) {
            const struct card_light light = look(&fixture, 3, y, row < 9 ? -20 : 60, row, &sight);
            const double V = (row - 100 * y * (1 / 300.0 + s / 2 - 1e-3)) / (1 - 100 * y * s);
            const double off = fabs(100 * y * s) / 2;
            if (V > 1 && V < ROWS - 1) {
                CHECK_NEAR((double)light.of[0], row < 9 ? 0.5 : 40.5, 1e-5, "the border");
                CHECK_NEAR((double)light.of[1], V, off / (1 - 2 * off) + 1e-4, "along it");
                CHECK(sight == SIGHT_BESIDE);
            }
        }
    }
    arena_free(&fixture.arena);
    fill(&fixture, steep_columns);
    fixture.relief.is_endless = true;
    for (double y = -28; y <= 28; y += 7) {
        /* beyond the column that is 4 m away, and before the one 0.3 m away */
        struct card_light light = look(&fixture, 28, y, 50, 11.5, &sight);
        CHECK_NEAR((double)light.of[1], 11.5 - 100 * y * (1 / 4000.0 - 1e-3), 1e-4, "far border");
        CHECK(sight == SIGHT_BESIDE);
        light = look(&fixture, 28, y / 4, -10, 11.5, &sight);
        CHECK_NEAR((double)light.of[1], 11.5 - 25 * y * (1 / 300.0 - 1e-3), 1e-4, "near border");
        CHECK(sight == SIGHT_BESIDE);
    }
    arena_free(&fixture.arena);
}

/* Nothing is looked for 500 frames beside the middle, where rays are nearest or end. */
static void test_far_beside(void)
{
    static const struct {
        double x, aside; /* mm; columns, at the distance of all */
        bool is_seen;
    } cases[] = {
        {0, 20490, true},   {0, -20490, true},    {0, 20510, false}, {0, -20510, false},
        {9, 20499.5, true}, {-9, 20499.5, false}, {9, 20501, false}, {-9, -20499.5, true},
    };
    struct fixture fixture;
    fill(&fixture, at_frame);
    fixture.relief.is_endless = true;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        enum depth_card_sight sight;
        const struct card_light light =
            look(&fixture, cases[i].x, 0, 20.5 + cases[i].aside, 11.5, &sight);
        CHECK_NEAR((double)light.of[2], cases[i].is_seen ? 1 : 0, 0, "far beside");
        CHECK(sight == SIGHT_BESIDE);
    }
    arena_free(&fixture.arena);
}

/* Nothing but a corner is near: 0.3 m before the pupil, the rest 4 m. */
static double corner(size_t column, size_t row)
{
    return depth_of(column >= 38 && row >= 20 ? 300 : 4000);
}

/* A point of column U at 300 mm is seen from x along u = U - 100 x (1/300 - 1/1000). */
static void test_corner(void)
{
    struct fixture fixture;
    fill(&fixture, corner);
    for (double x = -40; x <= 40; x += 8) {
        enum depth_card_sight sight;
        const double column = 39.5 - 100 * x * (1 / 300.0 - 1e-3);
        const struct card_light light = look(&fixture, x, 0, column, 21.5, &sight);
        CHECK_NEAR((double)light.of[0], 39.5, 1e-4, "a near corner");
        CHECK_NEAR((double)light.of[1], 21.5, 1e-4, "its row");
        CHECK(sight == SIGHT_SEEN);
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

/* -------- the range of a part -------- */

static long clamped(long at, long most)
{
    return at < 0 ? 0 : at > most ? most : at;
}

/* Of all pixels in the squares, of the least size that is over the part's, of its corners. */
static void range_of(const struct fixture *fixture, const long from[2], const long to[2],
                     double range[2])
{
    int level = 0;
    while (level < 6 && (to[0] - from[0] >= 1L << level || to[1] - from[1] >= 1L << level)) {
        level++;
    }
    const double size = (double)(1L << level);
    const long last[2] = {(COLUMNS - 1) >> level, (ROWS - 1) >> level};
    range[0] = INFINITY;
    range[1] = 0;
    for (long i = 0; i < COLUMNS * ROWS; i++) {
        const long square[2] = {i % COLUMNS >> level, i / COLUMNS >> level};
        bool holds = true;
        for (int k = 0; k < 2; k++) {
            holds = holds && (square[k] == clamped((long)floor((double)from[k] / size), last[k]) ||
                              square[k] == clamped((long)floor((double)to[k] / size), last[k]));
        }
        const double w = 1 / ((double)fixture->depths.pixels[i] * 1000 - 50);
        range[0] = holds ? fmin(range[0], w) : range[0];
        range[1] = holds ? fmax(range[1], w) : range[1];
    }
}

/* Parts from the middle of a pixel to that of another, on the frame and about its borders. */
static void test_range(void)
{
    struct fixture fixture;
    fill(&fixture, rough);
    for (int i = 0; i < 3000; i++) {
        const long from[2] = {(long)floor(fmod(i * 0.754878, 1) * 46) - 3,
                              (long)floor(fmod(i * 0.569840, 1) * 28) - 3};
        const long size = i % 3 == 0 ? 3 : 24;
        const long to[2] = {from[0] + (long)floor(fmod(i * 0.618034, 1) * (double)size),
                            from[1] + (long)floor(fmod(i * 0.318, 1) * (double)size)};
        const struct card_part part = {{10 * (double)from[0] - 200, 110 - 10 * (double)to[1]},
                                       {10 * (double)to[0] - 200, 110 - 10 * (double)from[1]}};
        const bool is_within = from[0] >= 0 && from[1] >= 0 && to[0] < COLUMNS && to[1] < ROWS;
        double least, most, range[2];
        range_of(&fixture, from, to, range);
        fixture.relief.is_endless = false;
        depth_card_range(&fixture.relief, &part, &least, &most);
        CHECK_NEAR(least, is_within ? range[0] : 0, 1e-12, "the farthest of a part");
        CHECK_NEAR(most, range[1], 1e-12, "the nearest of a part");
        fixture.relief.is_endless = true;
        depth_card_range(&fixture.relief, &part, &least, &most);
        CHECK_NEAR(least, range[0], 1e-12, "the farthest of a frame that goes on");
        CHECK_NEAR(most, range[1], 1e-12, "the nearest of it");
    }
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
    /* just at the front vertex, and just in a pupil before it, whose distance would be 0 */
    fixture.depths.pixels[2 * COLUMNS + 4] = 0.125F;
    fixture.question.sensor = 125;
    CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    fixture.question.sensor = 75;
    fixture.question.pupil = -50;
    CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    fixture.question.pupil = -49;
    CHECK(depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    fixture.question.pupil = -950; /* in the card itself */
    CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    CHECK_TEXT(error.message, "the card lies behind the entrance pupil");
    fixture.question.pupil = INFINITY;
    CHECK(!depth_card_open(&fixture.question, &fixture.arena, &fixture.relief, &error));
    arena_free(&fixture.arena);
}

int main(void)
{
    test_planes();
    test_edges();
    test_steps();
    test_coarse();
    test_plane();
    test_steep();
    test_endless();
    test_far_beside();
    test_corner();
    test_march();
    test_range();
    test_errors();
    return check_report();
}
