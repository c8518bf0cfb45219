/* tests/unit/test_dof.c - depth of field against exact rationals, and focus stacks. */
/* SPDX-License-Identifier: MIT */
#include <float.h>
#include <stdlib.h>

#include "check.h"
#include "photo/dof.h"
#include "photo/dof_plan.h"

enum { COLUMNS = 23 };

/* The columns of tests/truth/dof.tsv. */
enum column {
    ID,
    CLASS,
    F_MM,
    N_,
    S_MM,
    C_MM,
    P_,
    STATUS,
    M,
    V,
    NEFF,
    H,
    H_APPROX,
    NEAR,
    FAR,
    FRONT,
    BEHIND,
    TOTAL,
    DEPTH_OF_FOCUS,
    BLUR_INF,
    KAPPA_NEAR,
    KAPPA_FAR,
    FAR_APPROX
};

static double worst[COLUMNS]; /* in eps x condition */
static int rows, refusals;

/* Cut a line at its tabs; the number of cells. */
static int split(char *line, char *cell[COLUMNS])
{
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    for (char *at = line; at && count < COLUMNS; count++) {
        cell[count] = at;
        at = strchr(at, '\t');
        if (at) {
            *at++ = '\0';
        }
    }
    return count;
}

static double number(const char *cell)
{
    return strcmp(cell, "-") == 0 ? NAN : strtod(cell, NULL);
}

/* |value/truth - 1| <= eps units condition; infinities and zeros exactly. */
static void check_column(char *const cell[], enum column column, double value, double units,
                         double condition)
{
    double truth = number(cell[column]);
    char what[80] = "row ";
    strncat(what, cell[ID], 8);
    strncat(what, " column ", 9);
    size_t end = strlen(what);
    what[end] = (char)('0' + column / 10);
    what[end + 1] = (char)('0' + column % 10);
    what[end + 2] = '\0';
    if (isinf(truth) || truth == 0) {
        CHECK_NEAR(value, truth, 0, what);
        return;
    }
    double error = fabs(value / truth - 1) / (DBL_EPSILON * condition);
    if (error > worst[column]) {
        worst[column] = error;
    }
    CHECK_RELATIVE(value, truth, units * DBL_EPSILON * condition, what);
}

/* What is said of far on the row where s is H itself: all that rounding leaves. */
static void check_at_hyperfocal(const struct dof *d)
{
    CHECK(d->far > 1e12);
    CHECK(d->behind > 1e12);
    CHECK(d->total > 1e12);
}

/* Of a point so far away, |x - s| being as uncertain as both are. */
static void check_blur_at(const struct dof_setting *a, double x, const char *what)
{
    struct error error;
    double blur, q = a->f * (1 - 1 / a->P);
    if (!(x > q)) {
        CHECK(!dof_blur_at(a, x, &blur, &error));
        CHECK(error.code == ERROR_DOMAIN);
        return;
    }
    CHECK(dof_blur_at(a, x, &blur, &error));
    double focus = a->s < INFINITY ? a->s / (a->s - a->f) : 1;
    double apart = a->s < INFINITY && x < INFINITY ? (x + a->s) / fabs(x - a->s) : 1;
    double condition = 16 * (focus + apart + (fabs(x) + fabs(q)) / (x - q));
    if (condition * DBL_EPSILON < 1e-3) {
        CHECK_RELATIVE(blur, a->c, condition * DBL_EPSILON, what);
    }
}

/* The limits are where the blur is c; that at infinity is a column. */
static void check_blur(char *const cell[], const struct dof_setting *a)
{
    struct error error;
    double blur, near = number(cell[NEAR]), far = number(cell[FAR]);
    CHECK(dof_blur_at(a, INFINITY, &blur, &error));
    check_column(cell, BLUR_INF, blur, 4, a->s < INFINITY ? a->s / (a->s - a->f) : 1);
    if (a->s < INFINITY) {
        CHECK(dof_blur_at(a, a->s, &blur, &error) && blur == 0);
    }
    if (a->c > 0 && near != a->s) {
        check_blur_at(a, near, cell[ID]);
    }
    if (a->c > 0 && far < INFINITY && strcmp(cell[CLASS], "at_H") != 0) {
        check_blur_at(a, far, cell[ID]);
    }
}

