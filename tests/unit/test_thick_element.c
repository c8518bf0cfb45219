/* tests/unit/test_thick_element.c - the thick lens in place of a lens has its first-order data. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "optics/first_order.h"
#include "optics/thick_lens.h"

static const char *const text =
    "lens a title\nunit cm\nwavelength d F\nobject 90\nfield height 0 1.2\nmedium 1.33\n"
    "aperture f/4\nposition wide tele\nlet d 1 2\nlet object 90 80\n"
    "surface 5 d 1.5 3\nstop - 1 1.5 1\nsurface -4 6 1.2 3\n";

static void read_text(struct arena *arena, struct lens *lens)
{
    struct error error = {0};
    bool good = lens_read("t.lens", text_of(text), NULL, arena, lens, &error);
    CHECK(good);
    if (!good) {
        printf("%s\n", error.message);
    }
}

static void check_plain(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        CHECK(surface->is_plane && surface->has_thickness &&
              surface->thickness.variable == LENS_NONE);
        CHECK(surface->radius.value.hi == 0 && surface->curvature.value.hi == 0);
        CHECK(surface->conic.value.hi == 0 && surface->diameter.variable == LENS_NONE);
        for (int k = 0; k < LENS_COEFFICIENTS; k++) {
            CHECK(surface->coefficient[k].value.hi == 0);
            CHECK(surface->coefficient[k].variable == LENS_NONE);
        }
        CHECK(surface->has_diameter == (i == lens->stop));
        CHECK(surface->is_stop == (i == lens->stop));
    }
}

/* From first to last vertex 40; f = 70 in 1.33 and 1.2, H at 25, H' at -12, the pupil anywhere. */
static void check_stand_in(double pupil, double fnumber)
{
    struct arena arena = {0};
    struct lens real;
    struct error error = {0};
    struct first_order first;
    struct lens_warnings warnings;
    read_text(&arena, &real);
    const struct thick_stand_in stand_in = {.thick = {.focal = 70,
                                                      .front = 25,
                                                      .rear = -12,
                                                      .index_object = 1.33,
                                                      .index_image = 1.2,
                                                      .distortion = {0.1, -0.02, 0.003}},
                                            .length = 40,
                                            .pupil = pupil,
                                            .pupil_diameter = 13,
                                            .fnumber = fnumber,
                                            .image = 90.5,
                                            .title = "stand-in",
                                            .note = "a note"};
    const struct lens lens = thick_element_lens(&real, &stand_in, &arena);
    bool has_stop = isfinite(pupil);
    CHECK(lens_check(&lens, &arena, &warnings, &error));
    CHECK(lens.surface_count == (has_stop ? 4u : 3u));
    CHECK(lens.stop == (has_stop ? 1 : LENS_NONE));
    CHECK_TEXT(lens.title, "stand-in");
    CHECK_TEXT(lens.notes[0], "a note");
    CHECK(lens.note_count == 1 && strcmp(lens.unit, "mm") == 0);
    CHECK(lens.position_count == 0 && lens.variable_count == 0);
    /* what it stands in stays: 90 cm, 1.2 cm, in mm */
    CHECK_NEAR(lens.object.value.hi, 900, 0, "object");
    CHECK(lens.field_count == 2 && lens.field_kind == FIELD_HEIGHT);
    CHECK_NEAR(lens.fields[1].at[1].value.hi, 12, 0, "field");
    CHECK(lens.fields[1].at[1].typed.start == NULL && lens.object.typed.start == NULL);
    check_plain(&lens);
    CHECK(first_order_of_lens(&lens, 0.55, SECTION_Y, &arena, &first, &error));
    CHECK_NEAR(first.efl, 70, 1e-12, "1/power");
    CHECK_NEAR(first.length, 40, 1e-12, "first to last plane");
    CHECK_NEAR(first.front_principal, 25, 1e-12, "H");
    CHECK_NEAR(first.rear_principal, -12, 1e-12, "H'");
    CHECK_NEAR(first.bfl, 1.2 * 70 - 12, 1e-12, "F'");
    CHECK_NEAR(first.ffl, 25 - 1.33 * 70, 1e-12, "F");
    const struct surface *thick = &lens.surfaces[lens.surface_count - 2];
    for (int k = 0; k < 3; k++) {
        CHECK_NEAR(thick->distortion[k].value.hi, stand_in.thick.distortion[k], 0, "distortion");
    }
    CHECK_NEAR(lens.surfaces[lens.surface_count - 1].thickness.value.hi, 90.5, 0, "image");
    if (has_stop) {
        CHECK_NEAR(first.entrance_pupil, pupil, 1e-12, "entrance pupil");
        CHECK_NEAR(lens.surfaces[1].diameter.value.hi, 13, 0, "its diameter");
        CHECK(lens.aperture_kind == APERTURE_STOP);
    } else if (fnumber > 0 && fnumber < INFINITY) {
        CHECK(lens.aperture_kind == APERTURE_FNUMBER && lens.aperture.value.hi == fnumber);
    } else {
        CHECK(lens.aperture_kind == APERTURE_NONE && lens.aperture.value.hi == 0);
    }
    arena_free(&arena);
}

int main(void)
{
    check_stand_in(10, 2);
    check_stand_in(-30, NAN);
    check_stand_in(60, NAN);
    check_stand_in(NAN, 2.5);
    check_stand_in(NAN, NAN);
    check_stand_in(INFINITY, INFINITY);
    return check_report();
}
