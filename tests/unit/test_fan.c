/* tests/unit/test_fan.c - ray fans by symmetries and closed forms; numbers: truth/check_fan.py. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"
#include "analysis/waves/fan.h"
#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"

static const double degree = RADIANS_PER_DEGREE;

/* The double Gauss of the lecture without clear apertures, and with some. */
#define GAUSS(first, last)                                                                         \
    "wavelength d F C\nobject inf\nfield angle 14\nfocus paraxial\n"                               \
    "surface 58.95 7.52 1.67/47.1 " first "\nsurface 169.66 0.24 air -\n"                          \
    "surface 38.55 8.05 1.67/47.1 -\nsurface 81.54 6.55 1.699/30.1 -\nsurface 25.5 11.41 air -\n"  \
    "stop - 9 air 34.2\nsurface -28.99 2.36 1.603/38 -\nsurface 81.54 12.13 1.658/57.3 -\n"        \
    "surface -40.77 0.38 air -\nsurface 874.13 6.44 1.717/48 -\nsurface -79.46 72.228 air " last   \
    "\n"

/* A paraboloid of f = 100 and its stop; two of them with one focus, an afocal telescope. */
#define MIRROR "wavelength d\nobject inf\naperture stop\nsurface -200 -100 mirror 80 k=-1 stop\n"
#define MERSENNE                                                                                   \
    "wavelength d\nobject inf\naperture stop\nfocus afocal\n"                                      \
    "surface -200 -150 mirror 80 k=-1 stop\nsurface 100 120 mirror 200 k=-1\n"

static struct setup open_setup(const char *text, double image, struct arena *arena)
{
    struct setup setup = {0};
    struct error error = {0};
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct setup_question question = {
        .lens = lens, .wavelength = NAN, .fnumber = NAN, .wavelengths = WAVELENGTHS_ALL};
    const struct plane_value plane = {isnan(image) ? PLANE_OF_LENS : PLANE_AT, image};
    bool opened = lens_read("test", text_of(text), NULL, arena, lens, &error) &&
                  setup_open(&question, arena, &setup, &error) &&
                  setup_place_image(&setup, &plane, &error);
    if (!opened) {
        printf("%s\n", error.message);
    }
    CHECK(opened);
    return setup;
}

static struct fan_question question_of(const struct setup *setup, const struct field_point *field,
                                       enum wave_about about)
{
    return (struct fan_question){
        .bundle = {.setup = setup, .field = field, .clip = true}, .about = about, .points = 9};
}

static struct fan trace(const struct fan_question *question, struct arena *arena)
{
    struct fan fan = {0};
    struct error error = {0};
    bool traced = fan_trace(question, arena, &fan, &error);
    if (!traced) {
        printf("%s\n", error.message);
    }
    CHECK(traced && fan.no_opd == NULL);
    return fan;
}

static const struct fan_ray *ray_at(const struct fan *fan, size_t g, size_t section, size_t i)
{
    return &fan->rays[(g * FAN_SECTIONS + section) * fan->points + i];
}

