/* tests/unit/test_layout_pieces.c - bundles, diameters and pieces of glass of lenses in section. */
/* SPDX-License-Identifier: MIT */
#include "layout_drawing.h"

/*
 * Every field has its bundle, from the axis to the edge, each once. A surface without a diameter is
 * as wide as they are: light of slope 1/5 through the upper edge of the stop, 10, comes to the lens
 * 10 mm behind it at 12.
 */
static void test_fields(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw("object inf\naperture stop\nfield angle 11.309932474020215 0 5.710593137499643 "
         "5.710593137499643\nstop - 10 air 20\nthick 100 100 air\n",
         &(struct wanted){.every_field = true}, &arena, &drawing);
    CHECK(drawing.layout.field_count == 2 && count_of(&drawing, LAYOUT_OBLIQUE) == 4);
    CHECK_TEXT(drawing.layout.fields[0], "field 5.71°");
    CHECK_TEXT(drawing.layout.fields[1], "field 11.3°");
    for (size_t i = 0; i < 4; i++) {
        const struct layout_part *part = part_of(&drawing, LAYOUT_OBLIQUE, i);
        double slope = i < 2 ? 0.1 : 0.2, y = (i % 2 == 0 ? -10 : 10) + 10 * slope;
        CHECK(part->field == i / 2);
        CHECK_NEAR(part->y[1], y, 1e-6, "at the lens");
        CHECK_NEAR(part->y[2], 100 * slope, 1e-6, "in the image");
    }
    CHECK_NEAR(drawing.layout.semi[1], 12, 1e-6, "semi-diameter");
    CHECK(is_noted(&drawing, "1 of 2 surfaces have no stated diameter") &&
          is_noted(&drawing, "rays of all fields"));
    /* what rays need in another position counts too */
    struct error error;
    const struct layout_request request = {.light = &drawing.light,
                                           .heights = (const double[]){0, 15}};
    CHECK(layout_make(&drawing.setup, &request, &arena, &drawing.layout, &error));
    CHECK_NEAR(drawing.layout.semi[1], 15, 1e-12, "of another position");
    /* of eight fields six, the last among them */
    draw("object inf\naperture stop\nfield angle 1 2 3 4 5 6 7 8\nstop - 10 air 20\n"
         "thick 100 100 air 60\n",
         &(struct wanted){.every_field = true}, &arena, &drawing);
    CHECK(drawing.layout.field_count == 6 && is_noted(&drawing, "6 of 8 fields are drawn"));
    CHECK_TEXT(drawing.layout.fields[5], "field 8°");
    arena_free(&arena);
}

/*
 * Two cemented lenses are two elements: spheres of 50 mm have a sag of 50 - sqrt(50^2 - 10^2) at
 * 10 mm. A lens in the hole of a mirror coated on glass pierces the glass too, through which light
 * goes twice.
 */
static void test_pieces(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    const struct wanted wanted = {.no_rays = true};
    draw("object inf\naperture stop\nsurface 50 6 1.5 20 stop\nsurface -50 3 1.6 20\n"
         "surface - 40 air 20\n",
         &wanted, &arena, &drawing);
    const double sagitta = 50 - sqrt(50 * 50 - 10 * 10);
    CHECK(drawing.layout.element_count == 2);
    const struct layout_element *pieces = drawing.layout.elements;
    CHECK(pieces[0].surface == 0 && pieces[1].surface == 1 && pieces[0].glass != pieces[1].glass);
    CHECK_NEAR(pieces[0].z, 3, 1e-12, "middle of a rim");
    CHECK_NEAR(pieces[1].z, (6 - sagitta + 9) / 2, 1e-12, "middle of a rim");
    CHECK_NEAR(pieces[0].low, -10, 1e-12, "its lower end");
    draw("object inf\naperture epd 30\nsurface - 10 1.5 40\nsurface -200 -10 mirror 40 stop\n"
         "block circle 10\nsurface - -50 air 40\nsurface - 55 mirror 10\nsurface 50 2 1.6 6\n"
         "surface - 40 air 6\n",
         &wanted, &arena, &drawing);
    CHECK(drawing.layout.element_count == 2 && count_of(&drawing, LAYOUT_ELEMENT) == 5);
    for (size_t i = 0; i < 4; i++) {
        const struct layout_part *part = part_of(&drawing, LAYOUT_ELEMENT, i);
        double nearest = INFINITY;
        for (size_t k = 0; k < part->count; k++) {
            nearest = fmin(nearest, fabs(part->y[k]));
        }
        CHECK_NEAR(nearest, 5, 1e-6, "the hole");
    }
    arena_free(&arena);
}

int main(void)
{
    test_fields();
    test_pieces();
    return check_report();
}
