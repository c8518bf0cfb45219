/* tests/unit/test_ranges_view.c - legal ranges of views, formats and motion. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "photo/equivalent.h"
#include "photo/format.h"
#include "photo/fov_solve.h"
#include "photo/motion.h"
#include "ranges.h"

static const double pi = PI;

/* What is not named is not given: named members override the NaNs. */
#pragma GCC diagnostic ignored "-Woverride-init"
#define GOALS(...)                                                                                 \
    (&(struct fov_goals){.horizontal = NAN,                                                        \
                         .vertical = NAN,                                                          \
                         .diagonal = NAN,                                                          \
                         .field_width = NAN,                                                       \
                         .field_height = NAN,                                                      \
                         .field_diagonal = NAN,                                                    \
                         .pixel = NAN,                                                             \
                         __VA_ARGS__})
#define MOTION(...)                                                                                \
    (&(struct motion){.v = NAN,                                                                    \
                      .t = NAN,                                                                    \
                      .m = NAN,                                                                    \
                      .blur = NAN,                                                                 \
                      .angle = pi / 2,                                                             \
                      .s = NAN,                                                                    \
                      .h = 0,                                                                      \
                      __VA_ARGS__})
#define SHAKE(...)                                                                                 \
    (&(struct shake){.f = NAN, .omega = NAN, .t = NAN, .blur = NAN, .m = 0, __VA_ARGS__})

