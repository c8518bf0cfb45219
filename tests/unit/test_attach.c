/* tests/unit/test_attach.c - tubes, close-up lenses, converters, reversed and stacked lenses. */
/* SPDX-License-Identifier: MIT */
#include "photo/attach.h"

#include <stdint.h>
#include <stdlib.h>

#include "check.h"

#define NONE ((double)NAN)

/* A thin lens with one attachment: magnification at both ends, lens-to-subject at the near end. */
static const struct example {
    double f, m_near;
    struct attach_step step;
    double m_far, m_result, working_near, tolerance;
    const char *source;
} examples[] = {
    {50,
     0.125,
     {ATTACH_TUBE, 25, 0, 0},
     0.5,
     0.625,
     130,
     1e-14,
     "fredmiranda.com topic 630213: 50 mm, 450 mm, 25 mm tube: 130 mm, 0.625"},
    {50,
     0.15,
     {ATTACH_TUBE, 25, 0, 0},
     0.5,
     0.65,
     NONE,
     1e-14,
     "photography-on-the.net 1459388: 50/1.8, 0.15x, 25 mm tube: 0.5x and 0.65x"},
    {200,
     0,
     {ATTACH_CLOSE_UP, 8, 0, 0},
     1.6,
     1.6,
     125,
     1e-14,
     "macrobyraghu.com: Raynox DCR-250 (125 mm) on 200 mm: 1.6x at 12.5 cm"},
    {400,
     1.0 / 3,
     {ATTACH_CLOSE_UP, 2, 0, 0},
     0.8,
     1.4,
     NONE,
     1e-14,
     "cameralabs forum 153330: 400 mm at 1:3 with a 500 mm close-up lens: 533.3/222.2 - 1"},
    {300,
     0,
     {ATTACH_CLOSE_UP, 3, 0, 0},
     0.9,
     0.9,
     1000.0 / 3,
     1e-14,
     "Wikipedia, Close-up lens: 300 mm with +3: 0.9 at 0.333 m"},
    {200,
     0,
     {ATTACH_STACKED, 50, 30, 0},
     4,
     4,
     50,
     1e-13,
     "wetcanvas 361408, stackexchange: 50 mm reversed on 200 mm gives 4x"},
    {100,
     1,
     {ATTACH_CONVERTER, 2, 0, 0},
     0,
     2,
     NONE,
     1e-14,
     "a 2x converter doubles m at the same subject distance (focusonpictures.com)"},
};

static void test_examples(void)
{
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        const struct example *e = &examples[i];
        struct attach_lens lens;
        struct attach_focus near;
        struct error error;
        CHECK(attach_bare(&(struct attach_bare){e->f, 4, 1, e->m_near, 0, 0}, &lens, &error));
        CHECK(attach_apply(&lens, &e->step, 1, &error));
        CHECK(attach_focused(&lens, true, &near, &error));
        CHECK_NEAR(lens.m_far, e->m_far, e->tolerance, e->source);
        CHECK_NEAR(near.m, e->m_result, e->tolerance, e->source);
        if (!isnan(e->working_near)) {
            CHECK_RELATIVE(near.working_distance, e->working_near, 1e-13, e->source);
        }
    }
}

/* Wikipedia, Close-up lens: a lens that focuses to X = 1.5 m with +3: X/(D X + 1) = 0.273 m, the
   magnification X D + 1 = 5.5 times. Holds for distances from the principal plane and d = 0. */
static void test_close_up_range(void)
{
    struct attach_lens lens;
    struct attach_focus bare, with;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){100, 4, 1, 100.0 / 1400, 0, 0}, &lens, &error));
    CHECK(attach_focused(&lens, true, &bare, &error));
    CHECK_NEAR(bare.working_distance, 1500, 1e-9, "bare");
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_CLOSE_UP, 3, 0, 0}, 1, &error));
    CHECK(attach_focused(&lens, true, &with, &error));
    CHECK_NEAR(with.working_distance, 273, 0.5, "Wikipedia, Close-up lens, 0.273 m");
    CHECK_RELATIVE(with.m / bare.m, 5.5, 1e-12, "Wikipedia, Close-up lens, gain 5.5");
    CHECK_RELATIVE(with.working_fnumber, bare.working_fnumber, 1e-13,
                   "Wikipedia: close-up lenses do not affect exposure");
}

