/* tests/unit/test_dof_solve.c - the inverse of depth of field: round trips and refusals. */
/* SPDX-License-Identifier: MIT */
#include <float.h>
#include <stdint.h>

#include "base/roots.h"
#include "check.h"
#include "photo/dof_solve.h"

enum { FOCAL = 1, FNUMBER = 2, DISTANCE = 4, COC = 8 };
enum { NEAR = 1, FAR = 2, TOTAL = 4, HYPERFOCAL = 8, MAGNIFICATION = 16 };

/* Which unknowns are found from which targets. */
static const struct {
    unsigned unknown, targets;
} ways[] = {
    {FNUMBER, NEAR},
    {FNUMBER, FAR},
    {FNUMBER, TOTAL},
    {FNUMBER, HYPERFOCAL},
    {COC, NEAR},
    {COC, FAR},
    {COC, TOTAL},
    {COC, HYPERFOCAL},
    {DISTANCE, NEAR},
    {DISTANCE, FAR},
    {DISTANCE, TOTAL},
    {DISTANCE, MAGNIFICATION},
    {FOCAL, NEAR},
    {FOCAL, FAR},
    {FOCAL, TOTAL},
    {FOCAL, HYPERFOCAL},
    {FOCAL, MAGNIFICATION},
    {DISTANCE | FNUMBER, NEAR | FAR},
    {DISTANCE | COC, NEAR | FAR},
    {DISTANCE | FOCAL, NEAR | FAR},
    {DISTANCE | FNUMBER, NEAR | TOTAL},
    {DISTANCE | FNUMBER, FAR | TOTAL},
    {DISTANCE | FNUMBER, HYPERFOCAL | MAGNIFICATION},
    {DISTANCE | FNUMBER, HYPERFOCAL | NEAR},
    {DISTANCE | FNUMBER, MAGNIFICATION | TOTAL},
    {DISTANCE | FOCAL, HYPERFOCAL | FAR},
    {DISTANCE | FOCAL, MAGNIFICATION | HYPERFOCAL},
    {DISTANCE | FOCAL, MAGNIFICATION | NEAR},
    {DISTANCE | FOCAL, MAGNIFICATION | FAR},
    {DISTANCE | FOCAL, MAGNIFICATION | TOTAL},
    {FOCAL | FNUMBER, MAGNIFICATION | NEAR},
    {FOCAL | FNUMBER, HYPERFOCAL | NEAR},
    {FOCAL | COC, HYPERFOCAL | FAR},
    {FOCAL | FNUMBER | DISTANCE, NEAR | FAR | HYPERFOCAL},
    {FOCAL | FNUMBER | DISTANCE, NEAR | FAR | MAGNIFICATION},
    {FOCAL | FNUMBER | DISTANCE, MAGNIFICATION | HYPERFOCAL | NEAR},
};

enum { WAYS = sizeof ways / sizeof ways[0] };

/* Uniform in [0, 1): Knuth's MMIX generator, top 53 bits. */
static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static struct dof_targets pick(const struct dof *d, unsigned targets)
{
    return (struct dof_targets){
        .near = targets & NEAR ? d->near : NAN,
        .far = targets & FAR ? d->far : NAN,
        .total = targets & TOTAL ? d->total : NAN,
        .hyperfocal = targets & HYPERFOCAL ? d->hyperfocal : NAN,
        .magnification = targets & MAGNIFICATION ? d->magnification : NAN,
    };
}

static void forget(struct dof_setting *a, unsigned unknown)
{
    a->f = unknown & FOCAL ? NAN : a->f;
    a->N = unknown & FNUMBER ? NAN : a->N;
    a->s = unknown & DISTANCE ? NAN : a->s;
    a->c = unknown & COC ? NAN : a->c;
}

static int unsolved[WAYS];

/* Forget, solve, compute again: the targets must come back. */
static void check_way(int way, const struct dof_setting *a, const struct dof *d)
{
    struct dof_targets t = pick(d, ways[way].targets);
    struct dof_setting b = *a;
    struct error error = {0};
    struct dof e;
    forget(&b, ways[way].unknown);
    if (!dof_solve(&b, &t, &error) || !dof_compute(&b, DOF_EXACT, &e, &error)) {
        if (!unsolved[way]++) {
            printf("way %d: f %.17g N %.17g c %.17g s %.17g P %.17g: %s\n", way, a->f, a->N, a->c,
                   a->s, a->P, error.message);
        }
        return;
    }
    /* targets are met to 1e-9 of their condition; the depth is that of s / total more */
    double depth = a->s < INFINITY && d->far < INFINITY ? a->s / d->total + d->far_condition : 1;
    double focus = a->s < INFINITY ? a->s / (a->s - a->f) : 1;
    double far = d->far < INFINITY ? d->far_condition : 1;
    if (ways[way].targets & NEAR) {
        CHECK_RELATIVE(e.near, d->near, 1e-9 * d->near_condition, "near");
    }
    if (ways[way].targets & FAR) {
        CHECK_RELATIVE(e.far, d->far, 1e-9 * far, "far");
    }
    if (ways[way].targets & TOTAL) {
        CHECK_RELATIVE(e.total, d->total, 1e-9 * depth * focus, "total");
    }
    if (ways[way].targets & HYPERFOCAL) {
        CHECK_RELATIVE(e.hyperfocal, d->hyperfocal, 1e-9, "hyperfocal");
    }
    if (ways[way].targets & MAGNIFICATION) {
        CHECK_NEAR(e.magnification, d->magnification, 1e-9 * focus * d->magnification, "m");
    }
    CHECK(b.P == a->P);
}

