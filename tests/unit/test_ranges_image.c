/* tests/unit/test_ranges_image.c - legal ranges of conjugates, attachments and diffraction. */
/* SPDX-License-Identifier: MIT */
#include <stddef.h>

#include "photo/attach.h"
#include "photo/conjugate.h"
#include "photo/diffraction.h"
#include "photo/distance_from.h"
#include "ranges.h"

/* What is not named is not given: named members override the NaNs. */
#pragma GCC diagnostic ignored "-Woverride-init"
#define PAIR(...)                                                                                  \
    (&(struct conjugates_given){                                                                   \
        .f = NAN, .s = NAN, .v = NAN, .m = NAN, .T = NAN, .hiatus = 0, __VA_ARGS__})
#define INSIDE_PAIR(...)           INSIDE(conjugates_solve(PAIR(__VA_ARGS__), &r, &error))
#define OUTSIDE_PAIR(message, ...) OUTSIDE(conjugates_solve(PAIR(__VA_ARGS__), &r, &error), message)

/* The equals sign of each limit: f = 100 mm, all numbers exact in binary. */
static void test_conjugates(void)
{
    struct conjugates r;
    INSIDE_PAIR(.f = 0.25, .s = 0.5);
    CHECK_NEAR(r.m, 1, 0, "twice the focal length");
    OUTSIDE_PAIR("distance 100 mm lies within the focal length 100 mm: no real image, a magnifier "
                 "and not a photograph (more than 100 mm)",
                 .f = 100, .s = 100);
    INSIDE_PAIR(.f = 100, .v = 100);
    CHECK_NEAR(r.s, INFINITY, 0, "the image in the focus");
    OUTSIDE_PAIR(
        "image distance 99.5 mm lies within the focal length 100 mm: focused beyond infinity (100 "
        "mm or more)",
        .f = 100, .v = 99.5);
    INSIDE_PAIR(.f = 100, .T = 400);
    INSIDE_PAIR(.f = 100, .T = 400 * (1 - 2e-13));
    CHECK_NEAR(r.m, 1, 0, "within the slack it is 1:1");
    INSIDE_PAIR(.f = 100, .T = 410, .hiatus = 10);
    CHECK_NEAR(r.m, 1, 0, "the hiatus on top");
    OUTSIDE_PAIR("sensor distance 409 mm is too short for the focal length 100 mm: no real image "
                 "(4 f + hiatus = 410 mm or more)",
                 .f = 100, .T = 409, .hiatus = 10);
    OUTSIDE_PAIR("sensor distance inf has no enlarged image (a finite distance)", .f = 100,
                 .T = INFINITY, .choice = CONJUGATES_ENLARGED);
    INSIDE_PAIR(.f = 100, .T = INFINITY);
    CHECK_NEAR(r.m, 0, 0, "the far one of the two");
    INSIDE_PAIR(.s = 0.25, .m = 0.25);
    CHECK_NEAR(r.f, 0.05, 1e-17, "s m/(1 + m)");
    OUTSIDE_PAIR("distance 300 mm with magnification 0 leaves the focal length open (a finite "
                 "distance and a magnification above 0)",
                 .s = 300, .m = 0);
    OUTSIDE_PAIR("distance inf mm with magnification 1 leaves the focal length open (a finite "
                 "distance and a magnification above 0)",
                 .s = INFINITY, .m = 1);
    INSIDE_PAIR(.s = 300, .T = 310.5, .hiatus = 10);
    CHECK_NEAR(r.v, 0.5, 0, "T - hiatus - s");
    OUTSIDE_PAIR("sensor distance 310 mm leaves no room for an image behind the distance 300 mm "
                 "(finite and more than 310 mm)",
                 .s = 300, .T = 310, .hiatus = 10);
    OUTSIDE_PAIR("sensor distance inf mm leaves no room for an image behind the distance 300 mm "
                 "(finite and more than 310 mm)",
                 .s = 300, .T = INFINITY, .hiatus = 10);
    INSIDE_PAIR(.v = 300, .T = 310.5, .hiatus = 10);
    CHECK_NEAR(r.s, 0.5, 0, "T - hiatus - v");
    OUTSIDE_PAIR("sensor distance 310 mm leaves no room for a subject before the image distance "
                 "300 mm (more than 310 mm)",
                 .v = 300, .T = 310, .hiatus = 10);
    INSIDE_PAIR(.m = 0.5, .T = 10.5, .hiatus = 10);
    CHECK_NEAR(r.f, 1.0 / 9, 1e-17, "D m/(1 + m)^2");
    OUTSIDE_PAIR("sensor distance 10 mm with magnification 1 leaves the focal length open "
                 "(finite and more than the hiatus 10 mm, a magnification above 0)",
                 .m = 1, .T = 10, .hiatus = 10);
    OUTSIDE_PAIR("sensor distance 20 mm with magnification 0 leaves the focal length open "
                 "(finite and more than the hiatus 10 mm, a magnification above 0)",
                 .m = 0, .T = 20, .hiatus = 10);
    OUTSIDE_PAIR("sensor distance inf mm with magnification 1 leaves the focal length open "
                 "(finite and more than the hiatus 0 mm, a magnification above 0)",
                 .m = 1, .T = INFINITY);
}

