/* tests/unit/test_zemax.c - .zmx files: what they say, and what is lost. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "exchange/lens_formats.h"
#include "exchange/zemax/zemax.h"
#include "file/lens_change.h"
#include "optics/aperture.h"
#include "optics/first_order.h"

#include <stdlib.h>

#define HEAD     "MODE SEQ\nUNIT MM X W X CM MR CPMM\n"
#define OBJECT   "SURF 0\n  TYPE STANDARD\n  CURV 0\n  DISZ INFINITY\n"
#define IMAGE(n) "SURF " n "\n  TYPE STANDARD\n  CURV 0\n  DISZ 0\n"
#define ROW(row) "  UDAD " row "\n"
#define SINGLET                                                                                    \
    OBJECT "SURF 1\n  STOP\n  TYPE STANDARD\n  CURV 0.02\n  DISZ 4\n"                              \
           "  GLAS ___BLANK 1 0 1.5 0\n  DIAM 10 1 0 0 1 \"\"\n"                                   \
           "SURF 2\n  TYPE STANDARD\n  CURV -0.02\n  DISZ 50\n" IMAGE("3")

/* A file in memory, read with or without losses. */
struct reading {
    struct arena arena;
    struct lens lens;
    struct foreign_job job;
    struct error error;
    bool done;
};

static struct reading *read_text(const char *text, bool lossy)
{
    struct reading *reading = calloc(1, sizeof *reading);
    reading->job =
        (struct foreign_job){.source = "test.zmx", .arena = &reading->arena, .lossy = lossy};
    reading->done = foreign_read(&reading->job, text_of(text), &reading->lens, &reading->error);
    return reading;
}

static void forget(struct reading *reading)
{
    arena_free(&reading->arena);
    free(reading);
}

