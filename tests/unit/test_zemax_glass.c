/* tests/unit/test_zemax_glass.c - .zmx files whose numbers beside a glass are not its own. */
/* SPDX-License-Identifier: MIT */
#include "foreign_cases.h"
#include "optics/first_order.h"

/* A plano-convex lens, c = 0.02: f = 1/((n - 1) c) for any thickness. */
static const char good[] = "MODE SEQ\nUNIT MM\nENPD 10\nGCAT SCHOTT\nWAVM 1 0.5875618 1\nPWAV 1\n"
                           "SURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n"
                           "  GLAS N-BK7\nSURF 2\n  DISZ 90\nSURF 3\n  DISZ 0\n";

static double focal_length(struct fixture *fixture)
{
    struct first_order first = {.efl = NAN};
    CHECK(first_order_of_lens(&fixture->lens, 0.5875618, SECTION_Y, &fixture->arena, &first,
                              &fixture->error));
    return first.efl;
}

/* nd as SCHOTT prints them; what counts of a line, with each --glass-numbers. */
static void check_choices(void)
{
    static const struct {
        const char *glass;
        double file, line, catalog; /* nd */
    } cases[] = {
        {"SK2 0 0 1.61765 55.14", 1.60738, 1.61765, 1.60738},
        {"SK2 3 0 1.61765 55.14", 1.60738, 1.61765, 1.60738},
        {"SK2 1 0 1.61765 55.14", 1.61765, 1.61765, 1.60738},
        {"SK2 4 0 1.61765 55.14", 1.61765, 1.61765, 1.60738},
        {"SK2 0 0 1.5 40", 1.60738, 1.60738, 1.60738}, /* as written where nothing is known */
        {"SK2 0 0 0 0", 1.60738, 1.60738, 1.60738},
        {"NOGLASS 0 0 1.6 50", 1.6, 1.6, 1.6}, /* in no catalogue */
        {"NOGLASS 1 0 1.6 50", 1.6, 1.6, 1.6},
        {"___BLANK 1 0 1.6 50", 1.6, 1.6, 1.6},
    };
    for (size_t i = 0; i < 3 * sizeof cases / sizeof cases[0]; i++) {
        const double wanted[] = {cases[i / 3].file, cases[i / 3].line, cases[i / 3].catalog};
        struct fixture fixture;
        long line;
        int column;
        fixture_open(&fixture, "choice.zmx");
        fixture.job.glass_numbers = (enum glass_numbers)(i % 3);
        struct text file = case_file(&fixture, good, "N-BK7", cases[i / 3].glass, &line, &column);
        CHECK(foreign_read(&fixture.job, file, &fixture.lens, &fixture.error));
        CHECK_RELATIVE(focal_length(&fixture), 50 / (wanted[i % 3] - 1), 1e-5, cases[i / 3].glass);
        arena_free(&fixture.arena);
    }
}

/* A format whose glasses are names or numbers, never both, refuses the choice. */
static void check_refused(void)
{
    struct fixture fixture;
    fixture_open(&fixture, "own.lens");
    fixture.job.glass_numbers = GLASS_NUMBERS_LINE;
    struct text file = text_of("surface 50 4 SCHOTT:N-BK7 - stop\nsurface - 90 air -\n");
    CHECK(!foreign_read(&fixture.job, file, &fixture.lens, &fixture.error));
    CHECK(strcmp(fixture.error.message, "a file without indices beside the names of its glasses") ==
          0);
    CHECK(strstr(fixture.error.hint, ".zmx") != NULL);
    arena_free(&fixture.arena);
}

int main(void)
{
    check_choices();
    check_refused();
    return check_report();
}
