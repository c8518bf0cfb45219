/* tests/unit/test_exit_pupil.c - beams behind a paraboloid, where all is known; their lines. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_lines.h"

#include "base/constants.h"
#include "check.h"
#include "lens_of.h"

/* f = 100 mm, the stop of a radius of 40 in its vertex; what else is in the way. */
#define MIRROR(blocks)                                                                             \
    "wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 k=-1 stop\n" blocks

struct bench {
    struct arena arena;
    struct lens lens;
    struct setup setup;
    struct exit_pupils pupils;
    const struct exit_pupil *pupil; /* of the only wavelength; null: there is none */
};

static void open_bench(const char *text, struct field_point field, double image,
                       struct bench *bench)
{
    struct error error = {0};
    *bench = (struct bench){.arena = {0}};
    bench->lens = lens_of(text, &bench->arena);
    const struct setup_question question = {
        .lens = &bench->lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value plane = {isnan(image) ? PLANE_OF_LENS : PLANE_AT, image};
    const struct bundle_question bundle = {.setup = &bench->setup, .field = &field, .clip = true};
    const bool opened = setup_open(&question, &bench->arena, &bench->setup, &error) &&
                        setup_place_image(&bench->setup, &plane, &error) &&
                        exit_pupils_open(&bundle, &bench->arena, &bench->pupils, &error);
    CHECK(opened);
    if (!opened) {
        printf("%s\n", error.message);
    }
    bench->pupil = opened ? bench->pupils.list : NULL;
}

/* Where light to the direction of a and b leaves the mirror, h = 200 tan(U/2) off the axis. */
static void place_of(const double at[2], double place[2])
{
    const double sine = hypot(at[0], at[1]), h = 200 * tan(asin(sine) / 2);
    place[0] = sine > 0 ? -h * at[0] / sine : 0;
    place[1] = sine > 0 ? -h * at[1] / sine : 0;
}

/* The sine at the rim: tan U = 40/(100 - 4). */
static double rim_sine(void)
{
    return sin(atan(40. / 96));
}

/* -------- the beam -------- */

/* The amplitude is the root of h dh/(s ds), s = sin U: 100/(cos^2(U/2) sqrt(cos U)) mm,
   of a stop of 40. */
static void test_focus(double image)
{
    struct bench bench;
    open_bench(MIRROR(""), (struct field_point){FIELD_NONE, {0, 0}}, image, &bench);
    const struct exit_pupil *pupil = bench.pupil;
    if (pupil == NULL) {
        return;
    }
    /* of a sphere about the focus; moved by 1 mm all is seen from there, and less plain */
    const double off = image + 100;
    CHECK_RELATIVE(pupil->energy, PI, 1e-10, "the area of the beam, in radii of the stop");
    CHECK(pupil->is_mirrored[0] && pupil->is_mirrored[1] && !pupil->is_blocked);
    for (int k = 0; k < 2; k++) {
        CHECK_NEAR(pupil->middle[k], 0, 1e-12, "middle");
        CHECK(off != 0 || fabs(pupil->half[k] - rim_sine()) < 1e-11);
    }
    enum { COUNT = 25 };
    double at[COUNT][2], waves[COUNT], amplitudes[COUNT], form[2][COUNT];
    for (int i = 0; i < COUNT; i++) {
        at[i][0] = 0.18 * (i % 5 - 2) * pupil->half[0] * 2;
        at[i][1] = 0.16 * (i / 5 - 2) * pupil->half[1] * 2;
    }
    exit_pupil_values(pupil, (const double(*)[2])at, COUNT, waves, amplitudes);
    exit_pupil_form(pupil, (const double(*)[2])at, COUNT, form[0], form[1]);
    for (int i = 0; i < COUNT && off == 0; i++) {
        const double U = asin(hypot(at[i][0], at[i][1])), half = cos(U / 2);
        CHECK_NEAR(waves[i], 0, 1e-9, "W");
        CHECK_NEAR(form[0][i], 0, 1e-9, "W by polynomials");
        CHECK_RELATIVE(amplitudes[i], 2.5 / (half * half * sqrt(cos(U))), 1e-6, "amplitude");
        CHECK_RELATIVE(form[1][i], 2.5 / (half * half * sqrt(cos(U))), 1e-6, "and of these");
    }
    arena_free(&bench.arena);
}

/*
 * A plane 1 mm behind the focus: a ray of the angle U meets the sphere of 101 mm about there `back`
 * before the focus, where 100 mm are what the chief ray has; the way to its centre says a and b.
 */
static void test_defocus(void)
{
    struct bench bench;
    open_bench(MIRROR(""), (struct field_point){FIELD_NONE, {0, 0}}, -101, &bench);
    if (bench.pupil == NULL) {
        return;
    }
    enum { COUNT = 40 };
    double at[COUNT][2], waves[COUNT], amplitudes[COUNT], form[COUNT];
    double expected[COUNT];
    for (int i = 0; i < COUNT; i++) {
        const double h = 39.5 * (i + 0.5) / COUNT, turn = 2.4 * i;
        const double U = atan(h / (100 - h * h / 400)), cosine = cos(U);
        const double back = -cosine + sqrt(cosine * cosine + 101 * 101 - 1);
        at[i][0] = -back * sin(U) / 101 * cos(turn);
        at[i][1] = -back * sin(U) / 101 * sin(turn);
        expected[i] = -(100 - back) / 0.5875618e-3;
    }
    exit_pupil_values(bench.pupil, (const double(*)[2])at, COUNT, waves, amplitudes);
    exit_pupil_form(bench.pupil, (const double(*)[2])at, COUNT, form, amplitudes);
    for (int i = 0; i < COUNT; i++) {
        CHECK_NEAR(waves[i], expected[i], 1e-8, "W of a defocus");
        CHECK_NEAR(form[i], expected[i], 1e-4, "and by polynomials");
    }
    arena_free(&bench.arena);
}

/*
 * What polynomials leave is what they differ by from rays, in the mean of points all over the
 * pupil: a sphere, whose front at f/1.25 they do not follow all the way.
 */
static void test_left(void)
{
    static const struct field_point fields[] = {{FIELD_NONE, {0, 0}},
                                                {FIELD_ANGLE, {0, 3 * RADIANS_PER_DEGREE}},
                                                {FIELD_ANGLE, {2 * RADIANS_PER_DEGREE, -0.03}}};
    for (size_t f = 0; f < sizeof fields / sizeof fields[0]; f++) {
        struct bench bench;
        open_bench("wavelength d\nobject inf\naperture stop\nsurface -200 -96 mirror 120 stop\n",
                   fields[f], NAN, &bench);
        const struct exit_pupil *pupil = bench.pupil;
        if (pupil == NULL) {
            return;
        }
        enum { SIDE = 41, MOST = SIDE * SIDE };
        static double all[MOST][2], waves[MOST], amplitudes[MOST], form[2][MOST];
        static size_t limits[MOST];
        size_t count = 0;
        double sums[3] = {0}, mean = 0;
        for (int i = 0; i < MOST; i++) {
            all[i][0] = pupil->middle[0] + pupil->half[0] * (2. * (i % SIDE) / (SIDE - 1) - 1);
            all[i][1] = pupil->middle[1] + pupil->half[1] * (2. * (i / SIDE) / (SIDE - 1) - 1);
        }
        exit_pupil_look(pupil, (const double(*)[2])all, MOST, limits);
        exit_pupil_values(pupil, (const double(*)[2])all, MOST, waves, amplitudes);
        exit_pupil_form(pupil, (const double(*)[2])all, MOST, form[0], form[1]);
        for (int i = 0; i < MOST; i++) {
            if (limits[i] == EXIT_PUPIL_CLEAR) {
                count++;
                mean += amplitudes[i];
                sums[0] += pow(form[0][i] - waves[i], 2);
                sums[1] += pow(form[1][i] - amplitudes[i], 2);
            }
        }
        const double n = (double)count, off = sqrt(sums[0] / n);
        const double off_amplitude = sqrt(sums[1] / n) / (mean / n);
        CHECK_RELATIVE(pupil->off_waves, off, 0.2, "of the waves");
        CHECK_RELATIVE(pupil->off_amplitude, off_amplitude, 0.2, "of the amplitude");
        arena_free(&bench.arena);
    }
}

/* The box about the rim, and its ellipse as much larger as the rim comes out of it. */
static void test_box(void)
{
    static const char *const texts[] = {MIRROR(""),
                                        MIRROR("pass polygon -30,-20 35,-20 35,30 -30,30\n"),
                                        MIRROR("pass ellipse 50 30 decenter=3,9\n")};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct bench bench;
        open_bench(texts[i], (struct field_point){FIELD_ANGLE, {0.02, 0.05}}, NAN, &bench);
        const struct exit_pupil *pupil = bench.pupil;
        if (pupil == NULL) {
            return;
        }
        double low[2] = {2, 2}, high[2] = {-2, -2}, most = 0;
        CHECK(pupil->rim_count > 200);
        for (size_t r = 0; r < pupil->rim_count; r++) {
            for (int k = 0; k < 2; k++) {
                low[k] = fmin(low[k], pupil->rim[r][k]);
                high[k] = fmax(high[k], pupil->rim[r][k]);
            }
        }
        for (int k = 0; k < 2; k++) {
            CHECK_NEAR(pupil->middle[k], (low[k] + high[k]) / 2, 1e-15, "middle");
            CHECK_NEAR(pupil->half[k], (high[k] - low[k]) / 2, 1e-15, "half");
            CHECK(pupil->scale[k] >= pupil->half[k]);
        }
        for (size_t r = 0; r < pupil->rim_count; r++) {
            const double x = (pupil->rim[r][0] - pupil->middle[0]) / pupil->scale[0];
            const double y = (pupil->rim[r][1] - pupil->middle[1]) / pupil->scale[1];
            most = fmax(most, hypot(x, y));
        }
        CHECK(most <= 1 + 1e-15);
        CHECK(fabs(most - 1) < 1e-14 || pupil->scale[0] == pupil->half[0]);
        CHECK_RELATIVE(pupil->scale[0] / pupil->half[0], pupil->scale[1] / pupil->half[1], 1e-15,
                       "of its form");
        arena_free(&bench.arena);
    }
}

