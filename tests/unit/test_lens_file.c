/* tests/unit/test_lens_file.c - .lens files: what they say, and where they are wrong. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "file/lens_file.h"
#include "optics/first_order.h"

#include <stdlib.h>

static bool read_text(const char *text, struct arena *arena, struct lens *lens, struct error *error)
{
    return lens_read("test.lens", text_of(text), NULL, arena, lens, error);
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
        {"lens x\nsurfce 1 2 air -\n", 2, 1, "unknown word 'surfce'"},
        {"stop - 1 air 5\nstop - 1 air 5\n", 2, 1, "second stop"},
        {"aperture stop\nsurface 1 2 air -\n", 1, 10, "needs a stop"},
        {"surface 1 2 -1.5 -\n", 1, 13, "not above 0"},
        {"surface 1 2 0/50 -\n", 1, 13, "not above 0"},
        {"wavelength 587.56\n", 1, 18, "no unit"},
        {"wavelength d X\n", 1, 14, "not a wavelength"},
        {"surface 1,5 2 air -\n", 1, 10, "not a number"},
        {"surface 5 2 air\n", 1, 16, "diameter is missing"},
        {"surface 5\n", 1, 10, "thickness is missing"},
        {"surface 5 2 air 4 kk=1\n", 1, 19, "unknown word"},
        {"surface 5 2 air 4 A21=1\n", 1, 19, "unknown word"},
        {"surface 5 2 air 4 A22=1\n", 1, 19, "unknown word"},
        {"surface 5 d1 air 4\n", 1, 11, "'d1' is not a number, and no line"},
        {"position a b\nlet d1 1\nsurface 5 d1 air 4\n", 2, 5, "1 numbers for 2"},
        {"object -5\n", 1, 8, "to the left"},
        {"aperture f/0\n", 1, 12, "above 0"},
        {"unit mile\n", 1, 6, "one of mm"},
        {"surface 5 2 {d 1.5 -\n", 1, 13, "does not end"},
        {"surface 5 2 air 4 c=1\n", 1, 21, "beside a radius"},
        {"stop 5 2 air 4\n", 1, 6, "a stop is a plane"},
        {"surface 5 - air 4\nsurface 5 - air 4\n", 2, 1, "without a thickness"},
        {"lens a\nlens b\n", 2, 1, "twice"},
        {"focus near\n", 1, 7, "paraxial, table, best or afocal"},
        {"thick - 5 air 4\n", 1, 7, "other than 0"},
        {"thick 0 5 air 4\n", 1, 7, "other than 0"},
        {"thick 50 5 mirror 4\n", 1, 12, "not a mirror"},
        {"thick 50 5 air 4 k=1\n", 1, 18, "unknown word"},
        {"thick 50 5 air 4 A4=1\n", 1, 18, "unknown word"},
        {"surface 50 5 air 4 hiatus=1\n", 1, 20, "unknown word"},
        {"thick 50 5 air 4 hiatus=1..2\n", 1, 27, "not a number"},
        {"thick 50 5 air 4 distortion=1,2,3,4\n", 1, 35, "more than 3"},
        {"thick f1 5 air 4\n", 1, 7, "'f1' is not a number, and no line"},
        {"thin - 5 air 4\n", 1, 6, "other than 0"},
        {"thin 50 5 mirror\n", 1, 11, "not a mirror"},
        {"thin 50 5 air 4 hiatus=1\n", 1, 24, "no hiatus"},
        {"thin 50\nthin 50\n", 2, 1, "without a thickness"},
        {"surface 5 2 air 4 R~ R~\n", 1, 22, "'R~' is there twice"},
        {"surface 5 2 air 4 A4~ t~ A4~[1,2]\n", 1, 26, "'A4~' is there twice"},
        {"surface 5 2 air 4 A3=1e-5 A3=2e-5\n", 1, 27, "'A3=' is there twice"},
        {"surface 5 2 air 4 k=1 tilt=1,2 k=1\n", 1, 32, "'k=' is there twice"},
        {"surface 5 2 air 4 name=a name=b\n", 1, 26, "'name=' is there twice"},
        {"surface 5 2 air 4 stop stop\n", 1, 24, "'stop' is there twice"},
        {"bend tilt=1,2,3 tilt=1,2,3\n", 1, 17, "'tilt=' is there twice"},
        {"surface 5 2 air 4 R~[60,40]\n", 1, 21, "the lower bound is above the upper"},
        {"unit in\nsurface - 2 air 4 c=1 c~[0.2,0.1]\n", 2, 25, "the lower bound is above"},
        {"", 0, 0, "no surface"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        struct lens lens;
        struct error error = {0};
        CHECK(!read_text(cases[i].text, &arena, &lens, &error));
        CHECK(error.code == ERROR_DATA);
        bool named = strstr(error.message, cases[i].message) != NULL;
        bool placed = error.line == cases[i].line && error.column == cases[i].column;
        if (!named || !placed) {
            printf("%s -> %ld:%d: %s\n", cases[i].text, error.line, error.column, error.message);
        }
        CHECK(named && placed);
        arena_free(&arena);
    }
}

/* 0.1 is 0.1000000000000000055511151231257827 as a double; the rest is kept. */
static void check_decimals(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    CHECK(read_text("unit in\nsurface 0.1 1e-3 1.67 - A4=1\n", &arena, &lens, &error));
    const struct surface *surface = &lens.surfaces[0];
    CHECK(surface->radius.value.hi == 2.54);
    /* 2.54 = 2.54000000000000003552713678800500929355621337890625 - the rest */
    CHECK_RELATIVE(surface->radius.value.lo, -3.552713678800501e-17, 1e-12, "rest of 2.54");
    CHECK(surface->medium.index.hi == 1.67);
    /* 1.67 = 1.6699999999999999289457264239899814128875732421875 + the rest */
    CHECK_RELATIVE(surface->medium.index.lo, 7.105427357601002e-17, 1e-12, "rest of 1.67");
    CHECK_RELATIVE(surface->coefficient[1].value.hi, 1 / (25.4 * 25.4 * 25.4), 4e-16, "A4, mm^-3");
    arena_free(&arena);
}

