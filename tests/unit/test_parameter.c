/* tests/unit/test_parameter.c - names, numbers, scaling and reversal of what may change. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_change.h"
#include "file/lens_file.h"
#include "lens_of.h"
#include "optics/parameter.h"

static struct arena arena;

static struct parameter named(const char *name)
{
    struct parameter parameter;
    struct error error;
    CHECK(parameter_read(text_of(name), NULL, &parameter, &error));
    return parameter;
}

static void check_names(void)
{
    static const struct {
        const char *name;
        struct parameter expected;
    } cases[] = {
        {"R1", {0, PARAMETER_RADIUS, 0}},
        {"c12", {11, PARAMETER_CURVATURE, 0}},
        {"t3", {2, PARAMETER_THICKNESS, 0}},
        {"k999999", {999998, PARAMETER_CONIC, 0}},
        {"A4_2", {1, PARAMETER_COEFFICIENT, 4}},
        {"A20_11", {10, PARAMETER_COEFFICIENT, 20}},
        {"f1", {0, PARAMETER_FOCAL, 0}},
        {"hiatus1", {0, PARAMETER_HIATUS, 0}},
        {"n2", {1, PARAMETER_INDEX, 0}},
        {"V2", {1, PARAMETER_ABBE, 0}},
        {"glass2", {1, PARAMETER_GLASS, 0}},
        {"decenter_x4", {3, PARAMETER_DECENTER_X, 0}},
        {"tilt_z4", {3, PARAMETER_TILT_Z, 0}},
        {"bend_decenter_y4", {3, PARAMETER_BREAK_DECENTER_Y, 0}},
        {"bend_tilt_x4", {3, PARAMETER_BREAK_TILT_X, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct parameter *expected = &cases[i].expected, read = named(cases[i].name);
        CHECK(read.surface == expected->surface && read.kind == expected->kind &&
              read.order == expected->order);
        CHECK_TEXT(parameter_write(*expected, &arena), cases[i].name);
    }
    struct parameter spaced = named("R_7");
    CHECK(spaced.kind == PARAMETER_RADIUS && spaced.surface == 6);
    /* every one there is, in every order */
    size_t count = 0;
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        each.surface = 41;
        struct parameter again = named(parameter_write(each, &arena));
        CHECK(again.surface == 41 && again.kind == each.kind && again.order == each.order);
        enum parameter_kind kind;
        int order;
        CHECK(parameter_name_read(text_of(parameter_name(each.kind, each.order, &arena)), &kind,
                                  &order) &&
              kind == each.kind && order == each.order);
        CHECK(parameter_type(each.kind)->words[0] != '\0');
        count++;
    }
    CHECK(count == PARAMETER_KINDS - 1 + LENS_COEFFICIENTS);
}

