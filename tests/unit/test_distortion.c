/* tests/unit/test_distortion.c - chief rays against projections: other programs, closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/distortion.h"
#include "base/constants.h"
#include "check.h"
#include "exchange/lens_open.h"
#include "file/lens_file.h"

static const double degree = RADIANS_PER_DEGREE;

struct subject {
    struct lens lens;
    struct setup setup;
};

static bool set_up(struct subject *subject, struct arena *arena, struct error *error)
{
    const struct setup_question asked = {
        .lens = &subject->lens, .wavelength = NAN, .fnumber = NAN, .takes_telecentric = true};
    const struct plane_value plane = {.kind = PLANE_PARAXIAL};
    return setup_open(&asked, arena, &subject->setup, error) &&
           (!isfinite(subject->setup.first.image) ||
            setup_place_image(&subject->setup, &plane, error));
}

static void open_text(struct subject *subject, const char *text, struct arena *arena)
{
    struct error error;
    bool read = lens_read("test", text_of(text), NULL, arena, &subject->lens, &error) &&
                set_up(subject, arena, &error);
    if (!read) {
        printf("%s: %s\n", text, error.message);
    }
    CHECK(read);
}

static void open_name(struct subject *subject, const char *name, struct arena *arena)
{
    struct lensdb db = {.arena = arena};
    struct error error;
    CHECK(lens_open(&db, text_of(name), arena, &subject->lens, &error));
    CHECK(set_up(subject, arena, &error));
}

/* At angles of degrees, or heights of a near object. */
static struct distortion_point point_of(const struct distortion_map *map, double x, double y)
{
    struct distortion_point point = {.percent = NAN};
    struct error error = {0};
    const bool far = map->setup.object.is_infinite;
    const struct field_point field = {far ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {far ? x * degree : x, far ? y * degree : y}};
    bool done = distortion_at(map, &field, &point, &error);
    if (!done) {
        printf("%s\n", error.message);
    }
    CHECK(done);
    return point;
}

static struct distortion_map map_of(const struct subject *subject, enum projection projection,
                                    struct arena *arena)
{
    struct distortion_map map = {.scale = NAN};
    struct error error = {0};
    bool done = distortion_open(&subject->setup, 0, projection, arena, &map, &error);
    if (!done) {
        printf("%s\n", error.message);
    }
    CHECK(done);
    return map;
}

/* The lecture's double Gauss: an independent program of 50 digits. */
static void test_double_gauss(void)
{
    static const double cases[][4] = {
        {7, 12.35344265106342387127, 12.3664108357033993887, -0.1048661961200150378772},
        {9.8, 17.35988612859370038639, 17.39673162775571983803, -0.2117955254493555500197},
        {14, 24.99567298304572989117, 25.11140238911958611566, -0.460863970400952723798},
    };
    struct arena arena = {0};
    struct subject subject;
    open_name(&subject, "double-gauss", &arena);
    const struct distortion_map map = map_of(&subject, RECTILINEAR, &arena);
    CHECK_RELATIVE(map.scale, 100.71633391662729, 1e-15, "focal length");
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double *c = cases[i];
        const struct distortion_point up = point_of(&map, 0, c[0]);
        CHECK_NEAR(up.height, c[1], 1e-13, "chief ray");
        CHECK_NEAR(up.ideal, c[2], 2e-14, "f tan t");
        CHECK_NEAR(up.percent, c[3], 1e-12, "distortion");
        CHECK_NEAR(up.field, c[0] * degree, 1e-15, "field");
        const struct distortion_point down = point_of(&map, 0, -c[0]);
        CHECK_NEAR(down.height, -c[1], 1e-13, "below the axis");
        CHECK_NEAR(down.percent, c[3], 1e-12, "the same distortion");
        const struct distortion_point side = point_of(&map, c[0], 0);
        CHECK_NEAR(side.height, c[1], 1e-13, "along x");
        CHECK_NEAR(side.image[0], c[1], 1e-13, "x");
        CHECK_NEAR(side.image[1], 0, 1e-13, "y");
    }
    /* tan^2 t = 2 tan^2 x on the diagonal */
    const double both = atan(tan(14 * degree) / sqrt(2)) / degree;
    const struct distortion_point corner = point_of(&map, both, both);
    CHECK_NEAR(corner.height, cases[2][1], 1e-12, "a diagonal field of 14 deg");
    CHECK_NEAR(corner.image[0], cases[2][1] / sqrt(2), 1e-12, "its x");
    CHECK(isnan(point_of(&map, 0, 0).percent));
    CHECK_NEAR(point_of(&map, 0, 0).height, 0, 1e-13, "on the axis");
    arena_free(&arena);
}

