/* tests/unit/test_lens_change.c - lenses scaled, in another unit, turned around: by hand. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_change.h"

#include "check.h"
#include "file/lens_file.h"

static const struct lens *read_lens(const char *text, struct arena *arena)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct error error = {0};
    bool read = lens_read("test.lens", text_of(text), NULL, arena, lens, &error);
    if (!read) {
        printf("%ld:%d: %s\n", error.line, error.column, error.message);
    }
    CHECK(read);
    return read ? lens : NULL;
}

static const char *written(const struct lens *lens, struct arena *arena)
{
    struct text text = lens_write(lens, arena);
    return arena_printf(arena, "%.*s", (int)text.length, text.start);
}

/* The changed lens and the one typed by hand are written alike, number for number. */
static void check_same(const struct lens *changed, const char *by_hand, struct arena *arena)
{
    const struct lens *wanted = read_lens(by_hand, arena);
    CHECK(changed != NULL);
    if (changed != NULL && wanted != NULL) {
        CHECK_TEXT(written(changed, arena), written(wanted, arena));
    }
}

/* Every dimension: lengths k, curvatures 1/k, A4 1/k^3, A6 1/k^5; angles and ratios stay. */
static const char *const plain =
    "lens x\nunit mm\nwavelength 587.56nm\nobject 500\nfield height 0 12.5\naperture epd 20\n"
    "surface 50 6 1.5/60 40 k=-0.5 A4=4e-06 A6=-8e-08 R~[40,60] t~[5,7]\n"
    "surface - 2 1.6 30 c=0.0125 decenter=1,-2 tilt=3,4\n"
    "bend decenter=0.5,0.25 tilt=1,2,3\n"
    "stop - 4 air 16\n"
    "surface -80 90.5 air 40\n";

static void test_scaled(void)
{
    struct arena arena = {0};
    const struct lens *lens = read_lens(plain, &arena);
    const struct pair two = {2, 0}, half = {0.5, 0};
    const char *const twice =
        "lens x\nunit mm\nwavelength 587.56nm\nobject 1000\nfield height 0 25\naperture epd 40\n"
        "surface 100 12 1.5/60 80 k=-0.5 A4=5e-07 A6=-2.5e-09 R~[80,120] t~[10,14]\n"
        "surface - 4 1.6 60 c=0.00625 decenter=2,-4 tilt=3,4\n"
        "bend decenter=1,0.5 tilt=1,2,3\n"
        "stop - 8 air 32\n"
        "surface -160 181 air 80\n";
    if (lens != NULL) {
        check_same(lens_scaled(lens, two, false, &arena), twice, &arena);
        const struct lens *back = read_lens(twice, &arena);
        check_same(lens_scaled(back, half, false, &arena), plain, &arena);
        check_same(lens_scaled(lens, two, true, &arena), twice, &arena);
    }
    arena_free(&arena);
}

static void test_unit(void)
{
    struct arena arena = {0};
    const struct lens *lens = read_lens(plain, &arena);
    if (lens != NULL) {
        check_same(lens_in_unit(lens, "cm", &arena),
                   "lens x\nunit cm\nwavelength 587.56nm\nobject 50\nfield height 0 1.25\n"
                   "aperture epd 2\n"
                   "surface 5 0.6 1.5/60 4 k=-0.5 A4=0.004 A6=-0.008 R~[4,6] t~[0.5,0.7]\n"
                   "surface - 0.2 1.6 3 c=0.125 decenter=0.1,-0.2 tilt=3,4\n"
                   "bend decenter=0.05,0.025 tilt=1,2,3\n"
                   "stop - 0.4 air 1.6\n"
                   "surface -8 9.05 air 4\n",
                   &arena);
        CHECK(lens_in_unit(lens, "mm", &arena) == lens);
    }
    arena_free(&arena);
}

