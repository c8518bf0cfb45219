/* tests/unit/test_merit_expression.c - goals that are arithmetic: values and gradients. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "merit_check.h"

static const char zoom[] = "wavelength d F C\n"
                           "object inf\n"
                           "aperture epd 8\n"
                           "field angle 0 6\n"
                           "focus table\n"
                           "position wide tele-2\n"
                           "let gap 20 6\n"
                           "surface 60 4 1.6/50 30 A4=1e-6\n"
                           "surface -900 gap air 30 k=0.5\n"
                           "stop - 2 air 20\n"
                           "surface -70 2 1.7/35 24\n"
                           "surface 90 12 air 24 tilt=1,0\n"
                           "surface 50 5 1.62/60 30\n"
                           "surface -40 50 air 30\n";

static const char names[] = "R1 c2 t1 n1 V1 k2 A4_1 t3 R4 n4 V6 t7 tilt_x5";

/* Figures that are tested elsewhere, in both positions, one after the other; edges and centres of
   three pieces of glass. */
static const char plain[] = "efl=70,bfl=50,length=40,cra@5deg,bfl@F=50,edge=1,center=1";

enum { EFL, BFL, LENGTH, CRA, BFL_F, EDGE, CENTER = EDGE + 3, PLAIN = CENTER + 3 };

/* Numbers of the prescription. */
enum { R1 = PLAIN, C2, T1, T2, N1, V1, K2, A4, T7, TILT, FIGURES };

/* The lens in both positions. */
struct figures {
    double of[2][FIGURES];
};

struct expression_case {
    const char *text;
    size_t residuals; /* of both positions */
    double (*value)(const struct figures *x, size_t residual);
};

/* In each position one. */
#define EACH(name, formula)                                                                        \
    static double name(const struct figures *figures, size_t residual)                             \
    {                                                                                              \
        const double *x = figures->of[residual];                                                   \
        return formula;                                                                            \
    }

/* Across them. */
#define ACROSS(name, formula)                                                                      \
    static double name(const struct figures *figures, size_t residual)                             \
    {                                                                                              \
        const double *x = figures->of[0], *y = figures->of[1];                                     \
        (void)residual;                                                                            \
        return formula;                                                                            \
    }

EACH(sum, x[LENGTH] + x[BFL])
EACH(product, -x[EFL] * 2 * (x[BFL] - 3) / x[LENGTH] + 5)
EACH(colour, x[BFL_F] - x[BFL])
EACH(angle, x[CRA] * 2 - 3 * RADIANS_PER_DEGREE)
EACH(inverse, 1 / x[EFL] + 1 / x[BFL] - 0.001)
EACH(sides, x[BFL] - x[EFL] / 2)
EACH(lens_maker, (x[N1] - 1) * (1 / x[R1] - x[C2]) * x[EFL])
EACH(glass, (x[N1] - 1) / x[V1] + x[K2] * x[T1])
EACH(shape, x[A4] * x[T1] * x[T1] * x[T1] + x[TILT] / (2 * RADIANS_PER_DEGREE))
ACROSS(move, x[T2] - y[T2])
ACROSS(focus, (x[BFL] - y[BFL]) / (x[EFL] - y[EFL]) - x[T7])

static double mixed(const struct figures *figures, size_t residual)
{
    return figures->of[residual][BFL] - figures->of[1][BFL] * 0.5;
}

static double edges(const struct figures *figures, size_t residual)
{
    const double *x = figures->of[residual / 3];
    return x[EDGE + residual % 3] / x[CENTER + residual % 3] - x[T1] / 10;
}

static const struct expression_case cases[] = {
    {"length + bfl < 60", 2, sum},
    {"- efl * 2 * (bfl - 3) / length + 5 = 1", 2, product},
    {"bfl@F - bfl@d = 0", 2, colour},
    {"cra@5deg * 2 - 3 < 1deg", 2, angle},
    {"1/efl + 1/bfl - 1/m = 0.01", 2, inverse},
    {"bfl > efl / 2", 2, sides},
    {"(n1 - 1) * (1/R1 - c2) * efl = 1", 2, lens_maker},
    {"(n1 - 1)/V1 + k2 * t1/1mm = 1", 2, glass},
    {"A4_1 * t1 * t1 * t1 + tilt_x5/2deg < 2", 2, shape},
    {"t2@wide - gap@tele-2 > 1", 1, move},
    {"(bfl@wide - bfl@tele-2)/(efl@wide - efl@tele-2) - t7@wide/1mm=1", 1, focus},
    {"bfl - bfl@tele-2 * 0.5 = 1", 2, mixed},
    {"edge / center > t1 / 1cm", 6, edges},
};

