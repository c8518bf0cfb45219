/* tests/unit/test_merit_asbuilt.c - spots of lenses as they are made. */
/* SPDX-License-Identifier: MIT */
#include "any_errors.h"
#include "check.h"
#include "design/merit/merit.h"
#include "design/merit/merit_rays.h"
#include "design/tolerance/perturbed.h"
#include "double_gauss.h"
#include "lens_of.h"

#include <math.h>
#include <string.h>

#define HEAD                                                                                       \
    "wavelength d F C\n"                                                                           \
    "object inf\n"                                                                                 \
    "aperture stop\n"                                                                              \
    "field angle 0 10 14\n"
static const char in_table[] = HEAD "focus table\n" DOUBLE_GAUSS("34.2");
static const char paraxial[] = HEAD "focus paraxial\n" DOUBLE_GAUSS("34.2");

static struct arena arena;

enum { SIMPLE = sizeof any_errors / sizeof any_errors[0], ERRORS = SIMPLE + 1, MOST = 4000 };

/* Errors of numbers of the lens, and a form of a surface. */
static struct perturbation list[ERRORS];

/* Uniform errors: the deviation is the half range over the root of 3. */
static void set_list(void)
{
    memcpy(list, any_errors, sizeof any_errors);
    list[SIMPLE] = (struct perturbation){.kind = TOLERANCE_IRREGULARITY,
                                         .first = 4,
                                         .axis = PERTURBATION_Y,
                                         .what.kind = PARAMETER_KINDS,
                                         .amount = 0.5,
                                         .name = "irregularity"};
    for (size_t i = 0; i < ERRORS; i++) {
        list[i].spread = spread_of(DISTRIBUTION_UNIFORM, DISTRIBUTION_SIGMAS);
    }
}

/* That form, as rays are moved by it. */
static const struct irregularity form = {.surface = 4, .form = IRREGULARITY_SIN, .radius = 18};
static double height;

struct bench {
    struct perturbation *list; /* null: that of all kinds */
    size_t count;
    bool is_formed;
    struct lens lens;
    struct variables variables;
    struct perturbations errors;
    struct operand operand;
    struct merit merit;
    double numbers[4];
};

static bool open_bench(struct bench *bench, const char *text, enum operand_kind kind,
                       const struct variable *vary, size_t count)
{
    struct error error = {.code = ERROR_NONE};
    bench->lens = lens_of(text, &arena);
    bench->errors = (struct perturbations){.list = bench->list != NULL ? bench->list : list,
                                           .count = bench->list != NULL ? bench->count : ERRORS};
    bench->operand = operand_of(kind, "goal");
    CHECK(variables_open(&bench->lens, vary, count, &arena, &bench->variables, &error));
    const struct merit_question question = {.lens = &bench->lens,
                                            .variables = &bench->variables,
                                            .variable_count = count,
                                            .errors = &bench->errors,
                                            .irregularities = bench->is_formed ? &form : NULL,
                                            .irregularity_count = bench->is_formed,
                                            .irregularity_amounts =
                                                bench->is_formed ? &height : NULL,
                                            .operands = &bench->operand,
                                            .operand_count = 1,
                                            .fnumber = NAN,
                                            .is_skew = true,
                                            .pattern = PATTERN_GAUSS,
                                            .rays = 12};
    variables_get(&bench->variables, bench->numbers);
    const bool done = merit_open(&question, &arena, &bench->merit, &error);
    CHECK(done);
    if (!done) {
        printf("%s\n", error.message);
    }
    return done;
}

/* Residuals of lenses that are made with an error of this size, as numbers of a lens. */
struct made {
    struct bench bench;
    struct perturbed perturbed;
};

static void residuals_of(struct made *made, size_t error, double size, double *residuals)
{
    double errors[ERRORS] = {0};
    errors[error] = size;
    perturbed_put(&made->perturbed, errors);
    CHECK(merit_measure(&made->bench.merit, made->bench.numbers, residuals, NULL));
}

/* Central differences without the term of the square of the step. */
static void derive(struct made *made, size_t error, double step, double *column)
{
    static double at[4][MOST];
    residuals_of(made, error, step, at[0]);
    residuals_of(made, error, -step, at[1]);
    residuals_of(made, error, 2 * step, at[2]);
    residuals_of(made, error, -2 * step, at[3]);
    for (size_t i = 0; i < made->bench.merit.residual_count; i++) {
        column[i] = (8 * (at[0][i] - at[1][i]) - (at[2][i] - at[3][i])) / (12 * step);
    }
}

