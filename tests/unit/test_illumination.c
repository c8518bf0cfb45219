/* tests/unit/test_illumination.c - light in the image: closed forms, and values of 50 digits. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/illumination.h"

#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "optics/aperture.h"
#include "trace/aim/aim.h"

/* A lens both ways. */
struct opened {
    struct arena arena;
    struct lens lens;
    struct first_order first;
    struct conjugate_object object;
    struct system clipped, open, clipped_back, open_back;
};

static bool set_up(struct opened *opened, const char *text)
{
    struct error error;
    *opened = (struct opened){.arena = {0}};
    struct arena *arena = &opened->arena;
    struct system_options options = system_options_default();
    bool good = lens_read("test", text_of(text), NULL, arena, &opened->lens, &error);
    const double wavelength = good ? lens_primary_wavelength(&opened->lens) : 0;
    if (!good ||
        !first_order_of_lens(&opened->lens, wavelength, SECTION_Y, arena, &opened->first, &error)) {
        printf("%s\n", error.message);
        CHECK(false);
        return false;
    }
    const struct aperture_setting aperture = lens_aperture(&opened->lens);
    opened->object = lens_object(&opened->lens);
    CHECK(first_order_aperture(&opened->first, &opened->object, &aperture, FIELD_NONE, 0, &error));
    struct system *const systems[] = {&opened->open, &opened->clipped, &opened->open_back,
                                      &opened->clipped_back};
    for (int i = 0; i < 4; i++) {
        options.clip = i % 2 == 1;
        options.reverse = i >= 2;
        CHECK(system_compile(&opened->lens, wavelength, &options, arena, systems[i], &error));
    }
    return true;
}

static struct illumination film(struct opened *opened, double x, double y, double z, double error)
{
    const struct beam beam = beam_from_film((double[3]){x, y, z}, opened->open_back.index_first);
    const struct illumination_question question = {.clipped = &opened->clipped_back,
                                                   .open = &opened->open_back,
                                                   .beam = &beam,
                                                   .first = &opened->first,
                                                   .error = error};
    return illumination_of_film(&question, &opened->arena);
}

static struct illumination field(struct opened *opened, double value)
{
    const struct field_point point = {opened->object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {0, value}};
    struct beam beam;
    struct error error;
    struct aim aim;
    CHECK(beam_of_field(&point, &opened->object, &opened->first, &beam, &error));
    CHECK(aim_open(&opened->open, &beam, &opened->arena, &aim, &error));
    const struct illumination_question question = {.clipped = &opened->clipped,
                                                   .open = &opened->open,
                                                   .beam = &beam,
                                                   .first = &opened->first,
                                                   .inside = aim.chief,
                                                   .error = 1e-12};
    return illumination_of_field(&question, &opened->arena);
}

/* A disc of the radius tan(a), seen at the field angle t: exact, not cos^4. */
static double disc(double tan_a, double tan_t)
{
    double a2 = tan_a * tan_a, t2 = tan_t * tan_t;
    return PI / 2 * (1 - (1 + t2 - a2) / sqrt(t2 * t2 + 2 * t2 * (1 - a2) + (1 + a2) * (1 + a2)));
}

static void test_disc(void)
{
    static const double heights[] = {0, 1, 10, 50, 150};
    struct opened opened;
    if (!set_up(&opened, "lens disc\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n")) {
        return;
    }
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        double h = heights[i], expected = disc(0.5, h / 50);
        struct illumination light = film(&opened, 0, h, 50, 1e-12);
        CHECK_RELATIVE(light.value, expected, 1e-13, "a disc");
        CHECK(light.is_met && light.error >= fabs(light.value - expected));
        /* and beside the y axis */
        light = film(&opened, 0.6 * h, -0.8 * h, 50, 1e-12);
        CHECK_RELATIVE(light.value, expected, 1e-13, "a disc, from beside");
    }
    arena_free(&opened.arena);
    /* within glass all the way to the film n^2 times as much comes into the same cone */
    if (set_up(&opened, "lens disc\nwavelength d\nobject inf\naperture stop\nsurface - 0 1.5 -\n"
                        "stop - 0 1.5 50\n")) {
        CHECK_RELATIVE(film(&opened, 0, 10, 50, 1e-12).value, 2.25 * disc(0.5, 0.2), 1e-13,
                       "a disc within glass");
        arena_free(&opened.arena);
    }
}