static void test_round_trips(void)
{
    uint64_t state = 20040407;
    for (int i = 0; i < 3000; i++) {
        struct dof_setting a;
        struct error error;
        struct dof d;
        a.f = 5 * pow(200, uniform(&state));
        a.N = 1 + 31 * uniform(&state);
        a.c = 0.002 + 0.1 * uniform(&state);
        a.s = a.f * (1 + 0.05 * pow(20000, uniform(&state)));
        a.P = i % 2 ? 1 : pow(10, 2 * uniform(&state) - 1);
        /* near within f has no real image and is refused as a target */
        if (!dof_compute(&a, DOF_EXACT, &d, &error) || !(d.near > a.f)) {
            continue;
        }
        for (int way = 0; way < WAYS; way++) {
            if (d.far < INFINITY || !(ways[way].targets & (FAR | TOTAL))) {
                check_way(way, &a, &d);
            }
        }
    }
    for (int way = 0; way < WAYS; way++) {
        CHECK(unsolved[way] == 0);
    }
    for (int way = 0; way < WAYS; way++) {
        if (unsolved[way]) {
            printf("way %d (unknown %u, targets %u): %d unsolved\n", way, ways[way].unknown,
                   ways[way].targets, unsolved[way]);
        }
    }
}

static const struct dof_targets nothing = {NAN, NAN, NAN, NAN, NAN};

/* Hand-made: H = 50^2/(4 x 0.03125) + 50 = 20050, near there 10025. */
static void test_examples(void)
{
    struct dof_setting a = {50, NAN, 0.03125, NAN, 1};
    struct dof_targets t = nothing;
    struct error error;
    struct dof d;
    t.near = 10025;
    t.far = INFINITY;
    CHECK(dof_solve(&a, &t, &error));
    CHECK_RELATIVE(a.s, 20050.0, 1e-14, "s = H");
    CHECK_RELATIVE(a.N, 4.0, 1e-14, "N");
    CHECK(dof_compute(&a, DOF_EXACT, &d, &error) && d.far == INFINITY);
    /* near 2 m, far 3 m: s = 2 x 2 x 3/(2 + 3) = 2.4 m */
    a = (struct dof_setting){50, NAN, 0.03, NAN, 1};
    t.near = 2000;
    t.far = 3000;
    CHECK(dof_solve(&a, &t, &error));
    CHECK_RELATIVE(a.s, 2400.0, 1e-14, "s from 2 m to 3 m");
    /* N = f^2 (r - n)/(c (2 n r - f (n + r))) = 2500000/(0.03 x 11750000) */
    CHECK_RELATIVE(a.N, 2500. / (0.03 * 11750), 1e-14, "N from 2 m to 3 m");
    a = (struct dof_setting){NAN, 8, 0.03, 5000, 1};
    t = nothing;
    t.far = INFINITY;
    CHECK(dof_solve(&a, &t, &error));
    CHECK_RELATIVE(dof_hyperfocal(a.f, a.N, a.c), 5000.0, 1e-14, "H = s");
    CHECK(dof_compute(&a, DOF_EXACT, &d, &error) && d.far == INFINITY);
    a = (struct dof_setting){50, 2, 0.03, NAN, 1};
    t = nothing;
    t.magnification = 0;
    CHECK(dof_solve(&a, &t, &error) && a.s == INFINITY);
    /* the near limit with the lens at infinity is H - f */
    a = (struct dof_setting){50, NAN, 0.03125, INFINITY, 1};
    t = nothing;
    t.near = 20000;
    CHECK(dof_solve(&a, &t, &error));
    CHECK_RELATIVE(a.N, 4.0, 1e-14, "N from near at infinity");
}

static void test_infinity(void)
{
    static const unsigned unknown[] = {FOCAL, FNUMBER, DISTANCE, COC};
    uint64_t state = 1827;
    for (int i = 0; i < 4000; i++) {
        struct dof_setting a = {5 + 300 * uniform(&state), 1 + 31 * uniform(&state),
                                0.002 + 0.05 * uniform(&state), 0, i % 3 ? 1 : 0.7};
        a.s = a.f * (2 + 1000 * uniform(&state));
        struct dof_targets t = nothing;
        struct error error;
        struct dof d;
        forget(&a, unknown[i % 4]);
        t.far = i % 8 < 4 ? NAN : INFINITY;
        t.total = i % 8 < 4 ? INFINITY : NAN;
        CHECK(dof_solve(&a, &t, &error));
        CHECK(dof_compute(&a, DOF_EXACT, &d, &error) && d.far == INFINITY);
        CHECK_RELATIVE(d.hyperfocal, a.s, 1e-14, "focused at H");
    }
}

