/* tests/unit/test_coddington.c - foci of narrow beams against 50 digits and closed forms. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/coddington.h"

#include "base/constants.h"
#include "check.h"
#include "file/lens_file.h"
#include "trace/aim/aim.h"

static const double degree = RADIANS_PER_DEGREE;

/* What is compared, and what came out. */
struct tried {
    const char *text;
    double field[2]; /* deg, or mm of a near object */
    struct narrow_beam narrow;
    bool found;
};

static void try(struct tried *tried)
{
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    struct first_order first;
    struct system system;
    struct beam beam;
    struct aim aim;
    struct system_options options = system_options_default();
    bool read = lens_read("test", text_of(tried->text), NULL, &arena, &lens, &error);
    CHECK(read);
    tried->found = false;
    if (!read) {
        printf("%s\n", error.message);
        arena_free(&arena);
        return;
    }
    const struct conjugate_object object = lens_object(&lens);
    const double unit = object.is_infinite ? degree : 1;
    const struct field_point field = {object.is_infinite ? FIELD_ANGLE : FIELD_HEIGHT,
                                      {tried->field[0] * unit, tried->field[1] * unit}};
    const double wavelength = lens_primary_wavelength(&lens);
    bool ready = first_order_of_lens(&lens, wavelength, SECTION_Y, &arena, &first, &error) &&
                 system_compile(&lens, wavelength, &options, &arena, &system, &error) &&
                 beam_of_field(&field, &object, &first, &beam, &error);
    CHECK(ready);
    if (!ready || !aim_open(&system, &beam, &arena, &aim, &error)) {
        printf("%s\n", error.message);
        CHECK(false);
        arena_free(&arena);
        return;
    }
    tried->found = coddington_foci(&system, &beam, aim.chief, &arena, &tried->narrow);
    arena_free(&arena);
}

/* -------- an independent program's Coddington trace along the chief ray, 50 digits -------- */

static const struct {
    const char *text;
    double field, tangential, sagittal, tolerance; /* mm, from the last vertex */
} known[] = {
    {"lens Smith's double Gauss\nwavelength d\nobject inf\naperture stop\n"
     "surface 58.95 7.52 1.67/47.1 50.4\nsurface 169.66 0.24 air 50.4\n"
     "surface 38.55 8.05 1.67/47.1 46\nsurface 81.54 6.55 1.699/30.1 46\n"
     "surface 25.5 11.41 air 36\nstop - 9 air 34.2\nsurface -28.99 2.36 1.603/38 34\n"
     "surface 81.54 12.13 1.658/57.3 40\nsurface -40.77 0.38 air 40\n"
     "surface 874.13 6.44 1.717/48 40\nsurface -79.46 72.228 air 40\n",
     14, 72.10816205277326124388, 71.9847937174828894134, 4e-13},
    {"lens retrofocus\nwavelength d\nobject inf\naperture stop\nsurface 60 2.5 1.62041/60.3 -\n"
     "surface 18 14 air -\nsurface 80 2 1.62041/60.3 -\nsurface 14 12 air -\n"
     "surface 30 6 1.7552/27.6 -\nsurface -80 5 air -\nstop inf 2 air 2.4\n"
     "surface -60 1.5 1.80518/25.4 -\nsurface 18 5 1.62041/60.3 -\nsurface -16 0.3 air -\n"
     "surface 40 4 1.62041/60.3 -\nsurface -30 0 air -\n",
     70, 16.5336681389732954212, 16.50513387420804719838, 4e-13},
    {"lens two mirrors\nwavelength d\nobject inf\naperture epd 200\n"
     "surface -1000 -375 mirror - k=-1 stop\nsurface -300 0 mirror - k=-2.5\n",
     /* the second mirror enlarges 5 times, depths 25 times */
     0.2, 749.494664731663242028, 749.6610043082483127491, 1.5e-11},
    {"lens aspheres\nwavelength d\nobject inf\naperture epd 5\n"
     "surface 8.2 4 1.490595410934237409388709 - k=0.3 A4=-2e-4 A6=1.5e-6 stop\n"
     "surface -9.6 0 air - k=-4 A4=3.3e-4 A6=-4e-6 A8=1e-8\n",
     12, 7.826113607848276898864, 7.954130601637638676359, 1e-13},
    {"lens in water\nwavelength d\nobject inf\naperture epd 5\nsurface inf 1 air - stop\n"
     "surface 25 20 1.65/45 -\nsurface 18 0 1.333 -\n",
     8, 64.0194717064759334683, 64.65457886046493763055, 4e-13},
    {"lens relay\nwavelength d\nobject 97\naperture stop\n"
     "surface 129.94 2.5 1.672707035174367281428041 -\n"
     "surface 44.64 6 1.516800034500588463426176 -\nsurface -61.47 20 air -\n"
     "stop inf 20 air 16\nsurface 61.47 6 1.516800034500588463426176 -\n"
     "surface -44.64 2.5 1.672707035174367281428041 -\nsurface -129.94 0 air -\n",
     6, 93.71521549129192218458, 94.34915535445905332286, 4e-13},
};