/* Lengths and fringes of sag scale, shares and angles stay; A4 goes with 1/k^3. */
static void test_tolerances(void)
{
    struct arena arena = {0};
    const char *const text =
        "lens t\nunit mm\nwavelength 587.56nm\nobject inf\naperture stop\n"
        "surface 50 6 1.5/60 40 A4=4e-06\nstop - 4 air 16\nsurface -80 90.5 air 40\n"
        "tolerance R1 0.10%\ntolerance t1 0.02mm\ntolerance R3 3fringes\n"
        "tolerance surface 1 tilt 2.0arcmin\ntolerance A4_1 1.6e-07\ntolerance k1 0.010\n"
        "tolerance surface 3 decenter 20um\n";
    const struct lens *lens = read_lens(text, &arena);
    const struct pair two = {2, 0};
    if (lens != NULL) {
        check_same(lens_scaled(lens, two, false, &arena),
                   "lens t\nunit mm\nwavelength 587.56nm\nobject inf\naperture stop\n"
                   "surface 100 12 1.5/60 80 A4=5e-07\nstop - 8 air 32\nsurface -160 181 air 80\n"
                   "tolerance R1 0.10%\ntolerance t1 0.04mm\ntolerance R3 6fringes\n"
                   "tolerance surface 1 tilt 2.0arcmin\ntolerance A4_1 2e-08\ntolerance k1 0.010\n"
                   "tolerance surface 3 decenter 0.04mm\n",
                   &arena);
        check_same(
            lens_in_unit(lens, "cm", &arena),
            "lens t\nunit cm\nwavelength 587.56nm\nobject inf\naperture stop\n"
            "surface 5 0.6 1.5/60 4 A4=0.004\nstop - 0.4 air 1.6\nsurface -8 9.05 air 4\n"
            "tolerance R1 0.10%\ntolerance t1 0.02mm\ntolerance R3 3fringes\n"
            "tolerance surface 1 tilt 2.0arcmin\ntolerance A4_1 0.00016\ntolerance k1 0.010\n"
            "tolerance surface 3 decenter 20um\n",
            &arena);
    }
    arena_free(&arena);
}

/* What has no length keeps the digits that it was typed with. */
static void test_typed(void)
{
    struct arena arena = {0};
    const struct lens *lens =
        read_lens("lens x\nwavelength 587.56nm\nobject inf\naperture f/4.0\n"
                  "surface 50 6.00 1.50/60.0 40 k=-0.50 tilt=3.0,4.0 R~ t~ k~[-1.50,0.0]\n"
                  "surface - 2.0 air -\n",
                  &arena);
    if (lens != NULL) {
        const struct lens *twice = lens_scaled(lens, (struct pair){2, 0}, false, &arena);
        static const char *const kept[] = {"f/4.0", "1.50/60.0", "k=-0.50", "tilt=3.0,4.0",
                                           "R~ t~ k~[-1.50,0.0]"};
        for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
            CHECK(strstr(written(twice, &arena), kept[i]) != NULL);
        }
    }
    arena_free(&arena);
}

/* Apertures with all that they are made of, and pick-ups, whose offsets are of their number. */
static void test_parts(void)
{
    struct arena arena = {0};
    const char *const once =
        "lens p\nwavelength 587.56nm\nobject inf\nfield image 0 5\naperture stop\n"
        "stated efl 100\nstated bfl 90\nstated fnumber 4.0\n"
        "pickup R3 = -2 R1 + 10\npickup t3 = t1\npickup k3 = k1 + 1\n"
        "surface 50 6 1.5 40 k=-1\nblock spider 1 3 turn=20\npass ellipse 18 14 decenter=1,2\n"
        "stop - 3 air 16\nblock ring 3 5\npass polygon -9,-8 9,-8 8,8 0,5 -8,8 turn=7\n"
        "surface -90 6 1.5 40 k=0\nsurface -80 90.5 air 40\n";
    const char *const twice =
        "lens p\nwavelength 587.56nm\nobject inf\nfield image 0 10\naperture stop\n"
        "stated efl 200\nstated bfl 180\nstated fnumber 4.0\n"
        "pickup R3 = -2 R1 + 20\npickup t3 = t1\npickup k3 = k1 + 1\n"
        "surface 100 12 1.5 80 k=-1\nblock spider 2 3 turn=20\npass ellipse 36 28 decenter=2,4\n"
        "stop - 6 air 32\nblock ring 6 10\n"
        "pass polygon -18,-16 18,-16 16,16 0,10 -16,16 turn=7\n"
        "surface -180 12 1.5 80 k=0\nsurface -160 181 air 80\n";
    const struct lens *lens = read_lens(once, &arena);
    if (lens != NULL) {
        check_same(lens_scaled(lens, (struct pair){2, 0}, false, &arena), twice, &arena);
    }
    const struct lens *back = read_lens(twice, &arena);
    if (back != NULL) {
        check_same(lens_scaled(back, (struct pair){0.5, 0}, false, &arena), once, &arena);
    }
    arena_free(&arena);
}

