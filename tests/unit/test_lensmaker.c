/* tests/unit/test_lensmaker.c - the lens-maker's formula and its inverses. */
/* SPDX-License-Identifier: MIT */
#include "optics/lensmaker.h"

#include <float.h>
#include <stddef.h>
#include <stdlib.h>

#include "check.h"

static struct error error;

static struct lensmaker solve(struct lensmaker lens, bool second, int *count)
{
    struct lensmaker_choice choice = {.second = second};
    CHECK(lensmaker_solve(&lens, &choice, &error));
    *count = choice.count;
    return lens;
}

static struct lensmaker one(struct lensmaker lens)
{
    int count;
    return solve(lens, false, &count);
}

static struct lensmaker_facts facts_of(struct lensmaker lens)
{
    struct lensmaker_facts facts;
    lensmaker_facts(&lens, &facts);
    return facts;
}

/* power, efl, bfl, ffl, H', H as the truth table has them */
static void six(const double *inputs, double *out)
{
    struct lensmaker_facts f = facts_of((struct lensmaker){
        inputs[4], inputs[3], inputs[5], inputs[0], inputs[1], inputs[2], NAN, NAN});
    const double all[] = {f.power, f.efl, f.bfl, f.ffl, f.H_rear, f.H};
    memcpy(out, all, sizeof all);
}

/* Within 4 x 2^-53 x (sensitivity + |value|), the inputs being decimals rounded to doubles. */
static void test_truth(void)
{
    static const char names[][6] = {"power", "efl", "bfl", "ffl", "H'", "H"};
    char line[1024];
    int rows = 0;
    FILE *file = fopen("tests/truth/thick_lens.tsv", "r");
    CHECK(file != NULL);
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        double c[12], sensitivity[6] = {0}, actual[6], moved[6];
        char *at = line, *end = line;
        int count = 0;
        for (; count < 12; count++, at = end) {
            c[count] = strtod(at, &end);
            if (end == at) {
                break;
            }
        }
        if (count < 12) {
            continue;
        }
        rows++;
        six(c, actual);
        for (int k = 0; k < 6; k++) {
            double kept = c[k];
            c[k] *= 1 + 1e-7;
            six(c, moved);
            c[k] = kept;
            for (int i = 0; i < 6; i++) {
                sensitivity[i] += fabs(moved[i] - actual[i]) / 1e-7;
            }
        }
        for (int i = 0; i < 6; i++) {
            char what[80];
            snprintf(what, sizeof what, "thick_lens.tsv row %d: %s", rows, names[i]);
            check_source("thick-lens", i == 0 ? "1/mm" : "mm");
            CHECK_NEAR(actual[i], c[6 + i], 4 * DBL_EPSILON / 2 * (sensitivity[i] + fabs(c[6 + i])),
                       what);
        }
        check_source(NULL, "");
    }
    CHECK(rows == 40);
    if (file != NULL) {
        fclose(file);
    }
}

