/* tests/unit/test_variable.c - what a design varies: numbers put, slopes, bounds, pick-ups. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "design/glass_map.h"
#include "design/variable.h"
#include "double_gauss.h"
#include "file/lens_file.h"
#include "lens_of.h"
#include "optics/pickup.h"
#include "optics/wavelength.h"

static struct arena arena;

static struct variable variable_of(const char *name, double low, double high)
{
    struct variable variable = {
        .position = LENS_NONE, .low = low, .high = high, .name = name, .scale = 0};
    struct error error;
    CHECK(parameter_read(text_of(name), NULL, &variable.what, &error));
    return variable;
}

static void pick_up(struct lens *lens, const char *what, const char *from, double factor,
                    double offset)
{
    struct lens_pickup pickup = {
        .what = variable_of(what, 0, 0).what,
        .from = variable_of(from, 0, 0).what,
        .factor = {.value = {factor, 0}, .variable = LENS_NONE},
        .offset = {.value = {offset, 0}, .variable = LENS_NONE},
    };
    const char *against = lens_pickup_add(lens, pickup, &arena);
    CHECK(against == NULL);
    if (against != NULL) {
        printf("%s\n", against);
    }
}

/* A number that rays are derived by; an index is that at a wavelength. */
static double basis_of(const struct lens *lens, struct parameter basis, double wavelength)
{
    struct pair index = {NAN, 0};
    struct error error;
    if (basis.kind != PARAMETER_INDEX) {
        return parameter_get(lens, basis);
    }
    CHECK(medium_index(&lens->surfaces[basis.surface].medium, wavelength, &index, &error));
    return index.hi;
}

static bool is_basis(enum parameter_kind kind)
{
    return parameter_type(kind)->basis == kind || kind == PARAMETER_FOCAL;
}

/* Every basis of every surface by every variable: five points of differences. */
static void check_links(const struct lens *lens, const struct variable *list, size_t count,
                        double wavelength)
{
    struct variables variables;
    struct error error;
    bool opened = variables_open(lens, list, count, &arena, &variables, &error);
    CHECK(opened);
    if (!opened) {
        printf("%s\n", error.message);
        return;
    }
    struct variable_link *links =
        ARENA_ARRAY(&arena, variables_most_links(&variables), struct variable_link);
    double *v = ARENA_ARRAY(&arena, count, double);
    size_t linked = 0, seen = 0;
    for (size_t p = 0; p < variables.position_count; p++) {
        variables_get(&variables, v);
        variables_put(&variables, v, p);
        size_t n = variables_links(&variables, p, wavelength, links);
        CHECK(n <= variables_most_links(&variables));
        linked += n;
        for (size_t j = 0; j < count; j++) {
            for (struct parameter each = {0}; each.surface < lens->surface_count;
                 each = parameter_next(each)) {
                if (each.kind == PARAMETER_KINDS) {
                    each = (struct parameter){each.surface, PARAMETER_RADIUS, 0};
                    each.surface++;
                }
                if (each.surface == lens->surface_count || !is_basis(each.kind) ||
                    (each.kind == PARAMETER_FOCAL &&
                     !surface_has(&lens->surfaces[each.surface], SURFACE_HAS_FOCAL))) {
                    continue;
                }
                static const double weights[] = {1, -8, 0, 8, -1};
                double sum = 0, slope = 0, h = 5e-4 * variables.scale[j], start = v[j], size = 0;
                for (int i = 0; i < 5; i++) {
                    v[j] = start + (i - 2) * h;
                    const struct lens *at = variables_put(&variables, v, p);
                    double value = basis_of(at, each, wavelength);
                    sum += weights[i] * value;
                    size = fmax(size, fabs(value));
                }
                v[j] = start;
                variables_put(&variables, v, p);
                for (size_t i = 0; i < n; i++) {
                    bool same = links[i].variable == j && links[i].basis.surface == each.surface &&
                                links[i].basis.kind == each.kind &&
                                links[i].basis.order == each.order;
                    slope += same ? links[i].slope : 0;
                    seen += same;
                }
                double tolerance = 1e-10 * fabs(slope) + 4e-16 * size / h;
                CHECK_NEAR(sum / (12 * h), slope, tolerance, list[j].name);
                if (!(fabs(sum / (12 * h) - slope) <= tolerance)) {
                    printf("  basis %s of position %zu\n", parameter_write(each, &arena), p);
                }
            }
        }
    }
    CHECK(seen == linked && linked >= count);
}

