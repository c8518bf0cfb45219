/* tests/unit/test_mtf.c - contrast of a round pupil by waves, and of even discs by rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf.h"

#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "lens_of.h"

struct bench {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct field_point field;
    struct mtf_question question;
    struct mtf_source source;
    bool is_open;
};

static void open_bench(const char *text, struct field_point field, double image, bool by_rays,
                       struct bench *bench)
{
    struct error error = {0};
    *bench = (struct bench){.arena = {0}};
    bench->lens = lens_of(text, &bench->arena);
    bench->field = field;
    bench->question = (struct mtf_question){
        .bundle = {.setup = &bench->setup, .field = &bench->field, .clip = true},
        .by_rays = by_rays,
        .error = 1e-6};
    const struct setup_question question = {
        .lens = &bench->lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value plane = {isnan(image) ? PLANE_OF_LENS : PLANE_AT, image};
    bench->is_open = setup_open(&question, &bench->arena, &bench->setup, &error) &&
                     setup_place_image(&bench->setup, &plane, &error) &&
                     mtf_open(&bench->question, &bench->arena, &bench->source, &error);
    CHECK(bench->is_open);
    if (!bench->is_open) {
        printf("%s\n", error.message);
    }
}

/* 2 J1(x)/x: the mean of cos(x sin t) over cos^2 t, which a sum of equal steps has to rounding. */
static double disc_contrast(double x)
{
    enum { STEPS = 400 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double t = PI * ((i + 0.5) / STEPS - 0.5);
        sum += 2. / STEPS * cos(t) * cos(t) * cos(x * sin(t));
    }
    return sum;
}

/*
 * Straight rays through a stop of the radius 5 are an even disc on any plane; where that is the
 * stop's own there is no sphere about the image, and no pupil.
 */
static void test_rays(void)
{
    static const char *const text = "wavelength d\nobject inf\naperture stop\nfocus afocal\n"
                                    "stop - 0 air 10\nsurface - 0 air 40\n";
    static const double distances[] = {0, 50};
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        struct bench bench;
        open_bench(text, (struct field_point){FIELD_ANGLE, {0, 0.1}}, distances[i], true, &bench);
        CHECK((bench.source.pupils.list == NULL) == (distances[i] == 0));
        CHECK(bench.source.pupils.islands.share == 0 && bench.source.directions == 2);
        for (int k = 0; k < 2; k++) {
            CHECK(isnan(bench.source.cutoff[k]) == (distances[i] == 0));
            CHECK(bench.source.along[k][k] == (k == 0 ? 0 : -0.0));
            CHECK(fabs(bench.source.along[k][1 - k]) == 1);
        }
        for (double f = 0.01; f < 0.3 && bench.is_open; f += 0.04) {
            struct mtf mtf;
            struct error error;
            CHECK(mtf_find(&bench.source, f, &bench.arena, &mtf, &error) && mtf.has_converged);
            for (int k = 0; k < 2; k++) {
                const double expected = disc_contrast(2 * PI * f * 5);
                CHECK_NEAR(mtf.contrast[k], fabs(expected), 2e-6, "of a disc");
                CHECK_NEAR(fabs(mtf.phase[k]), expected < 0 ? PI : 0, 1e-4, "turned where below 0");
                CHECK(isnan(mtf.limit[k]) == (distances[i] == 0));
            }
        }
        arena_free(&bench.arena);
    }
}

/* The image on the axis of a round lens is the same in all directions; it is asked in one. */
static void test_directions(void)
{
    static const struct {
        struct field_point field;
        size_t directions;
    } rows[] = {{{FIELD_NONE, {0, 0}}, 1},
                {{FIELD_NONE, {0.01, 0}}, 1},
                {{FIELD_ANGLE, {0, 0}}, 1},
                {{FIELD_ANGLE, {0, 0.01}}, 2},
                {{FIELD_ANGLE, {0.01, 0}}, 2}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct bench bench;
        open_bench("wavelength d\nobject inf\naperture stop\n"
                   "surface -200 -100 mirror 4 k=-1 stop\n",
                   rows[i].field, -100, false, &bench);
        CHECK(bench.source.directions == rows[i].directions);
        arena_free(&bench.arena);
    }
}

/* [Goodman05] (6-32); the sine at the rim of a paraboloid of f/25 is even to 2e-4. */
static void test_waves(void)
{
    struct bench bench;
    open_bench("wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 4 k=-1 stop\n",
               (struct field_point){FIELD_NONE, {0, 0}}, -100, false, &bench);
    const double sine = sin(atan(2 / (100 - 4. / 400))), cutoff = 2 * sine / 0.5875618e-3;
    CHECK(bench.source.directions == 1);
    CHECK_RELATIVE(bench.source.cutoff[0], cutoff, 1e-7, "cut-off");
    for (int k = 0; k <= 20 && bench.is_open; k++) {
        const double share = k / 20., root = sqrt(1 - share * share);
        struct mtf mtf;
        struct error error;
        CHECK(mtf_find(&bench.source, share * cutoff, &bench.arena, &mtf, &error));
        const double expected = 2 / PI * (acos(share) - share * root);
        for (int d = 0; d < 2; d++) {
            CHECK_NEAR(mtf.contrast[d], expected, 2e-4, "a perfect pupil");
            CHECK_NEAR(mtf.limit[d], mtf.contrast[d], 2e-6, "it is the limit");
            CHECK(mtf.contrast[d] < 1e-6 || fabs(mtf.phase[d]) < 1e-6);
        }
    }
    arena_free(&bench.arena);
}

/*
 * Light beyond a gap is told of, of an image in the exit pupil too, where there is no sphere: of a
 * lens that has some, as test_pupil_islands counts in cells.
 */
static void test_islands(void)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct lens lens = {0};
    struct setup setup = {0};
    struct error error = {0};
    const struct field_point field = {FIELD_ANGLE, {0, 14 * RADIANS_PER_DEGREE}};
    const struct setup_question asked = {.lens = &lens, .wavelength = NAN, .fnumber = NAN};
    CHECK(lens_open(&db, text_of("cooke-triplet-50"), &arena, &lens, &error) &&
          setup_open(&asked, &arena, &setup, &error));
    const double exit = setup.first.exit_pupil;
    double shares[2] = {0, 0};
    for (int i = 0; i < 2; i++) {
        const struct plane_value plane = {i == 0 ? PLANE_OF_LENS : PLANE_AT, exit};
        const struct mtf_question question = {
            .bundle = {.setup = &setup, .field = &field, .clip = true},
            .by_rays = true,
            .error = 1e-3};
        struct mtf_source source;
        CHECK(setup_place_image(&setup, &plane, &error) &&
              mtf_open(&question, &arena, &source, &error));
        CHECK((source.pupils.list == NULL) == (i == 1));
        shares[i] = source.pupils.islands.share;
    }
    CHECK(shares[0] > 0.001 && shares[1] == shares[0]);
    arena_free(&arena);
}

int main(void)
{
    test_islands();
    test_directions();
    test_rays();
    test_waves();
    return check_report();
}