/* Lenses one can do in the head. */
static void test_by_hand(void)
{
    struct lensmaker lens = one((struct lensmaker){1, 1.5, 1, 50, -50, NAN, NAN, NAN});
    CHECK_RELATIVE(lens.f, 50.0, 4 * DBL_EPSILON, "equiconvex, n = 1.5: f = R");
    CHECK(lens.q == 0 && lens.d == 0);
    lens = one((struct lensmaker){1, 1.5, 1, 50, INFINITY, NAN, NAN, NAN});
    CHECK_RELATIVE(lens.f, 100.0, 4 * DBL_EPSILON, "plano-convex, n = 1.5: f = 2 R");
    CHECK(lens.q == 1);
    lens = one((struct lensmaker){1, 1.5, 1, INFINITY, NAN, NAN, 100, -1});
    CHECK_RELATIVE(lens.R2, -50.0, 4 * DBL_EPSILON, "a plane and shape factor -1 say the same");
    lens = one((struct lensmaker){1, 1.5, 1, NAN, 40, NAN, NAN, -5});
    CHECK_RELATIVE(lens.R1, 60.0, 4 * DBL_EPSILON, "-5 = (40 + 60)/(40 - 60)");
    lens = one((struct lensmaker){1, 1.5, 1, INFINITY, 50, 10, NAN, NAN});
    struct lensmaker_facts f = facts_of(lens);
    CHECK_RELATIVE(lens.f, -100.0, 4 * DBL_EPSILON, "plano-concave");
    CHECK(lens.q == -1 && f.H_rear == 0);
    CHECK_RELATIVE(f.H, 10 / 1.5, 4 * DBL_EPSILON, "the other plane d/n inside");
    /* under water, n = 4/3: power (3/2 - 4/3) 2/50 = 1/150, focus at 4/3 of that */
    f = facts_of((struct lensmaker){4. / 3, 1.5, 4. / 3, 50, -50, 0, NAN, NAN});
    CHECK_RELATIVE(f.efl, 150.0, 16 * DBL_EPSILON, "under water");
    CHECK_RELATIVE(f.rear_focal, 200.0, 16 * DBL_EPSILON, "under water");
    CHECK_RELATIVE(f.front_focal, -200.0, 16 * DBL_EPSILON, "under water");
    CHECK(f.N == 0 && f.N_rear == 0);
    /* water on one side: by the product of three matrices */
    f = facts_of((struct lensmaker){1.333, 1.5, 1, 50, -40, 10, NAN, NAN});
    CHECK_RELATIVE(f.front_focal, -85.659205312198779, 16 * DBL_EPSILON, "before the lens");
    CHECK_RELATIVE(f.rear_focal, 64.26046910142444, 16 * DBL_EPSILON, "before the lens");
    f = facts_of((struct lensmaker){1, 1.7, 1.333, -30, 70, 4, NAN, NAN});
    CHECK_RELATIVE(f.front_focal, 34.645192470056655, 16 * DBL_EPSILON, "behind the lens");
    CHECK_RELATIVE(f.rear_focal, -46.182041562585521, 16 * DBL_EPSILON, "behind the lens");
    /* one surface only: nodal points at the centre of curvature */
    f = facts_of((struct lensmaker){1, 1.5, 1.5, 20, 70, 5, NAN, NAN});
    CHECK_RELATIVE(f.N, 20.0, 4 * DBL_EPSILON, "nodal point at the centre");
    CHECK_RELATIVE(f.N_rear, 15.0, 4 * DBL_EPSILON, "nodal point at the centre");
    /* plate: no power, no principal planes */
    f = facts_of((struct lensmaker){1, 1.5, 1, INFINITY, INFINITY, 5, NAN, NAN});
    CHECK(f.power == 0 && isnan(f.H) && isinf(f.efl));
}

/* Ball: f = n D/(4 (n - 1)), bfl = f - D/2. */
static void test_ball(void)
{
    struct lensmaker ball = {1, 1.5, 1, NAN, NAN, 10, NAN, NAN};
    struct lensmaker_choice choice = {0};
    CHECK(lensmaker_solve_ball(&ball, &choice, &error));
    CHECK_RELATIVE(ball.f, 7.5, 4 * DBL_EPSILON, "ball, n = 1.5");
    CHECK_RELATIVE(facts_of(ball).bfl, 2.5, 4 * DBL_EPSILON, "ball, n = 1.5");
    CHECK_RELATIVE(facts_of(ball).H, 5.0, 4 * DBL_EPSILON, "principal planes in the centre");
    ball = (struct lensmaker){1, 1.5, 1, NAN, NAN, NAN, 7.5, NAN};
    CHECK(lensmaker_solve_ball(&ball, &choice, &error));
    CHECK_RELATIVE(ball.d, 10.0, 4 * DBL_EPSILON, "diameter");
    ball = (struct lensmaker){1, NAN, 1, NAN, NAN, 10, 7.5, NAN};
    CHECK(lensmaker_solve_ball(&ball, &choice, &error));
    CHECK_RELATIVE(ball.n, 1.5, 16 * DBL_EPSILON, "index");
    ball = (struct lensmaker){1, 2, 1, NAN, NAN, 10, NAN, NAN};
    CHECK(lensmaker_solve_ball(&ball, &choice, &error));
    CHECK(ball.f == 5 && facts_of(ball).bfl == 0); /* n = 2 focuses on its rear */
    ball = (struct lensmaker){1, 1.5, 1, NAN, NAN, NAN, -7.5, NAN};
    CHECK(!lensmaker_solve_ball(&ball, &choice, &error));
    ball = (struct lensmaker){1, 1.5, 1, 5, NAN, NAN, 7.5, NAN};
    CHECK(!lensmaker_solve_ball(&ball, &choice, &error));
}

/* R1 = 60, R2 = 40, n = 1.5: afocal at d = n (R1 - R2)/(n - 1) = 60; P = (d - 60)/14400 near it,
   from P1 P2/n = -1/14400. */
