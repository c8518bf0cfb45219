/* tests/unit/test_fifth_order.c - fifth-order aberrations against exact rays and a textbook. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "double_gauss.h"
#include "file/lens_file.h"
#include "optics/fifth_order.h"
#include "optics/wavelength.h"
#include "quad.h"
#include "trace/system.h"

/* A lens, its third and fifth order, and its exact rays. */
struct bench {
    struct lens lens;
    struct paraxial_system paraxial;
    struct first_order first;
    struct conjugate_object object;
    struct seidel_question question;
    struct seidel_rays rays;
    struct seidel third;
    struct fifth_order fifth;
    struct system system;
};

static bool bench_make(const char *text, struct arena *arena, struct bench *bench,
                       struct error *error)
{
    struct paraxial_trace trace;
    struct lens_warnings warnings;
    struct lens *lens = &bench->lens;
    const struct system_options options = system_options_default();
    if (!lens_read("test", text_of(text), NULL, arena, lens, error) ||
        !lens_check(lens, arena, &warnings, error) ||
        !paraxial_compile(lens, WAVELENGTH_D, SECTION_Y, arena, &bench->paraxial, error) ||
        !system_compile(lens, WAVELENGTH_D, &options, arena, &bench->system, error)) {
        return false;
    }
    const struct aperture_setting aperture = lens_aperture(lens);
    bench->object = lens_object(lens);
    bench->question = (struct seidel_question){
        .lens = lens,
        .system = &bench->paraxial,
        .section = SECTION_Y,
        .object = &bench->object,
        .first = &bench->first,
        .field_kind = lens->field_count > 0 ? lens->field_kind : FIELD_NONE,
        .field = lens->field_count > 0 ? lens->fields[0].at[1].value.hi : (double)NAN};
    const struct seidel_question *question = &bench->question;
    paraxial_trace(&bench->paraxial, &trace);
    first_order_compute(&bench->paraxial, &trace, &bench->object, &bench->first);
    return first_order_aperture(&bench->first, &bench->object, &aperture, question->field_kind,
                                question->field, error) &&
           seidel_object_rays(question, &bench->rays, error) &&
           seidel_compute(question, arena, &bench->third, error) &&
           fifth_order_compute(question, arena, &bench->fifth, error);
}

/* -------- exact rays -------- */

/* Spheres, conics, aspheres; mirrors; objects near and far; the stop before, within and behind. */
static const struct {
    const char *name, *text;
} lenses[] = {
    {"singlet, stop in front", "object inf\naperture epd 10\nfield angle 10\nstop - 12 air 10\n"
                               "surface 50 4 1.5 -\nsurface -80 0 air -\n"},
    {"singlet, stop behind",
     "object inf\naperture epd 10\nfield angle 10\nsurface 40 4 1.5 -\nsurface 300 8 air -\n"
     "stop - 30 air 10\n"},
    {"Cooke triplet",
     "object inf\naperture epd 10\nfield angle 12\n"
     "surface 22.01359 3.25896 1.62041/60.32 19\nsurface -435.76044 6.00755 air 18\n"
     "surface -22.21328 0.99998 1.62004/36.37 11\nsurface 20.29192 2.2 air 10\n"
     "surface - 2.55041 air 10 stop\nsurface 79.68360 2.95208 1.62041/60.32 15\n"
     "surface -18.39533 42.20778 air 16\n"},
    {"double Gauss", "object inf\naperture epd 25\nfield angle 10\n" DOUBLE_GAUSS("34.2")},
    {"double Gauss at 1500 mm",
     "object 1500\naperture stop\nfield height 200\n" DOUBLE_GAUSS("16")},
    {"conics", "object inf\naperture epd 16\nfield angle 8\nsurface 50 5 1.6 - k=-0.7\n"
               "stop - 3 1.6 10\nsurface -90 60 air - k=2.5\n"},
    {"aspheres A4, A6",
     "object 120\naperture na 0.06\nfield height 10\nsurface 40 5 1.5 - A4=-1e-5 A6=2e-8\n"
     "surface -200 3 air - k=1 A4=4e-6 A6=-3e-8\nstop - 6 air 10\n"
     "surface 300 4 1.7 - A4=2e-5\nsurface -60 0 air - A6=5e-9\n"},
    {"vertex curvature by A2",
     "object inf\naperture epd 10\nfield angle 6\nsurface - 4 1.5 - A2=0.01 A6=1e-8 stop\n"
     "surface -70 0 air - A2=-0.002\n"},
    {"Newton's mirror",
     "object inf\naperture epd 60\nfield angle 2\nstop - 150 air 60\nsurface -400 0 mirror -\n"},
    {"Cassegrain telescope",
     "object inf\naperture epd 200\nfield angle 0.8\nsurface -1000 -375 mirror - k=-1.1 stop\n"
     "surface -300 0 mirror - k=-2.5 A4=1e-9 A6=1e-14\n"},
    {"Mangin mirror", "object 900\naperture stop\nfield height 30\nsurface -150 6 1.5 -\n"
                      "surface -220 -6 mirror 60 stop\nsurface -150 -80 air -\n"},
    {"telecentric object",
     "object 60 telecentric\naperture na 0.06\nfield height 4\nsurface 60 4 1.6 -\n"
     "surface -60 40 air -\nstop - 40 air 10\nsurface 80 4 1.5 -\nsurface -50 0 air -\n"},
    {"Galilean telescope", "object inf\naperture epd 16\nfield angle 1\nsurface 80 6 1.5 - stop\n"
                           "surface -400 101.7453426970445207189186476171016693115234375 air -\n"
                           "surface -30 2 1.6 -\nsurface 40 0 air -\n"},
    {"image in glass, of an object in water",
     "medium 1.333\nobject 100\naperture na 0.08\nfield height 6\nsurface 30 5 1.6 - stop\n"
     "surface -70 4 air -\nsurface 25 30 1.5 - k=-0.5\n"},
};

