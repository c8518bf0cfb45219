/* tests/unit/test_perturbation.c - the independent errors that tolerances are. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/perturbation.h"

#include "check.h"
#include "file/lens_tolerance.h"
#include "lens_of.h"

/* A cemented pair with a plane behind, a stop, a single lens with an asphere. */
#define LENS                                                                                       \
    "surface 50 5 1.5/60 20\nsurface -50 3 1.6/40 20\nsurface - 6 air 20\nstop - 2 air 10\n"       \
    "surface 70 4 1.5 24 k=-1.5 A4=1e-6\nsurface -70 60 air 22\n"
/* Mirrors, a window between them, a space of 0 and a surface without a diameter. */
#define MIRRORS                                                                                    \
    "surface -200 -50 mirror 40\nsurface - -2 1.5/60 20\nsurface - -40 air -\n"                    \
    "surface 90 0 mirror 10\nsurface - 80 air 20\n"

/* Without diameters, with a stop that is near. */
#define BARE                                                                                       \
    "surface 50 5 1.5 -\nsurface -50 0.01 air -\nstop - 2 air 5\nsurface 30 3 1.5 -\n"             \
    "surface -30 20 air -\n"

/* A zoom: a gap that is 0 in one position, one that is narrow in the other. */
#define ZOOM                                                                                       \
    "position wide tele\nlet d2 0 9\nlet d4 8 0.5\nsurface 50 3 1.5 20\nsurface -50 d2 air 20\n"   \
    "surface -40 3 1.5 20\nsurface 40 d4 air 20\nsurface 60 3 1.5 20\nsurface -60 50 air 20\n"

/* "R1 0.05, R2 0.05": each with what it is half the range of. */
static const char *list_of(const struct perturbations *all, struct arena *arena)
{
    const char *text = "";
    for (size_t i = 0; i < all->count; i++) {
        const struct perturbation *one = &all->list[i];
        text = arena_printf(arena, "%s%s%s %.9g", text, i > 0 ? ", " : "", one->name, one->amount);
    }
    return text;
}