static void check_row(char *const cell[])
{
    struct dof_setting a = {number(cell[F_MM]), number(cell[N_]), number(cell[C_MM]),
                            number(cell[S_MM]), number(cell[P_])};
    struct error error;
    struct dof d;
    rows++;
    if (strcmp(cell[STATUS], "ok") != 0) {
        refusals++;
        CHECK(!dof_compute(&a, DOF_EXACT, &d, &error));
        CHECK(error.code == ERROR_DOMAIN);
        return;
    }
    bool done = dof_compute(&a, DOF_EXACT, &d, &error);
    CHECK(done);
    if (!done) {
        return;
    }
    /* s is rounded to double before s - f is formed: condition s/(s - f) */
    double focus = a.s < INFINITY ? a.s / (a.s - a.f) : 1;
    double kn = isnan(number(cell[KAPPA_NEAR])) ? 4 : number(cell[KAPPA_NEAR]);
    double kf = isnan(number(cell[KAPPA_FAR])) ? 4 : number(cell[KAPPA_FAR]);
    check_blur(cell, &a);
    check_column(cell, M, d.magnification, 4, focus);
    check_column(cell, V, d.image, 4, focus);
    check_column(cell, NEFF, d.working_fnumber, 4, focus);
    check_column(cell, H, d.hyperfocal, 4, 1);
    check_column(cell, NEAR, d.near, 8, kn);
    check_column(cell, FRONT, d.front, 4, kn * focus);
    check_column(cell, DEPTH_OF_FOCUS, d.depth_of_focus, 4, focus);
    check_column(cell, BLUR_INF, d.blur_at_infinity, 4, focus);
    if (strcmp(cell[CLASS], "at_H") == 0) {
        check_at_hyperfocal(&d);
        return;
    }
    check_column(cell, FAR, d.far, 8, kf);
    check_column(cell, BEHIND, d.behind, 4, kf * focus);
    check_column(cell, TOTAL, d.total, 4, kf * focus);
    /* the kappas are printed with 4 digits, for P = 1; near infinity they are conditioned too */
    a.P = 1;
    CHECK(dof_compute(&a, DOF_EXACT, &d, &error));
    if (!isnan(number(cell[KAPPA_NEAR]))) {
        CHECK_RELATIVE(d.near_condition, number(cell[KAPPA_NEAR]), 6e-4, cell[ID]);
    }
    if (!isnan(number(cell[KAPPA_FAR]))) {
        CHECK_RELATIVE(d.far_condition, kf, 6e-4 + 16 * DBL_EPSILON * kf, cell[ID]);
    }
}

static void test_truth(void)
{
    FILE *file = fopen("tests/truth/dof.tsv", "r");
    char line[2048], *cell[COLUMNS];
    CHECK(file != NULL);
    if (!file) {
        return;
    }
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#' || strncmp(line, "id\t", 3) == 0) {
            continue;
        }
        int count = split(line, cell);
        CHECK(count == COLUMNS);
        if (count == COLUMNS) {
            check_row(cell);
        }
    }
    fclose(file);
    CHECK(rows == 187);
    CHECK(refusals == 4);
    printf("worst errors, eps x condition: m %.2g v %.2g Neff %.2g H %.2g near %.2g far %.2g "
           "front %.2g behind %.2g total %.2g focus %.2g blur %.2g\n",
           worst[M], worst[V], worst[NEFF], worst[H], worst[NEAR], worst[FAR], worst[FRONT],
           worst[BEHIND], worst[TOTAL], worst[DEPTH_OF_FOCUS], worst[BLUR_INF]);
}

/* f N c s H near far image mag of tests/truth/thin_dof.tsv; inputs of ordinary conditioning. */
static void test_thin(void)
{
    FILE *file = fopen("tests/truth/thin_dof.tsv", "r");
    char line[1024], *cell[COLUMNS];
    int count = 0;
    CHECK(file != NULL);
    while (file && fgets(line, sizeof line, file)) {
        if (line[0] == '#' || line[0] == 'f' || split(line, cell) != 9) {
            continue;
        }
        struct dof_setting a = {number(cell[0]), number(cell[1]), number(cell[2]), number(cell[3]),
                                1};
        struct error error;
        struct dof d;
        count++;
        CHECK(dof_compute(&a, DOF_EXACT, &d, &error));
        CHECK_RELATIVE(d.hyperfocal, number(cell[4]), 4 * DBL_EPSILON, "H");
        CHECK_RELATIVE(d.near, number(cell[5]), 8 * DBL_EPSILON * d.near_condition, "near");
        CHECK_RELATIVE(d.far, number(cell[6]), 8 * DBL_EPSILON * d.far_condition, "far");
        CHECK_RELATIVE(d.image, number(cell[7]), 4 * DBL_EPSILON, "image");
        CHECK_RELATIVE(d.magnification, -number(cell[8]), 8 * DBL_EPSILON, "m");
    }
    if (file) {
        fclose(file);
    }
    CHECK(count == 40);
}