static void test_projections(void)
{
    static const struct {
        enum projection projection;
        double largest, angle; /* height in focal lengths, full angle there, rad */
        const char *refusal;
    } rows[] = {
        {EQUIDISTANT, PI, 2 * PI,
         "image height 4 mm lies beyond the edge of the equidistant projection, "
         "3.14159265358979 mm"},
        {EQUISOLID, 2, 2 * PI,
         "image height 4 mm lies beyond the edge of the equisolid projection, 2 mm"},
        {ORTHOGRAPHIC, 1, PI,
         "image height 4 mm lies beyond the edge of the orthographic projection, 1 mm"},
    };
    double angle = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        INSIDE(fov_angle(rows[i].projection, 0.25, 0.5 * rows[i].largest, &angle, &error));
        CHECK_RELATIVE(angle, rows[i].angle, 1e-7, "full angle at the edge");
        OUTSIDE(fov_angle(rows[i].projection, 1, 8, &angle, &error), rows[i].refusal);
    }
    INSIDE(fov_angle(STEREOGRAPHIC, 0.5, 2, &angle, &error));
    CHECK_RELATIVE(angle, pi, 1e-15, "4 atan(1)");
    OUTSIDE(fov_angle(RECTILINEAR, 0, 1, &angle, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(fov_angle(RECTILINEAR, 1, 0, &angle, &error),
            "sensor dimension 0 mm must be above 0 and finite");
}

static void test_fov(void)
{
    const struct sensor sensor = {.width = 0.375, .height = 0.25, .pitch = NAN};
    struct fov_setting a = {RECTILINEAR, 0.25, 0.5, 0.25, 2};
    struct fov fov;
    INSIDE(fov_compute(&a, &sensor, &fov, &error));
    CHECK_RELATIVE(fov.width_at_s, 0.75, 1e-15, "squeezed, at 1:1");
    CHECK_RELATIVE(fov.height_at_s, 0.25, 1e-15, "at 1:1");
    CHECK_RELATIVE(fov.diagonal_at_s, 0.790569415042094833, 1e-15, "sqrt(10)/4");
    CHECK_RELATIVE(fov.vertical, 0.199337304982324055, 1e-15, "2 atan(1/10): f (1 + m/P) = 1.25");
    a.s = 0.25;
    OUTSIDE(fov_compute(&a, &sensor, &fov, &error),
            "distance 0.25 mm lies within the focal length 0.25 mm: no real image");
    a = (struct fov_setting){RECTILINEAR, 0, 1, 1, 1};
    OUTSIDE(fov_compute(&a, &sensor, &fov, &error), "focal length 0 mm must be above 0 and finite");
    a = (struct fov_setting){RECTILINEAR, 1, 2, 0, 1};
    OUTSIDE(fov_compute(&a, &sensor, &fov, &error),
            "pupil magnification 0 must be above 0 and finite");
    a = (struct fov_setting){RECTILINEAR, 1, 2, 1, 0};
    OUTSIDE(fov_compute(&a, &sensor, &fov, &error),
            "anamorphic squeeze 0 must be above 0 and finite");
}

/* What a lens on 36 x 27 mm, with a diagonal of 45 mm, becomes of its goals. */
static bool solved(const struct fov_setting *setting, const struct fov_goals *goals,
                   struct fov_problem *problem, struct error *failure)
{
    *problem = (struct fov_problem){*setting, {36, 27, 0.01}, false, *goals, FOV_GIVEN, NULL};
    return fov_solve(problem, failure);
}

/* Each goal finds the focal length that reaches it. */
static void test_fov_goals(void)
{
    struct fov_setting far = {RECTILINEAR, NAN, INFINITY, 1, 1},
                       near = {RECTILINEAR, NAN, 1000, 1, 1};
    const struct fov_setting wide = {RECTILINEAR, NAN, INFINITY, 1, 5.0 / 3};
    static const double right = PI / 2;
    struct fov_problem a;
    INSIDE(solved(&far, GOALS(.horizontal = right), &a, &error));
    CHECK_RELATIVE(a.setting.f, 18.0, 1e-15, "90 deg: half the width");
    CHECK_TEXT(a.by, "horizontal angle");
    INSIDE(solved(&wide, GOALS(.horizontal = right), &a, &error));
    CHECK_RELATIVE(a.setting.f, 30.0, 1e-15, "half the squeezed width");
    INSIDE(solved(&far, GOALS(.vertical = right), &a, &error));
    CHECK_RELATIVE(a.setting.f, 13.5, 1e-15, "half the height");
    INSIDE(solved(&far, GOALS(.diagonal = right), &a, &error));
    CHECK_RELATIVE(a.setting.f, 22.5, 1e-15, "half the diagonal");
    INSIDE(solved(&near, GOALS(.field_width = 964), &a, &error));
    CHECK_RELATIVE(a.setting.f, 36.0, 1e-15, "s w/(W + w)");
    CHECK_TEXT(a.by, "field width");
    INSIDE(solved(&near, GOALS(.field_height = 973), &a, &error));
    CHECK_RELATIVE(a.setting.f, 27.0, 1e-15, "s w/(W + w)");
    INSIDE(solved(&near, GOALS(.field_diagonal = 955), &a, &error));
    CHECK_RELATIVE(a.setting.f, 45.0, 1e-15, "s w/(W + w)");
    INSIDE(solved(&near, GOALS(.pixel = 0.24), &a, &error));
    CHECK_RELATIVE(a.setting.f, 40.0, 1e-15, "s p/(P + p)");
    CHECK_TEXT(a.by, "pixel density");
    far.f = 50;
    INSIDE(solved(&far, GOALS(.vertical = NAN), &a, &error));
    CHECK_NEAR(a.setting.f, 50, 0, "given itself");
    CHECK(a.by == NULL && a.unknown == FOV_GIVEN);
    const char *one = "give exactly one of focal length, horizontal angle of view, vertical angle "
                      "of view, diagonal angle of view, or a field (width of the field, height of "
                      "the field, diagonal of the field) with distance or focal length";
    MISUSED(solved(&far, GOALS(.vertical = 1), &a, &error), one);
    MISUSED(solved(&near, GOALS(.vertical = NAN), &a, &error), one);
    MISUSED(solved(&near, GOALS(.vertical = 1, .diagonal = 1), &a, &error), one);
    MISUSED(solved(&near, GOALS(.vertical = 1, .field_width = 1), &a, &error), one);
    far.f = NAN;
    MISUSED(solved(&far, GOALS(.field_width = 100), &a, &error),
            "a wanted field needs focal length or a finite distance");
    near.projection = EQUIDISTANT;
    OUTSIDE(solved(&near, GOALS(.field_width = 100), &a, &error),
            "a wanted field needs a rectilinear lens");
    near.squeeze = 0;
    OUTSIDE(solved(&near, GOALS(.vertical = 1), &a, &error),
            "squeeze 0 must be above 0 and finite");
}

/* And the distance, where the focal length is given; of several fields all are in the picture. */
static void test_fov_distance(void)
{
    struct fov_setting lens = {RECTILINEAR, 50, INFINITY, 1, 1};
    struct fov_problem a;
    INSIDE(solved(&lens, GOALS(.field_width = 36), &a, &error));
    CHECK_NEAR(a.setting.s, 100, 0, "1:1: 2 f, where f W/w has f");
    CHECK(a.unknown == FOV_DISTANCE);
    INSIDE(solved(&lens, GOALS(.field_width = 360, .field_height = 540), &a, &error));
    CHECK_RELATIVE(a.setting.s, 1050.0, 1e-15, "f (1 + 540/27)");
    CHECK_TEXT(a.by, "field height");
    INSIDE(solved(&lens, GOALS(.field_width = 720, .field_height = 270), &a, &error));
    CHECK_RELATIVE(a.setting.s, 1050.0, 1e-15, "f (1 + 720/36)");
    CHECK_TEXT(a.by, "field width");
    INSIDE(solved(&lens, GOALS(.pixel = 0.2), &a, &error));
    CHECK_RELATIVE(a.setting.s, 1050.0, 1e-15, "f (1 + 0.2/0.01)");
    lens.squeeze = 2;
    INSIDE(solved(&lens, GOALS(.field_width = 720), &a, &error));
    CHECK_RELATIVE(a.setting.s, 550.0, 1e-15, "f (1 + 720/72)");
    INSIDE(solved(&lens, GOALS(.pixel = 0.2), &a, &error));
    CHECK_RELATIVE(a.setting.s, 550.0, 1e-15, "f (1 + 0.2/0.02)");
    a.sensor.pitch = NAN;
    a.setting = lens;
    MISUSED(fov_solve(&a, &error), "a pixel density needs pixel pitch or pixels");
    OUTSIDE(solved(&lens, GOALS(.field_width = 0), &a, &error),
            "field width 0 mm must be above 0 and finite");
    lens.f = 0;
    OUTSIDE(solved(&lens, GOALS(.field_width = 9), &a, &error),
            "focal length 0 mm must be above 0 and finite");
}

/* And the sensor, where both are: m = 50/(1050 - 50) = 1/20. */
static void test_fov_sensor(void)
{
    struct fov_problem a = {{RECTILINEAR, 50, 1050, 1, 1},
                            {36, 24, NAN},
                            true,
                            *GOALS(.field_width = 400, .field_height = 100),
                            FOV_GIVEN,
                            NULL};
    const struct fov_problem both = a;
    INSIDE(fov_solve(&a, &error));
    CHECK(a.unknown == FOV_SENSOR);
    CHECK_RELATIVE(a.sensor.width, 20.0, 1e-15, "m W");
    CHECK_RELATIVE(a.sensor.height, 5.0, 1e-15, "m H");
    a = both;
    a.goals.field_height = NAN;
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 20.0, 1e-15, "m W");
    CHECK_RELATIVE(a.sensor.height, 40.0 / 3, 1e-15, "in the shape of the sensor");
    a = both;
    a.goals.field_width = NAN;
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 7.5, 1e-15, "in the shape of the sensor");
    a = both;
    a.goals = *GOALS(.field_diagonal = 865.33230611135742); /* 240 sqrt 13 */
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 36.0, 1e-15, "12 sqrt 13 of diagonal");
    a = both;
    a.goals = *GOALS(.field_width = 400, .field_diagonal = 240);
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 20.0, 1e-15, "m W; the diagonal is less than that");
    a = both;
    a.setting.squeeze = 2;
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 10.0, 1e-15, "half by the squeeze");
    a = both;
    a.setting.squeeze = 2;
    a.goals = *GOALS(.field_width = 400, .field_height = 300, .field_diagonal = 1000);
    INSIDE(fov_solve(&a, &error));
    CHECK_RELATIVE(a.sensor.width, 20.0, 1e-15, "3:4:5: twice 400/20/2");
    CHECK_RELATIVE(a.sensor.height, 30.0, 1e-15, "3:4:5: twice 300/20");
    a = both;
    a.setting.s = 50;
    OUTSIDE(fov_solve(&a, &error),
            "distance 50 mm lies within the focal length 50 mm: no real image");
    a = both;
    a.sensor_is_open = false;
    MISUSED(fov_solve(&a, &error), "field, focal length, distance and sensor: three of them give "
                                   "the fourth, leave one out");
}