/* Four camera lenses, by another program: mm to 1e-6, percent to 1e-3 (a fisheye's to 1e-2). */
static void test_camera_lenses(void)
{
    static const struct {
        const char *lens;
        enum projection projection;
        double field, height, percent;
    } cases[] = {
        {"cs348b-dgauss-50", RECTILINEAR, 5, 4.403447, -0.053},
        {"cs348b-dgauss-50", RECTILINEAR, 10, 8.859872, -0.221},
        {"cs348b-dgauss-50", RECTILINEAR, 15, 13.420694, -0.539},
        {"cs348b-dgauss-50", RECTILINEAR, 20, 18.131997, -1.074},
        {"cs348b-dgauss-50", RECTILINEAR, 22, 20.066464, -1.374},
        {"cs348b-wide-22", RECTILINEAR, 10, 3.877559, -0.149},
        {"cs348b-wide-22", RECTILINEAR, 20, 7.970849, -0.562},
        {"cs348b-wide-22", RECTILINEAR, 30, 12.579561, -1.067},
        {"cs348b-wide-22", RECTILINEAR, 38, 17.020002, -1.085},
        {"cs348b-telephoto-250", RECTILINEAR, 1, 4.357002, 0.018},
        {"cs348b-telephoto-250", RECTILINEAR, 2, 8.721482, 0.074},
        {"cs348b-telephoto-250", RECTILINEAR, 4, 17.503348, 0.298},
        {"cs348b-telephoto-250", RECTILINEAR, 5, 21.936563, 0.469},
        {"cs348b-fisheye-10", EQUIDISTANT, 10, 1.744306, 0.03},
        {"cs348b-fisheye-10", EQUIDISTANT, 20, 3.491381, 0.11},
        {"cs348b-fisheye-10", EQUIDISTANT, 40, 7.002125, 0.38},
        {"cs348b-fisheye-10", EQUIDISTANT, 60, 10.528418, 0.63},
        {"cs348b-fisheye-10", EQUIDISTANT, 70, 12.272904, 0.54},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct subject subject;
        open_name(&subject, cases[i].lens, &arena);
        const struct distortion_map map = map_of(&subject, cases[i].projection, &arena);
        const struct distortion_point point = point_of(&map, 0, cases[i].field);
        double percent = cases[i].projection == RECTILINEAR ? 5.1e-4 : 5.1e-3;
        CHECK_NEAR(point.height, cases[i].height, 5.1e-7, cases[i].lens);
        CHECK_NEAR(point.percent, cases[i].percent, percent, cases[i].lens);
        CHECK(point.is_lit);
        arena_free(&arena);
    }
}