static double uniform(uint64_t *state)
{
    *state = *state * 6364136223846793005U + 1442695040888963407U;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* A ray through thin lenses: height and slope, light to the right. */
struct ray {
    double y, u;
};

static struct ray through(struct ray ray, double t, double f)
{
    double y = ray.y + t * ray.u;
    return (struct ray){y, ray.u - y / f};
}

/* Subject, close-up lens, main lens (thin, P = 1), sensor: traced rays meet where said, m as said.
 */
static void test_traced_close_up(void)
{
    uint64_t state = 11;
    for (int i = 0; i < 2000; i++) {
        double f = 20 + 300 * uniform(&state), D = 0.2 + 8 * uniform(&state);
        double gap = 60 * uniform(&state), m0 = uniform(&state), F = 1000 / D;
        if (gap > 0.9 * F) {
            continue;
        }
        struct attach_lens lens;
        struct attach_focus near;
        struct error error;
        CHECK(attach_bare(&(struct attach_bare){f, 4, 1, m0, 0, 0}, &lens, &error));
        CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_CLOSE_UP, D, gap, 0}, 1, &error));
        if (!attach_focused(&lens, true, &near, &error)) {
            continue;
        }
        double v = f * (1 + m0), w = near.working_distance;
        struct ray axial = through(through((struct ray){0, 0.01}, w, F), gap, f);
        struct ray point = through(through((struct ray){1, 0}, w, F), gap, f);
        CHECK_NEAR((axial.y + v * axial.u) / (0.01 * w), 0, 1e-11,
                   "axial ray meets the sensor's middle");
        CHECK_NEAR(point.y + v * point.u, -near.m, 1e-10 * (1 + near.m), "height 1 becomes -m");
        CHECK_RELATIVE(near.sensor_distance, w + gap + v, 1e-13, "subject to sensor");
        /* stop at the main lens: the image-side cone is that of the bare lens */
        CHECK_RELATIVE(near.working_fnumber, 4 * (1 + m0), 1e-11, "image-side cone kept");
        /* entrance pupil: the stop's rim seen through the close-up lens; N' = f'/diameter */
        double pupil = f / 4 / (1 - gap / F);
        CHECK_RELATIVE(lens.N, lens.f / pupil, 1e-12, "f-number from the traced pupil");
    }
}

/* The image-side cone is kept for any P too, and close-up lenses commute with rear attachments. */
static void test_commute(void)
{
    uint64_t state = 5;
    for (int i = 0; i < 2000; i++) {
        double f = 30 + 200 * uniform(&state), P = 0.4 + 1.2 * uniform(&state);
        double front = (uniform(&state) - 0.3) * 0.3 * f;
        struct attach_step front_first[] = {
            {ATTACH_CLOSE_UP, 0.1 + 2 * uniform(&state), 10 * uniform(&state), 0},
            {ATTACH_CONVERTER, 0.7 + uniform(&state), 20, 0},
            {ATTACH_TUBE, 30 * uniform(&state), 0, 0}};
        struct attach_step rear_first[] = {front_first[1], front_first[2], front_first[0]};
        struct attach_lens a, b, bare;
        struct error error;
        CHECK(attach_bare(&(struct attach_bare){f, 2.8, P, 0.3, front, 3}, &bare, &error));
        a = b = bare;
        if (front + front_first[0].gap < 0 || !attach_apply(&a, front_first, 1, &error)) {
            continue;
        }
        CHECK_RELATIVE(a.N * (1 + a.m_near / a.P), bare.N * (1 + 0.3 / P), 1e-12,
                       "cone kept, any P");
        CHECK(attach_apply(&a, front_first + 1, 2, &error));
        CHECK(attach_apply(&b, rear_first, 3, &error));
        CHECK_RELATIVE(a.f, b.f, 1e-12, "f");
        CHECK_RELATIVE(a.m_near, b.m_near, 1e-12, "m");
        CHECK_RELATIVE(a.N, b.N, 1e-11, "N");
        CHECK_RELATIVE(a.P, b.P, 1e-11, "P");
        CHECK_NEAR(a.front, b.front, 1e-10 * f, "front");
        CHECK_RELATIVE(a.length_near, b.length_near, 1e-13, "length");
    }
}

/* A converter leaves the subject where it was and multiplies m and N. */
static void test_converter(void)
{
    struct attach_lens lens;
    struct attach_focus bare, with;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){300, 2.8, 0.8, 0.2, 40, 5}, &lens, &error));
    CHECK(attach_focused(&lens, true, &bare, &error));
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_CONVERTER, 1.4, 0, 0}, 1, &error));
    CHECK(attach_focused(&lens, true, &with, &error));
    CHECK_RELATIVE(lens.f, 420.0, 1e-14, "300 mm x 1.4 = 420 mm");
    CHECK_NEAR(lens.N, 3.92, 1e-14, "f/2.8 x 1.4: one stop, marked f/4");
    CHECK_RELATIVE(with.working_distance, bare.working_distance, 1e-13, "the same distance");
    CHECK_RELATIVE(with.working_fnumber, 1.4 * bare.working_fnumber, 1e-13, "one stop at any m");
}

/* Lengths that overflow are refused, not shown as no number. */
static void test_overflow(void)
{
    struct attach_lens lens;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){50, 2.8, 1, 0, 0, 0}, &lens, &error));
    CHECK(!attach_apply(&lens, &(struct attach_step){ATTACH_CONVERTER, 1e308, 0, 0}, 1, &error));
    CHECK(error.code == ERROR_DOMAIN);
}

