/* tests/unit/test_working_fnumber.c - working f-numbers by field against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/working_fnumber.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"

static struct working_fnumber find(const char *text, const struct field_point *field, bool clip)
{
    struct arena arena = {0};
    struct error error = {0};
    struct setup setup = {0};
    struct working_fnumber found = {0};
    struct lens *lens = ARENA_NEW(&arena, struct lens);
    const struct setup_question question = {
        .lens = lens, .wavelength = NAN, .fnumber = NAN, .wavelengths = WAVELENGTHS_PRIMARY};
    const struct bundle_question bundle = {.setup = &setup, .field = field, .clip = clip};
    const bool done =
        lens_read("test", text_of(text), NULL, &arena, lens, &error) &&
        setup_open(&question, &arena, &setup, &error) &&
        setup_place_image(&setup, &(struct plane_value){.kind = PLANE_OF_LENS}, &error) &&
        working_fnumber_find(&bundle, &arena, &found, &error);
    if (!done) {
        printf("%s\n", error.message);
    }
    CHECK(done);
    arena_free(&arena);
    return found;
}

static const struct field_point axis = {FIELD_ANGLE, {0, 0}};

/* A paraboloid, f = 100, its rim at 40: tan(u/2) = h/(2 f), so sin u = (h/f)/(1 + h^2/(4 f^2)). */
static void test_paraboloid(void)
{
    const struct working_fnumber found =
        find("wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 k=-1 stop\n",
             &axis, true);
    const double expected = (1 + 0.04) / (2 * 0.4);
    CHECK_RELATIVE(found.tangential, expected, 2e-12, "paraboloid, tangential");
    CHECK_RELATIVE(found.sagittal, expected, 2e-12, "paraboloid, sagittal");
    CHECK_RELATIVE(found.both, expected, 2e-12, "paraboloid");
}

/*
 * Light focused in glass by an ellipsoid, k = -1/n^2, without aberration: from (h, sag) to the
 * focus n R/(n - 1) behind the vertex.
 */
static void test_index(void)
{
    const double n = 1.5, radius = 50, h = 20, k = -1 / (n * n);
    const double focus = n * radius / (n - 1);
    const double sag = h * h / radius / (1 + sqrt(1 - (1 + k) * h * h / (radius * radius)));
    const struct working_fnumber found = find("wavelength d\nobject inf\naperture stop\n"
                                              "surface 50 150 1.5 40 k=-0.44444444444444444 stop\n",
                                              &axis, true);
    CHECK_RELATIVE(found.both, hypot(h, focus - sag) / (2 * n * h), 2e-12, "ellipsoid into glass");
}

/*
 * An ideal lens that is the stop, f = 100, radius a, field t: rays from (0, +-a) and (+-a, 0) to
 * (0, f tan t, f), the chief ray from the middle. For a small a N/cos(t)^2 and N/cos(t).
 */
static void test_ideal_lens(void)
{
    static const struct {
        const char *text;
        double a, degrees;
    } cases[] = {
        {"wavelength d\nobject inf\naperture stop\nstop - 0 air 50\nthin 100 100 air\n", 25, 30},
        {"wavelength d\nobject inf\naperture stop\nstop - 0 air 50\nthin 100 100 air\n", 25, 10},
        {"wavelength d\nobject inf\naperture stop\nstop - 0 air .02\nthin 100 100 air\n", .01, 40},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double f = 100, a = cases[i].a, t = cases[i].degrees * RADIANS_PER_DEGREE;
        const double y = f * tan(t), chief = hypot(f, y);
        const struct field_point field = {FIELD_ANGLE, {0, t}};
        const struct working_fnumber found = find(cases[i].text, &field, true);
        const double up = sin(atan2(y + a, f) - t), down = sin(t - atan2(y - a, f));
        const double aside = a / hypot(a, chief);
        const double tangential = 1 / (2 * sqrt((up * up + down * down) / 2));
        CHECK_RELATIVE(found.tangential, tangential, 1e-10, "ideal lens, tangential");
        CHECK_RELATIVE(found.sagittal, 1 / (2 * aside), 1e-10, "ideal lens, sagittal");
        CHECK_RELATIVE(found.both, 1 / sqrt(up * up + down * down + 2 * aside * aside), 1e-10,
                       "ideal lens, all four");
        if (a < 0.1) {
            const double N = f / (2 * a);
            CHECK_RELATIVE(found.tangential, N / (cos(t) * cos(t)), 1e-7, "cosine squared");
            CHECK_RELATIVE(found.sagittal, N / cos(t), 1e-7, "cosine");
        }
    }
}

/* A frame 100 in front of that stop, 40 high: of a field of 10 degrees it ends the fan. */
static void test_clipped(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 100 air 60\n"
                               "stop - 0 air 50\nthin 100 100 air\n";
    const double f = 100, t = 10 * RADIANS_PER_DEGREE, y = f * tan(t), chief = hypot(f, y);
    const struct field_point field = {FIELD_ANGLE, {0, t}};
    const struct working_fnumber found = find(text, &field, true), open = find(text, &field, false);
    /* light goes up: what enters at -30 crosses the stop 100 tan(t) higher, at most at +25 */
    const double low = fmax(y - 30, -25), high = 25;
    const double up = sin(atan2(y - low, f) - t), down = sin(t - atan2(y - high, f));
    CHECK_RELATIVE(found.tangential, 1 / (2 * sqrt((up * up + down * down) / 2)), 1e-8,
                   "clipped, tangential");
    CHECK(fabs(chief) > 0 && found.tangential > open.tangential);
    CHECK_RELATIVE(open.sagittal, hypot(25, chief) / 50, 1e-10, "open, sagittal");
}

/* An afocal telescope has no cone. */
static void test_afocal(void)
{
    const struct working_fnumber found =
        find("wavelength d\nobject inf\naperture stop\nfocus afocal\n"
             "surface -200 -150 mirror 80 k=-1 stop\nsurface 100 120 mirror 200 k=-1\n",
             &axis, true);
    CHECK(isnan(found.both) && isnan(found.tangential) && isnan(found.sagittal));
}

int main(void)
{
    test_paraboloid();
    test_index();
    test_ideal_lens();
    test_clipped();
    test_afocal();
    return check_report();
}