/* Zoom positions, stated numbers, image heights; f-numbers do not scale. */
static void test_positions(void)
{
    struct arena arena = {0};
    const char *const zoom =
        "lens z\nposition wide tele\nlet d1 2 8\nlet object 100 300\nfield image 0 5\n"
        "aperture f/4\nlet aperture f/4 f/5.6\n"
        "surface 50 5 1.5 20\nsurface -50 d1 air 20\nstop - 3 air 10\nsurface 40 4 1.5 20\n"
        "surface -40 30 air 20\n";
    const struct lens *lens = read_lens(zoom, &arena);
    const struct pair three = {3, 0}, half = {0.5, 0};
    if (lens != NULL) {
        check_same(lens_scaled(lens, three, false, &arena),
                   "lens z\nposition wide tele\nlet d1 6 24\nlet object 300 900\nfield image 0 15\n"
                   "aperture f/4\nlet aperture f/4 f/5.6\n"
                   "surface 150 15 1.5 60\nsurface -150 d1 air 60\nstop - 9 air 30\n"
                   "surface 120 12 1.5 60\nsurface -120 90 air 60\n",
                   &arena);
        check_same(lens_one_position(lens, 1, &arena),
                   "lens z\nobject 300\nfield image 0 5\naperture f/5.6\n"
                   "surface 50 5 1.5 20\nsurface -50 8 air 20\nstop - 3 air 10\n"
                   "surface 40 4 1.5 20\nsurface -40 30 air 20\n",
                   &arena);
        const struct lens *many =
            read_lens("lens s\nwavelength 587.56nm\nposition a b c\nlet d1 2~[1,3] 8 9~\n"
                      "set R1 50 60 70\nset c2 -0.02 -0.04 -0.05\nset tilt_x2 1.0 2.0 3.0\n"
                      "surface 50 5 1.5 20\nsurface - d1 air 20 c=-0.02 tilt=1.0,0\n"
                      "surface - 3 air 20\n",
                      &arena);
        if (many != NULL) {
            check_same(lens_scaled(many, half, false, &arena),
                       "lens s\nwavelength 587.56nm\nposition a b c\nlet d1 1~[0.5,1.5] 4 4.5~\n"
                       "set R1 25 30 35\nset c2 -0.04 -0.08 -0.1\nset tilt_x2 1.0 2.0 3.0\n"
                       "surface 25 2.5 1.5 10\nsurface - d1 air 10 c=-0.04 tilt=1.0,0\n"
                       "surface - 1.5 air 10\n",
                       &arena);
        }
        struct error error;
        CHECK(lens_reversed(lens, &arena, &error) == NULL);
        CHECK_TEXT(error.message, "reverse: object or aperture change between the positions: "
                                  "choose one with position");
    }
    arena_free(&arena);
}

static void check_reversed(const char *text, const char *by_hand)
{
    struct arena arena = {0};
    struct error error = {0};
    const struct lens *lens = read_lens(text, &arena);
    if (lens != NULL) {
        const struct lens *reversed = lens_reversed(lens, &arena, &error);
        CHECK_TEXT(error.message, "");
        check_same(reversed, by_hand, &arena);
    }
    arena_free(&arena);
}