static void check_refused_names(void)
{
    static const struct {
        const char *name, *message, *hint;
    } cases[] = {
        {"Q1", "'Q1' names nothing", ""},
        {"", "'' names nothing", ""},
        {"7", "'7' names nothing", ""},
        {"R", "'R' names nothing", ""},
        {"r1", "'r1' names nothing", "did you mean 'R1'?"},
        {"N12", "'N12' names nothing", "did you mean 'n12'?"},
        {"radius3", "'radius3' names nothing", "did you mean 'R3'?"},
        {"thicknes3", "'thicknes3' names nothing", "did you mean 't3'?"},
        {"index2", "'index2' names nothing", "did you mean 'n2'?"},
        {"tlit_x2", "'tlit_x2' names nothing", "did you mean 'tilt_x2'?"},
        {"A42", "'A42' names nothing", "did you mean 'A4_2'?"},
        {"A105", "'A105' names nothing", "did you mean 'A10_5'?"},
        {"A1012", "'A1012' names nothing", "did you mean 'A10_12'?"},
        {"A21_2", "'A21_2' names nothing", ""},
        {"A22_1", "'A22_1' names nothing", ""},
        {"A0_1", "'A0_1' names nothing", ""},
        {"A04_1", "'A04_1' names nothing", ""},
        {"R0", "surfaces are counted from 1", ""},
        {"R1234567", "'R1234567': surfaces are counted from 1 to 999999", ""},
        {"R-1", "names nothing", ""},
        {"R1.5", "names nothing", ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct parameter parameter;
        struct error error = {0};
        CHECK(!parameter_read(text_of(cases[i].name), NULL, &parameter, &error));
        bool said = strstr(error.message, cases[i].message) != NULL &&
                    strstr(error.hint, cases[i].hint) != NULL;
        CHECK(said && error.code == ERROR_USAGE);
        if (!said) {
            printf("%s: %s, %s\n", cases[i].name, error.message, error.hint);
        }
    }
}

static bool is_radius(enum parameter_kind kind)
{
    return kind == PARAMETER_RADIUS;
}

/* Only what the caller takes is suggested to it; what it does not take is read all the same. */
static void check_suggestions(void)
{
    static const struct {
        const char *name, *hint;
    } cases[] = {
        {"r1", "did you mean 'R1'?"},    {"v1", ""}, {"A42", ""}, {"konic3", ""}, {"index2", ""},
        {"radiu2", "did you mean 'R2'?"}};
    struct parameter parameter;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct error error = {0};
        CHECK(!parameter_read(text_of(cases[i].name), is_radius, &parameter, &error));
        CHECK_TEXT(error.hint, cases[i].hint);
    }
    struct error error = {0};
    CHECK(parameter_read(text_of("V1"), is_radius, &parameter, &error) &&
          parameter.kind == PARAMETER_ABBE);
}

/* A surface of every kind, in the order of enum surface_kind, and one that has all it may have. */
static const char kinds[] = "medium 1.33\n"
                            "surface 50 6 1.67/47.1 30\n"
                            "surface -200 -8 mirror 30\n"
                            "stop - -4 1.5 10\n"
                            "thick 70 -30 air 30 hiatus=-3\n"
                            "bend decenter=1,2 tilt=3,4,5\n"
                            "surface - 10 N-BK7 20 c=0.02 k=-1 A2=1e-4 A4=1e-5 A20=1e-30 "
                            "decenter=0.1,0.2 tilt=1,2\n"
                            "surface - - air -\n";

/* What each kind of surface has, by hand. */
static void check_kinds(void)
{
    static const char all[] = " t decenter_x decenter_y tilt_x tilt_y tilt_z bend_decenter_x "
                              "bend_decenter_y bend_tilt_x bend_tilt_y bend_tilt_z ";
    static const char *const own[] = {" R c k A n V glass ", " R c k A ", " n V glass ",
                                      " f hiatus n V glass "};
    static const char *const marks[] = {
        "R, c, t, k, A4, glass, dx, dy, ax or ay", "R, c, t, k, A4, dx, dy, ax or ay",
        "t, glass, dx, dy, ax or ay", "t, focal, glass, dx, dy, ax or ay"};
    const struct lens lens = lens_of(kinds, &arena);
    for (size_t i = 0; i < 4; i++) {
        const struct surface *surface = &lens.surfaces[i];
        CHECK(surface->kind == (enum surface_kind)i);
        for (struct parameter each = {i, PARAMETER_RADIUS, 0}; each.kind < PARAMETER_KINDS;
             each = parameter_next(each)) {
            const char *word = arena_printf(&arena, " %s ", parameter_type(each.kind)->name);
            bool has = strstr(all, word) != NULL || strstr(own[i], word) != NULL;
            bool suits = parameter_suits(each.kind, surface);
            CHECK(suits == has);
            if (suits != has) {
                printf("surface %zu:%s\n", i + 1, word);
            }
            struct error error = {0};
            bool number = each.kind != PARAMETER_ABBE || i == 0;
            CHECK(parameter_check(&lens, each, &error) == (has && number));
        }
        CHECK_TEXT(parameter_marks(surface, &arena), marks[i]);
    }
}

static void check_refused(const char *text, const char *name, const char *message)
{
    const struct lens lens = lens_of(text, &arena);
    struct error error = {0};
    CHECK(!parameter_check(&lens, named(name), &error) && error.code == ERROR_DOMAIN);
    CHECK_TEXT(error.message, message);
}