/* A round lens has the same fans at every azimuth, about every reference. */
static void test_azimuths(enum wave_about about)
{
    struct arena arena = {0};
    struct setup setup = open_setup(GAUSS("50.4", "40"), NAN, &arena);
    double t = atan(tan(14 * degree) / sqrt(2));
    const struct field_point fields[] = {{FIELD_ANGLE, {0, 14 * degree}},
                                         {FIELD_ANGLE, {14 * degree, 0}},
                                         {FIELD_ANGLE, {t, t}},
                                         {FIELD_ANGLE, {0, -14 * degree}}};
    static const double along[][2] = {{0, 1}, {1, 0}, {0.7071067811865476, 0.7071067811865476}};
    struct fan_question question = question_of(&setup, &fields[0], about);
    struct fan up = trace(&question, &arena);
    /* the others are integrals over the clear pupil, whose edge is looked for along x and y */
    double place = about == WAVE_CHIEF ? 1e-10 : 1e-7, path = about == WAVE_CHIEF ? 1e-12 : 3e-8;
    for (size_t f = 1; f < 3 && up.rays != NULL; f++) {
        question.bundle.field = &fields[f];
        struct fan other = trace(&question, &arena);
        const double *a = other.along;
        CHECK_NEAR(a[0], along[f][0], 1e-15, "section x");
        CHECK_NEAR(a[1], along[f][1], 1e-15, "section y");
        CHECK_NEAR(other.radius, up.radius, place, "radius");
        for (size_t k = 0; k < 3 * FAN_SECTIONS * up.points && other.rays != NULL; k++) {
            const struct fan_ray *one = &up.rays[k], *two = &other.rays[k];
            CHECK(one->status == two->status && one->surface == two->surface);
            if (one->status == RAY_OK) {
                CHECK_NEAR(two->opd, one->opd, path, "W");
                CHECK_NEAR(two->off[0] * a[0] + two->off[1] * a[1], one->off[1], place, "along");
                CHECK_NEAR(two->off[0] * a[1] - two->off[1] * a[0], one->off[0], place, "across");
                CHECK_NEAR(two->pupil[0] * a[0] + two->pupil[1] * a[1], one->pupil[1], 1e-15, "p");
            }
        }
    }
    /* below the axis the tangential fan runs the other way: dy(-p) = -dy(p), W(-p) = W(p) */
    question.bundle.field = &fields[3];
    struct fan down = trace(&question, &arena);
    for (size_t i = 0; i < up.points && up.rays != NULL && down.rays != NULL; i++) {
        const struct fan_ray *one = ray_at(&up, 1, FAN_TANGENTIAL, i);
        const struct fan_ray *two = ray_at(&down, 1, FAN_TANGENTIAL, up.points - 1 - i);
        CHECK(one->status == two->status);
        CHECK(one->status != RAY_OK || fabs(one->off[1] + two->off[1]) < place);
        CHECK(one->status != RAY_OK || fabs(one->opd - two->opd) < path);
    }
    arena_free(&arena);
}

/* Rays lost at rims keep their places; the edge of the stop itself is in. */
static void test_lost(void)
{
    struct arena arena = {0};
    const struct field_point field = {FIELD_ANGLE, {0, 14 * degree}};
    struct setup setup = open_setup(GAUSS("50.4", "40"), NAN, &arena);
    struct fan_question question = question_of(&setup, &field, WAVE_CHIEF);
    struct fan fan = trace(&question, &arena);
    const struct fan_ray *low = ray_at(&fan, 0, FAN_TANGENTIAL, 0);
    CHECK(low->status == RAY_CLIPPED && low->surface == 1);
    CHECK(isnan(low->off[1]) && isnan(low->opd));
    CHECK_NEAR(low->pupil[1], -1, 0, "its place");
    question.bundle.clip = false;
    fan = trace(&question, &arena);
    for (size_t k = 0; k < 3 * FAN_SECTIONS * fan.points; k++) {
        CHECK(fan.rays[k].status == RAY_OK);
    }
    setup = open_setup(GAUSS("-", "-"), NAN, &arena);
    question = question_of(&setup, &field, WAVE_CHIEF);
    fan = trace(&question, &arena);
    for (size_t k = 0; k < 3 * FAN_SECTIONS * fan.points; k++) {
        CHECK(fan.rays[k].status == RAY_OK);
    }
    arena_free(&arena);
}