static void test_refusals(void)
{
    static const double no = NAN, inf = INFINITY;
    const struct {
        struct dof_setting a;
        struct dof_targets t;
        enum error_code code;
        const char *part; /* of the message */
    } bad[] = {
        {{50, no, 0.03, no, 1}, {2000, no, no, no, no}, ERROR_USAGE, "limit alone: give 1 of"},
        {{50, no, 0.03, no, 1}, {no, no, no, no, no}, ERROR_USAGE, "f-number, distance miss"},
        {{50, 4, 0.03, no, 1}, {2000, 3000, no, no, no}, ERROR_USAGE, "nothing is left"},
        {{50, no, no, 2000, 1}, {1900, no, no, 9000, no}, ERROR_USAGE, "product only"},
        {{50, 4, 0.03, no, 1}, {no, no, no, 9000, no}, ERROR_USAGE, "distance cannot be found"},
        {{50, no, 0.03, 2000, 1}, {no, no, no, no, 0.1}, ERROR_USAGE, "f-number cannot be found"},
        {{no, no, 0.03, 2000, 1}, {1900, 2500, no, no, no}, ERROR_USAGE, "cannot be found"},
        {{no, no, 0.03, no, 1}, {1900, 2500, 600, no, no}, ERROR_USAGE, "two of them"},
        {{50, no, 0.03, no, 1}, {3000, 2000, no, no, no}, ERROR_DOMAIN, "before the far limit"},
        {{50, no, 0.03, no, 1}, {40, 2000, no, no, no}, ERROR_DOMAIN, "no real image"},
        {{50, no, 0.03, 2000, 1}, {2500, no, no, no, no}, ERROR_DOMAIN, "before the distance"},
        {{50, no, 0.03, 2000, 1}, {no, 1500, no, no, no}, ERROR_DOMAIN, "behind the distance"},
        {{50, no, 0.03, 2000, 1}, {no, no, 0, no, no}, ERROR_DOMAIN, "above 0"},
        {{50, no, 0.03, 2000, 1}, {no, no, no, 40, no}, ERROR_DOMAIN, "above the focal length"},
        {{50, no, 0.03, 2000, 1}, {no, no, no, inf, no}, ERROR_DOMAIN, "finite"},
        {{50, 4, 0.03, no, 1}, {1e6, no, no, no, no}, ERROR_DOMAIN, "at infinity"},
        {{50, no, 0.03, inf, 1}, {no, inf, no, no, no}, ERROR_DOMAIN, "distance inf"},
        {{no, 4, 0.03, inf, 1}, {no, no, no, no, 0.1}, ERROR_DOMAIN, "distance inf"},
        {{50, no, 0, 2000, 1}, {1900, no, no, no, no}, ERROR_DOMAIN, "above 0 mm"},
        {{50, 4, 0, no, 1}, {no, no, 1000, no, no}, ERROR_DOMAIN, "above 0 mm"},
        {{50, no, 0.03, 2000, 0}, {1900, no, no, no, no}, ERROR_DOMAIN, "pupil"},
        {{50, no, 0.03, 40, 1}, {35, no, no, no, no}, ERROR_DOMAIN, "no real image"},
        {{50, no, 0.03, no, 1}, {no, 500, 600, no, no}, ERROR_DOMAIN, "below the far limit"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        struct dof_setting a = bad[i].a;
        struct error error = {0};
        bool refused = !dof_solve(&a, &bad[i].t, &error);
        CHECK(refused);
        CHECK(error.code == bad[i].code);
        check_at(strstr(error.message, bad[i].part) != NULL, __FILE__, __LINE__, error.message);
    }
}

static double cube(double x, const void *context)
{
    return x * x * x - *(const double *)context;
}

static double steep(double x, const void *context)
{
    (void)context;
    return x < 1 ? -INFINITY : INFINITY;
}

static double nan_inside(double x, const void *context)
{
    (void)context;
    return x < 0.3 ? -1 : x > 0.7 ? 1 : NAN;
}

static void test_roots(void)
{
    double two = 2, root = 0;
    struct error error;
    CHECK(root_find(cube, &two, 0, 1e6, &root, &error));
    CHECK_RELATIVE(root, 1.2599210498948731648, 8 * DBL_EPSILON, "cube root of 2 (OEIS A002580)");
    CHECK(root_find(steep, NULL, 0, 3, &root, &error));
    CHECK_RELATIVE(root, 1.0, 8 * DBL_EPSILON, "a jump");
    CHECK(!root_find(cube, &two, 2, 3, &root, &error));
    CHECK(!root_find(nan_inside, NULL, 0, 1, &root, &error));
}

int main(void)
{
    test_round_trips();
    test_examples();
    test_infinity();
    test_refusals();
    test_roots();
    return check_report();
}