static void check_refused_lenses(void)
{
    check_refused(kinds, "R7", "there is no radius 7 to vary: the lens has 6 surfaces");
    check_refused(kinds, "R3", "surface 3 has no radius to vary");
    check_refused(kinds, "k4", "surface 4 has no conic to vary");
    check_refused(kinds, "f1", "surface 1 has no focal length to vary");
    check_refused(kinds, "n2", "surface 2 has no index to vary");
    check_refused(kinds, "t6", "the lens states no thickness behind surface 6");
    check_refused(kinds, "n5",
                  "the medium N-BK7 after surface 5 has no index of its own to vary: only a number "
                  "or nd/Vd has");
    check_refused(kinds, "V3",
                  "the medium 1.5 after surface 3 has no Abbe number of its own to vary: only "
                  "nd/Vd has");
    static const char zoom[] = "position wide tele\nlet d1 2 8\nsurface 50 d1 1.5 -\n"
                               "surface -50 - air -\n";
    check_refused(zoom, "t1",
                  "the thickness of surface 1 is d1, which has a number of its own in every "
                  "position");
}

/* Every number of every kind of surface: what is set is got, and nothing else changes. */
static void check_round_trips(void)
{
    const struct lens lens = lens_of(kinds, &arena);
    size_t tried = 0;
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        for (each.surface = 0; each.surface < 5; each.surface++) {
            struct error error;
            double value = 1.0 / 3 + (double)each.kind + each.order, before;
            if (each.kind == PARAMETER_GLASS || !parameter_check(&lens, each, &error)) {
                continue;
            }
            tried++;
            before = parameter_get(&lens, each);
            struct lens *to = parameter_apply(&lens, &each, &value, 1, &arena);
            CHECK(parameter_get(to, each) == value);
            CHECK(parameter_get(&lens, each) == before);
            for (struct parameter other = {each.surface, PARAMETER_RADIUS, 0};
                 other.kind < PARAMETER_KINDS; other = parameter_next(other)) {
                bool curve = each.kind <= PARAMETER_CURVATURE && other.kind <= PARAMETER_CURVATURE;
                bool same = (other.kind == each.kind && other.order == each.order) || curve;
                if (same || other.kind == PARAMETER_GLASS ||
                    !parameter_suits(other.kind, &lens.surfaces[other.surface])) {
                    continue;
                }
                CHECK(parameter_get(to, other) == parameter_get(&lens, other));
            }
            /* and what is written reads back */
            struct lens again;
            bool has_z = each.kind == PARAMETER_TILT_Z; /* which no file has */
            CHECK(lens_read("again", lens_write(to, &arena), NULL, &arena, &again, &error));
            CHECK_RELATIVE(parameter_get(&again, each), has_z ? 0.0 : value, 1e-15, "read again");
        }
    }
    CHECK(tried > 80);
}

