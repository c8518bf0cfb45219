/* tests/unit/test_distortion_fit.c - models of distortion, by their published formulas. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/distortion_fit.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"

static bool fit_picture(const struct distortion_profile *profile, enum distortion_model model,
                        double focal, struct arena *arena, struct distortion_fit *fit)
{
    const struct distortion_question question = {model, {36, 24, NAN}, focal};
    struct error error;
    return distortion_fit(profile, &question, arena, fit, &error);
}

/* -------- published formulas, each written out as its source has it -------- */

static double brown(double r, const double *k)
{
    return r * (1 + k[0] * pow(r, 2) + k[1] * pow(r, 4) + k[2] * pow(r, 6));
}

static double fisheye(double t, const double *k)
{
    return t * (1 + k[0] * pow(t, 2) + k[1] * pow(t, 4) + k[2] * pow(t, 6) + k[3] * pow(t, 8));
}

static double poly3(double r, const double *k)
{
    return r * (1 - k[0] + k[0] * r * r);
}

static double poly5(double r, const double *k)
{
    return r * (1 + k[0] * pow(r, 2) + k[1] * pow(r, 4));
}

static double ptlens(double r, const double *k)
{
    return r * (k[0] * pow(r, 3) + k[1] * r * r + k[2] * r + 1 - k[0] - k[1] - k[2]);
}

/* How much smaller the ideal image counts where r = 1 stays in its place. */
static double shrunk(enum distortion_model model, const double *k)
{
    return model == MODEL_POLY3 ? 1 - k[0] : model == MODEL_PTLENS ? 1 - k[0] - k[1] - k[2] : 1;
}

/* -------- pictures that a model distorted -------- */

enum { COUNT = 128 };

struct picture {
    double ideal[COUNT], real[COUNT], weight[COUNT];
    struct distortion_profile profile;
};

/* Of a lens of 30 mm, as far as about the corner. */
static void distort(struct picture *picture, enum distortion_model model, const double *k,
                    double (*formula)(double r, const double *k))
{
    const double focal = 30;
    const double unit = model == MODEL_BROWN                              ? 1
                        : model == MODEL_OPENCV || model == MODEL_FISHEYE ? focal
                                                                          : 12;
    for (size_t i = 0; i < COUNT; i++) {
        const double in = 21.6 * (double)(i + 1) / COUNT; /* mm */
        const double out = unit * formula(in / unit / shrunk(model, k), k);
        picture->ideal[i] = (model == MODEL_BROWN ? out : in) / focal;
        picture->real[i] = model == MODEL_BROWN ? in : out;
        picture->weight[i] = 1;
    }
    picture->profile = (struct distortion_profile){.count = COUNT,
                                                   .ideal = picture->ideal,
                                                   .real = picture->real,
                                                   .weight = picture->weight,
                                                   .focal = focal,
                                                   .reached = picture->real[COUNT - 1]};
}

static const struct {
    enum distortion_model model;
    double (*formula)(double r, const double *k);
    double k[MODEL_TERMS];
} cases[] = {
    {MODEL_BROWN, brown, {2e-4, -3e-7, 1e-10}},
    {MODEL_OPENCV, brown, {-0.11, 0.05, -0.02}},
    {MODEL_FISHEYE, fisheye, {0.03, -0.02, 0.005, -0.001}},
    {MODEL_POLY3, poly3, {-0.021}},
    {MODEL_POLY3, poly3, {0.015}},
    {MODEL_POLY5, poly5, {-0.03, 0.004}},
    {MODEL_PTLENS, ptlens, {0.012, -0.04, 0.018}},
};

