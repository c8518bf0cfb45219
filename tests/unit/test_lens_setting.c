/* tests/unit/test_lens_setting.c - lines with `set`: each position is the lens typed alone. */
/* SPDX-License-Identifier: MIT */
#include "file/lens_setting.h"

#include "check.h"
#include "exchange/lens_formats.h"
#include "exchange/lens_json.h"
#include "file/lens_change.h"
#include "optics/first_order.h"

#include <math.h>
#include <stdlib.h>

static bool try_lens(const char *text, struct lens *lens, struct arena *arena, struct error *error)
{
    return lens_read("test.lens", text_of(text), NULL, arena, lens, error);
}

static const struct lens *read_lens(const char *text, struct arena *arena)
{
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct error error = {0};
    bool read = try_lens(text, lens, arena, &error);
    CHECK(read);
    if (!read) {
        printf("%s\n", error.message);
        exit(1);
    }
    return lens;
}

static const char *written(const struct lens *lens, struct arena *arena)
{
    struct text text = lens_write(lens, arena);
    return arena_string(arena, text.start, text.length);
}

/* A lens in inches of which everything that may is set, and what its positions are when typed. */
static const char whole[] =
    "unit in\nwavelength d F:0.5\naperture stop\nposition cold hot flat\n"
    "let d2 0.2 0.3 0.4\n"
    "set R1 2 -2.1 inf\nset glass1 1.5/60 1.6/40 1.7\nset t1 0.3 0.31 0.32\n"
    "set k2 -1 -0.5 0\nset A4_2 1e-3 2e-3 0.5\nset c3 0.1 0.2 -0.3\n"
    "set decenter_y3 0.01 0.02 0.03\nset tilt_x3 1 2 -3\nset bend_tilt_y4 10 0 -10\n"
    "set f4 3 4 5\nset hiatus4 0.1 0.2 0.3\n"
    "set stop 2 3 1\nset wavelength d,F:0.5 e,632.8nm d\n"
    "surface 2 0.3 1.5/60 1\n"
    "surface -3 d2 air 0.9 stop k=-1 A4=1e-3\n"
    "surface - 0.5 mirror 1 c=0.1 decenter=0,0.01 tilt=1,0\n"
    "bend decenter=0,0 tilt=0,10,0\n"
    "thick 3 1 air 2 hiatus=0.1\n";

static const char *const alone[3] = {
    "unit in\nwavelength d F:0.5\naperture stop\n"
    "surface 2 0.3 1.5/60 1\n"
    "surface -3 0.2 air 0.9 stop k=-1 A4=1e-3\n"
    "surface - 0.5 mirror 1 c=0.1 decenter=0,0.01 tilt=1,0\n"
    "bend decenter=0,0 tilt=0,10,0\nthick 3 1 air 2 hiatus=0.1\n",
    "unit in\nwavelength e 632.8nm\naperture stop\n"
    "surface -2.1 0.31 1.6/40 1\n"
    "surface -3 0.3 air 0.9 k=-0.5 A4=2e-3\n"
    "surface - 0.5 mirror 1 stop c=0.2 decenter=0,0.02 tilt=2,0\n"
    "bend decenter=0,0 tilt=0,0,0\nthick 4 1 air 2 hiatus=0.2\n",
    "unit in\nwavelength d\naperture stop\n"
    "surface inf 0.32 1.7 1 stop\n"
    "surface -3 0.4 air 0.9 k=0 A4=0.5\n"
    "surface - 0.5 mirror 1 c=-0.3 decenter=0,0.03 tilt=-3,0\n"
    "bend decenter=0,0 tilt=0,-10,0\nthick 5 1 air 2 hiatus=0.3\n"};

static void test_positions(struct arena *arena)
{
    const struct lens *lens = read_lens(whole, arena);
    for (size_t p = 0; p < 3; p++) {
        const struct lens *typed = read_lens(alone[p], arena);
        CHECK_TEXT(written(lens_one_position(lens, p, arena), arena), written(typed, arena));
    }
    CHECK_TEXT(written(read_lens(written(lens, arena), arena), arena), written(lens, arena));
}

