/* tests/unit/test_panorama.c - frames, size and parallax of panoramas. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "photo/panorama.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

static const double pi = PI, degree = RADIANS_PER_DEGREE;

/* Columbia University, R4110 week 12 (2000): frames of a full turn, 35 mm film upright, at least
   50 % overlap. The table rounds up to even numbers, and so does the comparison. */
static void test_columbia(void)
{
    static const struct {
        double f;
        int frames;
    } rows[] = {{14, 10}, {15, 10}, {18, 12}, {20, 12}, {22, 14},  {24, 14},  {27, 16},  {35, 20},
                {42, 24}, {50, 28}, {55, 30}, {85, 46}, {100, 54}, {135, 72}, {200, 106}};
    struct panorama_goal goal = {2 * pi, 0, 0.5};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct panorama_frame frame;
        struct panorama p;
        struct error error;
        CHECK(panorama_frame(rows[i].f, 0, 1, 24, 36, &frame, &error));
        CHECK(panorama_plan(&frame, &goal, &p, &error));
        CHECK_NEAR(p.columns + p.columns % 2, rows[i].frames, 0, "Columbia R4110 table");
        CHECK(p.overlap >= 0.5 && p.rows == 1 && isnan(p.row_overlap));
        CHECK_RELATIVE(p.step * p.columns, 2 * pi, 1e-14, "the turn closes");
    }
}

/* Angles by Markerink, shifcalc: 24 mm on 36 x 24: 73.7 and 53.1 degrees; novacalculator.com: 50 mm
   upright 27.0 degrees, 30 % overlap steps 18.9 degrees. */
