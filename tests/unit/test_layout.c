/* tests/unit/test_layout.c - lenses in section, each coordinate worked out by hand. */
/* SPDX-License-Identifier: MIT */
#include "analysis/layout/layout.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "layout_drawing.h"

static const double degree = RADIANS_PER_DEGREE;

/* The points z, y of a part, all of them. */
static void check_points(const struct layout_part *part, const double (*points)[2], size_t count,
                         double tolerance, const char *what)
{
    CHECK(part->count == count);
    for (size_t i = 0; i < count && i < part->count; i++) {
        CHECK_NEAR(part->z[i], points[i][0], tolerance, what);
        CHECK_NEAR(part->y[i], points[i][1], tolerance, what);
    }
}

#define POINTS(part, tolerance, what, ...)                                                         \
    do {                                                                                           \
        static const double points_[][2] = {__VA_ARGS__};                                          \
        check_points((part), points_, sizeof points_ / sizeof points_[0], (tolerance), (what));    \
    } while (0)

/*
 * A stop of 20 mm, 10 mm before an ideal lens of f = 100 with H' 5 behind H, in air. The largest
 * semi-diameter is that of the lens, 30; drawn from 0 to 15, so that rays lead in and out by
 * 0.3 * 15 + 0.5 * 30 = 19.5. Light of slope 1/5 through the middle of the stop comes to H at 2,
 * leaves H' at 2 with slope 1/5 - 2/100, and is at 20 in the focus 100 behind H'.
 */
static const char *const ideal = "object inf\naperture stop\nfield angle 11.309932474020215\n"
                                 "stop - 10 air 20\nthick 100 100 air 60 hiatus=5\n";

static void test_ideal(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw(ideal, &(struct wanted){.planes = true}, &arena, &drawing);
    POINTS(part_of(&drawing, LAYOUT_PLANE, 0), 0, "H", {10, -30}, {10, 30});
    POINTS(part_of(&drawing, LAYOUT_PLANE, 1), 0, "H'", {15, -30}, {15, 30});
    CHECK_TEXT(part_of(&drawing, LAYOUT_PLANE, 0)->label, "thick lens");
    POINTS(part_of(&drawing, LAYOUT_STOP, 0), 1e-14, "stop", {0, -10}, {0, -14.8});
    POINTS(part_of(&drawing, LAYOUT_STOP, 1), 1e-14, "tick", {-1.44, -10}, {1.44, -10});
    POINTS(part_of(&drawing, LAYOUT_STOP, 2), 1e-14, "stop", {0, 10}, {0, 14.8});
    POINTS(part_of(&drawing, LAYOUT_STOP, 3), 1e-14, "tick", {-1.44, 10}, {1.44, 10});
    POINTS(part_of(&drawing, LAYOUT_AXIAL, 0), 1e-9, "lower ray", {-19.5, -10}, {10, -10},
           {15, -10}, {115, 0});
    POINTS(part_of(&drawing, LAYOUT_AXIAL, 1), 1e-9, "upper ray", {-19.5, 10}, {10, 10}, {15, 10},
           {115, 0});
    /* 19.5 along a direction of slope 1/5: 19.5/sqrt(1.04) in z */
    const double back = 19.5 / sqrt(1.04);
    const double chief[][2] = {{-back, -back / 5}, {10, 2}, {15, 2}, {115, 20}};
    check_points(part_of(&drawing, LAYOUT_CHIEF, 0), chief, 4, 1e-9, "chief ray");
    for (size_t i = 0; i < 2; i++) {
        double y = i == 0 ? -10 : 10;
        const double edge[][2] = {{-back, y - back / 5}, {10, y + 2}, {15, y + 2}, {115, 20}};
        check_points(part_of(&drawing, LAYOUT_OBLIQUE, i), edge, 4, 1e-9, "oblique ray");
    }
    /* a tenth higher than the rays that arrive */
    POINTS(part_of(&drawing, LAYOUT_IMAGE, 0), 1e-9, "image", {115, -22}, {115, 22});
    CHECK_TEXT(part_of(&drawing, LAYOUT_IMAGE, 0)->label, "image");
    POINTS(part_of(&drawing, LAYOUT_PLANE, 2), 1e-12, "H drawn", {10, -37.5}, {10, 37.5});
    POINTS(part_of(&drawing, LAYOUT_PLANE, 3), 1e-12, "H' drawn", {15, -37.5}, {15, 37.5});
    POINTS(part_of(&drawing, LAYOUT_POINT, 0), 1e-12, "F", {-90, 0});
    POINTS(part_of(&drawing, LAYOUT_POINT, 1), 1e-12, "F'", {115, 0});
    /* the stop 10 before H has its image at s' = 1/(1/100 - 1/10) = -100/9, 10/9 as large */
    POINTS(part_of(&drawing, LAYOUT_PUPIL, 0), 1e-12, "pupil", {0, -10}, {0, -19});
    POINTS(part_of(&drawing, LAYOUT_PUPIL, 1), 1e-12, "pupil", {0, 10}, {0, 19});
    const double z = 15 - 100.0 / 9, r = 100.0 / 9;
    const double lower[][2] = {{z, -r}, {z, -r - 9}}, upper[][2] = {{z, r}, {z, r + 9}};
    check_points(part_of(&drawing, LAYOUT_PUPIL, 2), lower, 2, 1e-12, "exit pupil");
    check_points(part_of(&drawing, LAYOUT_PUPIL, 3), upper, 2, 1e-12, "exit pupil");
    CHECK(count_of(&drawing, LAYOUT_PUPIL) == 4);
    /* the axis through all of it, a fiftieth and 0.05 * 30 farther */
    const double more = 0.02 * (115 + 90) + 1.5;
    const double axis[][2] = {{-90 - more, 0}, {115 + more, 0}};
    check_points(part_of(&drawing, LAYOUT_AXIS, 0), axis, 2, 1e-12, "axis");
    CHECK(count_of(&drawing, LAYOUT_ELEMENT) == 0 && count_of(&drawing, LAYOUT_MIRROR) == 0);
    CHECK(drawing.layout.note_count == 0);
    arena_free(&arena);
}