/* Each with the line, the column and a part of the message. */
static void check_errors(void)
{
    static const struct {
        const char *text;
        long line;
        int column;
        const char *message;
    } cases[] = {
        {"MODE NSC\nSURF 0\n", 1, 6, "non-sequential"},
        {HEAD OBJECT IMAGE("1"), 0, 0, "no surface between"},
        {HEAD "SURF 0\nSURF 0\n", 4, 1, "SURF 1 is expected"},
        {HEAD "WXYZ 1\n" SINGLET, 3, 1, "unknown word 'WXYZ'"},
        {HEAD "ENPD x\n" SINGLET, 3, 6, "needs a number"},
        {HEAD "ENPD 0\n" SINGLET, 3, 6, "above 0"},
        {HEAD "WAVM 1 550000 1\n" SINGLET, 3, 8, "0.001 to 100000 um"},
        {HEAD "WAVM 2 0.55 1\n" SINGLET, 0, 0, "wavelength 1 is missing"},
        {HEAD "VCYN 0 0.1\n" SINGLET, 3, 8, "vignetting factors of the fields"},
        {HEAD "ENVD 40 -1 1\n" SINGLET, 3, 1, "a pressure of 0 or more"},
        {HEAD "XFLN 0 2\nYFLN 5 90\n" SINGLET, 4, 8, "both are below 90 degrees"},
        {HEAD "XFLN 0 200\n" SINGLET, 3, 8, "not beyond 180 degrees"},
        {HEAD "YFLN 0 5\nFWGN 1 -1\n" SINGLET, 4, 8, "a weight is not below 0"},
        {HEAD OBJECT "SURF 1\n  TYPE NONSEQCO\n" IMAGE("2"), 8, 8, "non-sequential group"},
        {HEAD OBJECT "SURF 1\n  TYPE BINARY_2\n  PARM 1 50\n" IMAGE("2"), 8, 8, "type BINARY_2"},
        {HEAD OBJECT "SURF 1\n  UDAD 0 \"slit.uda\" 1\n" IMAGE("2"), 8, 3,
         "the aperture of the file 'slit.uda' (files beside it are not read)"},
        {HEAD OBJECT "SURF 1\n  UDAD 0 x.uda 1\n" ROW("1 -1 -1 0") ROW("2 1 -1 90") IMAGE("2"), 8,
         3, "a user-defined aperture (row 2 is not x, y and 0)"},
        {HEAD OBJECT "SURF 1\n  UDAD 0 x.uda 1\n" ROW("1 LIN 1 1 0") IMAGE("2"), 8, 3,
         "(row 1 is not x, y and 0)"},
        {HEAD OBJECT "SURF 1\n  UDAD 0 x.uda 1\n" ROW("1 -1 -1 0") ROW("3 1 -1 0") IMAGE("2"), 8, 3,
         "(row 2 of it is missing)"},
        {HEAD OBJECT "SURF 1\n  UDAD 0 x.uda 2\n" ROW("1 -1 -1 0") IMAGE("2"), 8, 3,
         "numbers beside its name"},
        {HEAD OBJECT "SURF 1\n" ROW("1 0 0 0") IMAGE("2"), 8, 3, "(it has no shape)"},
        {HEAD "FTYP 0 0 13 1\nYFLN 0 1 2 3 4 5 6 7 8 9 10 11\n" SINGLET, 3, 1,
         "FTYP counts 13 fields, XFLN and YFLN have 12"},
        {HEAD "FENF 1 0\n" SINGLET, 3, 6, "FENF: fields beyond the twelfth"},
        {HEAD "FEFD 1 0 5\n" SINGLET, 3, 6, "FEFD: fields beyond the twelfth"},
        {HEAD OBJECT "SURF 1\n  FLAP 1 2 0\n" IMAGE("2"), 8, 3, "a hole"},
        {HEAD OBJECT "SURF 1\n  DISZ INFINITY\n" IMAGE("2"), 8, 8, "infinite distance"},
        {HEAD OBJECT "SURF 1\n  STOP\nSURF 2\n  STOP\n" IMAGE("3"), 9, 1, "second stop"},
        {HEAD OBJECT "SURF 1\n  TYPE TOROIDAL\n  CURV 0.1\n  PARM 1 30\n" IMAGE("2"), 8, 3,
         "a toroid"},
        {HEAD "FLOA\n" OBJECT "SURF 1\n  DISZ 1\n" IMAGE("2"), 3, 1, "which has no diameter"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct reading *reading = read_text(cases[i].text, false);
        const struct error *error = &reading->error;
        CHECK(!reading->done && error->code == ERROR_DATA);
        bool same = strstr(error->message, cases[i].message) != NULL &&
                    error->line == cases[i].line && error->column == cases[i].column;
        if (!same) {
            printf("%s -> %ld:%d: %s\n", cases[i].text, error->line, error->column, error->message);
        }
        CHECK(same);
        forget(reading);
    }
}

/*
 * A slit and a triangle that block, the file that UDAD 0 names row by row: in inches, shifted, with
 * and without the zeros behind the last one.
 */
static void check_inline_polygons(void)
{
    struct reading *reading =
        read_text("MODE SEQ\nUNIT IN\n" OBJECT
                  "SURF 1\n  USOB 0 0 0\n  OBDC 1 0\n  UDAD 0 slit.uda 1.0\n" ROW("1 -2 -1 0")
                      ROW("2 2 -1 0") ROW("3 2 1 0") ROW("4 -2 1 0") ROW("5 0 0 0") ROW("6 0 3 0")
                          ROW("7 1 3 0") ROW("8 0 4 0") IMAGE("2"),
                  false);
    const struct surface *surface = &reading->lens.surfaces[0];
    CHECK(reading->done && surface->aperture_count == 2);
    if (reading->done && surface->aperture_count == 2) {
        const struct aperture *slit = &surface->apertures[0], *triangle = &surface->apertures[1];
        CHECK(slit->shape == SHAPE_POLYGON && slit->blocks && slit->point_count == 4);
        CHECK(slit->points[2][0].value.hi == 2 * 25.4 && slit->points[3][1].value.hi == 25.4);
        CHECK(slit->decenter[0].value.hi == 25.4 && slit->decenter[1].value.hi == 0);
        CHECK(triangle->blocks && triangle->point_count == 3);
        CHECK(triangle->points[2][1].value.hi == 4 * 25.4);
    }
    forget(reading);
}

/* Light passes any of three slits, two of them apart in x, the third below: one polygon is all. */
static void check_slits(void)
{
    struct reading *reading = read_text(
        HEAD OBJECT "SURF 1\n" ROW("1 -3 -1 0") ROW("2 -1 -1 0") ROW("3 -1 1 0") ROW("4 -3 1 0")
            ROW("5 0 0 0") ROW("6 1 -1 0") ROW("7 1 1 0") ROW("8 3 1 0") ROW("9 3 -1 0")
                ROW("10 0 0 0") ROW("11 -2 -4 0") ROW("12 2 -4 0") ROW("13 0 -2 0") IMAGE("2"),
        false);
    const struct surface *surface = &reading->lens.surfaces[0];
    CHECK(reading->done && surface->aperture_count == 1 && !surface->apertures[0].blocks);
    if (reading->done && surface->aperture_count == 1) {
        const struct aperture_form form = aperture_form_of(&surface->apertures[0], &reading->arena);
        CHECK(aperture_passes(&form, -2, 0) && aperture_passes(&form, 2, 0));
        CHECK(aperture_passes(&form, 2, 0.99) && aperture_passes(&form, 0, -3));
        for (double t = 0.01; t < 1; t += 0.01) { /* between the slits, along what joins them */
            CHECK(!aperture_passes(&form, -1 + 2 * t, -1) &&
                  !aperture_passes(&form, -1 + 2 * t, 1));
            CHECK(!aperture_passes(&form, 0, -2 + 3 * t) && !aperture_passes(&form, -3, -1 - t));
        }
    }
    forget(reading);
    reading =
        read_text(HEAD OBJECT "SURF 1\n" ROW("1 -3 -1 0") ROW("2 1 -1 0") ROW("3 1 1 0")
                      ROW("4 0 0 0") ROW("5 0 -1 0") ROW("6 3 -1 0") ROW("7 3 1 0") IMAGE("2"),
                  false);
    CHECK(!reading->done && strstr(reading->error.message, "not polygons apart in x or y") != NULL);
    forget(reading);
}

/* What was refused above is listed with its line, and the rest is read. */
static void check_lossy(void)
{
    struct reading *reading =
        read_text(HEAD "WXYZ 1\nVDXN 0 2\nYFLN 5 0\n" SINGLET "EFFL 1 2 3\nMNUM 1 1\n", true);
    CHECK(reading->done && reading->job.loss_count == 2);
    CHECK(reading->job.losses[0].line == 3 && reading->job.losses[1].line == 4);
    CHECK(strstr(reading->job.losses[1].what, "VDXN") != NULL);
    CHECK(reading->lens.field_count == 2 && reading->lens.surface_count == 2);
    forget(reading);
}

static struct first_order first_order_at(struct reading *reading, size_t position)
{
    struct first_order first = {.efl = NAN};
    CHECK(first_order_of_lens(lens_at_position(&reading->lens, position, &reading->arena),
                              lens_primary_wavelength(&reading->lens), SECTION_Y, &reading->arena,
                              &first, &reading->error));
    return first;
}

/* R = 50, -50, t = 4, n = 1.5: P = 2 0.01 - 4/1.5 0.01^2 = 0.0197333.., by hand. */
static void check_singlet(void)
{
    static const char *const forms[] = {
        HEAD "FNUM 4\nFTYP 0 0 2 1\nYFLN 0 5 0\nWAVM 1 0.55 1\nPWAV 1\n" SINGLET,
        "UNIT IN\r\nSURF 0\r\n  DISZ INFINITY\r\nSURF 1\r\n  CURV 0.508\r\n"
        "  DISZ 0.15748031496062992125984251968504\r\n  GLAS ___BLANK 1 0 1.5 0\r\nSURF 2\r\n"
        "  CURV -0.508\r\n  DISZ 2\r\n  MAZH 0 0\r\nSURF 3\r\n",
    };
    for (size_t i = 0; i < 2; i++) {
        struct reading *reading = read_text(forms[i], false);
        CHECK(reading->done);
        if (reading->done) {
            struct first_order first = first_order_at(reading, 0);
            CHECK_RELATIVE(first.efl, 1 / 0.01973333333333333333, 1e-15, "efl");
            CHECK(reading->lens.focus == (i == 0 ? FOCUS_TABLE : FOCUS_PARAXIAL));
            struct pair c = surface_curvature(&reading->lens.surfaces[0], SECTION_Y);
            CHECK_RELATIVE(c.hi, 0.02, 1e-16, "curvature");
            CHECK(i == 1 || text_equal(reading->lens.surfaces[0].radius.typed, "50"));
        }
        forget(reading);
    }
}

/* The same file in all encodings is the same lens. */
static void check_encodings(void)
{
    const char *plain = HEAD "NAME 5 \xc2\xb5m\n" SINGLET;
    size_t length = strlen(plain);
    for (int big = 0; big < 2; big++) {
        for (int mark = 0; mark < 2; mark++) {
            struct arena arena = {0};
            struct lens lens;
            struct error error = {0};
            char *wide = calloc(length + 4, 2);
            size_t used = 0;
            if (mark) {
                memcpy(wide, big ? "\xfe\xff" : "\xff\xfe", 2);
                used = 2;
            }
            for (size_t i = 0; i < length; i++) {
                unsigned char c = (unsigned char)plain[i];
                c = c == 0xc2 ? (unsigned char)plain[++i] : c;
                wide[used + (big ? 1 : 0)] = (char)c;
                wide[used + (big ? 0 : 1)] = 0;
                used += 2;
            }
            struct foreign_job job = {.source = "wide.zmx", .arena = &arena};
            CHECK(foreign_read(&job, (struct text){wide, used}, &lens, &error));
            CHECK(lens.title != NULL && strcmp(lens.title, "5 \xc2\xb5m") == 0);
            CHECK(lens.surface_count == 2);
            arena_free(&arena);
            free(wide);
        }
    }
}

/* Pick-ups and sums by hand; the marginal ray of the singlet above meets the axis at its bfl. */
static void check_solves(void)
{
    struct reading *reading = read_text(
        HEAD "ENPD 10\n" OBJECT "SURF 1\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n"
             "SURF 2\n  CURV -0.02\n  DISZ 0\n  MAZH 0 0\n"
             "SURF 3\n  DISZ 0\n  PZUP 1 2.5 0.25\n"
             "SURF 4\n  DISZ 0\n  TCOM 3 20\n"
             "SURF 5\n  DISZ 0\n  TOLE 3 30.5\n"
             "SURF 6\n  TYPE COORDBRK\n  PARM 3 15\n  DISZ 0\n"
             "SURF 7\n  TYPE COORDBRK\n  PARM 3 0\n  PPAR 3 6 -1 0 0\n  DISZ 1\n" IMAGE("8"),
        false);
    const struct surface *s = reading->lens.surfaces;
    CHECK(reading->done);
    if (reading->done) {
        /* bfl = f (1 - d (n-1)/(n R1)) */
        double f = 1 / (0.02 - 4 / 1.5 * 0.0001), bfl = f * (1 - 4 * 0.5 / (1.5 * 50));
        CHECK_RELATIVE(s[1].thickness.value.hi, bfl, 1e-15, "MAZH");
        CHECK(s[2].thickness.value.hi == 10.25 && s[3].thickness.value.hi == 9.75);
        CHECK(s[4].thickness.value.hi == 10.5);
        CHECK(reading->lens.surface_count == 7 && s[5].coordinate_break != NULL &&
              s[6].coordinate_break != NULL);
        CHECK_NEAR(s[5].coordinate_break->tilt[0].value.hi, 0.26179938779914943654, 1e-16,
                   "15 deg");
        CHECK_NEAR(s[6].coordinate_break->tilt[0].value.hi, -0.26179938779914943654, 1e-16,
                   "-15 deg");
    }
    forget(reading);
}

/*
 * The second curvature of a lens of n = 1.5, c1 = 0.02, t = 4 with a pupil of 10, by hand: the
 * marginal ray meets it at y = 5 - 4 u, u = 0.05/1.5; a chief ray of 10 degrees at 4 tan 10/1.5.
 */
static void check_curvatures(void)
{
    const double u = -0.05 / 1.5, y = 5 + 4 * u, v = -0.05, slope = 0.17632698070846497347;
    const struct {
        const char *solve;
        double curvature;
        size_t notes, losses;
    } cases[] = {
        {"-0.02 0 0 0 0", -0.02, 0, 0},
        {"-0.02 1 0 0 0", -0.02, 0, 0},
        {"0 2 -0.125 0 0", (v + 0.125) / (y * -0.5), 1, 0},
        {"-0.0308219178082191780 2 -0.125 0 0", (v + 0.125) / (y * -0.5), 0, 0},
        {"-0.031 2 -0.125 0 0", (v + 0.125) / (y * -0.5), 0, 0}, /* rounded in the file */
        {"0 11 4 0 0", (v + 0.125) / (y * -0.5), 1, 0},
        {"0 3 0.1 0 0", (slope - 0.1) / (4 * slope / 1.5 * -0.5), 1, 0},
        {"-0.02 4 1 -1 0", -0.02, 0, 0},
        {"0.5 4 1 1.5 0", 0.5, 1, 1}, /* contradicts the lens: a note of its power, too */
        {"-0.032 2 -0.125 0 0", -0.032, 1, 1},
        {"0 5 0 0 0", -u / y, 1, 0},
        {"0 6 0 0 0", -(slope / 1.5) / (4 * slope / 1.5), 1, 0},
        {"0 7 0 0 0", -(1.5 + 1) * u / (1.5 * y), 1, 0},
        {"0.1 8 0.02 0 0", 0.1, 1, 0},
        {"0 9 1 0 0", -0.25, 1, 0},
        {"0 10 1 0 0", 1. / 46, 1, 0},
        {"0.1 12 0 0 0", 0.1, 1, 0},
        {"0.1 4 3 1 0", 0.1, 1, 0},
        {"0.1 4 1 1 3", 0.1, 1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1000];
        snprintf(text, sizeof text,
                 HEAD "ENPD 10\nFTYP 0 0 1 1\nYFLN 10\n" OBJECT
                      "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n"
                      "SURF 2\n  CURV %s \"\"\n  DISZ 30\n" IMAGE("3"),
                 cases[i].solve);
        struct reading *reading = read_text(text, true), *strict = read_text(text, false);
        CHECK(reading->done && strict->done == (cases[i].losses == 0));
        CHECK(reading->lens.note_count == cases[i].notes);
        CHECK(reading->job.loss_count == cases[i].losses);
        if (reading->done) {
            CHECK_RELATIVE(surface_curvature(&reading->lens.surfaces[1], SECTION_Y).hi,
                           cases[i].curvature, 4e-15, cases[i].solve);
        }
        forget(reading);
        forget(strict);
    }
}

/* An f-number wants the focal length, which the solved curvature decides: the pupil follows. */
static void check_settled(void)
{
    struct reading *reading = read_text(
        HEAD "FNUM 4\n" OBJECT "SURF 1\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n"
             "SURF 2\n  CURV 0.01 5\n  DISZ 0\n  MAZH 1 0\n" IMAGE("3"),
        false);
    CHECK(reading->done);
    if (reading->done) { /* u = u' at a normal surface: f = 1.5/0.01, and u' = -y1/f = -1/8 */
        double y1 = 150. / 8, y2 = y1 * (1 - 4 * 0.01 / 1.5);
        CHECK_RELATIVE(first_order_at(reading, 0).efl, 150., 1e-15, "efl");
        CHECK_RELATIVE(reading->lens.surfaces[1].thickness.value.hi, (y2 - 1) * 8, 1e-15,
                       "height 1");
    }
    forget(reading);
}

/* Glasses and semi-diameters that follow a surface; what follows none, or another column. */
static void check_other_pickups(void)
{
    static const struct {
        const char *text;
        size_t notes, losses;
    } cases[] = {
        {"  GLAS ___BLANK 2 1 1.5 0\n  DIAM 10 2 1 0 1\n", 0, 0},
        {"  GLAS OTHER 2 1 1.7 30\n  DIAM 5 2 1 0 0.5\n", 1, 0},
        {"  GLAS ___BLANK 2 3 1.5 0\n", 0, 1},
        {"  GLAS ___BLANK 1 0 1.5 0\n  DIAM 7 2 1 0 1\n", 1, 0},
        {"  GLAS ___BLANK 1 0 1.5 0\n  CONI -1 2 1\n", 1, 0},
        {"  GLAS ___BLANK 1 0 1.5 0\n  PARM 1 0\n  PPAR 1 3 1 0 0\n", 1, 0},
        {"  GLAS ___BLANK 1 0 1.5 0\n  PZUP 1 1 0 4\n", 1, 0},
        {"  GLAS ___BLANK 1 0 1.5 0\n  CHZH 0 0\n", 1, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[1000];
        snprintf(text, sizeof text,
                 HEAD OBJECT "SURF 1\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n"
                             "  DIAM 10 1\n"
                             "SURF 2\n  TYPE EVENASPH\n  CURV 0\n  DISZ 30\n%s" IMAGE("3"),
                 cases[i].text);
        struct reading *reading = read_text(text, true);
        CHECK(reading->done && reading->lens.note_count == cases[i].notes);
        CHECK(reading->job.loss_count == cases[i].losses);
        CHECK(i > 1 || reading->lens.surfaces[1].medium.index.hi == 1.5);
        forget(reading);
    }
}

/* Behind the surfaces operands of the merit function are passed over, other words are lost. */
static void check_tail(void)
{
    struct reading *reading =
        read_text(HEAD SINGLET "TOL COMP 0\nMNUM 1 1\nEFFL 1\nREAY 2 3\nQQQQ 4\n", true);
    CHECK(reading->done && reading->job.loss_count == 1);
    CHECK(reading->job.losses[0].line == 26);
    forget(reading);
}

static void check_configurations(void)
{
    struct reading *reading = read_text(
        HEAD "FNUM 4\n" SINGLET "MNUM 2 1\nTHIC 0 1 1e10 0\nTHIC 0 2 200 0\n"
             "THIC 2 1 50 0\nTHIC 2 2 70 0\nAPER 0 1 4\nAPER 0 2 5.6\nSDIA 1 1 10\nSDIA 1 2 8\n"
             "YFIE 1 1 0\nYFIE 1 2 0\n",
        false);
    const struct lens *lens = &reading->lens;
    CHECK(reading->done && lens->position_count == 2 && lens->variable_count == 2);
    if (reading->done) {
        CHECK(lens->objects != NULL && isinf(lens->objects[0].value.hi) &&
              lens->objects[1].value.hi == 200);
        CHECK(lens->apertures != NULL && lens->apertures[1].value.hi == 5.6);
        const struct lens *second = lens_at_position(lens, 1, &reading->arena);
        CHECK(second->surfaces[1].thickness.value.hi == 70);
        CHECK(second->surfaces[0].diameter.value.hi == 16);
    }
    forget(reading);
}

static const char rich[] =
    HEAD "ENPD 8.4\nGCAT SCHOTT\nFTYP 1 0 2 2\nYFLN 0 -3.5 0\nWAVM 1 0.55 1\nWAVM 2 0.65 0.5\n"
         "PWAV 2\nSURF 0\n  DISZ 123.4\n"
         "SURF 1\n  TYPE EVENASPH\n  CURV 0.016963528413910092\n  CONI -0.7\n  PARM 1 1e-5\n"
         "  PARM 2 -3.3E-07\n  DISZ 4.1\n  GLAS ___BLANK 1 0 1.5168 64.17 0 0\n  DIAM 5.05 1\n"
         "SURF 2\n  TYPE COORDBRK\n  PARM 1 0.5\n  PARM 2 -0.25\n  PARM 3 1.5\n  PARM 4 -2\n"
         "  PARM 5 3\n  DISZ 0\n"
         "SURF 3\n  STOP\n  CURV -0.031\n  DISZ 7\n  COMM back \"side\"\n"
         "SURF 4\n  TYPE XASPHERE\n  CURV 0.001\n  XDAT 1 10 0\n  XDAT 2 1 0\n  XDAT 12 2e-20 0\n"
         "  DISZ -6.25\n  GLAS MIRROR 0 0\n"
         "SURF 5\n  TYPE TOROIDAL\n  CURV 0\n  PARM 1 40\n  DISZ -3\n  GLAS ___BLANK 1 0 1.6 0\n"
         "SURF 6\n  DISZ -30\n" IMAGE("7");

static bool same_figure(const struct figure *a, const struct figure *b)
{
    return a->value.hi == b->value.hi && a->value.lo == b->value.lo;
}

static void check_same(const struct lens *a, const struct lens *b)
{
    CHECK(a->surface_count == b->surface_count && a->stop == b->stop);
    for (size_t i = 0; i < a->surface_count && a->surface_count == b->surface_count; i++) {
        const struct surface *s = &a->surfaces[i], *t = &b->surfaces[i];
        CHECK(s->kind == t->kind && s->curved == t->curved);
        CHECK(surface_curvature(s, SECTION_Y).hi == surface_curvature(t, SECTION_Y).hi);
        CHECK(surface_curvature(s, SECTION_X).hi == surface_curvature(t, SECTION_X).hi);
        CHECK(s->is_plane != t->is_plane || same_figure(&s->radius, &t->radius));
        CHECK(same_figure(&s->thickness, &t->thickness) && same_figure(&s->conic, &t->conic));
        CHECK(same_figure(&s->diameter, &t->diameter) && s->coefficients == t->coefficients);
        for (int k = 0; k < LENS_COEFFICIENTS; k++) {
            CHECK(same_figure(&s->coefficient[k], &t->coefficient[k]));
        }
        CHECK((s->coordinate_break == NULL) == (t->coordinate_break == NULL));
        for (int k = 0; s->coordinate_break != NULL && t->coordinate_break != NULL && k < 3; k++) {
            CHECK(same_figure(&s->coordinate_break->tilt[k], &t->coordinate_break->tilt[k]));
        }
        CHECK(s->medium.index.hi == t->medium.index.hi && s->medium.kind == t->medium.kind);
    }
}

/* What was read is written, and read as the same lens; in inches too. */
static void check_roundtrip(void)
{
    struct reading *reading = read_text(rich, false);
    CHECK(reading->done);
    static const char *const units[] = {"mm", "in", "m"};
    for (int i = 0; i < 3 && reading->done; i++) {
        struct text text;
        struct lens again;
        struct arena *arena = &reading->arena;
        const struct lens *lens = lens_in_unit(&reading->lens, units[i], arena);
        CHECK(zemax_write(&reading->job, lens, &text, &reading->error));
        CHECK(foreign_read(&reading->job, text, &again, &reading->error));
        check_same(lens, &again);
        CHECK(again.wavelengths[0].wavelength == 0.65 && again.wavelengths[1].weight == 1);
    }
    forget(reading);
}

/* Turned twice, a lens is itself but for the planes that carry bends; scaled and back, itself. */
static void check_changes(void)
{
    struct reading *reading = read_text(rich, false);
    struct arena *arena = &reading->arena;
    const struct lens *lens = &reading->lens;
    CHECK(reading->done);
    if (reading->done) {
        struct pair k = {0.125, 0}, inverse = {8, 0};
        check_same(lens, lens_scaled(lens_scaled(lens, k, false, arena), inverse, false, arena));
        const struct lens *once = lens_reversed(lens, arena, &reading->error);
        const struct lens *twice = lens_reversed(once, arena, &reading->error);
        struct first_order there = first_order_at(reading, 0), back, again;
        CHECK(first_order_of_lens(once, 0.65, SECTION_Y, arena, &back, &reading->error) &&
              first_order_of_lens(twice, 0.65, SECTION_Y, arena, &again, &reading->error));
        CHECK_RELATIVE(fabs(back.efl), fabs(there.efl), 1e-15, "turned");
        CHECK_RELATIVE(fabs(back.bfl), fabs(there.ffl), 1e-14, "bfl of the turned lens");
        CHECK_RELATIVE(again.efl, there.efl, 1e-15, "turned twice");
        CHECK_RELATIVE(again.bfl, there.bfl, 1e-15, "bfl of the lens turned twice");
        CHECK(again.exit_pupil - there.exit_pupil == 0 ||
              fabs(again.exit_pupil / there.exit_pupil - 1) < 1e-14);
    }
    forget(reading);
}

/*
 * A beam that would meet 100 mm behind the first surface of a lens: 1.5/s = 1/100 + 0.5/100 gives
 * 100 mm, less the 4 mm of glass 1/s' = 1.5/96 + 0.5/100, so that it meets 1600/33 mm behind it.
 */
static void check_virtual_object(void)
{
    static const char text[] =
        HEAD "ENPD 10\nWAVM 1 0.55 1\nSURF 0\n  DISZ -100\nSURF 1\n  STOP\n  CURV 0.01\n  DISZ 4\n"
             "  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n  CURV -0.01\n  MAZH 0 0\nSURF 3\n";
    struct reading *reading = read_text(text, false);
    CHECK(reading->done);
    const struct first_order first = first_order_at(reading, 0);
    CHECK_RELATIVE(first.image, 1600. / 33, 4e-16, "image of a virtual object");
    CHECK_RELATIVE(first.magnification, 1600. / 33 / 96, 4e-16, "its magnification");
    forget(reading);
}

int main(void)
{
    check_errors();
    check_inline_polygons();
    check_slits();
    check_lossy();
    check_singlet();
    check_encodings();
    check_solves();
    check_curvatures();
    check_settled();
    check_other_pickups();
    check_tail();
    check_configurations();
    check_roundtrip();
    check_changes();
    check_virtual_object();
    return check_report();
}