/* Everything: nd/Vd, an asphere, decentre and tilt, a mirror in glass, a thick lens, pick-ups. */
static void check_everything(void)
{
    struct lens lens = lens_of("wavelength d\n"
                               "surface 50 6 1.62/50 30 k=-0.7 A4=1e-6\n"
                               "surface -80 3 air 30 decenter=0.1,0.2 tilt=1,2\n"
                               "stop - 5 air 8\n"
                               "surface - 4 1.7/30 20\n"
                               "surface -35 9 1.5 20\n"
                               "surface -90 -9 mirror 20\n"
                               "surface - -12 air 20 c=0.02\n"
                               "thick 70 3 1.2 - hiatus=1\n"
                               "surface - 2 air -\n",
                               &arena);
    pick_up(&lens, "R2", "R1", -1.5, 0);
    pick_up(&lens, "R5", "R2", 0.5, 3);
    pick_up(&lens, "t5", "t4", 2, 1);
    pick_up(&lens, "t6", "t5", -1, 0);
    pick_up(&lens, "t3", "R1", 0.125, -1);
    pick_up(&lens, "glass4", "glass1", 1, 0);
    pick_up(&lens, "c7", "c6", -2, 0.001);
    pick_up(&lens, "ax2", "ay2", -1, 0.1);
    pick_up(&lens, "R9", "t1", 7, 1);
    lens_pickups_put(&lens, lens_at_position(&lens, 0, &arena), &arena);
    const double none = INFINITY;
    const struct variable list[] = {
        variable_of("R1", 20, none),
        variable_of("c4", -0.1, 0.1),
        variable_of("t1", 2, 10),
        variable_of("t4", -none, none),
        variable_of("k1", -none, none),
        variable_of("A4_1", -none, none),
        variable_of("A6_2", -none, none),
        variable_of("n1", -none, none),
        variable_of("V1", -none, none),
        variable_of("n5", 1.2, 2),
        variable_of("R6", -none, -30),
        variable_of("focal8", 50, none),
        variable_of("dx2", -none, none),
        variable_of("dy1", -none, none),
        variable_of("ay2", -none, none),
        variable_of("ax4", -none, none),
        variable_of("bend_tilt_x6", -none, none),
        variable_of("bend_decenter_y3", -none, none),
    };
    check_links(&lens, list, sizeof list / sizeof list[0], WAVELENGTH_F);
}