/* The coefficients come back, with the given focal length and with one to be found. */
static void test_recovered(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct model_facts *facts = &distortion_models[cases[i].model];
        for (int is_free = 0; is_free < 2; is_free++) {
            struct arena arena = {0};
            struct picture picture;
            struct distortion_fit fit;
            distort(&picture, cases[i].model, cases[i].k, cases[i].formula);
            CHECK(fit_picture(&picture.profile, cases[i].model, is_free ? (double)NAN : 30, &arena,
                              &fit));
            CHECK_NEAR(fit.focal, 30, 1e-9, facts->word.word);
            const struct distortion_polynomial *published = &fit.ways[facts->way];
            for (size_t j = 0; j < facts->terms; j++) {
                CHECK_NEAR(published->published[j], cases[i].k[j], 1e-8 * fabs(cases[i].k[j]),
                           facts->names[j]);
            }
            CHECK(published->rms < 1e-11 && published->largest < 1e-10);
            arena_free(&arena);
        }
    }
}

/* There and back by the fitted inverse: as near as its residual says. */
static void test_round_trip(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct picture picture;
        struct distortion_fit fit;
        distort(&picture, cases[i].model, cases[i].k, cases[i].formula);
        CHECK(fit_picture(&picture.profile, cases[i].model, 30, &arena, &fit));
        double largest[DISTORTION_WAYS] = {0}, sum[DISTORTION_WAYS] = {0};
        for (size_t n = 0; n < COUNT; n++) {
            const double ideal = 30 * picture.ideal[n], real = picture.real[n];
            for (int way = 0; way < DISTORTION_WAYS; way++) {
                /* by the published coefficients, in the test's own formula */
                const double *k = fit.ways[way].published;
                const double in = way == WAY_DISTORT ? ideal : real;
                const double out = way == WAY_DISTORT ? real : ideal;
                const double made =
                    fit.unit * cases[i].formula(in / fit.unit / shrunk(cases[i].model, k), k);
                largest[way] = fmax(largest[way], fabs(made - out));
                sum[way] += (made - out) * (made - out);
            }
        }
        for (int way = 0; way < DISTORTION_WAYS; way++) {
            CHECK_NEAR(fit.ways[way].largest, largest[way], 1e-11, "largest residual");
            CHECK_NEAR(fit.ways[way].rms, sqrt(sum[way] / COUNT), 1e-11, "rms residual");
            CHECK(fit.ways[way].largest < 0.1); /* mm: an inverse of the same few terms */
        }
        arena_free(&arena);
    }
}

static void test_reduced(void)
{
    static const double ptlens_k[] = {0.02, -0.05, 0.01};
    const double d = 1 - 0.02 + 0.05 - 0.01;
    const double reduced[] = {0.02 / pow(d, 4), -0.05 / pow(d, 3), 0.01 / pow(d, 2)};
    double published[MODEL_TERMS];
    CHECK(distortion_publish(MODEL_PTLENS, reduced, published));
    for (size_t j = 0; j < 3; j++) {
        CHECK_RELATIVE(published[j], ptlens_k[j], 1e-14, "there and back");
    }
    /* k1/(1 - k1)^3 is never below -4/27 */
    CHECK(distortion_publish(MODEL_POLY3, (double[]){-0.148}, published));
    CHECK(!distortion_publish(MODEL_POLY3, (double[]){-0.149}, published));
}

/* -------- lenses -------- */

static bool trace_text(const char *text, enum projection projection, double radius,
                       struct arena *arena, struct distortion_profile *profile, struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct distortion_map *map = ARENA_NEW(arena, struct distortion_map);
    const struct setup_question asked = {.lens = lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_PARAXIAL};
    return lens_read("test", text_of(text), NULL, arena, lens, error) &&
           setup_open(&asked, arena, setup, error) && setup_place_image(setup, &plane, error) &&
           distortion_open(setup, 0, projection, arena, map, error) &&
           distortion_trace(map, radius, arena, profile, error);
}

#define THIN "object inf\nfield angle 20\nstop - 10 air 4\nthick 30 0 air "

