/* tests/unit/test_search.c - rays at strong aspheres are met, however Newton's method fares. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "random_aspheres.h"
#include "trace/kernel/search.h"
#include "trace/verify.h"
#include "trace_one.h"

/* A strong asphere whose start lies beyond the sheet of the vertex; found by 113-bit bisection. */
static void test_other_sheet(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    const char *text = "medium 1.5\nsurface 12.85 - air - k=10.9 A2=0.0653 A4=-0.0079\n";
    struct system_options options = system_options_default();
    CHECK(lens_read("test", text_of(text), NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &system, &error));
    double length = sqrt(0.4338 * 0.4338 + 0.901 * 0.901);
    struct ray start = {.point = {0, 2.3, -1.54}, .cosine = {0, 0.4338 / length, 0.901 / length}};
    struct ray end = trace_one(&system, &start);
    CHECK(end.status == RAY_OK);
    CHECK_NEAR(end.point[1], 3.2172307, 5e-8, "y");
    CHECK_NEAR(end.point[2], 0.3650827, 5e-8, "z");
    struct verification check = verify_ray(&system, &start, &end);
    CHECK(check.ray.status == RAY_OK && check.point_error < 1e-14 && check.cosine_error < 1e-14);
    arena_free(&arena);
}

/* From far away, where steps of a ray are lost in its numbers: met, or an end is found. */
static void test_afar(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    const char *text = "medium 1.5\nsurface 12.85 - air - k=10.9 A2=0.0653 A4=-0.0079\n";
    struct system_options options = system_options_default();
    CHECK(lens_read("test", text_of(text), NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &system, &error));
    for (double z = -1e3; z > -1e17; z *= 10) {
        const struct ray start = {.point = {0, 1, z}, .cosine = {0, 0, 1}};
        const struct ray slant = {.point = {0, 1 + 1e-9 * z, z}, .cosine = {0, 1e-9, 1}};
        const struct ray back = {.point = {0, 1, -z}, .cosine = {0, 0, -1}};
        const struct ray end = trace_one(&system, &start);
        CHECK(end.status == RAY_OK);
        CHECK_NEAR(end.point[1], 1, 0, "the height of a parallel ray");
        CHECK(verify_ray(&system, &start, &end).ray.status == RAY_OK);
        verify_ray(&system, &slant, &end);
        verify_ray(&system, &back, &end);
    }
    arena_free(&arena);
}

/* Rays along the axis at a surface as deep as a kilometre: its sag, by the formula of the file. */
static void test_along_axis(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct system system;
    struct error error;
    const char *text = "surface 10 5 1.5 10 k=-1e10 A4=-1e3 A20=1e-300\n";
    struct system_options options = system_options_default();
    CHECK(lens_read("test", text_of(text), NULL, &arena, &lens, &error));
    CHECK(system_compile(&lens, 0.55, &options, &arena, &system, &error));
    for (double y = 0.0625; y < 5; y += 0.0625) {
        const struct ray start = {.point = {0, y, -7}, .cosine = {0, 0, 1}};
        const struct ray end = trace_one(&system, &start);
        const long double u = (long double)y * y, c = 0.1L, k = -1e10L;
        const long double sag = c * u / (1 + sqrtl(1 - (1 + k) * c * c * u)) - 1e3L * u * u;
        CHECK(end.status != RAY_MISS && end.status != RAY_NOT_CONVERGED);
        CHECK_NEAR(end.point[1], y, 0, "height");
        CHECK_NEAR(end.point[2] / (double)sag, 1, 4e-16, "sag");
    }
    arena_free(&arena);
}

/* Sums without signs of a step with all of its terms, term by term: of sags, and of what bends. */
static double sag_bound(const struct step *step, double r)
{
    double sum = fabs(step->c) * r * r;
    for (int i = 1; i <= STEP_TERMS; i++) {
        sum += fabs(step->coefficient[i - 1]) * pow(r, 2 * i);
        sum += fabs(step->odd[i - 1]) * pow(r, 2 * i - 1);
    }
    return sum;
}