/* A word of three positions, in two cells; a pick-up of one of them. */
static void check_positions(void)
{
    struct lens lens = lens_of("position wide mid tele\nlet d2 2.5 8 15\nlet d4 20 14.5 7.5\n"
                               "surface 50 6 1.62/50 -\nsurface - d2 air -\n"
                               "surface -40 2 1.5 -\nsurface - d4 air -\n"
                               "surface 80 5 1.5 -\nsurface - d2 air -\nsurface - 3 1.5 -\n"
                               "surface -60 30 air -\n",
                               &arena);
    pick_up(&lens, "t8", "t2", 0.5, 30);
    lens_pickups_put(&lens, lens_at_position(&lens, 0, &arena), &arena);
    struct variable list[] = {variable_of("t2", 1, 20), variable_of("t4", 0, 50),
                              variable_of("t2", 1, 20), variable_of("R1", -INFINITY, INFINITY)};
    list[0].position = 0;
    list[1].position = 1;
    list[2].position = 2;
    list[0].name = "d2[wide]";
    check_links(&lens, list, 4, WAVELENGTH_D);

    struct variables variables;
    struct error error;
    CHECK(variables_open(&lens, list, 4, &arena, &variables, &error));
    double v[4];
    variables_get(&variables, v);
    CHECK(v[0] == 2.5 && v[1] == 14.5 && v[2] == 15 && v[3] == 0.02);
    v[0] = 3.25;
    v[3] = 0.025;
    const struct lens *wide = variables_put(&variables, v, 0);
    CHECK(wide->surfaces[1].thickness.value.hi == 3.25);
    CHECK(wide->surfaces[5].thickness.value.hi == 3.25);
    CHECK(wide->surfaces[7].thickness.value.hi == 31.625);
    CHECK(variables_put(&variables, v, 2)->surfaces[7].thickness.value.hi == 37.5);
    const struct lens *out = variables_lens(&variables, v, &arena);
    CHECK(out->surfaces[0].radius.value.hi == 40);
    CHECK(out->variables[0].values[0].value.hi == 3.25);
    CHECK_TEXT(out->variables[0].values[0].typed.start, "3.25");
    CHECK(out->variables[0].values[2].value.hi == 15);
    CHECK(out->surfaces[7].thickness.value.hi == 31.625);
    CHECK(lens.variables[0].values[0].value.hi == 2.5);
}

/* Of the double Gauss: 0.01 /mm and 10 mm. */
static void check_scales(void)
{
    struct lens lens = lens_of("aperture epd 50\nfocus table\n" DOUBLE_GAUSS("34.2"), &arena);
    const struct variable list[] = {variable_of("R1", -INFINITY, INFINITY),
                                    variable_of("t11", 60, 80),
                                    variable_of("n7", -INFINITY, INFINITY),
                                    variable_of("V7", -INFINITY, INFINITY),
                                    variable_of("R3", 20, 100),
                                    variable_of("R10", 100, -100)};
    struct variables variables;
    struct error error;
    bool opened = variables_open(&lens, list, 6, &arena, &variables, &error);
    CHECK(opened);
    if (!opened) {
        printf("%s\n", error.message);
        return;
    }
    CHECK(variables.scale[0] == 0.01 && variables.scale[1] == 10);
    CHECK(variables.low[4] == 0.01 && variables.high[4] == 0.05);
    CHECK(variables.low[5] == -0.01 && variables.high[5] == 0.01);
    CHECK(variables.low[3] == 0 && variables.high[3] == 1);
    double v[6];
    variables_get(&variables, v);
    v[4] = 0; /* a plane */
    const struct arena_mark before = arena_mark(&arena);
    CHECK(variables_put(&variables, v, 0)->surfaces[2].is_plane);
    CHECK(arena_mark(&arena).used == before.used);
    const struct lens *out = variables_lens(&variables, v, &arena);
    CHECK(out->surfaces[2].is_plane);
    CHECK(out->surfaces[0].radius.typed.start == lens.surfaces[0].radius.typed.start);
    CHECK_RELATIVE(out->surfaces[6].medium.abbe.hi, 38.0, 1e-13, "Vd");
}

static bool open_one(const struct lens *lens, const struct variable *list, size_t count,
                     struct variables *variables)
{
    struct error error;
    return variables_open(lens, list, count, &arena, variables, &error);
}

