/* tests/unit/test_tolerance_model.c - made lenses by derivatives, statistics and symmetry. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "double_gauss.h"
#include "lens_of.h"

#include "base/random.h"
#include "design/merit/merit_rays.h"
#include "design/tolerance/irregularity.h"
#include "design/tolerance/sensitivity.h"
#include "design/tolerance/tolerance_trial.h"

#include <string.h>

enum { MOST = 16, FIGURES = 8 };

static const char double_gauss[] = "wavelength d F C\naperture stop\nfield angle 0 10 14\n"
                                   "focus paraxial\n" DOUBLE_GAUSS("34.2");

static struct arena arena;

struct under_test {
    struct lens lens;
    struct tolerance tolerance;
    struct second_order_problem problem;
    double *nominal;
};

/* Spots of 12 Gauss rays, or another criterion; `question` says what is not usual. */
static bool open_test(struct under_test *test, const char *text, struct tolerance_question question,
                      const struct perturbation *list, size_t count)
{
    struct error error = {.code = ERROR_NONE};
    test->lens = lens_of(text, &arena);
    question.view.lens = &test->lens;
    question.view.fnumber = NAN;
    question.view.pattern = PATTERN_GAUSS;
    question.view.rays = 12;
    question.perturbations = list;
    question.perturbation_count = count;
    question.criterion.frequency = NAN;
    question.criterion.name = "it";
    const bool done = tolerance_open(&question, &arena, &test->tolerance, &error);
    CHECK(done);
    if (done) {
        test->problem = tolerance_problem(&test->tolerance, NULL, &arena, &test->nominal);
        CHECK(test->problem.figure_count <= FIGURES);
    } else {
        printf("%s\n%s\n", text, error.message);
    }
    return done;
}

static void try(struct under_test *test, const double *errors, double *figures)
{
    struct error why = {.code = ERROR_NONE};
    const bool done = test->problem.trial(test->problem.context, errors, figures, &why);
    CHECK(done);
    if (!done) {
        printf("%s\n", why.message);
    }
}

#define SPREAD                                                                                     \
    {                                                                                              \
        .distribution = DISTRIBUTION_UNIFORM                                                       \
    }
#define NUMBER(one, surface, which, size)                                                          \
    {                                                                                              \
        .kind = one, .first = surface, .last = surface, .what = {surface, which, 0},               \
        .amount = size, .spread = SPREAD, .name = #which                                           \
    }
/* of the same surfaces, kind and pivot: one thing */
#define ELEMENT(one, from, to, way, size, about)                                                   \
    {                                                                                              \
        .kind = one, .first = from, .last = to, .what.kind = PARAMETER_KINDS, .axis = way,         \
        .amount = size, .pivot = about, .spread = SPREAD, .name = "element",                       \
        .thing = 1000 * (from) + 10 * (size_t)(one) + ((about) != 0)                               \
    }

/* -------- against derivatives -------- */

static const struct perturbation several[] = {
    NUMBER(TOLERANCE_RADIUS, 0, PARAMETER_RADIUS, 0.05),
    NUMBER(TOLERANCE_AIR, 1, PARAMETER_THICKNESS, 0.02),
    NUMBER(TOLERANCE_INDEX, 2, PARAMETER_INDEX, 5e-4),
    NUMBER(TOLERANCE_TILT, 3, PARAMETER_TILT_X, 5e-4),
    NUMBER(TOLERANCE_DECENTER, 6, PARAMETER_DECENTER_Y, 0.01),
    NUMBER(TOLERANCE_THICKNESS, 7, PARAMETER_THICKNESS, 0.02),
    {.kind = TOLERANCE_IRREGULARITY,
     .first = 1,
     .last = 1,
     .what.kind = PARAMETER_KINDS,
     .axis = PERTURBATION_X,
     .amount = 0.5,
     .spread = SPREAD,
     .name = "irregularity"},
};
enum { SEVERAL = sizeof several / sizeof several[0] };