static void test_afocal(void)
{
    struct lensmaker lens = {1, 1.5, 1, 60, 40, NAN, INFINITY, NAN};
    lens = one(lens);
    CHECK(lens.d == 60);
    const struct lensmaker_facts none = facts_of(lens);
    CHECK(none.power == 0 && isinf(none.bfl));
    CHECK(none.front_focal == -INFINITY && none.rear_focal == INFINITY && isinf(none.ffl));
    for (int k = 1; k < 46; k++) {
        lens.d = 60 + ldexp(1, -k);
        struct lensmaker_facts f = facts_of(lens);
        CHECK_RELATIVE(f.power, ldexp(1, -k) / 14400, 4 * DBL_EPSILON, "near afocal: power");
        CHECK_RELATIVE(f.efl, ldexp(14400, k), 4 * DBL_EPSILON, "near afocal: efl");
    }
    /* R2 of the afocal lens, by the radius and by the shape factor -(40 + 60)/20 = -5 */
    lens = one((struct lensmaker){1, 1.5, 1, 60, NAN, 60, INFINITY, NAN});
    CHECK_RELATIVE(lens.R2, 40.0, 4 * DBL_EPSILON, "R2 of an afocal lens");
    CHECK_RELATIVE(lens.q, -5.0, 8 * DBL_EPSILON, "its shape");
    int count;
    lens = solve((struct lensmaker){1, 1.5, 1, NAN, NAN, 60, INFINITY, -5}, true, &count);
    CHECK(count == 2);
    CHECK_RELATIVE(lens.R1, 60.0, 8 * DBL_EPSILON, "afocal from the shape");
    CHECK_RELATIVE(lens.R2, 40.0, 8 * DBL_EPSILON, "afocal from the shape");
}

static double random_in(unsigned *state, double low, double high)
{
    *state = *state * 1664525u + 1013904223u;
    return low + (high - low) * (*state / 4294967296.0);
}

/* Each unknown is found again: by one of the solutions, and both make the same power. */
static void test_put_back(void)
{
    unsigned state = 11;
    int twice = 0;
    for (int i = 0; i < 2000; i++) {
        struct lensmaker lens = {random_in(&state, 1, 1.4),
                                 random_in(&state, 1.45, 2),
                                 random_in(&state, 1, 1.4),
                                 random_in(&state, -100, 100),
                                 random_in(&state, -100, 100),
                                 random_in(&state, 1, 20),
                                 NAN,
                                 NAN};
        if (fabs(lens.R1) < 5 || fabs(lens.R2) < 5) {
            continue;
        }
        lens = one(lens);
        double condition = facts_of(lens).condition;
        if (condition > 50 || fabs(lens.q) > 50) {
            continue;
        }
        static const size_t unknown[][2] = {
            {offsetof(struct lensmaker, R1), offsetof(struct lensmaker, q)},
            {offsetof(struct lensmaker, R2), offsetof(struct lensmaker, q)},
            {offsetof(struct lensmaker, n), offsetof(struct lensmaker, q)},
            {offsetof(struct lensmaker, d), offsetof(struct lensmaker, q)},
            {offsetof(struct lensmaker, R1), offsetof(struct lensmaker, f)},
            {offsetof(struct lensmaker, R2), offsetof(struct lensmaker, f)},
            {offsetof(struct lensmaker, R1), offsetof(struct lensmaker, R2)},
        };
        for (size_t k = 0; k < sizeof unknown / sizeof unknown[0]; k++) {
            double best = INFINITY;
            int count = 1;
            for (int second = 0; second < count; second++) {
                struct lensmaker asked = lens;
                *(double *)(void *)((char *)&asked + unknown[k][0]) = NAN;
                *(double *)(void *)((char *)&asked + unknown[k][1]) = NAN;
                asked = solve(asked, second != 0, &count);
                double *found = (double *)(void *)((char *)&asked + unknown[k][0]);
                double *wanted = (double *)(void *)((char *)&lens + unknown[k][0]);
                best = fmin(best, fabs(*found / *wanted - 1));
                CHECK_RELATIVE(facts_of(asked).power, 1 / lens.f, 1e-9, "power of a solution");
            }
            CHECK_NEAR(best, 0, 1e-8, "an unknown found again");
            twice += count == 2;
        }
    }
    CHECK(twice > 100);
}

