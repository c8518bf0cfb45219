/* tests/unit/test_footprint.c - footprints of beams between plane surfaces, by circles. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/footprint.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"

enum { SURFACES = 3 };

/* Footprints of a field of 10 degrees in x or y; false: with an error. */
static bool find(const char *text, double x, double y, bool clip, struct footprint *list,
                 struct arena *arena, struct error *error)
{
    struct setup *setup = ARENA_NEW(arena, struct setup);
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct field_point *field = ARENA_NEW(arena, struct field_point);
    const struct setup_question question = {
        .lens = lens, .wavelength = NAN, .fnumber = NAN, .wavelengths = WAVELENGTHS_PRIMARY};
    *field = (struct field_point){FIELD_ANGLE, {x, y}};
    const struct bundle_question bundle = {.setup = setup, .field = field, .clip = clip};
    CHECK(lens_read("test", text_of(text), NULL, arena, lens, error) &&
          setup_open(&question, arena, setup, error));
    setup->image = NAN;
    return footprints_find(&bundle, arena, list, error);
}

/* A stop of radius 10, 30 behind one plane and 20 in front of another: circles, moved by tan t. */
static void test_circles(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 30 air 80\n"
                               "stop - 20 air 20\nsurface - 10 air -\n";
    static const double behind[SURFACES] = {-30, 0, 20};
    const double t = 10 * RADIANS_PER_DEGREE;
    for (int axis = 0; axis < 2; axis++) {
        struct arena arena = {0};
        struct error error = {0};
        struct footprint list[SURFACES];
        CHECK(find(text, axis == 0 ? t : 0, axis == 0 ? 0 : t, true, list, &arena, &error));
        for (size_t i = 0; i < SURFACES; i++) {
            const double middle = behind[i] * tan(t);
            CHECK_NEAR(list[i].low[axis], middle - 10, 1e-9, "low along the field");
            CHECK_NEAR(list[i].high[axis], middle + 10, 1e-9, "high along the field");
            CHECK_NEAR(list[i].low[1 - axis], -10, 1e-9, "low across it");
            CHECK_NEAR(list[i].high[1 - axis], 10, 1e-9, "high across it");
            CHECK_NEAR(list[i].radius, 10 + fabs(middle), 1e-9, "largest radius");
            for (size_t k = 0; k < list[i].count; k++) {
                const double *at = list[i].outline[k];
                CHECK_NEAR(hypot(at[1 - axis], at[axis] - middle), 10, 1e-9, "outline");
            }
        }
        arena_free(&arena);
    }
}

/* A rim of radius 9 on the first plane clips that beam: two circles cut each other. */
static void test_clipped(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 30 air 18\n"
                               "stop - 20 air 20\nsurface - 10 air -\n";
    const double t = 10 * RADIANS_PER_DEGREE, shift = 30 * tan(t);
    /* |(x, y)| = 9 and |(x, y + shift)| = 10 at y: the widest places of both lie within them */
    const double y = (100 - 81 - shift * shift) / (2 * shift), x = sqrt(81 - y * y);
    struct arena arena = {0};
    struct error error = {0};
    struct footprint list[SURFACES];
    CHECK(find(text, 0, t, true, list, &arena, &error));
    CHECK_NEAR(list[0].low[1], -9, 1e-9, "the rim");
    CHECK_NEAR(list[0].high[1], 10 - shift, 1e-9, "the stop");
    CHECK_NEAR(list[0].high[0], y < 0 && y > -shift ? x : 9, 1e-6, "the corner");
    CHECK_NEAR(list[0].radius, 9, 1e-9, "the rim is reached");
    CHECK_NEAR(list[1].low[1], shift - 9, 1e-9, "in the stop");
    CHECK_NEAR(list[1].high[1], 10, 1e-9, "its edge");
    CHECK(find(text, 0, t, false, list, &arena, &error));
    CHECK_NEAR(list[0].radius, 10 + shift, 1e-9, "not clipped");
    arena_free(&arena);
}

/* Nothing comes through: named. */
static void test_dark(void)
{
    static const char text[] = "wavelength d\nobject inf\naperture stop\nsurface - 30 air 2\n"
                               "stop - 20 air 2\nsurface - 10 air -\n";
    struct arena arena = {0};
    struct error error = {0};
    struct footprint list[SURFACES];
    CHECK(!find(text, 0, 10 * RADIANS_PER_DEGREE, true, list, &arena, &error));
    CHECK(error.code == ERROR_DOMAIN);
    arena_free(&arena);
}

int main(void)
{
    test_circles();
    test_clipped();
    test_dark();
    return check_report();
}