/* What the lens has. */
static void figures_read(const struct merit_bench *bench, const struct merit *merit,
                         struct figures *figures)
{
    size_t next = 0;
    /* of each goal both positions */
    for (size_t i = 0; i < EDGE; i++) {
        for (size_t p = 0; p < 2; p++) {
            figures->of[p][i] = merit->values[next++];
        }
    }
    for (size_t i = EDGE; i < PLAIN; i += 3) {
        for (size_t k = 0; k < 6; k++) {
            figures->of[k / 3][i + k % 3] = merit->values[next++];
        }
    }
    const struct parameter what[] = {{0, PARAMETER_RADIUS, 0},    {1, PARAMETER_CURVATURE, 0},
                                     {0, PARAMETER_THICKNESS, 0}, {1, PARAMETER_THICKNESS, 0},
                                     {0, PARAMETER_INDEX, 0},     {0, PARAMETER_ABBE, 0},
                                     {1, PARAMETER_CONIC, 0},     {0, PARAMETER_COEFFICIENT, 4},
                                     {6, PARAMETER_THICKNESS, 0}, {4, PARAMETER_TILT_X, 0}};
    for (size_t p = 0; p < 2; p++) {
        for (size_t i = 0; i < FIGURES - PLAIN; i++) {
            figures->of[p][PLAIN + i] = parameter_get(bench->merit.places[p].lens, what[i]);
        }
    }
}

/* The value that is expected, with one number changed. */
static double expected_at(struct merit_bench *bench, const struct expression_case *of,
                          size_t residual, size_t variable, double by)
{
    double v[MERIT_MOST], residuals[MERIT_MOST];
    struct figures figures;
    memcpy(v, bench->v, sizeof v);
    v[variable] += by;
    CHECK(merit_measure(&bench->merit, v, residuals, NULL));
    figures_read(bench, &bench->merit, &figures);
    return of->value(&figures, residual);
}

/* Central differences with steps h and h/2, without the term h^2. */
static double slope_expected(struct merit_bench *bench, const struct expression_case *of,
                             size_t residual, size_t variable)
{
    const double h = merit_step(bench, variable) / 4;
    double d[2];
    for (int i = 0; i < 2; i++) {
        const double step = h / (1 + i);
        d[i] = (expected_at(bench, of, residual, variable, step) -
                expected_at(bench, of, residual, variable, -step)) /
               (2 * step);
    }
    return (4 * d[1] - d[0]) / 3;
}

static void check_expression(const struct expression_case *of)
{
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    const struct merit_case with = {of->text, zoom, names, ARENA_JOIN(&arena, plain, ",", of->text),
                                    0};
    bool open = merit_bench_open(bench, &with, &arena, &error);
    CHECK(open);
    if (!open) {
        printf("    %s: %s\n", of->text, error.message);
        arena_free(&arena);
        return;
    }
    const struct merit *merit = &bench->merit;
    const size_t first = merit->residual_count - of->residuals;
    double *residuals = ARENA_ARRAY(&arena, merit->residual_count, double);
    double values[MERIT_MOST],
        *jacobian = ARENA_ARRAY(&arena, merit->residual_count * bench->count, double);
    CHECK(merit->residual_count == 2 * PLAIN + of->residuals);
    CHECK(merit_measure(&bench->merit, bench->v, residuals, jacobian));
    memcpy(values, merit->values, merit->residual_count * sizeof values[0]);
    for (size_t i = 0; i < of->residuals; i++) {
        const double value = values[first + i];
        CHECK_NEAR(value, expected_at(bench, of, i, 0, 0), 1e-12 * fmax(1, fabs(value)), of->text);
        for (size_t j = 0; j < bench->count; j++) {
            const double slope = slope_expected(bench, of, i, j);
            const double *row = &jacobian[(first + i) * bench->count];
            const double scale = fmax(fabs(slope), 1e-3 / merit_step(bench, j));
            const double deviation = merit->slots[merit->slot_count - 1].operand->deviation;
            const bool near = fabs(row[j] * deviation - slope) <= 2e-7 * scale;
            CHECK(near);
            if (!near) {
                printf("    %s: %zu by %s is %.12g, differences have %.12g\n", of->text, i,
                       bench->list[j].name, row[j] * deviation, slope);
            }
        }
    }
    arena_free(&arena);
}