/* The merit of the same spots, with a column a perturbation. */
static void open_columns(struct under_test *test, struct variables *variables, struct merit *merit)
{
    static struct variable list[SEVERAL];
    static struct irregularity irregular;
    static struct operand operand;
    struct error error;
    operand = (struct operand){.kind = OPERAND_POLY,
                               .deviation = 1,
                               .wavelength = NAN,
                               .position = LENS_NONE,
                               .first = LENS_NONE,
                               .last = LENS_NONE,
                               .frequency = NAN,
                               .name = "poly"};
    const struct surface *bent = &test->lens.surfaces[1];
    irregular = (struct irregularity){1, IRREGULARITY_COS, bent->diameter.value.hi / 2};
    for (size_t i = 0; i + 1 < SEVERAL; i++) {
        list[i] = (struct variable){.what = several[i].what,
                                    .position = LENS_NONE,
                                    .low = -INFINITY,
                                    .high = INFINITY,
                                    .name = several[i].name};
        if (list[i].what.kind == PARAMETER_RADIUS) {
            list[i].what.kind = PARAMETER_CURVATURE;
        }
    }
    const struct merit_question question = {.lens = test->tolerance.lens,
                                            .variables = variables,
                                            .variable_count = SEVERAL - 1,
                                            .irregularities = &irregular,
                                            .irregularity_count = 1,
                                            .operands = &operand,
                                            .operand_count = 1,
                                            .fnumber = NAN,
                                            .pattern = PATTERN_GAUSS,
                                            .rays = 12};
    CHECK(variables_open(test->tolerance.lens, list, SEVERAL - 1, &arena, variables, &error));
    CHECK(merit_open(&question, &arena, merit, &error));
}

/*
 * Linear parts against 2 r.J/(2 RMS) with the Jacobian that test_merit_rays.c has checked by 113
 * bits, as test_irregularity.c has the column of the irregularity.
 */
static void check_linear(void)
{
    static struct under_test test;
    struct variables variables;
    struct merit merit;
    const struct tolerance_question question = {.refocus = REFOCUS_NONE, .aims = true};
    struct sensitivity table[SEVERAL][FIGURES];
    const char *failure;
    if (!open_test(&test, double_gauss, question, several, SEVERAL)) {
        return;
    }
    const size_t figures = test.problem.figure_count;
    struct sensitivity *rows = ARENA_ARRAY(&arena, SEVERAL * figures, struct sensitivity);
    sensitivity_find(&test.problem, test.nominal, &arena, rows, &failure);
    CHECK(failure == NULL);
    memset(table, 0, sizeof table);
    open_columns(&test, &variables, &merit);
    double numbers[SEVERAL];
    double *residuals = ARENA_ARRAY(&arena, merit.residual_count, double);
    double *jacobian = ARENA_ARRAY(&arena, merit.residual_count * SEVERAL, double);
    variables_get(&variables, numbers);
    CHECK(merit_evaluate(&merit, numbers, residuals, jacobian));
    const struct merit_bundle *bundle = &merit.slots[0].beams->bundle;
    for (size_t j = 0; j < SEVERAL; j++) {
        double square[3] = {0}, slope[3] = {0}, scale = 0;
        const double radius = test.lens.surfaces[0].radius.value.hi;
        const double unit = j == 0             ? -1 / (radius * radius)
                            : j == SEVERAL - 1 ? TOLERANCE_WAVE_MM
                                               : 1;
        for (size_t g = 0; g < bundle->group_count; g++) {
            const struct bundle_group *group = &bundle->groups[g];
            for (size_t k = 0; k < 2 * group->points.count; k++) {
                const size_t at = group->row + k;
                square[group->field] += residuals[at] * residuals[at] / 3;
                slope[group->field] += residuals[at] * jacobian[at * SEVERAL + j] / 3;
            }
        }
        for (size_t f = 0; f < 3; f++) {
            slope[f] *= several[j].amount * unit / sqrt(square[f]);
            scale = fmax(scale, fabs(slope[f]));
            CHECK_RELATIVE(sqrt(square[f]), test.nominal[f], 1e-12, "nominal");
        }
        for (size_t f = 0; f < 3; f++) {
            CHECK_NEAR(rows[j * figures + f].linear, slope[f], 1e-9 * fmax(scale, 1e-6),
                       "linear part");
        }
    }
    arena_free(&arena);
}

/* -------- against statistics -------- */

/* Small errors: the deviation of many trials is that of the linear parts. */
static void check_deviation(enum criterion_kind kind, enum tolerance_refocus refocus)
{
    enum { TRIALS = 1500 };
    static struct under_test test;
    struct perturbation small[SEVERAL];
    const char *failure;
    const struct tolerance_question question = {.criterion.kind = kind, .refocus = refocus};
    for (size_t i = 0; i < SEVERAL; i++) {
        small[i] = several[i];
        small[i].amount *= 1e-3;
    }
    if (!open_test(&test, double_gauss, question, small, SEVERAL)) {
        return;
    }
    const size_t figures = test.problem.figure_count;
    struct sensitivity *rows = ARENA_ARRAY(&arena, SEVERAL * figures, struct sensitivity);
    sensitivity_find(&test.problem, test.nominal, &arena, rows, &failure);
    double sum[FIGURES] = {0}, squares[FIGURES] = {0}, fourths[FIGURES] = {0};
    for (uint64_t k = 0; k < TRIALS; k++) {
        double errors[SEVERAL], at[FIGURES];
        for (uint32_t i = 0; i < SEVERAL; i++) {
            errors[i] = 2 * random_unit(3, k, i) - 1;
        }
        try(&test, errors, at);
        for (size_t f = 0; f < figures; f++) {
            const double off = at[f] - test.nominal[f];
            sum[f] += off;
            squares[f] += off * off;
            fourths[f] += off * off * off * off;
        }
    }
    for (size_t f = 0; f < figures; f++) {
        double variance = 0;
        for (size_t i = 0; i < SEVERAL; i++) {
            variance += rows[i * figures + f].linear * rows[i * figures + f].linear / 3;
        }
        const double is = squares[f] / TRIALS - pow(sum[f] / TRIALS, 2);
        const double error = sqrt((fourths[f] / TRIALS - is * is) / TRIALS);
        CHECK_NEAR(is, variance, 4 * error + 1e-26, "variance of trials");
    }
    arena_free(&arena);
}

