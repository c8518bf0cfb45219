/* tests/unit/test_lens_pickup.c - pick-ups, goals and marks of files: read, written, changed. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_change.h"
#include "file/lens_file.h"
#include "lens_of.h"

static struct arena arena;

static bool read_lens(const char *text, struct lens *lens, struct error *error)
{
    *lens = (struct lens){0};
    *error = (struct error){.code = ERROR_NONE};
    return lens_read("test.lens", text_of(text), NULL, &arena, lens, error);
}

static double number(const struct lens *lens, const char *name)
{
    struct parameter parameter;
    struct error error;
    CHECK(parameter_read(text_of(name), NULL, &parameter, &error));
    return parameter_get(lens, parameter);
}

/* Every form of a rule; chains stand in any order. */
static const char *const text = "lens t\n"
                                "unit cm\n"
                                "pickup R5 = R3\n"
                                "pickup R3 = - R1\n"
                                "pickup t3 = 0.5 t1 + 2\n"
                                "pickup t4=10-2*t3\n"
                                "pickup c6 = -.5c2 - 1e-2\n"
                                "pickup k3 = 2 k1\n"
                                "pickup A4_3 = -1 A4_1 + 1e-4\n"
                                "pickup ay2 = -ax1 + 3\n"
                                "pickup dx2 = dy1\n"
                                "pickup glass3 = glass1\n"
                                "pickup t5 = 0.1 R1\n"
                                "goal efl = 100, spot\n"
                                "goal   edge 1..4 > 1 : 0.1   # glass\n"
                                "surface 5 0.3 1.6/50 2 k=-1 A4=2e-4 decenter=0,0.1 tilt=1,0\n"
                                "surface -8 1 air 2\n"
                                "surface -5.0 2.15 1.6/50 2\n"
                                "surface - 5.7 air 2\n"
                                "surface -4 0.5 1.5 2\n"
                                "surface - 3 air 2\n";

static void check_values(void)
{
    const struct lens lens = lens_of(text, &arena);
    CHECK_NEAR(number(&lens, "R3"), -50, 0, "-R1, cm");
    CHECK_NEAR(number(&lens, "R5"), -50, 0, "by a chain");
    CHECK_NEAR(number(&lens, "t3"), 21.5, 1e-14, "0.5 0.3 cm + 2 cm");
    CHECK_NEAR(number(&lens, "t4"), 57, 1e-13, "10 cm - 2 t3");
    CHECK_NEAR(number(&lens, "c6"), 0.5 / 80 - 0.001, 1e-17, "of 1/mm; 1e-2 per cm");
    CHECK_NEAR(number(&lens, "k3"), -2, 0, "2 k1");
    CHECK_NEAR(number(&lens, "A4_3"), (-2e-4 + 1e-4) * 1e-3, 1e-22, "1/cm^3");
    CHECK_NEAR(number(&lens, "ay2"), 2 * RADIANS_PER_DEGREE, 1e-16, "3 - 1 deg");
    CHECK_NEAR(number(&lens, "dx2"), 1, 0, "0.1 cm");
    CHECK_NEAR(number(&lens, "n3"), 1.6, 0, "glass");
    CHECK_NEAR(number(&lens, "V3"), 50, 0, "glass");
    CHECK_NEAR(number(&lens, "t5"), 5, 1e-14, "0.1 R1");
    CHECK(lens.surfaces[2].radius.typed.length == 4);
    CHECK(lens.goal_count == 2 && lens.goals[1].line == 15 && lens.goals[1].column == 8);
    CHECK(text_equal(lens.goals[1].text, "edge 1..4 > 1 : 0.1"));
    size_t warnings = 0;
    for (size_t i = 0; i < lens.pickup_count; i++) {
        warnings += lens.pickups[i].warning != NULL;
    }
    CHECK(lens.pickup_count == 11 && warnings == 1);
    struct lens_warnings all;
    struct error error;
    CHECK(lens_check(&lens, &arena, &all, &error) && all.count >= 1);
    CHECK_TEXT(all.texts[0], "R5 is -50 by its pick-up, not the -40 of the file");

    /* what is written says the same, without a warning */
    const struct text written = lens_write(&lens, &arena);
    const struct lens again = lens_of(arena_string(&arena, written.start, written.length), &arena);
    for (size_t i = 0; i < again.pickup_count; i++) {
        CHECK(again.pickups[i].warning == NULL);
    }
    const struct text twice = lens_write(&again, &arena);
    CHECK(text_identical(written, twice));
}

/* The numbers of a lens that is changed are those of its pick-ups. */
static void check_follows(const struct lens *lens, const char *what)
{
    const struct text written = lens_write(lens, &arena);
    const struct lens again = lens_of(arena_string(&arena, written.start, written.length), &arena);
    size_t warnings = 0;
    for (size_t i = 0; i < again.pickup_count; i++) {
        warnings += again.pickups[i].warning != NULL;
    }
    check_at(warnings == 0 && again.pickup_count == lens->pickup_count, __FILE__, __LINE__, what);
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *a = &lens->surfaces[i], *b = &again.surfaces[i];
        CHECK_RELATIVE(surface_base_curvature(b).hi, surface_base_curvature(a).hi, 1e-14, what);
        CHECK_RELATIVE(b->thickness.value.hi, a->thickness.value.hi, 1e-14, what);
    }
}