/* One reference for all: each chief ray has W = 0, and only that of the first no dy. */
static void test_colours(void)
{
    struct arena arena = {0};
    const struct field_point field = {FIELD_ANGLE, {0, 14 * degree}};
    struct setup setup = open_setup(GAUSS("-", "-"), NAN, &arena);
    struct fan_question question = question_of(&setup, &field, WAVE_CHIEF);
    struct fan fan = trace(&question, &arena);
    /* chief rays of d, F, C by a program of 50 digits: double_gauss of ../shared/reference/truth */
    static const double heights[] = {24.99567298304572989117, 24.99839617537574822596,
                                     24.99447550446368386536};
    for (size_t g = 0; g < 3; g++) {
        const struct fan_ray *middle = ray_at(&fan, g, FAN_SAGITTAL, 4);
        CHECK_NEAR(middle->opd, 0, 1e-15, "W of a chief ray");
        CHECK_NEAR(middle->off[1], heights[g] - heights[0], 1e-13, "colour");
    }
    /* about the centroid all move by the same, and that is where spot has it */
    struct fan_question other = question_of(&setup, &field, WAVE_CENTROID);
    struct fan about = trace(&other, &arena);
    struct spot_question asked = {.bundle = question.bundle, .error = 1e-6, .energy = NAN};
    struct spot spot;
    struct error error;
    CHECK(spot_find(&asked, &arena, &spot, &error));
    CHECK_NEAR(about.reference[1], spot.centroid[1], 1e-7, "centroid");
    for (size_t k = 0; k < 3 * FAN_SECTIONS * fan.points; k++) {
        double move = fan.rays[k].off[1] - about.rays[k].off[1];
        CHECK_NEAR(move, about.reference[1] - fan.reference[1], 1e-12, "moved alike");
    }
    arena_free(&arena);
}

/*
 * A paraboloid images the axis perfectly: all ways to the focus are alike. 1 mm behind it W is what
 * is left of the way from there back to the sphere; the best sphere finds the focus again.
 */
static void test_mirror(void)
{
    struct arena arena = {0};
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    struct setup setup = open_setup(MIRROR, -101, &arena);
    struct fan_question question = question_of(&setup, &axis, WAVE_CHIEF);
    struct fan fan = trace(&question, &arena);
    CHECK_NEAR(fan.radius, 101, 1e-12, "radius");
    for (size_t i = 0; i < fan.points; i++) {
        const struct fan_ray *ray = ray_at(&fan, 0, FAN_TANGENTIAL, i);
        double h = 40 * ray->pupil[1], sag = h * h / 400; /* the mirror there is at z = -sag */
        double slope = h / (100 - sag), cosine = 1 / sqrt(1 + slope * slope), off = slope;
        CHECK_NEAR(ray->off[1], -off, 1e-12, "where the ray is 1 mm behind the focus");
        /* from the focus, 1 mm before the centre of the sphere of 101 mm */
        double back = -cosine + sqrt(cosine * cosine + 101 * 101 - 1);
        CHECK_NEAR(ray->opd, -(100 - back), 1e-11, "W of a defocus");
    }
    question.about = WAVE_BEST;
    fan = trace(&question, &arena);
    CHECK_NEAR(fan.reference[2], 1, 1e-9, "the focus before the plane");
    for (size_t k = 0; k < FAN_SECTIONS * fan.points; k++) {
        CHECK_NEAR(fan.rays[k].opd, 0, 1e-12, "W of the best sphere");
        CHECK_NEAR(hypot(fan.rays[k].off[0], fan.rays[k].off[1]), 0, 1e-9, "all in its centre");
    }
    /* a plane in the pupil has no sphere, but rays arrive */
    setup = open_setup(MIRROR, 0, &arena);
    question = question_of(&setup, &axis, WAVE_CHIEF);
    struct error error;
    CHECK(fan_trace(&question, &arena, &fan, &error));
    CHECK(fan.no_opd != NULL && isnan(fan.rays[0].opd) && isfinite(fan.rays[0].off[1]));
    question.about = WAVE_BEST;
    CHECK(!fan_trace(&question, &arena, &fan, &error) && error.code == ERROR_DOMAIN);
    arena_free(&arena);
}