/* To second order: what is left out of the squares is of the third, and falls with it. */
static void check_second(enum tolerance_refocus refocus)
{
    double off[2] = {0, 0};
    for (int k = 0; k < 2; k++) {
        static struct under_test test;
        struct perturbation list[SEVERAL];
        struct second_order differential;
        struct error error;
        for (size_t i = 0; i < SEVERAL; i++) {
            list[i] = several[i];
            list[i].amount *= k == 0 ? 1 : 0.25;
        }
        const struct tolerance_question question = {.refocus = refocus};
        if (!open_test(&test, double_gauss, question, list, SEVERAL) ||
            !second_order_open(&test.problem, &arena, &differential, &error)) {
            CHECK(false);
            return;
        }
        double errors[SEVERAL * SECOND_ORDER_LANES], figures[FIGURES * SECOND_ORDER_LANES];
        for (uint64_t i = 0; i < SEVERAL * SECOND_ORDER_LANES; i++) {
            errors[i] = 2 * random_unit(9, i, 0) - 1;
        }
        second_order_trials(&differential, errors, figures);
        for (size_t l = 0; l < SECOND_ORDER_LANES; l++) {
            double one[SEVERAL], exact[FIGURES];
            for (size_t i = 0; i < SEVERAL; i++) {
                one[i] = errors[i * SECOND_ORDER_LANES + l];
            }
            try(&test, one, exact);
            for (size_t f = 0; f < test.tolerance.figure_count; f++) {
                const double about = figures[f * SECOND_ORDER_LANES + l];
                off[k] = fmax(off[k], fabs(about * about - exact[f] * exact[f]));
                CHECK_NEAR(about, exact[f], 0.02 * exact[f], "second order");
            }
        }
        arena_free(&arena);
    }
    CHECK(off[0] > 0 && off[1] < off[0] / 40); /* 4^3 = 64, and somewhat less */
}

/* -------- by symmetry -------- */

/* On the axis of a round lens both signs do the same, and x does what y does. */
static void check_pairs(void)
{
    static struct under_test test;
    static const char text[] =
        "wavelength d F C\naperture stop\nfocus paraxial\n" DOUBLE_GAUSS("34.2");
    static const struct perturbation list[] = {
        ELEMENT(TOLERANCE_ELEMENT_DECENTER, 2, 4, PERTURBATION_X, 0.1, 0),
        ELEMENT(TOLERANCE_ELEMENT_DECENTER, 2, 4, PERTURBATION_Y, 0.1, 0),
        ELEMENT(TOLERANCE_ELEMENT_TILT, 6, 8, PERTURBATION_X, 0.002, 3),
        ELEMENT(TOLERANCE_ELEMENT_TILT, 6, 8, PERTURBATION_Y, 0.002, 3),
    };
    const struct tolerance_question question = {.refocus = REFOCUS_BEST};
    if (!open_test(&test, text, question, list, 4)) {
        return;
    }
    double at[4][2][FIGURES];
    for (size_t i = 0; i < 4; i++) {
        for (int side = 0; side < 2; side++) {
            double errors[4] = {0};
            errors[i] = side == 0 ? 1 : -1;
            try(&test, errors, at[i][side]);
        }
        CHECK(fabs(at[i][0][0] - test.nominal[0]) > 1e-5);
        CHECK_NEAR(at[i][0][0], at[i][1][0], 1e-12, "both signs");
        CHECK_NEAR(at[i][0][1], at[i][1][1], 1e-12, "both refocus");
    }
    CHECK_NEAR(at[0][0][0], at[1][0][0], 1e-12, "x and y");
    CHECK_NEAR(at[2][0][0], at[3][0][0], 1e-12, "x and y");
    arena_free(&arena);
}