/* Numbers that vary in one position, and one that follows another: by hand. */
static void test_words(void)
{
    static const char follows[] = "wavelength d\n"
                                  "position wide tele\n"
                                  "let gap 20 6\n"
                                  "pickup t3 = 0.5 + 2 * t1\n"
                                  "surface 60 4 1.6/50 30\n"
                                  "surface -900 gap air 30\n"
                                  "surface 50 5 1.62/60 30\n"
                                  "surface -40 50 air 30\n";
    const struct parameter gap = {1, PARAMETER_THICKNESS, 0}, first = {0, PARAMETER_THICKNESS, 0};
    const struct variable list[] = {
        {.what = gap, .position = 0, .low = -INFINITY, .high = INFINITY, .name = "gap@wide"},
        {.what = gap, .position = 1, .low = -INFINITY, .high = INFINITY, .name = "gap@tele"},
        {.what = first, .position = LENS_NONE, .low = -INFINITY, .high = INFINITY, .name = "t1"}};
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct lens lens;
    struct variables variables;
    struct goals goals;
    struct merit merit;
    struct error error;
    const struct goals_reader reader = {&db, &lens, &arena, "--goals", 1};
    double v[3], residuals[5], rows[5][3];
    const bool open =
        lens_read("words", text_of(follows), NULL, &arena, &lens, &error) &&
        variables_open(&lens, list, 3, &arena, &variables, &error) &&
        goals_read(&reader, text_of("t2@wide - gap@tele = 1, t3 * t1 = 0, gap / t3 = 0"), &goals,
                   &error);
    CHECK(open);
    const struct merit_question question = {.lens = &lens,
                                            .variables = &variables,
                                            .variable_count = 3,
                                            .operands = goals.list,
                                            .operand_count = goals.count,
                                            .fnumber = NAN,
                                            .rays = 36};
    CHECK(merit_open(&question, &arena, &merit, &error) && merit.residual_count == 5);
    variables_get(&variables, v);
    CHECK(merit_measure(&merit, v, residuals, &rows[0][0]));
    /* t1 = 4, t3 = 8.5 that follows: d(t3 t1) = t3 + 2 t1, d(gap/t3) = 1/t3, -2 gap/t3^2 */
    static const double values[5] = {14, 34, 34, 20 / 8.5, 6 / 8.5};
    static const double slopes[5][3] = {{1, -1, 0},
                                        {0, 0, 16.5},
                                        {0, 0, 16.5},
                                        {1 / 8.5, 0, -40 / 72.25},
                                        {0, 1 / 8.5, -12 / 72.25}};
    for (size_t i = 0; i < 5; i++) {
        CHECK_NEAR(merit.values[i], values[i], 1e-13, merit.slots[i].operand->name);
        for (size_t j = 0; j < 3; j++) {
            CHECK_NEAR(rows[i][j], slopes[i][j], 1e-13, merit.slots[i].operand->name);
        }
    }
    arena_free(&arena);
}

/* A position that is not optimised is not asked for. */
static void test_elsewhere(void)
{
    struct arena arena = {0};
    struct error error;
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    const struct merit_case of = {"elsewhere", zoom, "R1", "efl=70,t2@wide - gap@tele-2 > 1", 0};
    struct merit merit;
    static const size_t wide = 0;
    CHECK(merit_bench_open(bench, &of, &arena, &error));
    struct merit_question question = bench->merit.question;
    question.positions = &wide;
    question.position_count = 1;
    CHECK(merit_open(&question, &arena, &merit, &error));
    CHECK(merit.slot_count == 1);
    arena_free(&arena);
}

/* The number of values of two terms must fit. */
static void test_refused(void)
{
    static const struct {
        const char *goals, *message;
    } all[] = {
        {"edge - air > 0",
         "goal edge - air > 0: air has 4 values, what stands before it 3: name surfaces"},
        {"bfl * magnification > 0", "goal bfl * magnification > 0: magnification: the object is "
                                    "infinitely far away, its magnification 0"},
    };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        const struct merit_case of = {"refused", zoom, "R1", all[i].goals, 0};
        struct arena arena = {0};
        struct error error = {.code = ERROR_NONE};
        struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
        CHECK(!merit_bench_open(bench, &of, &arena, &error));
        CHECK_TEXT(error.message, all[i].message);
        arena_free(&arena);
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_expression(&cases[i]);
    }
    test_words();
    test_elsewhere();
    test_refused();
    return check_report();
}