/* Half a turn about y: what was last comes first, R, A and z change signs, x too, y does not. */
static void test_reversed(void)
{
    check_reversed("lens x\nwavelength d\nobject 500\nfield height 0 10\naperture stop\n"
                   "surface 50 6 1.5/60 40 k=-0.5 A4=4e-6 R~[40,60] t~[5,7] glass~\n"
                   "surface +30 2 air 30\nstop - 3 air 16\n"
                   "surface -80 90.5 1.33 41 R~[-90,-70]\n",
                   "lens x\nwavelength d\nobject 90.5\nfield image 0 10\naperture stop\n"
                   "medium 1.33\n"
                   "surface 80 3 air 41 R~[70,90]\nstop - 2 air 16\n"
                   "surface -30 6 1.5/60 30 t~[5,7] glass~\n"
                   "surface -50 500 air 40 k=-0.5 A4=-4e-6 R~[-60,-40]\n");
    check_reversed("lens x\nwavelength d\nobject 500\nfield image 0 10\naperture stop\n"
                   "surface 50 6 1.5 40\nstop - 3 air 16\n",
                   "lens x\nwavelength d\nobject 3\nfield height 0 10\naperture stop\n"
                   "stop - 6 1.5 16\nsurface -50 500 air 40\n");
    /* from infinity: again at infinity, with a paraxial focus */
    check_reversed(
        "lens x\nwavelength d\nobject inf\nfield angle 0 10\nfocus table\naperture stop\n"
        "surface 50 6 1.5 40\nstop - 3 air 16\n",
        "lens x\nwavelength d\nobject inf\nfield angle 0 10\nfocus paraxial\n"
        "aperture stop\nstop - 6 1.5 16\nsurface -50 - air 40\n");
    /* f/4 of a thin plane-convex lens of 100 mm before its stop: 25 mm at the stop */
    check_reversed("lens x\nwavelength d\nobject inf\naperture epd 25\n"
                   "surface - 0 1.5 40\nsurface -50 0 air 40\nstop - 100 air 16\n",
                   "lens x\nwavelength d\nobject inf\naperture stop\n"
                   "stop - 0 air 25\nsurface 50 0 1.5 40\nsurface - - air 40\n");
}

/* One mirror: R stays, and t changes its sign with the mirrors and with the turn. */
static void test_reversed_mirrors(void)
{
    check_reversed("lens m\nwavelength d\nobject 300\naperture stop\n"
                   "stop - 50 air 30\nsurface -200 -150 mirror 40 R~[-250,-150]\n",
                   "lens m\nwavelength d\nobject 150\naperture stop\n"
                   "surface -200 -50 mirror 40 R~[-250,-150]\nstop - -300 air 30\n");
    struct arena arena = {0};
    struct error error = {0};
    const struct lens *lens = read_lens("lens m\nposition a b\nlet d1 50 60\nstop - d1 air 30\n"
                                        "surface -200 -150 mirror 40\n",
                                        &arena);
    if (lens != NULL) {
        CHECK(lens_reversed(lens, &arena, &error) == NULL);
        CHECK_TEXT(error.message, "reverse: distances beside an odd number of mirrors change "
                                  "between the positions: choose one with position");
    }
    arena_free(&arena);
}

/* A shift (1, 2), then turns by 3, 4, 5 deg: undone as 5, 4, 3 and the shift, seen from behind. */
static void test_reversed_breaks(void)
{
    check_reversed("lens b\nwavelength d\nobject inf\naperture stop\n"
                   "surface 50 6 1.5 40 decenter=1,2 tilt=3,4\n"
                   "bend decenter=1,2 tilt=3,4,5\nstop - 3 air 16\n",
                   "lens b\nwavelength d\nobject inf\naperture stop\n"
                   "stop - 0 1.5 16\n"
                   "bend tilt=0,0,5\nsurface - 0 1.5 -\n"
                   "bend tilt=0,-4,0\nsurface - 0 1.5 -\n"
                   "bend tilt=3,0,0\nsurface - 0 1.5 -\n"
                   "bend decenter=1,-2\nsurface - 6 1.5 -\n"
                   "surface -50 - air 40 decenter=-1,2 tilt=-3,4\n");
}