static void test_angles(void)
{
    struct panorama_frame frame;
    struct error error;
    CHECK(panorama_frame(24, 0, 1, 36, 24, &frame, &error));
    CHECK_NEAR(frame.horizontal / degree, 73.7, 0.05, "Markerink: 73.7");
    CHECK_NEAR(frame.vertical / degree, 53.1, 0.05, "Markerink: 53.1");
    CHECK(panorama_frame(50, 0, 1, 24, 36, &frame, &error));
    CHECK_NEAR(0.7 * frame.horizontal / degree, 18.9, 0.05, "novacalculator: step 18.9");
    CHECK(panorama_frame(50, 1, 1, 24, 36, &frame, &error));
    CHECK_RELATIVE(tan(frame.horizontal / 2), 12 / 100.0, 1e-14, "1:1 halves it");
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Enough frames, and one less would not do. */
static void test_plan(void)
{
    uint64_t state = 41;
    for (int i = 0; i < 4000; i++) {
        struct panorama_frame frame = {(5 + 115 * uniform(&state)) * degree,
                                       (5 + 95 * uniform(&state)) * degree};
        struct panorama_goal goal = {(i % 3 ? 10 + 340 * uniform(&state) : 360) * degree,
                                     180 * degree * uniform(&state), 0.8 * uniform(&state)};
        struct panorama p;
        struct error error;
        double overlap;
        CHECK(panorama_plan(&frame, &goal, &p, &error));
        CHECK(p.shots == p.columns * p.rows);
        CHECK(p.columns == 1 || p.overlap >= goal.overlap - 1e-9);
        CHECK(p.rows == 1 || p.row_overlap >= goal.overlap - 1e-9);
        CHECK(i % 3 == 0 || frame.horizontal + (p.columns - 1) * p.step >= goal.arc - 1e-12);
        CHECK(frame.vertical + (p.rows - 1) * p.row_step >= goal.span - 1e-12);
        CHECK(panorama_overlap(&frame, goal.arc, p.columns, &overlap, &error));
        CHECK(isnan(overlap) ? isnan(p.overlap) : fabs(overlap - p.overlap) < 1e-12);
        if (p.columns > 2) {
            CHECK(panorama_overlap(&frame, goal.arc, p.columns - 1, &overlap, &error));
            CHECK(overlap < goal.overlap);
        }
    }
    /* 360/(60 x 0.5) is 12 and not 13, whatever the rounding */
    struct panorama_frame sixty = {60 * degree, 40 * degree};
    struct panorama p;
    struct error error;
    CHECK(panorama_plan(&sixty, &(struct panorama_goal){2 * pi, 0, 0.5}, &p, &error));
    CHECK(p.columns == 12);
    CHECK_NEAR(p.overlap, 0.5, 1e-14, "exactly half");
    CHECK(
        panorama_plan(&sixty, &(struct panorama_goal){60 * degree, 40 * degree, 0.3}, &p, &error));
    CHECK(p.shots == 1 && isnan(p.overlap));
}

/* A wished number of rows: the overlap that is left, or the span they reach. */
static void test_wished_rows(void)
{
    struct panorama_frame frame = {60 * degree, 40 * degree};
    struct panorama_goal goal = {2 * pi, 100 * degree, 0.3};
    struct panorama p;
    struct error error;
    CHECK(panorama_plan(&frame, &goal, &p, &error));
    CHECK(panorama_set_rows(&frame, &goal, 4, &p, &error));
    CHECK(p.rows == 4 && p.shots == 4 * p.columns);
    CHECK_RELATIVE(p.row_step / degree, 20.0, 1e-13, "(100 - 40)/3");
    CHECK_RELATIVE(p.row_overlap, 0.5, 1e-13, "1 - 20/40");
    CHECK(panorama_set_rows(&frame, &goal, 3, &p, &error));
    CHECK_RELATIVE(p.row_overlap, 0.25, 1e-13, "less than the 30 % asked for: (100 - 40)/2 is 30");
    CHECK(!panorama_set_rows(&frame, &goal, 2, &p, &error));
    CHECK_TEXT(error.message, "number of rows 2 leaves gaps: at least 3 for span 100 degrees");
    goal.span = 0;
    CHECK(panorama_set_rows(&frame, &goal, 3, &p, &error));
    CHECK_RELATIVE(goal.span / degree, 96.0, 1e-13, "40 + 2 x 40 x 0.7");
    CHECK_RELATIVE(p.row_overlap, 0.3, 1e-13, "as asked");
    goal.span = 0;
    CHECK(panorama_set_rows(&frame, &goal, 9, &p, &error));
    CHECK_RELATIVE(goal.span, pi, 1e-15, "no higher than zenith to nadir");
    CHECK_RELATIVE(p.row_step / degree, 17.5, 1e-13, "(180 - 40)/8");
    goal.span = 0;
    CHECK(panorama_set_rows(&frame, &goal, 1, &p, &error));
    CHECK(p.rows == 1 && isnan(p.row_overlap));
    CHECK(!panorama_set_rows(&frame, &goal, 0, &p, &error));
    CHECK(!panorama_set_rows(&frame, &goal, 1000000, &p, &error));
}

/* Fewer columns high up; every azimuth of the row is seen, by turning edge points. */
static void test_rows(void)
{
    struct panorama_frame frame = {40 * degree, 55 * degree};
    struct panorama_goal goal = {2 * pi, pi, 0.25};
    struct panorama p;
    struct panorama_row row;
    struct error error;
    int total = 0;
    CHECK(panorama_plan(&frame, &goal, &p, &error));
    for (int i = 0; i < p.rows; i++) {
        CHECK(panorama_row_at(&frame, &goal, &p, 0, i, &row, &error));
        CHECK(row.columns >= 1 && row.columns <= p.columns);
        total += row.columns;
        /* worst azimuth half-width of the frame's right edge, half-way to both neighbours */
        double least = pi;
        for (int j = -1000; j <= 1000; j++) {
            double y = j / 1000.0 * tan(p.row_step / 2), e = row.elevation;
            least = fmin(least, atan2(tan(frame.horizontal / 2), cos(e) - y * sin(e)));
        }
        CHECK(row.columns * 2 * least * 0.75 >= 2 * pi - 1e-9);
        CHECK(row.columns == 1 || (row.columns - 1) * 2 * least * 0.75 < 2 * pi);
    }
    CHECK(total < p.shots);
    goal.span = 0;
    CHECK(panorama_plan(&frame, &goal, &p, &error));
    CHECK(panorama_row_at(&frame, &goal, &p, 0, 0, &row, &error) && row.columns == p.columns);
    CHECK(panorama_row_at(&frame, &goal, &p, pi / 2, 0, &row, &error) && row.columns == 1);
    CHECK(!panorama_row_at(&frame, &goal, &p, 0, 1, &row, &error));
    CHECK(!panorama_row_at(&frame, &goal, &p, 2, 0, &row, &error));
}

static void test_size(void)
{
    struct panorama_frame frame = {90 * degree, 60 * degree};
    struct panorama_goal goal = {2 * pi, 60 * degree, 0.3};
    struct panorama_size s;
    struct error error;
    CHECK(panorama_size(&frame, &goal, 4000, &s, &error)); /* 2000 pixels per unit of tangent */
    CHECK_RELATIVE(s.width, 2000 * 2 * pi, 1e-14, "a turn of 2000 pixels a radian");
    CHECK_RELATIVE(s.per_degree, 2000 * degree, 1e-14, "per degree");
    CHECK_RELATIVE(s.cylinder_height, 4000 * tan(30 * degree), 1e-14, "cylinder");
    CHECK_RELATIVE(s.sphere_height, 2000 * pi / 3, 1e-14, "sphere");
    CHECK(isinf(s.flat_width));
    goal.arc = 90 * degree;
    CHECK(panorama_size(&frame, &goal, 4000, &s, &error));
    CHECK_RELATIVE(s.flat_width, 4000.0, 1e-14, "a single flat frame keeps its pixels");
}

/* Hugin manual, Parallax: 4 frames around (half the step 45 degrees), object at 1 m, pupil 1 mm
   off, 8000 pixels a turn: about r sin a/D on either side, 1.8 pixels (the table prints 1 and a
   digit). */
static void test_parallax(void)
{
    double p, e, near;
    struct error error;
    CHECK(panorama_parallax(1, pi / 2, 1000, (double)INFINITY, &p, &error));
    CHECK_NEAR(p * 8000 / (2 * pi), 1.8, 0.05, "Hugin manual, Parallax");
    CHECK_NEAR(p, 2 * sin(pi / 4) / 1000, 2e-6, "2 r sin a/D for small r");
    uint64_t state = 43;
    for (int i = 0; i < 3000; i++) {
        double offset = 0.1 + 100 * uniform(&state), step = (1 + 170 * uniform(&state)) * degree;
        double distance = offset * (1.5 + 100 * uniform(&state)), q;
        /* the same by coordinates: pupils at offset (cos, +-sin), thing at (distance, 0) */
        double y = offset * sin(step / 2), x = distance - offset * cos(step / 2);
        CHECK(panorama_parallax(offset, step, distance, (double)INFINITY, &p, &error));
        CHECK_NEAR(p, 2 * atan2(y, x), 1e-15, "parallax by coordinates");
        CHECK(panorama_parallax(-offset, step, distance, 3 * distance, &q, &error) && q < p);
        if (p < pi - step) {
            CHECK(panorama_offset(p, step, distance, &e, &error));
            CHECK_RELATIVE(e, offset, 1e-11, "offset back");
            CHECK(panorama_nearest(offset, p, step, &near, &error));
            CHECK_RELATIVE(near, distance, 1e-11, "nearest back");
        }
    }
    CHECK(panorama_parallax(0, pi / 2, 1000, (double)INFINITY, &p, &error));
    CHECK_NEAR(p, 0, 0, "about the pupil: none");
    CHECK(panorama_parallax(20, pi / 2, 1000, 1000, &p, &error));
    CHECK_NEAR(p, 0, 0, "same distance: none");
}

/* The pupil from the sensor: a thin lens has it in the lens; P = 0.5 puts it behind, nearer. */
static void test_pupil(void)
{
    double d;
    struct error error;
    CHECK(panorama_pupil(50, 0, 1, 0, &d, &error));
    CHECK_NEAR(d, 50, 1e-14, "thin lens");
    CHECK(panorama_pupil(50, 0.1, 2, 4, &d, &error));
    CHECK_NEAR(d, 55 + 4 + 25, 1e-13, "P = 2: 25 mm before H");
    CHECK(panorama_pupil(200, 0, 0.5, 0, &d, &error));
    CHECK_NEAR(d, 0, 1e-13, "telephoto, P = 0.5: at the sensor");
    CHECK(!panorama_pupil(50, 0, 0, 0, &d, &error));
}

static void test_refusals(void)
{
    static const struct {
        struct panorama_frame frame;
        struct panorama_goal goal;
        const char *words;
    } rows[] = {
        {{0, 1}, {6, 0, 0.3}, "horizontal angle"},
        {{1, NONE}, {6, 0, 0.3}, "vertical angle"},
        {{1, 1}, {0, 0, 0.3}, "arc 0 degrees"},
        {{1, 1}, {6.5, 0, 0.3}, "up to 360"},
        {{1, 1}, {6, -1, 0.3}, "span"},
        {{1, 1}, {6, 0, 1}, "overlap 1"},
        {{1, 1}, {6, 0, -0.1}, "below 1"},
        {{1e-6, 1}, {6, 0, 0.3}, "frames"},
        {{1e-4, 1e-4}, {6, 3, 0.3}, "up to"},
    };
    struct panorama p;
    struct error error;
    double x;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        CHECK(!panorama_plan(&rows[i].frame, &rows[i].goal, &p, &error));
        CHECK(error.code == ERROR_DOMAIN);
        check_at(strstr(error.message, rows[i].words) != NULL, __FILE__, __LINE__, rows[i].words);
    }
    struct panorama_frame frame;
    CHECK(!panorama_frame(0, 0, 1, 36, 24, &frame, &error));
    CHECK(!panorama_parallax(50, 1, 40, 1000, &x, &error));
    CHECK(!panorama_parallax(50, 1, 400, 100, &x, &error));
    CHECK(!panorama_offset(0, 1, 400, &x, &error));
    CHECK(!panorama_nearest(0, 0.1, 1, &x, &error));
    CHECK(!panorama_overlap(&(struct panorama_frame){1, 1}, 6, 0, &x, &error));
}

/* 3 m by 2 m at 300 dpi, 35433 by 23622 pixels, by a lens with 7800 pixels a radian. */
static void test_print(void)
{
    const struct panorama_frame frame = {2 * atan(18 / 50.0), 2 * atan(12 / 50.0)};
    struct panorama_goal goal = {0, 0, 0.3};
    struct error error;
    CHECK(panorama_goal_of_size(&frame, 5616, 35433, 23622, &goal, &error));
    CHECK_RELATIVE(goal.arc, 35433 / 7800.0, 1e-12, "7800 pixels: 50 mm of 36 mm by 5616");
    CHECK_RELATIVE(tan(goal.span / 2), 11811 / 7800.0, 1e-12, "half its height, as a tangent");
    CHECK_NEAR(goal.overlap, 0.3, 0, "as it was");
    CHECK(!panorama_goal_of_size(&frame, 5616, 49010, 23622, &goal, &error));
    CHECK(panorama_goal_of_size(&frame, 5616, 49008, 23622, &goal, &error));
}

int main(void)
{
    test_print();
    test_columbia();
    test_angles();
    test_plan();
    test_wished_rows();
    test_rows();
    test_size();
    test_parallax();
    test_pupil();
    test_refusals();
    return check_report();
}