static void test_known(void)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        struct tried tried = {.text = known[i].text, .field = {0, known[i].field}};
        try(&tried);
        CHECK(tried.found);
        CHECK_NEAR(tried.narrow.tangential_z, known[i].tangential, known[i].tolerance,
                   "tangential");
        CHECK_NEAR(tried.narrow.sagittal_z, known[i].sagittal, known[i].tolerance, "sagittal");
        CHECK(tried.narrow.turn == 0);
    }
}

/* -------- closed forms -------- */

/* A spherical mirror with the stop on it: R cos(i)/2 and R/(2 cos i) along the ray. */
static void test_mirror(void)
{
    static const double angles[] = {0, 1, 10, 35, 60};
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        struct tried tried = {.text = "lens mirror\nwavelength d\nobject inf\naperture stop\n"
                                      "surface -200 -100 mirror 10 stop\n",
                              .field = {0, angles[i]}};
        const double cosine = cos(angles[i] * degree);
        try(&tried);
        CHECK_NEAR(tried.narrow.tangential, 100 * cosine, 1e-13, "tangential, along the ray");
        CHECK_NEAR(tried.narrow.sagittal, 100 / cosine, 2e-13, "sagittal, along the ray");
        CHECK_NEAR(tried.narrow.tangential_z, -100 * cosine * cosine, 1e-13, "tangential");
        CHECK_NEAR(tried.narrow.sagittal_z, -100, 1e-13, "sagittal: through the centre");
    }
}

/* Parallel light stays parallel through plates; a point is imaged by astigmatic shifts. */
static void test_plate(void)
{
    struct tried far = {.text = "lens plate\nwavelength d\nobject inf\naperture stop\n"
                                "stop - 0 air 4\nsurface - 10 1.5 -\nsurface - 0 air -\n",
                        .field = {0, 30}};
    try(&far);
    CHECK(far.found && isinf(far.narrow.tangential) && isinf(far.narrow.sagittal));
    CHECK(isinf(far.narrow.tangential_z) && isinf(far.narrow.sagittal_z));
    /* of a point 100 away, 40 off: the shift is t (1 - cos/(n cos')) and with (cos/cos')^3 */
    struct tried near = {.text = "lens plate\nwavelength d\nobject 100\naperture stop\n"
                                 "stop - 0 air 4\nsurface - 10 1.5 -\nsurface - 0 air -\n",
                         .field = {0, -40}};
    try(&near);
    const double u = atan(0.4), v = asin(sin(u) / 1.5), ratio = cos(u) / cos(v);
    CHECK_NEAR(near.narrow.sagittal_z, -100 - 10 * ratio / 1.5, 3e-13, "sagittal of a plate");
    CHECK_NEAR(near.narrow.tangential_z, -100 - 10 * ratio * ratio * ratio / 1.5, 3e-13,
               "tangential of a plate");
}

/* An ideal thick lens has its foci in one plane, however its image is distorted. */
static void test_thick(void)
{
    static const double fields[][2] = {{0, 0}, {0, 20}, {15, 25}};
    static const char *const texts[] = {
        "lens thick\nwavelength d\nobject inf\naperture stop\nstop - 5 air 4\n"
        "thick 50 0 air - hiatus=3\n",
        "lens thick\nwavelength d\nobject inf\naperture stop\nstop - 5 air 4\n"
        "thick 50 0 air - hiatus=3 distortion=-0.2,0.1,0.05\n",
    };
    for (size_t i = 0; i < 6; i++) {
        struct tried tried = {.text = texts[i / 3], .field = {fields[i % 3][0], fields[i % 3][1]}};
        try(&tried);
        /* from the frame of H, whose hiatus the foci lie behind */
        CHECK_NEAR(tried.narrow.tangential_z, 53, 2e-13, "tangential of a thick lens");
        CHECK_NEAR(tried.narrow.sagittal_z, 53, 2e-13, "sagittal of a thick lens");
    }
    /* with a plate behind it; the slope there is u - h/f with h = 5 u */
    struct tried tried = {.text = "lens thick\nwavelength d\nobject inf\naperture stop\n"
                                  "stop - 5 air 4\nthick 50 10 air - hiatus=3\n"
                                  "surface - 10 1.5 -\nsurface - 0 air -\n",
                          .field = {0, 40}};
    const double u = atan(0.9 * tan(40 * degree)), v = asin(sin(u) / 1.5);
    const double ratio = cos(u) / cos(v);
    try(&tried);
    CHECK_NEAR(tried.narrow.sagittal_z, 40 - 10 * ratio / 1.5, 2e-13, "sagittal, with a plate");
    CHECK_NEAR(tried.narrow.tangential_z, 40 - 10 * ratio * ratio * ratio / 1.5, 2e-13,
               "tangential, with a plate");
}