static void test_trace(void)
{
    struct arena arena = {0};
    struct distortion_profile profile;
    struct distortion_fit fit;
    struct error error;
    CHECK(trace_text(THIN "90\n", RECTILINEAR, 21.6, &arena, &profile, &error));
    CHECK_NEAR(profile.reached, 21.6, 1e-12, "as far as was asked");
    CHECK_NEAR(profile.focal, 30, 1e-7, "the focal length");
    double sum = 0;
    for (size_t i = 0; i < profile.count; i++) {
        CHECK_NEAR(profile.real[i], 30 * profile.ideal[i], 1e-12, "no distortion");
        sum += profile.weight[i];
    }
    CHECK_NEAR(sum, 21.6, 0.2, "the radius in all");
    for (int model = 0; model < DISTORTION_MODELS; model++) {
        if (model != MODEL_FISHEYE) {
            CHECK(fit_picture(&profile, (enum distortion_model)model, 30, &arena, &fit));
            CHECK(fit.ways[0].largest < 1e-12 && fit.ways[1].largest < 1e-12);
        }
    }
    /* tan t = t + t^3/3 + 2 t^5/15 + ...: least squares give the series for small angles */
    CHECK(trace_text(THIN "-\n", EQUIDISTANT, 4, &arena, &profile, &error));
    CHECK(fit_picture(&profile, MODEL_FISHEYE, 30, &arena, &fit));
    CHECK_NEAR(fit.ways[WAY_DISTORT].published[0], 1.0 / 3, 1e-6, "1/3");
    CHECK_NEAR(fit.ways[WAY_DISTORT].published[1], 2.0 / 15, 1e-3, "2/15");
    /* atan x = x - x^3/3 + x^5/5 */
    CHECK_NEAR(fit.ways[WAY_UNDISTORT].published[0], -1.0 / 3, 1e-6, "-1/3");
    CHECK_NEAR(fit.ways[WAY_UNDISTORT].published[1], 1.0 / 5, 1e-3, "1/5");
    arena_free(&arena);
}

/* Where the field ends. */
static void test_ends(void)
{
    struct arena arena = {0};
    struct distortion_profile profile;
    struct error error = {0};
    /* the lens clips chief rays above 5 mm: tan t = 0.5; and says nothing of a field */
    CHECK(trace_text("object inf\nstop - 10 air 4\nthick 30 0 air 10\n", RECTILINEAR, 21.6, &arena,
                     &profile, &error));
    CHECK_NEAR(profile.reached, 15, 1e-9, "as far as light comes");
    /* a lens without diameters is as good as it says, and no further */
    CHECK(trace_text("object inf\nfield angle 20\nstop - 10 air 4\nthick 30 0 air -\n", RECTILINEAR,
                     21.6, &arena, &profile, &error));
    CHECK_NEAR(profile.reached, 30 * tan(20 * RADIANS_PER_DEGREE), 1e-9, "no diameters");
    /* what the lens states counts, beyond that */
    CHECK(trace_text(THIN "4\n", RECTILINEAR, 21.6, &arena, &profile, &error));
    CHECK_NEAR(profile.reached, 30 * tan(20 * RADIANS_PER_DEGREE), 1e-9, "as far as stated");
    /* of a sphere only rays that meet it are refracted */
    CHECK(trace_text("object inf\nstop - 10 air 1\nsurface 20 5 1.5 -\nsurface - 0 air -\n",
                     RECTILINEAR, 1000, &arena, &profile, &error));
    CHECK(profile.reached < 1000 && profile.reached > 10);
    CHECK(!trace_text("object 30\nstop - 10 air 4\nthick 20 0 air -\n", EQUIDISTANT, 10, &arena,
                      &profile, &error));
    /* a near object: 30 mm before a stop, at 1 : -1 */
    CHECK(trace_text("object 30\nstop - 10 air 4\nthick 20 0 air -\n", RECTILINEAR, 10, &arena,
                     &profile, &error));
    CHECK_NEAR(profile.focal, 30, 1e-7, "1 times the distance to the pupil");
    CHECK(!trace_text("object 30\nstop - 10 air 4\ncylinder 20 x 5 1.5 -\nsurface - 0 air -\n",
                      RECTILINEAR, 10, &arena, &profile, &error));
    arena_free(&arena);
}

int main(void)
{
    test_recovered();
    test_round_trip();
    test_reduced();
    test_trace();
    test_ends();
    return check_report();
}
