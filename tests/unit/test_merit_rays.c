/* tests/unit/test_merit_rays.c - spots and wave fronts of lenses with variables. */
/* SPDX-License-Identifier: MIT */
#include "double_gauss.h"
#include "merit_rays_check.h"

static void check_lens(const char *text, const char *names, const struct merit_question *question,
                       enum operand_kind kind)
{
    static struct under_test test;
    struct error error = {0};
    const bool done = open_test(&test, text, names, question, kind, &error) && check_all(&test);
    CHECK(done);
    printf(done ? "%s: worst error %.2g of scale\n" : "%s\n", names, test.worst);
    if (!done) {
        printf("%s\n%s%s\n", text, error.message, test.merit.why.message);
    }
    arena_free(&test.arena);
}

/* Every kind of variable, aim, aperture, image plane and field. */
static void check_derivatives(void)
{
    static const struct merit_question stop = {.fnumber = NAN, .pattern = PATTERN_GAUSS, .rays = 3};
    struct merit_question entrance = stop, fast = stop;
    entrance.from_entrance = true;
    fast.fnumber = 6;
    static const char *const round = "wavelength d F\nfield angle 0 9\naperture epd 8\n"
                                     "focus paraxial\nsurface 50 6 1.6/55 -\nsurface -80 3 air -\n"
                                     "surface -40 2 1.7/30 -\nstop - 5 air 8\n"
                                     "surface 70 4 1.5 - k=-1 A4=1e-6\nsurface -35 40 air -\n";
    static const char *const all_round = "R1 c2 t1 t4 n1 V1 n5 k5 A4_5 A6_6 R6";
    check_lens(round, all_round, &stop, OPERAND_SPOT);
    check_lens(round, all_round, &entrance, OPERAND_POLY);
    check_lens(round, all_round, &fast, OPERAND_POLY);
    check_lens(round, all_round, &fast, OPERAND_OPD);
    static const char *const table = "wavelength e\nfield image 0 5,3\naperture stop\n"
                                     "focus table\nsurface 50 6 1.6 -\nsurface -80 3 air -\n"
                                     "surface -40 2 1.7 -\nstop - 5 air 7\n"
                                     "surface 70 4 1.5 -\nsurface -35 40 air -\n";
    check_lens(table, "R1 t3 t6 decenter_x2 decenter_y1 tilt_x3 tilt_y5 decenter_y4", &stop,
               OPERAND_SPOT);
    check_lens(table, "R1 t2 R5", &entrance, OPERAND_SPOT);
    check_lens(table, "R1 t2 R5 t6 tilt_y3", &entrance, OPERAND_OPD);
    static const char *const near = "wavelength e C\nobject 150\nfield height 0 6\n"
                                    "aperture na 0.02\nfocus paraxial\nmedium 1.1\n"
                                    "surface 40 6 1.6 -\nsurface - 3 1.2 -\nstop - 2 1.2 -\n"
                                    "surface -60 5 1.8 - k=2 A4=1e-5\nsurface 90 60 1.1 -\n";
    check_lens(near, "n0 R1 t2 n4 A4_4", &stop, OPERAND_SPOT);
    check_lens(near, "n0", &entrance, OPERAND_SPOT);
    check_lens(near, "n0", &stop, OPERAND_OPD);
    check_lens(near, "R1 t2 n4 A4_4", &entrance, OPERAND_POLY);
    check_lens(near, "R1 t2 n4 A4_4", &stop, OPERAND_OPD);
    static const char *const near_image = "object 150\nfield image 0 4\naperture na 0.02\n"
                                          "focus paraxial\nsurface 40 6 1.6 -\nsurface - 3 1 -\n"
                                          "stop - 2 1 -\nsurface -60 5 1.8 -\nsurface -90 0 1 -\n";
    check_lens(near_image, "R1 t2 n4", &stop, OPERAND_SPOT);
    check_lens(near_image, "R1 t2 n4", &entrance, OPERAND_SPOT);
    check_lens(near_image, "R1 t2 n4 t5", &entrance, OPERAND_OPD);
    static const char *const mirrors = "field angle 0 0.5\naperture f/12\nfocus paraxial\n"
                                       "stop - 0 air -\n"
                                       "surface -160 -50 mirror - k=-1\n"
                                       "surface -100 60 mirror - A4=1e-7\n"
                                       "surface 90 3 1.5 -\nsurface 400 10 air -\n";
    check_lens(mirrors, "R2 t2 k2 R3 A4_3 t3 n4", &stop, OPERAND_SPOT);
    check_lens(mirrors, "R2 t2 k2 R3 A4_3 t3 n4", &stop, OPERAND_OPD);
    static const char *const zoom = "field angle 0 4\naperture f/8\nfocus table\n"
                                    "position wide tele\nlet d2 4 12\nlet d4 30 22\n"
                                    "surface 80 4 1.6/60 -\nsurface -200 d2 air -\n"
                                    "surface -60 2 1.7 -\nsurface 90 d4 air -\nstop - 1 air 9\n"
                                    "surface 40 4 1.6 -\nsurface -50 70 air -\n";
    check_lens(zoom, "R1 R3 t1 n3 t7 V1 t2@1 t4@0", &stop, OPERAND_SPOT);
    check_lens(mirrors, "R2 t2 tilt_x3 bend_tilt_y3 bend_decenter_x4", &stop, OPERAND_SPOT);
    /* light goes through one glass twice */
    static const char *const mangin = "field angle 0 1\naperture f/8\nfocus paraxial\n"
                                      "stop - 10 air -\n"
                                      "surface -150 8 1.52 -\n"
                                      "surface -200 -8 mirror -\n"
                                      "surface -150 -60 air -\n";
    check_lens(mangin, "R2 n2 t2", &stop, OPERAND_SPOT);
}