static void test_fov_focal_length(void)
{
    double f = 0;
    INSIDE(fov_focal_length(
        &(struct fov_setting){.projection = ORTHOGRAPHIC, .s = INFINITY, .P = 0.25}, 0.5, pi, &f,
        &error));
    CHECK_RELATIVE(f, 0.25, 1e-15, "a half sphere");
    INSIDE(fov_focal_length(&(struct fov_setting){.projection = EQUIDISTANT, .s = INFINITY, .P = 1},
                            0.5, 2 * pi, &f, &error));
    CHECK_RELATIVE(f, 0.0795774715459476679, 1e-15, "0.25/pi");
    INSIDE(fov_focal_length(&(struct fov_setting){.projection = RECTILINEAR, .s = 0.25, .P = 1},
                            0.5, 1e-3, &f, &error));
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = RECTILINEAR, .s = 9, .P = 1}, 1,
                             pi, &f, &error),
            "angle of view 180 deg must be above 0 and below 180 deg (rectilinear)");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = STEREOGRAPHIC, .s = 9, .P = 1}, 1,
                             2 * pi, &f, &error),
            "angle of view 360 deg must be above 0 and below 360 deg (stereographic)");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = EQUISOLID, .s = 9, .P = 1}, 1,
                             2.5 * pi, &f, &error),
            "angle of view 450 deg must be above 0 and at most 360 deg (equisolid)");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = ORTHOGRAPHIC, .s = 9, .P = 1}, 1,
                             1.25 * pi, &f, &error),
            "angle of view 225 deg must be above 0 and at most 180 deg (orthographic)");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = EQUIDISTANT, .s = 9, .P = 1}, 1, 0,
                             &f, &error),
            "angle of view 0 deg must be above 0 and at most 360 deg (equidistant)");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = RECTILINEAR, .s = 0, .P = 1}, 1, 1,
                             &f, &error),
            "distance 0 mm must be above 0 mm");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = RECTILINEAR, .s = 9, .P = 1}, 0, 1,
                             &f, &error),
            "sensor dimension 0 mm must be above 0 and finite");
    OUTSIDE(fov_focal_length(&(struct fov_setting){.projection = RECTILINEAR, .s = 9, .P = 0}, 1, 1,
                             &f, &error),
            "pupil magnification 0 must be above 0 and finite");
    INSIDE(fov_focal_length_for_field(0.25, 0.25, 0.5, &f, &error));
    CHECK_NEAR(f, 0.25, 0, "1:1");
    OUTSIDE(fov_focal_length_for_field(0, 1, 1, &f, &error),
            "sensor dimension 0 mm must be above 0 and finite");
    OUTSIDE(fov_focal_length_for_field(1, 0, 1, &f, &error),
            "field width 0 mm must be above 0 and finite");
    OUTSIDE(fov_focal_length_for_field(1, 1, 0, &f, &error),
            "distance 0 mm must be above 0 and finite");
    static const struct {
        double degrees;
        const char *word;
    } kinds[] = {{19.99, "narrow"}, {20, "medium"}, {39.99, "medium"}, {40, "normal"},
                 {59.99, "normal"}, {60, "wide"},   {89.99, "wide"},   {90, "ultra-wide"}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        CHECK_TEXT(fov_kind((kinds[i].degrees + 1e-9) * (pi / 180)), kinds[i].word);
    }
}

