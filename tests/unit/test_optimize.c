/* tests/unit/test_optimize.c - lenses made better whose best is known by hand. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize.h"
#include "merit_check.h"

/* A plano-convex lens of index 1.5: efl = 2 R whatever its thickness. */
#define PLANO(radius, pupil)                                                                       \
    "wavelength d\naperture epd " pupil "\nfield angle 0\nfocus table\n"                           \
    "surface " radius " 20 1.5 - stop\nsurface - 150 air -\n"

static bool optimise(const struct merit_case *of, struct arena *arena, struct merit_bench *bench,
                     struct optimize_answer *answer, struct error *error)
{
    if (!merit_bench_open(bench, of, arena, error)) {
        return false;
    }
    const struct optimize_task task = {.merit = &bench->merit};
    return optimize_run(&task, arena, answer, error);
}

static void test_plano(void)
{
    static const struct merit_case efl = {
        .name = "efl", .text = PLANO("80", "10"), .variables = "R1 t1", .goals = "efl = 100"};
    static const struct merit_case exact = {.name = "exact",
                                            .text = PLANO("80", "10"),
                                            .variables = "c1",
                                            .goals = "efl == 100, bfl = 70"};
    struct arena arena = {0};
    struct merit_bench bench;
    struct optimize_answer answer;
    struct error error;
    CHECK(optimise(&efl, &arena, &bench, &answer, &error));
    CHECK_NEAR(answer.before.merit, 60.0 * 60, 1e-9, "(160 - 100)^2");
    CHECK_RELATIVE(answer.after.numbers[0], 1.0 / 50, 1e-6, "1/R");
    CHECK(!answer.is_idle[0] && answer.is_idle[1]);
    CHECK_NEAR(answer.after.numbers[1], 20, 0, "the thickness stays");
    CHECK(answer.begun == NULL && answer.history_count >= 2);
    /* bfl = efl - t/n: 100 - 20/1.5, 16.7 off */
    CHECK(optimise(&exact, &arena, &bench, &answer, &error));
    CHECK_RELATIVE(answer.after.numbers[0], 1.0 / 50, 1e-12, "c");
    CHECK(answer.summary.excess <= 1e-10);
    CHECK_RELATIVE(answer.after.merit, (30 - 20 / 1.5) * (30 - 20 / 1.5), 1e-9, "what bfl is off");
    arena_free(&arena);
}

/* Rays at 55 mm miss a sphere of 50 mm: with less of the pupil it grows until none does. */
static void test_lost(void)
{
    static const struct merit_case lost = {.name = "lost",
                                           .text = PLANO("50", "110"),
                                           .variables = "R1 t2",
                                           .goals = "poly, efl = 240"};
    static const struct merit_case hopeless = {
        .name = "hopeless", .text = PLANO("50", "110"), .variables = "t2", .goals = "poly"};
    struct arena arena = {0};
    struct merit_bench bench;
    struct optimize_answer answer;
    struct error error = {0};
    CHECK(optimise(&lost, &arena, &bench, &answer, &error));
    CHECK(answer.begun != NULL && strstr(answer.begun, "aperture") != NULL);
    CHECK(isnan(answer.before.merit) && isfinite(answer.after.merit));
    CHECK(1 / answer.after.numbers[0] > 55);
    CHECK(!optimise(&hopeless, &arena, &bench, &answer, &error));
    CHECK(strstr(error.message, "cannot be judged") != NULL);
    arena_free(&arena);
}

/* A lens that loses rays becomes one that does not. */
static void check_begin(const struct merit_case *of)
{
    struct arena arena = {0};
    struct error error = {0};
    struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
    double residuals[1000];
    const char *words;
    CHECK(merit_bench_open(bench, of, &arena, &error) && bench->merit.residual_count < 1000);
    const struct optimize_task task = {.merit = &bench->merit};
    CHECK(!merit_evaluate(&bench->merit, bench->v, residuals, NULL));
    CHECK(optimize_begin(&task, bench->v, &arena, &words, &error));
    CHECK(words != NULL && strstr(words, "aperture and field") != NULL);
    CHECK(merit_evaluate(&bench->merit, bench->v, residuals, NULL));
    arena_free(&arena);
}

/*
 * A phone lens of spheres whose coefficients vary, and which rays of 30 deg do not pass: with all
 * of them free from the beginning what suits narrow fields never lets wider ones through. And a
 * triplet at f/1.1, where no step of field or aperture leads on but with vignetting.
 */
static void test_begin(void)
{
    static const struct merit_case phone = {
        .name = "phone",
        .text = "wavelength d F C\nfield angle 0 10 18 24 30\naperture epd 1.0714\nfocus table\n"
                "stop - 0.05 air -\nsurface 1.5 0.6 1.535/56 -\nsurface 6 0.4 air -\n"
                "surface -2 0.35 1.63/23.9 -\nsurface -6 0.2 air -\nsurface 2 0.6 1.535/56 -\n"
                "surface 1 0.6 air -\nsurface - 0.4 air -\n",
        .variables = "R2 R3 R4 R5 R6 R7 t2 t3 t4 t5 t6 t7 k2 k3 k4 k5 k6 k7 A4_2 A4_3 A4_4 A4_5 "
                     "A4_6 A4_7 A6_2 A6_3 A6_4 A6_5 A6_6 A6_7",
        .goals = "poly, efl = 3 : 0.01, center > 0.3 : 0.01, edge > 0.2 : 0.01, air > 0.03 : 0.01, "
                 "length < 4.2 : 0.01, grazing < 85"};
    static const struct merit_case triplet = {
        .name = "triplet",
        .text = "wavelength d F C\nfield angle 0 10 16\naperture epd 44\nfocus table\n"
                "surface - 6 1.6204/60.3 - c=-0.01017\nsurface - 5 air - c=0.0096\n"
                "surface - 2 1.62/36.4 - c=-0.05759\nsurface - 2 air - c=0.0139\n"
                "stop - 4 air -\nsurface - 5 1.6204/60.3 - c=0.01586\n"
                "surface - 40 air - c=-0.05279\n",
        .variables = "c1 c2 c3 c4 c6 c7 t7",
        .goals = "poly, efl = 50, grazing < 85"};
    check_begin(&phone);
    check_begin(&triplet);
}