static void check_numbers(void)
{
    const struct lens lens = lens_of(kinds, &arena);
    CHECK_NEAR(parameter_get(&lens, named("c1")), 0.02, 0, "1/50");
    CHECK_NEAR(parameter_get(&lens, named("R5")), 50, 0, "1/0.02");
    CHECK_NEAR(parameter_get(&lens, named("R6")), INFINITY, 0, "a plane");
    CHECK_NEAR(parameter_get(&lens, named("c6")), 0, 0, "a plane");
    CHECK_NEAR(parameter_get(&lens, named("A20_5")), 1e-30, 0, "A20");
    CHECK_NEAR(parameter_get(&lens, named("A6_5")), 0, 0, "not given");
    CHECK_NEAR(parameter_get(&lens, named("V1")), 47.1, 0, "Abbe number");
    CHECK_NEAR(parameter_get(&lens, named("bend_tilt_z5")), 0.08726646259971647884, 1e-17, "5 deg");
    CHECK_NEAR(parameter_get(&lens, named("tilt_y5")), 0.03490658503988659154, 1e-17, "2 deg");
    CHECK_NEAR(parameter_get(&lens, named("decenter_x1")), 0, 0, "centred");
    CHECK_NEAR(parameter_get(&lens, (struct parameter){LENS_NONE, PARAMETER_INDEX, 0}), 1.33, 0,
               "object space");
    /* a curvature as a radius, to the bits of a pair: 1/0.3 = 10/3 */
    const struct parameter some[] = {named("c1"), named("c5"), named("c6"),  named("R2"),
                                     named("n1"), named("t5"), named("A4_1")};
    const double values[] = {0.3, 0.3, 0.01, INFINITY, 1.7, 10, 1e-5};
    struct lens *to = parameter_apply(&lens, some, values, 7, &arena);
    CHECK(!to->surfaces[0].has_curvature && !to->surfaces[0].is_plane);
    CHECK_RELATIVE(parameter_get(to, named("R1")), 10.0 / 3, 2e-16, "R1");
    CHECK(to->surfaces[4].has_curvature && to->surfaces[4].curvature.value.hi == 0.3);
    CHECK_RELATIVE(parameter_get(to, named("R6")), 100.0, 2e-16, "no plane any more");
    CHECK(to->surfaces[1].is_plane && parameter_get(to, named("c2")) == 0);
    CHECK(to->surfaces[0].coefficients == 2 && lens.surfaces[0].coefficients == 0);
    CHECK(text_equal(to->surfaces[4].thickness.typed, "10")); /* the same: its digits stay */
    /* the mirror behind the glass stands in it */
    CHECK(text_equal(to->surfaces[0].medium.written, "1.7/47.1"));
    CHECK(to->surfaces[1].medium.index.hi == 1.7 && to->surfaces[2].medium.index.hi == 1.5);
    CHECK(text_equal(lens.surfaces[0].medium.written, "1.67/47.1"));
}

/* Against differences of what the derivative is of; n of nd/Vd is linear in nd and in 1/Vd. */
static void check_slopes(void)
{
    const struct lens lens = lens_of(kinds, &arena);
    CHECK_RELATIVE(parameter_slope(&lens, named("R1"), 0.5), -0.0004, 1e-15, "-1/50^2");
    CHECK_RELATIVE(parameter_slope(&lens, named("R5"), 0.5), -0.0004, 1e-15, "of a curvature");
    CHECK_NEAR(parameter_slope(&lens, named("R6"), 0.5), 0, 0, "of a plane");
    CHECK_NEAR(parameter_slope(&lens, named("c1"), 0.5), 1, 0, "itself");
    CHECK_NEAR(parameter_slope(&lens, named("n3"), 0.5), 1, 0, "a number");
    CHECK_NEAR(parameter_slope(&lens, named("bend_tilt_z5"), 0.5), 1, 0, "itself");
    CHECK(isnan(parameter_slope(&lens, named("f4"), 0.5)));
    CHECK(isnan(parameter_slope(&lens, named("glass1"), 0.5)));
    /* nd 1.67, Vd 47.1 at 486.1327 nm: n - nd = (nd - 1)/Vd (F - d)/(F - C) in 1/l^2 */
    const double d = 1 / (0.5875618 * 0.5875618), F = 1 / (0.4861327 * 0.4861327),
                 C = 1 / (0.6562725 * 0.6562725), share = (F - d) / (F - C) / 47.1;
    CHECK_RELATIVE(parameter_slope(&lens, named("n1"), 0.4861327), 1 + share, 1e-14, "dn/dnd");
    CHECK_RELATIVE(parameter_slope(&lens, named("V1"), 0.4861327), -0.67 * share / 47.1, 1e-12,
                   "dn/dVd");
}

static const struct vary *mark_of(const struct surface *surface, enum parameter_kind kind)
{
    for (size_t i = 0; i < surface->vary_count; i++) {
        if (surface->varies[i].kind == kind) {
            return &surface->varies[i];
        }
    }
    static const struct vary none = {.low = {.value = {NAN, 0}}, .high = {.value = {NAN, 0}}};
    const bool mark_is_there = false;
    CHECK(mark_is_there);
    return &none;
}

static void check_bounds(const struct surface *surface, enum parameter_kind kind, double low,
                         double high, const char *what)
{
    const struct vary *vary = mark_of(surface, kind);
    CHECK(vary->has_bounds);
    CHECK_RELATIVE(vary->low.value.hi, low, 1e-15, what);
    CHECK_RELATIVE(vary->high.value.hi, high, 1e-15, what);
}

