/* tests/unit/test_tolerance_turned.c - tolerances of a lens that is scaled or turned around. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "design/tolerance/perturbation.h"
#include "file/lens_change.h"
#include "lens_of.h"

/* Every kind of tolerance: of what is at one end by itself, of ranges, about pivots. */
static const char content[] =
    "tolerance R1..R6 2fringes normal\ntolerance R5 0.1%\ntolerance R2 0.02mm\n"
    "tolerance t1..t5 0.02\ntolerance surface 1..5 air 1%\ntolerance n1..n5 0.0005\n"
    "tolerance V1..V5 0.5%\ntolerance k1..k6 0.01\ntolerance A4_5 1e-8\n"
    "tolerance surface 2..3 tilt 1arcmin\ntolerance surface 5 decenter 0.01\n"
    "tolerance surface 1..6 irregularity 0.5fringes\ntolerance elements 1..6 tilt 2arcmin\n"
    "tolerance element 1..3 roll 3arcmin two-point\ntolerance elements 1..6 decenter 0.02\n"
    "tolerance element 1..6 tilt 1arcmin pivot 4\ntolerance elements 1..6 wedge 0.01mm\n"
    "tolerance element 5..6 roll 1arcmin pivot 6\ntolerance focus 0.05\n"
    "surface 50 5 1.5/60 20\nsurface -50 3 1.6/40 20\nsurface - 6 air 20\nstop - 2 air 10\n"
    "surface 70 4 1.5/55 24 k=-1.5 A4=1e-6\nsurface -70 60 air 22\n";
enum { SURFACES = 6 };

static struct perturbations errors_of(const struct lens *lens, struct arena *arena)
{
    struct perturbations all = {0};
    struct error error = {.code = ERROR_NONE};
    const struct perturbation_wish wish = {.marks = {lens->tolerances, lens->tolerance_count}};
    CHECK(perturbations_of(lens, &wish, arena, &all, &error));
    CHECK_TEXT(error.message, "");
    return all;
}

/* The power of length that an amount scales with; of waves of sag it is 1. */
static int length_of(const struct perturbation *one)
{
    const bool is_sag = one->kind == TOLERANCE_IRREGULARITY || one->kind == TOLERANCE_FOCUS ||
                        one->kind == TOLERANCE_ELEMENT_DECENTER;
    return is_sag                              ? 1
           : one->what.kind == PARAMETER_KINDS ? 0
                                               : parameter_length(one->what.kind, one->what.order);
}

static void test_scaled(void)
{
    struct arena arena = {0};
    const struct lens lens = lens_of(content, &arena);
    const struct perturbations before = errors_of(&lens, &arena);
    const struct perturbations after =
        errors_of(lens_scaled(&lens, (struct pair){2, 0}, false, &arena), &arena);
    /* 5 radii, 4 spaces, 3 glasses, k and A4, 2 tilts, a decentre, 5 irregularities of three; of
       two elements tilt, decentre, roll and wedge, of both a tilt; the focus */
    CHECK(before.count == 5 + 4 + 3 * 2 + 2 + 2 * 2 + 2 + 5 * 3 + 2 * 4 * 2 + 2 + 1);
    CHECK(after.count == before.count);
    for (size_t i = 0; i < before.count && i < after.count; i++) {
        const struct perturbation *a = &before.list[i], *b = &after.list[i];
        CHECK_TEXT(b->name, a->name);
        CHECK_RELATIVE(b->amount, a->amount * pow(2, length_of(a)), 1e-12, a->name);
        CHECK_NEAR(b->pivot, 2 * a->pivot, 1e-12, a->name);
    }
    arena_free(&arena);
}

/* Where what was at this surface, or behind it, is now. */
static size_t turned(const struct perturbation *one, size_t surface)
{
    const bool is_behind = one->kind == TOLERANCE_THICKNESS || one->kind == TOLERANCE_AIR ||
                           one->kind == TOLERANCE_INDEX || one->kind == TOLERANCE_ABBE;
    return SURFACES - 1 - surface - (is_behind ? 1 : 0);
}

static double length_from(const struct lens *lens, size_t first, size_t last)
{
    double sum = 0;
    for (size_t i = first; i < last; i++) {
        sum += lens->surfaces[i].thickness.value.hi;
    }
    return sum;
}

/* Is it the same error of the lens turned around? */
static bool is_turned(const struct lens *lens, const struct perturbation *a,
                      const struct perturbation *b)
{
    const bool is_whole = a->kind == TOLERANCE_FOCUS;
    const bool has_pivot = a->kind == TOLERANCE_ELEMENT_TILT;
    const double pivot = length_from(lens, a->first, a->last) - a->pivot;
    return a->kind == b->kind && a->axis == b->axis && a->what.kind == b->what.kind &&
           b->first == (is_whole ? 0 : turned(a, a->last)) &&
           b->last == (is_whole ? 0 : turned(a, a->first)) &&
           a->spread.distribution == b->spread.distribution &&
           fabs(a->amount - b->amount) <= 1e-12 * a->amount &&
           (!has_pivot || fabs(b->pivot - pivot) <= 1e-12);
}

static void test_turned(void)
{
    struct arena arena = {0};
    struct error error = {.code = ERROR_NONE};
    const struct lens lens = lens_of(content, &arena);
    const struct lens *back = lens_reversed(&lens, &arena, &error);
    CHECK(back != NULL);
    const struct perturbations before = errors_of(&lens, &arena), after = errors_of(back, &arena);
    CHECK(before.count == after.count);
    for (size_t i = 0; i < before.count; i++) {
        size_t found = 0;
        for (size_t k = 0; k < after.count; k++) {
            found += is_turned(&lens, &before.list[i], &after.list[k]);
        }
        CHECK(found == 1);
        if (found != 1) {
            printf("%s: %zu\n", before.list[i].name, found);
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_scaled();
    test_turned();
    return check_report();
}