/* Each of the five quantities alone. */
static void test_quantities(void)
{
    struct conjugates r;
    OUTSIDE_PAIR("focal length 0 mm must be above 0 and finite", .f = 0, .s = 1);
    OUTSIDE_PAIR("focal length inf mm must be above 0 and finite", .f = INFINITY, .s = 1);
    OUTSIDE_PAIR("distance 0 mm must be above 0", .f = 1, .s = 0);
    INSIDE_PAIR(.f = 1, .s = INFINITY);
    OUTSIDE_PAIR("image distance 0 mm must be above 0 and finite", .f = 1, .v = 0);
    OUTSIDE_PAIR("image distance inf mm must be above 0 and finite", .f = 1, .v = INFINITY);
    INSIDE_PAIR(.f = 0.25, .m = 0);
    OUTSIDE_PAIR("magnification -0.25 must be 0 or more and finite", .f = 1, .m = -0.25);
    OUTSIDE_PAIR("magnification inf must be 0 or more and finite", .f = 1, .m = INFINITY);
    OUTSIDE_PAIR("sensor distance 0 mm must be above 0", .f = 1, .T = 0);
    OUTSIDE_PAIR("hiatus inf mm must be finite", .f = 1, .m = 1, .hiatus = INFINITY);
    MISUSED(conjugates_solve(PAIR(.f = 1), &r, &error),
            "give exactly two of focal length, distance, image distance, magnification and "
            "sensor distance");
}

static void test_conjugate_parts(void)
{
    struct conjugates_exposure x;
    double distance = 0;
    INSIDE(conjugates_exposure(0.25, 0, 0.25, &x, &error));
    CHECK_NEAR(x.stops, 0, 0, "no extension");
    INSIDE(conjugates_exposure(0.25, 0.25, 0.25, &x, &error));
    CHECK_NEAR(x.working_fnumber, 0.5, 0, "N (1 + m/P)");
    CHECK_NEAR(x.factor, 4, 0, "(1 + m/P)^2");
    CHECK_NEAR(x.stops, 2, 1e-15, "log2 of the factor");
    OUTSIDE(conjugates_exposure(0, 1, 1, &x, &error), "f-number 0 must be above 0 and finite");
    OUTSIDE(conjugates_exposure(INFINITY, 1, 1, &x, &error),
            "f-number inf must be above 0 and finite");
    OUTSIDE(conjugates_exposure(1, -0.25, 1, &x, &error),
            "magnification -0.25 must be 0 or more and finite");
    OUTSIDE(conjugates_exposure(1, INFINITY, 1, &x, &error),
            "magnification inf must be 0 or more and finite");
    OUTSIDE(conjugates_exposure(1, 1, 0, &x, &error),
            "pupil magnification 0 must be above 0 and finite");
    OUTSIDE(conjugates_exposure(1, 1, INFINITY, &x, &error),
            "pupil magnification inf must be above 0 and finite");
    INSIDE(conjugates_exposure(1e30, 1e30, 1e-30, &x, &error));
    CHECK_RELATIVE(x.factor, 1e120, 1e-14, "(1 + m/P)^2");
    OUTSIDE(conjugates_exposure(1, 1.5e30, 1, &x, &error),
            "magnification 1.5e+30 is out of range: 1e-30 to 1e+30");
    OUTSIDE(conjugates_exposure(1, 1, 5e-31, &x, &error),
            "pupil magnification 5e-31 is out of range: 1e-30 to 1e+30");
    OUTSIDE(conjugates_exposure(1e300, 0, 1, &x, &error),
            "f-number 1e+300 is out of range: 1e-30 to 1e+30");
    INSIDE(conjugates_working_distance(100.5, 100, &distance, &error));
    CHECK_NEAR(distance, 0.5, 0, "from the front");
    OUTSIDE(conjugates_working_distance(100, 100, &distance, &error),
            "subject 100 mm from the principal plane lies inside the lens, whose front is 100 mm "
            "before that plane (more than 100 mm)");
    CHECK_NEAR(conjugates_pupil_distance(100, 0.25, 0.5), 600, 0, "f (1/m + 1/P)");
}