/* Scaled, in another unit: the positions are those of the lens typed alone, changed. */
static void test_change(struct arena *arena)
{
    const struct lens *lens = read_lens(whole, arena);
    const struct pair factor = {1.5, 0};
    for (size_t p = 0; p < 3; p++) {
        const struct lens *typed = read_lens(alone[p], arena);
        const struct lens *scaled = lens_scaled(lens, factor, false, arena);
        CHECK_TEXT(written(lens_one_position(scaled, p, arena), arena),
                   written(lens_scaled(typed, factor, false, arena), arena));
        const struct lens *metric = lens_in_unit(lens, "mm", arena);
        CHECK_TEXT(written(lens_one_position(metric, p, arena), arena),
                   written(lens_in_unit(typed, "mm", arena), arena));
    }
}

/* JSON holds all of it; in mm, as it has no inches. */
static void test_json(struct arena *arena)
{
    const struct lens *lens = lens_in_unit(read_lens(whole, arena), "mm", arena);
    struct foreign_job out = {.source = "a.json", .arena = arena},
                       back = {.source = "a.json", .arena = arena};
    struct text text = {NULL, 0};
    struct error error = {0};
    struct lens again;
    CHECK(foreign_write(&out, &lens_json_format, lens, &text, &error));
    CHECK(foreign_read(&back, text, &again, &error));
    for (size_t p = 0; p < 3; p++) {
        CHECK_TEXT(written(lens_one_position(&again, p, arena), arena),
                   written(lens_one_position(lens, p, arena), arena));
    }
}