/* Tolerances of a lens, by hand; `grade` in the same words. */
static const struct sample {
    const char *lens, *grade, *marks, *expected;
} samples[] = {
    /* shares, of what has a radius; both ways around mirrors */
    {LENS, NULL, "R1..R6 0.1%", "R1 0.05, R2 0.05, R5 0.07, R6 0.07"},
    {MIRRORS, NULL, "R1..R5 0.1%", "R1 0.2, R4 0.09"},
    /* an airspace that the stop divides has one, on its wider gap */
    {LENS, NULL, "t1..t6 1%", "t1 0.05, t2 0.03, t5 0.04, t3 0.08"},
    {MIRRORS, NULL, "t1..t5 1%", "t2 0.02, t1 0.5, t3 0.4"},
    {LENS, NULL, "n1..n6 0.001\nV1..V6 1%", "n1 0.001, n2 0.001, n5 0.001, V1 0.6, V2 0.4"},
    {LENS, NULL, "surface 1..6 conic 10%\nA4_1..A4_6 1%", "k5 0.15, A4_5 1e-08"},
    /* the nearer one: a single thing, then air, then the range */
    {LENS, NULL, "t1..t5 0.02\nsurface 1..5 air 0.01\nt4 5um",
     "t1 0.02, t2 0.02, t5 0.02, t4 0.005"},
    /* whatever stands first */
    {LENS, NULL, "t4 5um\nsurface 1..5 air 0.01\nt1..t5 0.02",
     "t1 0.02, t2 0.02, t5 0.02, t4 0.005"},
    {LENS, NULL, "surface 1..5 air 0.01\nt4 5um\nt1..t5 0.02",
     "t1 0.02, t2 0.02, t5 0.02, t4 0.005"},
    {LENS, NULL, "t1..t5 0.02\nsurface 1..5 air 0.01", "t1 0.02, t2 0.02, t5 0.02, t3 0.01"},
    {LENS, NULL, "surface 1..5 air 0.01\nt1..t5 0.02", "t1 0.02, t2 0.02, t5 0.02, t3 0.01"},
    /* a stop may pass the vertex beside it */
    {BARE, NULL, "t1..t5 0.1", "t1 0.1, t4 0.1, t3 0.1"},
    {ZOOM, NULL, "t3..t4 0.1", "t3 0.1, t4 0.1"},
    /* fringes: roots of the sag by mpmath, 30 digits; half a wave each */
    {LENS, NULL, "R1 3fringes", "R1 1.58889651e-05"},
    {LENS, NULL, "R3 3fringes", "R3 1.63820999e-05"},
    {LENS, NULL, "surface 3..5 irregularity 0.5fringes",
     "surface 3 irregularity 0deg 0.25, surface 3 irregularity 45deg 0.25, "
     "surface 3 irregularity spherical 0.25, surface 5 irregularity 0deg 0.25, "
     "surface 5 irregularity 45deg 0.25, surface 5 irregularity spherical 0.25"},
    /* angles in rad; a runout over 20 mm and over the larger of 24 and 22 mm */
    {LENS, NULL, "surface 2 tilt 3.6deg",
     "surface 2 tilt x 0.0628318531, surface 2 tilt y "
     "0.0628318531"},
    {LENS, NULL, "elements 1..6 wedge 0.012mm",
     "element 1..3 wedge x 0.0006, element 1..3 wedge y 0.0006, element 5..6 wedge x 0.0005, "
     "element 5..6 wedge y 0.0005"},
    {LENS, NULL, "elements 1..6 decenter 0.02",
     "element 1..3 decenter x 0.02, element 1..3 decenter y 0.02, element 5..6 decenter x 0.02, "
     "element 5..6 decenter y 0.02"},
    {LENS, NULL, "element 1..6 decenter 0.02\nfocus 0.1",
     "element 1..6 decenter x 0.02, element 1..6 decenter y 0.02, focus 0.1"},
    {MIRRORS, NULL, "elements 1..5 decenter 1um",
     "element 1 decenter x 0.001, element 1 decenter y 0.001, element 2..3 decenter x 0.001, "
     "element 2..3 decenter y 0.001, element 4 decenter x 0.001, element 4 decenter y 0.001"},
    /* marks go before the grade; its fringes are for planes */
    {LENS, "R1..R6 0.1%\nR1..R6 3fringes\nt1..t6 0.1\nsurface 1..6 air 0.05",
     "t1 0.01\nt2..t3 0.02",
     "R1 0.05, R2 0.05, R3 1.63820999e-05, R5 0.07, R6 0.07, t1 0.01, t2 0.02, t5 0.1, t3 0.02"},
    {LENS, "surface 1..6 air 0.05\nt1..t6 0.1\nR1..R6 3fringes\nR1..R6 0.1%",
     "t2..t3 0.02\nt1 0.01",
     "R1 0.05, R2 0.05, R3 1.63820999e-05, R5 0.07, R6 0.07, t1 0.01, t2 0.02, t5 0.1, t3 0.02"},
    {LENS, "R1 0.1%\nR1 0.2%\nR5 0.4%\nR5 0.2%", "t1 0.01", "R1 0.05, R5 0.28, t1 0.01"},
};

/* Lines with `tolerance` before each. */
static struct tolerances tolerances_of(const char *lines, const struct lens *lens,
                                       const char *source, struct arena *arena)
{
    struct text_buffer file = {.arena = arena};
    struct text rest = text_of(lines);
    struct tolerances tolerances = {0};
    struct error error = {.code = ERROR_NONE};
    while (rest.start != NULL) {
        const struct text line = text_cut(&rest, '\n');
        growing_format(&file, "tolerance %.*s\n", (int)line.length, line.start);
    }
    CHECK(lens_tolerances_read(source, growing_done(&file), lens, arena, &tolerances, &error));
    return tolerances;
}