/* The length L by the scale of a curvature, 1/L: that of an ideal lens of a focal length. */
static void check_sizes(void)
{
    static const struct {
        double focal, size; /* borders are the geometric means of 1, 2, 5 and 10 */
    } rows[] = {{1.414, 1},  {1.4145, 2}, {3.162, 2}, {3.163, 5},  {7.071, 5},     {7.072, 10},
                {14.14, 10}, {14.15, 20}, {50, 50},   {999, 1000}, {0.0316, 0.02}, {0.0317, 0.05}};
    struct variables variables;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double f = rows[i].focal;
        struct lens lens = lens_of(arena_printf(&arena, "thick %.17g %.17g air -\n", f, f), &arena);
        const struct variable list[] = {variable_of("focal1", -INFINITY, INFINITY)};
        CHECK(open_one(&lens, list, 1, &variables));
        CHECK_RELATIVE(variables.scale[0], 1 / rows[i].size, 1e-14, "1/L of a focal length");
    }
    /* where the focal length is not near it, or none, the length of the lens; without one 100 mm */
    static const struct {
        const char *text;
        double size;
    } others[] = {{"surface 1000 2 1.5 -\nsurface - 8 air -\n", 10},
                  {"surface 50 10 1.5 -\nsurface - 500 air -\n", 100},
                  {"surface 5 80 1.5 -\nsurface - 20.5 air -\n", 100},
                  {"surface 5 80 1.5 -\nsurface - 19.5 air -\n", 10},
                  {"surface 1000 9 1.5 -\nsurface - 192 air -\n", 2000},
                  {"surface 1000 9 1.5 -\nsurface - 190 air -\n", 200},
                  {"surface - 6 1.5 -\nsurface - -14.2 air -\n", 20},
                  {"surface - 0 1.5 -\nsurface - 0 air -\n", 100}};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        struct lens lens = lens_of(others[i].text, &arena);
        const struct variable list[] = {variable_of("R1", -INFINITY, INFINITY)};
        CHECK(open_one(&lens, list, 1, &variables));
        CHECK_RELATIVE(variables.scale[0], 1 / others[i].size, 1e-14, "1/L of a curvature");
    }
}

/* Natural scales as variable.h has them, of a lens of L = 100 mm; one that is given stays. */
static void check_each_scale(void)
{
    struct lens lens = lens_of("surface - 5 1.6/50 20 c=1e-6 k=-1 A4=1e-6\n"
                               "surface - 2 1.6/50 - decenter=0.1,0.2 tilt=1,2\n"
                               "bend decenter=1,2 tilt=3,4,5\nthick 100 100 air -\n",
                               &arena);
    static const struct {
        const char *name;
        double scale;
    } rows[] = {{"c1", 1. / 100},
                {"t1", 100. / 10},
                {"k1", 1},
                {"A4_1", 1 / (2 * 100. * 10 * 10)},
                {"A6_1", 1 / (2 * 100. * 10 * 10 * 10 * 10)},
                {"A4_2", 1 / (2 * 100. * 10 * 10)}, /* without a diameter r is L/10 */
                {"n1", 0.1},
                {"V2", 10},
                {"dx2", 100. / 100},
                {"dy2", 100. / 100},
                {"ax2", 0.01},
                {"ay2", 0.01},
                {"bend_decenter_x3", 100. / 100},
                {"bend_decenter_y3", 100. / 100},
                {"bend_tilt_x3", 0.01},
                {"bend_tilt_y3", 0.01},
                {"bend_tilt_z3", 0.01},
                {"focal3", 1. / 100}};
    enum { ROWS = sizeof rows / sizeof rows[0] };
    struct variable list[ROWS];
    struct variables variables;
    for (size_t i = 0; i < ROWS; i++) {
        list[i] = variable_of(rows[i].name, -INFINITY, INFINITY);
    }
    const struct variables none = {0};
    variables = none;
    CHECK(open_one(&lens, list, ROWS, &variables));
    for (size_t i = 0; i < ROWS && variables.scale != NULL; i++) {
        CHECK_RELATIVE(variables.scale[i], rows[i].scale, 1e-14, rows[i].name);
        list[i].scale = 3 + (double)i;
    }
    variables = none;
    CHECK(open_one(&lens, list, ROWS, &variables));
    for (size_t i = 0; i < ROWS && variables.scale != NULL; i++) {
        CHECK_RELATIVE(variables.scale[i], 3 + (double)i, 1e-14, rows[i].name);
    }
}