/* Without 0.4 of the radius at 8 deg there, and 0.1 at 4 deg, the spots are those of narrower
   beams; that of the axis stays. */
static void test_vignetting(void)
{
    static const char text[] = "wavelength d\nfield angle 0 4 8\naperture epd %.17g\nfocus table\n"
                               "surface 50 6 1.6 -\nsurface -80 3 air -\nstop - 70 air -\n";
    static const struct {
        const char *goal;
        double open;
    } all[] = {{"spot@0deg", 1}, {"spot@4deg", 0.9}, {"spot@8deg", 0.6}};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        double sums[2] = {0, 0};
        for (int way = 0; way < 2; way++) {
            char lens[400];
            const struct merit_case of = {"beam", lens, "R1", all[i].goal, 0};
            struct arena arena = {0};
            struct error error;
            struct merit merit;
            struct merit_bench *bench = ARENA_NEW(&arena, struct merit_bench);
            double residuals[200];
            snprintf(lens, sizeof lens, text, way == 0 ? 20 : 20 * all[i].open);
            CHECK(merit_bench_open(bench, &of, &arena, &error));
            struct merit_question question = bench->merit.question;
            question.vignetting = way == 0 ? 0.4 : 0;
            CHECK(merit_open(&question, &arena, &merit, &error) && merit.residual_count < 200);
            CHECK(merit_evaluate(&merit, bench->v, residuals, NULL));
            for (size_t k = 0; k < merit.residual_count; k++) {
                sums[way] += residuals[k] * residuals[k];
            }
            arena_free(&arena);
        }
        CHECK_RELATIVE(sums[0], sums[1], 1e-12, all[i].goal);
    }
}

/* Told to stop at once it keeps what there is. */
static bool stops(void *context)
{
    ++*(int *)context;
    return false;
}

static void test_stopped(void)
{
    static const struct merit_case efl = {.name = "efl",
                                          .text = PLANO("80", "10"),
                                          .variables = "R1",
                                          .goals = "efl = 100, bfl = 70"};
    struct arena arena = {0};
    struct merit_bench bench;
    struct optimize_answer answer;
    struct error error;
    int asked = 0;
    CHECK(merit_bench_open(&bench, &efl, &arena, &error));
    const struct optimize_task task = {.merit = &bench.merit, .goes_on = stops, .context = &asked};
    CHECK(optimize_run(&task, &arena, &answer, &error));
    CHECK(asked == 1 && answer.summary.status == SOLVER_STOPPED);
    CHECK(answer.after.merit <= answer.before.merit);
    arena_free(&arena);
}

/* A triplet of f/1.4 whose steps lose rays all over the place: along that wall it is no minimum. */
static void test_wall(void)
{
    static const struct merit_case fast = {
        .name = "fast",
        .text = "wavelength d F C\nfield angle 0 10 16\naperture epd 35\nfocus table\n"
                "surface - 6 1.6204/60.3 - c=-0.01017\nsurface - 5 air - c=0.0096\n"
                "surface - 2 1.62/36.4 - c=-0.05759\nsurface - 2 air - c=0.0139\n"
                "stop - 4 air -\nsurface - 5 1.6204/60.3 - c=0.01586\n"
                "surface - 40 air - c=-0.05279\n",
        .variables = "c1 c2 c3 c4 c6 c7 t7",
        .goals = "poly, efl = 50"};
    static const double lengths[] = {1e-2, 1e-3, 1e-4, 1e-5};
    struct arena arena = {0};
    struct merit_bench bench, fresh;
    struct optimize_answer answer;
    struct error error;
    CHECK(optimise(&fast, &arena, &bench, &answer, &error));
    CHECK(answer.after.merit < 2); /* along the wall 15.9 */
    /* where it says that it has converged no step of a variable gains */
    const bool is_minimum = answer.summary.status == SOLVER_CONVERGED && !answer.limit.is_known;
    CHECK(merit_bench_open(&fresh, &fast, &arena, &error));
    double *residuals = ARENA_ARRAY(&arena, fresh.merit.residual_count, double);
    for (size_t k = 0; k < 8 * fresh.count && is_minimum; k++) {
        double at[MERIT_MOST], sum = 0;
        memcpy(at, answer.after.numbers, fresh.count * sizeof(double));
        at[k / 8] += (k % 2 == 0 ? 1 : -1) * lengths[k % 8 / 2] * fresh.variables.scale[k / 8];
        if (!merit_evaluate(&fresh.merit, at, residuals, NULL)) {
            continue;
        }
        for (size_t i = 0; i < fresh.merit.residual_count; i++) {
            sum += residuals[i] * residuals[i];
        }
        CHECK(sum > answer.after.merit * (1 - 1e-5));
    }
    arena_free(&arena);
}

int main(void)
{
    test_wall();
    test_plano();
    test_lost();
    test_begin();
    test_vignetting();
    test_stopped();
    return check_report();
}