/* Two paraboloids with one focus: plane waves stay plane on the axis. */
static void test_afocal(void)
{
    struct arena arena = {0};
    const struct field_point axis = {FIELD_NONE, {0, 0}}, field = {FIELD_ANGLE, {0, 0.1 * degree}};
    struct setup setup = open_setup(MERSENNE, NAN, &arena);
    struct fan_question question = question_of(&setup, &axis, WAVE_CHIEF);
    struct fan fan = trace(&question, &arena);
    CHECK(fan.is_angular && isinf(fan.radius));
    for (size_t k = 0; k < FAN_SECTIONS * fan.points; k++) {
        CHECK_NEAR(fan.rays[k].opd, 0, 1e-12, "W of a plane wave");
        CHECK_NEAR(hypot(fan.rays[k].off[0], fan.rays[k].off[1]), 0, 1e-13, "angle");
    }
    /* off the axis W falls along the exit pupil by the angles: dW/dy' = -angle, y' = y/2 */
    question.bundle.field = &field;
    question.points = 101;
    fan = trace(&question, &arena);
    for (size_t i = 10; i + 10 < fan.points; i += 10) {
        const struct fan_ray *ray = ray_at(&fan, 0, FAN_TANGENTIAL, i);
        double rise = (ray[1].opd - ray[-1].opd) / (2 * 0.02 * 40);
        double scale = fabs(ray_at(&fan, 0, FAN_TANGENTIAL, 90)->off[1]);
        CHECK_NEAR(fabs(rise), fabs(ray->off[1] / 2), 0.02 * scale, "slope of W");
    }
    question.about = WAVE_BEST;
    struct error error;
    CHECK(!fan_trace(&question, &arena, &fan, &error) && error.code == ERROR_DOMAIN);
    question.about = WAVE_CENTROID;
    fan = trace(&question, &arena);
    arena_free(&arena);
}

/*
 * Nothing refracts: at a rim of the radius 4, 10 mm behind a stop of the radius 5, rays of the
 * slope u have risen by 10 u; a disc of the radius 1 blocks light in its middle.
 */
static void test_ends(void)
{
    struct arena arena = {0};
    const double slope = 0.05, rise = 10 * slope;
    const struct field_point field = {FIELD_ANGLE, {0, atan(slope)}};
    struct setup setup = open_setup("wavelength d\nobject inf\naperture stop\nfocus afocal\n"
                                    "surface - 10 air 10 stop\n"
                                    "surface - 10 air 8\nblock circle 2\n",
                                    NAN, &arena);
    struct fan_question question = question_of(&setup, &field, WAVE_CHIEF);
    const struct fan fan = trace(&question, &arena);
    const double outer = sqrt(16 - rise * rise) / 5, inner = sqrt(1 - rise * rise) / 5;
    const double expected[FAN_SECTIONS][4] = {
        {(-4 - rise) / 5, (-1 - rise) / 5, (1 - rise) / 5, (4 - rise) / 5},
        {-outer, -inner, inner, outer}};
    for (size_t s = 0; s < FAN_SECTIONS && fan.ends != NULL; s++) {
        struct fan_ray line[9 + FAN_ENDS];
        CHECK(fan.ends[s].count == 4);
        CHECK(fan_line(&fan, 0, (enum fan_section)s, line) == 9 + 4);
        for (size_t i = 0; i < 4; i++) {
            const struct fan_ray *ray = &fan.ends[s].rays[i];
            CHECK_NEAR(ray->pupil[1 - s], expected[s][i], 1e-9, "the end of a section");
            CHECK(ray->status == RAY_OK && ray->surface == 2);
            /* Newton's method meets the outer edge, and the end lies half of 1e-9 within it */
            const double within = (expected[s][i] - ray->pupil[1 - s]) * (i < 2 ? -1 : 1);
            const bool is_outer = i == 0 || i == 3;
            CHECK(is_outer ? fabs(within - 5e-10) < 1e-12 : -within > 0 && -within < 1e-9);
        }
        for (size_t i = 0; i + 1 < 9 + 4; i++) {
            CHECK(line[i].pupil[1 - s] < line[i + 1].pupil[1 - s]);
        }
    }
    arena_free(&arena);
}

