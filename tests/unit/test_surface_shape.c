/* tests/unit/test_surface_shape.c - slopes, edges and volumes against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "lens_of.h"
#include "optics/surface_shape.h"

#include <math.h>

static void test_profiles(void)
{
    struct arena arena = {0};
    const struct lens lens = lens_of("object inf\naperture epd 10\n"
                                     "surface 50 4 1.5 40\nsurface -200 10 air 40 k=-1\n"
                                     "surface - 3 1.5 40 A4=1e-5 A3=2e-4\n"
                                     "surface 30 1 air 40 k=0.5\n",
                                     &arena);
    const struct surface_shape sphere = surface_shape_at(&lens.surfaces[0], 30);
    CHECK_NEAR(sphere.sag, 10, 1e-12, "50 - 40, of the triangle 30, 40, 50");
    CHECK_NEAR(sphere.slope, 30 / 40., 1e-14, "h/sqrt(R^2 - h^2)");
    CHECK_NEAR(sphere.departure, 0, 1e-13, "of a sphere from itself");
    const struct surface_shape parabola = surface_shape_at(&lens.surfaces[1], -20);
    CHECK_NEAR(parabola.sag, -1, 1e-13, "h^2/2R");
    CHECK_NEAR(parabola.slope, 0.1, 1e-14, "h/R");
    CHECK_NEAR(parabola.departure, -1 + 200 - sqrt(200. * 200 - 400), 1e-12, "from the sphere");
    const struct surface_shape asphere = surface_shape_at(&lens.surfaces[2], 10);
    CHECK_NEAR(asphere.sag, 0.1 + 0.2, 1e-13, "A4 h^4 + A3 h^3");
    CHECK_NEAR(asphere.slope, 0.04 + 0.06, 1e-14, "4 A4 h^3 + 3 A3 h^2");
    /* an ellipsoid of k = 0.5 and R = 30: half axes R/sqrt(1.5) across and R/1.5 along */
    const double across = 30 / sqrt(1.5), along = 20;
    const struct surface_shape ellipsoid = surface_shape_at(&lens.surfaces[3], 12);
    CHECK_NEAR(ellipsoid.sag, along * (1 - sqrt(1 - pow(12 / across, 2))), 1e-12, "an ellipse");
    CHECK_NEAR(ellipsoid.slope, along / across * 12 / sqrt(across * across - 144), 1e-13,
               "its slope");
    CHECK(isnan(surface_shape_at(&lens.surfaces[3], 25).sag));
    CHECK(isnan(surface_shape_at(&lens.surfaces[0], 51).slope));
    arena_free(&arena);
}

static double sphere_cap(double radius, double height)
{
    const double sag = radius - sqrt(radius * radius - height * height);
    return PI * sag * sag * (radius - sag / 3);
}

static void test_glass(void)
{
    struct arena arena = {0};
    const struct lens lens = lens_of("object inf\naperture epd 10\n"
                                     "surface 50 10 1.5 40\nsurface -60 10 air 40\n"
                                     "surface 25 50 1.5 50\nsurface -25 10 air 50\n"
                                     "surface -200 8 1.5 30 k=-1\nsurface - 1 air 40\n"
                                     "surface 50 6 1.5 -\nsurface -60 10 air 40\n"
                                     "surface 50 6 1.5 40 cyl=y\nsurface -60 10 air 40\n"
                                     "surface 30 2 1.5 20\nsurface -30 10 air 20\n",
                                     &arena);
    const struct glass_shape biconvex = glass_shape_behind(&lens, 0);
    const double left = 50 - sqrt(2500. - 400), right = 60 - sqrt(3600. - 400);
    CHECK_NEAR(biconvex.edge_thickness, 10 - left - right, 1e-12, "t less both sags");
    /* the cylinder of the edge between both caps */
    CHECK_RELATIVE(biconvex.volume,
                   PI * 400 * (10 - left - right) + sphere_cap(50, 20) + sphere_cap(60, 20), 1e-12,
                   "caps of spheres");
    const struct glass_shape ball = glass_shape_behind(&lens, 2);
    CHECK_RELATIVE(ball.volume, 4 / 3. * PI * pow(25, 3), 1e-9, "a ball");
    CHECK_NEAR(ball.edge_thickness, 0, 1e-12, "whose hemispheres meet");
    /* a paraboloid to 15 mm and flat from there: pi a^4/4R, and the ring of z = -a^2/2R */
    const struct glass_shape hollow = glass_shape_behind(&lens, 4);
    CHECK_RELATIVE(hollow.volume,
                   PI * 400 * 8 + PI * pow(15, 4) / 800 + PI * (400 - 225) * 225 / 400., 1e-12,
                   "flat to the rim");
    CHECK_NEAR(hollow.edge_thickness, 8 + 225 / 400., 1e-12, "at the flat");
    CHECK(isnan(glass_shape_behind(&lens, 6).volume));
    CHECK(isnan(glass_shape_behind(&lens, 6).edge_thickness));
    CHECK(isnan(glass_shape_behind(&lens, 8).volume));
    const struct glass_shape meeting = glass_shape_behind(&lens, 10);
    CHECK_NEAR(meeting.edge_thickness, 2 - 2 * (30 - sqrt(900. - 100)), 1e-12, "t less both sags");
    CHECK(isnan(meeting.volume));
    arena_free(&arena);
}

int main(void)
{
    test_profiles();
    test_glass();
    return check_report();
}