/* The same from a point 40 mm before the stop: rays begin at it, at most. */
static void test_near(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw("object 10\naperture stop\nstop - 10 air 20\nthick 10 100 air 60 hiatus=-2\n",
         &(struct wanted){.planes = false}, &arena, &drawing);
    /* the lens's own reach is 0 to 10; 0.3 * 10 + 0.5 * 30 = 18 > 10 * sqrt 2 along the ray */
    POINTS(part_of(&drawing, LAYOUT_AXIAL, 1), 1e-9, "to the object", {-10, 0}, {10, 20}, {8, 20},
           {28, 0});
    POINTS(part_of(&drawing, LAYOUT_IMAGE, 0), 1e-9, "image, a fifth of 30", {28, -6}, {28, 6});
    arena_free(&arena);
}

/* Gauss's rays through f = 50, H at 0, H' at 4: h = 0.7 * 20 = 14, the object 120 before H. */
static void test_construction(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    const struct wanted wanted = {.construction = true};
    draw("object inf\nthick 50 50 air 40 hiatus=4\n", &wanted, &arena, &drawing);
    /* 1/50 - 1/120 = 7/600: the image 600/7 behind H', upside down by 5/7 */
    const double image = 4 + 600.0 / 7, y = -10;
    const double rays[][3][2] = {
        {{-120, 14}, {0, 14}, {4, 14}}, {{-120, 14}, {0, y}, {4, y}}, {{-120, 14}, {0, 0}, {4, 0}}};
    for (size_t i = 0; i < 3; i++) {
        const double behind[][2] = {{4, rays[i][2][1]}, {image, y}};
        check_points(part_of(&drawing, LAYOUT_GAUSS, 2 * i), rays[i], 3, 1e-12, "to H'");
        check_points(part_of(&drawing, LAYOUT_GAUSS, 2 * i + 1), behind, 2, 1e-12, "behind");
    }
    const double arrow[][2] = {{image, 0}, {image, y}};
    POINTS(part_of(&drawing, LAYOUT_ARROW, 0), 1e-12, "object", {-120, 0}, {-120, 14});
    check_points(part_of(&drawing, LAYOUT_ARROW, 1), arrow, 2, 1e-12, "image");
    POINTS(part_of(&drawing, LAYOUT_PLANE, 2), 1e-12, "H", {0, -25}, {0, 25});
    POINTS(part_of(&drawing, LAYOUT_PLANE, 3), 1e-12, "H'", {4, -25}, {4, 25});
    POINTS(part_of(&drawing, LAYOUT_POINT, 0), 1e-12, "F", {-50, 0});
    POINTS(part_of(&drawing, LAYOUT_POINT, 1), 1e-12, "F'", {54, 0});
    POINTS(part_of(&drawing, LAYOUT_POINT, 2), 1e-12, "N", {0, 0});
    POINTS(part_of(&drawing, LAYOUT_POINT, 3), 1e-12, "N'", {4, 0});
    CHECK(is_noted(&drawing, "magnification -0.714:"));
    /* a negative lens: the image is virtual, 50 * 120/170 before H', 5/17 as large */
    draw("object inf\nthick -50 50 air 40 hiatus=4\n", &wanted, &arena, &drawing);
    const double near = 4 - 600.0 / 17, up = 14 * 5.0 / 17;
    const double slope = (14 - up) / (4 - near);
    const double leaves[][2] = {{4, 14}, {4 + 60, 14 + 60 * slope}};
    const double dashed[][2] = {{near, up}, {4, 14}};
    check_points(part_of(&drawing, LAYOUT_GAUSS, 1), leaves, 2, 1e-12, "on from H'");
    check_points(part_of(&drawing, LAYOUT_EXTENDED, 0), dashed, 2, 1e-12, "and back");
    CHECK(count_of(&drawing, LAYOUT_EXTENDED) == 3);
    struct error error = {0};
    CHECK(!try_draw("object inf\nsurface - 3 1.5/60 20\nsurface - 3 air 20\n", &wanted, &arena,
                    &drawing, &error));
    CHECK(strstr(error.message, "afocal") != NULL);
    CHECK(!try_draw("object inf\nsurface -100 -50 mirror 20\n", &wanted, &arena, &drawing, &error));
    CHECK(strstr(error.message, "odd number of mirrors") != NULL);
    arena_free(&arena);
}