/* -------- lines -------- */

/* Is the place of the mirror clear: in the disc of 40, out of one about (x, y). */
struct blocked {
    const char *text;
    double x, y, r;
};

static bool is_clear(const struct blocked *blocked, const double at[2])
{
    double place[2];
    place_of(at, place);
    return hypot(place[0], place[1]) <= 40 &&
           hypot(place[0] - blocked->x, place[1] - blocked->y) >= blocked->r;
}

/* Of both sides; perhaps: they are, but where pieces end is known to 1e-6 alone. */
enum sides { UNALIKE, ALIKE, PERHAPS };

/* Spans of lines along a direction: their ends stand between what is clear and what is not. */
static void check_lines(const struct blocked *blocked, const double along[2],
                        enum sides across_sides, enum sides along_sides)
{
    struct bench bench;
    open_bench(blocked->text, (struct field_point){FIELD_NONE, {0, 0}}, NAN, &bench);
    struct exit_lines *lines = ARENA_NEW(&bench.arena, struct exit_lines);
    if (bench.pupil == NULL) {
        return;
    }
    exit_lines_find(bench.pupil, along, &bench.arena, lines);
    CHECK(lines->count == (blocked->r > 0 ? 3 : 1));
    CHECK(across_sides == PERHAPS || lines->is_mirrored_across == (across_sides == ALIKE));
    CHECK(lines->is_mirrored_along == (along_sides == ALIKE));
    CHECK(lines->along[0] == along[0] && lines->along[1] == along[1]);
    CHECK(lines->across[0] == -along[1] && lines->across[1] == along[0]);
    CHECK_NEAR(lines->pieces[0].low, -rim_sine(), 1e-9, "from one side");
    CHECK_NEAR(lines->pieces[lines->count - 1].high, rim_sine(), 1e-9, "to the other");
    double area = 0;
    for (size_t p = 0; p < lines->count; p++) {
        const struct exit_piece *piece = &lines->pieces[p];
        CHECK(p == 0 || piece->low == lines->pieces[p - 1].high);
        enum { STEPS = 400 };
        for (int i = 0; i < STEPS; i++) {
            const double angle = PI * ((i + 0.5) / STEPS - 0.5);
            struct exit_spans spans;
            double slope;
            const double t = exit_piece_at(piece, angle, &slope, &spans);
            CHECK_NEAR(t,
                       (piece->low + piece->high) / 2 + (piece->high - piece->low) / 2 * sin(angle),
                       1e-15, "t");
            CHECK_NEAR(slope, (piece->high - piece->low) / 2 * cos(angle), 1e-15, "dt");
            for (size_t e = 0; e < 2 * spans.count; e++) {
                area += slope * PI / STEPS * spans.edges[e] * (e % 2 == 0 ? -1 : 1);
                if (i % 20 != 9 || fabs(angle) > 1.4) {
                    continue;
                }
                const double inward = e % 2 == 0 ? 2e-5 : -2e-5;
                for (int side = -1; side <= 1; side += 2) {
                    const double s = spans.edges[e] + side * inward;
                    const double at[2] = {s * along[0] + t * lines->across[0],
                                          s * along[1] + t * lines->across[1]};
                    CHECK(is_clear(blocked, at) == (side > 0));
                }
            }
        }
    }
    /* the directions of the disc less those of what blocks it, by a grid of 300 x 300 */
    double expected = 0;
    for (int i = 0; i < 90000; i++) {
        const double at[2] = {0.4 * (2 * (i % 300 + 0.5) / 300 - 1),
                              0.4 * (2 * (i / 300 + 0.5) / 300 - 1)};
        expected += is_clear(blocked, at) ? 0.64 / 90000 : 0;
    }
    CHECK_RELATIVE(area, expected, 1e-3, "what is clear of all lines");
    arena_free(&bench.arena);
}