/* A start that was written with fewer digits than its bound: 1e-12 of that. */
static void check_slack(void)
{
    static const struct {
        const char *name;
        double low, high; /* of the start, but for infinite ones */
        bool within;
    } rows[] = {
        {"t1", 1 + 0.9e-12, 2, true},
        {"t1", 1 + 1.2e-12, 2, false},
        {"t1", 0.5, 1 - 0.9e-12, true},
        {"t1", 0.5, 1 - 1.2e-12, false},
        {"t1", -INFINITY, 1 + 1e-12, true},
        {"t1", -INFINITY, 1 - 0.9e-12, true},
        {"t1", -INFINITY, 1 - 1.2e-12, false},
        {"t1", 1 + 0.9e-12, INFINITY, true},
        {"t1", 1 + 1.2e-12, INFINITY, false},
        {"R2", 2, 1 + 0.9e-12, true},
        {"R2", 2, 1 + 1.2e-12, false},
        {"R2", 1 - 0.9e-12, 0.5, true},
        {"R2", 1 - 1.2e-12, 0.5, false},
        {"R1", 0.02, -1, true},
        {"R1", 0.02, -0.02, true},
        {"R1", 1 + 0.9e-12, -1, true},
        {"R1", 1 + 1.2e-12, -1, false},
        {"R2", -1, 1 + 0.9e-12, true},
        {"R2", -1, 1 + 1.2e-12, false},
    };
    struct lens lens = lens_of("surface 50 6 1.5 -\nsurface -80 9 air -\n", &arena);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct variable one = variable_of(rows[i].name, 0, 0);
        struct variables variables;
        const double start = parameter_get(&lens, one.what);
        one.low = start * rows[i].low;
        one.high = start * rows[i].high;
        CHECK(open_one(&lens, &one, 1, &variables));
        const bool within = variables_moved(&variables, &arena) == NULL;
        CHECK(within == rows[i].within);
        CHECK(variables.start[0] >= variables.low[0] && variables.start[0] <= variables.high[0]);
        CHECK_RELATIVE(variables.start[0], one.what.kind == PARAMETER_RADIUS ? 1 / start : start,
                       1.21e-12, rows[i].name);
    }
}

/* nd or Vd alone stays where its border of the map is: 13.07/(nd - 1.2688) - 2.4, flint side. */
static void check_lone_glass(void)
{
    struct lens lens = lens_of("surface 50 6 1.62/40 -\nsurface - 3 1.65/38 -\n", &arena);
    const struct variable list[] = {variable_of("n1", -INFINITY, INFINITY),
                                    variable_of("V2", -INFINITY, INFINITY),
                                    variable_of("n2", 1.62, 1.66), variable_of("t2", 1, 9)};
    struct variables variables;
    const bool opened = open_one(&lens, list, 4, &variables);
    CHECK(opened);
    if (opened) {
        CHECK_RELATIVE(variables.low[0], 1.2688 + 13.07 / 42.4, 1e-13, "n1 at Vd = 40");
        CHECK_RELATIVE(glass_map_at(variables.high[0], 1).Vd, 40.0, 1e-12, "and its other end");
        CHECK_RELATIVE(variables.low[1], glass_map_abbes(1.62, 1.66).low, 1e-15, "V2 by n2");
        CHECK_RELATIVE(variables.high[1], glass_map_abbes(1.62, 1.66).high, 1e-15, "V2 by n2");
        CHECK(variables.low[2] == 1.62 && variables.high[2] == 1.66);
    }
    /* bounds are on one side of 1/low and 1/high */
    const struct variable open[] = {variable_of("R1", 20, INFINITY)};
    struct lens bent = lens_of("surface 50 6 1.62/40 -\nsurface -60 3 air -\n", &arena);
    CHECK(open_one(&bent, open, 1, &variables) && variables.low[0] == 0 &&
          variables.high[0] == 1 / 20.);
    /* 1.62/70 is no glass: where one is held there is none for the other */
    lens = lens_of("surface 50 6 1.62/70 -\nsurface - 3 air -\n", &arena);
    CHECK(!open_one(&lens, list, 1, &variables));
}