static double slope_bound(const struct step *step, double r)
{
    double sum = fabs(step->c) * r;
    for (int i = 1; i <= STEP_TERMS; i++) {
        sum += 2 * i * fabs(step->coefficient[i - 1]) * pow(r, 2 * i - 1);
        sum += i > 1 ? (2 * i - 1) * fabs(step->odd[i - 1]) * pow(r, 2 * i - 2) : 0;
    }
    return sum;
}

/*
 * What of a surface is searched: powers of two up to where no slope is above 1; the rim 1000 times
 * that, or where the highest power is 100 radii beyond all others, by fifths; the conic's end; the
 * clear aperture.
 */
static void test_prepared(void)
{
    unsigned long long state = 5;
    for (int i = 0; i < 400; i++) {
        const bool is_odd = i % 4 == 3, has_inner = i % 5 == 4;
        struct step step = {.kind = is_odd ? STEP_ODD : STEP_ASPHERE,
                            .c = i % 3 == 0 ? 0 : chance_between(&state, -0.3, 0.3),
                            .one_k = i % 2 == 0 ? 0 : chance_between(&state, -1, 2),
                            .clear2 =
                                i % 7 == 0 ? chance_between(&state, 1, 1e3) : (double)INFINITY,
                            .terms = i % 3 == 0 ? 1 + i % STEP_TERMS : i % 4,
                            .inner = has_inner ? chance_between(&state, 0.1, 20) : 0};
        for (int k = 0; k < STEP_TERMS; k++) {
            const double size = pow(10, chance_between(&state, -3, 1)) * pow(8, -2 * k);
            step.coefficient[k] = k < step.terms ? (k % 2 == 0 ? size : -size) : 0;
            step.slope[k] = (k + 1) * step.coefficient[k];
            step.odd[k] = is_odd ? (k % 3 == 0 ? -size : size) : 0;
            step.odd_slope[k] = (k + 0.5) * step.odd[k];
        }
        struct step ready = step;
        search_prepare(&ready);
        double inner = has_inner ? step.inner : 0x1p-100;
        while (!has_inner && inner < 0x1p100 && slope_bound(&step, 2 * inner) <= 1) {
            inner *= 2;
        }
        double rim = 1000 * inner;
        for (; !is_odd && step.terms > 0 && rim > 2 * inner; rim /= 1.25) {
            const double r = rim / 1.25;
            const double highest = fabs(step.coefficient[step.terms - 1]) * pow(r, 2 * step.terms);
            if (2 * highest - sag_bound(&step, r) <= 100 * r) {
                break;
            }
        }
        const double conic = step.one_k * step.c * step.c;
        const double end = conic > 0 ? 1 / sqrt(conic) : (double)INFINITY;
        const double least = fmin(rim, fmin(end, sqrt(step.clear2)));
        CHECK_RELATIVE(ready.rim2, least * least, 1e-14, "rim");
        CHECK_RELATIVE(ready.inner, fmin(inner, least), 1e-15, "inner");
        const double depth = sag_bound(&step, least);
        CHECK(ready.depth >= depth && ready.depth <= depth * (1 + 1.5e-9) + 1e-300);
    }
}

int main(void)
{
    static const struct strength strengths[] = {{0.8, 0.4, 4, 0.7}, {2, 1.5, 15, 1}};
    test_prepared();
    test_other_sheet();
    test_afar();
    test_along_axis();
    for (size_t i = 0; i < sizeof strengths / sizeof strengths[0]; i++) {
        struct asphere_tally tally = {0};
        unsigned long long state = 1 + i;
        for (int k = 0; k < 20; k++) {
            CHECK(try_asphere(&state, &strengths[i], 600, ASPHERE_RAYS, &tally));
        }
        CHECK(tally.lost == 0 && tally.wrong == 0 && tally.unconverged == 0);
        CHECK(tally.worst < 1e-11);
        printf("aspheres: %zu rays, %zu met, %zu elsewhere than first, worst %.2g of the size\n",
               tally.rays, tally.met, tally.differ, tally.worst);
    }
    return check_report();
}
