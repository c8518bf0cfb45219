/* tests/unit/test_zemax_solves.c - .zmx files: ideal lenses, solves, temperature. */
/* SPDX-License-Identifier: MIT */
#include "exchange/zemax/zemax.h"
#include "foreign_cases.h"
#include "optics/first_order.h"
#include "trace/dispatch.h"
#include "trace/system.h"

static const char good[] = "MODE SEQ\n"
                           "UNIT MM X W X CM MR CPMM\n"
                           "ENPD 10\n"
                           "FTYP 0 0 2 1 0 0 0\n"
                           "YFLN 0 10\n"
                           "WAVM 1 0.55 1\n"
                           "PWAV 1\n"
                           "SURF 0\n"
                           "  DISZ INFINITY\n"
                           "SURF 1\n"
                           "  STOP\n"
                           "  DISZ 20\n"
                           "SURF 2\n"
                           "  TYPE PARAXIAL\n"
                           "  DISZ 50\n"
                           "  PARM 1 50\n"
                           "  PARM 2 1\n"
                           "SURF 3\n"
                           "  DISZ 0\n";

static const struct meaning of_paraxial[] = {
    {"", "", "thin 50 50 air -"},
    {"PARM 2 1", "PARM 2 0", "thin 50 50 air -"},
    {"PARM 1 50", "PARM 1 -12.5\n  DIAM 4", "thin -12.5 50 air 8"},
    {"PARM 1 50", "PARM 1 50\n  GLAS ___BLANK 1 0 1.33 0", "thin 50 50 1.33 -"},
    {"UNIT MM", "UNIT IN", "thin 50 50 air -"},
    {"  STOP\n  DISZ 20\nSURF 2\n  TYPE PARAXIAL\n", "  DISZ 20\nSURF 2\n  TYPE PARAXIAL\n  STOP\n",
     "thin 50 50 air - stop"},
    {"  DISZ 20\n", "  TYPE PARAXIAL\n  PARM 1 40\n  DISZ 20\n", "thin 40 20 air - stop"},
    {"SURF 3\n", "SURF 3\n  TYPE PARAXIAL\n  PARM 1 9\n  PPAR 1 2 -0.5 3\n  DISZ 5\nSURF 4\n",
     "thin -22 5 air -"},
    {"SURF 3\n  DISZ 0\n", "SURF 3\n  DISZ 0\nMNUM 2 1\nPAR1 2 1 50\nPAR1 2 2 60\n",
     "set f2 50 60"},
    /* a plane in the program too: the numbers of its curve do nothing */
    {"PARM 2 1", "PARM 2 1\n  CURV 0.1\n  CONI 2",
     "note surface 2 is an ideal lens: its curvature and conic do nothing"},
    {"PARM 2 1", "PARM 2 1\n  CURV 0.1\n  CONI 2", "thin 50 50 air -"},
};

static const struct refusal of_wrong_paraxial[] = {
    {"PARM 1 50", "@PARM 1 0", "an ideal lens of the focal length 0", NULL},
    {"TYPE PARAXIAL\n  DISZ 50\n  PARM 1 50", "TYPE @PARAXIAL\n  DISZ 50",
     "an ideal lens without a focal length", NULL},
    {"PARM 2 1", "PARM 2 1\n  @PARM 3 1", "parameter 3 of an ideal lens", "left out"},
};

/* Up to the last surface: pick-ups and solves come behind it. */
#define SINGLET                                                                                    \
    "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n  CURV -0.02\n"     \
    "  DISZ 90\n"
/* Its second curve by a solve. */
#define BENT(code)                                                                                 \
    "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\nSURF 2\n"                   \
    "  CURV -0.02 " code " 0 0 0\n  DISZ 90\n"
#define PARAXIAL                                                                                   \
    "SURF 1\n  STOP\n  DISZ 20\nSURF 2\n  TYPE PARAXIAL\n  DISZ 50\n  PARM 1 50\n  PARM 2 1\n"