/* What stood behind the last surface has no place before the first. */
static void test_marks_left_out(void)
{
    static const struct {
        const char *text, *marks;
    } cases[] = {
        {"surface 50 6 1.5 40 t~ glass~\nsurface -50 90 air 40 R~\n", NULL},
        {"surface 50 6 1.5 40 t~\nsurface -50 90 1.33 40 R~ t~[80,100] glass~\n",
         "t~ of surface 2, glass~ of surface 2"},
        /* the glass lies before the mirror and behind it */
        {"surface 50 6 1.5 40 R~ glass~ t~\nsurface -50 -6 mirror 40\n", "glass~ of surface 1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct arena arena = {0};
        const struct lens *lens = read_lens(cases[i].text, &arena);
        const char *marks = lens_marks_left_out(lens, &arena);
        CHECK((marks == NULL) == (cases[i].marks == NULL));
        CHECK_TEXT(marks != NULL ? marks : "", cases[i].marks != NULL ? cases[i].marks : "");
        arena_free(&arena);
    }
}

/* What is 0 in a bend needs no plane of its own. */
static void test_reversed_parts(void)
{
    check_reversed("lens b\nwavelength d\nobject inf\naperture stop\nsurface 50 6 1.5 40\n"
                   "bend decenter=0,2 tilt=0,4,0\nstop - 3 air 16\n",
                   "lens b\nwavelength d\nobject inf\naperture stop\nstop - 0 1.5 16\n"
                   "bend tilt=0,-4,0\nsurface - 0 1.5 -\n"
                   "bend decenter=0,-2\nsurface - 6 1.5 -\nsurface -50 - air 40\n");
    check_reversed("lens b\nwavelength d\nobject inf\naperture stop\nsurface 50 6 1.5 40\n"
                   "bend decenter=2,0\nstop - 3 air 16\n",
                   "lens b\nwavelength d\nobject inf\naperture stop\nstop - 0 1.5 16\n"
                   "bend decenter=2,0\nsurface - 6 1.5 -\nsurface -50 - air 40\n");
    check_reversed("lens b\nwavelength d\nobject inf\naperture stop\nsurface 50 6 1.5 40\n"
                   "bend tilt=0,0,5\nstop - 3 air 16\n",
                   "lens b\nwavelength d\nobject inf\naperture stop\nstop - 0 1.5 16\n"
                   "bend tilt=0,0,5\nsurface - 6 1.5 -\nsurface -50 - air 40\n");
}

static void test_refusals(void)
{
    static const struct {
        const char *text, *message;
    } rows[] = {
        {"lens x\nobject inf\naperture epd 10\nsurface 50 6 1.5 40\nsurface -50 90 air 40\n",
         "reverse: the aperture is not that of a stop, and the lens has none: seen from behind "
         "it "
         "is another one"},
        {"lens x\nobject inf\naperture epd 10\nposition a b\nlet d1 6 7\nstop - 1 air 9\n"
         "surface 50 d1 1.5 40\nsurface -50 90 air 40\n",
         "reverse: the aperture is not that of the stop and may change between the positions: "
         "choose one with position"},
        {"lens x\naperture stop\nstop - 1 air 9\nthick 50 6 air 40 distortion=0,0.01\n",
         "reverse: surface 2 is a thick lens with distortion, which has no reverse"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct arena arena = {0};
        struct error error = {0};
        const struct lens *lens = read_lens(rows[i].text, &arena);
        if (lens != NULL) {
            CHECK(lens_reversed(lens, &arena, &error) == NULL && error.code == ERROR_DOMAIN);
            CHECK_TEXT(error.message, rows[i].message);
        }
        arena_free(&arena);
    }
}

int main(void)
{
    test_scaled();
    test_unit();
    test_tolerances();
    test_typed();
    test_parts();
    test_positions();
    test_reversed();
    test_reversed_mirrors();
    test_reversed_breaks();
    test_marks_left_out();
    test_reversed_parts();
    test_refusals();
    return check_report();
}