static const char marked[] =
    "surface 50 6 1.5 - k=-1 A4=1e-5 A6=-2e-8 decenter=0.5,-0.25 tilt=3,-2 R~[40,60] t~[5,7] "
    "k~[-2,0] A4~[8e-6,1.6e-5]\n"
    "surface - 3 air - c=-0.02 c~[-0.04,-0.01]\n"
    "thick 100 50 air - hiatus=4 f~[90,120]\n"
    "surface - - air -\n";

/* Twice as large: lengths times 2, curvatures by 2, A4 by 8, A6 by 32; numbers and angles stay. */
static void check_scaling(void)
{
    const struct lens lens = lens_of(marked, &arena);
    const struct lens *to = lens_scaled(&lens, pair_of(2), false, &arena);
    static const struct {
        const char *name;
        double expected;
    } cases[] = {{"R1", 100},
                 {"t1", 12},
                 {"k1", -1},
                 {"A4_1", 1.25e-6},
                 {"A6_1", -6.25e-10},
                 {"decenter_x1", 1},
                 {"decenter_y1", -0.5},
                 {"tilt_x1", 0.05235987755982988731},
                 {"n1", 1.5},
                 {"c2", -0.01},
                 {"f3", 200},
                 {"hiatus3", 8},
                 {"t3", 100}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK_RELATIVE(parameter_get(to, named(cases[i].name)), cases[i].expected, 1e-15,
                       cases[i].name);
    }
    check_bounds(&to->surfaces[0], PARAMETER_RADIUS, 80, 120, "R~");
    check_bounds(&to->surfaces[0], PARAMETER_THICKNESS, 10, 14, "t~");
    check_bounds(&to->surfaces[0], PARAMETER_CONIC, -2, 0, "k~");
    check_bounds(&to->surfaces[0], PARAMETER_COEFFICIENT, 1e-6, 2e-6, "A4~");
    check_bounds(&to->surfaces[1], PARAMETER_CURVATURE, -0.02, -0.005, "c~");
    check_bounds(&to->surfaces[2], PARAMETER_FOCAL, 180, 240, "f~");
    static const char lengths[] = " R t f hiatus decenter_x decenter_y bend_decenter_x "
                                  "bend_decenter_y ";
    for (struct parameter each = {0}; each.kind < PARAMETER_KINDS; each = parameter_next(each)) {
        const char *word = arena_printf(&arena, " %s ", parameter_type(each.kind)->name);
        int expected = each.order > 0                     ? 1 - each.order
                       : each.kind == PARAMETER_CURVATURE ? -1
                       : strstr(lengths, word) != NULL    ? 1
                                                          : 0;
        CHECK(parameter_length(each.kind, each.order) == expected);
    }
}

/* Turned by half a turn about y: what points to x or z changes its sign. */
static void check_reversal(void)
{
    struct lens lens = lens_of(marked, &arena);
    struct error error;
    parameter_set(&lens, named("tilt_z1"), 0.125, &arena);
    const struct lens *to = lens_reversed(&lens, &arena, &error);
    CHECK(to != NULL && to->surface_count == 4);
    static const struct {
        const char *name;
        double expected;
    } cases[] = {{"R4", -50},
                 {"k4", -1},
                 {"A4_4", -1e-5},
                 {"A6_4", 2e-8},
                 {"decenter_x4", -0.5},
                 {"decenter_y4", -0.25},
                 {"tilt_x4", -0.05235987755982988731},
                 {"tilt_y4", -0.03490658503988659154},
                 {"tilt_z4", -0.125},
                 {"c3", 0.02},
                 {"t3", 6},
                 {"n3", 1.5},
                 {"f2", 100},
                 {"hiatus2", 4},
                 {"t2", 3}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK_RELATIVE(parameter_get(to, named(cases[i].name)), cases[i].expected, 1e-15,
                       cases[i].name);
    }
    check_bounds(&to->surfaces[3], PARAMETER_RADIUS, -60, -40, "R~");
    check_bounds(&to->surfaces[3], PARAMETER_CONIC, -2, 0, "k~");
    check_bounds(&to->surfaces[3], PARAMETER_COEFFICIENT, -1.6e-5, -8e-6, "A4~");
    check_bounds(&to->surfaces[2], PARAMETER_CURVATURE, 0.01, 0.04, "c~");
    check_bounds(&to->surfaces[1], PARAMETER_FOCAL, 90, 120, "f~");
}