static bool perturb(const struct sample *sample, struct arena *arena, struct perturbations *all,
                    struct error *error)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    *lens = lens_of(sample->lens, arena);
    struct perturbation_wish wish = {.grade = "fine"};
    *error = (struct error){.code = ERROR_NONE};
    if (sample->grade != NULL) {
        wish.of_grade = tolerances_of(sample->grade, lens, "grades.tsv", arena);
    }
    if (sample->marks != NULL) {
        wish.marks = tolerances_of(sample->marks, lens, "marks", arena);
    }
    return perturbations_of(lens, &wish, arena, all, error);
}

static void test_amounts(void)
{
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        struct arena arena = {0};
        struct perturbations all;
        struct error error;
        CHECK(perturb(&samples[i], &arena, &all, &error));
        CHECK_TEXT(error.code == ERROR_NONE ? list_of(&all, &arena) : error.message,
                   samples[i].expected);
        arena_free(&arena);
    }
}

/* What each is of, and how it is spread. */
static void test_numbers(void)
{
    struct arena arena = {0};
    struct perturbations all;
    struct error error;
    const struct sample radius = {LENS, "R1..R6 1fringes\nV1..V6 1%", "R5 1% normal 3sigma", ""};
    CHECK(perturb(&radius, &arena, &all, &error));
    CHECK(all.list[0].what.kind == PARAMETER_CURVATURE && all.list[0].what.surface == 0);
    CHECK(all.list[3].what.kind == PARAMETER_RADIUS && all.list[3].what.surface == 4);
    CHECK(all.list[3].spread.distribution == DISTRIBUTION_NORMAL && all.list[3].spread.sigmas == 3);
    CHECK_TEXT(all.won, "R5");
    CHECK_TEXT(all.left_out, "V5");
    const struct sample tilt = {LENS, NULL,
                                "surface 2 tilt 1\nsurface 2 decenter 1mm\n"
                                "element 5..6 wedge 1arcmin\nelement 1..3 wedge 1 "
                                "pivot 1",
                                ""};
    CHECK(perturb(&tilt, &arena, &all, &error));
    CHECK(all.count == 8 && all.won == NULL && all.left_out == NULL);
    CHECK(all.list[0].what.kind == PARAMETER_TILT_X && all.list[0].axis == PERTURBATION_X);
    CHECK(all.list[1].what.kind == PARAMETER_TILT_Y && all.list[1].axis == PERTURBATION_Y);
    CHECK(all.list[3].what.kind == PARAMETER_DECENTER_Y && all.list[3].what.surface == 1);
    CHECK(all.list[4].what.kind == PARAMETER_TILT_X && all.list[4].what.surface == 0);
    CHECK(all.list[7].what.kind == PARAMETER_TILT_Y && all.list[7].what.surface == 5);
    arena_free(&arena);
}

/* From the vertex of the first surface: the middle, a vertex, a centre of curvature. */
static void test_pivots(void)
{
    static const struct {
        const char *marks;
        double pivot;
    } pivots[] = {
        {"element 1..3 tilt 1", 4},           {"element 1..3 tilt 1 pivot 2", 5},
        {"element 5..6 tilt 1 pivot 1", -16}, {"element 5..6 tilt 1 pivot 6", 4},
        {"element 1..3 roll 1", 50},          {"element 1..3 roll 1 pivot 2", -45},
        {"element 1..6 tilt 1", 10},          {"element 5..6 roll 1 pivot 6", -66},
    };
    for (size_t i = 0; i < sizeof pivots / sizeof *pivots; i++) {
        struct arena arena = {0};
        struct perturbations all;
        struct error error;
        const struct sample sample = {LENS, NULL, pivots[i].marks, ""};
        CHECK(perturb(&sample, &arena, &all, &error));
        CHECK_NEAR(all.list[0].pivot, pivots[i].pivot, 1e-12, pivots[i].marks);
        CHECK(all.list[1].kind == TOLERANCE_ELEMENT_TILT && all.list[1].axis == PERTURBATION_Y);
        arena_free(&arena);
    }
}