static void test_format(void)
{
    const struct sensor sensor = {.width = 3, .height = 4, .pitch = 0.25},
                        bare = {.width = 3, .height = 4, .pitch = NAN};
    double c = 0;
    CHECK_RELATIVE(sensor_crop(&sensor), 8.65332306111357396, 1e-15, "sqrt(1872)/5");
    OUTSIDE(sensor_check(&(struct sensor){0, 1, NAN}, &error),
            "sensor width 0 mm must be above 0 and finite");
    OUTSIDE(sensor_check(&(struct sensor){1, 0, NAN}, &error),
            "sensor height 0 mm must be above 0 and finite");
    OUTSIDE(sensor_check(&(struct sensor){1, 1, 0}, &error),
            "pixel pitch 0 mm must be above 0 and finite");
    INSIDE(coc_resolve(&(struct coc){.kind = COC_LENGTH, .value = 0}, NULL, &c, &error));
    OUTSIDE(coc_resolve(&(struct coc){.kind = COC_LENGTH, .value = -1}, NULL, &c, &error),
            "circle of confusion -1 mm must be 0 or more and finite");
    OUTSIDE(coc_resolve(&(struct coc){.kind = COC_LENGTH, .value = INFINITY}, NULL, &c, &error),
            "circle of confusion inf mm must be 0 or more and finite");
    INSIDE(coc_resolve(&(struct coc){.kind = COC_DIAGONAL, .value = 0.5}, &bare, &c, &error));
    CHECK_NEAR(c, 10, 0, "5/0.5");
    OUTSIDE(coc_resolve(&(struct coc){.kind = COC_DIAGONAL, .value = 0}, &bare, &c, &error),
            "circle of confusion d/x: x 0 must be above 0 and finite");
    INSIDE(coc_resolve(&(struct coc){.kind = COC_PIXELS, .value = 0.5}, &sensor, &c, &error));
    CHECK_NEAR(c, 0.125, 0, "half a pixel");
    OUTSIDE(coc_resolve(&(struct coc){.kind = COC_PIXELS, .value = 0}, &sensor, &c, &error),
            "circle of confusion 0 pixels must be above 0 and finite");
    struct coc print = {.kind = COC_PRINT, .viewing = 0.5, .acuity = 0.25, .print = 0.5};
    INSIDE(coc_resolve(&print, &bare, &c, &error));
    CHECK_RELATIVE(c, 0.064, 1e-15, "(0.5/250)/(0.25 0.5/4)");
    print.viewing = 0;
    OUTSIDE(coc_resolve(&print, &bare, &c, &error),
            "viewing distance 0 mm must be above 0 and finite");
    print = (struct coc){.kind = COC_PRINT, .viewing = 1, .acuity = 0, .print = 1};
    OUTSIDE(coc_resolve(&print, &bare, &c, &error),
            "acuity 0 line pairs per mm must be above 0 and finite");
    print = (struct coc){.kind = COC_PRINT, .viewing = 1, .acuity = 1, .print = 0};
    OUTSIDE(coc_resolve(&print, &bare, &c, &error),
            "long side of the print 0 mm must be above 0 and finite");
    struct coc airy = {.kind = COC_AIRY, .wavelength = 0.5, .fnumber = 0.5};
    INSIDE(coc_resolve(&airy, &bare, &c, &error));
    CHECK_RELATIVE(c, 0.609834945633252246, 1e-15, "2 1.22 lambda N");
    airy.fnumber = 0;
    OUTSIDE(coc_resolve(&airy, &bare, &c, &error), "f-number 0 must be above 0 and finite");
}