static const char zoom[] =
    "\xef\xbb\xbflens A zoom\r\nposition wide tele\r\n"
    "let d1 2.40 8.310\r\nlet aperture f/2.8 f/4\r\nlet object inf 900\r\n"
    "surface 58.950 d1 1.670/47.1 50.4 k=-1 name=\"front one\" R~ t~[2,10]\r\n"
    "surface - 1.0 mirror - tilt=45,0\r\nbend tilt=90,0,0\r\n"
    "stop - -3 {d 1.5, F 1.51} 10\r\nsurface inf - SCHOTT:N-BK7 - cyl=x\r\n";

static void check_model(void)
{
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    struct lens_warnings warnings;
    CHECK(read_text(zoom, &arena, &lens, &error));
    CHECK(lens.surface_count == 4 && lens.stop == 2 && lens.position_count == 2);
    CHECK(lens.surfaces[0].thickness.variable == 0 && lens.surfaces[0].vary_count == 2);
    CHECK(lens.surfaces[1].kind == SURFACE_REFLECT && lens.surfaces[2].coordinate_break != NULL);
    CHECK_TEXT(lens.surfaces[0].name, "front one");
    const struct lens *tele =
        lens_at_position(&lens, lens_position_find(&lens, text_of("tele")), &arena);
    CHECK(tele->surfaces[0].thickness.value.hi == 8.31 && tele->aperture.value.hi == 4);
    CHECK(!tele->object_is_infinite && tele->object.value.hi == 900);
    CHECK(lens_check(&lens, &arena, &warnings, &error));
    struct pair n;
    CHECK(!medium_index(&lens.surfaces[3].medium, 0.5, &n, &error));
    CHECK(strstr(error.message, "SCHOTT:N-BK7") != NULL);
    CHECK(medium_index(&lens.surfaces[2].medium, 0.5875618, &n, &error));
    CHECK_NEAR(n.hi, 1.5, 1e-16, "a table at its point");
    CHECK(!medium_index(&lens.surfaces[2].medium, 0.7, &n, &error));
    arena_free(&arena);
}