/* Points of the field: scaled, in another unit, in JSON, and of one position. */
static void test_sampler(struct arena *arena)
{
    const struct lens *lens =
        read_lens("unit mm\nwavelength d\nobject 100\nfield height 0 2,1:0.5\naperture na 0.1\n"
                  "focus table\nposition a b\nset field 0;2,1:0.5 0;25.4;-5:2\n"
                  "surface 40 6 1.5 - stop\nsurface -30 80 air -\n",
                  arena);
    static const struct {
        const char *line;
        double scale;
        const char *unit;
    } cases[] = {{"set field 0;2,1:0.5 0;25.4;-5:2\n", 1, "mm"},
                 {"set field 0;4,2:0.5 0;50.8;-10:2\n", 2, "mm"},
                 {"set field 0;0.2,0.1:0.5 0;2.54;-0.5:2\n", 1, "cm"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct pair factor = {cases[i].scale, 0};
        const struct lens *other =
            lens_in_unit(cases[i].scale == 1 ? lens : lens_scaled(lens, factor, false, arena),
                         cases[i].unit, arena);
        const char *text = written(other, arena);
        CHECK(strstr(text, cases[i].line) != NULL);
        struct foreign_job out = {.source = "a.json", .arena = arena},
                           back = {.source = "a.json", .arena = arena};
        struct text json = {NULL, 0};
        struct error error = {0};
        struct lens again;
        CHECK(foreign_write(&out, &lens_json_format, other, &json, &error));
        CHECK(foreign_read(&back, json, &again, &error));
        CHECK(again.points[1].count == 3 &&
              again.points[1].fields[1].at[1].value.hi == 25.4 * cases[i].scale);
    }
    CHECK(strstr(written(lens_one_position(lens, 1, arena), arena),
                 "field       height 0 25.4 -5:2\n") != NULL);
    CHECK(lens_at_position(lens, 1, arena)->fields[2].weight == 2);
}

/* CODE V files hold it too: every kind of number, glasses, the stop, wavelengths. */
static void test_sequence(struct arena *arena)
{
    static const char text[] =
        "unit mm\nwavelength 550nm 480nm:0.5\nobject inf\nfield angle 0 5\naperture epd 10\n"
        "focus table\nposition near far mid\n"
        "set R1 50 60.5 inf\nset glass1 1.600/40.0 1.500/60.0 air\nset k1 0.5 -1 0\n"
        "set A4_1 1e-6 0 2e-6\nset c2 -0.02 0.01 0\nset A3_2 1e-5 2e-5 0\nset k2 -1 0 1\n"
        "set decenter_y3 0.1 0 -0.2\nset tilt_x3 1 2 -3\nset tilt_y3 0 0 4\n"
        "set bend_tilt_x3 10 -20 0\nset bend_decenter_x3 0 1 2\nset stop 1 2 1\n"
        "set wavelength 550nm,480nm:0.5 550nm 600nm,480nm:2\nset field 0;5 0;3,7.5;-2:0.5 4\n"
        "surface 50 4 1.600/40.0 20 k=0.5 A4=1e-6 stop\n"
        "surface - 10 air 20 c=-0.02 k=-1 A3=1e-5\n"
        "bend decenter=0,0 tilt=10,0,0\n"
        "surface 200 30 1.550/50.0 30 decenter=0,0.1 tilt=1,0\n"
        "surface - 5 air 30\n";
    const struct lens *lens = read_lens(text, arena);
    struct foreign_job out = {.source = "a.seq", .arena = arena},
                       back = {.source = "a.seq", .arena = arena};
    struct text made = {NULL, 0};
    struct error error = {0};
    struct lens again;
    CHECK(foreign_write(&out, foreign_by_name(text_of("seq")), lens, &made, &error));
    CHECK(foreign_read(&back, made, &again, &error));
    CHECK(again.position_count == 3);
    for (size_t p = 0; p < 3 && p < again.position_count; p++) {
        /* the break before surface 3 has a plane of its own there */
        struct first_order first, other;
        const struct lens *one = lens_at_position(lens, p, arena),
                          *two = lens_at_position(&again, p, arena);
        const double wave = lens_primary_wavelength(one);
        CHECK(wave == lens_primary_wavelength(two) &&
              one->wavelength_count == two->wavelength_count);
        CHECK(one->stop == two->stop);
        CHECK(first_order_of_lens(one, wave, SECTION_Y, arena, &first, &error) &&
              first_order_of_lens(two, wave, SECTION_Y, arena, &other, &error));
        CHECK(first.efl == other.efl && first.image == other.image);
    }
    made = lens_write(&again, arena);
    const char *all = arena_string(arena, made.start, made.length);
    static const char *const lines[] = {"set R1 50 60.5 inf\n",
                                        "set glass1 1.600/40.0 1.500/60.0 air\n",
                                        "set k1 0.5 -1 0\n",
                                        "set A4_1 1e-6 0 2e-6\n",
                                        "set A3_2 1e-5 2e-5 0\n",
                                        "set k2 -1 0 1\n",
                                        "set decenter_y4 0.1 0 -0.2\n",
                                        "set tilt_x4 1 2 -3\n",
                                        "set tilt_y4 0 0 4\n",
                                        "set bend_tilt_x3 10 -20 0\n",
                                        "set bend_decenter_x3 0 1 2\n",
                                        "set stop 1 2 1\n",
                                        "set wavelength 550nm,480nm:0.5 550nm 600nm,480nm:2\n",
                                        "set field 0;5 0;3,7.5;-2:0.5 4\n"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        bool found = strstr(all, lines[i]) != NULL;
        if (!found) {
            printf("missing: %s", lines[i]);
        }
        CHECK(found);
    }
}

/* 1/f = (n - 1)(1/R1 - 1/R2 + (n - 1) t/(n R1 R2)), of two glasses and radii. */
static void test_focal_length(struct arena *arena)
{
    static const double n[] = {1.5, 1.7}, R1[] = {40, 60};
    const struct lens *lens = read_lens("position a b\nset R1 40 60\nset glass1 1.5 1.7\n"
                                        "surface 40 6 1.5 -\nsurface -30 - air -\n",
                                        arena);
    for (size_t p = 0; p < 2; p++) {
        struct first_order first;
        struct error error = {0};
        double m = n[p] - 1, power = m * (1 / R1[p] + 1 / 30. - m * 6 / (n[p] * R1[p] * 30));
        CHECK(first_order_of_lens(lens_at_position(lens, p, arena), 0.5, SECTION_Y, arena, &first,
                                  &error));
        CHECK_RELATIVE(first.efl, 1 / power, 1e-14, "focal length");
    }
}

/* What the positions set is no one number: neither it nor what stands for the same may vary. */
static void test_parameter_check(struct arena *arena)
{
    const struct lens *lens = read_lens(whole, arena);
    static const struct {
        const char *name;
        bool may;
    } cases[] = {{"R1", false}, {"c1", false}, {"n1", false},    {"V1", false},
                 {"R2", true},  {"k2", false}, {"A4_2", false},  {"A6_2", true},
                 {"t1", false}, {"t2", false}, {"tilt_y3", true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct parameter parameter;
        struct error error = {0};
        CHECK(parameter_read(text_of(cases[i].name), NULL, &parameter, &error));
        CHECK(parameter_check(lens, parameter, &error) == cases[i].may);
        CHECK(parameter_check(lens_at_position(lens, 1, arena), parameter, &error) ||
              cases[i].name[0] == 'V');
    }
}

static void test_errors(struct arena *arena)
{
    static const struct {
        const char *set, *message;
        int column;
    } cases[] = {
        {"set R1 40", "one value for each of the 2 positions", 10},
        {"set field 0 1", "field: the first position has not that of the lens", 5},
        {"set field 5 x", "the field 'x' is not a number", 13},
        {"set R1 40 50 60", "one value for each of the 2 positions", 14},
        {"set R1 41 50", "R1: the first position has not the number of its surface", 5},
        {"set R3 40 50", "R3: the lens has 2 surfaces", 5},
        {"set k1 0 1", "", 0}, /* a conic of 0 need not be written */
        {"set A4_1 0 1", "A4_1: its surface has no number of this kind to set", 5},
        {"set t2 5 6", "t2: its surface has no number of this kind to set", 5},
        {"set t1 6 7", "t1 is a variable, which has its numbers by 'let'", 5},
        {"set n1 1.5 1.6", "the positions set a medium as a whole: glass1 1.5/60 1.6/40", 5},
        {"set glass1 1.6 1.7", "glass1: the first position has not the medium of its surface", 5},
        {"set stop 2 3", "surfaces have the numbers 1 to 2", 12},
        {"set stop 1 2",
         "stop: in the first position it is not the surface that bears the word "
         "stop",
         5},
        {"set wavelength F d", "wavelength: the first position has not those of the lens", 5},
        {"set R1 40 0", "the radius is 0", 11},
        {"set R1 40 50\nset R1 40 50", "R1 is set twice", 5},
        {"set colour 1 2", NULL, 5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *text = arena_printf(arena,
                                        "wavelength d F\nposition a b\nlet d1 6 7\n"
                                        "surface 40 d1 1.5 -\nsurface -30 - air - stop\n%s\n",
                                        cases[i].set);
        struct error error = {0};
        struct lens lens;
        bool read = try_lens(text, &lens, arena, &error);
        CHECK(read == (cases[i].column == 0));
        CHECK(error.column == cases[i].column);
        if (cases[i].message != NULL && !read) {
            CHECK_TEXT(error.message, cases[i].message);
        }
    }
    struct error error = {0};
    struct lens lens;
    CHECK(!try_lens("set R1 4 5\nsurface 4 - air -\n", &lens, arena, &error));
    CHECK_TEXT(error.message, "'set' needs a line with 'position' before it");
}

int main(void)
{
    struct arena arena = {0};
    test_positions(&arena);
    test_change(&arena);
    test_json(&arena);
    test_sequence(&arena);
    test_sampler(&arena);
    test_focal_length(&arena);
    test_parameter_check(&arena);
    test_errors(&arena);
    arena_free(&arena);
    return check_report();
}