/* Sag of a sphere. */
static double sphere(double R, double y)
{
    return R - copysign(sqrt(R * R - y * y), R);
}

/*
 * Outline of one element with its faces at z and z + t: 49 points up the first, at the sines of
 * -90 to 90 degrees, and as many down the second; flats where a face is smaller than the other.
 */
static void check_element(const struct layout_part *part, const double face[2][3])
{
    const double larger = fmax(face[0][2], face[1][2]);
    size_t at = 0;
    for (int side = 0; side < 2; side++) {
        double z = face[side][0], R = face[side][1], semi = face[side][2], up = side == 0 ? 1 : -1;
        if (semi < larger) {
            CHECK_NEAR(part->z[at], z + sphere(R, semi), 1e-12, "flat begins");
            CHECK_NEAR(part->y[at], -up * larger, 1e-12, "flat begins at the rim");
            at++;
        }
        for (int k = 0; k <= 48; k++, at++) {
            double y = up * semi * sin((-90 + 180.0 * k / 48) * degree);
            CHECK_NEAR(part->y[at], y, 1e-12, "height");
            CHECK_NEAR(part->z[at], z + sphere(R, y), 1e-12, "sag");
        }
        if (semi < larger) {
            CHECK_NEAR(part->z[at], z + sphere(R, semi), 1e-12, "flat ends");
            CHECK_NEAR(part->y[at], up * larger, 1e-12, "flat ends at the rim");
            at++;
        }
    }
    CHECK(part->count == at);
}

/*
 * A cemented doublet whose inner face states a smaller diameter than it can have: drawn as far as
 * the smaller of its neighbours, 14. Then a thin lens of the first glass.
 */