static const char *const far_image = "wavelength d F\nfield image 0 5,3\naperture stop\n"
                                     "focus table\nsurface 50 6 1.6/55 -\nsurface -80 3 air -\n"
                                     "surface -40 2 1.7/30 -\nstop - 5 air 7\n"
                                     "surface 70 4 1.5 -\nsurface -35 40 air -\n";

/*
 * Rays that begin where those of a lens before it ended are of its own field: of an image height,
 * whose object is another one in every lens.
 */
static void check_settled(enum operand_kind kind, bool from_entrance)
{
    static struct under_test test;
    const struct merit_question question = {
        .fnumber = NAN, .pattern = PATTERN_GAUSS, .rays = 3, .from_entrance = from_entrance};
    struct error error = {0};
    const bool opens = open_test(&test, far_image, "R1 t2 R5", &question, kind, &error);
    CHECK(opens);
    if (opens) {
        double *residuals = ARENA_ARRAY(&test.arena, test.merit.residual_count, double);
        CHECK(merit_evaluate(&test.merit, test.v, residuals, NULL));
        merit_beams_settle(test.merit.slots[0].beams, false);
        test.v[0] *= 1.02;
        test.v[1] += 0.1;
        CHECK(check_all(&test));
    }
    arena_free(&test.arena);
}

/* Rays that are held stay whatever their field: a slope is that of what they do, by differences. */
static void check_held(enum operand_kind kind)
{
    enum { SIDES = 2 };
    static const double steps[SIDES] = {-1e-4, 1e-4};
    static struct under_test test;
    const struct merit_question question = {.fnumber = NAN, .pattern = PATTERN_GAUSS, .rays = 3};
    struct error error = {0};
    const bool opens = open_test(&test, far_image, "t2", &question, kind, &error);
    CHECK(opens);
    if (opens) {
        const size_t rows = test.merit.residual_count;
        double *residuals = ARENA_ARRAY(&test.arena, rows, double);
        double *jacobian = ARENA_ARRAY(&test.arena, rows, double);
        double *slopes = ARENA_ARRAY(&test.arena, rows, double), largest = 0;
        CHECK(merit_evaluate(&test.merit, test.v, residuals, NULL));
        merit_beams_settle(test.merit.slots[0].beams, true);
        for (int k = 0; k < SIDES; k++) {
            const double moved = test.v[0] + steps[k];
            CHECK(merit_evaluate(&test.merit, &moved, residuals, NULL));
            for (size_t i = 0; i < rows; i++) {
                slopes[i] += residuals[i] / (SIDES * steps[k]);
            }
        }
        CHECK(merit_evaluate(&test.merit, test.v, residuals, jacobian));
        for (size_t i = 0; i < rows; i++) {
            largest = fmax(largest, fabs(slopes[i]));
        }
        for (size_t i = 0; i < rows; i++) {
            CHECK_NEAR(jacobian[i], slopes[i], 1e-6 * largest, "a slope of rays that are held");
        }
    }
    arena_free(&test.arena);
}