/* A stop before a lens without aberrations images f tan t; the other projections follow. */
static void test_projections(void)
{
    struct arena arena = {0};
    struct subject subject;
    open_text(&subject, "object inf\nfield angle 40\nstop - 10 air 20\nthick 50 0 air 90\n",
              &arena);
    for (double t = 5; t < 60; t += 6) {
        const double tangent = tan(t * degree), half = t * degree / 2;
        const double over[PROJECTIONS] = {
            [RECTILINEAR] = 1,
            [EQUIDISTANT] = tangent / (t * degree),
            [EQUISOLID] = tangent / (2 * sin(half)),
            [STEREOGRAPHIC] = tangent / (2 * tan(half)),
            [ORTHOGRAPHIC] = 1 / cos(t * degree),
        };
        for (int i = 0; i < PROJECTIONS; i++) {
            const struct distortion_map map = map_of(&subject, (enum projection)i, &arena);
            const struct distortion_point point = point_of(&map, 0, t);
            CHECK_NEAR(point.height, 50 * tangent, 3e-13, "height");
            CHECK_NEAR(point.percent, 100 * (over[i] - 1), 1e-11, projections[i].word);
            CHECK(point.is_lit == (10 * tangent < 45));
        }
    }
    /* the focal length that makes f t and f tan t differ alike at axis and edge */
    struct distortion_map map = map_of(&subject, EQUIDISTANT, &arena);
    struct error error;
    const struct field_point edge = {FIELD_ANGLE, {0, 40 * degree}};
    const double last = 50 * tan(40 * degree) / (40 * degree);
    CHECK(distortion_calibrate(&map, &edge, &map.scale, &error));
    CHECK_NEAR(map.scale, (50 + last) / 2, 1e-6, "calibrated focal length");
    CHECK_NEAR(point_of(&map, 0, 40).percent, 100 * (last - 50) / (last + 50), 1e-5, "edge");
    CHECK_NEAR(point_of(&map, 0, 0.01).percent, -100 * (last - 50) / (last + 50), 1e-5, "axis");
    arena_free(&arena);
}

/* The largest distortion lies within the field. Against thousands of fields. */
static void test_calibrated(void)
{
    struct arena arena = {0};
    struct subject subject;
    open_name(&subject, "cs348b-wide-22", &arena);
    struct distortion_map map = map_of(&subject, RECTILINEAR, &arena);
    struct error error;
    const struct field_point edge = {FIELD_ANGLE, {0, 38 * degree}};
    CHECK(distortion_calibrate(&map, &edge, &map.scale, &error));
    double largest = -INFINITY, smallest = INFINITY;
    for (int i = 1; i <= 3800; i++) {
        double percent = point_of(&map, 0, 0.01 * i).percent;
        largest = fmax(largest, percent);
        smallest = fmin(smallest, percent);
    }
    CHECK_NEAR(largest, -smallest, 1e-5, "equal and opposite");
    CHECK(largest > 0.5 && largest < 0.6); /* -1.09 % in all */
    arena_free(&arena);
}

/* A lens without aberrations at 1:1. */
static void test_near(void)
{
    struct arena arena = {0};
    struct subject subject;
    open_text(&subject, "object 100\nfield height 20\nstop - 0 air 10\nthick 50 0 air -\n", &arena);
    struct distortion_map map = map_of(&subject, RECTILINEAR, &arena);
    CHECK_NEAR(map.scale, -1, 1e-14, "magnification");
    struct distortion_point point = point_of(&map, 0, 20);
    CHECK_NEAR(point.height, -20, 1e-13, "1:1, upside down");
    CHECK_NEAR(point.percent, 0, 1e-11, "no distortion");
    CHECK_NEAR(point.field, 20, 1e-13, "the object's height");
    struct error error;
    CHECK(!distortion_open(&subject.setup, 0, EQUIDISTANT, &arena, &map, &error));
    CHECK(strstr(error.message, "rectilinear") != NULL);
    arena_free(&arena);
}

/* Thin crossed cylinders at the stop: f is 50 mm in y, 100 mm in x; chief rays go straight on. */
static void test_squeeze(void)
{
    struct arena arena = {0};
    struct subject subject;
    open_text(&subject,
              "object inf\nfield angle 10\nstop - 0 air 2\nsurface 25 0 1.5 - cyl=y\n"
              "surface -50 0 air - cyl=x\n",
              &arena);
    const struct distortion_map map = map_of(&subject, RECTILINEAR, &arena);
    CHECK_NEAR(map.scale, 50, 1e-13, "y section");
    CHECK_NEAR(map.squeeze, 2, 1e-14, "x section");
    const struct distortion_point up = point_of(&map, 0, 8), side = point_of(&map, 8, 0);
    CHECK_NEAR(up.ideal, 50 * tan(8 * degree), 1e-13, "ideal image in y");
    CHECK_NEAR(side.ideal, 100 * tan(8 * degree), 1e-13, "ideal image in x");
    CHECK_NEAR(side.height, 50 * tan(8 * degree), 1e-13, "where the chief ray goes");
    CHECK_NEAR(side.percent, -50, 1e-11, "half of it");
    /* the same point again from its ideal image */
    double image[2];
    struct error error;
    const struct distortion_point skew = point_of(&map, 3, 5);
    const double ideal[2] = {100 * tan(3 * degree), 50 * tan(5 * degree)};
    CHECK(distortion_of_ideal(&map, ideal, image, &error));
    CHECK_NEAR(image[0], skew.image[0], 1e-13, "x");
    CHECK_NEAR(image[1], skew.image[1], 1e-13, "y");
    CHECK_NEAR(skew.ideal, hypot(ideal[0], ideal[1]), 1e-13, "along its direction");
    arena_free(&arena);
}

