/* tests/unit/test_setup.c - the rules by which a lens is made ready, each in closed form. */
/* SPDX-License-Identifier: MIT */
#include "analysis/setup/setup.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/dispatch.h"

static const double degree = RADIANS_PER_DEGREE;

/* A stop 10 mm before an ideal thin lens, which has no colours and no aberrations. */
#define THIN(f) "stop - 10 air 20\nthick " f " 99 air 60\n"

/* Plano-convex, infinitely thin: power (n - 1)/50, and a stop before it. */
#define GLASS "stop - 10 air 20\nsurface 50 0 1.5/60 60\nsurface - 99 air 60\n"

static struct setup_question question_of(const char *text, struct arena *arena)
{
    struct error error;
    struct lens *lens = ARENA_NEW(arena, struct lens);
    bool read = lens_read("test", text_of(text), NULL, arena, lens, &error);
    if (!read) {
        printf("%s: %s\n", text, error.message);
    }
    CHECK(read);
    return (struct setup_question){.lens = lens, .wavelength = NAN, .fnumber = NAN};
}

static struct setup open_question(const struct setup_question *question, struct arena *arena)
{
    struct setup setup;
    struct error error = {0};
    bool opened = setup_open(question, arena, &setup, &error);
    if (!opened) {
        printf("%s\n", error.message);
    }
    CHECK(opened);
    return setup;
}

static bool is_refused(const struct setup_question *question, const char *what, struct arena *arena)
{
    struct setup setup;
    struct error error;
    return !setup_open(question, arena, &setup, &error) && strstr(error.message, what) != NULL;
}

static void test_wavelengths(void)
{
    struct arena arena = {0};
    struct setup_question question = question_of("wavelength e F:2 C:0.5\n" GLASS, &arena);
    struct setup setup = open_question(&question, &arena);
    CHECK(setup.wavelength_count == 1);
    CHECK_NEAR(setup.wavelengths[0].wavelength, 0.5460740, 0, "e");
    question.wavelengths = WAVELENGTHS_ALL;
    setup = open_question(&question, &arena);
    static const double all[][2] = {{0.5460740, 1}, {0.4861327, 2}, {0.6562725, 0.5}};
    CHECK(setup.wavelength_count == 3);
    for (size_t i = 0; i < 3 && i < setup.wavelength_count; i++) {
        CHECK_NEAR(setup.wavelengths[i].wavelength, all[i][0], 0, "wavelength");
        CHECK_NEAR(setup.wavelengths[i].weight, all[i][1], 0, "weight");
    }
    question.wavelength = 0.7;
    setup = open_question(&question, &arena);
    CHECK(setup.wavelength_count == 1);
    CHECK_NEAR(setup.wavelengths[0].wavelength, 0.7, 0, "asked for");
    CHECK_NEAR(setup.wavelengths[0].weight, 1, 0, "its weight");
    question = question_of(GLASS, &arena);
    question.wavelengths = WAVELENGTHS_ALL;
    setup = open_question(&question, &arena);
    CHECK(setup.wavelength_count == 1);
    CHECK_NEAR(setup.wavelengths[0].wavelength, 0.5875618, 0, "d where the lens has none");
    arena_free(&arena);
}

/* What a policy makes of the fields of a lens: kind and y of each. */
struct field_case {
    const char *text;
    enum field_policy policy;
    enum field_kind kind;
    size_t count;
    double values[9]; /* deg or mm */
};

static const struct field_case field_cases[] = {
    {"field angle 0 10 -14\n" THIN("100"), FIELDS_LARGEST, FIELD_ANGLE, 1, {-14}},
    {"field angle 0 10 -14\n" THIN("100"), FIELDS_EDGE, FIELD_ANGLE, 1, {-14}},
    {"field angle 0 10 -14\n" THIN("100"), FIELDS_ALL, FIELD_ANGLE, 3, {0, 10, -14}},
    {"field angle 0 10 -14\n" THIN("100"),
     FIELDS_SPREAD,
     FIELD_ANGLE,
     9,
     {0, -1.75, -3.5, -5.25, -7, -8.75, -10.5, -12.25, -14}},
    {THIN("100"), FIELDS_LARGEST, FIELD_NONE, 0, {0}},
    {THIN("100"), FIELDS_EDGE, FIELD_ANGLE, 1, {5}},
    {"field angle 0\n" THIN("100"), FIELDS_EDGE, FIELD_ANGLE, 1, {5}},
    {THIN("100"), FIELDS_ALL, FIELD_NONE, 1, {0}},
    {"field image 0 -20\n" THIN("100"), FIELDS_LARGEST, FIELD_IMAGE, 1, {-20}},
    {"object 1000\nfield height 0 30\n" THIN("100"),
     FIELDS_SPREAD,
     FIELD_HEIGHT,
     9,
     {0, 3.75, 7.5, 11.25, 15, 18.75, 22.5, 26.25, 30}},
};