/* The first solution is the thin lens's when the thickness goes to 0. */
static void test_first(void)
{
    int count;
    for (double q = -3; q < 3.1; q += 0.5) {
        struct lensmaker thin = one((struct lensmaker){1, 1.5, 1, NAN, NAN, 0, 100, q});
        struct lensmaker thick =
            solve((struct lensmaker){1, 1.5, 1, NAN, NAN, 1e-9, 100, q}, false, &count);
        CHECK_NEAR(1 / thick.R1, 1 / thin.R1, 1e-10, "first solution");
        CHECK_NEAR(1 / thick.R2, 1 / thin.R2, 1e-10, "first solution");
        CHECK(count == (fabs(q) == 1 ? 1 : 2));
    }
    struct lensmaker lens =
        solve((struct lensmaker){1, NAN, 1, 50, 80, 1e-9, 200, NAN}, false, &count);
    struct lensmaker thin = one((struct lensmaker){1, NAN, 1, 50, 80, 0, 200, NAN});
    CHECK_RELATIVE(lens.n, thin.n, 1e-9, "first index");
    CHECK(count == 1); /* the other one goes to 0 */
}

static bool refused(struct lensmaker lens, enum error_code code, const char *words)
{
    struct lensmaker_choice choice = {0};
    error.message[0] = '\0';
    return !lensmaker_solve(&lens, &choice, &error) && error.code == code &&
           strstr(error.message, words) != NULL;
}

static void test_refusals(void)
{
    CHECK(
        refused((struct lensmaker){1, 1.5, 1, 50, NAN, NAN, NAN, NAN}, ERROR_USAGE, "too little"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, NAN, NAN, 5, 100, NAN}, ERROR_USAGE, "too little"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, -50, 0, 50, NAN}, ERROR_USAGE, "too much"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, -50, 0, NAN, 0}, ERROR_USAGE, "too much"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 0, -50, 0, NAN, NAN}, ERROR_DOMAIN, "radius 0"));
    CHECK(refused((struct lensmaker){1, -1, 1, 50, -50, 0, NAN, NAN}, ERROR_DOMAIN, "above 0"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, -50, -2, NAN, NAN}, ERROR_DOMAIN, "0 mm or"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, -50, 2, 0, NAN}, ERROR_DOMAIN, "focal"));
    CHECK(refused((struct lensmaker){1, NAN, 1, 50, -50, 2, -80, NAN}, ERROR_DOMAIN, "1 or more"));
    CHECK(refused((struct lensmaker){1, 1, 1, 50, NAN, 2, 80, NAN}, ERROR_DOMAIN, "equal indices"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, -50, NAN, 20, NAN}, ERROR_DOMAIN, "thin have"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, INFINITY, NAN, 20, NAN}, ERROR_DOMAIN,
                  "without power"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, NAN, NAN, 0, 20, INFINITY}, ERROR_DOMAIN,
                  "no power"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 50, NAN, 0, NAN, -1}, ERROR_DOMAIN, "plane"));
    CHECK(refused((struct lensmaker){1, 1e300, 1, 1e-310, -1e-310, 1, NAN, NAN}, ERROR_DOMAIN,
                  "too small"));
    /* equiconvex, d = 30, n = 1.5: P(x) = x - 5 x^2 is at most 1/20 */
    CHECK(refused((struct lensmaker){1, 1.5, 1, NAN, NAN, 30, 19.9, 0}, ERROR_DOMAIN,
                  "at most 50 dioptres, 20 mm"));
    CHECK(refused((struct lensmaker){1, 1.5, 1, 150, NAN, 450, 20, NAN}, ERROR_DOMAIN, "vertex"));
}

/*
 * Thickness and second radius with media on both sides, down to a nanometre, where all but a few
 * digits of the power cancel: by 60 digits from the inputs as doubles.
 */
