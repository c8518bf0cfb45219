/* tests/unit/test_tolerance.c - tolerances as they are written, in mm and rad. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "check.h"
#include "file/lens_tolerance.h"
#include "lens_of.h"

static const char lens_text[] = "unit in\n"
                                "surface 2 0.2 1.5/60 0.8 A4=1e-6\n"
                                "surface -2 1 air 0.8\n";

/* Lines of a file of their own, for a lens in inches. */
static const struct line {
    const char *text;
    enum tolerance_kind kind;
    enum tolerance_unit unit;
    double amount, sigmas;
    enum distribution distribution;
    size_t first, last, pivot;
    bool is_range;
} lines[] = {
    {"R1 0.1%", TOLERANCE_RADIUS, TOLERANCE_PERCENT, 0.1, 2, DISTRIBUTION_UNIFORM, 0, 0, LENS_NONE,
     false},
    {"R1..R2 0.001 normal", TOLERANCE_RADIUS, TOLERANCE_LENGTH, 0.0254, 2, DISTRIBUTION_NORMAL, 0,
     1, LENS_NONE, true},
    {"t1 20um truncated 3sigma", TOLERANCE_THICKNESS, TOLERANCE_LENGTH, 0.02, 3,
     DISTRIBUTION_TRUNCATED, 0, 0, LENS_NONE, false},
    {"A4_1 1e-9", TOLERANCE_COEFFICIENT, TOLERANCE_NUMBER, 1e-9 / (25.4 * 25.4 * 25.4), 2,
     DISTRIBUTION_UNIFORM, 0, 0, LENS_NONE, false},
    {"surface 2 tilt 0.5", TOLERANCE_TILT, TOLERANCE_ANGLE, PI / 360, 2, DISTRIBUTION_UNIFORM, 1, 1,
     LENS_NONE, false},
    {"element 1..2 tilt 3arcmin parabolic pivot 2", TOLERANCE_ELEMENT_TILT, TOLERANCE_ANGLE,
     PI / 3600, 2, DISTRIBUTION_PARABOLIC, 0, 1, 1, false},
    {"elements 1..2 wedge 0.01mm two-point", TOLERANCE_WEDGE, TOLERANCE_LENGTH, 0.01, 2,
     DISTRIBUTION_TWO_POINT, 0, 1, LENS_NONE, true},
    {"surface 1..2 irregularity 0.5fringes", TOLERANCE_IRREGULARITY, TOLERANCE_FRINGES, 0.5, 2,
     DISTRIBUTION_UNIFORM, 0, 1, LENS_NONE, true},
    {"focus 1mil", TOLERANCE_KINDS, TOLERANCE_LENGTH, 0, 0, DISTRIBUTION_UNIFORM, 0, 0, 0, false},
};

static void check_line(const struct line *line, const struct lens *lens, struct arena *arena)
{
    struct tolerances all;
    struct error error = {.code = ERROR_NONE};
    const char *content = arena_printf(arena, "# ours\n\n tolerance  %s # as agreed\n", line->text);
    const bool read = lens_tolerances_read("shop.txt", text_of(content), lens, arena, &all, &error);
    CHECK(read == (line->kind != TOLERANCE_KINDS));
    if (!read) {
        CHECK(error.code == ERROR_DATA && error.line == 3 && error.column == 20);
        CHECK_TEXT(error.source, "shop.txt");
        return;
    }
    const struct lens_tolerance *one = &all.list[0];
    CHECK(all.count == 1 && one->kind == line->kind && one->unit == line->unit);
    CHECK(one->first == line->first && one->last == line->last && one->pivot == line->pivot);
    CHECK(one->is_range == line->is_range && one->distribution == line->distribution);
    CHECK(one->sigmas == line->sigmas && one->line == 3 && one->column == 13);
    CHECK_RELATIVE(one->amount.value.hi, line->amount, 1e-15, line->text);
    /* written and read again it is the same */
    struct text_buffer written = {.arena = arena};
    growing_string(&written, "tolerance ");
    lens_tolerance_write(one, "in", &written);
    CHECK(lens_tolerances_read("again", growing_done(&written), lens, arena, &all, &error));
    CHECK_RELATIVE(all.list[0].amount.value.hi, line->amount, 1e-15, "again");
    CHECK(all.list[0].pivot == line->pivot && all.list[0].is_range == line->is_range);
}

static void test_lines(void)
{
    struct arena arena = {0};
    const struct lens lens = lens_of(lens_text, &arena);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        check_line(&lines[i], &lens, &arena);
    }
    arena_free(&arena);
}

/* What is no file of tolerances. */
static void test_files(void)
{
    static const struct {
        const char *content, *message;
        long line;
        int column;
    } files[] = {
        {"", "no line with 'tolerance'", 0, 0},
        {"# none\n", "no line with 'tolerance'", 0, 0},
        {"tolerance R1 1%\nsurface 1 2 3\n",
         "unknown word 'surface': lines of this file begin with 'tolerance'", 2, 1},
    };
    struct arena arena = {0};
    const struct lens lens = lens_of(lens_text, &arena);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        struct tolerances all;
        struct error error = {.code = ERROR_NONE};
        CHECK(!lens_tolerances_read("shop.txt", text_of(files[i].content), &lens, &arena, &all,
                                    &error));
        CHECK_TEXT(error.message, files[i].message);
        CHECK(error.line == files[i].line && error.column == files[i].column);
    }
    arena_free(&arena);
}

/* So many and no more. */
static void test_many(void)
{
    struct arena arena = {0};
    struct tolerances all;
    struct error error = {.code = ERROR_NONE};
    struct text_buffer file = {.arena = &arena};
    const struct lens lens = lens_of(lens_text, &arena);
    for (int i = 0; i < 1000; i++) {
        growing_string(&file, "tolerance focus 1um\n");
    }
    CHECK(lens_tolerances_read("many", growing_done(&file), &lens, &arena, &all, &error));
    growing_string(&file, "tolerance focus 1um\n");
    CHECK(!lens_tolerances_read("many", growing_done(&file), &lens, &arena, &all, &error));
    CHECK_TEXT(error.message, "more than 1000 tolerances");
    CHECK(error.line == 1001 && error.column == 11);
    arena_free(&arena);
}

int main(void)
{
    test_many();
    test_lines();
    test_files();
    return check_report();
}