/* In one configuration the number of the file is what the program solved. */
static const struct meaning of_kept[] = {
    {PARAXIAL, SINGLET "  MAZH 0 1\n",
     "note line 18: a solve that follows a real ray; the file's number is kept"},
    {PARAXIAL, SINGLET "  MAZH 0 1\n", "surface -50 90 air -"},
    {PARAXIAL, SINGLET "  DIAM 6 2 1 0 1\n",
     "note line 18: a semi-diameter that follows another number; the file's number is kept"},
    {PARAXIAL, SINGLET "  CONI -1 2 1\n",
     "note line 18: a conic that follows another number; the file's number is kept"},
    {PARAXIAL, SINGLET "  PARM 1 0\n  PPAR 1 5 1 0 0\n",
     "note line 19: a parameter that follows no earlier surface; the file's number is kept"},
    {PARAXIAL, SINGLET "  PZUP 1 1 0 4\n",
     "note line 18: a solve that follows another column; the file's number is kept"},
    {PARAXIAL, SINGLET "  PZUP 3 1 0\n",
     "note line 18: a solve that follows no earlier surface; the file's number is kept"},
    {PARAXIAL, BENT("40"),
     "note line 16: a solve that lenscalc does not know; the file's number is kept"},
    {PARAXIAL, BENT("1e17"),
     "note line 16: a solve that lenscalc does not know; the file's number is kept"},
};

/* In several it is that of one of them. */
static const struct refusal of_lost[] = {
    {PARAXIAL "SURF 3\n  DISZ 0\n", SINGLET "  @MAZH 0 1\nSURF 3\n  DISZ 0\nMNUM 2 1\n",
     "a solve that follows a real ray", "the file's number is kept"},
};

static const struct refusal of_circles[] = {
    {PARAXIAL, SINGLET "  @PZUP 2 1 0\n",
     "the pick-ups go in a circle: surface 2 follows surface 2, which follows it", NULL},
    {PARAXIAL, "SURF 1\n  STOP\n  DISZ 20\n  @PZUP 2 1 0\nSURF 2\n  DISZ 20\n  PZUP 1 1 0\n",
     "the pick-ups go in a circle: surface 1 follows surface 2, which follows it", NULL},
    {PARAXIAL, "SURF 1\n  STOP\n  @CURV 0.1 4 2 -1 0\nSURF 2\n  CURV -0.1 4 1 -1 0\n  DISZ 20\n",
     "the pick-ups go in a circle: surface 1 follows surface 2, which follows it", NULL},
    {PARAXIAL, SINGLET "  @DIAM 6 2 2 0 1\n",
     "the pick-ups go in a circle: surface 2 follows surface 2, which follows it", NULL},
    {PARAXIAL, SINGLET "  PARM 1 0\n  @PPAR 1 2 1 0 0\n",
     "the pick-ups go in a circle: surface 2 follows surface 2, which follows it", NULL},
};

/*
 * The stop at the first surface: a chief ray of 10 degrees has the slope tan 10/1.5 behind it, and
 * 4 tan 10/1.5 at the second one, of c = -0.02.
 */
static void check_chief(void)
{
    struct fixture fixture;
    long line;
    int column;
    fixture_open(&fixture, "chief.zmx");
    const char *text = "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.5 0\n"
                       "SURF 2\n  CURV -0.02\n  DISZ 0\n  CHZH 10\n";
    struct text file = case_file(&fixture, good, PARAXIAL, text, &line, &column);
    const double slope = 0.17632698070846497347, y = 4 * slope / 1.5;
    CHECK(foreign_read(&fixture.job, file, &fixture.lens, &fixture.error));
    CHECK_RELATIVE(fixture.lens.surfaces[1].thickness.value.hi, (10 - y) / (slope - 0.01 * y),
                   1e-15, "CHZH");
    CHECK(fixture.lens.note_count == 1 &&
          strstr(fixture.lens.notes[0], "by its solve, the file had 0") != NULL);
    arena_free(&fixture.arena);
}