/* A word is varied in one position where it stands for thicknesses, or for focal lengths, alone. */
static void check_words(void)
{
    static const struct {
        const char *first, *last, *name;
        size_t position;
        bool varies;
    } rows[] = {
        {"surface 50 d 1.5 -", "surface - 2 air -", "t1", 0, true},
        {"surface 50 d 1.5 -", "surface - 2 air -", "t1", 1, true},
        {"surface 50 d 1.5 -", "surface - 2 air -", "t1", 2, false},
        {"surface 50 2 1.5 -", "surface - d air -", "t1", 1, false},
        {"surface 50 2 1.5 -", "surface - d air -", "t2", 1, true},
        {"surface 50 2 1.5 d", "surface - d air -", "t2", 1, false},
        {"surface 50 d 1.5 -", "surface - 2 air d", "t1", 1, false},
        {"surface 50 2 1.5 -", "thick d 2 air -", "focal2", 1, true},
        {"surface 50 d 1.5 -", "thick d 2 air -", "focal2", 1, false},
        {"surface 50 d 1.5 -", "thick d 2 air -", "t1", 1, false},
        {"surface 50 d 1.5 -", "thick 70 2 air - hiatus=d", "t1", 1, false},
        {"surface 50 2 1.5 -", "thick d d air -", "focal2", 1, false},
        {"surface 50 2 1.5 -", "thick 70 2 air d hiatus=d", "hiatus2", 1, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        struct lens lens = lens_of(
            arena_printf(&arena, "position a b\nlet d 5 6\n%s\n%s\n", rows[i].first, rows[i].last),
            &arena);
        struct variable one = variable_of(rows[i].name, -INFINITY, INFINITY);
        struct variables variables;
        one.position = rows[i].position;
        const bool opened = open_one(&lens, &one, 1, &variables);
        CHECK(opened == rows[i].varies);
        if (opened != rows[i].varies) {
            printf("row %zu\n", i);
        }
    }
}

/* A radius of 0 by a pick-up, in the first or the last position. */
static void check_pickup_infinite(void)
{
    for (int k = 0; k < 3; k++) {
        static const char *const words[] = {"2 4 5", "3 4 2", "3 4 5"};
        struct lens lens = lens_of(arena_printf(&arena,
                                                "position a b c\nlet d2 %s\n"
                                                "surface 50 6 1.5 -\nsurface - d2 air -\n"
                                                "surface -40 2 1.5 -\nsurface 7 4 air -\n",
                                                words[k]),
                                   &arena);
        pick_up(&lens, "R4", "t2", 3, -6);
        struct variable list[] = {variable_of("R1", 20, 90), variable_of("t2", 0, 9)};
        list[1].position = 1;
        struct variables variables;
        struct error error = {0};
        CHECK(variables_open(&lens, list, 2, &arena, &variables, &error) == (k == 2));
        CHECK_TEXT(error.message,
                   k == 2 ? ""
                          : "the pick-up of the curvature of surface 4 gives no finite number");
    }
}

static void check_refused(const char *name, double low, double high, const char *message,
                          const char *hint)
{
    struct lens lens = lens_of("surface 50 6 1.5/95 -\nsurface - 3 air -\nsurface -50 1 1.5 -\n"
                               "surface -20 4 air -\n",
                               &arena);
    pick_up(&lens, "R4", "R3", 0.5, 0);
    const struct variable list[] = {variable_of("n1", 1, 2), variable_of(name, low, high)};
    struct variables variables;
    struct error error = {0};
    CHECK(!variables_open(&lens, list, 2, &arena, &variables, &error));
    CHECK(error.code == ERROR_DOMAIN);
    CHECK_TEXT(error.message, message);
    CHECK_TEXT(error.hint, hint);
}

/* Begun at the bound that is nearest, which is said. */
static void check_outside(void)
{
    static const struct {
        const char *name;
        double low, high, own, start;
        const char *words;
    } rows[] = {
        {"t1", 7, 9, 6, 7, "t1 is 6 mm, outside of its bounds 7 to 9 mm: it begins at 7 mm"},
        {"R1", 70, -10, 1.0 / 50, 1.0 / 70,
         "R1 is 50 mm, outside of its bounds 70 to -10 mm: it begins at 70 mm"},
        {"R2", 10, 40, 0, 1.0 / 40,
         "R2 is that of a plane, outside of its bounds 10 to 40 mm: it begins at 40 mm"},
        {"c1", 0.03, 0.04, 0.02, 0.03,
         "c1 is 0.02 /mm, outside of its bounds 0.03 to 0.04 /mm: it begins at 0.03 /mm"},
        {"ax1", RADIANS_PER_DEGREE, 2 * RADIANS_PER_DEGREE, 0, RADIANS_PER_DEGREE,
         "ax1 is 0 deg, outside of its bounds 1 to 2 deg: it begins at 1 deg"}};
    struct lens lens = lens_of("surface 50 6 1.5/95 -\nsurface - 3 air -\n", &arena);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct variable list[] = {variable_of(rows[i].name, rows[i].low, rows[i].high)};
        struct variables variables;
        CHECK(open_one(&lens, list, 1, &variables));
        CHECK_RELATIVE(variables.start[0], rows[i].start, 1e-15, rows[i].name);
        CHECK_RELATIVE(variables.own[0], rows[i].own, 1e-15, rows[i].name);
        CHECK_TEXT(variables_moved(&variables, &arena), rows[i].words);
    }
}