static double shown(const struct setup *setup, const struct setup_field *field)
{
    double value = field->point.value[setup_axis(setup)];
    return field->point.kind == FIELD_ANGLE ? value / degree : value;
}

static void test_fields(void)
{
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof field_cases / sizeof field_cases[0]; i++) {
        const struct field_case *one = &field_cases[i];
        for (int section = SECTION_Y; section <= SECTION_X; section++) {
            struct setup_question question = question_of(one->text, &arena);
            question.field_policy = one->policy;
            question.section = (enum lens_section)section;
            struct setup setup = open_question(&question, &arena);
            CHECK(setup.field_count == one->count);
            for (size_t k = 0; k < one->count && k < setup.field_count; k++) {
                CHECK(setup.fields[k].point.kind == one->kind);
                CHECK_NEAR(shown(&setup, &setup.fields[k]), one->values[k], 1e-13, one->text);
                CHECK_NEAR(setup.fields[k].weight, 1, 0, "weight");
                CHECK(setup.fields[k].point.value[section == SECTION_X] == 0);
            }
        }
    }
    arena_free(&arena);
}

/* An image height is that of the primary wavelength: tan t = y'(n - 1)/R in all of them. */
static void test_fields_in_colours(void)
{
    struct arena arena = {0};
    struct error error;
    struct setup_question question =
        question_of("wavelength d F\naperture f/4\nfield image 0 10\n" GLASS, &arena);
    question.wavelengths = WAVELENGTHS_ALL;
    const struct setup setup = open_question(&question, &arena);
    CHECK_NEAR(setup_edge_in_object(&setup).value[1], atan(0.1), 1e-15, "the edge");
    for (size_t i = 0; i < 2; i++) {
        struct setup_light light;
        CHECK(setup_light(&setup, i, &light, &error));
        CHECK_NEAR(light.first.chief_v, 0.1, 1e-15, "chief ray of each colour");
    }
    arena_free(&arena);
}

/* Seen from the object: tan t = y'/f of an image height, y = -L tan t of a near object. */
static void test_fields_in_object(void)
{
    struct arena arena = {0};
    struct setup_question question = question_of("field image 0 20\n" THIN("100"), &arena);
    question.field_policy = FIELDS_SPREAD;
    struct setup setup = open_question(&question, &arena);
    CHECK_NEAR(setup.fields[8].point.value[1], atan(0.2), 1e-15, "angle of an image height");
    CHECK_NEAR(setup.edge.value[1], atan(0.2), 1e-15, "the edge");
    question = question_of(THIN("50"), &arena);
    question.field_policy = FIELDS_SPREAD;
    setup = open_question(&question, &arena);
    CHECK_NEAR(setup.fields[8].point.value[1], atan(21.633 / 50), 1e-15, "corner of 35 mm film");
    CHECK_NEAR(setup.fields[1].point.value[1], atan(21.633 / 50) / 8, 1e-15, "an eighth of it");
    question = question_of("object 1000\nfield angle 0 10\n" THIN("100"), &arena);
    question.field_policy = FIELDS_SPREAD;
    setup = open_question(&question, &arena);
    CHECK(setup.fields[8].point.kind == FIELD_HEIGHT);
    CHECK_NEAR(setup.fields[8].point.value[1], -1000 * tan(10 * degree), 1e-12, "object height");
    /* 1010 mm before the lens: magnification 100/(100 - 1010) */
    question = question_of("object 1000\nfield image 0 5\n" THIN("100"), &arena);
    question.field_policy = FIELDS_SPREAD;
    setup = open_question(&question, &arena);
    CHECK_NEAR(setup.fields[8].point.value[1], 5 * -9.1, 1e-12, "object height of an image");
    question = question_of(THIN("10"), &arena);
    question.field_policy = FIELDS_SPREAD;
    CHECK(is_refused(&question, "states no fields", &arena));
    question = question_of("object 1000\n" THIN("100"), &arena);
    question.field_policy = FIELDS_SPREAD;
    CHECK(is_refused(&question, "states no fields", &arena));
    question = question_of("field height 0 5\n" THIN("100"), &arena);
    question.field_policy = FIELDS_SPREAD;
    CHECK(is_refused(&question, "no height", &arena));
    arena_free(&arena);
}