/* n' u' = n u - h/f at the height h, for any ray: [BornWolf99] 4.3 of one plane. */
static void check_rays(void)
{
    static const char *const media[] = {"", "  GLAS ___BLANK 1 0 1.33 0\n"};
    for (int which = 0; which < 2; which++) {
        struct fixture fixture;
        struct system system;
        struct system_options options = system_options_default();
        fixture_open(&fixture, "rays.zmx");
        const char *text =
            arena_printf(&fixture.arena,
                         "UNIT MM\nSURF 0\n  DISZ INFINITY\nSURF 1\n  DISZ 20\nSURF 2\n"
                         "  TYPE PARAXIAL\n  PARM 1 -30\n  DISZ 50\n%sSURF 3\n  DISZ 0\n",
                         media[which]);
        const double n = which == 0 ? 1 : 1.33;
        options.image = 50;
        bool read =
            foreign_read(&fixture.job, text_of(text), &fixture.lens, &fixture.error) &&
            system_compile(&fixture.lens, 0.55, &options, &fixture.arena, &system, &fixture.error);
        CHECK(read);
        for (int i = 0; i < 20 && read; i++) {
            const double x = 3 - 0.3 * i, y = 0.2 * i, p = 0.9 - 0.04 * i, q = 0.02 * i - 0.5;
            const double length = sqrt(1 + p * p + q * q), h = x + 20 * p, k = y + 20 * q;
            const struct ray start = {.point = {x, y, 0},
                                      .cosine = {p / length, q / length, 1 / length}};
            struct rays rays = rays_new(&fixture.arena, 1);
            rays_set(&rays, 0, system.index_first, &start);
            rays_trace(&system, &rays, NULL);
            const struct ray end = rays_get(&rays, 0, system.index_last);
            CHECK(end.status == RAY_OK);
            CHECK_NEAR(end.point[0], h + 50 * (p + h / 30) / n, 1e-12, "x in the image");
            CHECK_NEAR(end.point[1], k + 50 * (q + k / 30) / n, 1e-12, "y in the image");
        }
        arena_free(&fixture.arena);
    }
}

/* What is written is read as the same lens, in all units. */
static void check_written_again(void)
{
    static const char *const units[] = {"mm", "in", "m"};
    for (int i = 0; i < 3; i++) {
        struct fixture fixture;
        struct text text = {NULL, 0};
        struct lens again;
        fixture_open(&fixture, "again");
        const char *lens = arena_printf(&fixture.arena,
                                        "unit %s\nfield angle 0 10\naperture epd 10\nfocus table\n"
                                        "surface - 20 1.5/60 - stop\nthick 0.1 50 air 8\n",
                                        units[i]);
        bool same =
            foreign_read(&fixture.job, text_of(lens), &fixture.lens, &fixture.error) &&
            foreign_write(&fixture.job, &zemax_format, &fixture.lens, &text, &fixture.error) &&
            foreign_read(&fixture.job, text, &again, &fixture.error);
        CHECK(same);
        if (same) {
            const struct surface *was = &fixture.lens.surfaces[1], *is = &again.surfaces[1];
            CHECK(is->kind == SURFACE_THICK && is->focal.value.hi == was->focal.value.hi &&
                  is->focal.value.lo == was->focal.value.lo && is->hiatus.value.hi == 0 &&
                  is->thickness.value.hi == was->thickness.value.hi &&
                  is->diameter.value.hi == was->diameter.value.hi);
        } else {
            printf("%s: %s\n", units[i], fixture.error.message);
        }
        arena_free(&fixture.arena);
    }
}

#define GLASS(name)                                                                                \
    "SURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS " name "\nSURF 2\n  CURV -0.02\n  DISZ 90\n"

static const struct meaning of_environment[] = {
    {PARAXIAL, "ENVD 20 1 1\n" GLASS("N-BK7"), "surface 50 4 SCHOTT:N-BK7 - stop"},
    {PARAXIAL, "ENVD 40 0.5 0\n" GLASS("N-BK7"), "surface 50 4 SCHOTT:N-BK7 - stop"},
    {PARAXIAL, "ENVD 40 0.5 1\n" GLASS("___BLANK 1 0 1.5 60"), "surface 50 4 1.5/60 - stop"},
    {PARAXIAL, "ENVD 40 0.5 1\n" GLASS("N-BK7"),
     "note line 15: the indices of SCHOTT:N-BK7 at 40 C and 0.5 atmospheres"},
    /* a wavelength that FTYP does not count */
    {PARAXIAL, "WAVM 2 200 1\nENVD 40 0.5 1\n" GLASS("N-BK7"),
     "note line 16: the indices of SCHOTT:N-BK7 at 40 C and 0.5 atmospheres"},
};