/* What cannot be; the mark is the second line of its file. */
static const struct sample refused[] = {
    {LENS, NULL, "R1 1%\nR1 2%",
     "the tolerance of R1 cannot be: it has one already, in line 1 of "
     "marks"},
    {LENS, NULL, "t3 0.1\nt4 0.1",
     "the tolerance of t4 cannot be: its airspace, which the stop does not divide, has one "
     "already, in line 1 of marks"},
    {LENS, NULL, "R1 1%\nR3 2%",
     "the tolerance of R3 cannot be: a plane has no radius: its "
     "tolerance is in fringes"},
    {LENS, NULL, "R1 1%\nR4 2%",
     "the tolerance of R4 cannot be: the surface has no shape of its "
     "own"},
    {LENS, NULL, "R1 1%\nR2 60mm",
     "the tolerance of R2 cannot be: it is as wide as the number "
     "itself, 50"},
    {LENS, NULL, "R1 1%\nt2 3",
     "the tolerance of t2 cannot be: it is as wide as the number "
     "itself, 3"},
    {LENS, NULL, "R1 1%\nt6 1",
     "the tolerance of t6 cannot be: that is the image's distance: its "
     "tolerance is that of the focus"},
    {LENS, NULL, "R1 1%\nsurface 2 air 1",
     "the tolerance of t2 cannot be: there is no air behind "
     "the surface"},
    {LENS, NULL, "R1 1%\nn3 0.1",
     "the tolerance of n3 cannot be: there is no glass behind the "
     "surface"},
    {LENS, NULL, "R1 1%\nV5 1",
     "the tolerance of V5 cannot be: the medium behind it has no Abbe "
     "number"},
    {LENS, NULL, "R1 1%\nk1 1%", "the tolerance of k1 cannot be: it is 0 there"},
    {LENS, NULL, "R1 1%\nelement 1..2 tilt 1",
     "the tolerance of element 1..2 tilt cannot be: it "
     "is a part of the element 1..3"},
    {LENS, NULL, "R1 1%\nelement 4 tilt 1",
     "the tolerance of element 4 tilt cannot be: there is "
     "no element"},
    {LENS, NULL, "R1 1%\nelement 1..3 roll 1 pivot 3",
     "the tolerance of element 1..3 roll cannot be: surface 3 is plane: on it the element shifts, "
     "which is 'decenter'"},
    {LENS, NULL, "R1 1%\nelement 1..3 wedge 1 pivot 5",
     "the tolerance of element 1..3 wedge cannot be: surface 5 is none of the element's"},
    {LENS, NULL, "R1 1%\nR2 99999fringes",
     "the tolerance of R2 cannot be: so many fringes lead "
     "beyond the edge of the surface's sphere"},
    {MIRRORS, NULL, "R1 1%\nR3 1fringe",
     "the tolerance of R3 cannot be: surface 3 without a "
     "diameter, which fringes are counted over"},
    {MIRRORS, NULL, "R1 1%\nsurface 1..5 irregularity 1fringe",
     "the tolerance of surface 3 irregularity cannot be: surface 3 without a diameter, which the "
     "irregularity is over"},
    {MIRRORS, NULL, "R1 1%\nelements 1..5 wedge 0.01mm",
     "the tolerance of element 2..3 wedge cannot be: surface 3 without a diameter, which the "
     "runout "
     "is measured over"},
    {MIRRORS, "surface 1..5 irregularity 1fringe", NULL,
     "the tolerance of surface 3 irregularity in grade fine cannot be: surface 3 without a "
     "diameter, "
     "which the irregularity is over"},
    {BARE, "surface 1..5 irregularity 1fringe", NULL,
     "the tolerance of surface 1 irregularity in grade fine cannot be: surfaces 1, 2, 4 and 5 "
     "without a diameter, which the irregularity is over"},
    {BARE, NULL, "t1 1\nR2 1fringe",
     "the tolerance of R2 cannot be: surface 2 without a diameter, which fringes are counted over"},
    /* words of the positions: the narrowest counts */
    {ZOOM, NULL, "R1 1%\nt4 0.6",
     "the tolerance of t4 cannot be: it is as wide as the number itself, 0.5"},
    {ZOOM, NULL, "R1 1%\nt1..t4 0.1",
     "the tolerance of t2 cannot be: it is as wide as the number itself, 0"},
    {ZOOM, NULL, "R1 1%\nt4 1%",
     "the tolerance of t4 cannot be: a word of the positions has no one number to take a share of: "
     "give it in mm"},
    {LENS, "t1..t5 4", NULL,
     "the tolerance of t2 in grade fine cannot be: it is as wide as the "
     "number itself, 3"},
    {LENS, NULL, NULL, "nothing of the lens has a tolerance"},
};

