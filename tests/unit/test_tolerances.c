/* tests/unit/test_tolerances.c - tolerances by grade, from a file, and of the lens itself. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/tolerances.h"

#include "base/constants.h"

#include "check.h"
#include "lens_of.h"

#include <stdio.h>
#include <stdlib.h>

/* A single lens with a plane, and one of a glass without an Abbe number. */
#define LENS                                                                                       \
    "surface 50 5 1.5/60 20\nsurface - 6 air 20\nsurface 70 4 1.6 24\nsurface -70 60 air 22\n"

struct asked {
    struct arena arena;
    struct perturbations all;
    const char *assumed;
    struct error error;
    bool done;
};

static void ask(const char *content, const char *grade, const char *file, struct asked *asked)
{
    *asked = (struct asked){.assumed = ""};
    struct arena *arena = &asked->arena;
    struct lensdb db = {.arena = arena};
    const struct lens lens = lens_of(content, arena);
    const struct tolerances_reader reader = {&lens, &db, arena};
    asked->done = tolerances_of(&reader, grade, file, &asked->all, &asked->assumed, &asked->error);
}

/* The half range of what has this name; NaN where nothing has. */
static double amount_of(const struct asked *asked, const char *name)
{
    for (size_t i = 0; i < asked->all.count; i++) {
        if (strcmp(asked->all.list[i].name, name) == 0) {
            return asked->all.list[i].amount;
        }
    }
    return NAN;
}

/* The grade's table by hand: of R 0.1 %, of planes 5.79 fringes over 20 mm, and so on. */
static void test_grade(void)
{
    static const struct {
        const char *name;
        double amount;
    } precision[] = {
        {"R1", 0.05},
        {"R2", 5.79 * 546.07e-6 / (100 + 2.49916e-6)}, /* 2 d/(r^2 + d^2) */
        {"R3", 0.07},
        {"t1", 0.05},
        {"t2", 0.05},
        {"n1", 0.0005},
        {"V1", 0.3},
        {"surface 2 irregularity 0deg", 0.232},
        {"element 1..2 tilt x", 2.1 / 60 * PI / 180},
        {"element 3..4 decenter y", 0.0125},
    };
    struct asked asked;
    ask(LENS, "precision", NULL, &asked);
    CHECK(asked.done);
    for (size_t i = 0; i < sizeof precision / sizeof *precision; i++) {
        CHECK_RELATIVE(amount_of(&asked, precision[i].name), precision[i].amount, 1e-9,
                       precision[i].name);
    }
    /* 4 radii, 3 spaces, 2 indices, 1 Abbe number, 4 irregularities of 3, 2 elements of 4 */
    CHECK(asked.all.count == 4 + 3 + 2 + 1 + 12 + 8);
    CHECK_TEXT(asked.assumed, "grade precision; without V3, of media that have no Abbe number");
    arena_free(&asked.arena);
}

static void test_marks(void)
{
    struct asked asked;
    ask("tolerance R1 1%\ntolerance t2 0.5\n" LENS, "high", NULL, &asked);
    CHECK(asked.done && amount_of(&asked, "R1") == 0.5 && amount_of(&asked, "t2") == 0.5);
    CHECK_TEXT(asked.assumed, "grade high, but R1, t2 of the lens; without V3, of media that have "
                              "no Abbe number");
    arena_free(&asked.arena);
    ask("tolerance R1 1%\n" LENS, NULL, NULL, &asked);
    CHECK(asked.done && asked.all.count == 1);
    CHECK_TEXT(asked.assumed, "those of the lens");
    arena_free(&asked.arena);
    char shop[] = "/tmp/tolerances-test-XXXXXX", assumed[80];
    const int descriptor = mkstemp(shop);
    FILE *file = descriptor >= 0 ? fdopen(descriptor, "w") : NULL;
    CHECK(file != NULL && fputs("# ours\ntolerance t1 20um normal\n", file) >= 0 &&
          fclose(file) == 0);
    ask("tolerance R1 1%\n" LENS, NULL, shop, &asked);
    CHECK(asked.done && asked.all.count == 1 && amount_of(&asked, "t1") == 0.02);
    snprintf(assumed, sizeof assumed, "those of %s; those of the lens are not used", shop);
    CHECK_TEXT(asked.assumed, assumed);
    arena_free(&asked.arena);
    remove(shop);
}

static void test_refused(void)
{
    static const struct {
        const char *lens, *grade, *file, *message, *hint;
        enum error_code code;
    } refused[] = {
        {LENS, "precisoin", NULL, "there is no grade 'precisoin'", "did you mean 'precision'?",
         ERROR_USAGE},
        {LENS, "gold", NULL, "there is no grade 'gold'", "see 'lenscalc list tolerances'",
         ERROR_USAGE},
        {LENS, NULL, "no-such-folder/none",
         "cannot read no-such-folder/none: there is no such file", "", ERROR_IO},
        {LENS, NULL, NULL, "nothing of the lens has a tolerance",
         "give a grade, or lines 'tolerance R1 0.1% uniform' in the lens or in a file of their own",
         ERROR_DOMAIN},
        {"surface 50 5 1.5 -\nsurface -50 60 air 20\n", "commercial", NULL,
         "the tolerance of surface 1 irregularity in grade commercial cannot be: surface 1 without "
         "a diameter, which the irregularity is over",
         "the diameter in the line of a surface is what it takes; or lines 'tolerance ...' without "
         "such in the lens or in a file of their own, in place of the grade",
         ERROR_DOMAIN},
        {"surface 50 5 1.5 20\nsurface -50 0.01 air 20\n" LENS, "commercial", NULL,
         "the tolerance of t2 in grade commercial cannot be: it is as wide as the number itself, "
         "0.01",
         "a line 'tolerance t2 ...' of its own goes before the grade", ERROR_DOMAIN},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        struct asked asked;
        ask(refused[i].lens, refused[i].grade, refused[i].file, &asked);
        CHECK(!asked.done && asked.error.code == refused[i].code);
        CHECK_TEXT(asked.error.message, refused[i].message);
        CHECK_TEXT(asked.error.hint, refused[i].hint);
        arena_free(&asked.arena);
    }
}

int main(void)
{
    test_grade();
    test_marks();
    test_refused();
    return check_report();
}