static void test_lines(void)
{
    static const struct blocked none = {MIRROR(""), 0, 0, 0},
                                middle = {MIRROR("block circle 24\n"), 0, 0, 12},
                                above = {MIRROR("block circle 24 decenter=0,15\n"), 0, 15, 12},
                                aside = {MIRROR("block circle 24 decenter=-9,0\n"), -9, 0, 12},
                                skew = {MIRROR("block circle 24 decenter=8,-15\n"), 8, -15, 12};
    static const double x[] = {1, 0}, y[] = {0, 1}, down[] = {0, -1}, turned[] = {0.6, 0.8};
    check_lines(&none, x, ALIKE, ALIKE);
    check_lines(&none, y, ALIKE, ALIKE);
    check_lines(&none, turned, UNALIKE, UNALIKE);
    check_lines(&middle, x, ALIKE, ALIKE);
    check_lines(&middle, down, ALIKE, ALIKE);
    check_lines(&above, x, UNALIKE, ALIKE);
    check_lines(&above, y, PERHAPS, UNALIKE);
    check_lines(&aside, x, ALIKE, UNALIKE);
    check_lines(&aside, down, UNALIKE, ALIKE);
    check_lines(&skew, x, UNALIKE, UNALIKE);
    check_lines(&skew, y, UNALIKE, UNALIKE);
    check_lines(&skew, turned, UNALIKE, UNALIKE);
}

int main(void)
{
    test_focus(-100);
    test_focus(-101);
    test_defocus();
    test_left();
    test_box();
    test_lines();
    return check_report();
}