static void test_equivalent(void)
{
    const struct sensor quarter = {0.5, 0.25, NAN}, half = {1, 0.75, NAN};
    double k = 0;
    INSIDE(equivalent_ratio(&quarter, &half, EQUIVALENT_WIDTH, &k, &error));
    CHECK_NEAR(k, 2, 0, "widths");
    INSIDE(equivalent_ratio(&quarter, &half, EQUIVALENT_HEIGHT, &k, &error));
    CHECK_NEAR(k, 3, 0, "heights");
    OUTSIDE(equivalent_ratio(&quarter, &(struct sensor){0, 1, NAN}, 0, &k, &error),
            "sensor width 0 mm must be above 0 and finite");
    OUTSIDE(equivalent_ratio(&(struct sensor){1, 0, NAN}, &half, 0, &k, &error),
            "sensor height 0 mm must be above 0 and finite");
    OUTSIDE(equivalent_ratio(&(struct sensor){INFINITY, 1, NAN}, &half, 0, &k, &error),
            "sensor width inf mm must be above 0 and finite");
    OUTSIDE(equivalent_ratio(&(struct sensor){1, INFINITY, NAN}, &half, 0, &k, &error),
            "sensor height inf mm must be above 0 and finite");
    struct equivalent e;
    const struct equivalent_setting good = {0.5, 0.5, 0.5, 0.5, 0.5, 0};
    INSIDE(equivalent_compute(&good, 0.5, EQUIVALENT_EXPOSURE, &e, &error));
    CHECK_RELATIVE(e.f, 1.0 / 3, 1e-15, "f k (1 + m/P)/(1 + k m/P)");
    CHECK_RELATIVE(e.N, 2.0 / 3, 1e-15, "N (1 + m/P)/(1 + k m/P)");
    CHECK_NEAR(e.working_fnumber, 1, 1e-15, "the same exposure");
    CHECK_NEAR(e.light_stops, -2, 0, "a quarter of the area");
    CHECK_NEAR(e.field_depth_ratio, 2, 0, "1/k");
    CHECK_RELATIVE(e.pupil_diameter, 0.5, 1e-15, "f/N");
    INSIDE(equivalent_compute(&good, 0.5, EQUIVALENT_PICTURE, &e, &error));
    CHECK_RELATIVE(e.N, 1.0 / 3, 1e-15, "the same pupil");
    CHECK_NEAR(e.iso, 0.125, 0, "k^2");
    CHECK_NEAR(e.field_depth_ratio, 1, 0, "the same picture");
    CHECK_NEAR(e.light_stops, 0, 0, "the same light");
    static const struct {
        struct equivalent_setting setting;
        double k;
        const char *message;
    } rows[] = {
        {{0, 1, 1, 1, 1, 1}, 1, "focal length 0 mm must be above 0 and finite"},
        {{1, 0, 1, 1, 1, 1}, 1, "f-number 0 must be above 0 and finite"},
        {{1, 1, -0.5, 1, 1, 1}, 1, "magnification -0.5 must be 0 or more and finite"},
        {{1, 1, INFINITY, 1, 1, 1}, 1, "magnification inf must be 0 or more and finite"},
        {{1, 1, 1, 0, 1, 1}, 1, "pupil magnification 0 must be above 0 and finite"},
        {{1, 1, 1, 1, 0, 1}, 1, "ISO speed 0 must be above 0 and finite"},
        {{1, 1, 1, 1, 1, -0.5}, 1, "circle of confusion -0.5 mm must be 0 or more and finite"},
        {{1, 1, 1, 1, 1, INFINITY}, 1, "circle of confusion inf mm must be 0 or more and finite"},
        {{1, 1, 1, 1, 1, 1}, 0, "size ratio of the formats 0 must be above 0 and finite"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        OUTSIDE(equivalent_compute(&rows[i].setting, rows[i].k, EQUIVALENT_PICTURE, &e, &error),
                rows[i].message);
    }
}

static void test_motion(void)
{
    double m = 0;
    INSIDE(motion_magnification(0.25, 0.5, &m, &error));
    CHECK_NEAR(m, 1, 0, "1:1");
    OUTSIDE(motion_magnification(0, 1, &m, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(motion_magnification(50, 50, &m, &error),
            "distance 50 mm lies within the focal length 50 mm: no real image");
    struct motion shot = *MOTION(.v = 0.5, .t = 0.5, .m = 0.25, .s = 0.25);
    INSIDE(motion_solve(&shot, &error));
    CHECK_NEAR(shot.blur, 0.0625, 1e-16, "v t m");
    struct motion high = *MOTION(.v = 1, .t = 1, .m = 0.5, .s = 4, .angle = 0, .h = 0.75);
    INSIDE(motion_solve(&high, &error));
    CHECK_NEAR(high.blur, 0.25, 1e-16, "h/s/(1 - 1/4)");
    struct motion high_time =
        *MOTION(.v = 1, .blur = 0.25, .m = 0.5, .s = 4, .angle = 0, .h = 0.75);
    INSIDE(motion_solve(&high_time, &error));
    CHECK_NEAR(high_time.t, 1, 1e-15, "and back");
    MISUSED(motion_solve(MOTION(.v = 1, .t = 1, .blur = 1, .h = 0.5), &error),
            "magnification is solved for on the axis only: leave image height out");
    MISUSED(motion_solve(MOTION(.v = 1, .t = 1), &error),
            "give exactly three of speed, exposure time, magnification and blur");
    OUTSIDE(motion_solve(MOTION(.v = 0, .t = 1, .m = 1), &error),
            "speed 0 mm/s must be above 0 and finite");
    OUTSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .s = 0), &error),
            "distance 0 mm must be above 0");
    OUTSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .h = INFINITY), &error),
            "image height inf mm must be finite");
    INSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .angle = pi), &error));
    INSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .angle = 0), &error));
    OUTSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .angle = 1.25 * pi), &error),
            "angle of the motion 225 deg lies outside 0 to 180 deg");
    OUTSIDE(motion_solve(MOTION(.v = 1, .t = 1, .m = 1, .angle = -pi / 4), &error),
            "angle of the motion -45 deg lies outside 0 to 180 deg");
    OUTSIDE(motion_solve(MOTION(.v = 2, .t = 2, .m = 1, .angle = 0, .s = 4), &error),
            "exposure time 2 s is too long: the subject reaches the lens in 2 s");
    OUTSIDE(motion_solve(MOTION(.t = 1, .m = 1, .blur = 0.5, .angle = 0), &error),
            "no speed makes the blur 0.5 mm at the angle of the motion 0 deg");
}

