/* tests/unit/test_chromatic.c - foci and chief rays by wavelength. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/chromatic.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/wavelength.h"

#define TRIPLET                                                                                    \
    "surface 22.01359 3.25896 1.62041/60.32 19\nsurface -435.76044 6.00755 air 18\n"               \
    "surface -22.21328 0.99998 1.62004/36.37 11\nsurface 20.29192 2.2 air 10\n"                    \
    "surface - 2.55041 air 10 stop\nsurface 79.68360 2.95208 1.62041/60.32 15\n"                   \
    "surface -18.39533 42.20778 air 16\n"

/* A telescope of thin plano-convex and plano-concave lenses, f 150 and -50. */
#define TELESCOPE                                                                                  \
    "aperture epd 20\nfield angle 1\nwavelength d F C\nsurface 75 0 1.5/60 - stop\n"               \
    "surface - 100 air -\nsurface -25 0 1.5/60 -\nsurface - 0 air -\n"

static struct setup open_setup(const char *text, struct arena *arena)
{
    struct error error = {0};
    struct setup setup = {0};
    struct lens *lens = ARENA_NEW(arena, struct lens);
    bool read = lens_read("test", text_of(text), NULL, arena, lens, &error);
    const struct setup_question question = {
        .lens = lens, .wavelength = NAN, .fnumber = NAN, .field_policy = FIELDS_LARGEST};
    const struct plane_value paraxial = {.kind = PLANE_OF_LENS};
    read = read && setup_open(&question, arena, &setup, &error) &&
           setup_place_image(&setup, &paraxial, &error);
    if (!read) {
        printf("%s\n", error.message);
    }
    CHECK(read);
    return setup;
}

static struct chromatic_focus focus_at(const struct setup *setup, double wavelength)
{
    struct error error;
    struct chromatic_focus focus = {NAN, NAN, RAY_MISS};
    CHECK(chromatic_focus(setup, wavelength, &focus, &error));
    return focus;
}

/* Expected values: an independent 50-digit program, ../shared/reference/truth/cooke_triplet. */
static void check_triplet(void)
{
    static const struct {
        double wavelength, image, marginal, zone, chief;
    } cases[] = {
        {WAVELENGTH_D, 42.43641206318323, -0.25974249243647817, -0.08415674458169792,
         18.23249722876230},
        {WAVELENGTH_F, 42.37569188574176, -0.28351966886086474, -0.13669652374542663,
         18.23979087631792},
        {WAVELENGTH_C, 42.45965536407373, NAN, NAN, 18.22963027652269},
    };
    struct arena arena = {0};
    const struct setup setup =
        open_setup("wavelength d F C\naperture epd 10\nfield angle 20\n" TRIPLET, &arena);
    struct chromatic_chief primary = {{NAN, NAN}, {NAN, NAN}, RAY_MISS};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error error;
        struct chromatic_focus focus = focus_at(&setup, cases[i].wavelength), real;
        struct chromatic_chief chief;
        CHECK_RELATIVE(focus.image, cases[i].image, 3e-16, "paraxial image");
        CHECK_RELATIVE(focus.vergence, 1 / cases[i].image, 3e-16, "vergence");
        if (!isnan(cases[i].zone)) {
            CHECK(chromatic_zone(&setup, cases[i].wavelength, 1, true, &real, &error));
            CHECK(real.status == RAY_OK);
            CHECK_NEAR(real.image - setup.first.image, cases[i].marginal, 1e-12, "margin");
            CHECK_RELATIVE(real.vergence, 1 / real.image, 1e-14, "vergence of a real ray");
            CHECK(chromatic_zone(&setup, cases[i].wavelength, -0.5, true, &real, &error));
            CHECK_NEAR(real.image - setup.first.image, cases[i].zone, 1e-12, "half the aperture");
        }
        CHECK(chromatic_zone(&setup, cases[i].wavelength, 0, false, &real, &error));
        CHECK(real.image == focus.image);
        CHECK(chromatic_chief(&setup, &setup.edge, cases[i].wavelength, &chief, &error));
        CHECK(chief.status == RAY_OK);
        CHECK_NEAR(chief.height[0], 0, 0, "x of the chief ray");
        CHECK_RELATIVE(chief.height[1], cases[i].chief, 1e-14, "chief ray");
        primary = i == 0 ? chief : primary;
        const double up[2] = {0, 1}, aslant[2] = {0.6, 0.8};
        const double shift = cases[i].chief - cases[0].chief;
        CHECK_NEAR(chromatic_lateral(&primary, &chief, up).height, shift, 1e-13, "lateral");
        CHECK_NEAR(chromatic_lateral(&primary, &chief, aslant).height, 0.8 * shift, 1e-13,
                   "lateral");
    }
    arena_free(&arena);
}