static struct dof answer(double f, double N, double c, double s, double P, enum dof_model model)
{
    struct dof_setting a = {f, N, c, s, P};
    struct error error;
    struct dof d = {0};
    CHECK(dof_compute(&a, model, &d, &error));
    return d;
}

/* Rules that hold without any table. */
static void test_properties(void)
{
    /* 50^2/(4 x 0.03125) = 20000 and all that follows are exact in binary */
    struct dof d = answer(50, 4, 0.03125, 20050, 1, DOF_EXACT);
    CHECK(d.hyperfocal == 20050);
    CHECK(d.near == 10025); /* H/2 */
    CHECK(d.far == INFINITY);
    CHECK(dof_near_at_hyperfocal(50, 4, 0.03125, 1) == 10025);
    /* a wanted near limit: by hand; for P = 2 near = (20050 + 25)/2, for P = 1/2 (20050 - 50)/2 */
    CHECK(dof_hyperfocal_of_near(50, 1, NAN, 10025) == 20050);
    CHECK(dof_hyperfocal_of_near(50, 2, NAN, 10037.5) == 20050);
    CHECK(dof_hyperfocal_of_near(50, 0.5, NAN, 10000) == 20050);
    CHECK_RELATIVE(dof_hyperfocal_of_near(NAN, 2, 0.125, 10037.5), 20050.0, 1e-15, "f unknown");
    CHECK_RELATIVE(dof_hyperfocal_of_near(NAN, 0.5, 0.125, 10000), 20050.0, 1e-15, "f unknown");
    d = answer(50, 4, 0.03125, INFINITY, 1, DOF_EXACT);
    CHECK(d.near == 20000); /* H - f */
    CHECK(d.magnification == 0);
    CHECK(d.image == 50 && d.image_far == 50);
    d = answer(20, 2, 0.05, INFINITY, 2, DOF_EXACT); /* f(1 - 1/P) + f^2/(N c) = 10 + 4000 */
    CHECK_RELATIVE(d.near, 4010.0, 2 * DBL_EPSILON, "near at infinity with P = 2");
    d = answer(20, 2, 0.05, 4020, 2, DOF_EXACT);
    CHECK_RELATIVE(d.near, dof_near_at_hyperfocal(20, 2, 0.05, 2), 2 * DBL_EPSILON, "near at H");
    /* the image planes: conjugates, and harmonic about the image (P = 1) */
    d = answer(50, 4, 0.03, 3000, 1, DOF_EXACT);
    CHECK_RELATIVE(1 / d.near + 1 / d.image_near, 1.0 / 50, 4 * DBL_EPSILON, "near conjugates");
    CHECK_RELATIVE(1 / d.far + 1 / d.image_far, 1.0 / 50, 4 * DBL_EPSILON, "far conjugates");
    CHECK_RELATIVE(1 / d.image_near + 1 / d.image_far, 2 / d.image, 4 * DBL_EPSILON, "harmonic");
    d = answer(50, 4, 0.03, 120, 0.4, DOF_EXACT);
    CHECK_RELATIVE(1 / d.near + 1 / d.image_near, 1.0 / 50, 4 * DBL_EPSILON, "near, P = 0.4");
    CHECK_RELATIVE(1 / d.far + 1 / d.image_far, 1.0 / 50, 4 * DBL_EPSILON, "far, P = 0.4");
    CHECK_RELATIVE(d.far_vergence, 1 / d.far, 2 * DBL_EPSILON, "vergence");
    CHECK_RELATIVE(d.near_vergence, 1 / d.near, 2 * DBL_EPSILON, "near vergence");
    /* no blur: everything but the subject is out */
    d = answer(50, 4, 0, 3000, 0.7, DOF_EXACT);
    CHECK(d.near == 3000 && d.far == 3000 && d.total == 0 && d.hyperfocal == INFINITY);
    /* near has no real image when the blur is as wide as the pupil */
    CHECK(answer(1, 128, 0.03, 1e6, 1, DOF_EXACT).image_near == INFINITY);
}