static void test_unsteady(void)
{
    struct shake shake = *SHAKE(.f = 0.5, .omega = 0.5, .t = 0.5, .m = 1);
    INSIDE(shake_solve(&shake, &error));
    CHECK_NEAR(shake.blur, 0.25, 0, "f (1 + m) w t");
    OUTSIDE(shake_solve(SHAKE(.f = 1, .omega = 1, .t = 1, .m = -0.5), &error),
            "magnification -0.5 must be 0 or more and finite");
    OUTSIDE(shake_solve(SHAKE(.f = 1, .omega = 0, .t = 1), &error),
            "rotation 0 rad/s must be above 0 and finite");
    MISUSED(shake_solve(SHAKE(.f = 1, .omega = 1), &error),
            "give exactly three of focal length, rotation, exposure time and blur");
    struct blur_size size;
    INSIDE(blur_measure(0.5, 0.25, 0.125, &size, &error));
    CHECK_NEAR(size.pixels, 2, 0, "blur/pitch");
    CHECK_NEAR(size.circles, 4, 0, "blur/c");
    OUTSIDE(blur_measure(1, 0, 1, &size, &error), "pixel pitch 0 mm must be above 0 and finite");
    OUTSIDE(blur_measure(1, 1, 0, &size, &error),
            "circle of confusion 0 mm must be above 0 and finite");
    struct panning_blur blur;
    INSIDE(panning_solve(&(struct panning_shot){0.5, pi / 2, 0.5, 0.25, 0.5, 0}, &blur, &error));
    CHECK_NEAR(blur.rate, 1, 1e-16, "v/s");
    CHECK_NEAR(blur.subject, 0.25, 1e-16, "(1 - 0) m v t");
    CHECK_NEAR(blur.background, 0, 0, "standing still");
    OUTSIDE(panning_solve(&(struct panning_shot){0, 1, 1, 1, 2, 1}, &blur, &error),
            "speed 0 mm/s must be above 0 and finite");
    OUTSIDE(panning_solve(&(struct panning_shot){1, 1, 0, 1, 2, 1}, &blur, &error),
            "exposure time 0 s must be above 0 and finite");
    OUTSIDE(panning_solve(&(struct panning_shot){1, 4 * pi, 1, 1, 2, 1}, &blur, &error),
            "angle of the motion 720 deg lies outside 0 to 180 deg");
    OUTSIDE(panning_solve(&(struct panning_shot){1, 1, 1, 1, 1, 1}, &blur, &error),
            "distance 1 mm lies within the focal length 1 mm: no real image");
    OUTSIDE(panning_solve(&(struct panning_shot){1, 1, 1, 1, 2, -0.5}, &blur, &error),
            "track -0.5 must be 0 or more and finite");
    double t = 0;
    INSIDE(handheld_time(0.5, 0.5, 20, &t, &error));
    CHECK_NEAR(t, 0x1p22, 0, "2^20/(crop f)");
    OUTSIDE(handheld_time(0, 1, 0, &t, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(handheld_time(1, 0, 0, &t, &error), "crop factor 0 must be above 0 and finite");
    OUTSIDE(handheld_time(1, 1, 20.5, &t, &error),
            "stabiliser 20.5 stops lies outside 0 to 20 stops");
    OUTSIDE(handheld_time(1, 1, -0.5, &t, &error),
            "stabiliser -0.5 stops lies outside 0 to 20 stops");
    struct rolling_skew skew;
    INSIDE(rolling_shutter(0, 0.5, 0.5, &skew, &error));
    CHECK_NEAR(skew.angle, 0, 0, "nothing moves");
    INSIDE(rolling_shutter(0.5, 0.5, 0.25, &skew, &error));
    CHECK_RELATIVE(skew.angle, pi / 4, 1e-15, "as far as it is high");
    OUTSIDE(rolling_shutter(-0.5, 1, 1, &skew, &error),
            "speed of the image -0.5 mm/s must be 0 or more and finite");
    OUTSIDE(rolling_shutter(1, 0, 1, &skew, &error), "readout time 0 s must be above 0 and finite");
    OUTSIDE(rolling_shutter(1, 1, 0, &skew, &error),
            "height of the sensor 0 mm must be above 0 and finite");
}

int main(void)
{
    test_projections();
    test_fov();
    test_fov_goals();
    test_fov_distance();
    test_fov_sensor();
    test_fov_focal_length();
    test_format();
    test_equivalent();
    test_motion();
    test_unsteady();
    return check_report();
}