static void test_elements(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw("object inf\naperture f/8\nsurface 60 8 1.5168/64 30\nsurface -50 3 1.62/36 20\n"
         "surface -200 5 air 28\nsurface 80 4 1.5168/64 20\nsurface 90 60 air 18\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    static const double faces[][2][3] = {
        {{0, 60, 15}, {8, -50, 14}}, {{8, -50, 14}, {11, -200, 14}}, {{16, 80, 10}, {20, 90, 9}}};
    static const size_t glass[] = {0, 1, 0};
    for (size_t i = 0; i < 3; i++) {
        const struct layout_part *part = part_of(&drawing, LAYOUT_ELEMENT, i);
        check_element(part, faces[i]);
        CHECK(part->glass == glass[i]);
    }
    CHECK(drawing.layout.glass_count == 2 && count_of(&drawing, LAYOUT_ELEMENT) == 3);
    CHECK_TEXT(drawing.layout.glasses[0], "1.5168/64");
    CHECK_TEXT(drawing.layout.glasses[1], "1.62/36");
    CHECK_NEAR(drawing.layout.size, 15, 0, "largest semi-diameter");
    CHECK_NEAR(drawing.layout.left, 0, 1e-15, "from the first vertex");
    CHECK_NEAR(drawing.layout.right, 20 + sphere(90, 9), 1e-12, "to the last edge");
    CHECK(count_of(&drawing, LAYOUT_AXIAL) == 0);
    /* without thickness a glass gives the face behind it no room */
    draw("object inf\naperture epd 9\nsurface - 0 1.5168/64 30\nsurface - 3 1.62/36 20\n"
         "surface - 5 air 28\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK(drawing.layout.semi[1] == 10);
    draw("object inf\naperture epd 9\nsurface - 3 1.5168/64 30\nsurface - 0 1.62/36 20\n"
         "surface - 5 air 28\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK(drawing.layout.semi[1] == 10);
    /* half a millimetre is room, and the first rim may be the smaller one */
    draw("object inf\naperture epd 9\nsurface - 0.5 1.5168/64 26\nsurface - 0.5 1.62/36 16\n"
         "surface - 5 air 28\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK(drawing.layout.semi[1] == 13);
    /* faces that meet before the rim give none: 2 mm, less two sags of 30 - sqrt(900 - 14^2) */
    draw("object inf\naperture epd 9\nsurface 30 2 1.5168/64 30\nsurface -30 3 1.62/36 16\n"
         "surface - 5 air 28\nsurface - 2 1.5168/64 20\nsurface - 20 air 20\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK(drawing.layout.semi[1] == 8);
    draw("object inf\naperture epd 9\nsurface - 2 1.5168/64 30\nsurface 30 3 1.62/36 16\n"
         "surface -30 5 air 28\nsurface - 2 1.5168/64 20\nsurface - 20 air 20\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK(drawing.layout.semi[1] == 8);
    arena_free(&arena);
}

/* One aperture is enough for rays, that of the beam or those of all surfaces. */
static void test_apertures(void)
{
    static const char *const texts[] = {
        "object inf\naperture epd 10\nsurface 60 8 1.5/64 -\nsurface - 60 air -\n",
        "object inf\naperture epd 10\nsurface 60 8 1.5/64 20\nsurface - 60 air -\n",
        "object inf\naperture epd 10\nsurface 60 8 1.5/64 -\nsurface - 60 air 20\n",
        "object inf\nsurface 60 8 1.5/64 20\nsurface - 60 air 20\n"};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct drawing drawing;
        draw(texts[i], &(struct wanted){.no_rays = false}, &arena, &drawing);
        CHECK(count_of(&drawing, LAYOUT_AXIAL) == 2 && !is_noted(&drawing, "no rays"));
    }
    arena_free(&arena);
}

/*
 * In the x section a lens with cyl=x has its curve, in the y section none. No diameters: marginal
 * ray at 5, no field; the note counts them.
 */
static void test_sections(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    for (int section = 0; section < 2; section++) {
        const struct wanted wanted = {.no_rays = true,
                                      .section = section == 0 ? SECTION_X : SECTION_Y};
        draw("object inf\naperture epd 10\nsurface 60 8 1.5/64 20 cyl=x\nsurface - 60 air 24\n",
             &wanted, &arena, &drawing);
        const struct layout_part *part = part_of(&drawing, LAYOUT_ELEMENT, 0);
        double edge = section == 0 ? sphere(60, 10) : 0;
        CHECK_NEAR(part->z[0], edge, 1e-12, "lower edge");
        CHECK_NEAR(part->z[1], edge, 1e-12, "and the flat beyond");
        CHECK_NEAR(part->z[25], 0, 1e-12, "vertex");
    }
    draw("object inf\naperture epd 10\nsurface 60 8 1.5/64 -\nsurface - 60 air 24\n",
         &(struct wanted){.no_rays = true}, &arena, &drawing);
    CHECK_NEAR(drawing.layout.semi[0], 5, 1e-12, "the marginal ray's height");
    CHECK(is_noted(&drawing, "1 of 2 surfaces have no stated diameter"));
    arena_free(&arena);
}

/*
 * A Cassegrain: f1 = 100, the secondary 70 behind, where a beam of 20 is 6 high; 1/s' = 1/30 -
 * 1/(f2 = 45), s' = 90: the image is 20 behind the primary's vertex, where the beam is 6 (20/90) =
 * 4/3 high. The hole is 1.3 times that.
 */
static void test_mirrors(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw("object inf\naperture epd 40\nsurface -200 -70 mirror 40 stop\nsurface -90 90 mirror 16\n",
         &(struct wanted){.planes = false}, &arena, &drawing);
    const double hole = 1.3 * 4 / 3;
    CHECK(count_of(&drawing, LAYOUT_MIRROR) == 4 && count_of(&drawing, LAYOUT_HATCH) == 4);
    for (size_t i = 0; i < 4; i++) {
        const struct layout_part *part = part_of(&drawing, LAYOUT_MIRROR, i);
        const struct layout_part *hatch = part_of(&drawing, LAYOUT_HATCH, i);
        double side = i % 2 == 0 ? -1 : 1, vertex = i < 2 ? 0 : -70, R = i < 2 ? -200 : -90;
        double semi = i < 2 ? 20 : 8, inner = i < 2 ? hole : 0;
        CHECK(part->count == 49);
        for (size_t k = 0; k < part->count; k++) {
            double y = side * (inner + (semi - inner) * (double)k / 48);
            CHECK_NEAR(part->y[k], y, 1e-9, "mirror");
            CHECK_NEAR(part->z[k], vertex + sphere(R, y), 1e-9, "mirror's sag");
        }
        /* 28 strokes over 20 mm, evenly; behind the glass as light comes, 0.035 * 20 deep */
        size_t strokes = (size_t)(28 * (semi - inner) / 20);
        double toward = i < 2 ? 1 : -1;
        CHECK(hatch->count == 3 * strokes);
        for (size_t k = 0; k < strokes && hatch->count == 3 * strokes; k++) {
            double y = side * (inner + (semi - inner) * ((double)k + 0.5) / (double)strokes);
            const double *z = hatch->z + 3 * k, *h = hatch->y + 3 * k;
            CHECK_NEAR(h[0], y, 1e-9, "stroke");
            CHECK_NEAR(z[0], vertex + sphere(R, y), 1e-9, "stroke on the mirror");
            CHECK_NEAR(z[1] - z[0], toward * 0.7, 1e-9, "behind it");
            CHECK_NEAR(h[1] - h[0], -0.8 * 0.7, 1e-9, "slanted");
            CHECK(isnan(z[2]) && isnan(h[2]));
        }
    }
    CHECK_NEAR(drawing.layout.image, 20, 1e-12, "image");
    CHECK(count_of(&drawing, LAYOUT_CHIEF) == 0);
    arena_free(&arena);
}

/*
 * Bends and turns in the plane of the drawing. An ideal lens, then after 30 mm a bend of the axis
 * by 30 degrees about x, which takes z towards -y, and a stop 20 mm on; decentred by 3 across.
 */
static void test_bent(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    const double s = 0.5, c = sqrt(0.75);
    draw("object inf\nfield angle 0\naperture stop\nfocus table\nthick 200 30 air 60\n"
         "bend decenter=0,2 tilt=30,0,0\nthick 150 20 air 40\n"
         "stop - 40 air 10 decenter=0,3 tilt=10,0\n",
         &(struct wanted){.planes = false}, &arena, &drawing);
    /* the axis shifts by 2 up, then goes down */
    const double more = 0.6 * 30;
    const double axis[][2] = {
        {-more, 0}, {0, 0}, {30, 2}, {30 + 20 * c, 2 - 20 * s}, {30 + 60 * c, 2 - 60 * s}};
    check_points(part_of(&drawing, LAYOUT_AXIS, 0), axis, 5, 1e-12, "axis");
    const struct layout_frame *frame = &drawing.layout.frames[2];
    CHECK_NEAR(frame->angle, -40 * degree, 1e-15, "both turns");
    CHECK_NEAR(frame->z, 30 + 20 * c + 3 * s, 1e-12, "stop's vertex");
    CHECK_NEAR(frame->y, 2 - 20 * s + 3 * c, 1e-12, "stop's vertex");
    /* its strokes: 5 off its own axis, across which the sine of 40 degrees leads to +z */
    const double s40 = 0.6427876096865393, c40 = 0.766044443118978, r = 5 + 0.16 * 30;
    const double stroke[][2] = {{frame->z + 5 * s40, frame->y + 5 * c40},
                                {frame->z + r * s40, frame->y + r * c40}};
    check_points(part_of(&drawing, LAYOUT_STOP, 2), stroke, 2, 1e-12, "upper stroke");
    const double t = 0.3 * 0.16 * 30;
    const double tick[][2] = {{stroke[0][0] - t * c40, stroke[0][1] + t * s40},
                              {stroke[0][0] + t * c40, stroke[0][1] - t * s40}};
    check_points(part_of(&drawing, LAYOUT_STOP, 3), tick, 2, 1e-12, "upper tick");
    /* the image plane across the bent axis, 40 behind the stop */
    const struct layout_part *image = part_of(&drawing, LAYOUT_IMAGE, 0);
    CHECK_NEAR((image->z[0] + image->z[1]) / 2, 30 + 60 * c, 1e-12, "image");
    CHECK_NEAR((image->y[0] + image->y[1]) / 2, 2 - 60 * s, 1e-12, "image");
    CHECK_NEAR((image->z[1] - image->z[0]) * c - (image->y[1] - image->y[0]) * s, 0, 1e-12,
               "across the axis");
    CHECK(image->y[1] > image->y[0]);
    CHECK(!is_noted(&drawing, "out of the plane"));
    CHECK(count_of(&drawing, LAYOUT_AXIS) == 1);
    arena_free(&arena);
}

/* In the x section a turn about y takes z towards +x; what leaves the plane is noted. */
static void test_bent_aside(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    static const struct {
        const char *bend;
        double z, y, angle; /* of the surface behind it, in the x section */
        bool skew;
    } cases[] = {{"decenter=2,0", 10, 2, 0, false},
                 {"tilt=0,30,0", 10, 0, 30, false},
                 {"decenter=0,2", 10, 0, 0, true},
                 {"tilt=20,0,0", 10, 0, 0, true},
                 {"tilt=0,0,5", 10, 0, 0, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[200];
        const struct wanted wanted = {.no_rays = true, .section = SECTION_X};
        snprintf(text, sizeof text,
                 "object inf\naperture epd 4\nthick 100 10 air 20\nbend %s\nthick 100 60 air 20\n",
                 cases[i].bend);
        draw(text, &wanted, &arena, &drawing);
        const struct layout_frame *frame = &drawing.layout.frames[1];
        CHECK_NEAR(frame->z, cases[i].z, 1e-14, cases[i].bend);
        CHECK_NEAR(frame->y, cases[i].y, 1e-14, cases[i].bend);
        CHECK_NEAR(frame->angle, cases[i].angle * degree, 1e-14, cases[i].bend);
        CHECK(is_noted(&drawing, "out of the plane") == cases[i].skew);
    }
    arena_free(&arena);
}

/* Images that are not shown, and why. */
static void test_notes(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    static const struct {
        const char *text, *note;
    } cases[] = {
        {"object inf\naperture epd 4\nthick 5000 60 air 20\n", "it lies 5000 mm behind the last"},
        {"object inf\naperture epd 4\nthick -50 60 air 20\n", "it lies 50 mm before the last"},
        {"object 100\naperture epd 4\nthick 100 60 air 20\n", "the image is at infinity"},
        {"object inf\naperture epd 4\nsurface - 1 1.5/60 20\nsurface - 9 air 20\n", "at infinity"},
        {"object inf\nthick 100 60 air -\n", "no diameter"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error error = {0};
        bool good =
            try_draw(cases[i].text, &(struct wanted){.planes = false}, &arena, &drawing, &error);
        bool said =
            good ? is_noted(&drawing, cases[i].note) : strstr(error.message, cases[i].note) != NULL;
        CHECK(said);
        if (!said) {
            printf("%s\n", cases[i].text);
        }
    }
    arena_free(&arena);
}

/* A rim before the stop that is smaller than the beam: what is drawn, and what is said. */
static void test_cut(void)
{
    struct arena arena = {0};
    struct drawing drawing;
    draw("object inf\naperture stop\nfield angle 5.710593137499643\nsurface 1e9 1 1.5/60 16\n"
         "surface 1e9 9 air 16\nstop - 10 air 20\nthick 100 100 air 60\n",
         &(struct wanted){.planes = false}, &arena, &drawing);
    CHECK(is_noted(&drawing, "cut by the clear aperture of surface 1, not by the stop"));
    CHECK(is_noted(&drawing, "the oblique bundle is cut by the clear apertures"));
    CHECK_NEAR(part_of(&drawing, LAYOUT_AXIAL, 1)->y[1], 8, 1e-6, "to the rim");
    CHECK_NEAR(part_of(&drawing, LAYOUT_AXIAL, 0)->y[1], -8, 1e-6, "to the rim");
    /* 1/10 per mm upwards: at most 8 on both faces */
    CHECK_NEAR(part_of(&drawing, LAYOUT_OBLIQUE, 1)->y[2], 8, 1e-6, "upper");
    CHECK_NEAR(part_of(&drawing, LAYOUT_OBLIQUE, 0)->y[1], -8, 1e-6, "lower");
    /* a field from which nothing passes is drawn as near to its edge as rays come: 8 mm rim and
     * 10 mm stop, 30 apart: tan t = 18/30; in steps of 3 % below 45 degrees */
    draw("object inf\naperture stop\nfield angle 45\nthick 1e6 30 air 16\nstop - 10 air 20\n"
         "thick 100 100 air 60\n",
         &(struct wanted){.planes = false}, &arena, &drawing);
    double share = 1, limit = atan(0.6) / degree;
    while (45 * share > limit) {
        share *= 0.97;
    }
    char note[100];
    snprintf(note, sizeof note, "drawn at %.3g", 45 * share);
    CHECK(is_noted(&drawing, note));
    arena_free(&arena);
}

/* What counts as centred, and whose image plane is drawn. */
static void test_centred(void)
{
    static const struct {
        const char *text;
        bool centred;
        enum plane_kind plane;
    } cases[] = {
        {"thick 100 10 air 20\nthick 100 60 air 20\n", true, PLANE_OF_LENS},
        {"thick 100 10 air 20\nbend tilt=1,0,0\nthick 100 60 air 20\n", false, PLANE_TABLE},
        {"thick 100 10 air 20\nsurface - 60 air 20 tilt=1,0\n", false, PLANE_TABLE},
        {"thick 100 10 air 20\nsurface - 60 air 20 decenter=0,1\n", false, PLANE_TABLE},
        {"thick 100 10 air 20\nsurface - - air 20 decenter=0,1\n", false, PLANE_OF_LENS}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        struct error error;
        CHECK(lens_read("test", text_of(cases[i].text), NULL, &arena, &lens, &error));
        CHECK(layout_is_centred(&lens) == cases[i].centred);
        CHECK(layout_plane(&lens) == cases[i].plane);
        arena_free(&arena);
    }
}

int main(void)
{
    test_centred();
    test_ideal();
    test_near();
    test_construction();
    test_elements();
    test_apertures();
    test_sections();
    test_mirrors();
    test_bent();
    test_bent_aside();
    test_notes();
    test_cut();
    return check_report();
}