/* -------- fields beside both axes -------- */

/* A round lens is as round beside the axes; the angle from the axis is the same. */
static void test_beside(void)
{
    const double tangent = tan(14 * degree);
    for (int i = 0; i < 4; i++) {
        const double turn = (17 + 90.0 * i) * degree;
        struct tried tried = {
            .text = known[0].text,
            .field = {atan(tangent * sin(turn)) / degree, atan(tangent * cos(turn)) / degree}};
        try(&tried);
        CHECK_NEAR(tried.narrow.tangential_z, known[0].tangential, 1e-12, "tangential beside");
        CHECK_NEAR(tried.narrow.sagittal_z, known[0].sagittal, 1e-12, "sagittal beside");
        CHECK_NEAR(tried.narrow.turn, 0, 1e-11, "no turn");
    }
}

/* A skew chief ray through a cylinder: differences of 60 digits in an independent program. */
static void test_skew(void)
{
    struct tried tried = {.text = "lens cylinder\nwavelength d\nobject inf\naperture stop\n"
                                  "stop - 6 air 4\nsurface 40 5 1.6 - cyl=y\nsurface - 3 air -\n"
                                  "surface 60 4 1.5 -\nsurface - 0 air -\n",
                          .field = {7, 11}};
    try(&tried);
    CHECK_NEAR(tried.narrow.tangential, 35.529794180880495977, 2e-13, "tangential, along the ray");
    CHECK_NEAR(tried.narrow.sagittal, 112.96750970742072142, 1e-12, "sagittal, along the ray");
    CHECK_NEAR(tried.narrow.tangential_z, 34.908337669305220566, 2e-13, "tangential");
    CHECK_NEAR(tried.narrow.sagittal_z, 110.99157947414347522, 1e-12, "sagittal");
    CHECK_NEAR(tried.narrow.turn, -0.594573824863301898, 1e-14, "turn");
}

/* One section of a cylinder stays parallel, whichever way it lies: 1/f = 0.6/40. */
static void test_cylinder(void)
{
    struct tried tried = {.text = "lens cylinder\nwavelength d\nobject inf\naperture stop\n"
                                  "stop - 6 air 4\nsurface 40 0 1.6 - cyl=y\nsurface - 0 air -\n"};
    try(&tried);
    CHECK_NEAR(tried.narrow.tangential_z, 40 / 0.6, 1e-13, "tangential");
    CHECK(isinf(tried.narrow.sagittal_z));
    tried.text = "lens cylinder\nwavelength d\nobject inf\naperture stop\n"
                 "stop - 6 air 4\nbend decenter=0,0 tilt=0,0,45\nsurface 40 0 1.6 - cyl=y\n"
                 "surface - 0 air -\nbend decenter=0,0 tilt=0,0,-20\nsurface - 0 air -\n";
    try(&tried);
    CHECK(fabs(fabs(tried.narrow.turn) - 20 * degree) < 1e-14);
    CHECK_NEAR(tried.narrow.tangential_z, 40 / 0.6, 2e-13, "tangential, turned");
    CHECK(fabs(tried.narrow.sagittal_z) > 1e14);
}

static void test_lost(void)
{
    /* 70 degrees within glass are totally reflected at the plane behind it */
    struct tried tried = {.text = "lens prism\nwavelength d\nobject inf\naperture stop\n"
                                  "medium 1.5\nstop - 1 1.5 4\nsurface - 0 air -\n",
                          .field = {0, 70}};
    try(&tried);
    CHECK(!tried.found && tried.narrow.chief.status == RAY_TOTAL_REFLECTION &&
          tried.narrow.chief.surface == 2);
}

int main(void)
{
    test_known();
    test_mirror();
    test_plate();
    test_thick();
    test_beside();
    test_skew();
    test_cylinder();
    test_lost();
    return check_report();
}