static void test_cancelling(void)
{
    static const struct {
        double n0, n, n1, R1, R2, f, d, given, radius;
    } rows[] = {
        {1.0003, 1.8396, 1.0, 111.411, -53.239, 45.3649789322634, 19.51526472417754,
         19.515264724177527, -53.239},
        {1.0, 1.4924, 1.0, -36.321, -127.179, -104.3606604568746, 2.9295155622511153,
         2.9295155622511335, -127.17900000000002},
        {1.0, 1.7304, 1.336, -30.719, -178.322, -47.074561206114524, 10.601651784495811,
         10.601651784495772, -178.32199999999992},
        {1.0003, 1.5968, 1.336, -113.442, 109.959, -131.0618267678087, 1.914736885816224e-09,
         1.9146597631991155e-09, 109.95899999999997},
        {1.33, 1.6331, 1.336, -147.406, 156.438, -250.43100038462256, 15.78079894628399,
         15.780798946284042, 156.438},
        {1.0, 1.7034, 1.0, 39.405, 89.572, 100.02374440485393, 2.6946186746136673e-09,
         2.694619546605609e-09, 89.572},
        {1.0, 1.5461, 1.0, 87.583, 95.562, 960.4215526643137, 22.589098244680486,
         22.589098244680486, 95.562},
        {1.33, 1.6016, 1.0, 22.727, 156.447, 123.37832034722861, 1.269192195601812e-09,
         1.2691929377077213e-09, 156.447},
        {1.0, 1.4549, 1.0, 51.982, -100.536, 75.32472436626212, 2.9705627827843625e-06,
         2.970562811671111e-06, -100.53599999999999},
        {1.0, 1.6387, 1.0, -91.074, -20.085, 37.0705321735543, 16.082902997419794,
         16.08290299741979, -20.085},
        {1.0, 1.5448, 1.0, -27.579, -58.384, -95.9442861700682, 0.001019150477238437,
         0.001019150477240826, -58.384},
        {1.33, 1.8236, 1.0, -33.371, -124.892, -121.99900524484104, 1.0310181501753087e-06,
         1.031018146891651e-06, -124.892},
        {1.33, 1.6173, 1.0, -192.644, 169.825, -195.07360223044608, 2.7330512617638186e-06,
         2.7330513356044443e-06, 169.825},
        {1.0, 1.7323, 1.0, -167.204, -150.57, 2066.804291100907, 2.478848781612309e-06,
         2.4788487796333027e-06, -150.57},
        {1.0, 1.7591, 1.0, 128.636, 28.532, -48.29968733474959, 1.07739031747487e-09,
         1.0773929433875654e-09, 28.532},
        {1.33, 1.5573, 1.336, 66.257, 72.818, 2554.2967116477976, 2.858472374617589e-06,
         2.8584723728947836e-06, 72.818},
        {1.0, 1.5069, 1.0, -70.439, -154.817, -254.96484953321664, 1.5383977663402492e-09,
         1.538387856057682e-09, -154.817},
        {1.0003, 1.5621, 1.0, -70.753, -36.595, 134.77592584180337, 2.781880469353446e-06,
         2.781880459939625e-06, -36.595},
        {1.33, 1.7456, 1.336, -126.178, -105.463, 1694.6724044260545, 0.0024019400374876002,
         0.0024019400374860273, -105.463},
        {1.0, 1.4596, 1.336, -106.802, 77.403, -169.48786183012987, 1.1506240498315297e-09,
         1.1505258001847678e-09, 77.40299999999998},
        {1.33, 1.7817, 1.336, -162.788, 83.33, -122.74869904277588, 2.8016718786608124,
         2.8016718786607577, 83.33},
        {1.0003, 1.8749, 1.0, 123.105, 88.252, -355.9793053862164, 2.217732613122677e-09,
         2.2177338014878195e-09, 88.252},
        {1.0, 1.4908, 1.0, 178.363, 89.919, -397.8403114669681, 19.155115848857527,
         19.155115848857534, 89.919},
        {1.0003, 1.8273, 1.0, -75.842, -106.572, -318.3272628943152, 2.9147915335480127e-06,
         2.9147915348162454e-06, -106.572},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        double n0 = rows[i].n0, n = rows[i].n, n1 = rows[i].n1, R1 = rows[i].R1, R2 = rows[i].R2;
        double f = rows[i].f, d = rows[i].given, radius = rows[i].radius;
        struct lensmaker lens = one((struct lensmaker){n0, n, n1, R1, R2, NAN, f, NAN});
        CHECK_RELATIVE(lens.d, rows[i].d, 4e-16, "thickness");
        lens = one((struct lensmaker){n0, n, n1, R1, NAN, d, f, NAN});
        CHECK_RELATIVE(lens.R2, radius, 4e-16, "second radius");
        /* the lens reversed */
        lens = one((struct lensmaker){n1, n, n0, NAN, -R1, d, f, NAN});
        CHECK_RELATIVE(lens.R1, -radius, 4e-16, "first radius");
    }
    /* planes are written as inf, never -inf */
    struct lensmaker plano = one((struct lensmaker){1, 1.5, 1, NAN, NAN, 0, -100, 1});
    CHECK(plano.R2 == INFINITY && plano.R1 == -50);
    plano = one((struct lensmaker){1, 1.5, 1, NAN, NAN, 0, 100, -1});
    CHECK(plano.R1 == INFINITY && plano.R2 == -50);
    plano = one((struct lensmaker){1, 1.5, 1, NAN, NAN, 0, -100, -1});
    CHECK(plano.R1 == INFINITY && plano.R2 == 50);
}

int main(void)
{
    test_cancelling();
    test_truth();
    test_by_hand();
    test_ball();
    test_afocal();
    test_put_back();
    test_first();
    test_refusals();
    return check_report();
}