static const struct attach_lens bare = {50, 2, 0.5, 0, 0.25, 10, 65, 77.5};

static void check_lens(const struct attach_lens *lens, const struct attach_lens *wanted,
                       const char *what)
{
    CHECK_RELATIVE(lens->f, wanted->f, 1e-15, what);
    CHECK_RELATIVE(lens->N, wanted->N, 1e-15, what);
    CHECK_RELATIVE(lens->P, wanted->P, 1e-15, what);
    CHECK_RELATIVE(lens->m_far, wanted->m_far, 1e-15, what);
    CHECK_RELATIVE(lens->m_near, wanted->m_near, 1e-15, what);
    CHECK_RELATIVE(lens->front, wanted->front, 1e-15, what);
    CHECK_RELATIVE(lens->length_far, wanted->length_far, 1e-15, what);
    CHECK_RELATIVE(lens->length_near, wanted->length_near, 1e-15, what);
}

/* Fractions by hand: two thin systems d apart, f/f' = 1 + (f - d)/F. */
static void test_attached(void)
{
    struct attach_lens lens;
    const struct attach_step tube = {ATTACH_TUBE, 25, 0, 0}, doubler = {ATTACH_CONVERTER, 2, 12, 0},
                             close = {ATTACH_CLOSE_UP, 4, 5, 0},
                             stacked = {ATTACH_STACKED, 100, 5, 4};
    CHECK(attach_bare(&(struct attach_bare){50, 2, 0.5, 0.25, 10, 5}, &lens, &error));
    check_lens(&lens, &bare, "bare");
    CHECK(attach_apply(&lens, &tube, 1, &error));
    check_lens(&lens, &(struct attach_lens){50, 2, 0.5, 0.5, 0.75, 10, 90, 102.5}, "tube");
    CHECK(attach_apply(&lens, &doubler, 1, &error));
    check_lens(&lens, &(struct attach_lens){100, 4, 1, 1, 1.5, 60, 102, 114.5}, "converter");
    lens = bare;
    CHECK(attach_apply(&lens, (struct attach_step[]){tube, close}, 2, &error));
    check_lens(
        &lens,
        &(struct attach_lens){50 / 1.14, 1.48 / 1.14, 0.37, 0.77, 1.055, 15 / 1.14, 95, 107.5},
        "close-up");
    lens = bare;
    CHECK(attach_apply(&lens, &stacked, 1, &error));
    check_lens(
        &lens,
        &(struct attach_lens){50 / 1.35, 0.7 / 1.35, 0.175, 0.5, 0.8375, 15 / 1.35, 70, 82.5},
        "stacked");
    lens = bare;
    CHECK(attach_apply(&lens, &(struct attach_step){ATTACH_REVERSED, 75, 5, 7}, 1, &error));
    check_lens(&lens, &(struct attach_lens){50, 4, 2, 0.5, 0.5, 7, 87, 87}, "reversed");
}

static bool apply(enum attach_kind kind, double value, double gap, double extra)
{
    struct attach_lens lens = bare;
    return attach_apply(&lens, &(struct attach_step){kind, value, gap, extra}, 1, &error);
}