static void test_ring(void)
{
    static const double heights[] = {0, 5, 40};
    struct opened opened;
    if (!set_up(&opened, "lens ring\nwavelength d\nobject inf\naperture stop\nstop - 0 air 50\n"
                         "block circle 20\n")) {
        return;
    }
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        double h = heights[i], expected = disc(0.5, h / 50) - disc(0.2, h / 50);
        struct illumination light = film(&opened, 0, h, 50, 1e-10);
        CHECK_RELATIVE(light.value, expected, 1e-9, "a ring");
        CHECK(light.error >= fabs(light.value - expected) - 1e-14);
    }
    arena_free(&opened.arena);
}

/* On the axis only the marginal ray counts: pi n'^2 sin^2; a sphere refracting at its centre. */
static void test_axis(void)
{
    struct opened opened;
    /* from its focus in front of a paraboloid mirror: parallel light behind it, sin = known */
    if (!set_up(&opened, "lens paraboloid\nwavelength d\nobject inf\naperture stop\n"
                         "surface -200 -100 mirror 80 k=-1 stop\n")) {
        return;
    }
    /* h = 2 f tan(u/2), f = 100 */
    const double u = 2 * atan(40.0 / 200);
    struct illumination light = film(&opened, 0, 0, -100, 1e-12);
    CHECK_RELATIVE(light.value, PI * sin(u) * sin(u), 1e-13, "a mirror from its focus");
    light = field(&opened, 0);
    CHECK_RELATIVE(light.value, PI * sin(u) * sin(u), 1e-13, "a mirror towards its focus");
    arena_free(&opened.arena);
}

/* Relative to the axis, the stop alone limits: an independent program. */
static const struct {
    const char *text;
    double field, height, plane, at_point, of_field; /* rad or mm, mm, mm */
} known[] = {
    {"lens Smith's double Gauss\nwavelength d\nobject inf\naperture stop\n"
     "surface 58.95 7.52 1.67/47.1 -\nsurface 169.66 0.24 air -\n"
     "surface 38.55 8.05 1.67/47.1 -\nsurface 81.54 6.55 1.699/30.1 -\n"
     "surface 25.5 11.41 air -\nstop - 9 air 34.2\nsurface -28.99 2.36 1.603/38 -\n"
     "surface 81.54 12.13 1.658/57.3 -\nsurface -40.77 0.38 air -\n"
     "surface 874.13 6.44 1.717/48 -\nsurface -79.46 72.228 air -\n",
     14 * RADIANS_PER_DEGREE, 24.99567298304572989117, 72.21181047708427469653,
     0.915876739096261577027, 0.8682914830785470003942},
};

static void test_known(void)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct opened opened;
        if (!set_up(&opened, known[i].text)) {
            return;
        }
        struct illumination axis = film(&opened, 0, 0, known[i].plane, 1e-12);
        struct illumination light = film(&opened, 0, known[i].height, known[i].plane, 1e-12);
        CHECK_RELATIVE(light.value / axis.value, known[i].at_point, 1e-12, "at the point");
        axis = field(&opened, 0);
        light = field(&opened, known[i].field);
        CHECK_RELATIVE(light.value / axis.value, known[i].of_field, 1e-12, "of the field");
        arena_free(&opened.arena);
    }
}

/* The other apertures go, the stop's stay; and the lens that was given keeps all. */
static void test_stop_only(void)
{
    struct opened opened;
    if (!set_up(&opened, "lens stop\nwavelength d\nobject inf\naperture stop\n"
                         "surface 50 5 1.5 10\nblock circle 2\nstop - 0 air 4\npass rectangle 3 3\n"
                         "block circle 1\n")) {
        return;
    }
    const struct lens *bare = illumination_stop_only(&opened.lens, &opened.arena);
    CHECK(!bare->surfaces[0].has_diameter && bare->surfaces[0].aperture_count == 0);
    CHECK(bare->surfaces[1].has_diameter && bare->surfaces[1].aperture_count == 1);
    CHECK(!bare->surfaces[1].apertures[0].blocks);
    CHECK(opened.lens.surfaces[1].aperture_count == 2);
    CHECK(opened.lens.surfaces[0].has_diameter && opened.lens.surfaces[0].aperture_count == 1);
    arena_free(&opened.arena);
}

int main(void)
{
    test_disc();
    test_ring();
    test_axis();
    test_known();
    test_stop_only();
    return check_report();
}