/* Marks of the space behind a surface go to where it lies in the lens turned around. */
static void check_reversed_marks(void)
{
    const struct lens lens = lens_of("surface 50 6 1.5 - R~ t~[5,7] glass~\n"
                                     "surface -80 3 air - t~[2,4]\n"
                                     "bend tilt=0,0,10\n"
                                     "surface 70 2 1.6 - k~\n"
                                     "surface -60 - air - c~ t~\n",
                                     &arena);
    struct error error;
    const struct lens *to = lens_reversed(&lens, &arena, &error);
    /* the surfaces backwards, with a plane that undoes the bend behind the third */
    CHECK(to != NULL && to->surface_count == 5);
    static const size_t counts[5] = {1, 1, 1, 2, 1};
    for (size_t i = 0; i < 5; i++) {
        CHECK(to->surfaces[i].vary_count == counts[i]);
    }
    CHECK(mark_of(&to->surfaces[0], PARAMETER_CURVATURE)->has_bounds == false);
    CHECK(mark_of(&to->surfaces[1], PARAMETER_CONIC)->has_bounds == false);
    check_bounds(&to->surfaces[2], PARAMETER_THICKNESS, 2, 4, "air gap");
    check_bounds(&to->surfaces[3], PARAMETER_THICKNESS, 5, 7, "glass");
    CHECK(mark_of(&to->surfaces[3], PARAMETER_GLASS)->has_bounds == false);
    CHECK(mark_of(&to->surfaces[4], PARAMETER_RADIUS)->has_bounds == false);
}

/* Glass before a mirror is the glass behind the surface where light comes in again. */
static void check_reversed_mangin(void)
{
    const struct lens lens = lens_of("surface -50 6 1.5 - glass~ t~[5,7]\n"
                                     "surface -80 -6 mirror - R~\n"
                                     "surface -50 -90 air -\n",
                                     &arena);
    struct error error;
    const struct lens *to = lens_reversed(&lens, &arena, &error);
    CHECK(to != NULL && to->surface_count == 3);
    CHECK(to->surfaces[0].vary_count == 1 && to->surfaces[2].vary_count == 0);
    CHECK(mark_of(&to->surfaces[0], PARAMETER_GLASS)->has_bounds == false);
    CHECK(mark_of(&to->surfaces[1], PARAMETER_RADIUS)->has_bounds == false);
    check_bounds(&to->surfaces[1], PARAMETER_THICKNESS, -7, -5, "t~");
    struct lens again;
    CHECK(lens_read("again", lens_write(to, &arena), NULL, &arena, &again, &error));
}

/*
 * Light that comes back from a mirror meets H' of a thick lens first, and leaves from H, which lies
 * where light goes: 4 mm to the left.
 */
static void check_reversed_hiatus(void)
{
    const struct lens lens = lens_of("thick 100 50 air - hiatus=4\nsurface -200 -40 mirror -\n"
                                     "surface - - air -\n",
                                     &arena);
    struct error error;
    const struct lens *to = lens_reversed(&lens, &arena, &error);
    CHECK(to != NULL && to->surface_count == 3);
    CHECK_NEAR(parameter_get(to, named("hiatus3")), -4, 0, "from H' to H");
    CHECK_NEAR(parameter_get(to, named("f3")), 100, 0, "the same power");
    CHECK_NEAR(parameter_get(to, named("t2")), -50, 0, "to H'");
}