static void check_errors(void)
{
    check_refused("R9", 1, 2, "there is no radius 9 to vary: the lens has 4 surfaces", "");
    check_refused("n1", 1, 2, "n1 and n1 are the same number, which varies once", "");
    check_refused("R4", 1, 2,
                  "R4 follows surface 3 by a pick-up: vary that, or leave the pick-up out", "");
    check_refused("t1", 9, 7, "t1: the bounds 9 to 7 mm leave nothing to vary",
                  "the lower one comes first; what is to stay is held, not varied");
    check_refused("t1", 6, 6, "t1: the bounds 6 to 6 mm leave nothing to vary",
                  "the lower one comes first; what is to stay is held, not varied");
    check_refused("R1", -10, 70, "R1: between the bounds -10 and 70 mm lies 0, which is no radius",
                  "through a plane it is R1[70,-10]");
    static const double empty[][2] = {{70, 60}, {-60, -70}, {70, 1}, {0, -10}, {70, 0}};
    for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
        const char *message = arena_printf(
            &arena, "R1: the bounds %g to %g mm leave nothing to vary", empty[i][0], empty[i][1]);
        check_refused("R1", empty[i][0], empty[i][1], message,
                      "the lower one comes first; what is to stay is held, not varied");
    }
    check_refused("R1", -70, 1, "R1: between the bounds -70 and 1 mm lies 0, which is no radius",
                  "through a plane it is R1[1,-70]");
    check_refused("tilt_z1", 1, 2, "the tilt about z of a surface does not vary", "");
}