static const struct refusal of_no_data[] = {
    {PARAXIAL, "ENVD 40 1 1\n" GLASS("@PMMA 0 0 1.490595 58.005"),
     "the index at 40 C and 1 atmospheres (the catalogue gives no dn/dT of MISC:PMMA)",
     "that of the catalogue is kept"},
};

/*
 * N-BK7 in air of T and p, by a program of its own: the maker's formula at the wavelength that the
 * file's has in air of 20 C, Kohlrausch's air, and the maker's change in vacuum. Beside the file's
 * wavelength and the lines, a parabola goes between them.
 */
static void check_indices(void)
{
    static const struct {
        const char *environment;
        double wavelength, index, tolerance;
    } cases[] = {
        {"ENVD 20 0 1\n", 0.55, 1.5189446251499588, 4e-16},
        {"ENVD 40 1 1\n", 0.55, 1.5185816350991548, 4e-16},
        {"ENVD -30 0.5 1\n", 0.55, 1.5186331340439905, 4e-16},
        {"ENVD -30 0.5 1\n", 0.4861327, 1.5224786649854414, 4e-16},
        {"ENVD 20 0 1\n", 0.6562725, 1.5147390696815377, 4e-16},
        {"ENVD 40 1 1\n", 0.6, 1.5163513344133994, 1e-7},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        long line;
        int column;
        struct pair index = {NAN, NAN};
        fixture_open(&fixture, "air.zmx");
        const char *now =
            arena_printf(&fixture.arena, "%s%s", cases[i].environment, GLASS("N-BK7"));
        struct text file = case_file(&fixture, good, PARAXIAL, now, &line, &column);
        CHECK(foreign_read(&fixture.job, file, &fixture.lens, &fixture.error) &&
              medium_index(&fixture.lens.surfaces[0].medium, cases[i].wavelength, &index,
                           &fixture.error));
        CHECK_RELATIVE(index.hi, cases[i].index, cases[i].tolerance, cases[i].environment);
        arena_free(&fixture.arena);
    }
}

/* The same air, in the second of two configurations. */
static void check_configurations(void)
{
    static const struct {
        const char *settings;
        double index;
    } cases[] = {
        {"TEMP 0 1 20\nTEMP 0 2 40\n", 1.5185816350991548},
        {"PRES 0 1 1\nPRES 0 2 0\n", 1.5189446251499588},
        {"TEMP 0 1 20\nTEMP 0 2 -30\nPRES 0 1 1\nPRES 0 2 0.5\n", 1.5186331340439905},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        long line;
        int column;
        struct pair index = {NAN, NAN};
        fixture_open(&fixture, "airs.zmx");
        struct text file =
            case_file(&fixture, good, PARAXIAL, "ENVD 20 1 1\n" GLASS("N-BK7"), &line, &column);
        file = text_of(arena_printf(&fixture.arena, "%.*sMNUM 2\n%s", (int)file.length, file.start,
                                    cases[i].settings));
        CHECK(foreign_read(&fixture.job, file, &fixture.lens, &fixture.error));
        const struct lens *second = lens_at_position(&fixture.lens, 1, &fixture.arena);
        CHECK(medium_index(&second->surfaces[0].medium, 0.55, &index, &fixture.error));
        CHECK_RELATIVE(index.hi, cases[i].index, 4e-16, cases[i].settings);
        arena_free(&fixture.arena);
    }
}

int main(void)
{
    check_configurations();
    check_meanings("paraxial.zmx", good, CASES(of_paraxial));
    check_refusals("paraxial.zmx", good, CASES(of_wrong_paraxial));
    check_meanings("kept.zmx", good, CASES(of_kept));
    check_refusals("lost.zmx", good, CASES(of_lost));
    check_refusals("circle.zmx", good, CASES(of_circles));
    check_chief();
    check_meanings("environment.zmx", good, CASES(of_environment));
    check_refusals("environment.zmx", good, CASES(of_no_data));
    check_indices();
    check_rays();
    check_written_again();
    return check_report();
}
