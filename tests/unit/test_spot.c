/* tests/unit/test_spot.c - the two directions that spots of angles lie along. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"
#include "base/constants.h"
#include "check.h"
#include "lens_of.h"

static double product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Across the direction and each other, of length 1; upright, whichever way the light goes. */
static void test_axes(void)
{
    static const double directions[][3] = {{0, 0, 1},
                                           {0, 0.6, 0.8},
                                           {0, -0.6, -0.8},
                                           {2. / 7, 3. / 7, 6. / 7},
                                           {-6. / 7, 2. / 7, -3. / 7},
                                           {1, 0, 0}};
    for (size_t i = 0; i < sizeof directions / sizeof directions[0]; i++) {
        const double *d = directions[i];
        double across[2][3];
        spot_axes(d, across);
        for (int k = 0; k < 2; k++) {
            CHECK_NEAR(product(across[k], d), 0, 1e-15, "across the direction");
            CHECK_NEAR(product(across[k], across[k]), 1, 1e-15, "its length");
        }
        CHECK_NEAR(product(across[0], across[1]), 0, 1e-15, "across each other");
        CHECK(across[1][0] == 0 && across[1][1] > 0);
        CHECK(d[2] == 0 || across[0][0] > 0);
    }
}

/*
 * Straight rays: a beam of the radius 5 of which what lies below -2 is cut off, on a plane behind.
 * Of a segment the moments are integrals of the chord 2 sqrt(25 - y^2).
 */
static void test_segment(bool about_chief, bool turned)
{
    const double a = 5, c = 2, corner = sqrt(a * a - c * c), angle = acos(-c / a);
    const double area = a * a * (angle - sin(2 * angle) / 2); /* of the disc above -c */
    const double mean = 2 * corner * corner * corner / 3 / area;
    const double square = (a * a / 4 * area - c * corner * corner * corner / 2) / area;
    const double size =
        (a * a / 2 * area - c * corner * corner * corner / 3) / area; /* x^2 + y^2 */
    const double across = size - square, along = square - mean * mean;
    const int up = turned ? 0 : 1;
    struct arena arena = {0};
    struct lens lens = lens_of(turned ? "wavelength d\nobject inf\naperture stop\nfocus afocal\n"
                                        "stop - 10 air 10\nsurface - 10 air 40\n"
                                        "pass polygon -2,-9 9,-9 9,9 -2,9\n"
                                      : "wavelength d\nobject inf\naperture stop\nfocus afocal\n"
                                        "stop - 10 air 10\nsurface - 10 air 40\n"
                                        "pass polygon -9,-2 9,-2 9,9 -9,9\n",
                               &arena);
    const struct setup_question asked = {.lens = &lens, .wavelength = NAN, .fnumber = NAN};
    const struct plane_value plane = {.kind = PLANE_AT, .distance = 50};
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    struct setup setup = {0};
    struct error error = {0};
    CHECK(setup_open(&asked, &arena, &setup, &error) && setup_place_image(&setup, &plane, &error));
    const struct spot_question question = {
        .bundle = {.setup = &setup, .field = &axis, .clip = true},
        .error = 1e-5,
        .about_chief = about_chief,
        .energy = 0.1};
    struct spot spot = {0};
    const bool found = spot_find(&question, &arena, &spot, &error);
    CHECK(found && spot.has_converged && !spot.is_angular);
    if (!found) {
        printf("%s\n", error.message);
    }
    CHECK_RELATIVE(spot.clear, area / (a * a * PI), 1e-5, "clear");
    CHECK_NEAR(spot.centroid[up], mean, 1e-4, "centroid");
    CHECK(spot.centroid[1 - up] == 0);
    CHECK_RELATIVE(up == 1 ? spot.rms_y : spot.rms_x, sqrt(along), 1e-4, "rms along");
    CHECK_RELATIVE(up == 1 ? spot.rms_x : spot.rms_y, sqrt(across), 1e-4, "rms across");
    CHECK_RELATIVE(spot.rms, sqrt(along + across), 1e-4, "rms");
    CHECK_RELATIVE(spot.rms_chief, sqrt(size), 1e-4, "about the chief ray");
    const double far = hypot(corner, c + mean), top = a - mean;
    CHECK_RELATIVE(spot.radius, about_chief ? a : fmax(far, top), 5e-6, "the farthest ray");
    CHECK(spot.radius_error < 1e-3);
    /* a tenth lies in a circle that is inside: about the chief ray as about the centroid */
    CHECK_RELATIVE(spot.energy_radius, sqrt(0.1 * area / PI), 2e-3, "a tenth of the light");
    arena_free(&arena);
}

int main(void)
{
    test_segment(true, false);
    test_segment(false, false);
    test_segment(true, true);
    test_segment(false, true);
    test_axes();
    return check_report();
}
