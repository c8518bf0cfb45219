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

/* Numbers that decide against the first catalogue of the file are told with what that one has. */
static void check_homonym(void)
{
    struct fixture fixture;
    long line;
    int column;
    fixture_open(&fixture, "homonym.zmx");
    struct text file =
        case_file(&fixture, good,
                  "SCHOTT\nWAVM 1 0.5875618 1\nPWAV 1\nSURF 0\n  DISZ INFINITY\nSURF 1\n"
                  "  STOP\n  CURV 0.02\n  DISZ 4\n  GLAS N-BK7",
                  "SCHOTT CDGM\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n  DISZ 4\n"
                  "  GLAS F2 0 0 1.612929 36.986",
                  &line, &column);
    CHECK(foreign_read(&fixture.job, file, &fixture.lens, &fixture.error));
    const struct medium *medium = &fixture.lens.surfaces[0].medium;
    CHECK(text_equal(medium->written, "CDGM:F2") && medium->warning != NULL &&
          strstr(medium->warning, "SCHOTT:F2 of nd 1.62004 and Vd 36.37") != NULL &&
          strstr(medium->warning, "that is CDGM:F2, which is used") != NULL);
    arena_free(&fixture.arena);
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
    CHECK(strstr(fixture.error.hint, ".zmx, .seq, .len") != NULL);
    arena_free(&fixture.arena);
}

/*
 * The back focus of the lens, by its solve, beside SK2 with the numbers of another glass: by hand
 * f - 4/n with f = 50/(n - 1). Which n the program had is told by the number beside the solve.
 */
static void check_told(void)
{
    static const struct {
        const char *what;
        double index;             /* the program's */
        enum glass_numbers asked; /* by the reader */
        bool is_read;
        double nd; /* then */
    } cases[] = {
        {"the numbers", 1.61765, GLASS_NUMBERS_OF_FILE, true, 1.61765},
        {"the catalogue", 1.60738, GLASS_NUMBERS_OF_FILE, true, 1.60738},
        {"neither", 1.6, GLASS_NUMBERS_OF_FILE, false, 0},
        {"the numbers, against the reader", 1.61765, GLASS_NUMBERS_CATALOG, false, 0},
        {"the catalogue, against the reader", 1.60738, GLASS_NUMBERS_LINE, false, 0},
        {"the numbers, as the reader says", 1.61765, GLASS_NUMBERS_LINE, true, 1.61765},
        {"another edition of the catalogue", 1.607385, GLASS_NUMBERS_OF_FILE, true, 1.60738},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double n = cases[i].index, back = 50 / (n - 1) - 4 / n;
        struct fixture fixture;
        long line;
        int column;
        char text[200];
        fixture_open(&fixture, "told.zmx");
        fixture.job.glass_numbers = cases[i].asked;
        snprintf(text, sizeof text, "GLAS SK2 0 0 1.61765 55.14\nSURF 2\n  DISZ %.15g\n  MAZH 0 0",
                 back);
        struct text file =
            case_file(&fixture, good, "GLAS N-BK7\nSURF 2\n  DISZ 90", text, &line, &column);
        const bool read = foreign_read(&fixture.job, file, &fixture.lens, &fixture.error);
        if (read != cases[i].is_read) {
            printf("%s: %s\n", cases[i].what, read ? "read" : fixture.error.message);
        }
        CHECK(read == cases[i].is_read);
        if (read) {
            CHECK_RELATIVE(focal_length(&fixture), 50 / (cases[i].nd - 1), 1e-5, cases[i].what);
            const char *warning = fixture.lens.surfaces[0].medium.warning;
            CHECK(warning != NULL && strstr(warning, "nd 1.60738") != NULL &&
                  strstr(warning, "nd 1.61765") != NULL);
        } else {
            CHECK(fixture.error.line == 16 &&
                  strstr(fixture.error.message, "contradicts the lens") != NULL);
        }
        arena_free(&fixture.arena);
    }
}

/*
 * What is rounded is no contradiction: f = 50/(n - 1) of n = 1.5168 known by nd and Vd only, at
 * another wavelength, and a back focus of 4 digits. With 8 digits of a wrong one it is.
 */
static void check_rounding(void)
{
    static const struct {
        const char *wave, *back;
        bool is_read;
    } cases[] = {
        {"0.5875618", "94.1121", true},         {"0.5875618", "94.11", true},
        {"0.5875618", "94.11220000001", false}, {"0.5460740", "93.76600000001", true},
        {"0.5460740", "94.11220000001", false}, {"0.5875618", "0", true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct fixture fixture;
        long line;
        int column;
        char text[400];
        fixture_open(&fixture, "rounded.zmx");
        snprintf(
            text, sizeof text,
            "WAVM 1 %s 1\nPWAV 1\nSURF 0\n  DISZ INFINITY\nSURF 1\n  STOP\n  CURV 0.02\n"
            "  DISZ 4\n  GLAS ___BLANK 1 0 1.5168 64.17\nSURF 2\n  DISZ %s\n  MAZH 0 0\nSURF 3",
            cases[i].wave, cases[i].back);
        const char *from = strstr(good, "WAVM"), *to = strstr(good, "\n  DISZ 0");
        char *old = arena_string(&fixture.arena, from, (size_t)(to - from));
        struct text file = case_file(&fixture, good, old, text, &line, &column);
        const bool read = foreign_read(&fixture.job, file, &fixture.lens, &fixture.error);
        if (read != cases[i].is_read) {
            printf("%s um, %s: %s\n", cases[i].wave, cases[i].back,
                   read ? "read" : fixture.error.message);
        }
        CHECK(read == cases[i].is_read);
        arena_free(&fixture.arena);
    }
}

int main(void)
{
    check_choices();
    check_told();
    check_rounding();
    check_homonym();
    check_refused();
    return check_report();
}