/* Bounds have the unit of their number: 0.5/in is 0.5/25.4 per mm, 2 in^-3 2/25.4^3 mm^-3. */
static void check_units(void)
{
    const struct lens lens = lens_of("unit in\n"
                                     "surface - 1 1.5 - c=0.5 A4=3 R~[2,4] c~[0.5,1] A4~[2,4] "
                                     "k~[-1,1]\nthick 4 1 air - f~[3,5]\n",
                                     &arena);
    const struct lens *to = lens_in_unit(&lens, "mm", &arena);
    const double inch = 25.4, cube = 25.4 * 25.4 * 25.4;
    for (int i = 0; i < 2; i++) {
        const struct surface *surfaces = i == 0 ? lens.surfaces : to->surfaces;
        check_bounds(&surfaces[0], PARAMETER_RADIUS, 2 * inch, 4 * inch, "R~");
        check_bounds(&surfaces[0], PARAMETER_CURVATURE, 0.5 / inch, 1 / inch, "c~");
        check_bounds(&surfaces[0], PARAMETER_COEFFICIENT, 2 / cube, 4 / cube, "A4~");
        check_bounds(&surfaces[0], PARAMETER_CONIC, -1, 1, "k~");
        check_bounds(&surfaces[1], PARAMETER_FOCAL, 3 * inch, 5 * inch, "f~");
    }
    /* and as text: 1/25.4 */
    struct text text = lens_write(to, &arena);
    CHECK(strstr(arena_string(&arena, text.start, text.length), "0.0393700787401574") != NULL);
}

/*
 * A bend undone, each part on a plane, in the order z, y, x, shift; and with the axes turned what
 * belongs to x or z twice.
 */
static void check_reversed_break(void)
{
    static const char *const texts[2] = {
        "surface 50 6 1.5 -\nbend decenter=1,2 tilt=3,4,5\nsurface -80 - air -\n",
        "surface 50 6 1.5 -\nbend decenter=1,2 tilt=3,4,5\nsurface -80 - mirror -\n"};
    const double degree = RADIANS_PER_DEGREE;
    const double expected[2][5] = {{5 * degree, -4 * degree, 3 * degree, 1, -2},
                                   {-5 * degree, -4 * degree, -3 * degree, -1, -2}};
    static const char *const names[5] = {"bend_tilt_z2", "bend_tilt_y3", "bend_tilt_x4",
                                         "bend_decenter_x5", "bend_decenter_y5"};
    for (int i = 0; i < 2; i++) {
        const struct lens lens = lens_of(texts[i], &arena);
        struct error error;
        const struct lens *to = lens_reversed(&lens, &arena, &error);
        CHECK(to != NULL && to->surface_count == 6);
        for (int j = 0; j < 5; j++) {
            CHECK_RELATIVE(parameter_get(to, named(names[j])), expected[i][j], 1e-15, names[j]);
        }
    }
}

/* One mirror: the lens stays, and light goes the other way along it. */
static void check_reversed_mirror(void)
{
    struct lens lens = lens_of("surface 50 6 1.5 - A4=1e-5 tilt=3,-2 R~[40,60]\n"
                               "surface -200 -8 mirror -\nsurface 70 - air -\n",
                               &arena);
    struct error error;
    parameter_set(&lens, named("tilt_z1"), 0.125, &arena);
    const struct lens *to = lens_reversed(&lens, &arena, &error);
    CHECK(to != NULL && to->surface_count == 3);
    static const struct {
        const char *name;
        double expected;
    } cases[] = {{"R3", 50},     {"R2", -200},       {"R1", 70},
                 {"A4_3", 1e-5}, {"tilt_z3", 0.125}, {"tilt_x3", 0.05235987755982988731},
                 {"t1", 8},      {"t2", -6}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        CHECK_RELATIVE(parameter_get(to, named(cases[i].name)), cases[i].expected, 1e-15,
                       cases[i].name);
    }
    check_bounds(&to->surfaces[2], PARAMETER_RADIUS, 40, 60, "R~");
}

int main(void)
{
    check_names();
    check_refused_names();
    check_suggestions();
    check_kinds();
    check_refused_lenses();
    check_round_trips();
    check_numbers();
    check_slopes();
    check_scaling();
    check_reversal();
    check_reversed_break();
    check_reversed_mirror();
    check_reversed_marks();
    check_reversed_mangin();
    check_reversed_hiatus();
    check_units();
    arena_free(&arena);
    return check_report();
}