/* n (y V - u Y) of an exact ray and the marginal ray, in the plane z = 0 of a vertex. */
static void exact_invariant(const struct precise_ray *ray, real n, real y, real v, real out[2])
{
    for (int k = 0; k < 2; k++) {
        const real slope = ray->p[k] / ray->p[2], height = ray->x[k] - ray->x[2] * slope;
        out[k] = n * y * slope - v * height;
    }
}

/* The third and the fifth order of a ray, by the sums: x and y. */
static void by_orders(const double S[SEIDEL_TERMS], const double F[FIFTH_TERMS],
                      const real pupil[2], real field, real third[2], real fifth[2])
{
    const real x = pupil[0], y = pupil[1], a = x * x + y * y, h = field;
    const real TSC = S[SEIDEL_SPHERICAL] / 2, CC = S[SEIDEL_COMA] / 2;
    const real TAC = S[SEIDEL_ASTIGMATISM] / 2, TPC = S[SEIDEL_PETZVAL] / 2;
    third[0] = TSC * a * x + CC * h * 2 * x * y + (TAC + TPC) * h * h * x;
    third[1] = TSC * a * y + CC * h * (a + 2 * y * y) + (3 * TAC + TPC) * h * h * y +
               S[SEIDEL_DISTORTION] / 2 * h * h * h;
    /* cos 2 theta rho^2 = y^2 - x^2, sin 2 theta rho^2 = 2 x y */
    fifth[0] = F[FIFTH_B5] * a * a * x + F[FIFTH_F2] * a * 2 * x * y * h +
               (F[FIFTH_M2] * a + F[FIFTH_M3] * y * y) * x * h * h +
               F[FIFTH_N3] * 2 * x * y * h * h * h +
               (F[FIFTH_C5] + F[FIFTH_PI5]) * x * h * h * h * h;
    fifth[1] = F[FIFTH_B5] * a * a * y + (F[FIFTH_F1] * a + F[FIFTH_F2] * (y * y - x * x)) * a * h +
               (F[FIFTH_M1] * a + F[FIFTH_M3] * y * y) * y * h * h +
               (F[FIFTH_N1] * a + F[FIFTH_N2] * (y * y - x * x)) * h * h * h +
               (5 * F[FIFTH_C5] + F[FIFTH_PI5]) * y * h * h * h * h +
               F[FIFTH_E5] * h * h * h * h * h;
}