static bool is_refused(const char *text, double field, const char *words)
{
    struct arena arena = {0};
    struct subject subject;
    struct distortion_map map;
    struct distortion_point point;
    struct error error = {0};
    open_text(&subject, text, &arena);
    const struct field_point at = {FIELD_ANGLE, {0, field * degree}};
    bool refused = !(distortion_open(&subject.setup, 0, RECTILINEAR, &arena, &map, &error) &&
                     distortion_at(&map, &at, &point, &error));
    bool said = refused && error.code == ERROR_DOMAIN && strstr(error.message, words) != NULL;
    if (!said) {
        printf("%s: '%s'\n", text, error.message);
    }
    arena_free(&arena);
    return said;
}

/*
 * A concave mirror with its stop at the centre of curvature sends chief rays back along
 * themselves: y = f tan t in its focal plane, against f t stretched tan t/t times.
 */
static void test_tv(void)
{
    static const double aspects[] = {1, 1.5, 16 / 9.};
    struct arena arena = {0};
    struct subject subject;
    struct distortion_map map;
    struct tv_distortion tv;
    struct error error = {0};
    open_text(&subject,
              "object inf\nfield angle 20\nstop - 200 air 4\nsurface -200 -100 mirror 300\n",
              &arena);
    CHECK(distortion_open(&subject.setup, 0, EQUIDISTANT, &arena, &map, &error));
    for (size_t i = 0; i < sizeof aspects / sizeof *aspects; i++) {
        const double half[2] = {aspects[i] * 15, 15}, corner = hypot(half[0], 15) / 100;
        CHECK(tv_distortion_find(&map, half, &tv, &error));
        const double stretched = (tan(corner) / corner) / (tan(0.15) / 0.15);
        CHECK_NEAR(tv.smia, stretched - 1, 1e-12, "corners stretch more than the middle");
        CHECK_NEAR(tv.traditional, (stretched - 1) / 2, 1e-12, "half of it");
    }
    CHECK(distortion_open(&subject.setup, 0, RECTILINEAR, &arena, &map, &error));
    CHECK(tv_distortion_find(&map, (double[2]){20, 15}, &tv, &error));
    CHECK_NEAR(tv.smia, 0, 1e-13, "none against f tan t");
    arena_free(&arena);
}

static void test_refusals(void)
{
    CHECK(is_refused("object inf\nstop - 10 air 20\nthick 50 100 air 60\nthick 50 0 air -\n", 5,
                     "afocal"));
    CHECK(is_refused("object inf\nsurface 50 5 1.5 20\nsurface -50 0 air 20\n", 5, "no stop"));
    CHECK(is_refused("object 50\nstop - 0 air 20\nthick 50 0 air -\n", 5, "infinitely far"));
    CHECK(is_refused("object inf\nstop - 10 air 20\nthick 50 0 air -\n", 90, "rectilinear"));
    CHECK(is_refused("object inf\nsurface 20 30 1.5 -\nsurface -50 10 air -\nstop - 0 air 1\n", 80,
                     "surface"));
}

int main(void)
{
    test_double_gauss();
    test_camera_lenses();
    test_projections();
    test_calibrated();
    test_near();
    test_squeeze();
    test_tv();
    test_refusals();
    return check_report();
}