static void test_refused(void)
{
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        struct arena arena = {0};
        struct perturbations all;
        struct error error;
        const bool is_mark = refused[i].marks != NULL;
        CHECK(!perturb(&refused[i], &arena, &all, &error));
        CHECK_TEXT(error.message, refused[i].expected);
        CHECK(error.code == (is_mark ? ERROR_DATA : ERROR_DOMAIN));
        CHECK(error.line == (is_mark ? 2 : 0) && error.column == (is_mark ? 11 : 0));
        arena_free(&arena);
    }
}

/* An astigmatism has its size and an azimuth; its moments, by sums over many. */
static void check_errors(void)
{
    enum { COUNT = 200, TURNS = 16 };
    const struct spread even = spread_of(DISTRIBUTION_UNIFORM, 2);
    const struct perturbation list[] = {
        {.kind = TOLERANCE_RADIUS, .spread = even},
        {.kind = TOLERANCE_IRREGULARITY, .axis = PERTURBATION_X, .spread = even},
        {.kind = TOLERANCE_IRREGULARITY, .axis = PERTURBATION_Y, .spread = even},
        {.kind = TOLERANCE_IRREGULARITY, .spread = even}};
    double second = 0, fourth = 0;
    for (int i = 0; i < COUNT; i++) {
        for (int k = 0; k < TURNS; k++) {
            const double size = (i + 0.5) / COUNT, turn = (k + 0.25) / TURNS;
            const double units[] = {0.75, size, turn, 0.125};
            double errors[4];
            perturbation_errors(list, 4, units, errors);
            CHECK(errors[0] == 0.5 && errors[3] == -0.75);
            CHECK_NEAR(hypot(errors[1], errors[2]), fabs(2 * size - 1), 1e-15, "size");
            CHECK_NEAR(errors[1], (2 * size - 1) * cos(8 * atan(1) * turn), 1e-15, "0 degrees");
            second += errors[2] * errors[2] / (COUNT * TURNS);
            fourth += pow(errors[2], 4) / (COUNT * TURNS);
        }
    }
    const struct perturbation_moments moments = perturbation_moments(&list[2]);
    CHECK_NEAR(second, moments.second, 1e-5, "second moment");
    CHECK_NEAR(fourth, moments.fourth, 1e-5, "fourth moment");
    CHECK_NEAR(perturbation_moments(&list[3]).second, 1.0 / 3, 1e-15, "of a spherical form");
    CHECK_NEAR(perturbation_moments(&list[3]).fourth, 1.0 / 5, 1e-15, "of a spherical form");
    CHECK_NEAR(perturbation_moments(&list[0]).second, 1.0 / 3, 1e-15, "of a radius");
    CHECK_NEAR(perturbation_moments(&list[0]).fourth, 1.0 / 5, 1e-15, "of a radius");
}

int main(void)
{
    test_amounts();
    test_numbers();
    test_pivots();
    test_refused();
    check_errors();
    return check_report();
}
