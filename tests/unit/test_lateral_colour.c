/* tests/unit/test_lateral_colour.c - colours of a thin lens, in closed form. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/lateral_colour.h"

#include "check.h"
#include "file/lens_file.h"

/*
 * Equal sides of 100 mm make f = 50/(n - 1); the film lies at that of the second wavelength, a stop
 * of 10 mm so far before the lens.
 */
static const double indices[] = {1.506, 1.5, 1.497}, width = 10, film = 100;

static struct error error;
static struct arena arena;

struct fixture {
    struct lens lens;
    struct setup setup;
    struct lens_film film;
    struct lateral_colour_scratch *room;
};

static bool open_thin(double before, struct fixture *fixture)
{
    const char *const text =
        arena_printf(&arena,
                     "lens thin\nwavelength F d C\nobject inf\naperture stop\nstop - %g air %g\n"
                     "surface 100 0.001 {486.1327nm %g, 587.5618nm %g, 656.2725nm %g} -\n"
                     "surface -100 %g air -\n",
                     before, width, indices[0], indices[1], indices[2], film);
    const struct setup_question question = {
        .lens = &fixture->lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_AT, .distance = film};
    const struct film_question asked = {.setup = &fixture->setup, .width = 24, .height = 24};
    const bool good = lens_read("test", text_of(text), NULL, &arena, &fixture->lens, &error) &&
                      setup_open(&question, &arena, &fixture->setup, &error) &&
                      setup_place_image(&fixture->setup, &plane, &error) &&
                      lens_film_open(&asked, &arena, &fixture->film, &error);
    fixture->room = lateral_colour_scratch_new(3, &arena);
    CHECK(good);
    return good;
}

static double focal(size_t wavelength)
{
    return 50 / (indices[wavelength] - 1);
}

/* A tile of so large pixels, whose middle is there. */
static const struct lateral_colour *find(const struct fixture *fixture, double x, double y,
                                         double pixel)
{
    const double pixels[2] = {pixel, pixel};
    const struct film_plan plan = {
        .left = x - 0.5e-3, .bottom = y - 0.5e-3, .width = 1e-3, .height = 1e-3};
    return lateral_colour_find(&fixture->film, 3, 1, pixels, &plan, fixture->room);
}

/* A cone of the first wavelength, which is the farthest away, meets the film in such a disc. */
static void test_spread(void)
{
    struct fixture fixture;
    if (open_thin(0, &fixture)) {
        const double most = width * (film - focal(0)) / focal(0), least = most / FRINGES_MOST;
        CHECK(find(&fixture, 0, 0, 1.02 * least) != NULL);
        CHECK(find(&fixture, 0, 0, 0.96 * least) == NULL); /* of points that lie within its rim */
        const struct lateral_colour *fringes = find(&fixture, 0, 0, 2 * least);
        for (size_t w = 0; w < 3 && fringes != NULL; w++) {
            CHECK_NEAR(lateral_colour_moved(fringes, w, 0, 0.5, 0.5), 0, 1e-6,
                       "the middle of a disc");
        }
    }
}

/*
 * Through the middle of a stop l before it a ray of the slope t meets the lens at l t and the film
 * at h = l t + z (t - l t/f); the second wavelength comes there at h2 with the same t.
 */
static void test_moved(void)
{
    static const double before = 20, at[2] = {3, -2};
    struct fixture fixture;
    if (!open_thin(before, &fixture)) {
        return;
    }
    const struct lateral_colour *fringes = find(&fixture, at[0], at[1], 2);
    CHECK(fringes != NULL);
    for (size_t w = 0; w < 3 && fringes != NULL; w++) {
        const double own = before + film * (1 - before / focal(w));
        const double seconds = before + film * (1 - before / focal(1));
        for (int axis = 0; axis < 2; axis++) {
            const double expected = at[axis] * (seconds / own - 1);
            CHECK_NEAR(lateral_colour_moved(fringes, w, axis, 0.5, 0.5), expected,
                       0.02 * fabs(expected) + 1e-9, "between chief rays");
            CHECK(fringes->low[axis] <= expected * (expected < 0 ? 0.97 : 1) &&
                  fringes->high[axis] >= expected * (expected > 0 ? 0.97 : 1));
        }
    }
    CHECK(find(&fixture, 30, 0, 2) == NULL); /* where no light comes */
}

/* A wide tile: each of its corners by itself, and none is told of where one of them is dark. */
static void test_corners(void)
{
    static const double before = 20, left = 2, bottom = -5, tile[2] = {3, 2}, pixels[2] = {2, 2};
    struct fixture fixture;
    if (!open_thin(before, &fixture)) {
        return;
    }
    const struct film_plan plan = {
        .left = left, .bottom = bottom, .width = tile[0], .height = tile[1]};
    const struct lateral_colour *fringes =
        lateral_colour_find(&fixture.film, 3, 1, pixels, &plan, fixture.room);
    CHECK(fringes != NULL);
    for (int i = 0; i < 12 && fringes != NULL; i++) {
        const size_t w = (size_t)i / 4;
        const double across = i % 2, up = i / 2 % 2;
        const double own = before + film * (1 - before / focal(w));
        const double seconds = before + film * (1 - before / focal(1));
        const double at[2] = {left + across * tile[0], bottom + up * tile[1]};
        for (int axis = 0; axis < 2; axis++) {
            const double expected = at[axis] * (seconds / own - 1);
            CHECK_NEAR(lateral_colour_moved(fringes, w, axis, across, up), expected,
                       0.02 * fabs(expected) + 1e-9, "between chief rays of a corner");
        }
    }
    static const double edges[4][4] = {
        {2, 0, 28, 1}, {-30, 0, 32, 1}, {0, 2, 1, 28}, {0, -30, 1, 32}};
    for (int i = 0; i < 4; i++) {
        const struct film_plan dark = {.left = edges[i][0],
                                       .bottom = edges[i][1],
                                       .width = edges[i][2],
                                       .height = edges[i][3]};
        const double large[2] = {100, 100};
        CHECK(lateral_colour_find(&fixture.film, 3, 1, large, &dark, fixture.room) == NULL);
    }
}

int main(void)
{
    test_spread();
    test_moved();
    test_corners();
    arena_free(&arena);
    return check_report();
}