static void check_changed(void)
{
    struct error error;
    const struct lens zoom =
        lens_of("position wide tele\nlet d4 2.5~ 15~[10,20]\n"
                "pickup R3 = -R1\npickup t3 = 0.5 t4 + 2\npickup k3 = k1\n"
                "pickup glass5 = glass1\ngoal efl = 50\n"
                "surface 50 3 1.6/50 20 k=-1 R~[20,90]\nsurface -80 1 air 20 c~[-0.1,0.05]\n"
                "surface -50 3.25 1.7/30 20 k=-1\nsurface 90 d4 air 20 ay~[-1,2]\n"
                "surface 40 2 1.6/50 20\nsurface - d4 air 20\n",
                &arena);
    check_follows(&zoom, "zoom");
    CHECK_NEAR(number(lens_at_position(&zoom, 1, &arena), "t3"), 9.5, 0, "0.5 15 + 2");
    const struct lens *reversed = lens_reversed(&zoom, &arena, &error);
    check_follows(reversed, "reversed");
    CHECK(reversed->pickup_count == 4 && reversed->goal_count == 0);
    CHECK_NEAR(number(reversed, "R4"), 50, 0, "turned");
    CHECK_NEAR(number(reversed, "R6"), -50, 0, "turned");
    check_follows(lens_reversed(reversed, &arena, &error), "reversed twice");
    const struct lens *scaled = lens_scaled(&zoom, pair_of(1.5), false, &arena);
    check_follows(scaled, "scaled");
    CHECK_NEAR(scaled->pickups[1].offset.value.hi, 3, 1e-15, "2 mm 1.5");
    CHECK_NEAR(scaled->variables[0].varies[1]->low.value.hi, 15, 1e-14, "10 mm 1.5");
    CHECK_NEAR(scaled->variables[0].varies[1]->high.value.hi, 30, 1e-14, "20 mm 1.5");
    CHECK(scaled->variables[0].varies[0] != NULL && !scaled->variables[0].varies[0]->has_bounds);
    const struct lens *inches = lens_in_unit(&zoom, "in", &arena);
    check_follows(inches, "inches");
    CHECK(inches->goal_count == 1);
    const struct lens *tele = lens_one_position(&zoom, 1, &arena);
    check_follows(tele, "one position");
    CHECK(tele->pickup_count == 5 &&
          parameter_is_marked(PARAMETER_THICKNESS, 0, &tele->surfaces[3]));
    CHECK(number(tele, "t6") == 15);
}

static void check_refused(void)
{
    static const struct {
        const char *line;
        int column;
        const char *message;
    } cases[] = {
        {"pickup R9 = R1", 8, "R9: the lens has 4 surfaces"},
        {"pickup R2 = R9", 8, "R9: the lens has 4 surfaces"},
        {"pickup R2 = -c2", 8, "R2 follows itself"},
        {"pickup R1 = R2", 8,
         "R1 follows R2, and the mark at surface 1 lets it vary: only one of them can be"},
        {"pickup t2 = t1", 8,
         "t2: the thickness of surface 2 is d2, which has a number of its own in every position"},
        {"pickup k2 = R1", 8, "k2 and R1 have not the same dimension"},
        {"pickup ax2 = k1", 8, "ax2 and k1 have not the same dimension"},
        {"pickup glass2 = n1", 8, "glass2 and n1 have not the same dimension"},
        {"pickup R2 = R1 + R3", 18,
         "a second number that is followed: a pick-up is a factor times one number of the lens, "
         "plus one plain number"},
        {"pickup R2 = 1 + R3 + 2", 22,
         "a second plain number: a pick-up is a factor times one number of the lens, plus one "
         "plain "
         "number"},
        {"pickup R2 = R1 R3", 16, "expected '+' or '-' here"},
        {"pickup R2 = 0 R1", 8, "the factor is 0: nothing is followed"},
        {"pickup R2 = 12", 13, "a pick-up follows a number of the lens: R6 = -R3"},
        {"pickup R2 R1", 8, "a pick-up is written R6 = -R3 or t9 = 0.5 t4 + 2"},
        {"pickup stop = R1", 8, "'stop' names nothing of a surface that may change"},
        {"pickup R2 = R3\npickup R3 = R4\npickup R4 = R2", 8,
         "R4 follows R2, which follows it: pick-ups in a circle"},
        {"pickup R2 = R3\npickup c2 = c4", 8, "c2 has a pick-up already: it follows R3"},
        {"surface 60 - air 20 R~ R~", 24, "'R~' is there twice"},
        {"surface 60 - air 20 R~[60,-50] t~[-inf,3] k~[1]", 45, "bounds are written [low,high]"},
        {"goal", 5, "the goal is missing: efl = 100"},
        {"let a1 1~ 2", 21, "'a1' is marked, but stands for no thickness and no focal length"},
        {"let a1 1~[3,2] 2", 10, "the lower bound is above the upper"},
        {"let a1 1~3 2", 10, "bounds are written [low,high]"},
        {"let a1 1~", 5, "1 numbers for 2 positions"},
        {"let a1 1 2~ 3~", 5, "3 numbers for 2 positions"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct lens lens;
        struct error error;
        const char *file = arena_printf(
            &arena,
            "position a b\nlet d2 2 5\nsurface 50 3 1.5/60 a1 R~\nsurface -50 d2 air 20\n"
            "surface 60 5 1.6 20\nsurface -60 3 air 20\n%s%s\n",
            strncmp(cases[i].line, "let a1", 6) == 0 ? "" : "let a1 20 30\n", cases[i].line);
        CHECK(!read_lens(file, &lens, &error));
        CHECK_TEXT(error.message, cases[i].message);
        CHECK(error.column == cases[i].column && error.code == ERROR_DATA);
        if (error.column != cases[i].column) {
            printf("  %s: column %d\n", cases[i].line, error.column);
        }
    }
}

int main(void)
{
    check_values();
    check_changed();
    check_refused();
    arena_free(&arena);
    return check_report();
}