/* What is written is what was typed, digit by digit, and writing it again changes nothing. */
static void check_writing(void)
{
    struct arena arena = {0};
    struct lens lens, again;
    struct error error;
    CHECK(read_text(zoom, &arena, &lens, &error));
    struct text first = lens_write(&lens, &arena);
    const char *text = arena_string(&arena, first.start, first.length);
    CHECK(strstr(text, "58.950") != NULL && strstr(text, "8.310") != NULL);
    CHECK(strstr(text, "t~[2,10]") != NULL && strstr(text, "name=\"front one\"") != NULL);
    CHECK(lens_read("again", first, NULL, &arena, &again, &error));
    struct text second = lens_write(&again, &arena);
    CHECK(second.length == first.length && memcmp(first.start, second.start, first.length) == 0);
    arena_free(&arena);
}

/* Doubtful lenses stay usable; impossible ones are refused. */
static void check_warnings(void)
{
    static const struct {
        const char *text, *warning;
    } cases[] = {
        {"surface 10 5 1.5 30\nsurface -50 0 air 30\n", "sag's domain"},
        {"surface 20 1 1.5 30\nsurface -20 0 air 30\n", "overlap"},
        {"surface 20 5 1.5 10\nsurface -20 -1 air 10\nsurface 5 0 1.5 4\n", "negative"},
    };
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    struct lens_warnings warnings;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK(read_text(cases[i].text, &arena, &lens, &error));
        CHECK(lens_check(&lens, &arena, &warnings, &error));
        CHECK(warnings.count > 0 && strstr(warnings.texts[0], cases[i].warning) != NULL);
    }
    CHECK(read_text("aperture stop\nsurface 20 1 1.5 - stop\n", &arena, &lens, &error));
    CHECK(!lens_check(&lens, &arena, &warnings, &error) && error.code == ERROR_DATA);
    CHECK(read_text("surface 20 1 1.5 9 stop\nsurface - 1 1.5 9\nsurface 20 1 1.5 9\n", &arena,
                    &lens, &error));
    lens.surfaces[2].is_stop = true;
    CHECK(!lens_check(&lens, &arena, &warnings, &error));
    CHECK_TEXT(error.message, "two stops: surfaces 1 and 3");
    arena_free(&arena);
}

/* A line of a million characters, and one of half a million words. */
static void check_long_lines(void)
{
    enum { LENGTH = 1000000 };
    char *text = malloc(LENGTH + 1);
    struct arena arena = {0};
    struct lens lens;
    struct error error;
    memset(text, '7', LENGTH);
    text[LENGTH] = '\0';
    CHECK(!read_text(text, &arena, &lens, &error) && error.line == 1);
    memcpy(text, "surface ", 8);
    CHECK(!read_text(text, &arena, &lens, &error) && error.line == 1);
    for (int i = 0; i < LENGTH; i++) {
        text[i] = i % 2 == 0 ? '1' : ' ';
    }
    memcpy(text, "field angle ", 12);
    CHECK(!read_text(text, &arena, &lens, &error)); /* no surface */
    CHECK(lens.field_count > 400000);
    free(text);
    arena_free(&arena);
}

/*
 * A zoom of two positions as thick lenses: read, written, read again, and of the power, the
 * principal planes and the pupil that stand in it.
 */