/* The conditions of any P against central differences, step 1e-5: error of the order 1e-9. */
static void test_conditions(void)
{
    static const struct dof_setting cases[] = {{50, 4, 0.03, 3000, 0.4}, {50, 4, 0.03, 3000, 2.5},
                                               {50, 8, 0.03, 80, 0.3},   {50, 8, 0.03, 80, 4},
                                               {14, 8, 0.03, 800, 2},    {14, 8, 0.03, 5000, 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct dof_setting a = cases[i];
        struct dof d = answer(a.f, a.N, a.c, a.s, a.P, DOF_EXACT);
        double near = 0, far = 0, h = 1e-5;
        for (int which = 0; which < 4; which++) {
            double up[4] = {1, 1, 1, 1}, down[4] = {1, 1, 1, 1};
            up[which] += h;
            down[which] -= h;
            struct dof x =
                answer(a.f * up[0], a.N * up[1], a.c * up[2], a.s * up[3], a.P, DOF_EXACT);
            struct dof y =
                answer(a.f * down[0], a.N * down[1], a.c * down[2], a.s * down[3], a.P, DOF_EXACT);
            near += fabs(x.near - y.near) / (2 * h * d.near);
            far += fabs(x.far - y.far) / (2 * h * d.far);
        }
        CHECK_RELATIVE(d.near_condition, near, 1e-6, "near condition");
        if (d.far < INFINITY) {
            CHECK_RELATIVE(d.far_condition, far, 1e-6, "far condition");
        }
    }
}

/* The short cuts, as the formulas stand in the header. */
static void test_models(void)
{
    struct dof d = answer(50, 2, 0.05, 150, 1, DOF_NO_F);
    CHECK_RELATIVE(d.hyperfocal, 25000.0, 2 * DBL_EPSILON, "H without f");
    CHECK_RELATIVE(d.near, 25000. * 150 / (25000 + 100), 4 * DBL_EPSILON, "no-f near");
    d = answer(50, 2, 0.05, 150, 1, DOF_POPULAR);
    CHECK_RELATIVE(d.near, 25000. * 150 / (25000 + 150), 4 * DBL_EPSILON, "popular near");
    CHECK_RELATIVE(d.far, 25000. * 150 / (25000 - 150), 4 * DBL_EPSILON, "popular far");
    CHECK_RELATIVE(d.front, 150 - d.near, 1e-12, "popular front"); /* cancels three digits */
    CHECK(answer(50, 2, 0.05, 25000, 1, DOF_POPULAR).far == INFINITY);
    CHECK(answer(50, 2, 0.05, INFINITY, 1, DOF_POPULAR).near == 25000);
    d = answer(50, 2, 0.05, 150, 1, DOF_CLOSE_UP); /* m = 0.5 */
    CHECK_RELATIVE(d.total, 2 * 2 * 0.05 * 1.5 / 0.25, 4 * DBL_EPSILON, "close-up total");
    CHECK_RELATIVE(d.near, 150 - 0.6, 4 * DBL_EPSILON, "close-up near");
    struct dof_setting a = {50, 2, 0.05, 1e9, 1};
    struct error error;
    CHECK(!dof_compute(&a, DOF_CLOSE_UP, &d, &error));
    for (int i = 0; i < DOF_MODELS; i++) {
        CHECK(dof_models[i].word && dof_models[i].help);
    }
}

static void test_refusals(void)
{
    static const struct {
        struct dof_setting a;
        const char *message;
    } bad[] = {
        {{50, 4, 0.03, 40, 1}, "distance 40 mm lies within the focal length 50 mm: no real image"},
        {{0, 4, 0.03, 40, 1}, "focal length 0 mm must be above 0 and finite"},
        {{50, -1, 0.03, 400, 1}, "f-number -1 must be above 0 and finite"},
        {{50, 4, -0.5, 400, 1}, "circle of confusion -0.5 mm must be 0 or more and finite"},
        {{50, 4, 0.03, 400, 0}, "pupil magnification 0 must be above 0 and finite"},
        {{50, 4, 0.03, NAN, 1}, "distance is not a number; it must be above 50 mm"},
        {{INFINITY, 4, 0.03, INFINITY, 1}, "focal length inf mm must be above 0 and finite"},
        /* N c would be 0 */
        {{7e-173, 1e-172, 1e-172, 2e-172, 1},
         "focal length 7e-173 mm is out of range: 1e-30 to "
         "1e+30 mm"},
        {{50, 4, 0.03, 1e31, 1}, "distance 1e+31 mm is out of range: 1e-30 to 1e+30 mm"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct error error = {0};
        struct dof d;
        CHECK(!dof_compute(&bad[i].a, DOF_EXACT, &d, &error));
        CHECK_TEXT(error.message, bad[i].message);
    }
    struct dof_setting huge = {1e300, 1e-300, 1e300, INFINITY, 1};
    struct dof_setting nan_c = {50, 4, NAN, 400, 1};
    struct error error;
    struct dof d;
    CHECK(!dof_compute(&huge, DOF_EXACT, &d, &error));
    CHECK(!dof_compute(&nan_c, DOF_EXACT, &d, &error));
}

/* Every stack covers its range without a gap, with at least the overlap, in the fewest shots. */
static void check_plan(struct dof_setting a, double near, double far, double overlap)
{
    struct dof_plan plan;
    struct dof_setting shot;
    struct error error;
    struct dof d, before = {0};
    bool made = dof_plan_make(&a, near, far, overlap, &plan, &error);
    CHECK(made);
    for (long k = 0; made && k < plan.count; k++) {
        CHECK(dof_plan_shot(&plan, k, &shot, &d, &error));
        if (k > 0) {
            double common = before.image_near - before.image_far;
            double kept = (d.image_near - before.image_far) / common;
            CHECK(kept >= overlap - 1e-7); /* of differences of nearby image distances */
        } else if (plan.count > 1) {
            CHECK_RELATIVE(d.near, near, 1e-11, "first near");
        } else {
            CHECK(d.near <= near && d.far >= far);
        }
        before = d;
    }
    if (made && plan.count > 1 && far < INFINITY) {
        CHECK_RELATIVE(d.far, far, 1e-9, "last far");
    }
    if (made && far == INFINITY) {
        CHECK(d.far > 1e12);
    }
    if (made) {
        CHECK(!dof_plan_shot(&plan, plan.count, &shot, &d, &error));
    }
}

static void test_plan(void)
{
    struct dof_setting a = {100, 8, 0.02, INFINITY, 1};
    struct dof_plan plan;
    struct error error;
    check_plan(a, 300, 400, 0.3);
    check_plan(a, 300, 400, 0);
    check_plan(a, 2000, INFINITY, 0.5);
    check_plan(a, 40000, INFINITY, 0); /* H = 62600: one shot */
    a.P = 0.3;
    check_plan(a, 150, 160, 0.2);
    a.P = 3;
    check_plan(a, 1000, INFINITY, 0.95);
    a.P = 1;
    /* one shot more than needed is one too many: two depths of field end to end take two shots */
    struct dof first = answer(100, 8, 0.02, 300, 1, DOF_EXACT);
    double h = 8 * 0.02 / 100, ratio = (1 - h) / (1 + h); /* image 150 -> 150 ratio, P = 1 */
    double v = 150 * ratio;
    struct dof second = answer(100, 8, 0.02, 1 / (1.0 / 100 - 1 / v), 1, DOF_EXACT);
    CHECK(dof_plan_make(&a, first.near, second.far, 0, &plan, &error) && plan.count == 2);
    CHECK(dof_plan_make(&a, first.near, second.far * 1.0001, 0, &plan, &error) && plan.count == 3);
    CHECK(!dof_plan_make(&a, 90, 200, 0, &plan, &error));
    CHECK(!dof_plan_make(&a, 300, 200, 0, &plan, &error));
    CHECK(!dof_plan_make(&a, 300, 400, 0.96, &plan, &error));
    CHECK(!dof_plan_make(&a, 300, NAN, 0, &plan, &error));
    a.c = 1e-9;
    CHECK(!dof_plan_make(&a, 101, INFINITY, 0.9, &plan, &error));
    a.c = 0;
    CHECK(!dof_plan_make(&a, 300, 400, 0, &plan, &error));
}

static void check_equal(struct dof_setting a, double k)
{
    struct dof_setting b;
    struct error error;
    struct dof d, e;
    CHECK(dof_equal(&a, k, &b, &error));
    CHECK(dof_compute(&a, DOF_EXACT, &d, &error) && dof_compute(&b, DOF_EXACT, &e, &error));
    CHECK(b.s == a.s);
    CHECK_RELATIVE(e.magnification, k * d.magnification, 1e-12, "framing");
    if (d.total < INFINITY) {
        CHECK_RELATIVE(e.total, d.total, 1e-11 * d.far_condition, "equal total");
    }
    if (a.P == 1 || d.total == INFINITY) {
        CHECK_RELATIVE(e.near, d.near, 1e-12, "equal near");
    }
    if (a.P == 1) {
        CHECK_RELATIVE(b.N, a.N * b.f / a.f, 4 * DBL_EPSILON, "equal f/N rule");
    }
}

/* 2 N c (m + 1)/m^2 of close-ups, [Ray02]; with f what dof_compute says at that magnification. */
static void test_rail(void)
{
    static const struct {
        double m, N, c, P, covered, overlap, depth, step;
        long count;
        const char *source;
    } stacks[] = {
        {2, 5.6, 0.03, 1, 8, 0.2, 0.252, 7.748 / 39, 40, "2 x 5.6 x 0.03 x 3/4; 7.748/0.2016"},
        {1, 8, 0.03, 1, 9.6, 0.5, 0.96, 8.64 / 18, 19, "2 x 8 x 0.03 x 2; exactly 18 steps"},
        {0.5, 4, 0.02, 2, 1, 0, 1.6 * 0.5, 0.2, 2, "0.16 x (2 + 1/2)/0.5"},
        {1, 8, 0.03, 1, 0.5, 0.2, 0.96, NAN, 1, "one is enough"},
    };
    struct error error;
    struct dof_rail rail;
    for (size_t i = 0; i < sizeof stacks / sizeof *stacks; i++) {
        const struct dof_setting a = {NAN, stacks[i].N, stacks[i].c, INFINITY, stacks[i].P};
        CHECK(dof_rail_plan(&a, stacks[i].m, stacks[i].covered, stacks[i].overlap, &rail, &error));
        CHECK_RELATIVE(rail.depth, stacks[i].depth, 1e-14, stacks[i].source);
        CHECK(rail.count == stacks[i].count);
        CHECK(isnan(stacks[i].step) ? isnan(rail.step) : fabs(rail.step - stacks[i].step) < 1e-14);
        CHECK_RELATIVE(rail.travel + (rail.count > 1 ? rail.depth : stacks[i].covered),
                       stacks[i].covered, 1e-14, "all is covered");
    }
    const struct dof_setting near = {60, 16, 0.03, 60 + 60 / 0.05, 1.5};
    struct dof dof;
    CHECK(dof_compute(&near, DOF_EXACT, &dof, &error));
    CHECK(dof_rail_plan(&near, 0.05, 5000, 0.2, &rail, &error));
    CHECK_RELATIVE(rail.depth, dof.total, 1e-13, "dof_compute, which other programs pin");
    CHECK(!dof_rail_plan(&near, 0, 8, 0.2, &rail, &error));
    CHECK(!dof_rail_plan(&near, 1, 0, 0.2, &rail, &error));
    CHECK(!dof_rail_plan(&near, 1, 8, 1, &rail, &error));
    CHECK(!dof_rail_plan(&near, 0.001, 8, 0.2, &rail, &error)); /* e above 1 */
    CHECK(!dof_rail_plan(&near, 5, 1e9, 0.2, &rail, &error));
}

/* Depth by the magnification alone: the symmetric formula, and dof_compute where f is known. */
static void test_depth_at(void)
{
    static const struct {
        double f, m, N, c, P, depth;
        const char *source;
    } shots[] = {
        {NAN, 1, 11, 0.015, 1, 0.66, "R. Littlefield, photomacrography.net: 0.66 mm at 1x f/11"},
        {NAN, 5, 4, 0.015, 1, 0.0288, "2 x 4 x 0.015 x 6/25; the same table has 0.028"},
        {NAN, 5, 4, 0.015, 2, 0.0168, "2 x 4 x 0.015 x (1/5 + 1/2)/5"},
        {1000, 5, 4, 0.015, 1, 0.0288 / (1 - 1.44e-10), "1 - (N c/(m f))^2"},
        {NAN, 1, 11, 0, 1, 0, "nothing but a plane is sharp"},
        {1, 0.05, 8, 0.03, 1, INFINITY, "e = 4.8"},
    };
    struct error error;
    double depth;
    for (size_t i = 0; i < sizeof shots / sizeof *shots; i++) {
        const struct dof_setting a = {shots[i].f, shots[i].N, shots[i].c, NAN, shots[i].P};
        CHECK(dof_depth_at(&a, shots[i].m, &depth, &error));
        CHECK(isinf(shots[i].depth) ? isinf(depth)
                                    : fabs(depth - shots[i].depth) <= 1e-14 * shots[i].depth);
    }
    const struct dof_setting near = {60, 16, 0.03, 60 + 60 / 0.05, 1.5};
    struct dof dof;
    CHECK(dof_compute(&near, DOF_EXACT, &dof, &error));
    CHECK(dof_depth_at(&near, 0.05, &depth, &error));
    CHECK_RELATIVE(depth, dof.total, 1e-13, "dof_compute, which other programs pin");
    CHECK(!dof_depth_at(&near, 0, &depth, &error));
    CHECK(!dof_depth_at(&(struct dof_setting){NAN, 0, 0.03, NAN, 1}, 1, &depth, &error));
    CHECK(!dof_depth_at(&(struct dof_setting){NAN, 8, -1, NAN, 1}, 1, &depth, &error));
    CHECK(!dof_depth_at(&(struct dof_setting){NAN, 8, 0.03, NAN, 0}, 1, &depth, &error));
}

static void test_equal(void)
{
    check_equal((struct dof_setting){50, 2.8, 0.03, 3000, 1}, 0.5);
    check_equal((struct dof_setting){50, 2.8, 0.03, 80, 1}, 2.5);
    check_equal((struct dof_setting){50, 2.8, 0.03, INFINITY, 1}, 0.2);
    check_equal((struct dof_setting){50, 2.8, 0.03, 3000, 2}, 0.5);
    check_equal((struct dof_setting){50, 2.8, 0.03, 80, 0.5}, 0.6);
    check_equal((struct dof_setting){50, 2.8, 0.03, INFINITY, 0.5}, 2);
    struct dof_setting a = {50, 2.8, 0.03, 3000, 1}, b;
    struct error error;
    CHECK(!dof_equal(&a, 0, &b, &error));
}

/*
 * Reciprocal limits by what a pupil of diameter f/N at q = f (1 - 1/P) blurs: a point at x draws a
 * disc (f/N)(s - x)/(x - q) in the plane in focus, and m times that on the film.
 */
static void test_vergences(void)
{
    static const double settings[][5] = {{50, 4, 0.03, 2000, 1},
                                         {85, 1.4, 0.02, 900, 0.7},
                                         {24, 11, 0.03, 5000, 2.5},
                                         {100, 8, 0.1, 300, 0.5},
                                         {35, 16, 0.03, 40000, 1.6}};
    static const double fnumbers[] = {1, 2.8, 22};
    for (size_t i = 0; i < 3 * sizeof settings / sizeof settings[0]; i++) {
        const double *row = settings[i / 3];
        double f = row[0], c = row[2], s = row[3], P = row[4], N = fnumbers[i % 3], near, far;
        const struct dof_setting setting = {f, row[1], c, s, P};
        double m = f / (s - f), D = f / N, q = f * (1 - 1 / P);
        dof_vergences(&setting, N, &near, &far);
        CHECK_RELATIVE(near, (m * D + c) / (m * D * s + c * q), 1e-14, "near");
        CHECK_NEAR(far, (m * D - c) / (m * D * s - c * q), 1e-14 / f, "far");
    }
}

int main(void)
{
    test_vergences();
    test_truth();
    test_thin();
    test_properties();
    test_conditions();
    test_models();
    test_refusals();
    test_plan();
    test_rail();
    test_depth_at();
    test_equal();
    return check_report();
}
