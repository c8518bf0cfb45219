/* tests/unit/test_film_light.c - light on the film: the closed form of a disc, and exact edges. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/lens_film.h"

#include "analysis/rays/illumination.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"

static struct error error;
static struct arena arena;

struct fixture {
    struct lens lens;
    struct setup setup;
    struct lens_film film;
};

/* The lens with its film where it is in focus, or so far behind it, mm. */
static bool open_film(double behind, struct fixture *fixture)
{
    const struct setup_question question = {
        .lens = &fixture->lens, .wavelength = NAN, .wavelengths = WAVELENGTHS_ALL, .fnumber = NAN};
    const struct plane_value at = {.kind = PLANE_AT, .distance = behind};
    const struct plane_value focused = {.kind = PLANE_PARAXIAL};
    const struct film_question asked = {.setup = &fixture->setup, .width = 36, .height = 24};
    const bool good =
        setup_open(&question, &arena, &fixture->setup, &error) &&
        setup_place_image(&fixture->setup, isfinite(behind) ? &at : &focused, &error) &&
        lens_film_open(&asked, &arena, &fixture->film, &error);
    CHECK(good);
    return good;
}

static double light_at(const struct fixture *fixture, double height)
{
    enum { BLOCKS = 8 };
    static struct film_samples samples;
    const struct rays rays = rays_new(&arena, RAYS_BLOCK);
    struct lens_film aimed = fixture->film;
    aimed.start = aimed.aim;
    const double at[2] = {0.6 * height, 0.8 * height};
    return lens_film_light(&aimed, at, 0, BLOCKS, &samples, &rays);
}

/* A disc of even light seen from beside its axis, as Foote (1915) has it in closed form. */
static double disc_light(double radius, double distance, double height)
{
    const double a = pow(radius / distance, 2), t = pow(height / distance, 2);
    return PI / 2 * (1 - (1 + t - a) / sqrt(t * t + 2 * t * (1 - a) + (1 + a) * (1 + a)));
}

static void check_disc(void)
{
    struct fixture fixture;
    if (!lens_read("test",
                   text_of("lens thin\nwavelength d\nobject inf\naperture stop\n"
                           "surface 100 0.001 1.5 -\nsurface -100 5 air -\nstop - 95 air 30\n"),
                   NULL, &arena, &fixture.lens, &error) ||
        !open_film(95, &fixture)) {
        CHECK(false);
        return;
    }
    for (double height = 0; height < 21; height += 3) {
        const double expected = disc_light(15, 95, height);
        CHECK_RELATIVE(light_at(&fixture, height), expected, 3e-5, "disc");
    }
}

/* Plates bend nothing: through the middle of the stop, 95 mm before the film, rays go straight. */
static void check_chief(void)
{
    static const double off = 2e-5; /* a fifth of the stop's radius */
    static const double steps[][2] = {{3, 4}, {-12, 5}, {8, -15}, {0, 11}, {-0.5, 0}};
    static struct film_samples samples;
    struct fixture fixture;
    if (!lens_read("test",
                   text_of("lens plate\nwavelength d\nobject inf\naperture stop\n"
                           "surface - 2 1.5 -\nsurface - 5 air -\nstop - 95 air 0.02\n"),
                   NULL, &arena, &fixture.lens, &error) ||
        !open_film(95, &fixture)) {
        CHECK(false);
        return;
    }
    struct rays rays = rays_new(&arena, RAYS_BLOCK);
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++) {
        const double x = steps[i][0], y = steps[i][1], h = hypot(x, y), length = hypot(h, 95);
        CHECK_NEAR(lens_film_angle(&fixture.film, steps[i], &samples, &rays),
                   atan(h / 95) - atan(1e-6 * h / 95), off, "angle of a step");
        lens_film_chief(&fixture.film, steps[i], &samples, &rays);
        CHECK_NEAR(rays.blocks->p[0], -x / length, off, "chief ray: x");
        CHECK_NEAR(rays.blocks->q[0], -y / length, off, "chief ray: y");
        CHECK_NEAR(rays.blocks->r[0], -95 / length, off, "chief ray: z");
    }
}

/* Where several edges cut the pupil: by those that are found to the last digit. */
static void check_vignetted(const char *name, double reach)
{
    struct fixture fixture;
    struct lensdb db = {.arena = &arena};
    if (!lens_open(&db, text_of(name), &arena, &fixture.lens, &error) ||
        !open_film(NAN, &fixture)) {
        CHECK(false);
        return;
    }
    struct setup *setup = &fixture.setup;
    const struct system *clipped = setup_system(setup, 0, SETUP_CLIPPED | SETUP_REVERSED, &error);
    const struct system *open = setup_system(setup, 0, SETUP_REVERSED, &error);
    for (double height = 0; height <= reach && clipped != NULL && open != NULL;
         height += reach / 8) {
        const struct beam beam =
            beam_from_film((double[3]){0, height, setup->image}, open->index_first);
        const struct illumination_question question = {
            .clipped = clipped, .open = open, .beam = &beam, .first = &setup->first, .error = 1e-7};
        const double expected = illumination_of_film(&question, &arena).value;
        CHECK_RELATIVE(light_at(&fixture, height), expected, 2e-4, name);
    }
}

int main(void)
{
    check_disc();
    check_chief();
    check_vignetted("double-gauss-50", 20);
    arena_free(&arena);
    return check_report();
}