/* Catalogue values of glasses, and what is none. */
static void check_glass_map(void)
{
    static const struct {
        double nd, Vd;
        bool inside;
        const char *name;
    } glasses[] = {{1.5168, 64.17, true, "N-BK7"},     {1.43875, 94.66, true, "S-FPL53"},
                   {1.497, 81.54, true, "S-FPL51"},    {1.4585, 67.82, true, "fused silica"},
                   {1.84666, 23.83, true, "SF57"},     {1.62004, 36.37, true, "F2"},
                   {1.54814, 45.75, true, "LLF1"},     {1.95906, 17.47, true, "S-NPH3"},
                   {2.001, 29.13, true, "TAFD40"},     {1.755, 52.32, true, "S-YGH51"},
                   {1.883, 40.76, true, "S-LAH58"},    {1.62041, 60.32, true, "N-SK16"},
                   {1.52344, 51.49, true, "KF9"},      {1.67271, 32.21, true, "SF5"},
                   {1.5855, 29.9, false, "a plastic"}, {1.6, 80, false, "none"},
                   {1.35, 60, false, "none"},          {2.4, 20, false, "none"}};
    for (size_t i = 0; i < sizeof glasses / sizeof glasses[0]; i++) {
        double share = glass_map_share(glasses[i].nd, glasses[i].Vd);
        check_at((share >= 0 && share <= 1) == glasses[i].inside, __FILE__, __LINE__,
                 glasses[i].name);
        if (share >= 0) {
            CHECK_RELATIVE(glass_map_at(glasses[i].nd, share).Vd, glasses[i].Vd, 1e-13, "Vd");
        }
    }
    /* ranges have their ends on the border: 13.07/(nd - 1.2688) - 2.4 and 59.5 - 96.6 y + ...,
       y = nd - 1.7, which at 1.6 are 37.06256038647343 and 70.419; beyond it lie its ends */
    const struct glass_map_range nd = glass_map_indices(37.06256038647343, 70.419);
    CHECK_RELATIVE(nd.low, 1.2688 + 13.07 / 72.819, 1e-13, "nd of 70.4 on the flint side");
    CHECK_RELATIVE(glass_map_at(nd.high, 1).Vd, 37.06256038647343, 1e-13, "nd on the crown side");
    const struct glass_map_range Vd = glass_map_abbes(1.6, 1.6);
    CHECK_RELATIVE(Vd.low, 37.06256038647343, 1e-13, "Vd of 1.6 on the flint side");
    CHECK_RELATIVE(Vd.high, 70.419, 1e-13, "Vd of 1.6 on the crown side");
    const struct glass_map_range all = glass_map_indices(-INFINITY, INFINITY);
    CHECK(all.low == GLASS_MAP_LOWEST && all.high == GLASS_MAP_HIGHEST);
    CHECK(glass_map_indices(5, 5).low > glass_map_indices(5, 5).high);
    struct lens lens = lens_of("surface 50 6 1.5/95 -\nsurface - 3 air -\n", &arena);
    const struct variable list[] = {variable_of("n1", -INFINITY, INFINITY),
                                    variable_of("V1", -INFINITY, INFINITY)};
    struct variables variables;
    struct error error = {0};
    CHECK(!variables_open(&lens, list, 2, &arena, &variables, &error));
    CHECK_TEXT(error.message,
               "surface 1: 1.5/95 lies outside of the map of optical glasses, within "
               "which a model glass varies");
    /* the border at 1.6 is 13.07/0.3312 - 2.4 = 37.06256038647343 */
    lens = lens_of("surface 50 6 1.6/37.062560386473 -\nsurface - 3 air -\n", &arena);
    CHECK(variables_open(&lens, list, 2, &arena, &variables, &error) && variables.start[1] == 0);
    lens = lens_of("surface 50 6 1.6/37.06256 -\nsurface - 3 air -\n", &arena);
    CHECK(!variables_open(&lens, list, 2, &arena, &variables, &error));
}

int main(void)
{
    check_everything();
    check_positions();
    check_scales();
    check_sizes();
    check_each_scale();
    check_slack();
    check_lone_glass();
    check_words();
    check_pickup_infinite();
    check_outside();
    check_errors();
    check_glass_map();
    arena_free(&arena);
    return check_report();
}