/* apug 1057535 (Bigler): a lens reversed works at N (1/P)(1 + P m). */
static void test_reversed(void)
{
    struct attach_lens lens;
    struct attach_focus focus;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){28, 4, 1.6, 0, 0, 0}, &lens, &error));
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_REVERSED, 84, 0, 0}, 1, &error));
    CHECK(attach_focused(&lens, false, &focus, &error));
    CHECK_NEAR(focus.m, 2, 1e-14, "84 mm behind a 28 mm lens is 2:1");
    CHECK_RELATIVE(focus.working_fnumber, 4 / 1.6 * (1 + 1.6 * 2), 1e-14, "apug 1057535");
    CHECK(!attach_apply(&lens, &(struct attach_step){ATTACH_REVERSED, 20, 0, 0}, 1, &error));
    /* a known back: H' 5 mm behind it is the new H, the old H 12 mm from there the new H' */
    CHECK(attach_bare(&(struct attach_bare){28, 4, 1.6, 0, 9, 12}, &lens, &error));
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_REVERSED, 84, 12, 5}, 1, &error));
    CHECK(attach_focused(&lens, false, &focus, &error));
    CHECK_NEAR(focus.working_distance, 42 - 5, 1e-13, "s = f (1 + 1/m) = 42 mm from H");
    CHECK_NEAR(focus.sensor_distance, 42 + 12 + 84, 1e-13, "T = s + hiatus + v");
    struct attach_step late[] = {{ATTACH_TUBE, 10, 0, 0}, {ATTACH_REVERSED, 84, 0, 0}};
    CHECK(!attach_apply(&lens, late, 2, &error) && error.code == ERROR_USAGE);
}

/* The narrower of the two lenses sets the beam: 200/4 is 50 mm wide, a 50/2.8 only 17.9 mm. */
static void test_stacked_beam(void)
{
    struct attach_lens lens;
    struct attach_focus focus;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){200, 4, 1, 0, 0, 0}, &lens, &error));
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_STACKED, 50, 0, 2.8}, 1, &error));
    CHECK(attach_focused(&lens, false, &focus, &error));
    CHECK_RELATIVE(focus.working_fnumber, 200 / (50 / 2.8), 1e-13, "limited by the front lens");
    CHECK(attach_bare(&(struct attach_bare){200, 16, 1, 0, 0, 0}, &lens, &error));
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_STACKED, 50, 0, 2.8}, 1, &error));
    CHECK(attach_focused(&lens, false, &focus, &error));
    CHECK_RELATIVE(focus.working_fnumber, 16.0, 1e-13, "limited by the rear lens");
}

static void test_refusals(void)
{
    static const struct {
        struct attach_step step;
        const char *words;
    } rows[] = {
        {{ATTACH_TUBE, -1, 0, 0}, "tube -1 mm"},
        {{ATTACH_CLOSE_UP, 0, 0, 0}, "close-up lens 0"},
        {{ATTACH_CLOSE_UP, 20, 51, 0}, "less than 50 mm"},
        {{ATTACH_CLOSE_UP, 2, NONE, 0}, "gap"},
        {{ATTACH_CONVERTER, 0, 0, 0}, "converter factor"},
        {{ATTACH_REVERSED, 99, 0, 0}, "100 mm or more"},
        {{ATTACH_STACKED, 0, 0, 0}, "stacked lens"},
    };
    struct attach_lens bare, lens;
    struct error error;
    CHECK(attach_bare(&(struct attach_bare){100, 4, 1, 0, 0, 0}, &bare, &error));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        lens = bare;
        CHECK(!attach_apply(&lens, &rows[i].step, 1, &error) && error.code == ERROR_DOMAIN);
        check_at(strstr(error.message, rows[i].words) != NULL, __FILE__, __LINE__, rows[i].words);
    }
    CHECK(!attach_bare(&(struct attach_bare){0, 4, 1, 0, 0, 0}, &lens, &error));
    CHECK(!attach_bare(&(struct attach_bare){50, 4, NONE, 0, 0, 0}, &lens, &error));
    CHECK(!attach_bare(&(struct attach_bare){50, 4, 1, -1, 0, 0}, &lens, &error));
    struct attach_focus focus;
    CHECK(attach_bare(&(struct attach_bare){50, 4, 1, 5, 61, 0}, &lens,
                      &error)); /* s = 60 mm, front 61 mm before H */
    CHECK(!attach_focused(&lens, true, &focus, &error));
}

int main(void)
{
    test_examples();
    test_close_up_range();
    test_traced_close_up();
    test_commute();
    test_converter();
    test_overflow();
    test_reversed();
    test_stacked_beam();
    test_refusals();
    return check_report();
}