/* Both surfaces of an element about one centre: it may turn about that as it likes. */
static void check_concentric(void)
{
    static struct under_test test;
    static const char text[] = "wavelength d\nfield angle 0 3\naperture stop\nfocus table\n"
                               "stop - 2 air 8\nsurface 50 10 1.6 -\nsurface 40 5 air -\n"
                               "surface 60 4 1.5 -\nsurface -60 60 air -\n";
    static const struct perturbation list[] = {
        ELEMENT(TOLERANCE_ELEMENT_TILT, 1, 2, PERTURBATION_X, 0.02, 50),
        ELEMENT(TOLERANCE_ELEMENT_TILT, 1, 2, PERTURBATION_Y, 0.02, 50),
        ELEMENT(TOLERANCE_ELEMENT_TILT, 1, 2, PERTURBATION_X, 0.02, 0),
    };
    const struct tolerance_question question = {.refocus = REFOCUS_NONE};
    if (!open_test(&test, text, question, list, 3)) {
        return;
    }
    for (size_t i = 0; i < 3; i++) {
        double errors[3] = {0}, at[FIGURES];
        errors[i] = 1;
        try(&test, errors, at);
        const double off = fabs(at[1] - test.nominal[1]);
        CHECK(i < 2 ? off < 1e-13 : off > 1e-5);
    }
    arena_free(&arena);
}

/* The first figures of a lens as its file has it. */
static void look(const char *text, double *figures)
{
    static struct under_test test;
    const struct tolerance_question question = {.refocus = REFOCUS_NONE, .aims = true};
    if (open_test(&test, text, question, NULL, 0)) {
        memcpy(figures, test.nominal, test.tolerance.figure_count * sizeof *figures);
    }
}

/*
 * An element that is displaced surface by surface against coordinate breaks before it and, back at
 * its first vertex, behind it; and all surfaces with their stop, which is the lens tilted.
 */
static void check_breaks(void)
{
#define HEAD "wavelength d\nfield angle 0 3\naperture stop\nfocus table\n"
    static const char plain[] = HEAD "surface 70 6 1.6 -\nsurface -200 4 air -\nstop - 3 air 9\n"
                                     "surface -60 2 1.7 -\nsurface 50 5 1.5 -\n"
                                     "surface -45 90 air -\n";
    static const struct {
        struct perturbation list[2];
        const char *broken;
    } cases[] = {
        {{ELEMENT(TOLERANCE_ELEMENT_TILT, 3, 5, PERTURBATION_X, 0.01, 0),
          ELEMENT(TOLERANCE_ELEMENT_DECENTER, 3, 5, PERTURBATION_Y, 0.2, 0)},
         HEAD "surface 70 6 1.6 -\nsurface -200 4 air -\nstop - 3 air 9\n"
              "bend decenter=0,0.2 tilt=0.57295779513082320877,0,0\n"
              "surface -60 2 1.7 -\nsurface 50 5 1.5 -\nsurface -45 -7 air -\n"
              "bend tilt=-0.57295779513082320877,0,0\nsurface - 97 air -\n"},
        {{ELEMENT(TOLERANCE_ELEMENT_TILT, 0, 5, PERTURBATION_X, 0.01, 0),
          ELEMENT(TOLERANCE_ELEMENT_TILT, 0, 5, PERTURBATION_Y, 1e-300, 0)},
         HEAD "bend tilt=0.57295779513082320877,0,0\n"
              "surface 70 6 1.6 -\nsurface -200 4 air -\nstop - 3 air 9\n"
              "surface -60 2 1.7 -\nsurface 50 5 1.5 -\nsurface -45 -20 air -\n"
              "bend tilt=-0.57295779513082320877,0,0\nsurface - 110 air -\n"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        static struct under_test test;
        const struct tolerance_question question = {.refocus = REFOCUS_NONE, .aims = true};
        const double errors[2] = {1, 1};
        double displaced[FIGURES], broken[FIGURES] = {0};
        if (!open_test(&test, plain, question, cases[k].list, 2)) {
            return;
        }
        try(&test, errors, displaced);
        for (size_t f = 0; f < 2; f++) {
            CHECK(fabs(displaced[f] - test.nominal[f]) > 1e-5);
        }
        look(cases[k].broken, broken);
        for (size_t f = 0; f < 2; f++) {
            CHECK_NEAR(displaced[f], broken[f], 1e-12, "coordinate breaks");
        }
        arena_free(&arena);
    }
}

int main(void)
{
    check_linear();
    check_deviation(CRITERION_SPOT, REFOCUS_NONE);
    check_deviation(CRITERION_SPOT, REFOCUS_BEST);
    check_deviation(CRITERION_EFL, REFOCUS_BEST);
    check_second(REFOCUS_NONE);
    check_second(REFOCUS_BEST);
    check_pairs();
    check_concentric();
    check_breaks();
    return check_report();
}