/* Height 1 in, by thin lenses: f = R/(n - 1), y = 1 - 100/f1, vergence -v/y. */
static void check_telescope(void)
{
    const double strength =
        0.5 / 60 / (1 / (WAVELENGTH_F * WAVELENGTH_F) - 1 / (WAVELENGTH_C * WAVELENGTH_C));
    struct arena arena = {0};
    const struct setup setup = open_setup(TELESCOPE, &arena);
    const double waves[] = {WAVELENGTH_D, WAVELENGTH_F, WAVELENGTH_C};
    CHECK(isnan(setup.image));
    struct chromatic_chief chiefs[3];
    for (size_t i = 0; i < 3; i++) {
        struct error error;
        const double n =
            1.5 + strength * (1 / (waves[i] * waves[i]) - 1 / (WAVELENGTH_D * WAVELENGTH_D));
        const double P1 = (n - 1) / 75, P2 = -(n - 1) / 25, y = 1 - 100 * P1;
        CHECK_NEAR(focus_at(&setup, waves[i]).vergence, P1 / y + P2, 1e-17, "vergence");
        CHECK(chromatic_chief(&setup, &setup.edge, waves[i], &chiefs[i], &error));
        CHECK(isnan(chiefs[i].height[1]));
    }
    CHECK(isinf(focus_at(&setup, WAVELENGTH_D).image));
    const double up[2] = {0, 1};
    const struct chromatic_lateral lateral = chromatic_lateral(&chiefs[0], &chiefs[1], up);
    CHECK(isnan(lateral.height));
    CHECK_RELATIVE(lateral.angle, atan(chiefs[1].slope[1]) - atan(chiefs[0].slope[1]), 1e-12,
                   "angle");
    arena_free(&arena);
}

static void check_axial(void)
{
    const struct chromatic_focus a = {99, 0, RAY_OK}, b = {100, 0, RAY_OK}, c = {103, 0, RAY_OK},
                                 far = {INFINITY, 0, RAY_OK};
    CHECK_NEAR(chromatic_axial(&a, &b, &c).primary, -4, 0, "99 - 103");
    CHECK_NEAR(chromatic_axial(&a, &b, &c).secondary, 1, 0, "101 - 100");
    CHECK(isnan(chromatic_axial(&a, &a, &c).secondary) &&
          isnan(chromatic_axial(&a, &c, &c).secondary));
    CHECK_NEAR(chromatic_axial(&a, &a, &c).primary, -4, 0, "99 - 103");
    CHECK(isnan(chromatic_axial(&a, &far, &c).primary));
}

/* A ray that the lens does not let through is said to be lost; without a stop there is none. */
static void check_lost(void)
{
    struct arena arena = {0};
    struct error error;
    struct chromatic_focus focus;
    struct chromatic_chief chief;
    const struct setup ball = open_setup(
        "aperture stop\nfield angle 1\nstop - 1 air 30\nsurface 10 20 1.9 -\nsurface -10 0 air -\n",
        &arena);
    CHECK(chromatic_zone(&ball, WAVELENGTH_D, 0.5, false, &focus, &error) &&
          focus.status == RAY_OK && focus.image < focus_at(&ball, WAVELENGTH_D).image);
    CHECK(chromatic_zone(&ball, WAVELENGTH_D, 0.9, false, &focus, &error) &&
          focus.status == RAY_MISS && isnan(focus.image) && isnan(focus.vergence));
    const struct setup open = open_setup("surface 50 0 1.5 -\nfield angle 3\n", &arena);
    CHECK(!chromatic_zone(&open, WAVELENGTH_D, 1, false, &focus, &error));
    CHECK(!chromatic_chief(&open, &open.edge, WAVELENGTH_D, &chief, &error));
    arena_free(&arena);
}

int main(void)
{
    check_triplet();
    check_telescope();
    check_axial();
    check_lost();
    return check_report();
}