static double dot(const double *a, const double *b, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* What errors add, less what the error of the focus takes of it: that of the place `plane`. */
static void compare(struct made *made, size_t plane, size_t count, const double *got)
{
    static double column[MOST], focus[MOST];
    const size_t rays = made->bench.merit.residual_count;
    derive(made, plane, 0.1, focus);
    for (size_t j = 0; j < count; j++) {
        derive(made, j, 0.1, column);
        const double share = dot(column, focus, rays) / dot(focus, focus, rays);
        for (size_t i = 0; i < rays; i++) {
            column[i] -= share * focus[i];
        }
        const double expected = sqrt(dot(column, column, rays) / 3);
        CHECK_NEAR(got[j], expected, 1e-6 * expected + 1e-9, made->bench.errors.list[j].name);
        CHECK(j == plane || got[j] > 1e-6);
    }
}

/* The nominal spots, and what each error adds, beside lenses that are perturbed by hand. */
static void check_values(void)
{
    static struct bench bench;
    static struct made made;
    static double got[MOST], nominal[MOST];
    struct error error = {.code = ERROR_NONE};
    if (!open_bench(&bench, in_table, OPERAND_ASBUILT, NULL, 0) ||
        !open_bench(&made.bench, in_table, OPERAND_POLY, NULL, 0)) {
        return;
    }
    const size_t rays = made.bench.merit.residual_count;
    const struct perturbed_question asked = {.lens = &made.bench.lens,
                                             .list = list,
                                             .count = ERRORS,
                                             .lenses = made.bench.variables.lenses};
    CHECK(bench.merit.residual_count == rays + ERRORS && rays < MOST);
    CHECK(perturbed_open(&asked, &arena, &made.perturbed, &error));
    CHECK(merit_measure(&bench.merit, bench.numbers, got, NULL));
    residuals_of(&made, 0, 0, nominal);
    CHECK(memcmp(got, nominal, rays * sizeof got[0]) == 0);
    compare(&made, SIMPLE - 1, SIMPLE, got + rays);
    CHECK(got[rays + SIMPLE] > 1e-4);
}

/* A lens with a mirror behind glass, which light passes twice. */
static const char mirror[] = "wavelength d F C\n"
                             "object inf\n"
                             "aperture epd 20\n"
                             "field angle 0 1\n"
                             "focus table\n"
                             "surface -200 3 1.6/40 25 stop\n"
                             "surface -300 -3 mirror 25\n"
                             "surface -200 -110 air 25\n";
/* An object in oil, whose index says how long the ways of rays begin. */
static const char oil[] = "wavelength d F C\n"
                          "object 6\n"
                          "medium 1.52\n"
                          "aperture stop\n"
                          "field height 0 0.4\n"
                          "focus table\n"
                          "surface -40 4 1.7/50 -\n"
                          "surface -9 1 air -\n"
                          "stop - 1 air 5\n"
                          "surface 60 4 1.6/60 -\n"
                          "surface -14 60 air -\n";

/* Errors of the medium behind a surface, or of the object's, which has no Abbe number. */
static void check_medium(const char *text, size_t surface)
{
    struct perturbation media[] = {
        {.kind = TOLERANCE_INDEX,
         .what = {surface, PARAMETER_INDEX, 0},
         .amount = 1e-3,
         .name = "n1",
         .spread = {.distribution = DISTRIBUTION_UNIFORM, .sigmas = DISTRIBUTION_SIGMAS}},
        {.kind = surface == LENS_NONE ? TOLERANCE_INDEX : TOLERANCE_ABBE,
         .what = {surface, surface == LENS_NONE ? PARAMETER_INDEX : PARAMETER_ABBE, 0},
         .amount = surface == LENS_NONE ? 2e-3 : 0.4,
         .name = "V1",
         .spread = {.distribution = DISTRIBUTION_UNIFORM, .sigmas = DISTRIBUTION_SIGMAS}},
        {.kind = TOLERANCE_FOCUS, .what.kind = PARAMETER_KINDS, .amount = 0.1, .name = "focus"},
    };
    enum { MEDIA = 2, PLANE = 2, ALL = 3 };
    static struct bench bench;
    static struct made made;
    static double got[MOST];
    struct error error = {.code = ERROR_NONE};
    bench = (struct bench){.list = media, .count = MEDIA};
    made = (struct made){.bench = {.list = media, .count = ALL}};
    if (!open_bench(&bench, text, OPERAND_ASBUILT, NULL, 0) ||
        !open_bench(&made.bench, text, OPERAND_POLY, NULL, 0)) {
        return;
    }
    const size_t rays = made.bench.merit.residual_count;
    const struct perturbed_question asked = {.lens = &made.bench.lens,
                                             .list = media,
                                             .count = ALL,
                                             .lenses = made.bench.variables.lenses};
    CHECK(perturbed_open(&asked, &arena, &made.perturbed, &error));
    CHECK(merit_measure(&bench.merit, bench.numbers, got, NULL));
    compare(&made, PLANE, MEDIA, got + rays);
}

/* An astigmatism at a random azimuth: half of the mean square of its height is in each direction.
   The image plane does nothing for it. */
static void check_form(void)
{
    static struct bench bench, formed = {.is_formed = true};
    static double got[MOST], without[MOST], with[MOST];
    struct error error = {.code = ERROR_NONE};
    if (!open_bench(&bench, in_table, OPERAND_ASBUILT, NULL, 0) ||
        !open_bench(&formed, in_table, OPERAND_POLY, NULL, 0)) {
        return;
    }
    const size_t rays = formed.merit.residual_count;
    CHECK(merit_measure(&bench.merit, bench.numbers, got, NULL));
    CHECK(merit_measure(&formed.merit, formed.numbers, without, NULL));
    CHECK(merit_beams_deform(formed.merit.slots[0].beams, &error));
    height = 0.5 * TOLERANCE_WAVE_MM;
    CHECK(merit_measure(&formed.merit, formed.numbers, with, NULL));
    for (size_t i = 0; i < rays; i++) {
        with[i] -= without[i];
    }
    const double expected = sqrt(dot(with, with, rays) / 3 / 2);
    CHECK_NEAR(got[rays + SIMPLE], expected, 1e-9 * expected, "irregularity");
}

/* Where an image plane follows the paraxial image it is focused anew all the same. */
static void check_image(void)
{
    static struct bench table, follows;
    static double here[MOST], there[MOST];
    if (!open_bench(&follows, paraxial, OPERAND_ASBUILT, NULL, 0)) {
        return;
    }
    const double at = follows.merit.places[0].setup.first.bfl;
    char text[2000];
    snprintf(text, sizeof text, "%s", in_table);
    char *old = strstr(text, "72.228");
    CHECK(old != NULL);
    char end[200];
    snprintf(end, sizeof end, "%.15g%s", at, old + strlen("72.228"));
    strcpy(old, end);
    if (!open_bench(&table, text, OPERAND_ASBUILT, NULL, 0)) {
        return;
    }
    CHECK(merit_measure(&follows.merit, follows.numbers, here, NULL));
    CHECK(merit_measure(&table.merit, table.numbers, there, NULL));
    for (size_t i = 0; i < table.merit.residual_count; i++) {
        CHECK_NEAR(here[i], there[i], 1e-9, "paraxial");
    }
}

/* Derivatives by variables, beside extrapolated differences of values. */
static void check_slopes(void)
{
    static const struct variable vary[] = {
        {.what = {0, PARAMETER_RADIUS, 0},
         .position = LENS_NONE,
         .name = "R1",
         .low = -INFINITY,
         .high = INFINITY},
        {.what = {6, PARAMETER_THICKNESS, 0},
         .position = LENS_NONE,
         .name = "t7",
         .low = -INFINITY,
         .high = INFINITY},
        {.what = {2, PARAMETER_INDEX, 0},
         .position = LENS_NONE,
         .name = "n3",
         .low = -INFINITY,
         .high = INFINITY},
    };
    enum { VARIABLES = sizeof vary / sizeof vary[0] };
    static const double steps[VARIABLES] = {2e-5, 0.05, 1e-3};
    static struct bench bench;
    static double at[4][MOST], jacobian[MOST * VARIABLES], again[MOST];
    if (!open_bench(&bench, paraxial, OPERAND_ASBUILT, vary, VARIABLES)) {
        return;
    }
    const size_t count = bench.merit.residual_count;
    CHECK(merit_measure(&bench.merit, bench.numbers, again, jacobian));
    for (size_t k = 0; k < VARIABLES; k++) {
        static const double sides[4] = {1, -1, 2, -2};
        for (size_t s = 0; s < 4; s++) {
            double numbers[VARIABLES];
            memcpy(numbers, bench.numbers, sizeof numbers);
            numbers[k] += sides[s] * steps[k];
            CHECK(merit_measure(&bench.merit, numbers, at[s], NULL));
        }
        double most = 0, off = 0;
        for (size_t i = 0; i < count; i++) {
            const double slope =
                (8 * (at[0][i] - at[1][i]) - (at[2][i] - at[3][i])) / (12 * steps[k]);
            most = fmax(most, fabs(slope));
            off = fmax(off, fabs(slope - jacobian[i * VARIABLES + k]));
        }
        CHECK_NEAR(off / most, 0, 1e-5, vary[k].name);
    }
    CHECK(merit_measure(&bench.merit, bench.numbers, at[0], NULL));
    for (size_t i = 0; i < count; i++) {
        CHECK_NEAR(at[0][i], again[i], 1e-12, "the lens is left as it was");
    }
}

int main(void)
{
    arena = (struct arena){0};
    set_list();
    check_values();
    check_medium(mirror, 0);
    check_medium(oil, LENS_NONE);
    check_form();
    check_image();
    check_slopes();
    arena_free(&arena);
    return check_report();
}