/* What is asked for comes before what the lens states; of several the largest where one counts. */
static void test_fields_asked(void)
{
    static const struct setup_field asked[] = {{{FIELD_ANGLE, {0, 0.1}}, 1},
                                               {{FIELD_ANGLE, {0, -0.2}}, 3},
                                               {{FIELD_HEIGHT, {0, -9}}, 9}}; /* not asked for */
    static const enum field_policy policies[] = {FIELDS_ALL, FIELDS_SPREAD, FIELDS_LARGEST};
    struct arena arena = {0};
    struct setup_question question = question_of("field angle 0 30\n" THIN("100"), &arena);
    question.fields = asked;
    question.field_count = 2;
    for (size_t i = 0; i < 3; i++) {
        question.field_policy = policies[i];
        struct setup setup = open_question(&question, &arena);
        bool one = policies[i] == FIELDS_LARGEST;
        CHECK(setup.field_count == (one ? 1 : 2));
        CHECK_NEAR(setup.fields[one ? 0 : 1].point.value[1], -0.2, 0, "field asked for");
        CHECK_NEAR(setup.fields[one ? 0 : 1].weight, one ? 1 : 3, 0, "its weight");
        CHECK_NEAR(setup.edge.value[1], -0.2, 0, "the edge");
        CHECK(setup.fields_from == NULL);
    }
    /* of a set the angle of a near object is a height, y = -L tan t; one by one it stays */
    question = question_of("object 1000\n" THIN("100"), &arena);
    question.fields = asked;
    question.field_count = 2;
    question.field_policy = FIELDS_SPREAD;
    struct setup setup = open_question(&question, &arena);
    CHECK(setup.fields[1].point.kind == FIELD_HEIGHT);
    CHECK_NEAR(setup.fields[1].point.value[1], 1000 * tan(0.2), 1e-12, "height of an angle");
    CHECK_NEAR(setup.fields[1].weight, 3, 0, "its weight");
    question.field_policy = FIELDS_ALL;
    setup = open_question(&question, &arena);
    CHECK(setup.fields[1].point.kind == FIELD_ANGLE);
    CHECK_NEAR(setup.fields[1].point.value[1], -0.2, 0, "angle of a near object");
    arena_free(&arena);
}

/* The stop stands before the lens and is its own entrance pupil: radius f/(2 N). */
static void test_aperture(void)
{
    static const struct {
        const char *text;
        double fnumber, radius;
    } cases[] = {
        {"aperture f/4\n" THIN("100"), NAN, 12.5},
        {"aperture f/4\n" THIN("100"), 8, 6.25},
        {"aperture stop\n" THIN("100"), NAN, 10},
        {"aperture stop\n" THIN("100"), 2.5, 20},
        {"aperture epd 30\n" THIN("100"), NAN, 15},
        {THIN("100"), NAN, NAN},
        {THIN("100"), 10, 5},
    };
    struct arena arena = {0};
    struct error error;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct setup_question question = question_of(cases[i].text, &arena);
        question.fnumber = cases[i].fnumber;
        struct setup setup = open_question(&question, &arena);
        bool known = !isnan(cases[i].radius);
        CHECK(known == !isnan(setup.first.stop_radius));
        const struct system *system = setup_system(&setup, 0, SETUP_OPEN, &error);
        /* without any aperture the diameter of the stop limits */
        CHECK_NEAR(system->stop_radius, known ? cases[i].radius : 10, 1e-13, cases[i].text);
    }
    arena_free(&arena);
}