/*
 * The sum of squares of nine spots of the lecture's double Gauss and of what its focal length is
 * off from 100 mm, by a program of its own: 127 rays in rings, and Gauss's 36.
 */
static void check_starts(void)
{
    static const char *const text =
        "wavelength d F C\nfield angle 0 10 14\naperture epd 50\nfocus table\n" DOUBLE_GAUSS(
            "34.2");
    static const struct {
        enum pattern pattern;
        size_t rays;
        double sum;
    } cases[] = {{PATTERN_HEXAPOLAR, 127, 1.56763}, {PATTERN_GAUSS, 36, 1.00147}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        static struct under_test test;
        const struct merit_question question = {.fnumber = NAN,
                                                .from_entrance = true,
                                                .pattern = cases[i].pattern,
                                                .rays = cases[i].rays};
        struct error error;
        const bool opens = open_test(&test, text, "R1", &question, OPERAND_SPOT, &error);
        CHECK(opens);
        if (opens) {
            double *residuals = ARENA_ARRAY(&test.arena, test.merit.residual_count, double);
            struct truth truth;
            CHECK(merit_evaluate(&test.merit, test.v, residuals, NULL) &&
                  open_truth(&test, &test.merit.slots[0], test.v, &truth));
            const double off = (double)(1 / truth.first.power) - 100;
            double sum = off * off;
            for (size_t k = 0; k < test.merit.residual_count; k++) {
                sum += residuals[k] * residuals[k];
            }
            CHECK_NEAR(sum, cases[i].sum, 6e-6, "nine spots");
        }
        arena_free(&test.arena);
    }
}

/*
 * Behind a plate a parallel beam stays one, as wide as the stop of 4 mm in radius: the mean square
 * distance from its middle is 4^2/2 in each field, whatever the unit of residuals.
 */
static void check_squares(void)
{
    static const char *const plate = "wavelength d F\nfield angle 0 4 9\naperture stop\n"
                                     "focus table\nsurface - 2 1.5 -\nsurface - 5 air -\n"
                                     "stop - 40 air 8\n";
    static const double deviations[] = {1, 0.02};
    static const struct merit_question question = {
        .fnumber = NAN, .pattern = PATTERN_GAUSS, .rays = 3};
    for (size_t i = 0; i < 2; i++) {
        static struct under_test test;
        struct error error = {0};
        const bool opens = open_test(&test, plate, "R2", &question, OPERAND_SPOT, &error);
        CHECK(opens);
        if (opens) {
            double squares[3];
            double *residuals = ARENA_ARRAY(&test.arena, test.merit.residual_count, double);
            test.operand.deviation = deviations[i];
            CHECK(merit_evaluate(&test.merit, test.v, residuals, NULL));
            merit_rays_squares(&test.merit.slots[0], residuals, squares);
            for (int field = 0; field < 3; field++) {
                CHECK_RELATIVE(squares[field], 8.0, 1e-6, "a beam of 4 mm in radius");
            }
        }
        arena_free(&test.arena);
    }
}

int main(void)
{
    check_squares();
    if (sizeof(real) == sizeof(double)) {
        printf("spots: skipped, no number has more than 53 bits\n");
        return check_report();
    }
    check_starts();
    check_derivatives();
    check_settled(OPERAND_SPOT, false);
    check_settled(OPERAND_POLY, true);
    check_settled(OPERAND_OPD, false);
    check_held(OPERAND_SPOT);
    check_held(OPERAND_OPD);
    return check_report();
}