/* What third and fifth order leave of a ray at a share of pupil and field, as a length. */
static double left_over(const struct bench *bench, const double F[FIFTH_TERMS],
                        const double pupil[2], double field, double share)
{
    const struct seidel_rays *rays = &bench->rays;
    const real at[2] = {(real)(pupil[0] * share), (real)(pupil[1] * share)};
    const real h[2] = {0, (real)(field * share)}, n = precise_of(bench->paraxial.index[0]);
    struct precise_ray ray = {.status = RAY_OK};
    real root = 1, before[2], after[2], third[2], fifth[2];
    for (int k = 0; k < 2; k++) {
        ray.x[k] = at[k] * precise_of(rays->y) + h[k] * precise_of(rays->chief_y);
        ray.p[k] = (at[k] * precise_of(rays->v) + h[k] * precise_of(rays->chief_v)) / n;
        root += ray.p[k] * ray.p[k];
    }
    root = n / precise_root(root);
    ray.p[0] *= root;
    ray.p[1] *= root;
    ray.p[2] = root;
    exact_invariant(&ray, n, precise_of(rays->y), precise_of(rays->v), before);
    CHECK(precise_trace(&ray, &bench->system));
    /* the marginal ray in as many digits */
    real y = precise_of(rays->y), v = precise_of(rays->v);
    for (size_t i = 0; i < bench->paraxial.count; i++) {
        v -= y * precise_of(bench->paraxial.surfaces[i].power);
        y += v * precise_of(bench->paraxial.surfaces[i].reduced);
    }
    exact_invariant(&ray, precise_of(bench->paraxial.index[bench->paraxial.count]), y, v, after);
    by_orders(bench->third.total.sum, F, at, h[1], third, fifth);
    real square = 0;
    for (int k = 0; k < 2; k++) {
        const real rest = before[k] - after[k] - third[k] - fifth[k];
        square += rest * rest;
    }
    return (double)precise_root(square);
}

/* How the rest falls: log2 of it at a sixteenth over that at a thirty-second. */
static double falls_by(const struct bench *bench, const double F[FIFTH_TERMS],
                       const double pupil[2], double field)
{
    return log2(left_over(bench, F, pupil, field, 0.0625) /
                left_over(bench, F, pupil, field, 0.03125));
}

enum { RAYS = 6 };
static const double pupils[RAYS][2] = {{0, 1},      {0, -0.8},  {1, 0},
                                       {0.6, -0.7}, {0.4, 0.8}, {-0.7, 0.2}};
static const double fields[RAYS] = {0, 1, 0.9, 1, -0.7, 0.5};

/* What third and fifth order leave falls as the seventh power; with any sign turned it does not. */
static void check_exact(void)
{
    for (size_t i = 0; i < sizeof lenses / sizeof lenses[0]; i++) {
        struct arena arena = {0};
        struct bench bench;
        struct error error = {.code = ERROR_NONE};
        const bool made = bench_make(lenses[i].text, &arena, &bench, &error);
        CHECK(made);
        if (!made) {
            printf("%s: %s\n", lenses[i].name, error.message);
            continue;
        }
        const double *F = bench.fifth.total.sum;
        for (size_t k = 0; k < RAYS; k++) {
            CHECK_NEAR(falls_by(&bench, F, pupils[k], fields[k]), 7, 0.1, lenses[i].name);
        }
        for (size_t term = 0; term < FIFTH_TERMS; term++) {
            double turned[FIFTH_TERMS];
            memcpy(turned, F, sizeof turned);
            turned[term] = -turned[term];
            bool seen = false;
            for (size_t k = 0; k < RAYS; k++) {
                seen = seen || fabs(falls_by(&bench, turned, pupils[k], fields[k]) - 7) > 0.5;
            }
            CHECK(seen);
        }
        arena_free(&arena);
    }
}

/* -------- a textbook -------- */

/*
 * [Smith08] tables 6.4 and 6.5 (p. 121), transverse, of the triplet of p. 119: SK4, SF2, an axial
 * ray of 14.6 and a principal ray of slope 0.21. PTZ5 of surface 1 is printed negative there, which
 * its own C10 and C11, and the sum of the column, contradict.
 */
