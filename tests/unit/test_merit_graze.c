/* tests/unit/test_merit_graze.c - rays near loss: by hand, and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "merit_check.h"

/* What the margin m counts with the limit m0, by hand. */
static double count_of(double m, double m0)
{
    return (m0 - m) * (m0 - m) / (m0 * (m + m0 / 100));
}

/* All rays meet a plane at the field angle; the glass behind it bends them back to that. */
static void test_planes(void)
{
    static const struct {
        const char *goals, *text;
        double angle, surfaces, limit;
    } cases[] = {
        /* both sides of a plate at 60 deg */
        {"poly, grazing < 45",
         "wavelength d\nfield angle 60\naperture epd 2\nfocus table\n"
         "stop - 5 air -\nsurface - 4 1.5/60 -\nsurface - 30 air -\n",
         60, 2, 0.5},
        {"poly, grazing < 59.5:0.1",
         "wavelength d\nfield angle 60\naperture epd 2\nfocus table\n"
         "stop - 5 air -\nsurface - 4 1.5/60 -\nsurface - 30 air -\n",
         60, 2, 0.2575951898768315},
        /* a mirror: its own side */
        {"spot, grazing < 75",
         "wavelength d\nfield angle 80\naperture epd 2\nfocus table\n"
         "stop - 5 air -\nsurface - -30 mirror -\n",
         80, 1, 0.06698729811},
        /* well inside */
        {"poly, grazing < 61",
         "wavelength d\nfield angle 60\naperture epd 2\nfocus table\n"
         "stop - 5 air -\nsurface - 4 1.5/60 -\nsurface - 30 air -\n",
         60, 0, 0.2350403673},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct merit_case of = {.name = cases[i].goals,
                                      .text = cases[i].text,
                                      .variables = "c2",
                                      .goals = cases[i].goals};
        struct arena arena = {0};
        struct merit_bench bench;
        struct error error;
        const bool done = merit_bench_open(&bench, &of, &arena, &error);
        CHECK(done);
        if (done) {
            const size_t last = bench.merit.residual_count - 1;
            double *residuals = ARENA_ARRAY(&arena, last + 1, double);
            const double cosine = cos(cases[i].angle * RADIANS_PER_DEGREE);
            const double deviation = bench.goals.list[1].deviation;
            CHECK(merit_evaluate(&bench.merit, bench.v, residuals, NULL));
            CHECK_NEAR(bench.merit.values[last], cases[i].angle * RADIANS_PER_DEGREE, 1e-12,
                       "largest angle");
            CHECK_RELATIVE(residuals[last] * deviation,
                           cases[i].surfaces * count_of(cosine * cosine, cases[i].limit), 1e-8,
                           cases[i].goals);
        }
        arena_free(&arena);
    }
}

/* What is asked of a bench: the last residual. */
struct graze_bench {
    struct merit_bench bench;
    struct merit merit;
    size_t slot, residual_count;
    double *residuals;
};

static double graze_at(struct graze_bench *graze, size_t variable, double step)
{
    double v[MERIT_MOST];
    memcpy(v, graze->bench.v, sizeof v);
    v[variable] += step;
    if (!merit_measure(&graze->merit, v, graze->residuals, NULL)) {
        return NAN;
    }
    return graze->residuals[graze->slot];
}

/* Central differences with steps h, h/2, h/4, without the terms h^2 and h^4. */
static double difference(struct graze_bench *graze, size_t variable, double h)
{
    double d[3];
    for (int i = 0; i < 3; i++, h /= 2) {
        d[i] = (graze_at(graze, variable, h) - graze_at(graze, variable, -h)) / (2 * h);
    }
    const double first = (4 * d[1] - d[0]) / 3, second = (4 * d[2] - d[1]) / 3;
    return (16 * second - first) / 15;
}