/* The f-number is of the primary wavelength; at others the stop stays: f(l) = 50/(n - 1). */
static void test_light(void)
{
    struct arena arena = {0};
    struct error error;
    struct setup_question question = question_of("wavelength d F\naperture f/4\n" GLASS, &arena);
    question.wavelengths = WAVELENGTHS_ALL;
    struct setup setup = open_question(&question, &arena);
    /* n = A + B/l^2 with n(d) = 1.5 and n(F) - n(C) = 0.5/60 */
    const double d = 0.5875618, F = 0.4861327, C = 0.6562725;
    double B = 0.5 / 60 / (1 / (F * F) - 1 / (C * C));
    double focal = 50 / (0.5 + B * (1 / (F * F) - 1 / (d * d)));
    for (size_t i = 0; i < 2; i++) {
        struct setup_light light;
        CHECK(setup_light(&setup, i, &light, &error));
        CHECK_NEAR(light.first.stop_radius, 12.5, 1e-13, "stop radius");
        CHECK_NEAR(light.first.efl, i == 0 ? 100 : focal, 1e-10, "focal length");
        CHECK_NEAR(light.first.fnumber, (i == 0 ? 100 : focal) / 25, 1e-12, "f-number");
        const struct system *system = setup_system(&setup, i, SETUP_CLIPPED, &error);
        CHECK_NEAR(system->stop_radius, 12.5, 1e-13, "of exact rays");
        CHECK_NEAR(system->wavelength, i == 0 ? d : F, 0, "wavelength of the system");
    }
    /* a setup at a wavelength of its own keeps the stop */
    struct setup other = setup_at_wavelength(&setup, F, &arena);
    CHECK(other.wavelength_count == 1);
    CHECK_NEAR(setup_system(&other, 0, SETUP_OPEN, &error)->stop_radius, 12.5, 1e-13, "stop");
    arena_free(&arena);
}

struct plane_case {
    const char *text;
    struct plane_value asked;
    double image;
    const char *focus, *refused, *warned; /* null = none */
};

#define BARE "thick 100 99 air 60\n"
#define END  "stop - 10 air 20\nthick 100 - air 60\n"

static const struct plane_case plane_cases[] = {
    {THIN("100"), {PLANE_OF_LENS, NAN}, 100, "paraxial", NULL, NULL},
    {"focus table\n" THIN("100"), {PLANE_OF_LENS, NAN}, 99, "table", NULL, NULL},
    {"focus best\n" THIN("100"), {PLANE_OF_LENS, NAN}, 100, "best", NULL, NULL},
    {"focus table\n" THIN("100"), {PLANE_PARAXIAL, NAN}, 100, "paraxial", NULL, NULL},
    {THIN("100"), {PLANE_TABLE, NAN}, 99, "table", NULL, NULL},
    {THIN("100"), {PLANE_BEST, NAN}, 100, "best", NULL, NULL},
    {THIN("100"), {PLANE_AT, 95}, 95, "given", NULL, NULL},
    /* 1010 mm before the lens: 1/(1/100 - 1/1010) */
    {"object 1000\n" THIN("100"), {PLANE_OF_LENS, NAN}, 101000.0 / 910, "paraxial", NULL, NULL},
    {END, {PLANE_TABLE, NAN}, 0, NULL, "no distance", NULL},
    {"focus best\n" BARE, {PLANE_OF_LENS, NAN}, 100, "paraxial", NULL, "paraxial focus instead"},
    {BARE, {PLANE_BEST, NAN}, 0, NULL, "no stop", NULL},
    /* the object in the front focal plane, 54 mm before the stop; 1/64 is a double */
    {"object 54\n" THIN("64"), {PLANE_OF_LENS, NAN}, NAN, NULL, NULL, NULL},
    {"object 54\n" THIN("64"), {PLANE_PARAXIAL, NAN}, 0, NULL, "infinitely far", NULL},
    {"object 54\n" THIN("64"), {PLANE_AT, 200}, 200, "given", NULL, NULL},
};

static void test_plane(void)
{
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof plane_cases / sizeof plane_cases[0]; i++) {
        const struct plane_case *one = &plane_cases[i];
        struct setup_question question = question_of(one->text, &arena);
        struct setup setup = open_question(&question, &arena);
        struct error error = {0};
        bool found = setup_place_image(&setup, &one->asked, &error);
        CHECK(found == (one->refused == NULL));
        if (!found) {
            CHECK(one->refused != NULL && strstr(error.message, one->refused) != NULL);
            continue;
        }
        if (isnan(one->image)) {
            CHECK(isnan(setup.image) && setup.focus == NULL);
        } else {
            CHECK_NEAR(setup.image, one->image, 1e-11, one->text);
            CHECK_TEXT(setup.focus != NULL ? setup.focus : "-", one->focus);
        }
        CHECK((setup.warning == NULL) == (one->warned == NULL));
        CHECK(one->warned == NULL || strstr(setup.warning, one->warned) != NULL);
    }
    arena_free(&arena);
}

/* A real image height behind a break of 90 degrees about z, where x' = y and y' = -x. An ideal lens
   in its stop, f = 100: tan = height/100. */