static const char smith_triplet[] =
    "object inf\naperture epd 29.2\nfield angle 11.859779120947978\n"
    "surface 37.40 5.90 1.61272 -\nsurface -341.48 12.93 air -\n"
    "surface -42.65 2.50 1.64769 -\nsurface 36.40 2.00 air -\nstop - 9.85 air 30\n"
    "surface 204.52 5.90 1.61272 -\nsurface -37.05 77.405 air -\n";

/* Of a surface, 0 is the sum: C1 .. C12 where table 6.5 gives them. */
static const struct {
    size_t surface;
    double SA5, CMA5, AST5, PTZ5, DIS5;
    double C[12]; /* all 0: not given */
} smith_rows[] = {
    {1,
     -0.061946,
     -0.001202,
     0.000323,
     0.004476,
     0.000474,
     {-0.061946, -0.007324, -0.001202, -0.018538, -0.018301, 0.033213, 0.006375, 0.008183, 0.006542,
      0.006092, 0.004799, 0.000474}},
    {2,
     -0.154199,
     0.189546,
     -0.060252,
     -0.007701,
     0.056437,
     {-0.154199, 0.314507, 0.189546, -0.468290, -0.169776, -0.243766, 0.361953, 0.248751, 0.134015,
      -0.308963, -0.067954, 0.056437}},
    {3,
     0.394409,
     -0.354457,
     0.033863,
     0.007252,
     -0.026296,
     {0.394409, -0.574065, -0.354457, 0.624135, 0.226035, 0.280642, -0.313680, -0.193903, -0.109803,
      0.176565, 0.041115, -0.026296}},
    {4,
     0.110416,
     0.055693,
     0.021076,
     0.016469,
     0.052491,
     {0.110416, 0.108491, 0.055693, 0.094590, 0.049073, -0.066253, 0.017082, 0.009050, 0.025061,
      0.121850, 0.037545, 0.052491}},
    {6, -0.015016, -0.022169, -0.023359, -0.004057, -0.053149, {0}},
    {7, -0.148238, 0.092127, 0.011081, 0.008735, -0.014342, {0}},
    {0, 0.125426, -0.040462, -0.017268, 0.025173, 0.015616, {0}},
};

static void check_smith(void)
{
    static const char *const names[] = {
        "Smith's triplet: C1",  "Smith's triplet: C2",  "Smith's triplet: C3",
        "Smith's triplet: C4",  "Smith's triplet: C5",  "Smith's triplet: C6",
        "Smith's triplet: C7",  "Smith's triplet: C8",  "Smith's triplet: C9",
        "Smith's triplet: C10", "Smith's triplet: C11", "Smith's triplet: C12"};
    const double rounded = 2.5e-6; /* what half a unit of the last digit of an index makes */
    struct arena arena = {0};
    struct bench bench;
    struct error error = {.code = ERROR_NONE};
    CHECK(bench_make(smith_triplet, &arena, &bench, &error));
    check_source("smith-engineering", "mm");
    for (size_t i = 0; i < sizeof smith_rows / sizeof smith_rows[0]; i++) {
        const size_t surface = smith_rows[i].surface;
        const struct fifth_order_part *part =
            surface == 0 ? &bench.fifth.total : &bench.fifth.parts[surface - 1];
        double F[FIFTH_TERMS];
        for (size_t k = 0; k < FIFTH_TERMS; k++) {
            F[k] = part->sum[k] / bench.third.slope;
        }
        CHECK_NEAR(F[FIFTH_B5], smith_rows[i].SA5, rounded, "Smith's triplet: SA5");
        CHECK_NEAR(F[FIFTH_F2], smith_rows[i].CMA5, rounded, "Smith's triplet: CMA5");
        CHECK_NEAR(F[FIFTH_C5], smith_rows[i].AST5, rounded, "Smith's triplet: AST5");
        CHECK_NEAR(F[FIFTH_PI5], smith_rows[i].PTZ5, rounded, "Smith's triplet: PTZ5");
        CHECK_NEAR(F[FIFTH_E5], smith_rows[i].DIS5, rounded, "Smith's triplet: DIS5");
        const double C5 = F[FIFTH_C5], PI5 = F[FIFTH_PI5];
        F[FIFTH_C5] = 5 * C5 + PI5;
        F[FIFTH_PI5] = C5 + PI5;
        for (size_t k = 0; k < FIFTH_TERMS && smith_rows[i].C[0] != 0; k++) {
            CHECK_NEAR(F[k], smith_rows[i].C[k], rounded, names[k]);
        }
    }
    check_source(NULL, "");
    arena_free(&arena);
}