/* `share`: of the usual step, as the limit is crossed somewhere */
static void check_slopes(const struct merit_case *of, bool from_entrance, double share)
{
    struct arena arena = {0};
    struct error error;
    struct graze_bench *graze = ARENA_NEW(&arena, struct graze_bench);
    bool done = merit_bench_open(&graze->bench, of, &arena, &error);
    struct merit_question question = graze->bench.merit.question;
    question.from_entrance = from_entrance;
    done = done && merit_open(&question, &arena, &graze->merit, &error);
    CHECK(done);
    if (!done) {
        printf("    %s: %s\n", of->name, error.message);
        arena_free(&arena);
        return;
    }
    const size_t n = graze->bench.count, m = graze->merit.residual_count;
    double *jacobian = ARENA_ARRAY(&arena, m * n, double);
    graze->slot = m - 1;
    graze->residuals = ARENA_ARRAY(&arena, m, double);
    CHECK(merit_measure(&graze->merit, graze->bench.v, graze->residuals, jacobian));
    const double value = graze->residuals[m - 1];
    CHECK(value > 0);
    for (size_t j = 0; j < n; j++) {
        const double h = share * merit_step(&graze->bench, j), slope = difference(graze, j, h);
        const double mine = jacobian[(m - 1) * n + j];
        const double scale = fmax(fabs(slope), 1e-4 / h * value);
        CHECK(fabs(mine - slope) <= of->tolerance * scale);
        if (!(fabs(mine - slope) <= of->tolerance * scale)) {
            printf("    %s, %s: by %s %.15g, differences %.15g\n", of->name, of->text,
                   graze->bench.list[j].name, mine, slope);
        }
    }
    arena_free(&arena);
}

/* With a limit of a few degrees all rays of any lens are near loss. */
static void test_slopes(void)
{
    for (unsigned long long seed = 1; seed <= 6; seed++) {
        char text[MERIT_TEXT], names[MERIT_TEXT];
        merit_random(seed, seed % 2 == 0, text, names);
        const struct merit_case of = {"by chance", text, names, "poly, grazing < 4", 1e-7};
        check_slopes(&of, false, 0.25);
        check_slopes(&of, true, 0.25);
    }
    /* really near: behind a steep surface, and at mirrors */
    static const struct merit_case near = {
        .name = "near loss",
        .text =
            "wavelength d F\nfield angle 0 3\naperture epd 33.2\nfocus table\n"
            "stop - 1 air -\nsurface - 12 1.5168/64.17 - c=0.001\nsurface - 60 air - c=-0.0385\n",
        .variables = "c2 c3 t1 t2 k3 n2 V2 t3",
        .goals = "poly, grazing < 75",
        .tolerance = 1e-6};
    check_slopes(&near, false, 0.002);
    check_slopes(&near, true, 0.002);
    static const struct merit_case mirrors = {
        .name = "mirrors",
        .text = "wavelength d\nfield angle 0 1\naperture epd 40\nfocus paraxial\n"
                "stop - 60 air -\nsurface -400 -90 mirror -\nsurface -300 120 mirror -\n",
        .variables = "c2 c3 t1 t2 k2 k3 tilt_x3 decenter_y3",
        .goals = "spot, grazing < 3",
        .tolerance = 1e-7};
    check_slopes(&mirrors, false, 0.25);
}

static void test_refusals(void)
{
    static const char *const goals[] = {"poly, grazing = 80", "poly, grazing > 80",
                                        "poly, grazing < 91", "poly, grazing < 0",
                                        "poly, grazing < 80, grazing < 70"};
    for (size_t i = 0; i < sizeof goals / sizeof goals[0]; i++) {
        const struct merit_case of = {.name = goals[i],
                                      .text = "wavelength d\nfield angle 0\naperture epd 2\n"
                                              "focus table\nsurface 50 4 1.5/60 - stop\n"
                                              "surface - 90 air -\n",
                                      .variables = "c1",
                                      .goals = goals[i]};
        struct arena arena = {0};
        struct merit_bench bench;
        struct error error;
        CHECK(!merit_bench_open(&bench, &of, &arena, &error));
        arena_free(&arena);
    }
}

int main(void)
{
    test_planes();
    test_slopes();
    test_refusals();
    return check_report();
}
