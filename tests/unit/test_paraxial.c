/* tests/unit/test_paraxial.c - the (y, v) trace and the figures that follow from it. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "optics/first_order.h"
#include "optics/portable.h"

static bool solve(const char *text, struct arena *arena, struct lens *lens,
                  struct paraxial_trace *trace, struct paraxial_trace *portable,
                  struct first_order *first)
{
    struct paraxial_system system;
    struct error error;
    if (!lens_read("test", text_of(text), NULL, arena, lens, &error) ||
        !paraxial_compile(lens, lens_primary_wavelength(lens), SECTION_Y, arena, &system, &error)) {
        printf("%s\n", error.message);
        return false;
    }
    const struct conjugate_object object = lens_object(lens);
    paraxial_trace(&system, trace);
    paraxial_trace_portable(&system, portable);
    struct first_order same;
    memset(first, 0, sizeof *first); /* the padding, too */
    memset(&same, 0, sizeof same);
    first_order_compute(&system, trace, &object, first);
    first_order_compute_portable(&system, trace, &object, &same);
    CHECK(memcmp(first, &same, sizeof same) == 0);
    return true;
}

/* Closed forms: a thin lens, a ball, a mirror, a plane plate. */
static void check_closed_forms(void)
{
    static const struct {
        const char *text;
        double efl, bfl, ffl;
    } cases[] = {
        {"surface 50 0 1.5 -\nsurface -50 0 air -\n", 50, 50, -50},
        /* ball: efl = n R/(2 (n - 1)), back focus efl - R */
        {"surface 10 20 1.6 -\nsurface -10 - air -\n", 40.0 / 3, 10.0 / 3, -10.0 / 3},
        {"surface -200 0 mirror -\n", 100, -100, -100},
        {"surface - 10 1.5 -\nsurface - 0 air -\n", INFINITY, INFINITY, INFINITY},
        {"surface - 0 1.5 - c=0.02\nsurface -50 0 air -\n", 50, 50, -50},
        {"unit in\nsurface 2 0 1.5 -\nsurface -2 0 air -\n", 50.8, 50.8, -50.8},
        /* A2 adds 2 A2 to the curvature: 0.02 in all */
        {"surface - 0 1.5 - A2=0.01\nsurface -50 0 air -\n", 50, 50, -50},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        struct paraxial_trace trace, portable;
        struct first_order first;
        CHECK(solve(cases[i].text, &arena, &lens, &trace, &portable, &first));
        CHECK_RELATIVE(first.efl, cases[i].efl, 2e-16, cases[i].text);
        CHECK_RELATIVE(first.bfl, cases[i].bfl, 2e-16, cases[i].text);
        CHECK_RELATIVE(first.ffl, cases[i].ffl, 2e-16, cases[i].text);
        CHECK(isnan(first.entrance_pupil) && isnan(first.exit_pupil));
        CHECK(memcmp(&trace, &portable, sizeof trace) == 0);
        arena_free(&arena);
    }
}

/*
 * A Galilean telescope of exact decimals, gap 100 = f1 + f2 with f1 = 150, f2 = -50 by thin plano
 * lenses: the power is exactly 0, where doubles leave 1e-19; moved by 1e-7 mm it is
 * -1e-7/(150 x -50) /mm.
 */
static void check_afocal(void)
{
    static const char before[] = "surface 75 0 1.5 -\nsurface - ",
                      behind[] = " air -\nsurface -25 0 1.5 -\nsurface - 0 air -\n";
    struct arena arena = {0};
    struct lens lens;
    struct paraxial_trace trace, portable;
    struct first_order first;
    const char *exact = arena_printf(&arena, "%s100%s", before, behind);
    const char *moved = arena_printf(&arena, "%s100.0000001%s", before, behind);
    CHECK(solve(exact, &arena, &lens, &trace, &portable, &first));
    CHECK(first.is_afocal && isinf(first.efl) && first.power == 0);
    CHECK_RELATIVE(first.angular_magnification, 3.0, 1e-15, "150/50");
    CHECK(fabs(trace.whole.c.hi) < 1e-31);
    CHECK(solve(moved, &arena, &lens, &trace, &portable, &first));
    CHECK_RELATIVE(first.power, 1e-7 / 7500, 4e-16, "power, 1/mm");
    CHECK(isnan(first.angular_magnification)); /* it depends on the object's distance */
    CHECK(memcmp(&trace, &portable, sizeof trace) == 0);
    arena_free(&arena);
}

/*
 * Where the whole system has lost what its parts still know. Expected values by exact fractions:
 * the exit pupil through the two surfaces from the stop on; H' = n' (1 - a)/c with 1 - a about
 * 1e-20; a stop in the front focus, whose exit pupil is at infinity.
 */
static void check_extremes(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct paraxial_trace trace, portable;
    struct first_order first;
    CHECK(solve("surface -34.140708 173.13453 2.1451 -\nsurface 218.38011 1.4982118e+08 2.08378 -\n"
                "surface -0.0034158787 9.4319443e+09 1.34617 -\n"
                "surface -20390.183 0.0026283691 2.00416 -\n"
                "surface 2514.4814 1564.6291 2.00331 - stop\nsurface -1034.4811 - 1 -\n",
                &arena, &lens, &trace, &portable, &first));
    CHECK_RELATIVE(first.exit_pupil, -3220.551304877331, 4e-16, "exit pupil");
    CHECK_RELATIVE(first.exit_scale, 4.1235092933998265, 4e-16, "its radius over that of the stop");
    CHECK(
        solve("surface - 1.5170048e-09 2.02933 -\nsurface - 415.93235 1.91846 -\n"
              "surface -1.001043e+08 1.3702865e-09 1.92083 -\nsurface 3.6544631e+08 - 1.47813 -\n",
              &arena, &lens, &trace, &portable, &first));
    CHECK_RELATIVE(first.rear_principal, -2.021337587360998e-11, 4e-16, "H' of a flat lens");
    CHECK(solve("stop - 17.1 air -\nsurface 17.1 0 2 -\nsurface - 0 air -\n", &arena, &lens, &trace,
                &portable, &first));
    CHECK(isinf(first.exit_pupil) && isinf(first.pupil_magnification));
    arena_free(&arena);
}

/* The determinant is 1, and reversing a lens swaps the focal points. */
static void check_properties(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct paraxial_trace trace, portable;
    struct first_order there, back;
    CHECK(solve("surface 58.95 7.52 1.67/47.1 -\nsurface 169.66 3 1.33 -\nsurface -28.9 2 1.6 -\n"
                "surface 80 0 air -\n",
                &arena, &lens, &trace, &portable, &there));
    const struct paraxial_matrix *m = &trace.whole;
    double determinant = pair_subtract(pair_multiply(m->a, m->d), pair_multiply(m->b, m->c)).hi;
    CHECK_NEAR(determinant, 1, 1e-30, "determinant");
    CHECK(solve("surface -80 2 1.6 -\nsurface 28.9 3 1.33 -\nsurface -169.66 7.52 1.67/47.1 -\n"
                "surface -58.95 0 air -\n",
                &arena, &lens, &trace, &portable, &back));
    CHECK_RELATIVE(back.efl, there.efl, 0, "focal length of the reversed lens");
    CHECK_RELATIVE(back.bfl, -there.ffl, 0, "back focus of the reversed lens");
    arena_free(&arena);
}

int main(void)
{
    check_closed_forms();
    check_afocal();
    check_extremes();
    check_properties();
    return check_report();
}