/* -------- parts -------- */

static void check_parts(void)
{
    static const char thick[] = "object 200\naperture na 0.1\nfield height 10\nstop - 5 air 10\n"
                                "thick 60 4 air -\n";
    static const char odd[] = "aperture epd 5\nfield angle 3\nsurface 50 0 1.5 - stop A5=1e-5\n";
    struct arena arena = {0};
    struct bench bench;
    struct error error = {.code = ERROR_NONE};
    CHECK(bench_make(lenses[2].text, &arena, &bench, &error));
    for (size_t k = 0; k < FIFTH_TERMS; k++) {
        const struct fifth_order_part *parts = bench.fifth.parts;
        double sum = 0;
        for (size_t i = 0; i < bench.paraxial.count; i++) {
            sum += parts[i].sum[k];
        }
        CHECK(sum == bench.fifth.total.sum[k]);
        /* nothing comes before the first surface; the second has what that one makes */
        CHECK(parts[0].sum[k] == parts[0].intrinsic[k] && parts[0].sum[k] != 0);
        CHECK(fabs(parts[1].sum[k] - parts[1].intrinsic[k]) > 1e-3 * fabs(parts[1].sum[k]));
    }
    /* without a field what the marginal ray alone makes; a thick lens adds nothing */
    CHECK(bench_make("aperture epd 5\nsurface 50 0 1.5 - stop\n", &arena, &bench, &error));
    CHECK(bench.fifth.total.sum[FIFTH_B5] != 0 && isnan(bench.fifth.total.sum[FIFTH_F1]) &&
          isnan(bench.fifth.total.sum[FIFTH_E5]));
    CHECK(bench_make(thick, &arena, &bench, &error));
    for (size_t k = 0; k < FIFTH_TERMS; k++) {
        CHECK(bench.fifth.total.sum[k] == 0);
    }
    CHECK(!bench_make(odd, &arena, &bench, &error));
    CHECK_TEXT(error.message,
               "surface 1: A5 r^5 makes an aberration of lower order than the fifth");
    arena_free(&arena);
}

/* What the second surface adds by itself is what it adds to light that arrives so. */
static void check_intrinsic(void)
{
    /* behind the first plane a ray of 1/3 in glass has slope 1/3 / 1.5, to first order */
    static const char both[] = "object 90\naperture na 0.1\nfield height 6\n"
                               "stop - 0 1.5 20\nsurface -40 60 air -\n";
    static const char alone[] = "medium 1.5\nobject 135\naperture stop\nfield height 6\n"
                                "stop - 0 1.5 20\nsurface -40 60 air -\n";
    struct arena arena = {0};
    struct bench one, other;
    struct error error = {.code = ERROR_NONE};
    CHECK(bench_make(both, &arena, &one, &error));
    CHECK(bench_make(alone, &arena, &other, &error));
    const double scale = one.rays.y.hi / other.rays.y.hi; /* of the apertures */
    static const int powers[FIFTH_TERMS] = {6, 5, 5, 4, 4, 4, 3, 3, 3, 2, 2, 1};
    for (size_t k = 0; k < FIFTH_TERMS; k++) {
        const double expected = other.fifth.parts[1].sum[k] * pow(scale, powers[k]);
        CHECK_NEAR(one.fifth.parts[1].intrinsic[k], expected, 1e-12 * fabs(expected) + 1e-20,
                   "intrinsic");
    }
    arena_free(&arena);
}

int main(void)
{
    check_exact();
    check_smith();
    check_parts();
    check_intrinsic();
    return check_report();
}