static void test_attach_ranges(void)
{
    struct attach_lens lens;
    INSIDE(attach_bare(&(struct attach_bare){0.25, 0.25, 0.25, 0, -1, -1}, &lens, &error));
    OUTSIDE(attach_bare(&(struct attach_bare){0, 1, 1, 0, 0, 0}, &lens, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(attach_bare(&(struct attach_bare){1, 0, 1, 0, 0, 0}, &lens, &error),
            "f-number 0 must be above 0 and finite");
    OUTSIDE(attach_bare(&(struct attach_bare){1, 1, 0, 0, 0, 0}, &lens, &error),
            "pupil magnification 0 must be above 0 and finite");
    OUTSIDE(attach_bare(&(struct attach_bare){1, 1, 1, -0.25, 0, 0}, &lens, &error),
            "magnification -0.25 must be 0 or more and finite");
    OUTSIDE(attach_bare(&(struct attach_bare){1, 1, 1, 0, INFINITY, 0}, &lens, &error),
            "front principal plane inf mm and hiatus 0 mm must be finite");
    OUTSIDE(attach_bare(&(struct attach_bare){1, 1, 1, 0, 0, INFINITY}, &lens, &error),
            "front principal plane 0 mm and hiatus inf mm must be finite");
    INSIDE(apply(ATTACH_TUBE, 0, 0, 0));
    OUTSIDE(apply(ATTACH_TUBE, -0.25, 0, 0), "tube -0.25 mm must be 0 or more and finite");
    INSIDE(apply(ATTACH_CLOSE_UP, 0.25, 0, 0));
    OUTSIDE(apply(ATTACH_CLOSE_UP, 0, 0, 0), "close-up lens 0 dioptres must be above 0 and finite");
    OUTSIDE(apply(ATTACH_CLOSE_UP, 1, -0.25, 0), "gap -0.25 mm must be 0 or more and finite");
    INSIDE(apply(ATTACH_CLOSE_UP, 4, 189.5, 0));
    OUTSIDE(apply(ATTACH_CLOSE_UP, 4, 190, 0),
            "gap 190 mm brings the focus of the front lens (250 mm) before the pupil: no image "
            "(less than 190 mm)");
    INSIDE(apply(ATTACH_CONVERTER, 0.25, 0, 0));
    OUTSIDE(apply(ATTACH_CONVERTER, 0, 0, 0), "converter factor 0 must be above 0 and finite");
    OUTSIDE(apply(ATTACH_CONVERTER, 2, -0.25, 0),
            "length of the converter -0.25 mm must be 0 or more and finite");
    INSIDE(apply(ATTACH_REVERSED, 50, 0, 0));
    OUTSIDE(apply(ATTACH_REVERSED, 49.5, 0, 0),
            "a sensor 49.5 mm behind the reversed lens lies within its focal length: no real image "
            "(50 mm or more)");
    INSIDE(apply(ATTACH_STACKED, 100, 0, 0));
    OUTSIDE(apply(ATTACH_STACKED, 0, 0, 0), "stacked lens 0 mm must be above 0 and finite");
    OUTSIDE(apply(ATTACH_STACKED, 50, 0, -0.25),
            "f-number of the stacked lens -0.25 must be 0 or more and finite");
    lens = bare;
    MISUSED(attach_apply(
                &lens, (struct attach_step[]){{ATTACH_TUBE, 1, 0, 0}, {ATTACH_REVERSED, 60, 0, 0}},
                2, &error),
            "reversing must come first: reverse the lens, then attach to it");
}

static void test_attach_answers(void)
{
    struct attach_lens lens = {50, 2, 0.5, 1, 0.5, 99.5, 300, 400};
    struct attach_focus focus;
    INSIDE(attach_focused(&lens, false, &focus, &error));
    CHECK_NEAR(focus.working_distance, 0.5, 0, "f (1 + 1/m) - front");
    CHECK_NEAR(focus.sensor_distance, 300.5, 0, "and the length");
    CHECK_NEAR(focus.working_fnumber, 6, 0, "N (1 + m/P)");
    INSIDE(attach_focused(&lens, true, &focus, &error));
    CHECK_NEAR(focus.sensor_distance, 450.5, 0, "the other end");
    lens.front = 100;
    CHECK(!attach_focused(&lens, false, &focus, &error));
    lens.front = 102;
    OUTSIDE(attach_focused(&lens, false, &focus, &error),
            "at magnification 1 the subject would lie 2 mm inside the lens (less magnification)");
}

/* m/P = 3, so that each formula shows whether it has the bellows factor 4. */
static void test_diffraction(void)
{
    const struct diffraction_setting good = {
        .N = 0.5, .wavelength = 0.5, .m = 0.75, .P = 0.25, .blur = 0.25, .pitch = 0.25};
    struct diffraction_setting bad = good;
    struct diffraction d;
    struct diffraction_mtf mtf;
    double x = 0;
    INSIDE(diffraction_compute(&good, &d, &error));
    CHECK_RELATIVE(d.cutoff, 1000.0, 1e-15, "1/(lambda N (1 + m/P))");
    CHECK_RELATIVE(d.airy_radius, 1.21966989126650445e-3, 1e-15, "j1 zero/pi in that unit");
    CHECK_RELATIVE(d.sparrow, 0.947155252709185545e-3, 1e-15, "Sparrow, in that unit");
    CHECK_NEAR(d.nyquist, 2, 0, "1/(2 p)");
    bad.blur = bad.pitch = bad.m = 0;
    INSIDE(diffraction_compute(&bad, &d, &error));
    CHECK_RELATIVE(d.working_fnumber, 0.5, 0, "no extension");
    static const struct {
        size_t at;
        double value;
        const char *message;
    } rows[] = {
        {offsetof(struct diffraction_setting, N), 0, "f-number 0 must be above 0 and finite"},
        {offsetof(struct diffraction_setting, wavelength), 0,
         "wavelength 0 um must be above 0 and finite"},
        {offsetof(struct diffraction_setting, m), -0.25,
         "magnification -0.25 must be 0 or more and finite"},
        {offsetof(struct diffraction_setting, P), 0,
         "pupil magnification 0 must be above 0 and finite"},
        {offsetof(struct diffraction_setting, blur), -0.25,
         "blur by defocus -0.25 mm must be 0 or more and finite"},
        {offsetof(struct diffraction_setting, pitch), INFINITY,
         "pixel pitch inf mm must be 0 or more and finite"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        bad = good;
        memcpy((char *)&bad + rows[i].at, &rows[i].value, sizeof(double));
        OUTSIDE(diffraction_compute(&bad, &d, &error), rows[i].message);
        OUTSIDE(diffraction_mtf_at(&bad, 1, &mtf, &error), rows[i].message);
        OUTSIDE(diffraction_frequency(&bad, 0.5, &x, &error), rows[i].message);
    }
    INSIDE(diffraction_mtf_at(&good, 0, &mtf, &error));
    CHECK_NEAR(mtf.total, 1, 0, "nothing is lost at frequency 0");
    INSIDE(diffraction_mtf_at(&good, 1000, &mtf, &error));
    CHECK_NEAR(mtf.lens, 0, 0, "at the cut-off");
    OUTSIDE(diffraction_mtf_at(&good, -0.25, &mtf, &error),
            "spatial frequency -0.25 per mm must be 0 or more and finite");
    OUTSIDE(diffraction_frequency(&good, 0, &x, &error),
            "contrast 0 is out of range (above 0, below 1)");
    OUTSIDE(diffraction_frequency(&good, 1, &x, &error),
            "contrast 1 is out of range (above 0, below 1)");
    /* no blur, no pixel: 2/pi (acos x - x sqrt(1 - x^2)) = 1/2, with 40 digits */
    bad = good;
    bad.blur = bad.pitch = 0;
    INSIDE(diffraction_frequency(&bad, 0.5, &x, &error));
    CHECK_RELATIVE(x, 403.972753299517209, 1e-14, "half contrast of a perfect lens");
}

static void test_diffraction_answers(void)
{
    struct diffraction_optimum best;
    struct diffraction_angles angles;
    double x = 0;
    INSIDE(diffraction_fnumber(0.5, 0.5, 0.75, 0.25, &x, &error));
    CHECK_RELATIVE(x, 102.486747352761228, 1e-15, "d/(2 1.22 lambda (1 + m/P))");
    OUTSIDE(diffraction_fnumber(0, 1, 0, 1, &x, &error),
            "diameter on the sensor 0 mm must be above 0 and finite");
    INSIDE(diffraction_optimum(0.5, 0.5, 0.75, 0.25, &best, &error));
    CHECK_RELATIVE(best.working_fnumber, 14.3168954283225264, 1e-15,
                   "sqrt(spread/(4 1.22 lambda))");
    CHECK_RELATIVE(best.fnumber, 3.57922385708063159, 1e-15, "and 1 + m/P = 4");
    CHECK_RELATIVE(best.blur, hypot(best.airy_diameter, best.defocus), 1e-15, "both together");
    CHECK_RELATIVE(best.airy_diameter, best.defocus, 1e-14, "equal at the optimum");
    OUTSIDE(diffraction_optimum(0, 1, 0, 1, &best, &error),
            "focus spread 0 mm must be above 0 and finite");
    INSIDE(diffraction_focus_spread(0.25, 0.5, 0.5, &x, &error));
    CHECK_NEAR(x, 0, 0, "no depth, no spread");
    INSIDE(diffraction_focus_spread(0.25, 0.5, INFINITY, &x, &error));
    CHECK_NEAR(x, 0.25, 0, "f^2/(near - f)");
    INSIDE(diffraction_focus_spread(0.25, 0.5, 0.75, &x, &error));
    CHECK_NEAR(x, 0.125, 0, "f^2/(near - f) (far - near)/(far - f)");
    OUTSIDE(diffraction_focus_spread(0, 1, 2, &x, &error),
            "focal length 0 mm must be above 0 and finite");
    OUTSIDE(
        diffraction_focus_spread(50, 50, 100, &x, &error),
        "nearest point 50 mm lies within the focal length 50 mm: no real image (more than 50 mm, "
        "finite)");
    OUTSIDE(diffraction_focus_spread(50, 100, 99.5, &x, &error),
            "farthest point 99.5 mm lies before the nearest point 100 mm (100 mm or more)");
    INSIDE(diffraction_resolve(0.5, 0.5, &angles, &error));
    CHECK_RELATIVE(angles.rayleigh, 1.21966989126650445e-3, 1e-15, "1.22 lambda/D");
    CHECK_RELATIVE(angles.sparrow, 0.947155252709185545e-3, 1e-15, "Sparrow");
    CHECK_RELATIVE(angles.dawes, 1.12476774017412351e-3, 1e-15, "116 arc seconds/D in mm");
    OUTSIDE(diffraction_resolve(0, 1, &angles, &error),
            "entrance pupil 0 mm must be above 0 and finite");
    OUTSIDE(diffraction_resolve(1, 0, &angles, &error),
            "wavelength 0 um must be above 0 and finite");
}

static void test_distance_from(void)
{
    struct dof_setting a = {.f = 50, .N = 4, .c = 0.03, .s = 100, .P = 0.5};
    struct distance_reference from = {FROM_PRINCIPAL, 7, 9};
    const struct dof_targets none = {NAN, NAN, NAN, NAN, NAN};
    double s = 0;
    CHECK_NEAR(distance_offset(&a, &from), 0, 0, "from the principal plane itself");
    from.from = FROM_SENSOR;
    CHECK_NEAR(distance_offset(&a, &from), 107, 0, "v + hiatus");
    INSIDE(distance_to_principal(50, 0.5, 207, &from, &s, &error));
    CHECK_NEAR(s, 100, 0, "1:1");
    OUTSIDE(distance_to_principal(50, 0.5, 206, &from, &s, &error),
            "distance 206 mm from the sensor is less than 4 times the focal length 50 mm and what "
            "lies between the principal planes: no real image (207 mm or more)");
    from.hiatus = 0;
    OUTSIDE(distance_to_principal(50, 0.5, 199, &from, &s, &error),
            "distance 199 mm from the sensor is less than 4 times the focal length 50 mm: no real "
            "image (200 mm or more)");
    from.from = FROM_ENTRANCE;
    CHECK_NEAR(distance_offset(&a, &from), 50, 0, "-f (1 - 1/P)");
    INSIDE(distance_to_principal(50, 0.5, 150, &from, &s, &error));
    CHECK_NEAR(s, 100, 0, "the way back");
    from.from = FROM_FRONT;
    CHECK_NEAR(distance_offset(&a, &from), -9, 0, "less the front");
    INSIDE(distance_to_principal(50, 0.5, 91, &from, &s, &error));
    CHECK_NEAR(s, 100, 0, "the way back");
    from.front = NAN;
    MISUSED(distance_to_principal(50, 0.5, 91, &from, &s, &error),
            "distance origin front needs lens: a thin lens has no front");
    /* all given, two infinite: nothing to solve, whatever the rest of the command says of them */
    from.from = FROM_PRINCIPAL;
    a = (struct dof_setting){.f = INFINITY, .N = INFINITY, .c = INFINITY, .s = INFINITY, .P = 1};
    INSIDE(distance_solve(&a, &none, &from, &error));
}

int main(void)
{
    test_conjugates();
    test_quantities();
    test_conjugate_parts();
    test_attached();
    test_attach_ranges();
    test_attach_answers();
    test_diffraction();
    test_diffraction_answers();
    test_distance_from();
    return check_report();
}