static void check_thick(void)
{
    static const char text[] = "lens thick\nposition wide tele\nlet f1 24 70\nlet d1 30 -5\n"
                               "let h1 -12.5 3\naperture stop\n"
                               "surface - 20 air -\nstop - -4 air 10\n"
                               "thick f1 d1 air 30 hiatus=h1 distortion=-0.1,0.02 name=zoom\n"
                               "surface - - air -\n";
    const double focal[2] = {24, 70}, gap[2] = {30, -5}, hiatus[2] = {-12.5, 3};
    struct arena arena = {0};
    struct lens lens;
    struct error error = {0};
    struct lens_warnings warnings;
    CHECK(read_text(text, &arena, &lens, &error));
    struct text written = lens_write(&lens, &arena);
    CHECK(lens_read("again.lens", written, NULL, &arena, &lens, &error));
    CHECK(lens_check(&lens, &arena, &warnings, &error) && warnings.count == 0);
    for (size_t i = 0; i < 2; i++) {
        struct first_order first;
        const struct lens *one = lens_at_position(&lens, i, &arena);
        CHECK(first_order_of_lens(one, 0.55, SECTION_Y, &arena, &first, &error));
        CHECK_RELATIVE(first.efl, focal[i], 1e-15, "focal length");
        CHECK_NEAR(first.front_principal, 16, 1e-13, "H");
        CHECK_NEAR(first.rear_principal, -gap[i], 1e-13, "H'");
        CHECK_NEAR(first.length, 16 + hiatus[i] + gap[i], 1e-13, "length");
        CHECK_NEAR(first.entrance_pupil, 20, 1e-13, "entrance pupil");
        CHECK_NEAR(first.petzval_sum, 0, 0, "a flat field");
        CHECK_NEAR(one->surfaces[2].distortion[1].value.hi, 0.02, 0, "distortion");
        CHECK_NEAR(surface_advance(&one->surfaces[2]).hi, gap[i] + hiatus[i], 1e-14, "advance");
    }
    /* read in inches: lengths scale, the distortion does not */
    CHECK(read_text("unit in\nthick 2 1 1.5 - hiatus=0.5 distortion=0.3\n", &arena, &lens, &error));
    CHECK_RELATIVE(lens.surfaces[0].focal.value.hi, 50.8, 1e-15, "inches");
    CHECK_RELATIVE(lens.surfaces[0].hiatus.value.hi, 12.7, 1e-15, "inches");
    CHECK_NEAR(lens.surfaces[0].distortion[0].value.hi, 0.3, 0, "a number");
    arena_free(&arena);
}

/*
 * Two thin lenses, d apart: 1/f = 1/f1 + 1/f2 - d/(f1 f2), behind the second one
 * f2 (d - f1)/(d - f1 - f2) to the focus in cm f1 = 8, f2 = -9.5, d = 14.
 */
static void check_thin(void)
{
    struct arena arena = {0};
    struct error error = {0};
    struct lens lens;
    struct first_order first;
    CHECK(read_text("unit cm\nthin 8 14\nthin -9.5\n", &arena, &lens, &error));
    CHECK(first_order_of_lens(&lens, 0.55, SECTION_Y, &arena, &first, &error));
    CHECK_RELATIVE(first.efl, 10 * 8 * 9.5 / 15.5, 1e-15, "focal length of two thin lenses");
    CHECK_RELATIVE(first.bfl, 10 * -9.5 * 6 / 15.5, 1e-15, "back focal length");
    CHECK(surface_is_thin(&lens.surfaces[0]) && !lens.surfaces[1].has_thickness);
    CHECK(read_text("medium 1.33\nthin 8\n", &arena, &lens, &error));
    CHECK_NEAR(lens.surfaces[0].medium.index.hi, 1.33, 0, "the medium in front");
    arena_free(&arena);
}

int main(void)
{
    check_thick();
    check_thin();
    check_errors();
    check_decimals();
    check_model();
    check_writing();
    check_warnings();
    check_long_lines();
    return check_report();
}
