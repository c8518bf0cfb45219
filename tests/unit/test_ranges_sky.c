/* tests/unit/test_ranges_sky.c - legal ranges of star trails, panoramas and tilts. */
/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "base/constants.h"
#include "photo/panorama.h"
#include "photo/stars.h"
#include "photo/tilt.h"
#include "ranges.h"

static const double pi = PI;

static void test_star_ranges(void)
{
    static const char beyond[] = "declination 135 deg lies outside -90 to 90 deg";
    static const char pole[] =
        "declination 90 deg is a pole: a star there does not move and no time is too long; the "
        "declination must lie between -90 and 90 deg";
    static const char turn[] =
        "exposure time 86165 s exceeds one turn of the sky, 86164.0989 s: the "
        "trail is closed";
    struct star_trail trail;
    struct star_time time;
    double x = 0;
    INSIDE(star_trail(0.5, pi / 2, STELLAR_DAY, &trail, &error));
    INSIDE(star_trail(0.5, -pi / 2 * (1 + 5e-13), 0.5, &trail, &error));
    CHECK(!star_trail(0.5, pi / 2 * (1 + 1.5e-12), 1, &trail, &error));
    OUTSIDE(star_trail(0, 0, 1, &trail, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(star_trail(1, 0.75 * pi, 1, &trail, &error), beyond);
    OUTSIDE(star_trail(1, 0, 0, &trail, &error), "exposure time 0 s must be above 0 and finite");
    OUTSIDE(star_trail(1, 0, 86165, &trail, &error), turn);
    INSIDE(star_trail_worst(0.5, 0, 0.5, 0, &x, &error));
    OUTSIDE(star_trail_worst(0, 0, 1, 1, &x, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(star_trail_worst(1, 0.75 * pi, 1, 1, &x, &error), beyond);
    OUTSIDE(star_trail_worst(1, 0, 86165, 1, &x, &error), turn);
    OUTSIDE(star_trail_worst(1, 0, 1, -0.5, &x, &error),
            "half diagonal -0.5 mm must be 0 or more and finite");
    OUTSIDE(star_trail_worst(1, 0, 1, INFINITY, &x, &error),
            "half diagonal inf mm must be 0 or more and finite");
    INSIDE(star_time(0.5, pi / 2 * (1 - 2e-12), 0.5, &time, &error));
    CHECK(!star_time(1, pi / 2 * (1 - 0.5e-12), 1, &time, &error));
    OUTSIDE(star_time(0, 0, 1, &time, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(star_time(1, pi / 2, 1, &time, &error), pole);
    OUTSIDE(star_time(1, 0.75 * pi, 1, &time, &error), beyond);
    OUTSIDE(star_time(1, 0, 0, &time, &error), "trail 0 mm must be above 0 and finite");
    INSIDE(star_focal_length(0, 0.5, 0.5, &x, &error));
    OUTSIDE(star_focal_length(pi / 2, 1, 1, &x, &error), pole);
    OUTSIDE(star_focal_length(0, 86165, 1, &x, &error), turn);
    OUTSIDE(star_focal_length(0, 1, 0, &x, &error), "trail 0 mm must be above 0 and finite");
}

static void test_star_rules(void)
{
    double t = 0;
    INSIDE(star_rule_time(0.5, 0.5, 0.25, &t, &error));
    CHECK_NEAR(t, 4, 0, "constant/(crop f)");
    OUTSIDE(star_rule_time(0, 1, 1, &t, &error), "rule constant 0 must be above 0 and finite");
    OUTSIDE(star_rule_time(1, 0, 1, &t, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(star_rule_time(1, 1, 0, &t, &error), "crop factor 0 must be above 0 and finite");
    INSIDE(npf_simple_time(0.5, 0.5, 0.0005, &t, &error));
    CHECK_RELATIVE(t, 65.0, 1e-15, "(35 N + 30 p)/f, p in um");
    OUTSIDE(npf_simple_time(0, 1, 1, &t, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(npf_simple_time(1, 0, 1, &t, &error), "f-number 0 must be above 0 and finite");
    OUTSIDE(npf_simple_time(1, 1, 0, &t, &error), "pixel pitch 0 mm must be above 0 and finite");
    INSIDE(npf_full_time(0.5, 0.5, 0.0005, pi / 3, 0.5, &t, &error));
    CHECK_RELATIVE(t, 30.7, 1e-15, "k (16.9 N + 0.1 f + 13.7 p)/(f cos 60)");
    OUTSIDE(npf_full_time(1, 1, 0, 0, 1, &t, &error),
            "pixel pitch 0 mm must be above 0 and finite");
    OUTSIDE(npf_full_time(1, 1, 1, 0.75 * pi, 1, &t, &error),
            "declination 135 deg lies outside -90 to 90 deg");
    OUTSIDE(npf_full_time(1, 1, 1, 0, 0, &t, &error), "accuracy 0 must be above 0 and finite");
    INSIDE(four_minus_crop_time(0.5, 0.5, &t, &error));
    CHECK_NEAR(t, 700, 0, "100 (4 - crop)/f");
    OUTSIDE(four_minus_crop_time(0, 1, &t, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(four_minus_crop_time(1, 0, &t, &error), "crop factor 0 must be above 0 and finite");
    OUTSIDE(four_minus_crop_time(1, 4, &t, &error),
            "crop factor 4 must lie below 4 for the 4 - crop rule");
}

/*
 * The fastest corner of the frame: the velocity p x d of a direction d = (R cos a, R sin a, 1)
 * about the pole p, seen in the gnomonic projection, searched over a by a script of its own.
 */
static void test_star_worst(void)
{
    static const struct {
        double f, half, dec, factor; /* over w t */
        const char *source;
    } rows[] = {
        {0.5, 1, 1.0, 1.6006616173190642, "corner at slope 2"},
        {0.5, 1, -1.5, 1.032863587437906, "corner at slope 2"},
        {2, 0.5, 1.0, 1.5013401041402274, "corner at slope 0.25"},
        {2, 0, 0.0, 2.0, "corner at slope 0"},
        {2, 0.125, 1.2, 0.8412203946992504, "corner at slope 0.0625"},
        {4, 2, 1.5, 2.27793877987892, "corner at slope 0.5"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double worst = 0;
        INSIDE(star_trail_worst(rows[i].f, rows[i].dec, 1000, rows[i].half, &worst, &error));
        CHECK_RELATIVE(worst, rows[i].factor * 0.07292115146706924, 1e-13, rows[i].source);
    }
}

static void test_panorama_frame(void)
{
    struct panorama_frame frame;
    double x = 0;
    INSIDE(panorama_frame(0.25, 0.25, 0.25, 1, 0.5, &frame, &error));
    CHECK_RELATIVE(frame.horizontal, pi / 2, 1e-15, "width 2 f (1 + m/P)");
    CHECK_RELATIVE(frame.vertical, 0.927295218001612232, 1e-15, "2 atan(1/2)");
    OUTSIDE(panorama_frame(0, 0, 1, 1, 1, &frame, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(panorama_frame(1, -0.5, 1, 1, 1, &frame, &error),
            "magnification -0.5 must be 0 or more and finite");
    OUTSIDE(panorama_frame(1, 0, 0, 1, 1, &frame, &error),
            "pupil magnification 0 must be above 0 and finite");
    OUTSIDE(panorama_frame(1, 0, 1, 0, 1, &frame, &error),
            "sensor width 0 mm must be above 0 and finite");
    OUTSIDE(panorama_frame(1, 0, 1, 1, 0, &frame, &error),
            "sensor height 0 mm must be above 0 and finite");
    INSIDE(panorama_pupil(0.5, 0.5, 0.5, -1, &x, &error));
    CHECK_NEAR(x, -0.75, 1e-16, "f (1 + m) + hiatus + f (1 - 1/P)");
    OUTSIDE(panorama_pupil(0, 0, 1, 0, &x, &error), "focal length 0 mm must be above 0 and finite");
    OUTSIDE(panorama_pupil(1, 0, 0, 0, &x, &error),
            "pupil magnification 0 must be above 0 and finite");
    OUTSIDE(panorama_pupil(1, 0, 1, INFINITY, &x, &error), "hiatus inf mm must be finite");
}

static void test_panorama_plan(void)
{
    const struct panorama_frame frame = {pi / 4, pi / 8}, tiny = {1e-5, 1e-5}, small = {1e-3, 1e-3};
    struct panorama_goal goal = {2 * pi, pi / 2, 0.5};
    struct panorama plan;
    INSIDE(panorama_plan(&frame, &goal, &plan, &error));
    CHECK(plan.columns == 16 && plan.rows == 7 && plan.shots == 112);
    CHECK_RELATIVE(plan.step, pi / 8, 1e-15, "360 deg in 16");
    CHECK_RELATIVE(plan.row_step, pi / 16, 1e-15, "(90 - 22.5) deg in 6 steps");
    CHECK_NEAR(plan.overlap, 0.5, 1e-15, "as asked");
    CHECK_NEAR(plan.row_overlap, 0.5, 1e-15, "as asked");
    goal = (struct panorama_goal){0.5, 0, 0};
    INSIDE(panorama_plan(&frame, &goal, &plan, &error));
    CHECK(plan.shots == 1 && isnan(plan.overlap) && isnan(plan.row_overlap));
    CHECK_NEAR(plan.step, 0, 0, "a single frame");
    INSIDE(panorama_plan(&(struct panorama_frame){2 * pi, 2 * pi},
                         &(struct panorama_goal){2 * pi, pi, 0}, &plan, &error));
    static const struct {
        struct panorama_frame frame;
        struct panorama_goal goal;
        const char *message;
    } rows[] = {
        {{0, 1},
         {1, 0, 0},
         "horizontal angle of view 0 degrees is out of range (above 0, up to 360)"},
        {{2.5 * PI, 1},
         {1, 0, 0},
         "horizontal angle of view 450 degrees is out of range (above 0, up to 360)"},
        {{1, 0},
         {1, 0, 0},
         "vertical angle of view 0 degrees is out of range (above 0, up to 360)"},
        {{1, 2.5 * PI},
         {1, 0, 0},
         "vertical angle of view 450 degrees is out of range (above 0, up to 360)"},
        {{1, 1}, {0, 0, 0}, "arc 0 degrees is out of range (above 0, up to 360)"},
        {{1, 1}, {2.5 * PI, 0, 0}, "arc 450 degrees is out of range (above 0, up to 360)"},
        {{1, 1}, {1, -0.25 * PI, 0}, "span -45 degrees is out of range (from 0, up to 180)"},
        {{1, 1}, {1, 1.25 * PI, 0}, "span 225 degrees is out of range (from 0, up to 180)"},
        {{1, 1}, {1, 0, 1}, "overlap 1 is out of range (0 up to below 1)"},
        {{1, 1}, {1, 0, -0.5}, "overlap -0.5 is out of range (0 up to below 1)"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        OUTSIDE(panorama_plan(&rows[i].frame, &rows[i].goal, &plan, &error), rows[i].message);
    }
    INSIDE(panorama_plan(&tiny, &(struct panorama_goal){5, 0, 0}, &plan, &error));
    CHECK(plan.columns == 500000);
    OUTSIDE(panorama_plan(&tiny, &(struct panorama_goal){5, 0, 0.75}, &plan, &error),
            "2e+06 frames a row are out of range (up to 1e+06: a wider frame, less overlap)");
    OUTSIDE(panorama_plan(&small, &(struct panorama_goal){2, 2, 0}, &plan, &error),
            "2000 x 2000 frames are out of range (up to 1e+06)");
    INSIDE(panorama_plan(&small, &(struct panorama_goal){1, 1, 0}, &plan, &error));
    CHECK(plan.shots == 1000000);
    /* rounding must not cost a frame: 1e-9 of one is passed over, 2e-9 is not */
    const struct panorama_frame eighth = {0.125, 0.125};
    INSIDE(
        panorama_plan(&eighth, &(struct panorama_goal){0.25 * (1 + 0.25e-9), 0, 0}, &plan, &error));
    CHECK(plan.columns == 2);
    INSIDE(
        panorama_plan(&eighth, &(struct panorama_goal){0.25 * (1 + 0.75e-9), 0, 0}, &plan, &error));
    CHECK(plan.columns == 3);
    double overlap = 0;
    INSIDE(panorama_overlap(&frame, 2 * pi, 16, &overlap, &error));
    CHECK_NEAR(overlap, 0.5, 1e-15, "closed");
    INSIDE(panorama_overlap(&frame, 2 * pi * (1 - 0.5e-12), 16, &overlap, &error));
    CHECK_NEAR(overlap, 0.5, 1e-12, "closed after conversion");
    INSIDE(panorama_overlap(&frame, 2 * pi * (1 - 1.5e-12), 16, &overlap, &error));
    CHECK_NEAR(overlap, 1 - 7.0 / 15, 1e-11, "an arc: (360 - 45)/15 deg of 45");
    INSIDE(panorama_overlap(&frame, pi, 1, &overlap, &error));
    CHECK(isnan(overlap));
    OUTSIDE(panorama_overlap(&frame, pi, 0, &overlap, &error),
            "number of columns 0 is out of range (1 or more)");
    OUTSIDE(panorama_overlap(&frame, 2.5 * pi, 3, &overlap, &error),
            "arc 450 degrees is out of range (above 0, up to 360)");
    OUTSIDE(panorama_overlap(&(struct panorama_frame){0, 1}, pi, 3, &overlap, &error),
            "horizontal angle of view 0 degrees is out of range (above 0, up to 360)");
}

static void test_panorama_rows(void)
{
    const struct panorama_frame frame = {pi / 2, pi / 4};
    const struct panorama_goal goal = {2 * pi, pi, 0};
    const struct panorama plan = {.columns = 4, .rows = 5, .step = pi / 2, .row_step = pi / 4};
    struct panorama_row row;
    struct panorama_size size;
    INSIDE(panorama_row_at(&frame, &goal, &plan, 0, 2, &row, &error));
    CHECK(row.columns == 4);
    CHECK_NEAR(row.elevation, 0, 0, "the middle one");
    INSIDE(panorama_row_at(&frame, &goal, &plan, 0, 3, &row, &error));
    CHECK_RELATIVE(row.elevation, pi / 4, 1e-15, "one up");
    CHECK(row.columns == 4); /* 360/(2 atan cot 45) */
    INSIDE(panorama_row_at(&frame, &goal, &plan, 0, 4, &row, &error));
    CHECK(row.columns == 1 && row.step == 0);
    CHECK_RELATIVE(row.elevation, pi / 2, 1e-15, "the zenith");
    OUTSIDE(panorama_row_at(&frame, &goal, &plan, 0, 5, &row, &error),
            "row 5 is out of range (0 to 4)");
    OUTSIDE(panorama_row_at(&frame, &goal, &plan, 0, -1, &row, &error),
            "row -1 is out of range (0 to 4)");
    OUTSIDE(panorama_row_at(&frame, &goal, &plan, pi / 4, 4, &row, &error),
            "row at 135 degrees is out of range (-90 to 90)");
    OUTSIDE(panorama_row_at(&(struct panorama_frame){pi, 1}, &goal, &plan, 0, 0, &row, &error),
            "a flat frame of 180 x 57.2958 degrees is out of range (above 0, below 180)");
    OUTSIDE(panorama_row_at(&(struct panorama_frame){1, 0}, &goal, &plan, 0, 0, &row, &error),
            "a flat frame of 57.2958 x 0 degrees is out of range (above 0, below 180)");
    INSIDE(panorama_size(&frame, &(struct panorama_goal){pi / 2, pi / 2, 0}, 0.5, &size, &error));
    CHECK_RELATIVE(size.per_degree, pi / 720, 1e-15, "1/4 pixel a radian");
    CHECK_RELATIVE(size.width, pi / 8, 1e-15, "arc times that");
    CHECK_RELATIVE(size.sphere_height, pi / 8, 1e-15, "span times that");
    CHECK_RELATIVE(size.cylinder_height, 0.5, 1e-15, "2 tan 45 deg times that");
    CHECK_RELATIVE(size.flat_width, 0.5, 1e-15, "2 tan 45 deg times that");
    INSIDE(panorama_size(&frame, &(struct panorama_goal){pi, pi, 0}, 1, &size, &error));
    CHECK_NEAR(size.cylinder_height, INFINITY, 0, "a half turn");
    CHECK_NEAR(size.flat_width, INFINITY, 0, "a half turn");
    OUTSIDE(panorama_size(&frame, &goal, 0, &size, &error),
            "pixels of a frame 0 must be above 0 and finite");
}

static void test_panorama_parallax(void)
{
    double x = 0;
    INSIDE(panorama_parallax(-0.5, pi, 1, INFINITY, &x, &error));
    CHECK_RELATIVE(x, 0.927295218001612232, 1e-15, "2 atan(0.5/1)");
    INSIDE(panorama_parallax(0.5, pi, 1, 1, &x, &error));
    CHECK_NEAR(x, 0, 0, "no depth");
    OUTSIDE(panorama_parallax(1, 0, 2, 3, &x, &error),
            "step 0 degrees is out of range (above 0, up to 180)");
    OUTSIDE(panorama_parallax(1, 1.25 * pi, 2, 3, &x, &error),
            "step 225 degrees is out of range (above 0, up to 180)");
    OUTSIDE(panorama_parallax(-2, 1, 2, 3, &x, &error),
            "nearest point 2 mm lies within the circle of the entrance pupil (more than the offset "
            "2 mm)");
    OUTSIDE(panorama_parallax(1, 1, 3, 2.5, &x, &error),
            "farthest point 2.5 mm lies before the nearest point 3 mm (3 mm or more)");
    INSIDE(panorama_offset(pi / 2, pi / 6, 0.5, &x, &error));
    CHECK_RELATIVE(x, 0.408248290463863016, 1e-15, "sin 45/sin 60 of it");
    INSIDE(panorama_nearest(-0.408248290463863016, pi / 2, pi / 6, &x, &error));
    CHECK_RELATIVE(x, 0.5, 1e-15, "the way back");
    OUTSIDE(panorama_offset(0.75 * pi, pi / 4, 1, &x, &error),
            "parallax of 135 degrees is out of range (above 0, below 135)");
    OUTSIDE(panorama_offset(0, pi / 4, 1, &x, &error),
            "parallax of 0 degrees is out of range (above 0, below 135)");
    OUTSIDE(panorama_offset(1, 1, 0, &x, &error), "nearest point 0 mm must be above 0 and finite");
    OUTSIDE(panorama_nearest(0, 1, 1, &x, &error), "offset 0 mm must be above 0 and finite");
    OUTSIDE(panorama_nearest(1, 1, 1.25 * pi, &x, &error),
            "step 225 degrees is out of range (above 0, up to 180)");
}

/* What is not named is not given: named members override the NaNs. */
#pragma GCC diagnostic ignored "-Woverride-init"
#define TILT(...)                                                                                  \
    (&(struct tilt_given){.f = 0.5,                                                                \
                          .N = 0.5,                                                                \
                          .c = 0,                                                                  \
                          .tilt = NAN,                                                             \
                          .hinge = NAN,                                                            \
                          .image = NAN,                                                            \
                          .distance = NAN,                                                         \
                          .angle = NAN,                                                            \
                          __VA_ARGS__})

static void test_tilt_ranges(void)
{
    struct tilt t;
    INSIDE(tilt_solve(TILT(.tilt = 0, .image = 0.75), &t, &error));
    INSIDE(tilt_solve(TILT(.tilt = 0, .image = 0.75, .c = 0.5), &t, &error));
    OUTSIDE(
        tilt_solve(TILT(.tilt = 0, .image = 1, .c = 1), &t, &error),
        "circle of confusion 1 mm is not narrower than the aperture (0 or more, below f/N = 1 mm)");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .image = 1, .c = -0.5), &t, &error),
            "circle of confusion -0.5 mm is not narrower than the aperture (0 or more, below f/N = "
            "1 mm)");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .image = 1, .f = 0), &t, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .image = 1, .N = 0), &t, &error),
            "f-number 0 must be above 0 and finite");
    MISUSED(tilt_solve(TILT(.image = 1), &t, &error), "give exactly one of tilt and hinge");
    MISUSED(tilt_solve(TILT(.image = 1, .tilt = 0, .hinge = 1), &t, &error),
            "give exactly one of tilt and hinge");
    INSIDE(tilt_solve(TILT(.hinge = -1, .image = 0.75), &t, &error));
    CHECK_RELATIVE(t.tilt, -pi / 6, 1e-15, "asin(f/J)");
    OUTSIDE(tilt_solve(TILT(.hinge = 0.25, .image = 1), &t, &error),
            "hinge 0.25 mm is nearer than any tilt can bring it with focal length 0.5 mm (above "
            "0.5 mm on either side)");
    OUTSIDE(tilt_solve(TILT(.hinge = 0.5, .image = 1), &t, &error),
            "tilt 90 degrees is out of range (-90 to 90, exclusive)");
    OUTSIDE(tilt_solve(TILT(.tilt = -0.75 * pi, .image = 1), &t, &error),
            "tilt -135 degrees is out of range (-90 to 90, exclusive)");
    MISUSED(tilt_solve(TILT(.tilt = 0), &t, &error),
            "give exactly one of image distance, distance and angle of the plane of focus");
    MISUSED(tilt_solve(TILT(.tilt = 0, .image = 1, .angle = 1), &t, &error),
            "give exactly one of image distance, distance and angle of the plane of focus");
    MISUSED(tilt_solve(TILT(.tilt = 0, .image = 1, .distance = 1), &t, &error),
            "give exactly one of image distance, distance and angle of the plane of focus");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .image = 0), &t, &error),
            "image distance 0 mm must be above 0 and finite");
    INSIDE(tilt_solve(TILT(.tilt = pi / 3, .distance = 1.25), &t, &error));
    CHECK_RELATIVE(t.image, 5.0, 1e-14, "f/(cos 60 - 0.5/1.25)");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .distance = 0.5), &t, &error),
            "distance 0.5 mm lies within the focal length of the tilted lens: no real image (more "
            "than f/cos(tilt) = 0.5 mm)");
    OUTSIDE(tilt_solve(TILT(.tilt = 0, .angle = 1), &t, &error),
            "angle of the plane of focus needs a tilt: untilted, the plane of focus is parallel to "
            "the sensor (a tilt other than 0)");
    OUTSIDE(tilt_solve(TILT(.tilt = pi / 4, .angle = pi / 4), &t, &error),
            "angle of the plane of focus 45 degrees cannot be reached with this tilt (between 45 "
            "and 180)");
    OUTSIDE(tilt_solve(TILT(.tilt = -pi / 4, .angle = -pi), &t, &error),
            "angle of the plane of focus -180 degrees cannot be reached with this tilt (between "
            "-45 and -180)");
    INSIDE(tilt_solve(TILT(.tilt = -pi / 6, .angle = -pi / 2), &t, &error));
    CHECK_RELATIVE(t.image, 0.577350269189625765, 1e-15, "f/sin 60");
}

static void test_tilt_points(void)
{
    struct tilt_point near = {1, 0}, far = {2, 0.5}, at = {0, 0};
    double tilt = 0, image = 0;
    INSIDE(tilt_through(0.5, &near, &far, &tilt, &image, &error));
    CHECK_RELATIVE(tilt, pi / 6, 1e-15, "sine f (1 - 1/2)/0.5");
    CHECK_RELATIVE(image, 1.36602540378443865, 1e-14, "f/(cos 30 - 0.5)");
    OUTSIDE(tilt_through(0, &near, &far, &tilt, &image, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(tilt_through(1, &at, &far, &tilt, &image, &error),
            "points at 0 mm and 2 mm: one is not in front of the lens (above 0 mm)");
    OUTSIDE(tilt_through(1, &near, &at, &tilt, &image, &error),
            "points at 1 mm and 0 mm: one is not in front of the lens (above 0 mm)");
    OUTSIDE(
        tilt_through(1, &near, &(struct tilt_point){2, 0}, &tilt, &image, &error),
        "both points lie in the same direction (slope 0): any tilt serves only one of them (two "
        "directions)");
    OUTSIDE(tilt_through(1, &near, &far, &tilt, &image, &error),
            "the two points ask for a hinge 1 mm from the lens, nearer than the focal length 1 mm "
            "(more than that)");
    OUTSIDE(tilt_through(2, &near, &(struct tilt_point){1, 0.5}, &tilt, &image, &error),
            "no sensor position images both points: the plane through them lies within the focal "
            "length 2 mm (farther away)");
}

/* A 3 x 4 frame untilted: its corner is 2.5 off the middle; the lens stands at v = 2 f. */
static void test_tilt_circle(void)
{
    struct tilt t = {.f = 5, .image = 10, .tilt = 0, .A = 0.5, .B = 0};
    struct tilt_coverage coverage;
    double x = 0;
    INSIDE(tilt_coverage(&t, &(struct tilt_frame){3, 4, 0, 0}, &coverage, &error));
    CHECK_RELATIVE(coverage.circle, 2.5, 1e-15, "at infinity it is half as large");
    CHECK_RELATIVE(coverage.angle, 0.244978663126864154, 1e-15, "atan(1/4)");
    INSIDE(tilt_coverage(&t, &(struct tilt_frame){3, 4, 3, 2.5}, &coverage, &error));
    CHECK_RELATIVE(coverage.circle, 6.40312423743284869, 1e-15, "hypot(4, 5)");
    INSIDE(tilt_coverage(&t, &(struct tilt_frame){3, 4, -3, -2.5}, &coverage, &error));
    CHECK_RELATIVE(coverage.circle, 6.40312423743284869, 1e-15, "and the other way");
    OUTSIDE(tilt_coverage(&t, &(struct tilt_frame){0, 4, 0, 0}, &coverage, &error),
            "sensor width 0 mm must be above 0 and finite");
    OUTSIDE(tilt_coverage(&t, &(struct tilt_frame){3, 0, 0, 0}, &coverage, &error),
            "sensor height 0 mm must be above 0 and finite");
    t.tilt = pi / 4;
    t.B = sin(t.tilt);
    OUTSIDE(tilt_coverage(&t, &(struct tilt_frame){1, 24, 0, 0}, &coverage, &error),
            "a corner of the frame lies beside the tilted lens: no image circle holds it (less "
            "tilt than 45 degrees)");
    /* 2 x 2 on a lens tilted by 45 deg, v = 10: y = 1 lies 9 deg/sqrt 2 across, 11/sqrt 2 along */
    INSIDE(tilt_coverage(&t, &(struct tilt_frame){2, 2, 0, 0}, &coverage, &error));
    CHECK_RELATIVE(coverage.circle, 12.322818340454909, 1e-15, "hypot(sqrt 2, 11)/9 x 10");
    INSIDE(tilt_shift_limit(&(struct tilt){.f = 5, .image = 10}, 2.5,
                            &(struct tilt_frame){3, 4, 0, 0}, &x, &error));
    CHECK_NEAR(x, 0, 1e-15, "the circle touches the corners");
    INSIDE(tilt_shift_limit(&(struct tilt){.f = 5, .image = 10}, 6.5,
                            &(struct tilt_frame){6.5, 6, 0, 0}, &x, &error));
    CHECK_RELATIVE(x, 2.6291651245988508, 1e-14, "sqrt(6.5^2 - 3.25^2) - 3");
    OUTSIDE(tilt_shift_limit(&(struct tilt){.f = 5, .image = 10}, 2.25,
                             &(struct tilt_frame){3, 4, 0, 0}, &x, &error),
            "image circle 2.25 mm does not cover the frame 3 x 4 mm (2.5 mm or more)");
    OUTSIDE(tilt_shift_limit(&(struct tilt){.f = 0, .image = 1}, 1,
                             &(struct tilt_frame){1, 1, 0, 0}, &x, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(tilt_shift_limit(&(struct tilt){.f = 1, .image = 0}, 1,
                             &(struct tilt_frame){1, 1, 0, 0}, &x, &error),
            "image distance 0 mm must be above 0 and finite");
}

int main(void)
{
    test_star_ranges();
    test_star_rules();
    test_star_worst();
    test_panorama_frame();
    test_panorama_plan();
    test_panorama_rows();
    test_panorama_parallax();
    test_tilt_ranges();
    test_tilt_points();
    test_tilt_circle();
    return check_report();
}