/*
 * An edge at a point of the fan, or so little beside it that no end has room between them: the line
 * goes on ascending. Rims on the axis of 2.5 mm, where the beam of 5 mm is half as wide.
 */
static void test_ends_at_points(void)
{
    static const struct {
        double share; /* of the rim that the point lies at */
        bool is_met;  /* else it is bisected */
    } rows[] = {
        {1, false}, {1 + 1e-10, false}, {1 - 1e-10, false}, {1 + 2e-8, true}, {1 - 2e-8, true}};
    const struct field_point axis = {FIELD_NONE, {0, 0}};
    struct arena arena = {0};
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        const double rim = 0.5 * rows[row].share;
        const char *text = arena_printf(&arena,
                                        "wavelength d\nobject inf\naperture stop\nfocus afocal\n"
                                        "surface - 10 air 10 stop\nsurface - 10 air %.17g\n",
                                        10 * rim);
        struct setup setup = open_setup(text, NAN, &arena);
        struct fan_question question = question_of(&setup, &axis, WAVE_CHIEF);
        const struct fan fan = trace(&question, &arena);
        for (size_t s = 0; s < FAN_SECTIONS && fan.ends != NULL; s++) {
            struct fan_ray line[9 + FAN_ENDS];
            CHECK(fan_line(&fan, 0, (enum fan_section)s, line) == 9 + 2);
            for (size_t i = 0; i + 1 < 9 + 2; i++) {
                CHECK(line[i].pupil[1 - s] <= line[i + 1].pupil[1 - s]);
            }
            for (size_t i = 0; i < 2; i++) {
                const double within = rim - fabs(fan.ends[s].rays[i].pupil[1 - s]);
                CHECK(within > -1e-12 && within <= 1e-9);
                CHECK(!rows[row].is_met || fabs(within - 5e-10) < 1e-12);
            }
        }
    }
    arena_free(&arena);
}

/* The ends of a lens are where single rays say they are: bisected through the question itself. */
static void test_ends_refracted(void)
{
    struct arena arena = {0};
    const struct field_point field = {FIELD_ANGLE, {0, 14 * degree}};
    struct setup setup = open_setup(GAUSS("50.4", "40"), NAN, &arena);
    struct fan_question question = question_of(&setup, &field, WAVE_CHIEF);
    const struct fan coarse = trace(&question, &arena);
    /* so many points that neighbours of an edge are 1e-4 apart: where it lies by another way */
    question.points = 20001;
    const struct fan dense = trace(&question, &arena);
    for (size_t k = 0; k < 3 * FAN_SECTIONS && coarse.ends != NULL && dense.ends != NULL; k++) {
        const struct fan_ends *one = &coarse.ends[k], *other = &dense.ends[k];
        const size_t s = k % FAN_SECTIONS;
        CHECK(one->count == other->count);
        for (size_t i = 0; i < one->count && i < other->count; i++) {
            CHECK_NEAR(one->rays[i].pupil[1 - s], other->rays[i].pupil[1 - s], 1e-12, "the end");
            CHECK(one->rays[i].surface == other->rays[i].surface);
            const struct fan_ray *clear = ray_at(&dense, k / FAN_SECTIONS, s, other->behind[i]);
            const struct fan_ray *next = clear + 1;
            CHECK((clear->status == RAY_OK) != (next->status == RAY_OK));
            CHECK(clear->pupil[1 - s] <= one->rays[i].pupil[1 - s] &&
                  one->rays[i].pupil[1 - s] <= next->pupil[1 - s]);
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_ends();
    test_ends_at_points();
    test_ends_refracted();
    test_azimuths(WAVE_CHIEF);
    test_azimuths(WAVE_CENTROID);
    test_azimuths(WAVE_BEST);
    test_lost();
    test_colours();
    test_mirror();
    test_afocal();
    return check_report();
}