static void test_turned_image(void)
{
    struct arena arena = {0};
    struct beam beam;
    struct error error = {0};
    const struct setup_question question = question_of(
        "object inf\naperture stop\nbend tilt=0,0,90\nstop - 0 air 10\nthick 100 100 air 60\n",
        &arena);
    const struct setup setup = open_question(&question, &arena);
    const struct field_point field = {FIELD_REAL, {3, 4}};
    CHECK(setup_beam(&setup, &field, &beam, &error));
    CHECK_NEAR(beam.axis[0] / beam.axis[2], -0.04, 1e-12, "tangent in x");
    CHECK_NEAR(beam.axis[1] / beam.axis[2], 0.03, 1e-12, "tangent in y");
    arena_free(&arena);
}

/* A zoom: the stop moves with its gap, its aperture and its object with the position. */
static void test_position(void)
{
    struct arena arena = {0};
    struct setup_question question =
        question_of("position wide tele\nlet g 10 20\nlet aperture f/4 f/5\nlet object inf 980\n"
                    "stop - g air 20\nthick 100 99 air 60\n",
                    &arena);
    question.position = 1;
    struct setup setup = open_question(&question, &arena);
    CHECK_TEXT(setup.position, "tele");
    CHECK_NEAR(setup.first.length, 20, 0, "gap of the position");
    CHECK_NEAR(setup.first.stop_radius, 10, 1e-13, "f/5");
    CHECK(!setup.object.is_infinite);
    CHECK_NEAR(setup.first.image, 1000.0 / 9, 1e-11, "2 f conjugates of 1 m");
    question.position = 0;
    setup = open_question(&question, &arena);
    CHECK_TEXT(setup.position, "wide");
    CHECK_NEAR(setup.first.stop_radius, 12.5, 1e-13, "f/4");
    question = question_of(THIN("100"), &arena);
    setup = open_question(&question, &arena);
    CHECK(setup.position == NULL);
    arena_free(&arena);
}

/* Where a ray that comes in parallel to the axis at this height ends; its status if it is lost. */
static enum ray_status trace_at(const struct system *system, double height, double *y,
                                struct arena *arena)
{
    const struct ray ray = {.point = {0, height, 0},
                            .cosine = {0, 0, system->options.reverse ? -1 : 1}};
    struct rays rays = rays_new(arena, 1);
    rays_set(&rays, 0, system->index_first, &ray);
    rays_trace(system, &rays, NULL);
    const struct ray end = rays_get(&rays, 0, system->index_last);
    *y = end.point[1];
    return end.status;
}

static void test_systems(void)
{
    struct arena arena = {0};
    struct error error;
    double y;
    struct setup_question question = question_of("aperture stop\n" THIN("100"), &arena);
    struct setup setup = open_question(&question, &arena);
    const struct plane_value half = {PLANE_AT, 50};
    CHECK(setup_place_image(&setup, &half, &error));
    const struct system *open = setup_system(&setup, 0, SETUP_OPEN, &error);
    CHECK(open == setup_system(&setup, 0, SETUP_OPEN, &error));
    CHECK(trace_at(open, 11, &y, &arena) == RAY_OK);
    CHECK_NEAR(y, 11, 1e-13, "behind the last surface");
    const struct system *clipped = setup_system(&setup, 0, SETUP_CLIPPED, &error);
    CHECK(trace_at(clipped, 11, &y, &arena) == RAY_CLIPPED);
    CHECK(trace_at(clipped, 9, &y, &arena) == RAY_OK);
    const struct system *image = setup_system(&setup, 0, SETUP_CLIPPED | SETUP_IMAGE, &error);
    CHECK(trace_at(image, 8, &y, &arena) == RAY_OK);
    CHECK_NEAR(y, 4, 1e-13, "half way to the focal point");
    /* the stop lies 10 mm behind the lens as the light goes: 0.9 of the height */
    const struct system *back = setup_system(&setup, 0, SETUP_REVERSED | SETUP_CLIPPED, &error);
    CHECK(trace_at(back, 11, &y, &arena) == RAY_OK);
    CHECK_NEAR(y, 9.9, 1e-12, "in the stop");
    CHECK(trace_at(back, 11.2, &y, &arena) == RAY_CLIPPED);
    arena_free(&arena);
}

int main(void)
{
    test_wavelengths();
    test_fields();
    test_fields_in_object();
    test_fields_in_colours();
    test_fields_asked();
    test_aperture();
    test_light();
    test_plane();
    test_position();
    test_turned_image();
    test_systems();
    return check_report();
}
